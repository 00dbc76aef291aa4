//! Motion blur: motions of the camera and of objects while the shutter is open.
//!
//! Each sample of a pixel has one time, which all its rays share (Cook, Porter and Carpenter, "Distributed
//! Ray Tracing", 1984). A ray that is tested against a moving object is moved back to where the object was
//! described, and its hit is moved to where the object is by then.

#[cfg(feature = "distributed")]
mod moved;

#[cfg(feature = "distributed")]
pub(crate) use moved::{Moved, PreparedMotion};

use crate::arena::Arena;
use crate::light::ObjectId;
use crate::math::{Extent, Real, Vec3};

/// A motion of the camera or of an object while the shutter is open, at even speed. The scene describes where
/// everything is when the shutter opens. It needs the feature `distributed`, and several samples for each
/// pixel.
///
/// A spinning object is first turned, then moved. Textures and bumps go along. Lights without a size do not
/// move.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Motion {
    /// The camera or an object, each at most once in [`Scene::motions`](crate::Scene::motions).
    pub of: Mover,
    /// The way of the motion until the shutter closes.
    pub by: Vec3,
    /// The turn until the shutter closes; `None`: none.
    pub spin: Option<Spin>,
}

/// The camera or an object that moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Mover {
    /// The camera.
    Camera,
    /// An object.
    Object(ObjectId),
}

/// A turn about an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Spin {
    /// A point of the axis.
    pub center: Vec3,
    /// The direction of the axis; any length but 0.
    pub axis: Vec3,
    /// The angle in radians: counterclockwise, as seen from the end of the axis. At most 10 turns.
    pub angle: f32,
}

#[cfg(feature = "serde")]
crate::read::plain!(Spin);
#[cfg(feature = "serde")]
crate::read::read_enum! { [] Mover as Mover { Camera, Object(ObjectId) } }
#[cfg(feature = "serde")]
crate::read::read_struct!([] Motion as Motion { of, by = Vec3::ZERO, spin = None });

impl Motion {
    /// The camera moves by this vector.
    pub const fn of_camera(by: Vec3) -> Self {
        Self { of: Mover::Camera, by, spin: None }
    }

    /// The object at this position in [`Scene::objects`](crate::Scene::objects) moves by this vector.
    pub const fn of_object(object: u16, by: Vec3) -> Self {
        Self { of: Mover::Object(ObjectId(object)), by, spin: None }
    }

    /// Adds a turn to the motion.
    pub const fn spinning(self, center: Vec3, axis: Vec3, angle: f32) -> Self {
        Self { spin: Some(Spin { center, axis, angle }), ..self }
    }

    /// The memory that so many prepared motions take: at most as much as this array.
    pub(crate) const fn bytes<R: Real>(count: usize) -> usize {
        Arena::bytes::<[R; 12]>(count)
    }

    /// The extent of a moved object, which was `still` before.
    pub(crate) fn extent(&self, still: Extent) -> Extent {
        let moved = |magnitude| if magnitude > 0.0 { self.reach(magnitude) } else { 0.0 };
        let plane = still.plane.map(|distance| distance + self.by.length() + self.beside());
        Extent { solid: moved(still.solid), flat: moved(still.flat), plane }
    }

    /// The largest coordinate of a moved point whose coordinates were within ±`magnitude`.
    pub(crate) fn reach(&self, magnitude: f32) -> f32 {
        // No such point is farther from the center of a spin than √3 · `magnitude` and the center's own
        // distance.
        let turned = if self.spin.is_some() { magnitude * 1.7321 } else { magnitude };
        turned + (self.by.magnitude() + self.beside())
    }

    /// The largest distance that a spin adds because its center is beside the origin.
    fn beside(&self) -> f32 {
        self.spin.map_or(0.0, |spin| spin.center.length() * 2.0)
    }
}
