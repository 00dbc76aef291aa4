//! The settings in a scene's file: how its picture is meant to be drawn.

use rayline::read::{Fields, Read, Reader, next_field, next_value, plain, read_fields, set_field};
use rayline::{Background, Sampling, Scene, Settings};
use serde::de::{Deserializer, MapAccess, SeqAccess};
use serde::{Deserialize, Serialize};

/// The field `settings` of a scene's file. Settings that are left out have their usual values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FileSettings {
    /// [`Settings::width`] and [`Settings::height`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size: Option<(u32, u32)>,
    /// [`Settings::bounces`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bounces: Option<u8>,
    /// [`Settings::rays_per_pixel`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rays_per_pixel: Option<u32>,
    /// [`Settings::cutoff`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cutoff: Option<f32>,
    /// [`Settings::sampling`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sampling: Option<Sampling>,
}

plain!(FileSettings);

impl FileSettings {
    /// What differs between some settings and the usual ones, apart from the size.
    pub(super) fn beside(usual: &Settings, settings: &Settings) -> Self {
        fn changed<T: PartialEq>(usual: T, value: T) -> Option<T> {
            (usual != value).then_some(value)
        }
        Self {
            size: None,
            bounces: changed(usual.bounces, settings.bounces),
            rays_per_pixel: changed(usual.rays_per_pixel, settings.rays_per_pixel),
            cutoff: changed(usual.cutoff, settings.cutoff),
            sampling: changed(usual.sampling, settings.sampling),
        }
    }

    /// The usual settings with those of the file.
    pub(crate) fn over(&self, usual: Settings) -> Settings {
        let (width, height) = self.size.unwrap_or((usual.width, usual.height));
        Settings {
            width,
            height,
            bounces: self.bounces.unwrap_or(usual.bounces),
            rays_per_pixel: self.rays_per_pixel.unwrap_or(usual.rays_per_pixel),
            cutoff: self.cutoff.unwrap_or(usual.cutoff),
            sampling: self.sampling.unwrap_or(usual.sampling),
            ..usual
        }
    }
}

/// All that a file holds: a scene, and the settings of its picture.
pub(super) struct File<'a> {
    pub(super) scene: Scene<'a>,
    pub(super) settings: FileSettings,
}

impl<'m> Read<'m> for File<'m> {
    fn read<D: Deserializer<'m>>(from: D, reader: &mut Reader<'m>) -> Result<Self, D::Error> {
        read_fields(from, reader)
    }
}

impl<'m> Fields<'m> for File<'m> {
    const NAME: &'static str = "Scene";
    const FIELDS: &'static [&'static str] =
        &["camera", "background", "objects", "materials", "lights", "settings"];

    fn from_values<A: SeqAccess<'m>>(mut values: A, reader: &mut Reader<'m>) -> Result<Self, A::Error> {
        Ok(Self {
            scene: Scene {
                camera: next_value(&mut values, reader, "camera")?,
                background: next_value(&mut values, reader, "background")?,
                objects: next_value(&mut values, reader, "objects")?,
                materials: next_value(&mut values, reader, "materials")?,
                lights: next_value(&mut values, reader, "lights")?,
            },
            settings: next_value(&mut values, reader, "settings")?,
        })
    }

    fn from_map<A: MapAccess<'m>>(mut map: A, reader: &mut Reader<'m>) -> Result<Self, A::Error> {
        let (mut camera, mut background, mut objects) = (None, None, None);
        let (mut materials, mut lights, mut settings) = (None, None, None);
        while let Some(field) = next_field(&mut map, Self::FIELDS)? {
            match field {
                "camera" => set_field(&mut camera, &mut map, reader, field),
                "background" => set_field(&mut background, &mut map, reader, field),
                "objects" => set_field(&mut objects, &mut map, reader, field),
                "materials" => set_field(&mut materials, &mut map, reader, field),
                "lights" => set_field(&mut lights, &mut map, reader, field),
                _ => set_field(&mut settings, &mut map, reader, field),
            }?;
        }
        let missing = serde::de::Error::missing_field;
        Ok(Self {
            scene: Scene {
                camera: camera.ok_or_else(|| missing("camera"))?,
                background: background.unwrap_or(Background::BLACK),
                objects: objects.ok_or_else(|| missing("objects"))?,
                materials: materials.ok_or_else(|| missing("materials"))?,
                lights: lights.unwrap_or(&[]),
            },
            settings: settings.unwrap_or_default(),
        })
    }
}
