//! Places on surfaces in two numbers: what the mappings of shapes have in common (Glassner (ed.), "An Introduction to Ray
//! Tracing", 1989, ch. 2).
//!
//! | shape | u | v |
//! |---|---|---|
//! | sphere, ellipsoid, quadric, implicit surfaces | longitude about the y axis, from x toward -z: 0 to 1 | latitude, from below to above: 0 to 1 |
//! | cylinder, cone: side | angle about the axis: 0 to 1 | height, from base to top: 0 to 1 |
//! | disc, lids | across, in the square around it: 0 to 1 | across that: 0 to 1 |
//! | torus | angle about the axis: 0 to 1 | angle about the ring, from its outside toward the axis' end: 0 to 1 |
//! | rectangle | along `right`: 0 to 1 | along `up`: 0 to 1 |
//! | box | across the face: 0 to 1 | across that: 0 to 1 |
//! | triangle, mesh without coordinates of its own | weight of the second corner | weight of the third corner |
//! | plane, polygon, polyhedron | length along the plane, from the origin | length across that |
//! | instances | that of the model, where it was described | that of the model |
//!
//! Seen from the front u grows to the right and v upward. Across an axis or normal, u and angles begin toward the x axis; if
//! it lies along that, toward y: on a floor u is x and v is -z, and on a wall that faces z they are x and y.

use crate::math::{Product, Real, Scale, Vec3};

/// The angle of a vector about an axis, as a share of a turn.
pub(super) fn angle_about<R: Real>(axis: Vec3<R>, vector: Vec3<R>) -> R {
    let (first, second) = axis.around();
    R::turn(second.dot(vector), first.dot(vector))
}

/// Longitude and latitude of a vector.
pub(crate) fn globe<R: Real>(vector: Vec3<R>) -> [R; 2] {
    let Vec3 { x, y, z } = vector;
    let across = (x.times(x) + z.times(z)).sqrt();
    // From straight down to straight up is half a turn.
    let latitude = R::turn(across, -y);
    [R::turn(-z, x), latitude + latitude]
}

/// Lengths along a plane of this unit normal, in the scene's units.
pub(super) fn flat<R: Real>(normal: Vec3<R>, point: Vec3<R>, scale: Scale) -> [R; 2] {
    let (first, second) = normal.around();
    [first.dot(point), second.dot(point)].map(|length| scale.unscaled(length))
}

/// Place in the square around a disc.
pub(super) fn disc<R: Real>(normal: Vec3<R>, from_center: Vec3<R>, radius: R) -> [R; 2] {
    let (first, second) = normal.around();
    [first.dot(from_center), second.dot(from_center)].map(|length| share(length, radius))
}

/// From 0 at `-reach` to 1 at `reach`.
pub(super) fn share<R: Real>(length: R, reach: R) -> R {
    (length / reach + R::ONE) * R::from_fraction(1 << 15)
}
