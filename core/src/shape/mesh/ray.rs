//! The test of a ray against a triangle of a mesh. No ray slips through where triangles join (after Woop,
//! Benthin and Wald, "Watertight Ray/Triangle Intersection", Journal of Computer Graphics Techniques 2013).
//!
//! # Why no ray slips through
//! The corners of triangles are projected along the ray, which lies at (0, 0). The two projected coordinates
//! of a corner depend on the ray and on that corner alone, however they are rounded. So in the projection,
//! triangles that share corners join without a gap.
//!
//! The side of an edge on which (0, 0) lies is the sign of a difference of two products. A larger product is
//! never rounded to a smaller number, so the sign is right or the difference is 0. The triangle on the other
//! side of the edge computes the same number with the opposite sign. As 0 counts as inside for both, the ray
//! meets one of the two, or both.
//!
//! If a triangle is small and far from the ray, all three differences may be rounded to 0. So (0, 0) must
//! also lie in the rectangle around the projected corners, which comparisons decide without rounding.
//!
//! The paper shears space along the ray's largest coordinate, and decides with twice the digits if a
//! difference is 0. Here, the corners are multiplied by two vectors across the ray instead. This takes two
//! more products for a corner, but no division and no exchange of coordinates; and no decision is needed,
//! since it does no harm if both triangles of an edge are met.
//!
//! # Hits that are only rounding
//! A triangle may be so thin, compared with its distance, that all three differences are only rounding. They
//! may have the same sign by chance, and would then put the hit anywhere between the depths of the corners.
//! So the place of a hit must lie in the triangle's own box, padded as the boxes of hierarchies are. The
//! error of real hits is a small part of that padding.
//!
//! # In fixed point
//! Corners lie within 8 units and rays begin within 59, so projected coordinates stay below 116, and the
//! difference of two of their products below 2 · 116² units. 64 bits hold these exactly, so signs are always
//! right.

use crate::math::{Product, Ray, Real, Vec3};
use crate::shape::bounds_of;

/// A ray, prepared for tests of triangles.
pub(super) struct MeshRay<R> {
    origin: Vec3<R>,
    direction: Vec3<R>,
    /// Two vectors at right angles to the direction, with lengths from 0.57 to 1.
    across: [Vec3<R>; 2],
}

/// A hit of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Meeting<R> {
    /// Distance from the ray's origin.
    pub(super) t: R,
    /// The weight of the second corner.
    pub(super) b: R,
    /// The weight of the third corner.
    pub(super) c: R,
}

impl<R: Real> MeshRay<R> {
    #[inline]
    pub(super) fn new(ray: &Ray<R>) -> Self {
        let Ray { origin, direction: d } = *ray;
        let (x, y, z) = (d.x.abs(), d.y.abs(), d.z.abs());
        let zero = R::ZERO;
        // Both contain the largest coordinate of the direction, so that neither is short.
        let across = if x >= y && x >= z {
            [Vec3::new(-d.y, d.x, zero), Vec3::new(-d.z, zero, d.x)]
        } else if y >= z {
            [Vec3::new(d.y, -d.x, zero), Vec3::new(zero, -d.z, d.y)]
        } else {
            [Vec3::new(d.z, zero, -d.x), Vec3::new(zero, d.z, -d.y)]
        };
        Self { origin, direction: d, across }
    }

    /// Whether the place at this distance lies in the box around a triangle, padded by its rounding.
    fn is_beside(&self, corners: [Vec3<R>; 3], t: R) -> bool {
        let place = self.origin + self.direction * t;
        let room = R::offset(self.origin.magnitude().larger(place.magnitude()));
        bounds_of(corners.into_iter()).is_some_and(|bounds| bounds.padded(room).contains(place))
    }

    /// The hit of the ray's whole line, if it meets a triangle. A triangle that is seen edge-on is not met.
    #[inline]
    pub(super) fn meet(&self, corners: [Vec3<R>; 3]) -> Option<Meeting<R>> {
        let seen = corners.map(|corner| corner - self.origin);
        let [u, v] = self.across;
        let [a, b, c] = seen.map(|corner| (corner.dot(u), corner.dot(v)));
        let side = |p: (R, R), q: (R, R)| p.0.times(q.1) - p.1.times(q.0);
        let (at_a, at_b, at_c) = (side(b, c), side(c, a), side(a, b));
        let zero = R::Product::ZERO;
        let from_front = at_a >= zero && at_b >= zero && at_c >= zero;
        let from_behind = at_a <= zero && at_b <= zero && at_c <= zero;
        if !from_front && !from_behind {
            return None;
        }
        let holds_ray = |p: R, q: R, r: R| {
            let zero = R::ZERO;
            !(p > zero && q > zero && r > zero || p < zero && q < zero && r < zero)
        };
        if !(holds_ray(a.0, b.0, c.0) && holds_ray(a.1, b.1, c.1)) {
            return None;
        }
        let whole = at_a + at_b + at_c;
        if whole == zero {
            return None;
        }
        let (b, c) = (at_b.share(whole), at_c.share(whole));
        // Interpolate the depths of the corners: the result lies between them, however thin the triangle is.
        let [at_a, at_b, at_c] = seen.map(|corner| corner.dot(self.direction));
        let t = at_a + (at_b - at_a) * b + (at_c - at_a) * c;
        self.is_beside(corners, t).then_some(Meeting { t, b, c })
    }
}
