//! A disc or ring: a hit of its plane counts if its distance from the center is right (Haines in Glassner
//! (ed.), "An Introduction to Ray Tracing", 1989, ch. 2).

use super::circle::Circle;
use super::tessellate::{Directions, Ring};
use super::{
    Facet, Form, Geometry, Hull, Intersect, Luminaire, PreparedPlane, Silhouette, Tessellation, reach_across,
    uv,
};
use crate::arena::Arena;
use crate::fault::{Fault, check_coordinate, check_direction, check_point, check_radius, check_size};
use crate::math::{Aabb, Extent, Interval, Product, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// A flat disc, or a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Disc {
    /// The middle.
    pub center: Vec3,
    /// Points to the front; any length but 0.
    pub normal: Vec3,
    /// Radius, more than 0.
    pub radius: f32,
    /// Radius of the hole, 0 or more and less than `radius`.
    #[cfg_attr(feature = "serde", serde(default))]
    pub hole: f32,
}

impl Disc {
    /// The disc around `center` with this `normal` and radius.
    pub const fn new(center: Vec3, normal: Vec3, radius: f32) -> Self {
        Self { center, normal, radius, hole: 0.0 }
    }

    /// The ring around `center` with this `normal`, from the radius `hole` to `radius`.
    pub const fn ring(center: Vec3, normal: Vec3, hole: f32, radius: f32) -> Self {
        Self { center, normal, radius, hole }
    }
}

impl Geometry for Disc {
    type Prepared<'m, R: Real> = PreparedDisc<R>;

    fn luminaire(&self) -> Option<Luminaire> {
        let Self { center, normal, radius, hole } = *self;
        (hole == 0.0).then_some(Luminaire::Disc { center, normal, radius })
    }

    fn extent(&self) -> Extent {
        Extent::flat(self.center.magnitude() + self.radius)
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, _: &mut Arena<'m>) -> Result<PreparedDisc<R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.center)?;
        check_radius(self.radius)?;
        check_coordinate(self.hole)?;
        if !(self.hole >= 0.0 && self.hole < self.radius) {
            return Err(Fault::HoleTooLarge);
        }
        let normal: Vec3<R::Setup> = check_direction(self.normal)?;
        let center: Vec3<R::Setup> = self.center.to();
        let radius: R = scale.length(R::Setup::from_f32(self.radius));
        let hole: R = scale.length(R::Setup::from_f32(self.hole));
        check_size(radius - hole)?;
        Ok(PreparedDisc {
            plane: PreparedPlane::new(normal, normal.dot(center), scale),
            center: scale.point(center),
            radius,
            radius_squared: radius.times(radius),
            hole_squared: hole.times(hole),
        })
    }
}

/// A [`Disc`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedDisc<R: Real> {
    plane: PreparedPlane<R>,
    center: Vec3<R>,
    radius: R,
    radius_squared: R::Product,
    hole_squared: R::Product,
}

impl<R: Real> Intersect<R> for PreparedDisc<R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        self.plane.meet_where(ray, range, |point| {
            let distance_squared = (point - self.center).length_squared_wide();
            distance_squared < self.radius_squared && distance_squared >= self.hole_squared
        })
    }

    fn form(&self) -> Form<R> {
        self.plane.form()
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        let bounds = Aabb::around(self.center, reach_across(self.plane.normal) * self.radius);
        Some(bounds.padded(R::offset(bounds.magnitude())))
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        self.plane.surface(ray, t)
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        uv::disc(self.plane.normal, surface.point - self.center, self.radius)
    }
}

impl<R: Real> Silhouette<R> for PreparedDisc<R> {
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        let axis = self.plane.normal;
        let hole = self.hole_squared.sqrt();
        let half = (self.radius - hole) * R::from_f32(0.5);
        // One hull encloses a disc without a hole tightly; a ring needs one for each arc.
        let (circle, distance) = if hole > R::ZERO {
            (Circle { center: self.center, axis, radius: hole + half }, half)
        } else if part == 0 {
            (Circle { center: self.center, axis, radius: self.radius }, R::ZERO)
        } else {
            return None;
        };
        circle.hull(part, distance)
    }

    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let (first, second) = self.plane.normal.around();
        let (axes, radii) = ([first, second, self.plane.normal], [self.radius, self.hole_squared.sqrt()]);
        let directions = Directions::new(tessellation.sides());
        let ring = Ring { center: self.center, axes, radii, is_closed: false };
        ring.each_facet(&directions, false, visit);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;

    const UP: Vec3 = Vec3::new(0.0, 3.0, 0.0);
    const DOWN: Vec3 = Vec3::new(0.0, -1.0, 0.0);
    const PLATE: Disc = Disc::new(Vec3::new(1.0, 2.0, 3.0), UP, 2.0);

    #[test]
    fn met_within_the_radius_from_both_sides() {
        for (x, z) in [(1.0, 3.0), (2.9, 3.0), (1.0, 1.1), (2.4, 4.4)] {
            assert_meets(PLATE, Vec3::new(x, 6.0, z), DOWN, 4.0, [0.0, 1.0, 0.0]);
            assert_meets(PLATE, Vec3::new(x, -1.0, z), UP, 3.0, [0.0, 1.0, 0.0]);
        }
        for (x, z) in [(3.1, 3.0), (1.0, 0.9), (2.5, 4.5)] {
            assert_misses(PLATE, Vec3::new(x, 6.0, z), DOWN);
        }
        assert_misses(PLATE, Vec3::new(1.0, 6.0, 3.0), UP);
        // In its plane.
        assert_misses(PLATE, Vec3::new(9.0, 2.0, 3.0), Vec3::new(-1.0, 0.0, 0.0));
    }

    #[test]
    fn met_at_a_slant() {
        // A disc that leans by 45 degrees reaches 1/√2 upward.
        let half = core::f64::consts::FRAC_1_SQRT_2;
        let leaning = Disc::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 1.0), 1.0);
        assert_meets(leaning, Vec3::new(0.0, 0.7, 5.0), Vec3::new(0.0, 0.0, -1.0), 5.7, [0.0, half, half]);
        assert_misses(leaning, Vec3::new(0.0, 0.72, 5.0), Vec3::new(0.0, 0.0, -1.0));
    }

    #[test]
    fn a_ring_has_a_hole() {
        let ring = Disc::ring(PLATE.center, UP, 1.0, 2.0);
        assert_meets(ring, Vec3::new(2.1, 6.0, 3.0), DOWN, 4.0, [0.0, 1.0, 0.0]);
        assert_misses(ring, Vec3::new(1.9, 6.0, 3.0), DOWN);
        assert_misses(ring, Vec3::new(1.0, 6.0, 3.0), DOWN);
        assert_misses(ring, Vec3::new(3.1, 6.0, 3.0), DOWN);
    }

    #[test]
    fn bounds_are_tight() {
        let mut memory = Memory::new();
        let leaning = Disc::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 1.0), 2.0);
        let bounds = prepared::<_, f32>(leaning, &mut memory).unwrap().bounds().unwrap();
        let expected = Vec3::new(2.0, 2f32.sqrt(), 2f32.sqrt());
        assert!((bounds.max - expected).magnitude() < 1e-4 && (bounds.min + expected).magnitude() < 1e-4);
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            let center = Vec3::new(0.3, -0.7, 0.2) * extent;
            let normal = Vec3::new(0.3, 0.9, -0.2);
            assert_no_self_hits(Disc::new(center, normal, extent), center, extent, 20_000);
            assert_no_self_hits(Disc::ring(center, normal, 0.5 * extent, extent), center, extent, 20_000);
        }
    }

    #[test]
    fn coordinates_are_those_of_the_square_around_it() {
        assert_uv(PLATE, Vec3::new(1.0, 6.0, 3.0), DOWN, [0.5, 0.5]);
        assert_uv(PLATE, Vec3::new(2.0, 6.0, 3.0), DOWN, [0.75, 0.5]);
        assert_uv(PLATE, Vec3::new(1.0, 6.0, 4.5), DOWN, [0.5, 0.125]);
    }

    #[test]
    fn bad_discs_are_refused() {
        assert_eq!(refusal(Disc { radius: 0.0, ..PLATE }), Fault::RadiusNotPositive);
        assert_eq!(refusal(Disc { hole: 2.0, ..PLATE }), Fault::HoleTooLarge);
        assert_eq!(refusal(Disc { hole: -1.0, ..PLATE }), Fault::HoleTooLarge);
        assert_eq!(refusal(Disc { hole: f32::NAN, ..PLATE }), Fault::NotFinite);
        assert_eq!(refusal(Disc { normal: Vec3::ZERO, ..PLATE }), Fault::ZeroLength);
        assert_eq!(refusal(Disc { center: UP * f32::INFINITY, ..PLATE }), Fault::NotFinite);
    }
}
