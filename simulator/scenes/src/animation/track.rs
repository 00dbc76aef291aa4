//! Values that change between key frames.

use rayline::{Camera, Lamp, Light, LinearRgb, Vec3};

use super::error::AnimationFault;
use super::placement::Placement;

/// The values at the key frames of one part of the scene, by time: one or more.
#[derive(Clone, Debug)]
pub(super) struct Track<T> {
    first: T,
    /// For each key frame its time, whether the way to it begins and ends at rest, and its value.
    keys: Vec<(f32, bool, T)>,
}

impl<T: Between> Track<T> {
    pub(super) fn new(keys: impl Iterator<Item = (f32, bool, T)>) -> Result<Self, AnimationFault> {
        let keys: Vec<_> = keys.collect();
        let Some((_, _, first)) = keys.first() else { return Err(AnimationFault::NoKeys) };
        let mut before = None;
        for (at, ..) in &keys {
            if !(at.is_finite() && *at >= 0.0 && before.is_none_or(|before| *at > before)) {
                return Err(AnimationFault::Times { at: *at });
            }
            before = Some(*at);
        }
        Ok(Self { first: *first, keys })
    }

    /// The value at a time in seconds.
    pub(super) fn at(&self, seconds: f32) -> T {
        let next = self.keys.partition_point(|(at, ..)| *at <= seconds);
        let before = next.checked_sub(1).and_then(|last| self.keys.get(last));
        match (before, self.keys.get(next)) {
            (Some((from, _, before)), Some((to, ease, after))) => {
                let share = (seconds - from) / (to - from);
                // The cubic that is level at both ends.
                let share = if *ease { share * share * (3.0 - 2.0 * share) } else { share };
                before.between(after, share)
            }
            (Some((.., last)), None) => *last,
            (None, _) => self.first,
        }
    }
}

/// A value that can change evenly into another one.
pub(super) trait Between: Copy {
    /// The value at a share of the way from this one to `other`.
    fn between(&self, other: &Self, share: f32) -> Self;
}

impl Between for f32 {
    fn between(&self, other: &Self, share: f32) -> Self {
        self + (other - self) * share
    }
}

impl Between for Vec3 {
    fn between(&self, other: &Self, share: f32) -> Self {
        *self + (*other - *self) * share
    }
}

impl Between for LinearRgb {
    fn between(&self, other: &Self, share: f32) -> Self {
        let Self { r, g, b } = self;
        Self::new(r.between(&other.r, share), g.between(&other.g, share), b.between(&other.b, share))
    }
}

impl Between for Camera {
    fn between(&self, other: &Self, share: f32) -> Self {
        Self {
            eye: self.eye.between(&other.eye, share),
            target: self.target.between(&other.target, share),
            up: self.up.between(&other.up, share),
            vertical_fov: self.vertical_fov.between(&other.vertical_fov, share),
            lens: self.lens,
        }
    }
}

impl Between for Placement {
    fn between(&self, other: &Self, share: f32) -> Self {
        Self {
            by: self.by.between(&other.by, share),
            rotation: self.rotation.between(&other.rotation, share),
            about: self.about.between(&other.about, share),
        }
    }
}

/// Between two lights of one kind.
impl Between for Light {
    fn between(&self, other: &Self, share: f32) -> Self {
        match (*self, *other) {
            (Self::Point { position, color }, Self::Point { position: place, color: shine }) => {
                Self::Point { position: position.between(&place, share), color: color.between(&shine, share) }
            }
            (Self::Directional { direction, color }, Self::Directional { direction: way, color: shine }) => {
                let (direction, color) = (direction.between(&way, share), color.between(&shine, share));
                Self::Directional { direction, color }
            }
            (Self::Lamp(lamp), Self::Lamp(other)) => {
                let mut cone = lamp.cone;
                if let (Some(cone), Some(other)) = (&mut cone, other.cone) {
                    cone.direction = cone.direction.between(&other.direction, share);
                }
                let position = lamp.position.between(&other.position, share);
                Self::Lamp(Lamp { position, color: lamp.color.between(&other.color, share), cone, ..lamp })
            }
            (Self::Ambient { color }, Self::Ambient { color: other }) => {
                Self::Ambient { color: color.between(&other, share) }
            }
            (light, _) => light,
        }
    }
}
