//! The place where a ray meets a shape.

use crate::math::Vec3;

/// The place where a ray meets a shape, as the shape describes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface<R> {
    /// The point, projected back onto the shape.
    pub point: Vec3<R>,
    /// The unit geometric normal: outward on a closed shape, the front of a flat one.
    pub normal: Vec3<R>,
    /// The unit normal to shade with: interpolated where vertices have normals, else the geometric one.
    pub shading_normal: Vec3<R>,
    /// The largest number that entered the computation of `point`: its rounding error is a few units in the
    /// last place of this.
    pub magnitude: R,
    /// Which part of the shape this is, where it has parts that differ in more than their place: a face, a triangle.
    pub part: u32,
}
