//! The point where a ray hits a shape.

use crate::math::Vec3;

/// The point where a ray hits a shape, as the shape describes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface<R> {
    /// The point, projected back onto the shape.
    pub point: Vec3<R>,
    /// The unit geometric normal: outward on a closed shape, the front of a flat one.
    pub normal: Vec3<R>,
    /// The unit normal to shade with: interpolated where vertices have normals, else the geometric one.
    pub shading_normal: Vec3<R>,
    /// Bounds the rounding error of `point`: rays leave it by [`Real::offset`](crate::math::Real::offset) of
    /// `magnitude`. Most often, this is the largest number in the computation of `point`.
    pub magnitude: R,
    /// The number of the part of the shape that was hit, such as a face or a triangle; 0 for a shape of one
    /// part.
    pub part: u32,
}

impl<R: PartialEq> Surface<R> {
    /// The number of the facet that was hit. The parts of a smooth surface are no facets: no edge is seen
    /// between them, and their number is 0.
    #[inline]
    pub(crate) fn facet(&self) -> u32 {
        if self.part != 0 && self.shading_normal == self.normal { self.part } else { 0 }
    }
}
