//! A sphere, after Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection",
//! Ray Tracing Gems, 2019, ch. 7.

use super::tessellate::globe;
use super::{Facet, Form, Geometry, Intersect, Luminaire, Silhouette, Spans, Tessellation, uv};
use crate::arena::Arena;
use crate::fault::{Fault, check_point, check_radius, check_size};
use crate::math::{Aabb, Extent, FourRays, Interval, Product, Ray, Real, Scale, Vec3, each};
use crate::surface::Surface;

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Sphere {
    /// The middle.
    pub center: Vec3,
    /// Radius, more than 0.
    pub radius: f32,
}

impl Sphere {
    /// The sphere around `center` with this radius.
    pub const fn new(center: Vec3, radius: f32) -> Self {
        Self { center, radius }
    }
}

impl Geometry for Sphere {
    type Prepared<'m, R: Real> = PreparedSphere<R>;

    fn is_solid(&self) -> bool {
        true
    }

    fn luminaire(&self) -> Option<Luminaire> {
        Some(Luminaire::Ball { center: self.center, radius: self.radius })
    }

    fn extent(&self) -> Extent {
        Extent::solid(self.center.magnitude() + self.radius)
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, _: &mut Arena<'m>) -> Result<PreparedSphere<R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.center)?;
        check_radius(self.radius)?;
        let radius: R = scale.length(R::Setup::from_f32(self.radius));
        check_size(radius)?;
        let center = scale.point(self.center.to());
        let rounding = rounding(center.magnitude(), radius);
        Ok(PreparedSphere { center, radius, radius_squared: radius.times(radius), rounding })
    }
}

/// A [`Sphere`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedSphere<R: Real> {
    center: Vec3<R>,
    radius: R,
    radius_squared: R::Product,
    /// [`Surface::magnitude`] of all places.
    rounding: R,
}

/// Balls of a larger radius, or whose center has a larger coordinate, are huge: see [`rounding`].
const HUGE: u16 = 1024;

/// The [`Surface::magnitude`] of a ball whose center has no coordinate larger than `farthest`.
///
/// Rays that leave the ground, a ball of radius 1e5, must not begin above the things on it. In floating
/// point, hits of balls are more accurate than the offset of spawned rays allows for all shapes. Of 27
/// million rays whose direction's length is off by up to 3.9e-7, none meets its ball again with a sixteenth
/// of the offset of the larger number, and a few do with an 18th. This is a 13th, and directions are off by
/// 1.8e-7. In fixed point there are no such balls, as scenes are scaled into its range.
fn rounding<R: Real>(farthest: R, radius: R) -> R {
    let larger = farthest.larger(radius);
    let is_huge = !R::IS_FIXED_POINT && larger > R::from_u16(HUGE);
    if is_huge { larger * R::from_fraction(5 << 10) } else { farthest + radius }
}

impl<R: Real> PreparedSphere<R> {
    /// The distances at which a ray's line enters and leaves the sphere.
    // Forced: see `intersect` in `shape_set!` (1.12 times the instructions).
    #[inline(always)]
    fn chord(&self, ray: &Ray<R>) -> Option<(R, R)> {
        let from_center = ray.origin - self.center;
        let middle = -from_center.dot(ray.direction);
        // Compute the discriminant from the point of the ray that is nearest to the center. With the
        // textbook's b² − c, hits from 100 radii away are off by 0.3 % of the radius.
        let nearest = from_center + ray.direction * middle;
        let discriminant = self.radius_squared - nearest.length_squared_wide();
        if discriminant > R::Product::ZERO {
            let half_chord = discriminant.sqrt();
            Some((middle - half_chord, middle + half_chord))
        } else {
            None
        }
    }
}

impl<R: Real> Intersect<R> for PreparedSphere<R> {
    #[inline]
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let (near, far) = self.chord(ray)?;
        range.first(near, far)
    }

    #[inline(always)]
    #[allow(clippy::indexing_slicing)] // All indices are below 4.
    fn intersect_four(&self, rays: &FourRays<R>, max: &[R; 4]) -> (u32, [R; 4]) {
        // The steps of `chord`. If the discriminant is not positive, its root is 0 or NaN.
        let from_center = each(|i| rays.ray(i).origin - self.center);
        let middle = each(|i| -from_center[i].dot(rays.ray(i).direction));
        let nearest = each(|i| from_center[i] + rays.ray(i).direction * middle[i]);
        let half_chord = each(|i| (self.radius_squared - nearest[i].length_squared_wide()).sqrt());
        let zeros = [R::ZERO; 4];
        let met = R::less(&zeros, &half_chord);
        if met == 0 {
            return (0, *max);
        }
        let near = each(|i| middle[i] - half_chord[i]);
        let far = each(|i| middle[i] + half_chord[i]);
        let first = each(|i| if near[i] > R::ZERO { near[i] } else { far[i] });
        (met & R::less(&zeros, &first) & R::less(&first, max), first)
    }

    fn form(&self) -> Form<R> {
        Form::Ball { center: self.center, radius: self.radius }
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        let bounds = Aabb::around(self.center, Vec3::new(self.radius, self.radius, self.radius));
        Some(bounds.padded(R::offset(bounds.magnitude())))
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        self.chord(ray).map_or(Spans::NONE, |(near, far)| Spans::one(near, far))
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let normal = (ray.at(t) - self.center).unit();
        Surface {
            // On the sphere again: the hit is off by the rounding of a long ray.
            point: self.center + normal * self.radius,
            normal,
            shading_normal: normal,
            magnitude: self.rounding,
            part: 0,
        }
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        uv::globe(surface.point - self.center)
    }
}

impl<R: Real> Silhouette<R> for PreparedSphere<R> {
    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        (surface.normal * self.radius + step).unit()
    }

    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        globe(tessellation, false, |normal| (self.center + normal * self.radius, normal), visit);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;

    const BALL: Sphere = Sphere::new(Vec3::new(1.0, 2.0, 3.0), 2.0);

    #[test]
    fn met_from_outside_from_inside_and_from_behind() {
        assert_meets(BALL, Vec3::new(1.0, 2.0, 10.0), Vec3::new(0.0, 0.0, -1.0), 5.0, [0.0, 0.0, 1.0]);
        assert_meets(BALL, Vec3::new(1.0, 2.0, 3.0), Vec3::new(1.0, 0.0, 0.0), 2.0, [1.0, 0.0, 0.0]);
        assert_meets(BALL, Vec3::new(1.0, 2.0, 4.5), Vec3::new(0.0, 0.0, -1.0), 3.5, [0.0, 0.0, -1.0]);
        assert_misses(BALL, Vec3::new(1.0, 2.0, 10.0), Vec3::new(0.0, 0.0, 1.0));
        assert_misses(BALL, Vec3::new(1.0, 5.0, 10.0), Vec3::new(0.0, 0.0, -1.0));
    }

    #[test]
    fn met_off_center() {
        // At half the radius off the axis the surface is √3/2 radii high.
        let height = 3f64.sqrt();
        let normal = [0.5, 0.0, height / 2.0];
        assert_meets(BALL, Vec3::new(2.0, 2.0, 10.0), Vec3::new(0.0, 0.0, -1.0), 7.0 - height, normal);
    }

    #[test]
    fn longitude_and_latitude() {
        let center = BALL.center;
        // Toward -z is a quarter of a turn, as seen from above.
        for (x, z, u) in [(0.0, -1.0, 0.25), (-1.0, 0.0, 0.5), (0.0, 1.0, 0.75), (1.0, -1.0, 0.125)] {
            let inward = Vec3::new(-x, 0.0, -z);
            assert_uv(BALL, center - inward * 5.0, inward, [u, 0.5]);
            // At 45 degrees up, latitude is three quarters of the way from pole to pole.
            let down = inward + Vec3::new(0.0, -inward.length(), 0.0);
            assert_uv(BALL, center - down * 5.0, down, [u, 0.75]);
        }
        // Next to the pole.
        let down = Vec3::new(-1e-3, -1.0, -1e-3);
        assert_uv(BALL, center - down * 5.0, down, [0.875, 1.0 - 1e-3 * 2f64.sqrt() / core::f64::consts::PI]);
    }

    #[test]
    fn touching_is_a_miss() {
        assert_misses(BALL, Vec3::new(3.0, 2.0, 10.0), Vec3::new(0.0, 0.0, -1.0));
    }

    #[test]
    fn found_from_a_hundred_thousand_radii_away() {
        let marble = Sphere::new(Vec3::ZERO, 1.0);
        assert_meets(marble, Vec3::new(0.0, 0.0, 1e5), Vec3::new(0.0, 0.0, -1.0), 1e5 - 1.0, [0.0, 0.0, 1.0]);
    }

    #[test]
    fn its_inside_is_a_chord() {
        let along = Vec3::new(0.0, 0.0, -1.0);
        // From outside, from inside, and from beyond it.
        for z in [10.0, 3.5, -5.0] {
            let middle = f64::from(z) - 3.0;
            assert_spans(BALL, Vec3::new(1.0, 2.0, z), along, &[(middle - 2.0, middle + 2.0)]);
        }
        let half = 3f64.sqrt();
        assert_spans(BALL, Vec3::new(2.0, 2.0, 3.0), along, &[(-half, half)]);
        assert_spans(BALL, Vec3::new(3.5, 2.0, 3.0), along, &[]);
        for extent in EXTENTS {
            let center = Vec3::new(3.0, -2.0, 1.0) * extent;
            assert_spans_are_met(Sphere::new(center, extent), center, extent, 2_000);
        }
    }

    #[test]
    fn four_rays_meet_it_as_single_ones_do() {
        assert_four_are_met_as_one(BALL, BALL.center, BALL.radius);
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for radius in EXTENTS.into_iter().chain([1e4]) {
            for center in [Vec3::ZERO, Vec3::new(3.0, -2.0, 1.0) * radius] {
                assert_no_self_hits(Sphere::new(center, radius), center, radius, 20_000);
            }
        }
    }

    #[test]
    fn bad_spheres_are_refused() {
        for radius in [0.0, -1.0, -0.0] {
            assert_eq!(refusal(Sphere { radius, ..BALL }), Fault::RadiusNotPositive);
        }
        assert_eq!(refusal(Sphere { radius: f32::NAN, ..BALL }), Fault::NotFinite);
        assert_eq!(refusal(Sphere { radius: 2e6, ..BALL }), Fault::TooFar);
        assert_eq!(refusal(Sphere::new(Vec3::new(0.0, f32::INFINITY, 0.0), 1.0)), Fault::NotFinite);
    }
}
