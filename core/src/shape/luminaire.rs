//! Shapes that can light a scene.

use crate::math::Vec3;

/// The surface of a shape that lights a scene if its material emits light, see
/// [`Geometry::luminaire`](super::Geometry::luminaire).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Luminaire {
    /// A ball.
    Ball {
        /// Its center.
        center: Vec3,
        /// Its radius.
        radius: f32,
    },
    /// A disc without a hole. Both sides shine.
    Disc {
        /// Its center.
        center: Vec3,
        /// The direction at right angles to it; any length but 0.
        normal: Vec3,
        /// Its radius.
        radius: f32,
    },
    /// A rectangle or parallelogram. Both sides shine.
    Rectangle {
        /// One corner.
        corner: Vec3,
        /// The edge from that corner to the next one.
        right: Vec3,
        /// The other edge from that corner.
        up: Vec3,
    },
}
