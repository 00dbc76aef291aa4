use std::sync::atomic::{AtomicUsize, Ordering};

use super::super::testing::*;
use super::super::{Cone, Csg, CsgStep, Cuboid, Cylinder, Hull, Mesh, Polygon, Silhouette, Sphere, Torus};
use super::*;
use crate::math::{Fixed, Interval, Ray, Rotation, Vec3};
use crate::surface::Surface;

const DOWN: Vec3 = Vec3::new(0.0, 0.0, -1.0);
const QUARTER: f32 = core::f32::consts::FRAC_PI_2;

/// A ball beside the origin of the model.
static BALL: Sphere = Sphere::new(Vec3::new(1.0, 0.0, 0.0), 0.5);

/// Turned about z from x to y, then moved.
static ASIDE: [Pose; 1] = [Pose::at(Vec3::new(3.0, 0.0, 1.0)).turned(Vec3::new(0.0, 0.0, QUARTER))];

/// Random places within `extent`, turned at random.
fn poses<const N: usize>(center: Vec3, extent: f32) -> [Pose; N] {
    let mut random = Random(2);
    core::array::from_fn(|_| Pose::at(center + random.vector() * extent).turned(random.vector() * 3.0))
}

#[test]
fn turned_about_the_origin_of_the_model_enlarged_and_moved() {
    // The ball is around (3, 2, 1), with a radius of 1.
    let ball = Instances::new(&BALL, &ASIDE).sized(2.0);
    assert_meets(ball, Vec3::new(3.0, 2.0, 10.0), DOWN, 8.0, [0.0, 0.0, 1.0]);
    assert_meets(ball, Vec3::new(3.0, 2.0, 1.5), DOWN, 1.5, [0.0, 0.0, -1.0]);
    assert_meets(
        ball,
        Vec3::new(9.0, 2.5, 1.0),
        Vec3::new(-1.0, 0.0, 0.0),
        6.0 - 0.75f64.sqrt(),
        [0.75f64.sqrt(), 0.5, 0.0],
    );
    assert_misses(ball, Vec3::new(5.0, 0.0, 10.0), DOWN);
    assert_misses(ball, Vec3::new(3.0, 3.01, 10.0), DOWN);
    // Longitude of the model: from its x axis, which was turned to y, toward -z.
    assert_uv(ball, Vec3::new(3.0, 2.0, 10.0), DOWN, [0.75, 0.5]);
    assert_uv(ball, Vec3::new(3.0, 9.0, 1.0), Vec3::new(0.0, -1.0, 0.0), [0.0, 0.5]);
}

#[test]
fn the_nearest_of_several_is_met() {
    let places = [2.0, 5.0, -1.0].map(|z| Pose::at(Vec3::new(-1.0, 0.0, z)));
    let balls = Instances::new(&BALL, &places);
    assert_meets(balls, Vec3::new(0.0, 0.0, 10.0), DOWN, 4.5, [0.0, 0.0, 1.0]);
    assert_meets(balls, Vec3::new(0.0, 0.0, 4.0), DOWN, 1.5, [0.0, 0.0, 1.0]);
    assert_meets(balls, Vec3::new(0.0, 0.0, 0.0), DOWN, 0.5, [0.0, 0.0, 1.0]);
}

#[test]
fn one_alone_is_solid_if_its_model_is() {
    let ball = Instances::new(&BALL, &ASIDE).sized(2.0);
    assert_spans(ball, Vec3::new(3.0, 2.0, 10.0), DOWN, &[(8.0, 10.0)]);
    assert_spans(ball, Vec3::new(3.0, 4.0, 10.0), DOWN, &[]);
    let torus =
        Torus { center: Vec3::ZERO, axis: Vec3::new(1.0, 2.0, 0.5), major_radius: 1.0, minor_radius: 0.25 };
    let [pose] = poses(Vec3::ZERO, 1.0);
    assert_spans_are_met(Instances::new(&torus, &[pose]).sized(0.75), pose.origin, 1.0, 2_000);
    assert!(!Instances::new(&BALL, &[pose, pose]).is_solid());
}

#[test]
fn parts_of_a_solid_that_is_made_of_others() {
    // A hole through the ball, from left to right.
    let hole = Cylinder {
        base: Vec3::new(1.0, -2.0, 0.0),
        top: Vec3::new(1.0, 2.0, 0.0),
        radius: 0.25,
        capped: true,
    };
    let ball = BeadPart::Ball(BALL);
    let hole = BeadPart::Hole(hole);
    let steps = [&ball, &hole].map(|model| CsgStep::Solid(Instances::new(model, &ASIDE).sized(2.0)));
    let [ball, hole] = steps;
    let bead = [ball, hole, CsgStep::Difference];
    let bead = Csg::new(&bead);
    assert_misses(bead, Vec3::new(9.0, 2.0, 1.0), Vec3::new(-1.0, 0.0, 0.0));
    assert_meets(bead, Vec3::new(3.0, 2.0, 1.0), DOWN, 0.5, [0.0, 0.0, 1.0]);
    let origin = Vec3::new(3.0, 2.75, 10.0);
    assert_meets(bead, origin, DOWN, 9.0 - 0.4375f64.sqrt(), [0.0, 0.75, 0.4375f64.sqrt()]);
}

crate::shape_set! {
    /// The parts of a bead.
    enum BeadPart;
    /// [`BeadPart`], prepared.
    enum PreparedBeadPart {
        /// The ball.
        Ball(Sphere),
        /// Its hole.
        Hole(Cylinder),
    }
}

/// A house, as a mesh: a cube with a gable.
const HOUSE: [Vec3; 10] = [
    Vec3::new(-1.0, 0.0, -1.0),
    Vec3::new(1.0, 0.0, -1.0),
    Vec3::new(-1.0, 1.0, -1.0),
    Vec3::new(1.0, 1.0, -1.0),
    Vec3::new(-1.0, 0.0, 1.0),
    Vec3::new(1.0, 0.0, 1.0),
    Vec3::new(-1.0, 1.0, 1.0),
    Vec3::new(1.0, 1.0, 1.0),
    Vec3::new(0.0, 1.75, -1.0),
    Vec3::new(0.0, 1.75, 1.0),
];

static WALLS: [[u16; 3]; 16] = [
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
    [0, 1, 5],
    [0, 5, 4],
    [2, 8, 3],
    [6, 7, 9],
    [2, 6, 9],
    [2, 9, 8],
    [3, 8, 9],
    [3, 9, 7],
];

const fn house(vertices: &[Vec3]) -> Mesh<'_> {
    Mesh::new(vertices, &WALLS)
}

/// Rays from all around must meet both shapes in the same places, with the same normals.
fn assert_same<R: Real>(one: impl Geometry, other: impl Geometry) {
    let lent = || [core::mem::MaybeUninit::uninit(); 16384];
    let (mut memory, mut others) = (lent(), lent());
    let scale = Scale::new::<R>(one.extent().union(other.extent()), Vec3::new(9.0, 0.0, 0.0));
    let one = one.prepare::<R>(scale, &mut Arena::new(&mut memory)).unwrap();
    let other = other.prepare::<R>(scale, &mut Arena::new(&mut others)).unwrap();
    let near = R::from_f32(2e-5 * scale.to_f32());
    let (mut random, mut met, mut lost) = (Random(4), 0, 0);
    for _ in 0..5_000 {
        let origin = random.direction() * 8.0;
        let Some(direction) = (random.vector() * 3.0 - origin).to::<R::Setup>().normalized() else {
            continue;
        };
        let ray = Ray { origin: scale.point(origin.to()), direction: Vec3::from_setup(direction) };
        let (t, same) = match (one.intersect(&ray, Interval::AHEAD), other.intersect(&ray, Interval::AHEAD)) {
            (Some(t), Some(same)) => (t, same),
            (None, None) => continue,
            // A ray next to an outline.
            _ => {
                lost += 1;
                continue;
            }
        };
        let (surface, expected) = (one.surface(&ray, t), other.surface(&ray, same));
        // For a ray that grazes a face, the same distance from the face is a longer way along the ray.
        let slope = expected.normal.dot(ray.direction).abs();
        let is_turned = (surface.normal - expected.normal).magnitude() > R::from_f32(1e-4);
        // Next to an edge, it may be one face or the other.
        assert!(is_turned || (t - same).abs() * slope < near, "{ray:?}: {t:?}, not {same:?}");
        assert!((surface.point - ray.at(t)).magnitude() < near, "{surface:?} of {ray:?} at {t:?}");
        met += usize::from(!is_turned);
    }
    assert!(met > 150 && lost < 3, "{met} {lost}");
}

#[test]
fn an_instance_is_the_mesh_with_its_vertices_there() {
    fn check<R: Real>() {
        let places: [Pose; 7] = poses(Vec3::ZERO, 2.0);
        for count in [1, 2, 7] {
            let places = &places[..count];
            let vertices: Vec<Vec3> = places
                .iter()
                .flat_map(|pose| {
                    let rotation = Rotation::<f32>::new(pose.rotation);
                    HOUSE.map(|vertex| rotation.turn(vertex * 0.5) + pose.origin)
                })
                .collect();
            let triangles: Vec<[u16; 3]> = (0..count as u16)
                .flat_map(|copy| WALLS.map(|corners| corners.map(|corner| corner + copy * 10)))
                .collect();
            let whole = Mesh::new(&vertices, &triangles);
            let model = Model::Mesh(house(&HOUSE));
            let instances = Instances::new(&model, places).sized(0.5);
            assert_same::<R>(instances, whole);
        }
    }
    check::<f32>();
    check::<f64>();
    check::<Fixed>();
}

#[test]
fn parts_tell_the_instance_and_the_part_of_the_model() {
    let cube = Cuboid::aligned(Vec3::new(-0.5, -0.5, -0.5), Vec3::new(0.5, 0.5, 0.5));
    let places =
        [Pose::at(Vec3::ZERO), Pose::at(Vec3::new(0.0, 3.0, 0.0)).turned(Vec3::new(QUARTER, 0.0, 0.0))];
    let mut memory = Memory::new();
    let prepared = prepared::<_, f64>(Instances::new(&cube, &places), &mut memory).unwrap();
    let part = |y: f64| {
        let ray = Ray { origin: Vec3::new(0.0, y, 5.0), direction: DOWN.to() };
        prepared.surface(&ray, prepared.intersect(&ray, Interval::AHEAD).unwrap()).part
    };
    // The ray meets the face toward z. In the second instance, that is the model's face toward y.
    assert_eq!((part(0.0), part(3.0)), (5, 1 << 16 | 3));
}

#[test]
fn the_hull_is_turned_too() {
    let top = Vec3::new(0.0, 4.0, 0.0);
    let pole = Cylinder { base: Vec3::ZERO, top, radius: 0.25, capped: true };
    let mut memory = Memory::new();
    let prepared = prepared::<_, f64>(Instances::new(&pole, &ASIDE), &mut memory).unwrap();
    let hull = prepared.hull(0).unwrap();
    let top = hull.center + hull.axes[0];
    assert!((top - Vec3::new(-1.0, 0.0, 1.0)).magnitude() < 1e-6 && hull.radius == 0.25);
    assert_eq!(prepared.hull(1), None);
}

/// A solid that counts the calls of its method `hull`.
#[derive(Clone, Copy, Debug)]
struct Counted(&'static AtomicUsize);

impl Geometry for Counted {
    type Prepared<'m, R: Real> = Self;

    fn extent(&self) -> Extent {
        Extent::solid(1.0)
    }

    fn is_solid(&self) -> bool {
        true
    }

    fn prepare<'m, R: Real>(&self, _: Scale, _: &mut Arena<'m>) -> Result<Self, Fault>
    where
        Self: 'm,
    {
        Ok(*self)
    }
}

impl<R: Real> Intersect<R> for Counted {
    fn intersect(&self, _: &Ray<R>, _: Interval<R>) -> Option<R> {
        None
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        Some(Aabb::point(Vec3::ZERO))
    }

    fn surface(&self, _: &Ray<R>, _: R) -> Surface<R> {
        unreachable!("it is never met")
    }

    fn uv(&self, _: &Surface<R>, _: Scale) -> [R; 2] {
        [R::ZERO; 2]
    }
}

impl<R: Real> Silhouette<R> for Counted {
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        self.0.fetch_add(1, Ordering::Relaxed);
        (part < 17).then(|| Hull::ball(Vec3::ZERO, R::ONE))
    }

    fn hulls(&self) -> usize {
        17
    }
}

/// Hulls are listed for each ray of realtime quality: pictures of instances of rings took seconds.
#[test]
fn each_hull_is_worked_out_once_when_all_are_listed() {
    static ASKED: AtomicUsize = AtomicUsize::new(0);
    let solid = CsgStep::Solid(Counted(&ASKED));
    let steps = [solid, solid, CsgStep::Union, solid, CsgStep::Union];
    let (three, places) = (Csg::new(&steps), poses::<20>(Vec3::ZERO, 1.0));
    let mut memory = Memory::new();
    let prepared = prepared::<_, f32>(Instances::new(&three, &places), &mut memory).unwrap();
    let listed = (0..).map_while(|part| prepared.hull(part)).count();
    // A box around all, and for each place a box and three times 17.
    assert_eq!(listed, 1 + 20 * (1 + 3 * 17));
    assert_eq!(ASKED.load(Ordering::Relaxed), 20 * 3 * 17);
}

#[test]
fn the_tip_is_turned_too() {
    let top = Vec3::new(0.0, 4.0, 0.0);
    let spire = Cone { base: Vec3::ZERO, base_radius: 0.25, top, top_radius: 0.0, capped: true };
    let mut memory = Memory::new();
    let prepared = prepared::<_, f64>(Instances::new(&spire, &ASIDE), &mut memory).unwrap();
    let tip = prepared.tip(0).unwrap();
    assert!((tip.apex - Vec3::new(-1.0, 0.0, 1.0)).magnitude() < 1e-6 && tip.radius == 0.25);
    assert_eq!(prepared.tip(1), None);
}

#[test]
fn a_place_takes_no_more_than_100_bytes() {
    fn check<R: Real>(most: usize) {
        let model = Model::Mesh(house(&HOUSE));
        let places: [Pose; 16] = poses(Vec3::ZERO, 3.0);
        let bytes = |count: usize| Instances::new(&model, &places[..count]).const_bytes::<R>();
        assert!(bytes(4) <= bytes(1) + 3 * 50 && bytes(16) <= bytes(1) + 16 * most, "{}", bytes(16));
        for count in [1, 4, 16] {
            let instances = Instances::new(&model, &places[..count]);
            let mut memory = vec![core::mem::MaybeUninit::uninit(); instances.bytes::<R>()];
            let scale = Scale::new::<R>(instances.extent(), Vec3::ZERO);
            assert!(instances.prepare::<R>(scale, &mut Arena::new(&mut memory)).is_ok());
        }
    }
    check::<f32>(100);
    check::<Fixed>(100);
}

#[test]
fn spawned_rays_do_not_meet_their_own_surface() {
    for extent in EXTENTS {
        for center in [Vec3::ZERO, Vec3::new(3.0, -2.0, 1.0) * extent] {
            let [pose] = poses(center, 0.1 * extent);
            assert_no_self_hits(Instances::new(&BALL, &[pose]).sized(extent), center, extent, 4_000);
            let model = Model::Mesh(house(&HOUSE));
            let house = Instances::new(&model, core::slice::from_ref(&pose)).sized(0.5 * extent);
            assert_no_self_hits(house, center, extent, 4_000);
            // Far from the place where the model was described.
            let far = Sphere::new(Vec3::new(0.0, 4.0, 0.0), 1.0);
            let origin = center - Rotation::<f32>::new(pose.rotation).turn(far.center * (0.5 * extent));
            let there = [Pose { origin, ..pose }];
            assert_no_self_hits(Instances::new(&far, &there).sized(0.5 * extent), center, extent, 2_000);
        }
    }
}

#[test]
fn bad_instances_are_refused() {
    let at = |origin| [Pose::at(origin)];
    let refused = |size: f32, origin: Vec3| refusal(Instances::new(&BALL, &at(origin)).sized(size));
    assert_eq!(refusal(Instances::new(&BALL, &[])), Fault::NoPoses);
    for size in [0.0, -1.0, 1e-7] {
        assert_eq!(refused(size, Vec3::ZERO), Fault::InstanceSize);
    }
    assert_eq!(refused(f32::NAN, Vec3::ZERO), Fault::NotFinite);
    assert_eq!(refused(1.0, Vec3::new(0.0, f32::INFINITY, 0.0)), Fault::NotFinite);
    assert_eq!(refused(1.0, Vec3::new(0.0, 2e6, 0.0)), Fault::TooFar);
    // The model would reach too far.
    assert_eq!(refused(2e5, Vec3::new(9e5, 0.0, 0.0)), Fault::TooFar);
    let turned = [Pose::at(Vec3::ZERO).turned(Vec3::new(f32::NAN, 0.0, 0.0))];
    assert_eq!(refusal(Instances::new(&BALL, &turned)), Fault::NotFinite);
    let point = Sphere::new(Vec3::ZERO, 0.0);
    assert_eq!(refusal(Instances::new(&point, &ASIDE)), Fault::RadiusNotPositive);
}

#[test]
fn rays_whose_coordinates_wrap_meet_no_model() {
    // Fixed point: rays from the farthest points that there are, transformed to the model.
    let model = Model::Mesh(house(&HOUSE));
    let flat = [Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 0.0, -1.0), Vec3::new(0.0, 1.0, 1.0)];
    let polygon = Model::Polygon(Polygon::new(&flat));
    let (mut random, mut met) = (Random(8), 0);
    for round in 0..40 {
        let pose = [Pose::at(random.vector()).turned(random.vector() * 3.0)];
        let instances = Instances::new(if round % 2 == 0 { &model } else { &polygon }, &pose);
        let scale = Scale::new::<Fixed>(instances.extent(), Vec3::ZERO);
        let (mut memory, mut others) = (Memory::new(), Memory::new());
        let fixed = instances.prepare::<Fixed>(scale, &mut Arena::new(memory.lend())).unwrap();
        let double = instances.prepare::<f64>(scale, &mut Arena::new(others.lend())).unwrap();
        for i in 0..5_000 {
            let corner = random.vector();
            let signs = [corner.x, corner.y, corner.z].map(|x| 58.9f32.copysign(x));
            let origin = if i % 2 == 0 { Vec3::new(signs[0], signs[1], signs[2]) } else { corner * 58.9 };
            let toward = if i % 4 < 2 { random.vector() - origin } else { random.vector() };
            let Some(direction) = toward.to::<f32>().normalized() else { continue };
            let ray = Ray { origin: Vec3::from_setup(origin), direction: Vec3::from_setup(direction) };
            // Of unit length to all its digits.
            let exact: Vec3<f64> = ray.direction.to_setup().to();
            let exact = Ray { origin: ray.origin.to_setup().to(), direction: exact.unit_and_length().0 };
            let reached = Interval { min: 0.0, max: 59.0 };
            if fixed.intersect(&ray, Interval::AHEAD).is_some() {
                assert!(double.intersect(&exact, reached).is_some(), "{ray:?}");
                met += 1;
            }
        }
    }
    assert!(met > 50, "{met}");
}
