//! Coordinates u and v of places on surfaces: the common parts of the shapes' mappings (Glassner (ed.), "An
//! Introduction to Ray Tracing", 1989, ch. 2).
//!
//! | shape | u | v |
//! |---|---|---|
//! | sphere, ellipsoid, quadric, implicit | longitude, from x toward -z: 0 to 1 | latitude: 0 to 1 |
//! | cylinder, cone: side | angle about the axis: 0 to 1 | height, from base to top: 0 to 1 |
//! | disc, lids | across the square around it: 0 to 1 | up in that square: 0 to 1 |
//! | torus | angle about the axis: 0 to 1 | angle about the tube, from outside along the axis: 0 to 1 |
//! | rectangle | along `right`: 0 to 1 | along `up`: 0 to 1 |
//! | box | across the face: 0 to 1 | up the face: 0 to 1 |
//! | triangle, mesh without `uvs` | weight of the second corner | weight of the third corner |
//! | plane, polygon, polyhedron | length along the plane | length along the plane, at a right angle to u |
//! | instances | u of the model | v of the model |
//! As seen from the front, u grows to the right and v upward. The direction of u, and the direction in which
//! angles are 0, is that of the x axis, projected across the normal or axis; if the normal or axis itself is
//! along x, that of the y axis. So on a floor u is x and v is -z, and on a wall that faces z they are x and
//! y.

use crate::math::{Product, Real, Scale, Vec3};

/// The angle of a vector about an axis, in turns: 0 to 1.
pub(super) fn angle_about<R: Real>(axis: Vec3<R>, vector: Vec3<R>) -> R {
    let (first, second) = axis.around();
    R::turn(second.dot(vector), first.dot(vector))
}

/// Longitude and latitude of a vector, both from 0 to 1.
pub(crate) fn globe<R: Real>(vector: Vec3<R>) -> [R; 2] {
    let Vec3 { x, y, z } = vector;
    let across = (x.times(x) + z.times(z)).sqrt();
    // The angle from straight down to straight up is half a turn: double it.
    let latitude = R::turn(across, -y);
    [R::turn(-z, x), latitude + latitude]
}

/// Lengths along a plane with this unit normal, in the scene's units.
pub(super) fn flat<R: Real>(normal: Vec3<R>, point: Vec3<R>, scale: Scale) -> [R; 2] {
    let (first, second) = normal.around();
    [first.dot(point), second.dot(point)].map(|length| scale.unscaled(length))
}

/// The place in the square around a disc.
pub(super) fn disc<R: Real>(normal: Vec3<R>, from_center: Vec3<R>, radius: R) -> [R; 2] {
    let (first, second) = normal.around();
    [first.dot(from_center), second.dot(from_center)].map(|length| share(length, radius))
}

/// The place of `length` between `-reach` (0) and `reach` (1).
pub(super) fn share<R: Real>(length: R, reach: R) -> R {
    (length / reach + R::ONE) * R::from_fraction(1 << 15)
}
