//! A rectangle or parallelogram: the part of a [`Patch`] whose two coordinates are both from 0 to 1.

use super::patch::Patch;
use super::tessellate::face;
use super::{Facet, Form, Geometry, Hull, Intersect, Luminaire, Silhouette, Tessellation, bounds_of};
use crate::arena::Arena;
use crate::fault::{Fault, check_point};
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// A rectangle, or a parallelogram if its edges are not at right angles. Its front is the side from which
/// `right` turns counterclockwise toward `up`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Rectangle {
    /// One corner.
    pub corner: Vec3,
    /// The edge from that corner to the next one.
    pub right: Vec3,
    /// The other edge from that corner.
    pub up: Vec3,
}

impl Rectangle {
    /// The rectangle that is spanned by two edges from a corner.
    pub const fn new(corner: Vec3, right: Vec3, up: Vec3) -> Self {
        Self { corner, right, up }
    }

    fn corners<R: Real>(corner: Vec3<R>, right: Vec3<R>, up: Vec3<R>) -> [Vec3<R>; 4] {
        [corner, corner + right, corner + right + up, corner + up]
    }
}

impl Geometry for Rectangle {
    type Prepared<'m, R: Real> = PreparedRectangle<R>;

    fn luminaire(&self) -> Option<Luminaire> {
        Some(Luminaire::Rectangle { corner: self.corner, right: self.right, up: self.up })
    }

    fn extent(&self) -> Extent {
        Extent::flat_between(Self::corners(self.corner, self.right, self.up))
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, _: &mut Arena<'m>) -> Result<PreparedRectangle<R>, Fault>
    where
        Self: 'm,
    {
        [self.right, self.up].into_iter().try_for_each(check_point)?;
        Self::corners(self.corner, self.right, self.up).into_iter().try_for_each(check_point)?;
        let patch = Patch::new(self.corner.to(), self.right.to(), self.up.to(), scale)?;
        Ok(PreparedRectangle { patch })
    }
}

/// A [`Rectangle`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedRectangle<R: Real> {
    patch: Patch<R>,
}

impl<R: Real> Intersect<R> for PreparedRectangle<R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let inside = |u: R, v: R| u >= R::ZERO && v >= R::ZERO && u <= R::ONE && v <= R::ONE;
        self.patch.meet(ray, range, inside)
    }

    fn form(&self) -> Form<R> {
        self.patch.plane.form()
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        let [corner, right, up] = self.patch.edges();
        bounds_of(Rectangle::corners(corner, right, up).into_iter().map(Vec3::from_setup))
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        self.patch.plane.surface(ray, t)
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        self.patch.coordinates(surface.point).into()
    }
}

impl<R: Real> Silhouette<R> for PreparedRectangle<R> {
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        (part == 0).then(|| self.patch.hull())
    }

    fn each_facet(&self, _: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let [corner, right, up] = self.patch.edges();
        let corners = Rectangle::corners(corner, right, up).map(Vec3::from_setup);
        face(&corners, self.patch.plane.normal, 0, false, visit);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;
    use crate::math::Fixed;

    // Three wide, two deep, in the plane y = 1.
    const TABLE: Rectangle =
        Rectangle::new(Vec3::new(-1.0, 1.0, 1.0), Vec3::new(3.0, 0.0, 0.0), Vec3::new(0.0, 0.0, -2.0));
    const DOWN: Vec3 = Vec3::new(0.0, -1.0, 0.0);

    #[test]
    fn met_between_its_edges_from_both_sides() {
        for (x, z) in [(-0.99, 0.0), (1.99, 0.99), (0.5, -0.99), (0.0, 0.0)] {
            assert_meets(TABLE, Vec3::new(x, 5.0, z), DOWN, 4.0, [0.0, 1.0, 0.0]);
            assert_meets(TABLE, Vec3::new(x, -5.0, z), -DOWN, 6.0, [0.0, 1.0, 0.0]);
        }
        for (x, z) in [(-1.01, 0.0), (2.01, 0.99), (0.5, -1.01), (0.0, 1.01)] {
            assert_misses(TABLE, Vec3::new(x, 5.0, z), DOWN);
        }
        assert_misses(TABLE, Vec3::new(0.0, 5.0, 0.0), -DOWN);
        // In its plane.
        assert_misses(TABLE, Vec3::new(-9.0, 1.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
    }

    #[test]
    fn edges_at_any_angle_make_a_parallelogram() {
        let leaning = Rectangle { up: Vec3::new(2.0, 0.0, -2.0), ..TABLE };
        for (x, z) in [(-0.9, 0.99), (1.9, 0.8), (1.1, -0.99), (3.9, -0.99)] {
            assert_meets(leaning, Vec3::new(x, 5.0, z), DOWN, 4.0, [0.0, 1.0, 0.0]);
        }
        for (x, z) in [(-0.9, 0.8), (2.3, 0.8), (0.9, -0.99)] {
            assert_misses(leaning, Vec3::new(x, 5.0, z), DOWN);
        }
    }

    #[test]
    fn bounds_are_tight() {
        let mut memory = Memory::new();
        let bounds = prepared::<_, f32>(TABLE, &mut memory).unwrap().bounds().unwrap();
        assert!((bounds.min - Vec3::new(-1.0, 1.0, -1.0)).magnitude() < 1e-4, "{bounds:?}");
        assert!((bounds.max - Vec3::new(2.0, 1.0, 1.0)).magnitude() < 1e-4, "{bounds:?}");
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            let tilted = Rectangle {
                corner: Vec3::new(-0.8, -0.5, 0.3) * extent,
                right: Vec3::new(1.5, 0.2, -0.4) * extent,
                up: Vec3::new(0.1, 1.2, 0.3) * extent,
            };
            assert_no_self_hits(tilted, Vec3::ZERO, extent, 20_000);
        }
    }

    #[test]
    fn coordinates_run_along_its_edges() {
        assert_uv(TABLE, Vec3::new(-0.25, 5.0, 0.5), DOWN, [0.25, 0.25]);
        let leaning = Rectangle { up: Vec3::new(2.0, 0.0, -2.0), ..TABLE };
        assert_uv(leaning, Vec3::new(0.75, 5.0, 0.0), DOWN, [0.25, 0.5]);
    }

    #[test]
    fn bad_rectangles_are_refused() {
        assert_eq!(refusal(Rectangle { up: TABLE.right * 2.0, ..TABLE }), Fault::Collinear);
        assert_eq!(refusal(Rectangle { right: Vec3::ZERO, ..TABLE }), Fault::Collinear);
        assert_eq!(refusal(Rectangle { up: DOWN * f32::NAN, ..TABLE }), Fault::NotFinite);
        assert_eq!(refusal(Rectangle { up: DOWN * 2e6, ..TABLE }), Fault::TooFar);
        assert_eq!(refusal(Rectangle { corner: DOWN * 9.99e5, up: DOWN * 2e3, ..TABLE }), Fault::TooFar);
    }

    #[test]
    fn rectangles_thinner_than_fixed_point_can_tell_are_refused() {
        let wide = Vec3::new(3e5, 0.0, 0.0);
        for (right, up) in [(wide, DOWN * 0.01), (DOWN * 0.01, wide), (DOWN * 0.02, TABLE.right * 0.01)] {
            let thin = Rectangle { corner: wide, right, up };
            let mut memory = Memory::new();
            assert_eq!(prepared::<_, Fixed>(thin, &mut memory).unwrap_err(), Fault::TooSmall);
            assert!(prepared::<_, f32>(thin, &mut memory).is_ok());
        }
    }
}
