//! Key frames as they stand in a file, and the values of the scene that they give.

use rayline::{Camera, Lamp, Light, LinearRgb, Vec3};
use rayline_formats::Exposure;
use serde::Deserialize;

use super::error::AnimationFault;
use super::placement::Placement;

/// The camera at a key frame.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraKey {
    pub(super) at: f32,
    #[serde(default)]
    pub(super) ease: bool,
    eye: Option<Vec3>,
    target: Option<Vec3>,
    up: Option<Vec3>,
    vertical_fov: Option<f32>,
}

impl CameraKey {
    /// The scene's camera with the fields of this key frame.
    pub(super) fn of(&self, own: &Camera) -> Camera {
        Camera {
            eye: self.eye.unwrap_or(own.eye),
            target: self.target.unwrap_or(own.target),
            up: self.up.unwrap_or(own.up),
            vertical_fov: self.vertical_fov.unwrap_or(own.vertical_fov),
            lens: own.lens,
        }
    }
}

/// The place of an object at a key frame.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectKey {
    pub(super) at: f32,
    #[serde(default)]
    pub(super) ease: bool,
    by: Option<Vec3>,
    rotation: Option<Vec3>,
    about: Option<Vec3>,
}

impl ObjectKey {
    pub(super) fn placement(&self) -> Placement {
        let or_zero = |vector: Option<Vec3>| vector.unwrap_or(Vec3::ZERO);
        Placement { by: or_zero(self.by), rotation: or_zero(self.rotation), about: or_zero(self.about) }
    }
}

/// A light at a key frame.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightKey {
    pub(super) at: f32,
    #[serde(default)]
    pub(super) ease: bool,
    position: Option<Vec3>,
    direction: Option<Vec3>,
    color: Option<LinearRgb>,
}

impl LightKey {
    /// The scene's light with the fields of this key frame. A scene of this exposure has it already; the
    /// color of the key frame gets it here.
    pub(super) fn of(&self, own: &Light, exposure: Exposure) -> Result<Light, AnimationFault> {
        let mut light = *own;
        let (place, way, shine) = match &mut light {
            Light::Point { position, color } => (Some(position), None, Some(color)),
            Light::Directional { direction, color } => (None, Some(direction), Some(color)),
            Light::Lamp(Lamp { position, color, cone, .. }) => {
                (Some(position), cone.as_mut().map(|cone| &mut cone.direction), Some(color))
            }
            Light::Ambient { color } => (None, None, Some(color)),
            _ => (None, None, None),
        };
        set(place, self.position, "position")?;
        set(way, self.direction, "direction")?;
        set(shine, self.color.map(|color| exposure.of_color(color)), "color")?;
        Ok(light)
    }
}

/// Sets a field, if a value is given.
fn set<T>(field: Option<&mut T>, value: Option<T>, name: &'static str) -> Result<(), AnimationFault> {
    match (field, value) {
        (_, None) => Ok(()),
        (Some(field), Some(value)) => {
            *field = value;
            Ok(())
        }
        (None, Some(_)) => Err(AnimationFault::Field(name)),
    }
}
