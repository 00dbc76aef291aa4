//! The test of boxes against a ray in floating point: a ray is inside a box where it lies between the two
//! planes of each axis (Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986).
//!
//! # No hit is lost
//! A hit is a point of the ray in the bounds of the shape, except for rounding. Because of this and of the
//! rounding of the test itself, all boxes are inflated (Ize, "Robust BVH Ray Traversal", JCGT 2013): by
//! [`Real::offset`] of their own coordinates when they are built, and by that of the ray's origin when they
//! are tested. In `f32` this is 168 half units in the last place of each; the distance of a plane is the
//! difference of the two, which is rounded four times.
//!
//! A coordinate of the direction that is 0, or almost 0, is replaced by the smallest number that has a
//! reciprocal. This moves no point of the scene, and no infinity is ever multiplied by 0 (Williams et al.,
//! "An Efficient and Robust Ray-Box Intersection Algorithm", JGT 2005).
//!
//! # All at once, or one by one
//! A processor that computes four numbers at once tests all boxes of a node together. Others test one box
//! after the other, and skip the remaining axes of a box as soon as the ray misses it along one axis.

use super::{BoxTest, Node, RayTest, slots};
use crate::math::{FOUR_AT_ONCE, Ray, Real};

/// A ray up to a distance, prepared for tests of boxes.
pub(super) struct Slabs<R> {
    axes: [Along<R>; 3],
    max: R,
}

/// A ray along one axis.
struct Along<R> {
    /// The index of the nearer planes: 0 for the lower ones, 1 for the upper ones.
    nearer: usize,
    /// The origin for the nearer planes: moved by the distance by which boxes are inflated.
    near: R,
    /// The origin for the farther planes.
    far: R,
    /// The distance along the ray for each unit of the coordinate.
    per_unit: R,
}

impl<R: Real> Slabs<R> {
    #[inline]
    pub(super) fn new(ray: &Ray<R>, max: R) -> Self {
        Self::inflated(ray, max, R::offset(ray.origin.magnitude()))
    }

    /// [`new`](Self::new), for boxes that are inflated by this margin.
    #[inline]
    pub(super) fn inflated(ray: &Ray<R>, max: R, margin: R) -> Self {
        let Ray { origin, direction } = *ray;
        let tiniest = R::FARTHEST.recip();
        let along = |origin: R, d: R| {
            let per_unit = (if d.abs() < tiniest { tiniest } else { d }).recip();
            let (above, below) = (origin + margin, origin - margin);
            if per_unit > R::ZERO {
                Along { nearer: 0, near: above, far: below, per_unit }
            } else {
                Along { nearer: 1, near: below, far: above, per_unit }
            }
        };
        let axes = [along(origin.x, direction.x), along(origin.y, direction.y), along(origin.z, direction.z)];
        Self { axes, max }
    }
}

impl<R: Real> Slabs<R> {
    /// A bit for each box of a node that the ray meets, and the distances at which it enters them.
    #[inline]
    pub(super) fn meet<const W: usize>(&self, node: &Node<R, W>) -> (u32, [R; W]) {
        let (mut nears, mut fars) = ([R::ZERO; W], [self.max; W]);
        for (along, planes) in self.axes.iter().zip(&node.planes) {
            let Along { near, far, per_unit, .. } = along;
            let [near_planes, far_planes] = along.nearer_first(planes);
            nears = both(nears, near_planes.map(|plane| (plane - *near) * *per_unit), R::larger);
            fars = both(fars, far_planes.map(|plane| (plane - *far) * *per_unit), R::smaller);
        }
        // The ray meets a box if it enters the box no later than it leaves it.
        (R::no_larger(&nears, &fars), nears)
    }

    /// The distance at which the ray enters one of a node's boxes, if it meets the box: the same as that of
    /// [`meet`](Self::meet).
    // Forced, as in the rest of this test: without it, 91 balls take 1.012 times the instructions on a
    // Cortex-M4F.
    #[inline(always)]
    pub(super) fn enters<const W: usize>(&self, node: &Node<R, W>, slot: usize) -> Option<R> {
        let ([x, y, z], [along_x, along_y, along_z]) = (&self.axes, &node.planes);
        let between = |(begin, end): (R, R), (near, far): (R, R)| {
            let (begin, end) = (begin.larger(near), end.smaller(far));
            (begin <= end).then_some((begin, end))
        };
        let range = between((R::ZERO, self.max), x.crossings(along_x, slot))?;
        let (begin, end) = between(range, y.crossings(along_y, slot))?;
        // The end is not needed after the last axis.
        let (near, far) = z.crossings(along_z, slot);
        if near > end || far < begin {
            return None;
        }
        Some(begin.larger(near))
    }
}

impl<R: Real> Along<R> {
    /// The planes of all boxes, the nearer side first.
    #[inline]
    fn nearer_first<'p, const W: usize>(&self, [lower, upper]: &'p [[R; W]; 2]) -> [&'p [R; W]; 2] {
        if self.nearer & 1 == 0 { [lower, upper] } else { [upper, lower] }
    }

    /// The distances at which the ray crosses the nearer and the farther plane of a box.
    // Forced: see `enters`.
    #[inline(always)]
    fn crossings<const W: usize>(&self, planes: &[[R; W]; 2], slot: usize) -> (R, R) {
        let [near, far] =
            self.nearer_first(planes).map(|planes| planes.get(slot).copied().unwrap_or(R::ZERO));
        ((near - self.near) * self.per_unit, (far - self.far) * self.per_unit)
    }
}

impl<R: Real, const W: usize> BoxTest<R, W> for Slabs<R> {
    // Forced: see `enters`.
    #[inline(always)]
    fn any_met(&self, node: &Node<R, W>, mut visit: impl FnMut(usize) -> bool) -> bool {
        if FOUR_AT_ONCE {
            return slots::<W>(self.meet(node).0).any(visit);
        }
        (0..W).any(|slot| self.enters(node, slot).is_some() && visit(slot))
    }
}

impl<R: Real, const W: usize> RayTest<R, W> for Slabs<R> {
    // Forced: see `enters`.
    #[inline(always)]
    fn each_met(&self, node: &Node<R, W>, mut visit: impl FnMut(usize, R)) {
        if FOUR_AT_ONCE {
            let (met, keys) = self.meet(node);
            for slot in slots::<W>(met) {
                if let Some(key) = keys.get(slot) {
                    visit(slot, *key);
                }
            }
            return;
        }
        for slot in 0..W {
            if let Some(key) = self.enters(node, slot) {
                visit(slot, key);
            }
        }
    }

    #[inline]
    fn end_at(&mut self, max: R) {
        self.max = max;
    }

    #[inline]
    fn reaches(&self, key: R) -> bool {
        key <= self.max
    }
}

/// The results of `f` for each pair of elements.
#[inline]
pub(super) fn both<A: Copy, const W: usize>(a: [A; W], b: [A; W], f: impl Fn(A, A) -> A) -> [A; W] {
    let mut others = b.into_iter();
    a.map(|a| others.next().map_or(a, |b| f(a, b)))
}
