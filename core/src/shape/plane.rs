//! An infinite plane; as a solid, the half of space behind it.

use super::tessellate::{Directions, Ring};
use super::{Facet, Form, Geometry, Intersect, Silhouette, Spans, Tessellation, project_onto_plane, uv};
use crate::arena::Arena;
use crate::fault::{Fault, check_direction, check_point};
use crate::math::{Aabb, Extent, FOUR_AT_ONCE, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// An infinite plane. As a solid, it is the half of space behind the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Plane {
    /// Any point of the plane.
    pub point: Vec3,
    /// Points to the front; any length but 0.
    pub normal: Vec3,
}

impl Plane {
    /// The plane through `point` with this `normal`.
    pub const fn new(point: Vec3, normal: Vec3) -> Self {
        Self { point, normal }
    }
}

impl Geometry for Plane {
    type Prepared<'m, R: Real> = PreparedPlane<R>;

    fn is_solid(&self) -> bool {
        true
    }

    fn extent(&self) -> Extent {
        let normal = check_direction::<f32>(self.normal).unwrap_or(Vec3::ZERO);
        Extent::plane(normal.dot(self.point).abs())
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, _: &mut Arena<'m>) -> Result<PreparedPlane<R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.point)?;
        let normal = check_direction(self.normal)?;
        Ok(PreparedPlane::new(normal, normal.dot(self.point.to()), scale))
    }
}

/// A [`Plane`], prepared: all points p with `normal · p = distance`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedPlane<R> {
    pub(super) normal: Vec3<R>,
    pub(super) distance: R,
}

impl<R: Real> PreparedPlane<R> {
    /// The plane with this unit normal and this distance from the origin, in the scene's units.
    pub(super) fn new(normal: Vec3<R::Setup>, distance: R::Setup, scale: Scale) -> Self {
        Self { normal: Vec3::from_setup(normal), distance: scale.length(distance) }
    }

    /// The distance at which a ray meets the plane.
    #[inline]
    pub(super) fn meet(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let height = self.distance - self.normal.dot_sparse(ray.origin);
        let slope = self.normal.dot_sparse(ray.direction);
        // A ray that does not go toward the plane misses it, and its slope may be 0.
        let toward = (height > R::ZERO && slope > R::ZERO) || (height < R::ZERO && slope < R::ZERO);
        if !toward {
            return None;
        }
        let t = height / slope;
        range.contains(t).then_some(t)
    }

    /// The distance at which a ray meets the part of the plane whose points are `inside`. The function
    /// `inside` should be cheap, since it may be called for rays that miss the plane.
    ///
    /// Processors that compute four numbers at once ([`FOUR_AT_ONCE`]) evaluate all conditions: the tested
    /// shapes lie near the ray, so that branch prediction often fails. Others stop at the first condition
    /// that is not met.
    // Forced: see `intersect` in `shape_set!` (1.12 times the instructions).
    #[inline(always)]
    pub(super) fn meet_where(
        &self,
        ray: &Ray<R>,
        range: Interval<R>,
        inside: impl FnOnce(Vec3<R>) -> bool,
    ) -> Option<R> {
        if FOUR_AT_ONCE && !R::IS_FIXED_POINT {
            // Positive and finite only for a ray that goes toward the plane.
            let t = (self.distance - self.normal.dot(ray.origin)) / self.normal.dot(ray.direction);
            let met = (t > R::ZERO) & (t > range.min) & (t < range.max) & inside(ray.at(t));
            return met.then_some(t);
        }
        let t = self.meet(ray, range)?;
        inside(ray.at(t)).then_some(t)
    }

    /// The point of the plane where a ray meets it.
    #[inline(always)]
    fn point_at(&self, ray: &Ray<R>, t: R) -> Vec3<R> {
        let Vec3 { x, y, z } = self.normal;
        let is_zero = [x, y, z].map(|coordinate| coordinate == R::ZERO);
        if !(R::IS_FIXED_POINT
            && matches!(is_zero, [false, true, true] | [true, false, true] | [true, true, false]))
        {
            return project_onto_plane(ray.at(t), self.normal, self.distance);
        }
        // Across an axis one coordinate is that of the plane: the same bits in 0.96 of the instructions on an
        // M0.
        let coordinate = |unit: R, from, along| match unit == R::ZERO {
            true => from + along * t,
            false if unit > R::ZERO => self.distance,
            false => -self.distance,
        };
        let Ray { origin, direction } = ray;
        Vec3::new(
            coordinate(x, origin.x, direction.x),
            coordinate(y, origin.y, direction.y),
            coordinate(z, origin.z, direction.z),
        )
    }
}

impl<R: Real> Intersect<R> for PreparedPlane<R> {
    #[inline]
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let t = self.meet(ray, range)?;
        // The next ray begins there.
        ray.at(t).is_in_reach().then_some(t)
    }

    fn form(&self) -> Form<R> {
        Form::Flat { normal: self.normal, distance: self.distance }
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        None
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        let farthest = R::FARTHEST;
        let height = self.distance - self.normal.dot(ray.origin);
        let slope = self.normal.dot(ray.direction);
        if slope == R::ZERO {
            return if height > R::ZERO { Spans::one(-farthest, farthest) } else { Spans::NONE };
        }
        let t = height / slope;
        // A hit too far away is no hit: the span ends at infinity instead.
        let t = if t.abs() < farthest && ray.at(t).is_in_reach() {
            t
        } else if t > R::ZERO {
            farthest
        } else {
            -farthest
        };
        if slope > R::ZERO { Spans::one(-farthest, t) } else { Spans::one(t, farthest) }
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let point = self.point_at(ray, t);
        let magnitude = point.magnitude().larger(self.distance.abs());
        Surface { point, normal: self.normal, shading_normal: self.normal, magnitude, part: 0 }
    }

    fn uv(&self, surface: &Surface<R>, scale: Scale) -> [R; 2] {
        uv::flat(self.normal, surface.point, scale)
    }
}

/// The least radius of the rings around the foot of the eye, and the largest, in heights of the eye.
const RINGS: (f32, u16) = (0.5, 4096);

impl<R: Real> Silhouette<R> for PreparedPlane<R> {
    /// Rings around the point below the eye, each four times as wide as the one before. They end where the
    /// horizon is less than a pixel away, at 4096 heights of the eye; in fixed point at 127 heights, or where
    /// no ray meets the plane any more.
    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let center = project_onto_plane(tessellation.eye, self.normal, self.distance);
        let height = (self.normal.dot(tessellation.eye) - self.distance).abs();
        if !(height > R::offset(tessellation.eye.magnitude())) {
            return;
        }
        let (four, (least, most)) = (R::from_u16(4), RINGS);
        // No ray meets the plane beyond. Compare quotients: products may be out of range.
        let end = R::FARTHEST - center.magnitude();
        let heights = R::from_u16(most);
        let end = if end / heights > height { height * heights } else { end };
        let (first, second) = self.normal.around();
        let directions = Directions::new(tessellation.sides());
        let (mut inner, mut outer) = (R::ZERO, height * R::from_f32(least));
        while inner < end {
            outer = if end / four < outer { end } else { outer };
            let (axes, radii) = ([first, second, self.normal], [outer, inner]);
            Ring { center, axes, radii, is_closed: false }.each_facet(&directions, false, visit);
            (inner, outer) = (outer, outer * four);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;

    const FLOOR: Plane = Plane::new(Vec3::new(7.0, -1.0, 3.0), Vec3::new(0.0, 5.0, 0.0));

    #[test]
    fn met_from_both_sides() {
        assert_meets(FLOOR, Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, -1.0, 0.0), 3.0, [0.0, 1.0, 0.0]);
        assert_meets(FLOOR, Vec3::new(0.0, -4.0, 0.0), Vec3::new(0.0, 1.0, 0.0), 3.0, [0.0, 1.0, 0.0]);
        let slant = Vec3::new(3.0, -4.0, 0.0);
        assert_meets(FLOOR, Vec3::new(0.0, 3.0, 0.0), slant, 5.0, [0.0, 1.0, 0.0]);
    }

    #[test]
    fn missed_behind_and_along() {
        assert_misses(FLOOR, Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
        assert_misses(FLOOR, Vec3::new(0.0, 2.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
        assert_misses(FLOOR, Vec3::new(0.0, -1.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
    }

    #[test]
    fn its_inside_is_what_lies_behind() {
        let (down, up) = (Vec3::new(0.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
        let along = Vec3::new(1.0, 0.0, 0.0);
        let endless = f64::INFINITY;
        assert_spans(FLOOR, Vec3::new(0.0, 2.0, 0.0), down, &[(3.0, endless)]);
        assert_spans(FLOOR, Vec3::new(0.0, -4.0, 0.0), down, &[(-3.0, endless)]);
        assert_spans(FLOOR, Vec3::new(0.0, 2.0, 0.0), up, &[(-endless, -3.0)]);
        assert_spans(FLOOR, Vec3::new(0.0, 2.0, 0.0), along, &[]);
        assert_spans(FLOOR, Vec3::new(0.0, -2.0, 0.0), along, &[(-endless, endless)]);
        for extent in EXTENTS {
            let point = Vec3::new(0.3, -0.7, 0.2) * extent;
            assert_spans_are_met(Plane::new(point, Vec3::new(0.3, 0.9, -0.2)), point, extent, 2_000);
        }
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            let point = Vec3::new(0.3, -0.7, 0.2) * extent;
            assert_no_self_hits(Plane::new(point, Vec3::new(0.3, 0.9, -0.2)), point, extent, 20_000);
        }
    }

    #[test]
    fn bad_planes_are_refused() {
        assert_eq!(refusal(Plane { normal: Vec3::ZERO, ..FLOOR }), Fault::ZeroLength);
        assert_eq!(refusal(Plane { normal: Vec3::new(0.0, f32::NAN, 1.0), ..FLOOR }), Fault::NotFinite);
        assert_eq!(refusal(Plane { point: Vec3::new(0.0, -3e6, 1.0), ..FLOOR }), Fault::TooFar);
    }

    #[test]
    fn coordinates_are_lengths_in_units_of_the_scene() {
        let down = Vec3::new(0.0, -1.0, 0.0);
        let floor = Plane::new(Vec3::new(0.0, 1.0, 0.0), -down);
        assert_uv(floor, Vec3::new(3.0, 5.0, 7.0), down, [3.0, -7.0]);
        let wall = Plane::new(Vec3::ZERO, Vec3::new(0.0, 0.0, 4.0));
        assert_uv(wall, Vec3::new(3.0, -5.0, 7.0), Vec3::new(0.0, 0.0, -1.0), [3.0, -5.0]);
        let side = Plane::new(Vec3::ZERO, Vec3::new(-1.0, 0.0, 0.0));
        assert_uv(side, Vec3::new(-9.0, 2.0, 3.0), Vec3::new(1.0, 0.0, 0.0), [2.0, -3.0]);
    }

    #[test]
    fn a_tiny_normal_is_a_direction() {
        let floor = Plane::new(Vec3::ZERO, Vec3::new(0.0, 1e-30, 0.0));
        assert_meets(floor, Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, -1.0, 0.0), 2.0, [0.0, 1.0, 0.0]);
    }
}
