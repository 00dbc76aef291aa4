//! The test of boxes against a ray in fixed point: whether the ray meets a box before its end.
//!
//! The ray lies between the two planes of an axis from the distance `near / d` to `far / d`, and it meets the
//! box if all three of these ranges overlap (see [`slabs`](super::slabs)). Here both sides of each comparison
//! are multiplied by the divisors. So there is no reciprocal, which might be out of range, and boxes behind
//! the ray or beyond its end take no multiplication. The products are exact, and boxes are inflated as in
//! floating point.

use super::{Axis, BoxTest, Node, RayTest};
use crate::math::{Ray, Real, Vec3};

/// The part of a ray from its origin to its end, mirrored so that it runs upward along all axes.
pub(super) struct Segment<R> {
    origin: Vec3<R>,
    direction: Vec3<R>,
    /// The absolute coordinates of the direction.
    slope: Vec3<R>,
    /// The axis with the largest absolute coordinate of the direction.
    steepest: Axis,
    /// The distance by which boxes are inflated.
    margin: R,
    /// The end of the ray, relative to the origin.
    end: Vec3<R>,
}

impl<R: Real> Segment<R> {
    #[inline]
    pub(super) fn new(ray: &Ray<R>, max: R) -> Self {
        Self::inflated(ray, max, R::offset(ray.origin.magnitude()))
    }

    /// [`new`](Self::new), with this margin for boxes.
    #[inline]
    pub(super) fn inflated(ray: &Ray<R>, max: R, margin: R) -> Self {
        let Ray { origin, direction } = *ray;
        let slope = Vec3::new(direction.x.abs(), direction.y.abs(), direction.z.abs());
        let steepest = if slope.x >= slope.y && slope.x >= slope.z {
            Axis::X
        } else if slope.y >= slope.z {
            Axis::Y
        } else {
            Axis::Z
        };
        Self { origin, direction, slope, steepest, margin, end: slope * max }
    }

    /// The coordinates at which a box begins and ends along an axis, relative to the origin, in the direction
    /// of the ray.
    #[inline]
    fn along(&self, axis: Axis, lower: R, upper: R) -> (R, R) {
        let (origin, margin) = (axis.of(self.origin), self.margin);
        if axis.of(self.direction) < R::ZERO {
            (origin - upper - margin, origin - lower + margin)
        } else {
            (lower - origin - margin, upper - origin + margin)
        }
    }

    /// The coordinate along the steepest axis at which a box begins, if the ray meets the box.
    fn enters(&self, [lower, upper]: [Vec3<R>; 2]) -> Option<R> {
        let Self { slope, steepest, end, .. } = self;
        let (near_x, far_x) = self.along(Axis::X, lower.x, upper.x);
        let (near_y, far_y) = self.along(Axis::Y, lower.y, upper.y);
        let (near_z, far_z) = self.along(Axis::Z, lower.z, upper.z);
        let behind = far_x < R::ZERO || far_y < R::ZERO || far_z < R::ZERO;
        if behind || near_x > end.x || near_y > end.y || near_z > end.z {
            return None;
        }
        // Whether the ray leaves one pair of planes before it enters another.
        let apart = |far: R, slope: R, other_near: R, other_slope: R| {
            far.times(other_slope) < other_near.times(slope)
        };
        let misses = apart(far_x, slope.x, near_y, slope.y)
            || apart(far_y, slope.y, near_x, slope.x)
            || apart(far_y, slope.y, near_z, slope.z)
            || apart(far_z, slope.z, near_y, slope.y)
            || apart(far_z, slope.z, near_x, slope.x)
            || apart(far_x, slope.x, near_z, slope.z);
        (!misses).then(|| steepest.of(Vec3::new(near_x, near_y, near_z)))
    }
}

impl<R: Real, const W: usize> BoxTest<R, W> for Segment<R> {
    #[inline]
    fn any_met(&self, node: &Node<R, W>, mut visit: impl FnMut(usize) -> bool) -> bool {
        (0..W).any(|slot| self.enters(node.corners(slot)).is_some() && visit(slot))
    }
}

impl<R: Real, const W: usize> RayTest<R, W> for Segment<R> {
    #[inline]
    fn each_met(&self, node: &Node<R, W>, mut visit: impl FnMut(usize, R)) {
        for slot in 0..W {
            if let Some(key) = self.enters(node.corners(slot)) {
                visit(slot, key);
            }
        }
    }

    #[inline]
    fn end_at(&mut self, max: R) {
        self.end = self.slope * max;
    }

    #[inline]
    fn reaches(&self, key: R) -> bool {
        key <= self.steepest.of(self.end)
    }
}
