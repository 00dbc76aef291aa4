//! The test of a box: whether the piece of a ray that still matters comes through it.
//!
//! The ray lies between the two planes of a slab from `near / d` to `far / d` (Kay and Kajiya, "Ray Tracing Complex
//! Scenes", SIGGRAPH 1986), and the box is met if all three of these ranges overlap. Here both sides of each comparison are
//! multiplied by the divisors, which is the test by separating axes (Gottschalk, Lin and Manocha, "OBBTree", SIGGRAPH
//! 1996) of a segment and a box: no division, no infinity where a direction has a coordinate of 0 (Williams et al., "An
//! Efficient and Robust Ray-Box Intersection Algorithm", JGT 2005), so that it holds in fixed point, and what lies
//! behind the ray or beyond its end costs no multiplication.
//!
//! # No hit is lost
//! A hit is a point of the ray, off by its rounding, in the box that the shape gave. For that and for the rounding of the
//! test itself all boxes are inflated (Ize, "Robust BVH Ray Traversal", JCGT 2013) by [`Real::offset`] of their own
//! coordinates when they are built, and by that of the ray's origin when they are tested. In `f32` that is 168 half
//! units in the last place of both. No coordinate of the way between them is larger than their sum, and the test makes five
//! roundings of it, all relative to the coordinates of the direction by which the inflation is multiplied as well. In fixed point
//! its products are exact.

use super::Node;
use crate::math::{Product, Ray, Real, Vec3};

/// The piece of a ray from its origin to the farthest hit that matters.
pub(super) struct Segment<R> {
    origin: Vec3<R>,
    direction: Vec3<R>,
    /// The absolute values of the direction's coordinates.
    slope: Vec3<R>,
    /// By how much boxes are inflated.
    margin: R,
    max: R,
    /// The box around the segment, seen from the origin.
    lower: Vec3<R>,
    upper: Vec3<R>,
}

impl<R: Real> Segment<R> {
    #[inline(always)]
    pub(super) fn new(ray: &Ray<R>, max: R) -> Self {
        let Ray { origin, direction } = *ray;
        let slope = Vec3::new(direction.x.abs(), direction.y.abs(), direction.z.abs());
        let margin = R::offset(origin.magnitude());
        let mut segment =
            Self { origin, direction, slope, margin, max, lower: Vec3::ZERO, upper: Vec3::ZERO };
        segment.stretch();
        segment
    }

    /// Ends it at a distance.
    #[inline(always)]
    pub(super) fn end_at(&mut self, max: R) {
        if max != self.max {
            self.max = max;
            self.stretch();
        }
    }

    #[inline(always)]
    fn stretch(&mut self) {
        let end = self.direction * self.max;
        let lower = |end: R| if end < R::ZERO { end } else { R::ZERO };
        self.lower = Vec3::new(lower(end.x), lower(end.y), lower(end.z));
        self.upper = Vec3::new(end.x.larger(R::ZERO), end.y.larger(R::ZERO), end.z.larger(R::ZERO));
    }

    /// Whether it may meet anything in a node's box.
    #[inline(always)]
    pub(super) fn meets(&self, node: &Node<R>) -> bool {
        let Self { direction: d, slope, margin, lower, upper, .. } = *self;
        let to = node.center - self.origin;
        let reach = node.reach + Vec3::new(margin, margin, margin);
        if to.x + reach.x < lower.x
            || to.x - reach.x > upper.x
            || to.y + reach.y < lower.y
            || to.y - reach.y > upper.y
            || to.z + reach.z < lower.z
            || to.z - reach.z > upper.z
        {
            return false;
        }
        // Along each axis: the distance of the line from the center, and how far the box reaches.
        let passes =
            |distance: R::Product, reach: R::Product| distance > reach || R::Product::ZERO - distance > reach;
        !(passes(to.y.times(d.z) - to.z.times(d.y), reach.y.times(slope.z) + reach.z.times(slope.y))
            || passes(to.z.times(d.x) - to.x.times(d.z), reach.z.times(slope.x) + reach.x.times(slope.z))
            || passes(to.x.times(d.y) - to.y.times(d.x), reach.x.times(slope.y) + reach.y.times(slope.x)))
    }
}
