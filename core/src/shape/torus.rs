//! A torus: a ray meets it at the roots of a quartic equation. The roots of the derivative separate them
//! (Hanrahan in Glassner (ed.), "An Introduction to Ray Tracing", 1989, ch. 3). If a line is parametrized
//! from its point nearest to the center, the derivative is t³ + A t + B, whose roots are simple to find. The
//! roots of the quartic between them are found by Newton's steps. These evaluate the squared distance from
//! the tube's middle circle, less the squared radius of the tube, in place of the quartic: it has the same
//! sign, and keeps the digits of a thin tube.

use super::circle::Circle;
use super::tessellate::{Directions, Grid};
use super::{
    Facet, Geometry, Hull, Intersect, Silhouette, Spans, Tessellation, normal_after_step, reach_across, uv,
};
use crate::arena::Arena;
use crate::fault::{Fault, check_direction, check_point, check_radius, check_size};
use crate::limits::MIN_SEGMENTS;
use crate::math::{Aabb, Extent, Interval, Product, Ray, Real, Scale, Vec3, cubic_roots, root_between};
use crate::surface::Surface;

/// A torus: all points that are no farther than the minor radius from a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Torus {
    /// The middle of the hole.
    pub center: Vec3,
    /// Points along the axis of the hole; any length but 0.
    pub axis: Vec3,
    /// Radius of the circle, more than 0.
    pub major_radius: f32,
    /// Radius of the tube around the circle: more than 0, and less than the major radius.
    pub minor_radius: f32,
}

impl Geometry for Torus {
    type Prepared<'m, R: Real> = PreparedTorus<R>;

    fn is_solid(&self) -> bool {
        true
    }

    fn extent(&self) -> Extent {
        Extent::solid(self.center.magnitude() + self.major_radius + self.minor_radius)
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, _: &mut Arena<'m>) -> Result<PreparedTorus<R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.center)?;
        check_radius(self.major_radius)?;
        check_radius(self.minor_radius)?;
        let axis: Vec3<R::Setup> = check_direction(self.axis)?;
        if self.minor_radius >= self.major_radius {
            return Err(Fault::NoHole);
        }
        let (major, minor) = (R::Setup::from_f32(self.major_radius), R::Setup::from_f32(self.minor_radius));
        let size = major + minor;
        let center = self.center.to::<R::Setup>();
        check_size(scale.length::<R>(minor))?;
        let thickness: R = R::from_setup(minor / size);
        if thickness < R::RAY_OFFSET * R::from_u16(4) {
            return Err(Fault::TooSmall);
        }
        Ok(PreparedTorus {
            center: scale.point(center),
            axis: Vec3::from_setup(axis),
            major: scale.length(major),
            minor: scale.length(minor),
            size: scale.length(size),
            width: R::from_setup(major / size),
            thickness,
            magnitude: scale.length(center.magnitude() + size),
        })
    }
}

/// A [`Torus`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedTorus<R> {
    center: Vec3<R>,
    axis: Vec3<R>,
    major: R,
    minor: R,
    /// The sum of both radii: no point is farther from the center.
    size: R,
    /// The major radius in units of `size`.
    width: R,
    /// The minor radius in units of `size`.
    thickness: R,
    magnitude: R,
}

/// A line, relative to a torus of size 1. It is parametrized from its point nearest to the center.
struct LineAtTorus<R: Real> {
    /// The squared distance of that point from the center.
    distance: R::Product,
    /// The height of that point along the axis.
    height: R,
    /// The change of height for each unit along the line.
    climb: R,
}

impl<R: Real> LineAtTorus<R> {
    /// The part that can meet the torus: the part in the ball around the torus and between the two planes
    /// that touch it.
    fn part(&self, thickness: R) -> Option<Interval<R>> {
        let end = (R::ONE.times(R::ONE) - self.distance).sqrt();
        let mut part = Interval { min: -end, max: end };
        if self.climb == R::ZERO {
            return (self.height.abs() < thickness).then_some(part);
        }
        let (one, other) = ((-thickness - self.height) / self.climb, (thickness - self.height) / self.climb);
        let (enters, leaves) = if one < other { (one, other) } else { (other, one) };
        part.min = part.min.larger(enters);
        if leaves < part.max {
            part.max = leaves;
        }
        (part.min < part.max).then_some(part)
    }

    /// Whether the place at `t` is inside the torus, and Newton's step from there to the surface, for the
    /// difference between two squares: of the distance from the circle, and of the tube's radius.
    fn look(&self, t: R, width: R, thickness: R) -> (bool, R) {
        let height = self.height + self.climb * t;
        let from_axis = (self.distance + t.times(t) - height.times(height)).sqrt();
        let across = from_axis - width;
        let value = across.times(across) + height.times(height) - thickness.times(thickness);
        // Half the slope, times the distance from the axis.
        let slope = across * (t - height * self.climb) + height * self.climb * from_axis;
        (value < R::Product::ZERO, -value.times(from_axis).over(slope + slope))
    }
}

impl<R: Real> PreparedTorus<R> {
    /// Calls `found` with the distances at which a ray's line meets the torus, in order, until it returns
    /// `true`. Distances before the beginning of `range` may be left out.
    fn each_crossing(&self, ray: &Ray<R>, range: Interval<R>, mut found: impl FnMut(R) -> bool) {
        let (from_center, advance) = ray.nearest_to_twice(self.center);
        if from_center.length_squared_wide() > self.size.times(self.size) {
            return;
        }
        let Self { width, thickness, size, .. } = *self;
        let start = Vec3::new(from_center.x / size, from_center.y / size, from_center.z / size);
        let (height, climb) = (start.dot(self.axis), ray.direction.dot(self.axis));
        let line = LineAtTorus { distance: start.length_squared_wide(), height, climb };
        let Some(part) = line.part(thickness) else { return };

        // The quartic is (t² + k)² - 4 W² (t² + s² - (height + climb t)²), with k = s² + W² - T². A quarter
        // of its derivative:
        let (width_squared, distance) = (width * width, line.distance.over(R::ONE));
        let linear =
            distance - thickness * thickness + width_squared * (climb * climb + climb * climb - R::ONE);
        let constant = width_squared * height * climb;
        let turns = cubic_roots(linear, constant + constant, part.min, part.max);
        // Both ends of the part are outside of the torus.
        let places = turns.map(|turn| (turn, line.look(turn, width, thickness).0)).chain([(part.max, false)]);
        let (mut from, mut from_is_inside) = (part.min, false);
        for (to, to_is_inside) in places {
            if from_is_inside != to_is_inside && advance + size * to > range.min {
                let look = |t: R| line.look(t, width, thickness);
                let t = advance + size * root_between(from, to, from_is_inside, look);
                if found(t) {
                    return;
                }
            }
            (from, from_is_inside) = (to, to_is_inside);
        }
    }
}

impl<R: Real> Intersect<R> for PreparedTorus<R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let mut nearest = None;
        self.each_crossing(ray, range, |t| {
            nearest = range.contains(t).then_some(t);
            nearest.is_some()
        });
        nearest
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        let tube = Vec3::new(self.minor, self.minor, self.minor);
        let reach = reach_across(self.axis) * self.major + tube;
        Some(Aabb::around(self.center, reach).padded(R::offset(self.magnitude)))
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        let everywhere = Interval { min: -R::FARTHEST, max: R::FARTHEST };
        let (mut spans, mut enters) = (Spans::NONE, None);
        self.each_crossing(ray, everywhere, |t| {
            enters = match enters {
                None => Some(t),
                Some(enters) => {
                    spans.push(enters, t);
                    None
                }
            };
            false
        });
        spans
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let from_center = ray.at(t) - self.center;
        let across = from_center - self.axis * from_center.dot(self.axis);
        let ring = across.normalized().unwrap_or(Vec3::ZERO) * self.major;
        let normal = (from_center - ring).normalized().unwrap_or(-ray.direction);
        let point = self.center + ring + normal * self.minor;
        Surface { point, normal, shading_normal: normal, magnitude: self.magnitude, part: 0 }
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        let from_center = surface.point - self.center;
        let height = from_center.dot(self.axis);
        let across = (from_center - self.axis * height).length();
        [uv::angle_about(self.axis, from_center), R::turn(height, across - self.major)]
    }
}

impl<R: Real> Silhouette<R> for PreparedTorus<R> {
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        let circle = Circle { center: self.center, axis: self.axis, radius: self.major };
        circle.hull(part, self.minor)
    }

    fn hulls(&self) -> usize {
        Circle::<R>::HULLS
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        normal_after_step(self, surface, step)
    }

    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let columns = tessellation.sides();
        let rows = (columns / 2).max(MIN_SEGMENTS);
        let (around, about_tube) = (Directions::<R>::new(columns), Directions::<R>::new(rows));
        let (first, second) = self.axis.around();
        let corner = |column: u16, row: u16| {
            let ((along, across), (out, up)) = (around.at(column), about_tube.at(row));
            let outward = first * along + second * across;
            let normal = outward * out + self.axis * up;
            (self.center + outward * self.major + normal * self.minor, normal)
        };
        Grid { columns, rows, is_closed: true }.each_facet(corner, visit);
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;

    /// Around the axis through (1, ·, 3), from 2 to 4 units away from it.
    const RING: Torus = Torus {
        center: Vec3::new(1.0, 2.0, 3.0),
        axis: Vec3::new(0.0, 2.0, 0.0),
        major_radius: 3.0,
        minor_radius: 1.0,
    };
    const LEFT: Vec3 = Vec3::new(-1.0, 0.0, 0.0);
    const DOWN: Vec3 = Vec3::new(0.0, -1.0, 0.0);

    #[test]
    fn met_four_times_along_its_plane() {
        let right = Vec3::new(9.0, 2.0, 3.0);
        assert_meets(RING, right, LEFT, 4.0, [1.0, 0.0, 0.0]);
        assert_meets(RING, right + LEFT * 5.0, LEFT, 1.0, [-1.0, 0.0, 0.0]);
        assert_meets(RING, right + LEFT * 8.0, LEFT, 2.0, [1.0, 0.0, 0.0]);
        assert_meets(RING, right + LEFT * 11.0, LEFT, 1.0, [-1.0, 0.0, 0.0]);
        assert_spans(RING, right, LEFT, &[(4.0, 6.0), (10.0, 12.0)]);
        assert_spans(RING, right + LEFT * 20.0, LEFT, &[(-16.0, -14.0), (-10.0, -8.0)]);
        // Half a minor radius above the circle, the tube is √3 wide.
        let half = 0.75f64.sqrt();
        let above = right - DOWN * 0.5;
        assert_spans(RING, above, LEFT, &[(5.0 - half, 5.0 + half), (11.0 - half, 11.0 + half)]);
        assert_meets(RING, above, LEFT, 5.0 - half, [half, 0.5, 0.0]);
        assert_misses(RING, right - DOWN * 1.01, LEFT);
    }

    #[test]
    fn met_twice_from_above_but_not_through_the_hole() {
        assert_meets(RING, Vec3::new(4.0, 9.0, 3.0), DOWN, 6.0, [0.0, 1.0, 0.0]);
        let half = 0.75f64.sqrt();
        assert_meets(RING, Vec3::new(3.5, 9.0, 3.0), DOWN, 7.0 - half, [-0.5, half, 0.0]);
        assert_spans(RING, Vec3::new(3.5, 9.0, 3.0), DOWN, &[(7.0 - half, 7.0 + half)]);
        for x in [1.0, 1.5, 2.99, 5.01, 9.0] {
            assert_misses(RING, Vec3::new(x, 9.0, 3.0), DOWN);
        }
    }

    #[test]
    fn met_along_a_line_that_touches_the_inner_circle() {
        // A little more than two units beside the axis, the line stays in the tube from end to end.
        let end = (16.0 - 2.001f64 * 2.001).sqrt();
        assert_spans(RING, Vec3::new(1.0 + 2.001, 2.0, 3.0), Vec3::new(0.0, 0.0, 1.0), &[(-end, end)]);
    }

    #[test]
    fn every_crossing_is_one_of_a_fine_search() {
        let mut random = Random(7);
        let mut met = 0;
        for minor_radius in [0.02, 0.3, 0.9, 0.999] {
            let torus =
                Torus { center: Vec3::ZERO, axis: random.direction(), major_radius: 1.0, minor_radius };
            let axis = torus.axis.to::<f64>().normalized().unwrap();
            let mut memory = Memory::new();
            let prepared = prepared::<_, f64>(torus, &mut memory).unwrap();
            for _ in 0..500 {
                let direction = random.direction().to::<f64>().normalized().unwrap();
                let ray = Ray { origin: random.vector().to::<f64>() * 2.0, direction };
                let distance = |t: f64| {
                    let p = ray.at(t);
                    let height = p.dot(axis);
                    let across = (p - axis * height).length() - 1.0;
                    across.hypot(height) - f64::from(minor_radius)
                };
                let spans = prepared.spans(&ray);
                let inside = |t: f64| spans.as_slice().iter().any(|part| t > part.min && t < part.max);
                for part in spans.as_slice() {
                    met += 1;
                    assert!(distance(part.min).abs() < 1e-7 && distance(part.max).abs() < 1e-7, "{part:?}");
                }
                for step in -400..400 {
                    let t = f64::from(step) / 50.0;
                    let distance = distance(t);
                    assert!(distance.abs() < 1e-7 || (distance < 0.0) == inside(t), "{torus:?} {ray:?} {t}");
                }
            }
        }
        assert!(met > 300, "{met}");
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            for minor in [0.02, 0.2, 0.45] {
                for center in [Vec3::ZERO, Vec3::new(3.0, -2.0, 1.0) * extent] {
                    let torus = Torus {
                        center,
                        axis: Vec3::new(0.3, 0.8, -0.4),
                        major_radius: 0.5 * extent,
                        minor_radius: minor * extent,
                    };
                    // Aim nearer at a thin torus: few rays meet it.
                    if minor > 0.1 {
                        assert_no_self_hits(torus, center, extent, 4_000);
                        assert_spans_are_met(torus, center, extent, 500);
                    } else {
                        assert_no_self_hits(torus, center, 0.5 * extent, 4_000);
                    }
                }
            }
        }
    }

    #[test]
    fn coordinates_are_two_angles() {
        assert_uv(RING, Vec3::new(9.0, 2.0, 2.99), LEFT, [0.01 / 4.0 / core::f64::consts::TAU, 0.0]);
        assert_uv(RING, Vec3::new(1.0, 9.0, 0.0), DOWN, [0.25, 0.25]);
        // From the middle outward: the inner side of the tube.
        assert_uv(RING, Vec3::new(1.0, 2.0, 3.0), LEFT, [0.5, 0.5]);
        assert_uv(RING, Vec3::new(1.0, -9.0, 6.0), -DOWN, [0.75, 0.75]);
    }

    #[test]
    fn bounds_hold_one_whose_axis_lies_almost_along_a_coordinate_axis() {
        let tilted = Torus {
            center: Vec3::ZERO,
            axis: Vec3::new(1.0, 2e-4, 0.0),
            major_radius: 3.0,
            minor_radius: 0.1,
        };
        let mut memory = Memory::new();
        let tilted = prepared::<_, f32>(tilted, &mut memory).unwrap();
        // Onto the side of the tube, where the circle leans by 3 · 2e-4.
        let ray = Ray { origin: Vec3::new(9.0, -3.0, 0.0), direction: LEFT };
        let t = tilted.intersect(&ray, Interval::AHEAD).unwrap();
        assert!((t - (8.9 - 3.0 * 2e-4)).abs() < 1e-5, "{t}");
        assert!(tilted.bounds().unwrap().contains(ray.at(t)));
    }

    #[test]
    fn bad_tori_are_refused() {
        assert_eq!(refusal(Torus { minor_radius: 0.0, ..RING }), Fault::RadiusNotPositive);
        assert_eq!(refusal(Torus { major_radius: -1.0, ..RING }), Fault::RadiusNotPositive);
        assert_eq!(refusal(Torus { minor_radius: 3.0, ..RING }), Fault::NoHole);
        assert_eq!(refusal(Torus { minor_radius: 1e-5, ..RING }), Fault::TooSmall);
        assert_eq!(refusal(Torus { axis: Vec3::ZERO, ..RING }), Fault::ZeroLength);
        assert_eq!(refusal(Torus { major_radius: f32::NAN, ..RING }), Fault::NotFinite);
    }
}
