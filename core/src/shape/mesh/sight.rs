//! Whether a ray meets a triangle of a mesh, so that none slips through where triangles join (after Woop, Benthin and Wald,
//! "Watertight Ray/Triangle Intersection", Journal of Computer Graphics Techniques 2013).
//!
//! # Why none slips through
//! A ray sees each corner at two coordinates across its direction. However they are rounded, they depend on the ray and the
//! corner alone: in what the ray sees, triangles that share corners still join without a gap, and it is at (0, 0).
//!
//! On which side of an edge that is, the difference of two products tells. A larger product is never rounded to a smaller
//! number, so the sign of the difference is right or the difference is 0; and the triangle on the other side of the edge gets
//! the same number with the opposite sign. As 0 is inside for both, one of the two is met, or both.
//!
//! Where a triangle is small and far from the ray, all three differences may be rounded to 0. So (0, 0) must also lie in the
//! rectangle around the corners as they are seen, which comparisons tell without rounding.
//!
//! The paper shears space along the ray's largest coordinate, and decides with twice the digits where a difference is 0. Here
//! vectors across the ray take the place of the shear, which cost two products more for a corner and no division and no
//! exchange of coordinates; and there is nothing to decide, as it does no harm if both triangles of an edge are met.
//!
//! # What is no hit
//! A triangle may be so thin beside its distance that all three differences are nothing but rounding: they
//! have the same sign by chance, and their shares put the hit anywhere between the depths of the corners. So
//! the place of a hit must lie in the triangle's own box, with the room that hierarchies have around boxes.
//! What is met in earnest is off by a small part of that.
//!
//! # In fixed point
//! Corners lie within 8 units and rays begin within 59, so coordinates across a ray stay below 116, and the difference of two
//! of their products below 2 · 116² units, which 64 bits hold exactly: signs are always right.

use crate::math::{Product, Ray, Real, Vec3};
use crate::shape::bounds_of;

/// A ray, prepared to look at corners.
pub(super) struct Sight<R> {
    origin: Vec3<R>,
    direction: Vec3<R>,
    /// Two vectors across the direction, of a length from 0.57 to 1.
    across: [Vec3<R>; 2],
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Meeting<R> {
    /// Distance from the ray's origin.
    pub(super) t: R,
    /// The weight of the second corner.
    pub(super) b: R,
    /// The weight of the third.
    pub(super) c: R,
}

impl<R: Real> Sight<R> {
    #[inline(always)]
    pub(super) fn new(ray: &Ray<R>) -> Self {
        let Ray { origin, direction: d } = *ray;
        let (x, y, z) = (d.x.abs(), d.y.abs(), d.z.abs());
        let zero = R::ZERO;
        // Each has the largest coordinate in it, so that none is short.
        let across = if x >= y && x >= z {
            [Vec3::new(-d.y, d.x, zero), Vec3::new(-d.z, zero, d.x)]
        } else if y >= z {
            [Vec3::new(d.y, -d.x, zero), Vec3::new(zero, -d.z, d.y)]
        } else {
            [Vec3::new(d.z, zero, -d.x), Vec3::new(zero, d.z, -d.y)]
        };
        Self { origin, direction: d, across }
    }

    /// Whether the place at this distance lies in the box around a triangle, but for its rounding.
    fn is_beside(&self, corners: [Vec3<R>; 3], t: R) -> bool {
        let place = self.origin + self.direction * t;
        let room = R::offset(self.origin.magnitude().larger(place.magnitude()));
        bounds_of(corners.into_iter()).is_some_and(|bounds| bounds.padded(room).contains(place))
    }

    /// Where the whole line of the ray meets a triangle. One that is seen edge-on is not met.
    #[inline(always)]
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
        // Between the depths of the corners, however thin the triangle is.
        let [at_a, at_b, at_c] = seen.map(|corner| corner.dot(self.direction));
        let t = at_a + (at_b - at_a) * b + (at_c - at_a) * c;
        self.is_beside(corners, t).then_some(Meeting { t, b, c })
    }
}
