//! An ellipsoid: the image of a ball under a linear map. Rays are mapped back, and meet a ball by the steps
//! of [`Sphere`](super::Sphere) (Glassner (ed.), "An Introduction to Ray Tracing", 1989, ch. 2).

use super::tessellate::globe;
use super::{Facet, Geometry, Hull, Intersect, Silhouette, Spans, Tessellation, normal_after_step, uv};
use crate::arena::Arena;
use crate::fault::{Fault, check_held, check_point, check_size, unit};
use crate::math::{Aabb, Extent, Interval, Product, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// An ellipsoid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Ellipsoid {
    /// The middle.
    pub center: Vec3,
    /// Three vectors a, b and c from the middle to the surface: the half axes, if they are at right angles to
    /// each other. They may have other angles, but must not lie in one plane: the ellipsoid is all points
    /// `center + x a + y b + z c` with x² + y² + z² ≤ 1.
    pub axes: [Vec3; 3],
}

impl Ellipsoid {
    /// The ellipsoid along the coordinate axes, with three radii that are more than 0.
    pub const fn new(center: Vec3, radii: Vec3) -> Self {
        Self {
            center,
            axes: [Vec3::new(radii.x, 0.0, 0.0), Vec3::new(0.0, radii.y, 0.0), Vec3::new(0.0, 0.0, radii.z)],
        }
    }

    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
        Arena::bytes::<MappedBall<R>>(1)
    }
}

impl Geometry for Ellipsoid {
    type Prepared<'m, R: Real> = PreparedEllipsoid<'m, R>;

    fn bytes<R: Real>(&self) -> usize {
        self.const_bytes::<R>()
    }

    fn is_solid(&self) -> bool {
        true
    }

    fn extent(&self) -> Extent {
        Extent::solid(self.center.magnitude() + reach(self.axes).magnitude())
    }

    fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedEllipsoid<'m, R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.center)?;
        self.axes.into_iter().try_for_each(check_point)?;
        let [a, b, c] = self.axes;
        let (unit_a, unit_b, unit_c) = (unit::<R::Setup>(a)?, unit::<R::Setup>(b)?, unit::<R::Setup>(c)?);
        if unit_a.cross(unit_b).dot(unit_c).abs() < R::Setup::from_f32(1e-4) {
            return Err(Fault::NoVolume);
        }
        let axes = self.axes.map(|axis| scale.setup_point::<R>(axis.to()));
        let longest = axes.into_iter().map(Vec3::length).fold(R::Setup::ZERO, R::Setup::larger);
        // Multiply the inverse of the map by the longest axis. Then the ball has that radius, and no number
        // is large.
        let [a, b, c] = axes.map(|axis| axis * longest.recip());
        let volume = a.cross(b).dot(c).recip();
        let rows = [b.cross(c) * volume, c.cross(a) * volume, a.cross(b) * volume];
        let steepest = rows.into_iter().map(Vec3::length).fold(R::Setup::ZERO, R::Setup::larger);
        check_held::<R>(steepest)?;
        check_size(R::from_setup(longest / steepest))?;
        let size = farthest(axes);
        let center = scale.setup_point::<R>(self.center.to());
        let ball = MappedBall {
            center: Vec3::from_setup(center),
            rows: rows.map(Vec3::from_setup),
            radius: R::from_setup(longest),
            size: R::from_setup(size),
            reach: Vec3::from_setup(reach(axes)),
            hull: hull(center, axes),
            magnitude: R::from_setup(center.magnitude() + size),
        };
        memory.store(ball).map(PreparedEllipsoid)
    }
}

/// How far an ellipsoid with these axes reaches along each coordinate axis.
fn reach<R: Real>(axes: [Vec3<R>; 3]) -> Vec3<R> {
    let [a, b, c] = axes;
    Vec3::new(
        Vec3::new(a.x, b.x, c.x).length(),
        Vec3::new(a.y, b.y, c.y).length(),
        Vec3::new(a.z, b.z, c.z).length(),
    )
}

/// An upper bound of the distance from the middle (Gershgorin's): the longest axis, if they are at right
/// angles.
fn farthest<R: Real>(axes: [Vec3<R>; 3]) -> R {
    let sum = |axis: Vec3<R>| axes.iter().map(|other| axis.dot(*other).abs()).fold(R::ZERO, |a, b| a + b);
    axes.into_iter().map(sum).fold(R::ZERO, R::larger).sqrt()
}

/// The hull: a line along the longest of the three axes, whose radius is the longer half axis of the ellipse
/// of the other two; or the parallelepiped of all three axes, if the ellipsoid is flat rather than long.
fn hull<R: Real>(center: Vec3<R::Setup>, axes: [Vec3<R::Setup>; 3]) -> Hull<R> {
    let [a, b, c] = axes;
    let (a_length, b_length, c_length) = (a.length(), b.length(), c.length());
    let (longest, b, c) = if a_length >= b_length && a_length >= c_length {
        (a, b, c)
    } else if b_length >= c_length {
        (b, c, a)
    } else {
        (c, a, b)
    };
    let half = R::Setup::from_f32(0.5);
    let (mean, difference) = ((b.dot(b) + c.dot(c)) * half, (b.dot(b) - c.dot(c)) * half);
    let common = b.dot(c);
    let radius = (mean + (difference * difference + common * common).sqrt()).sqrt();
    let is_flat = a_length + b_length + c_length < longest.length() + radius + radius * half;
    let (axes, radius) =
        if is_flat { ([longest, b, c], R::Setup::ZERO) } else { ([longest, Vec3::ZERO, Vec3::ZERO], radius) };
    Hull { center: Vec3::from_setup(center), axes: axes.map(Vec3::from_setup), radius: R::from_setup(radius) }
}

/// An [`Ellipsoid`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedEllipsoid<'m, R>(&'m MappedBall<R>);

/// The data of a [`PreparedEllipsoid`].
#[derive(Clone, Copy, Debug, PartialEq)]
struct MappedBall<R> {
    center: Vec3<R>,
    /// The rows of the matrix that maps the ellipsoid to a ball.
    rows: [Vec3<R>; 3],
    /// The radius of that ball.
    radius: R,
    /// No point is farther from the center.
    size: R,
    reach: Vec3<R>,
    hull: Hull<R>,
    magnitude: R,
}

impl<R: Real> MappedBall<R> {
    fn mapped(&self, vector: Vec3<R>) -> Vec3<R> {
        let [x, y, z] = self.rows;
        Vec3::new(x.dot(vector), y.dot(vector), z.dot(vector))
    }

    /// The distances at which the whole line of a ray enters and leaves the ellipsoid.
    fn crossings(&self, ray: &Ray<R>) -> Option<(R, R)> {
        let (from_center, advance) = ray.nearest_to(self.center);
        if from_center.length_squared_wide() > self.size.times(self.size) {
            return None;
        }
        let start = self.mapped(from_center);
        let (direction, stretch) = self.mapped(ray.direction).unit_and_length();
        let middle = -start.dot(direction);
        let nearest = start + direction * middle;
        let discriminant = self.radius.times(self.radius) - nearest.length_squared_wide();
        if discriminant > R::Product::ZERO {
            let half_chord = discriminant.sqrt();
            Some((advance + (middle - half_chord) / stretch, advance + (middle + half_chord) / stretch))
        } else {
            None
        }
    }
}

impl<R: Real> Intersect<R> for PreparedEllipsoid<'_, R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let (near, far) = self.0.crossings(ray)?;
        range.first(near, far)
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        Some(Aabb::around(self.0.center, self.0.reach).padded(R::offset(self.0.magnitude)))
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        self.0.crossings(ray).map_or(Spans::NONE, |(near, far)| Spans::one(near, far))
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let from_center = ray.at(t) - self.0.center;
        let (outward, length) = self.0.mapped(from_center).unit_and_length();
        // The gradient of the distance from the center of the ball: the transposed matrix times its normal.
        let [x, y, z] = self.0.rows;
        let gradient = x * outward.x + y * outward.y + z * outward.z;
        let normal = gradient.normalized().unwrap_or(-ray.direction);
        Surface {
            point: self.0.center + from_center * (self.0.radius / length),
            normal,
            shading_normal: normal,
            magnitude: self.0.magnitude,
            part: 0,
        }
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        uv::globe(self.0.mapped(surface.point - self.0.center))
    }
}

impl<R: Real> Silhouette<R> for PreparedEllipsoid<'_, R> {
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        (part == 0).then_some(self.0.hull)
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        normal_after_step(self, surface, step)
    }

    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let MappedBall { center, rows, radius, .. } = *self.0;
        // The columns of the inverse matrix, times the radius, are the three axes.
        let [x, y, z] = rows.map(Vec3::to_setup);
        let volume = x.cross(y).dot(z);
        let scale = radius.to_setup() / volume;
        let [a, b, c] =
            [y.cross(z), z.cross(x), x.cross(y)].map(|column| Vec3::<R>::from_setup(column * scale));
        let is_mirrored = volume < R::Setup::ZERO;
        let [x, y, z] = rows;
        let corner = |outward: Vec3<R>| {
            let gradient = x * outward.x + y * outward.y + z * outward.z;
            let point = center + a * outward.x + b * outward.y + c * outward.z;
            (point, gradient.normalized().unwrap_or(outward))
        };
        globe(tessellation, is_mirrored, corner, visit);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;

    const EGG: Ellipsoid = Ellipsoid::new(Vec3::new(1.0, 2.0, 3.0), Vec3::new(2.0, 1.0, 0.5));
    const LEFT: Vec3 = Vec3::new(-1.0, 0.0, 0.0);
    const DOWN: Vec3 = Vec3::new(0.0, -1.0, 0.0);
    const AWAY: Vec3 = Vec3::new(0.0, 0.0, -1.0);

    #[test]
    fn met_from_outside_from_inside_and_from_behind() {
        assert_meets(EGG, Vec3::new(5.0, 2.0, 3.0), LEFT, 2.0, [1.0, 0.0, 0.0]);
        assert_meets(EGG, Vec3::new(1.0, 7.0, 3.0), DOWN, 4.0, [0.0, 1.0, 0.0]);
        assert_meets(EGG, Vec3::new(1.0, 2.0, 7.0), AWAY, 3.5, [0.0, 0.0, 1.0]);
        assert_meets(EGG, Vec3::new(1.0, 2.0, 3.0), AWAY, 0.5, [0.0, 0.0, -1.0]);
        assert_misses(EGG, Vec3::new(5.0, 2.0, 3.0), -LEFT);
        assert_misses(EGG, Vec3::new(5.0, 2.0, 3.6), LEFT);
        assert_misses(EGG, Vec3::new(5.0, 3.0, 3.0), LEFT);
    }

    #[test]
    fn the_normal_is_the_gradient() {
        // One unit aside of the middle, y = √3/2 above it; the gradient is (x / 4, y).
        let height = 0.75f64.sqrt();
        let length = (0.0625 + 0.75f64).sqrt();
        let normal = [0.25 / length, height / length, 0.0];
        assert_meets(EGG, Vec3::new(2.0, 7.0, 3.0), DOWN, 5.0 - height, normal);
    }

    #[test]
    fn equal_radii_make_a_sphere_however_it_is_turned() {
        let ball = Ellipsoid {
            center: Vec3::new(1.0, 2.0, 3.0),
            axes: [Vec3::new(1.2, 1.6, 0.0), Vec3::new(-1.6, 1.2, 0.0), Vec3::new(0.0, 0.0, -2.0)],
        };
        let height = 3f64.sqrt();
        let normal = [0.5, 0.0, height / 2.0];
        assert_meets(ball, Vec3::new(2.0, 2.0, 10.0), AWAY, 7.0 - height, normal);
    }

    #[test]
    fn a_slanted_image_of_a_ball() {
        // With x = u + v and y = v, it is all points with (x - y)² + y² + z² ≤ 1. On y = 1/2 they end at x =
        // (1 + √3) / 2.
        let slanted = Ellipsoid {
            center: Vec3::ZERO,
            axes: [Vec3::new(1.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)],
        };
        let x = (1.0 + 3f64.sqrt()) / 2.0;
        let (gx, gy) = (x - 0.5, 1.0 - x);
        let length = gx.hypot(gy);
        let normal = [gx / length, gy / length, 0.0];
        assert_meets(slanted, Vec3::new(5.0, 0.5, 0.0), LEFT, 5.0 - x, normal);
        // The ellipsoid reaches no higher than 1.
        assert_misses(slanted, Vec3::new(5.0, 1.01, 0.0), LEFT);
    }

    #[test]
    fn found_from_far_away() {
        let egg = Ellipsoid { center: Vec3::ZERO, ..EGG };
        assert_meets(egg, Vec3::new(0.0, 0.0, 500.0), AWAY, 499.5, [0.0, 0.0, 1.0]);
        assert_meets(egg, Vec3::new(-500.0, 0.0, 0.0), -LEFT, 498.0, [-1.0, 0.0, 0.0]);
    }

    #[test]
    fn spans_are_the_chords() {
        let height = 0.75f64.sqrt();
        assert_spans(EGG, Vec3::new(2.0, 7.0, 3.0), DOWN, &[(5.0 - height, 5.0 + height)]);
        assert_spans(EGG, Vec3::new(-4.0, 2.0, 3.0), LEFT, &[(-7.0, -3.0)]);
        assert_spans(EGG, Vec3::new(2.0, 7.0, 3.5), DOWN, &[]);
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            let axes =
                [Vec3::new(0.6, 0.48, 0.64), Vec3::new(0.24, 0.192, -0.369), Vec3::new(-0.1, 0.15, 0.0)];
            for center in [Vec3::ZERO, Vec3::new(3.0, -2.0, 1.0) * extent] {
                let turned = Ellipsoid { center, axes: axes.map(|axis| axis * extent) };
                assert_no_self_hits(turned, center, extent, 10_000);
                let lens = Ellipsoid::new(center, Vec3::new(1.0, 0.2, 1.0) * extent);
                assert_no_self_hits(lens, center, extent, 10_000);
                assert_spans_are_met(turned, center, extent, 1_000);
            }
        }
    }

    #[test]
    fn coordinates_are_those_of_a_sphere_that_was_stretched() {
        assert_uv(EGG, Vec3::new(1.0, 2.0, 9.0), AWAY, [0.75, 0.5]);
        // A point between the z axis and the top.
        let away = (0.75f32).sqrt() * 0.5;
        assert_uv(
            EGG,
            Vec3::new(1.0, 9.0, 3.0 - 0.5 * away),
            DOWN,
            [0.25, 0.5 + (0.8125f64).sqrt().asin() / core::f64::consts::PI],
        );
    }

    #[test]
    fn bad_ellipsoids_are_refused() {
        let [a, b, _] = EGG.axes;
        assert_eq!(refusal(Ellipsoid { axes: [a, b, Vec3::ZERO], ..EGG }), Fault::ZeroLength);
        assert_eq!(refusal(Ellipsoid { axes: [a, b, a - b], ..EGG }), Fault::NoVolume);
        assert_eq!(refusal(Ellipsoid { axes: [a, b, a * f32::NAN], ..EGG }), Fault::NotFinite);
        assert_eq!(refusal(Ellipsoid { axes: [a, b, a * 1e9], ..EGG }), Fault::TooFar);
        // A coin that is too thin for fixed-point numbers.
        let coin = Ellipsoid::new(Vec3::ZERO, Vec3::new(1.0, 0.01, 1.0));
        let mut memory = Memory::new();
        let fault = prepared::<_, crate::math::Fixed>(coin, &mut memory).expect_err("accepted");
        assert_eq!(fault, Fault::OutOfRange);
    }
}
