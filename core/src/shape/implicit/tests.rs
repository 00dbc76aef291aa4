use super::super::testing::*;
use super::*;
use crate::math::Fixed;

/// The distance field of a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
struct BallField {
    center: Vec3,
    radius: f32,
}

#[derive(Clone, Copy, Debug)]
struct PreparedBallField<R> {
    center: Vec3<R>,
    radius: R,
}

impl DistanceField for BallField {
    type Prepared<R: Real> = PreparedBallField<R>;

    fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedBallField<R>, Fault> {
        crate::fault::check_radius(self.radius)?;
        let radius = scale.length(R::Setup::from_f32(self.radius));
        Ok(PreparedBallField { center: scale.point(self.center.to()), radius })
    }
}

impl<R: Real> Distance<R> for PreparedBallField<R> {
    fn distance(&self, point: Vec3<R>) -> R {
        (point - self.center).length() - self.radius
    }
}

/// Of a whole ball, and of one that the box cuts open.
#[test]
fn corners_of_facets_lie_on_the_surface() {
    fn check<R: Real>(half: f32) -> usize {
        let field = BallField { center: Vec3::new(0.1, 0.2, 0.3), radius: 1.0 };
        let corner = Vec3::new(half, 1.5, 1.5);
        let ball = Implicit { field, min: -corner, max: corner };
        let mut memory = Memory::new();
        let scale = Scale::new::<R>(ball.extent(), Vec3::ZERO);
        let prepared: PreparedImplicit<_, R> = ball.prepare(scale, &mut Arena::new(memory.lend())).unwrap();
        let tessellation = Tessellation { segments: 32, eye: Vec3::ZERO };
        let mut count = 0;
        prepared.each_facet(&tessellation, &mut |facet| {
            count += 1;
            for (corner, normal) in facet.corners.into_iter().zip(facet.normals) {
                let outward = corner.to_f32() * (1.0 / scale.to_f32()) - field.center;
                assert!((outward.length() - 1.0).abs() < 1e-4, "{corner:?}");
                assert!((outward - normal.to_f32()).length() < 1e-3, "{corner:?}: {normal:?}");
            }
        });
        count
    }
    for (whole, cut) in [
        (check::<f32>(1.5), check::<f32>(0.5)),
        (check::<f64>(1.5), check::<f64>(0.5)),
        (check::<Fixed>(1.5), check::<Fixed>(0.5)),
    ] {
        assert!(whole > 1000 && cut > 500, "{whole}, {cut}");
    }
}

/// The distance field of a box with round edges: all points no farther than `rounding` from the box.
#[derive(Clone, Copy, Debug, PartialEq)]
struct BlockField {
    center: Vec3,
    half: Vec3,
    rounding: f32,
}

#[derive(Clone, Copy, Debug)]
struct PreparedBlockField<R> {
    center: Vec3<R>,
    half: Vec3<R>,
    rounding: R,
}

impl DistanceField for BlockField {
    type Prepared<R: Real> = PreparedBlockField<R>;

    fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedBlockField<R>, Fault> {
        let rounding = scale.length(R::Setup::from_f32(self.rounding));
        Ok(PreparedBlockField {
            center: scale.point(self.center.to()),
            half: scale.point(self.half.to()),
            rounding,
        })
    }
}

impl<R: Real> Distance<R> for PreparedBlockField<R> {
    fn distance(&self, point: Vec3<R>) -> R {
        let Vec3 { x, y, z } = point - self.center;
        let beyond = Vec3::new(x.abs() - self.half.x, y.abs() - self.half.y, z.abs() - self.half.z);
        let most = beyond.x.larger(beyond.y).larger(beyond.z);
        let positive = |x: R| x.larger(R::ZERO);
        let outside = Vec3::new(positive(beyond.x), positive(beyond.y), positive(beyond.z));
        (if most < R::ZERO { most } else { outside.length() }) - self.rounding
    }
}

const CENTER: Vec3 = Vec3::new(1.0, 2.0, 3.0);
const DOWN: Vec3 = Vec3::new(0.0, 0.0, -1.0);

fn ball(center: Vec3, radius: f32) -> Implicit<BallField> {
    let reach = Vec3::new(radius, radius, radius) * 1.25;
    Implicit { field: BallField { center, radius }, min: center - reach, max: center + reach }
}

fn block(center: Vec3, half: Vec3) -> Implicit<BlockField> {
    Implicit {
        field: BlockField { center, half, rounding: 0.0 },
        min: center - half * 1.25,
        max: center + half * 1.25,
    }
}

#[test]
fn met_from_outside_and_from_inside() {
    let ball = ball(CENTER, 2.0);
    assert_meets(ball, Vec3::new(1.0, 2.0, 10.0), DOWN, 5.0, [0.0, 0.0, 1.0]);
    assert_meets(ball, Vec3::new(1.0, 2.0, 4.5), DOWN, 3.5, [0.0, 0.0, -1.0]);
    assert_misses(ball, Vec3::new(1.0, 2.0, 10.0), -DOWN);
    assert_misses(ball, Vec3::new(1.0, 4.01, 10.0), DOWN);
    assert_uv(ball, Vec3::new(1.0, 2.0, 10.0), DOWN, [0.75, 0.5]);
}

#[test]
fn open_where_the_box_ends() {
    let bowl = Implicit { max: Vec3::new(9.0, 9.0, 3.0), ..ball(CENTER, 2.0) };
    assert_meets(bowl, Vec3::new(1.0, 2.0, 10.0), DOWN, 9.0, [0.0, 0.0, -1.0]);
}

/// Fires rays at both shapes: they must meet them in the same places, and, except near an edge, with the same
/// normals.
fn assert_same<R: Real>(one: impl Geometry, other: impl Geometry) {
    let (mut memory, mut others) = (Memory::new(), Memory::new());
    let scale = Scale::new::<R>(one.extent().union(other.extent()), CENTER * 2.0);
    let one = one.prepare::<R>(scale, &mut Arena::new(memory.lend())).unwrap();
    let other = other.prepare::<R>(scale, &mut Arena::new(others.lend())).unwrap();
    let tolerance = R::from_f32(2e-5 * scale.to_f32());
    let (mut random, mut met, mut turned, mut lost) = (Random(9), 0, 0, 0);
    for _ in 0..3_000 {
        let origin = CENTER + random.direction() * 6.0;
        let Some(direction) = (CENTER + random.vector() * 2.0 - origin).normalized() else { continue };
        let ray = Ray { origin: scale.point(origin.to()), direction: Vec3::from_setup(direction.to()) };
        let hits = (one.intersect(&ray, Interval::AHEAD), other.intersect(&ray, Interval::AHEAD));
        match hits {
            (Some(t), Some(same)) => {
                met += 1;
                // For a ray that grazes a surface, the same distance from the surface is a longer way along
                // the ray.
                let (surface, normal) = (one.surface(&ray, t), other.surface(&ray, same).normal);
                let slope = normal.dot(ray.direction).abs().larger(R::from_f32(0.02));
                assert!((t - same).abs() * slope < tolerance, "{ray:?}: {t:?}, not {same:?}");
                turned += usize::from((surface.normal - normal).magnitude() > R::from_f32(1e-3));
            }
            (None, None) => {}
            // Next to an outline or an edge, less than a step may be inside.
            _ => lost += 1,
        }
    }
    assert!(met > 500 && turned < met / 20 && lost < met / 200, "{met} {turned} {lost}");
}

#[test]
fn the_field_of_a_shape_is_the_shape() {
    let half = Vec3::new(1.0, 2.0, 0.5);
    let cuboid = crate::shape::Cuboid::aligned(CENTER - half, CENTER + half);
    let sphere = crate::shape::Sphere::new(CENTER, 2.0);
    assert_same::<f32>(block(CENTER, half), cuboid);
    assert_same::<f64>(block(CENTER, half), cuboid);
    assert_same::<Fixed>(block(CENTER, half), cuboid);
    assert_same::<f32>(ball(CENTER, 2.0), sphere);
    assert_same::<f64>(ball(CENTER, 2.0), sphere);
    assert_same::<Fixed>(ball(CENTER, 2.0), sphere);
}

#[test]
fn spawned_rays_do_not_meet_their_own_surface() {
    for extent in EXTENTS {
        for center in [Vec3::ZERO, Vec3::new(3.0, -2.0, 1.0) * extent] {
            assert_no_self_hits(ball(center, extent), center, extent, 5_000);
            let half = Vec3::new(0.5, 1.0, 0.75) * extent;
            // Normals next to a sharp edge are between those of its faces.
            let sharp = block(center, half);
            let pebble = Implicit { field: BlockField { rounding: 0.1 * extent, ..sharp.field }, ..sharp };
            assert_no_self_hits(pebble, center, extent, 5_000);
        }
    }
}

#[test]
fn bad_boxes_are_refused() {
    let ball = ball(CENTER, 2.0);
    assert_eq!(refusal(Implicit { min: ball.max, ..ball }), Fault::NoVolume);
    assert_eq!(refusal(Implicit { max: Vec3::new(f32::NAN, 9.0, 9.0), ..ball }), Fault::NotFinite);
    assert_eq!(refusal(Implicit { min: Vec3::new(-2e6, 0.0, 0.0), ..ball }), Fault::TooFar);
    assert_eq!(
        refusal(Implicit { field: BallField { radius: 0.0, ..ball.field }, ..ball }),
        Fault::RadiusNotPositive
    );
}
