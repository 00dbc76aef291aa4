//! The test of boxes in floating point: a ray lies in a box where it lies between the two planes of each axis (Kay and
//! Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986).
//!
//! # No hit is lost
//! A hit is a point of the ray, off by its rounding, in the box that the shape gave. For that and for the rounding of the
//! test itself all boxes are inflated (Ize, "Robust BVH Ray Traversal", JCGT 2013) by [`Real::offset`] of their own
//! coordinates when they are built, and by that of the ray's origin when they are tested. In `f32` that is 168 half
//! units in the last place of both; the distance of a plane is the difference of the two, rounded four times.
//!
//! A direction without a coordinate has the smallest that has a reciprocal, which moves no point of the scene: no infinity
//! meets a zero, and nothing depends on what became of it (Williams et al., "An Efficient and Robust Ray-Box Intersection
//! Algorithm", JGT 2005).

use super::{BoxTest, Node, RayTest, WIDTH};
use crate::math::{Ray, Real, Vec3};

/// Whether the processor computes four numbers at once.
const FOUR_AT_ONCE: bool = cfg!(any(target_feature = "sse2", target_feature = "neon"));

/// A ray between two distances, prepared to be tested.
pub(super) struct Slabs<R> {
    /// What lower planes are seen from: the origin, moved by how much boxes are inflated.
    above: Vec3<R>,
    /// What upper planes are seen from.
    below: Vec3<R>,
    /// Distance for each unit of a coordinate.
    per_unit: Vec3<R>,
    max: R,
}

impl<R: Real> Slabs<R> {
    #[inline(always)]
    pub(super) fn new(ray: &Ray<R>, max: R) -> Self {
        let Ray { origin, direction: d } = *ray;
        let margin = R::offset(origin.magnitude());
        let margin = Vec3::new(margin, margin, margin);
        let tiniest = R::FARTHEST.recip();
        let per_unit = |d: R| (if d.abs() < tiniest { tiniest } else { d }).recip();
        Self {
            above: origin + margin,
            below: origin - margin,
            per_unit: Vec3::new(per_unit(d.x), per_unit(d.y), per_unit(d.z)),
            max,
        }
    }
}

impl<R: Real> BoxTest<R> for Slabs<R> {
    #[inline(always)]
    fn meet(&self, node: &Node<R>) -> u32 {
        self.meet_at(node).0
    }
}

impl<R: Real> RayTest<R> for Slabs<R> {
    #[inline(always)]
    fn meet_at(&self, node: &Node<R>) -> (u32, [R; WIDTH]) {
        let Self { above, below, per_unit, max } = *self;
        let [lower_x, lower_y, lower_z] = node.lower;
        let [upper_x, upper_y, upper_z] = node.upper;
        let between = |lower: [R; WIDTH], upper: [R; WIDTH], above: R, below: R, per_unit: R| {
            let one = lower.map(|plane| (plane - above) * per_unit);
            let other = upper.map(|plane| (plane - below) * per_unit);
            // The direction tells which of the two planes is nearer. To compare them is less where four are compared at once.
            if FOUR_AT_ONCE {
                (both(one, other, smaller), both(one, other, R::larger))
            } else if per_unit > R::ZERO {
                (one, other)
            } else {
                (other, one)
            }
        };
        let (near_x, far_x) = between(lower_x, upper_x, above.x, below.x, per_unit.x);
        let (near_y, far_y) = between(lower_y, upper_y, above.y, below.y, per_unit.y);
        let (near_z, far_z) = between(lower_z, upper_z, above.z, below.z, per_unit.z);
        let near =
            both(both(both([R::ZERO; WIDTH], near_x, R::larger), near_y, R::larger), near_z, R::larger);
        let far = both(both(both([max; WIDTH], far_x, smaller), far_y, smaller), far_z, smaller);
        (met(near, far), near)
    }

    #[inline(always)]
    fn end_at(&mut self, max: R) {
        self.max = max;
    }

    #[inline(always)]
    fn reaches(&self, key: R) -> bool {
        key <= self.max
    }
}

/// Which boxes there is a way through, a bit for each, from where it begins and ends in them.
#[inline(always)]
pub(super) fn met<R: Real>(near: [R; WIDTH], far: [R; WIDTH]) -> u32 {
    R::no_larger(near, far)
}

/// A function of both, for each of four boxes.
#[inline(always)]
pub(super) fn both<A, B>(a: [A; WIDTH], b: [A; WIDTH], f: impl Fn(A, A) -> B) -> [B; WIDTH] {
    let ([a0, a1, a2, a3], [b0, b1, b2, b3]) = (a, b);
    [f(a0, b0), f(a1, b1), f(a2, b2), f(a3, b3)]
}

#[inline(always)]
pub(super) fn smaller<R: Real>(a: R, b: R) -> R {
    if a < b { a } else { b }
}
