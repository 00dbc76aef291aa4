//! A triangle: the part of a [`Patch`] whose two coordinates are at least 0 and have a sum of at most 1. They
//! are the barycentric coordinates of the second and the third corner.

use super::patch::Patch;
use super::{Facet, Form, Geometry, Hull, Intersect, Silhouette, Tessellation, Tip, bounds_of};
use crate::arena::Arena;
use crate::fault::{Fault, check_direction, check_point};
use crate::math::{Aabb, Extent, FourRays, Interval, Ray, Real, Scale, Vec3, each};
use crate::surface::Surface;

/// A triangle. Its front is the side from which the vertices run counterclockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Triangle {
    /// The corners.
    pub vertices: [Vec3; 3],
    /// Normals at the corners, of any length but 0, interpolated for shading; `None` for a flat triangle.
    pub normals: Option<[Vec3; 3]>,
}

impl Triangle {
    /// A flat triangle.
    pub const fn flat(a: Vec3, b: Vec3, c: Vec3) -> Self {
        Self { vertices: [a, b, c], normals: None }
    }

    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
        if self.normals.is_some() { Arena::bytes::<[Vec3<R>; 3]>(1) } else { 0 }
    }
}

impl Geometry for Triangle {
    type Prepared<'m, R: Real> = PreparedTriangle<'m, R>;

    fn bytes<R: Real>(&self) -> usize {
        self.const_bytes::<R>()
    }

    fn extent(&self) -> Extent {
        Extent::flat_between(self.vertices)
    }

    fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedTriangle<'m, R>, Fault>
    where
        Self: 'm,
    {
        self.vertices.into_iter().try_for_each(check_point)?;
        let [a, b, c] = self.vertices.map(Vec3::to::<R::Setup>);
        let patch = Patch::new(a, b - a, c - a, scale)?;
        let normals = match self.normals {
            None => None,
            Some(normals) => {
                let mut units = [Vec3::ZERO; 3];
                for (unit, normal) in units.iter_mut().zip(normals) {
                    *unit = Vec3::from_setup(check_direction(normal)?);
                }
                memory.store(units).map(Some)?
            }
        };
        Ok(PreparedTriangle { patch, normals })
    }
}

/// A [`Triangle`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedTriangle<'m, R: Real> {
    /// The coordinates are the weights of the second and the third corner.
    patch: Patch<R>,
    normals: Option<&'m [Vec3<R>; 3]>,
}

impl<R: Real> PreparedTriangle<'_, R> {
    /// The interpolated normal at a point of the plane; `None` if the triangle is flat or the normals cancel.
    #[inline]
    fn normal_at(&self, point: Vec3<R>) -> Option<Vec3<R>> {
        let [at_a, at_b, at_c] = self.normals?;
        let (b, c) = self.patch.coordinates(point);
        (*at_a * (R::ONE - b - c) + *at_b * b + *at_c * c).normalized()
    }
}

impl<R: Real> Intersect<R> for PreparedTriangle<'_, R> {
    const IS_SMOOTHED: bool = true;

    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let inside = |b: R, c: R| b >= R::ZERO && c >= R::ZERO && b.add_saturating(c) <= R::ONE;
        self.patch.meet(ray, range, inside)
    }

    #[inline]
    #[allow(clippy::indexing_slicing)] // All indices are below 4.
    fn intersect_four(&self, rays: &FourRays<R>, max: &[R; 4]) -> (u32, [R; 4]) {
        let (met, t, b, c) = self.patch.meet_four(rays, max);
        let (zeros, sum) = ([R::ZERO; 4], each(|i| b[i].add_saturating(c[i])));
        let inside = R::no_larger(&zeros, &b) & R::no_larger(&zeros, &c) & R::no_larger(&sum, &[R::ONE; 4]);
        (met & inside, t)
    }

    fn form(&self) -> Form<R> {
        self.patch.plane.form()
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        let [a, ab, ac] = self.patch.edges();
        bounds_of([a, a + ab, a + ac].into_iter().map(Vec3::from_setup))
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let surface = self.patch.plane.surface(ray, t);
        Surface { shading_normal: self.normal_at(surface.point).unwrap_or(surface.normal), ..surface }
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        self.patch.coordinates(surface.point).into()
    }
}

impl<R: Real> Silhouette<R> for PreparedTriangle<'_, R> {
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        (part == 0).then(|| self.patch.hull())
    }

    fn tip(&self, number: usize) -> Option<Tip<R>> {
        let [a, ab, ac] = self.patch.edges();
        let [a, b, c] = [a, a + ab, a + ac].map(Vec3::from_setup);
        let (apex, ends) = match number {
            0 => (a, [b, c]),
            1 => (b, [c, a]),
            2 => (c, [a, b]),
            _ => return None,
        };
        Some(Tip { apex, ends, radius: R::ZERO })
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        self.normal_at(surface.point + step).unwrap_or(surface.normal)
    }

    fn each_facet(&self, _: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let [a, ab, ac] = self.patch.edges();
        let flat = Facet::flat([a, a + ab, a + ac].map(Vec3::from_setup), self.patch.plane.normal);
        visit(&Facet { normals: self.normals.copied().unwrap_or(flat.normals), ..flat });
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;
    use crate::math::Fixed;

    // In the plane z = 1, counterclockwise as seen from above.
    const FLAT: Triangle =
        Triangle::flat(Vec3::new(0.0, 0.0, 1.0), Vec3::new(4.0, 0.0, 1.0), Vec3::new(0.0, 3.0, 1.0));

    fn down(x: f32, y: f32) -> (Vec3, Vec3) {
        (Vec3::new(x, y, 6.0), Vec3::new(0.0, 0.0, -1.0))
    }

    #[test]
    fn four_rays_meet_it_as_single_ones_do() {
        assert_four_are_met_as_one(FLAT, Vec3::new(1.3, 1.0, 1.0), 2.0);
    }

    #[test]
    fn met_inside_from_both_sides() {
        let (above, toward) = down(1.0, 1.0);
        assert_meets(FLAT, above, toward, 5.0, [0.0, 0.0, 1.0]);
        assert_meets(FLAT, Vec3::new(1.0, 1.0, -1.0), -toward, 2.0, [0.0, 0.0, 1.0]);
        for (x, y) in [(0.01, 0.01), (3.9, 0.01), (0.01, 2.9), (1.99, 1.49)] {
            let (origin, toward) = down(x, y);
            assert_meets(FLAT, origin, toward, 5.0, [0.0, 0.0, 1.0]);
        }
    }

    #[test]
    fn missed_outside_along_and_behind() {
        for (x, y) in [(-0.01, 1.0), (1.0, -0.01), (2.01, 1.51), (5.0, 0.0), (-1.0, -1.0)] {
            let (origin, toward) = down(x, y);
            assert_misses(FLAT, origin, toward);
        }
        assert_misses(FLAT, Vec3::new(-1.0, 1.0, 1.0), Vec3::new(1.0, 0.0, 0.0));
        assert_misses(FLAT, Vec3::new(1.0, 1.0, 6.0), Vec3::new(0.0, 0.0, 1.0));
    }

    #[test]
    fn normals_are_interpolated_by_barycentric_coordinates() {
        let normals = [Vec3::new(0.0, 0.0, 9.0), Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
        let smooth = Triangle { normals: Some(normals), ..FLAT };
        // Weights 1/4, 1/2, 1/4.
        let (origin, toward) = down(2.0, 0.75);
        let length = 6f64.sqrt() / 4.0;
        let expected = [0.5 / length, 0.25 / length, 0.25 / length];
        let got = shading_normal(smooth, origin, toward);
        assert!(got.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{got:?}");
        assert_eq!(shading_normal(FLAT, origin, toward), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn normals_that_cancel_give_way_to_the_flat_one() {
        let normals = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(-1.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 1.0)];
        let smooth = Triangle { normals: Some(normals), ..FLAT };
        let (origin, toward) = down(2.0, 0.0);
        let got = shading_normal(smooth, origin, toward);
        assert!((got[2] - 1.0).abs() < 1e-6, "{got:?}");
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            let corner = |x, y, z| Vec3::new(x, y, z) * extent;
            let triangle =
                Triangle::flat(corner(-1.0, -0.8, 0.3), corner(1.0, -0.6, -0.5), corner(0.1, 1.0, 0.9));
            assert_no_self_hits(triangle, Vec3::ZERO, extent, 20_000);
        }
    }

    #[test]
    fn coordinates_are_weights_of_corners() {
        let (origin, toward) = down(2.0, 0.75);
        assert_uv(FLAT, origin, toward, [0.5, 0.25]);
    }

    #[test]
    fn bad_triangles_are_refused() {
        let [a, b, c] = FLAT.vertices;
        assert_eq!(refusal(Triangle::flat(a, b, b)), Fault::Collinear);
        assert_eq!(refusal(Triangle::flat(a, b, a * 0.5 + b * 0.5)), Fault::Collinear);
        assert_eq!(refusal(Triangle::flat(a, a, a)), Fault::Collinear);
        assert_eq!(refusal(Triangle::flat(a, b, c * f32::NAN)), Fault::NotFinite);
        assert_eq!(refusal(Triangle { normals: Some([a, b, Vec3::ZERO]), ..FLAT }), Fault::ZeroLength);
        // A tiny one far away from the origin, for fixed point.
        let far = FLAT.vertices.map(|vertex| Vec3::new(3e5, 0.0, 0.0) + vertex * 0.05);
        let tiny = Triangle { vertices: far, normals: None };
        assert_eq!(prepared::<_, Fixed>(tiny, &mut Memory::new()).unwrap_err(), Fault::TooSmall);
    }
}
