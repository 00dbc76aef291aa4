//! The settings in a scene's file: how its picture is meant to be drawn.

use rayline::read::{plain, read_struct};
use rayline::shape::Shape;
use rayline::{
    AreaLights, Background, Camera, Dither, Integrator, Light, Look, Material, Motion, Object, Sampling,
    Scene, Settings, Transfer,
};
use rayline_formats::Exposure;
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
    /// [`Settings::integrator`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub integrator: Option<Integrator>,
    /// [`Settings::area_lights`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area_lights: Option<AreaLights>,
    /// [`Settings::transfer`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub transfer: Option<Transfer>,
    /// [`Settings::dither`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dither: Option<Dither>,
    /// [`Settings::look`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub look: Option<Look>,
    /// The exposure. The scene is as written: [`LoadedScene`](crate::LoadedScene) exposes it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exposure: Option<Exposure>,
}

plain!(FileSettings);

impl FileSettings {
    /// The settings that differ from the usual ones, apart from the size.
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
            integrator: changed(usual.integrator, settings.integrator),
            area_lights: changed(usual.area_lights, settings.area_lights),
            transfer: changed(usual.transfer, settings.transfer),
            dither: changed(usual.dither, settings.dither),
            look: changed(usual.look, settings.look),
            // A scene that was opened is exposed already.
            exposure: None,
        }
    }

    fn are_usual(&self) -> bool {
        *self == Self::default()
    }

    /// The usual settings with those of the file.
    pub fn over(&self, usual: Settings) -> Settings {
        let (width, height) = self.size.unwrap_or((usual.width, usual.height));
        Settings {
            width,
            height,
            bounces: self.bounces.unwrap_or(usual.bounces),
            rays_per_pixel: self.rays_per_pixel.unwrap_or(usual.rays_per_pixel),
            cutoff: self.cutoff.unwrap_or(usual.cutoff),
            sampling: self.sampling.unwrap_or(usual.sampling),
            integrator: self.integrator.unwrap_or(usual.integrator),
            area_lights: self.area_lights.unwrap_or(usual.area_lights),
            transfer: self.transfer.unwrap_or(usual.transfer),
            dither: self.dither.unwrap_or(usual.dither),
            look: self.look.unwrap_or(usual.look),
        }
    }
}

/// All that a file holds: the fields of a scene, and the settings of its picture.
#[derive(Serialize)]
pub(super) struct File<'a> {
    camera: Camera,
    background: Background<'a>,
    objects: &'a [Object<Shape<'a>>],
    materials: &'a [Material<'a>],
    lights: &'a [Light],
    #[serde(skip_serializing_if = "<[Motion]>::is_empty")]
    motions: &'a [Motion],
    #[serde(skip_serializing_if = "FileSettings::are_usual")]
    pub(super) settings: FileSettings,
}

read_struct! {
    [] Scene as File<'m> {
        camera, background = Background::BLACK, objects, materials, lights = &[], motions = &[],
        settings = FileSettings::default(),
    }
}

impl<'a> File<'a> {
    pub(super) fn new(scene: &Scene<'a>, settings: FileSettings) -> Self {
        let Scene { camera, background, objects, materials, lights, motions } = *scene;
        Self { camera, background, objects, materials, lights, motions, settings }
    }

    pub(super) fn scene(&self) -> Scene<'a> {
        let Self { camera, background, objects, materials, lights, motions, .. } = *self;
        Scene { camera, background, objects, materials, lights, motions }
    }
}
