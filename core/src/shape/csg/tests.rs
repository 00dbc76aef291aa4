use super::super::testing::*;
use super::super::{Cuboid, Cylinder, Plane, Sphere, Torus};
use super::*;
use crate::math::Fixed;

const RIGHT: Vec3 = Vec3::new(1.0, 0.0, 0.0);
const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);

const fn ball(x: f32, radius: f32) -> CsgStep {
    CsgStep::Solid(Solid::Sphere(Sphere::new(Vec3::new(x, 0.0, 0.0), radius)))
}

const fn pillar(radius: f32, bottom: f32, top: f32) -> CsgStep {
    let (base, top) = (Vec3::new(0.0, bottom, 0.0), Vec3::new(0.0, top, 0.0));
    CsgStep::Solid(Solid::Cylinder(Cylinder { base, top, radius, capped: true }))
}

const fn behind(point: Vec3, normal: Vec3) -> CsgStep {
    CsgStep::Solid(Solid::Plane(Plane::new(point, normal)))
}

/// The distances at which the line from `origin` meets the solid, in order, and the cosines between the line
/// and the normals there.
fn meetings<R: Real>(csg: Csg, origin: Vec3, toward: Vec3) -> Vec<(f64, f64)> {
    let mut memory = Memory::new();
    let scale = Scale::new::<R>(csg.extent(), origin);
    let prepared: PreparedCsg<'_, R, _> = csg.prepare(scale, &mut Arena::new(memory.lend())).unwrap();
    let direction = Vec3::from_setup(toward.to::<R::Setup>().normalized().unwrap());
    let ray = Ray { origin: scale.point(origin.to()), direction };
    let mut range = Interval::AHEAD;
    let mut meetings = vec![];
    while let Some(t) = prepared.intersect(&ray, range) {
        let along = prepared.surface(&ray, t).normal.dot(direction);
        meetings.push((f64::from(t.to_f32() / scale.to_f32()), f64::from(along.to_f32())));
        range.min = t;
    }
    meetings
}

/// The line meets the solid at these distances and nowhere else, with normals that alternately point against
/// the line and along it.
#[track_caller]
fn assert_surfaces(steps: &[CsgStep], origin: Vec3, toward: Vec3, expected: &[f64]) {
    let csg = Csg::new(steps);
    for meetings in [
        meetings::<f32>(csg, origin, toward),
        meetings::<f64>(csg, origin, toward),
        meetings::<Fixed>(csg, origin, toward),
    ] {
        let near =
            meetings.iter().zip(expected).all(|((t, _), expected)| (t - expected).abs() < 2e-5 * t.max(1.0));
        assert!(near && meetings.len() == expected.len(), "{meetings:?}, not {expected:?}");
        // At the last one, the line leaves the solid.
        let outward = meetings.iter().rev().enumerate().all(|(i, (_, along))| (*along > 0.0) == (i % 2 == 0));
        assert!(outward, "{meetings:?}");
    }
}

#[test]
fn a_lens_is_what_two_balls_have_in_common() {
    let lens = [ball(-1.0, 2.0), ball(1.0, 2.0), CsgStep::Intersection];
    let csg = Csg::new(&lens);
    assert_meets(csg, RIGHT * 5.0, -RIGHT, 4.0, [1.0, 0.0, 0.0]);
    assert_meets(csg, Vec3::ZERO, -RIGHT, 1.0, [-1.0, 0.0, 0.0]);
    let half = 3f64.sqrt() - 1.0;
    assert_surfaces(&lens, RIGHT * 5.0 + UP, -RIGHT, &[5.0 - half, 5.0 + half]);
    assert_surfaces(&lens, UP * 5.0, -UP, &[5.0 - 3f64.sqrt(), 5.0 + 3f64.sqrt()]);
    assert_surfaces(&lens, RIGHT * 5.0 + UP * 1.8, -RIGHT, &[]);
    // The normal of the ball that the surface belongs to.
    let x = 3f64.sqrt() - 1.0;
    assert_meets(csg, RIGHT * 5.0 + UP, -RIGHT, 5.0 - x, [(x + 1.0) / 2.0, 0.5, 0.0]);
}

#[test]
fn a_bead_has_a_hole() {
    let bead = [ball(0.0, 1.0), pillar(0.4, -2.0, 2.0), CsgStep::Difference];
    let csg = Csg::new(&bead);
    assert_misses(csg, UP * 5.0, -UP);
    assert_misses(csg, UP * 5.0 + RIGHT * 0.39, -UP);
    assert_meets(csg, RIGHT * 5.0, -RIGHT, 4.0, [1.0, 0.0, 0.0]);
    // The wall of the hole faces the axis.
    assert_meets(csg, Vec3::ZERO, RIGHT, 0.4, [-1.0, 0.0, 0.0]);
    assert_surfaces(&bead, RIGHT * 5.0, -RIGHT, &[4.0, 4.6, 5.4, 6.0]);
    let height = (1.0 - 0.5f64 * 0.5).sqrt();
    assert_surfaces(&bead, Vec3::new(0.5, 5.0, 0.0), -UP, &[5.0 - height, 5.0 + height]);
}

#[test]
fn a_union_has_no_walls_inside() {
    let pair = [ball(-1.0, 1.5), ball(1.0, 1.5), CsgStep::Union];
    assert_surfaces(&pair, RIGHT * 5.0, -RIGHT, &[2.5, 7.5]);
    assert_surfaces(&pair, Vec3::ZERO, RIGHT, &[2.5]);
    let apart = [ball(-3.0, 1.0), ball(3.0, 1.0), CsgStep::Union];
    assert_surfaces(&apart, RIGHT * 5.0, -RIGHT, &[1.0, 3.0, 7.0, 9.0]);
    assert_surfaces(&apart, Vec3::ZERO, UP, &[]);
}

#[test]
fn a_solid_that_is_subtracted_twice_stays() {
    // A shell around a ball.
    let onion = [ball(0.0, 3.0), ball(0.0, 2.0), ball(0.0, 1.0), CsgStep::Difference, CsgStep::Difference];
    assert_surfaces(&onion, RIGHT * 5.0, -RIGHT, &[2.0, 3.0, 4.0, 6.0, 7.0, 8.0]);
    assert_meets(Csg::new(&onion), RIGHT * 2.5, -RIGHT, 0.5, [-1.0, 0.0, 0.0]);
    assert_meets(Csg::new(&onion), RIGHT * 1.5, -RIGHT, 0.5, [1.0, 0.0, 0.0]);
    // In the other order the ball is subtracted from the cavity, which changes nothing.
    let shell = [ball(0.0, 3.0), ball(0.0, 2.0), CsgStep::Difference, ball(0.0, 1.0), CsgStep::Difference];
    assert_surfaces(&shell, RIGHT * 5.0, -RIGHT, &[2.0, 3.0, 7.0, 8.0]);
}

#[test]
fn half_spaces_cut() {
    let dome = [ball(0.0, 2.0), behind(Vec3::ZERO, -UP), CsgStep::Intersection];
    assert_surfaces(&dome, UP * 5.0, -UP, &[3.0, 5.0]);
    assert_meets(Csg::new(&dome), -UP * 5.0, UP, 5.0, [0.0, -1.0, 0.0]);
    assert_surfaces(&dome, RIGHT * 5.0 - UP, -RIGHT, &[]);
    // Ground with a dent has no bounds, and no end below.
    let dent = [behind(Vec3::ZERO, UP), ball(0.0, 2.0), CsgStep::Difference];
    assert_eq!(meetings::<f32>(Csg::new(&dent), UP * 5.0, -UP).len(), 1);
    assert_meets(Csg::new(&dent), UP * 5.0 + RIGHT * 3.0, -UP, 5.0, [0.0, 1.0, 0.0]);
    assert_meets(Csg::new(&dent), UP * 5.0, -UP, 7.0, [0.0, 1.0, 0.0]);
    let mut memory = Memory::new();
    assert_eq!(prepared::<_, f32>(Csg::new(&dent), &mut memory).unwrap().bounds(), None);
}

#[test]
fn a_torus_that_is_cut_open_is_met_more_than_twice() {
    let ring = Torus { center: Vec3::ZERO, axis: UP, major_radius: 3.0, minor_radius: 1.0 };
    let groove = Torus { minor_radius: 0.5, ..ring };
    let pipe =
        [CsgStep::Solid(Solid::Torus(ring)), CsgStep::Solid(Solid::Torus(groove)), CsgStep::Difference];
    let meetings = [1.0, 1.5, 2.5, 3.0, 7.0, 7.5, 8.5, 9.0];
    assert_surfaces(&pipe, RIGHT * 5.0, -RIGHT, &meetings);
}

#[test]
fn bounds_are_those_of_the_combined_solid() {
    let bounds = |steps: &[CsgStep]| {
        let mut memory = Memory::new();
        prepared::<_, f32>(Csg::new(steps), &mut memory).unwrap().bounds().unwrap()
    };
    let near = |a: Vec3, b: Vec3| (a - b).magnitude() < 1e-3;
    let lens = bounds(&[ball(-1.0, 2.0), ball(1.0, 2.0), CsgStep::Intersection]);
    assert!(
        near(lens.min, Vec3::new(-1.0, -2.0, -2.0)) && near(lens.max, Vec3::new(1.0, 2.0, 2.0)),
        "{lens:?}"
    );
    let cut = bounds(&[ball(-1.0, 2.0), ball(1.0, 9.0), CsgStep::Difference]);
    assert!(near(cut.min, Vec3::new(-3.0, -2.0, -2.0)) && near(cut.max, Vec3::new(1.0, 2.0, 2.0)), "{cut:?}");
    let pair = bounds(&[ball(-1.0, 2.0), ball(1.0, 2.0), CsgStep::Union]);
    assert!(
        near(pair.min, Vec3::new(-3.0, -2.0, -2.0)) && near(pair.max, Vec3::new(3.0, 2.0, 2.0)),
        "{pair:?}"
    );
    // Balls that do not overlap leave a box without volume, and no surface.
    let nothing = [ball(-3.0, 1.0), ball(3.0, 1.0), CsgStep::Intersection];
    let _ = bounds(&nothing);
    assert_surfaces(&nothing, RIGHT * 9.0, -RIGHT, &[]);
}

#[test]
fn a_solid_and_itself() {
    for operator in [CsgStep::Union, CsgStep::Intersection] {
        assert_surfaces(&[ball(0.3, 1.0), ball(0.3, 1.0), operator], RIGHT * 5.0, -RIGHT, &[3.7, 5.7]);
    }
    assert_surfaces(&[ball(0.3, 1.0), ball(0.3, 1.0), CsgStep::Difference], RIGHT * 5.0, -RIGHT, &[]);
}

#[test]
fn a_window_ends_where_its_wall_does() {
    let block = |x: f32, y: f32| {
        let half = Vec3::new(x, y, 0.3);
        CsgStep::Solid(Solid::Cuboid(Cuboid::aligned(RIGHT * 0.1 - half, RIGHT * 0.1 + half)))
    };
    let window = [block(2.0, 2.0), block(1.0, 1.0), CsgStep::Difference];
    let toward = Vec3::new(0.3, -0.2, 1.0);
    // Through the window, through the wall, and through the wall into the window.
    let line = |x: f32, y: f32, expected: &[f64]| {
        let length = f64::from(toward.length());
        let expected: Vec<f64> = expected.iter().map(|t| t * length).collect();
        assert_surfaces(&window, Vec3::new(0.1 + x, y, 0.0) - toward * 4.0, toward, &expected);
    };
    line(0.0, 0.0, &[]);
    line(0.9, 0.9, &[]);
    line(-1.5, 0.0, &[3.7, 4.3]);
    line(-1.0, 0.0, &[3.7, 4.0]);
    line(1.0, 0.0, &[4.0, 4.3]);
}

#[test]
fn coordinates_are_those_of_the_solid() {
    let half = Vec3::new(1.0, 1.0, 1.0);
    let block = CsgStep::Solid(Solid::Cuboid(Cuboid::aligned(-half, half)));
    let steps = [ball(0.0, 0.5), block, CsgStep::Union];
    let (origin, toward) = (Vec3::new(0.5, 0.25, 9.0), Vec3::new(0.0, 0.0, -1.0));
    let alone = Cuboid::aligned(-half, half);
    let expected = [0.75, 0.625];
    assert_uv(alone, origin, toward, expected);
    assert_uv(Csg::new(&steps), origin, toward, expected);
    // A cavity as well, as seen from inside.
    let cavity = [ball(0.0, 2.0), block, CsgStep::Difference];
    assert_uv(alone, Vec3::new(0.5, 0.25, 0.0), -toward, expected);
    assert_uv(Csg::new(&cavity), Vec3::new(0.5, 0.25, 0.0), -toward, expected);
}

/// A pipe: two pieces of a cylinder, one on the other, from which two pieces of a core are subtracted, end to
/// end.
fn pipe_in_pieces(base: Vec3, axis: Vec3, extent: f32) -> [CsgStep; 7] {
    let cylinder = |radius: f32, from: f32, to: f32| {
        let at = |height: f32| base + axis * (height * extent);
        let cylinder = Cylinder { base: at(from), top: at(to), radius: radius * extent, capped: true };
        CsgStep::Solid(Solid::Cylinder(cylinder))
    };
    [
        cylinder(1.0, 0.0, 1.0),
        cylinder(1.0, 1.0, 2.0),
        CsgStep::Union,
        cylinder(0.5, 0.0, 1.0),
        CsgStep::Difference,
        cylinder(0.5, 1.0, 2.0),
        CsgStep::Difference,
    ]
}

/// Rays from everywhere, most of them grazing: none of them may meet dust where faces coincide.
fn assert_no_dust<R: Real>(extent: f32) {
    let (base, axis) = (Vec3::new(1.0, 2.0, -0.5) * extent, Vec3::new(0.48, 0.6, -0.64));
    let steps = pipe_in_pieces(base, axis, extent);
    let pipe = Csg::new(&steps);
    let mut random = Random(3);
    let mut memory = Memory::new();
    let scale = Scale::new::<R>(pipe.extent(), base + Vec3::new(12.0, 0.0, 0.0) * extent);
    let prepared: PreparedCsg<'_, R, _> = pipe.prepare(scale, &mut Arena::new(memory.lend())).unwrap();
    let mut met = 0;
    for _ in 0..20_000 {
        let disc = axis.cross(random.direction());
        // A place on one of three faces that must not exist: in the mouths of the hole, or between the
        // pieces.
        let (height, most) = match random.next() {
            x if x < -0.3 => (0.0, 0.45),
            x if x < 0.3 => (1.0, 0.95),
            _ => (2.0, 0.45),
        };
        let place = base + axis * (height * extent) + disc * (most * extent * random.next());
        let slope = random.next() * random.next() * random.next();
        let Some(direction) = (axis.cross(random.direction()) + axis * slope).normalized() else { continue };
        if slope.abs() < 2e-3 {
            continue;
        }
        let origin = place - direction * (extent * (6.0 + 5.0 * random.next()));
        let ray = Ray {
            origin: scale.point(origin.to()),
            direction: Vec3::from_setup(direction.to::<R::Setup>().normalized().unwrap()),
        };
        let mut range = Interval::AHEAD;
        while let Some(t) = prepared.intersect(&ray, range) {
            let surface = prepared.surface(&ray, t);
            let point: Vec3 = surface.point.to_f32() * (1.0 / scale.to_f32()) - base;
            let height = point.dot(axis);
            let from_axis = (point - axis * height).length();
            let on_lid = surface.normal.to_f32().dot(axis).abs() > 0.5;
            let (height, from_axis) = (height / extent, from_axis / extent);
            // At an edge the normal may be that of either face.
            let is_dust = on_lid && (from_axis < 0.499 || (height - 1.0).abs() < 0.5 && from_axis > 0.501);
            assert!(!is_dust, "dust at height {height}, {from_axis} from the axis: {ray:?}");
            met += 1;
            range.min = t;
        }
    }
    assert!(met > 10_000, "{met}");
}

#[test]
fn coinciding_faces_leave_no_dust() {
    for extent in EXTENTS {
        assert_no_dust::<f32>(extent);
        assert_no_dust::<f64>(extent);
        assert_no_dust::<Fixed>(extent);
    }
}

/// A random tree over six random balls: each step adds a ball or an operator.
fn random_tree(random: &mut Random) -> Vec<CsgStep> {
    let (mut steps, mut balls, mut depth) = (vec![], 0, 0);
    while balls < 6 || depth > 1 {
        if balls < 6 && (depth < 2 || random.next() > 0.0) {
            let sphere = Sphere::new(random.vector(), 0.7 + 0.4 * random.next());
            steps.push(CsgStep::Solid(Solid::Sphere(sphere)));
            balls += 1;
            depth += 1;
        } else {
            let choice = random.next();
            steps.push(if choice < -0.3 {
                CsgStep::Union
            } else if choice < 0.3 {
                CsgStep::Intersection
            } else {
                CsgStep::Difference
            });
            depth -= 1;
        }
    }
    steps
}

/// Whether a point is inside a tree of balls.
fn is_inside(steps: &[CsgStep], point: Vec3<f64>) -> bool {
    let mut stack = vec![];
    for step in steps {
        let value = if let CsgStep::Solid(Solid::Sphere(sphere)) = step {
            (point - sphere.center.to()).length() < f64::from(sphere.radius)
        } else {
            let (right, left): (bool, bool) = (stack.pop().unwrap(), stack.pop().unwrap());
            match step {
                CsgStep::Union => left || right,
                CsgStep::Intersection => left && right,
                _ => left && !right,
            }
        };
        stack.push(value);
    }
    stack.pop().unwrap()
}

#[test]
fn surfaces_are_where_a_point_comes_in_or_goes_out() {
    let mut random = Random(11);
    let mut met = 0;
    for _ in 0..300 {
        let steps = random_tree(&mut random);
        let is_inside = |point| is_inside(&steps, point);
        let mut memory = Memory::new();
        let prepared = prepared::<_, f64>(Csg::new(&steps), &mut memory).unwrap();
        for _ in 0..10 {
            let direction = random.direction().to::<f64>().normalized().unwrap();
            let ray = Ray { origin: random.vector().to::<f64>() - direction * 6.0, direction };
            let mut surfaces = vec![];
            let mut range = Interval::AHEAD;
            while let Some(t) = prepared.intersect(&ray, range) {
                let surface = prepared.surface(&ray, t);
                assert!((surface.point - ray.at(t)).length() < 1e-9);
                let (before, after) = (ray.at(t - 1e-4), ray.at(t + 1e-4));
                // Unless another surface is near.
                if prepared.intersect(&ray, Interval { min: t - 1e-3, max: t }).is_none()
                    && prepared.intersect(&ray, Interval { min: t, max: t + 1e-3 }).is_none()
                {
                    let comes_in = surface.normal.dot(direction) < 0.0;
                    assert_eq!((is_inside(before), is_inside(after)), (!comes_in, comes_in));
                }
                surfaces.push(t);
                range.min = t;
                met += 1;
            }
            for step in 0..1200 {
                let t = f64::from(step) * 0.01;
                if surfaces.iter().all(|surface| (surface - t).abs() > 1e-6) {
                    let before = surfaces.iter().filter(|surface| **surface < t).count();
                    assert_eq!(is_inside(ray.at(t)), before % 2 == 1, "{steps:?}: {ray:?} at {t}");
                }
            }
        }
    }
    assert!(met > 1000, "{met}");
}

#[test]
fn spawned_rays_do_not_meet_their_own_surface() {
    for extent in EXTENTS {
        let ball = |x: f32, radius: f32| {
            let center = Vec3::new(x, 0.3, -0.2) * extent;
            CsgStep::Solid(Solid::Sphere(Sphere::new(center, radius * extent)))
        };
        let bore = Cylinder {
            base: Vec3::new(-0.9, -0.8, 0.1) * extent,
            top: Vec3::new(0.9, 0.8, 0.2) * extent,
            radius: 0.2 * extent,
            capped: true,
        };
        let lens = [ball(-0.5, 1.0), ball(0.5, 1.0), CsgStep::Intersection];
        let bored = [ball(0.0, 0.9), CsgStep::Solid(Solid::Cylinder(bore)), CsgStep::Difference];
        let pair = [ball(-0.4, 0.5), ball(0.4, 0.5), CsgStep::Union];
        for steps in [lens, bored, pair] {
            assert_no_self_hits(Csg::new(&steps), Vec3::ZERO, extent, 7_000);
        }
    }
}

#[test]
fn a_set_of_your_own() {
    let balls = [-1.0, 1.0].map(|x| CsgStep::Solid(Sphere::new(Vec3::new(x, 0.0, 0.0), 2.0)));
    let [left, right] = balls;
    let steps = [left, right, CsgStep::Intersection];
    assert_meets(Csg::new(&steps), RIGHT * 5.0, -RIGHT, 4.0, [1.0, 0.0, 0.0]);
}

#[test]
fn many_solids_in_one() {
    // A pillar from which a row of balls is subtracted, one after the other.
    let mut steps = vec![pillar(1.0, -20.0, 20.0)];
    for place in 0..31u16 {
        let center = Vec3::new(1.0, f32::from(place) - 15.0, 0.0);
        steps.push(CsgStep::Solid(Solid::Sphere(Sphere::new(center, 0.25))));
        steps.push(CsgStep::Difference);
    }
    let csg = Csg::new(&steps);
    let mut memory = crate::arena::Workspace::<8192>::new();
    let prepared: PreparedCsg<'_, f32, _> = csg.prepare(Scale::ONE, &mut Arena::new(memory.lend())).unwrap();
    let ray = Ray { origin: Vec3::new(0.9, 30.0, 0.0), direction: -UP };
    let mut range = Interval::AHEAD;
    let mut count = 0;
    while let Some(t) = prepared.intersect(&ray, range) {
        range.min = t;
        count += 1;
    }
    assert_eq!(count, 64);
    steps.extend([ball(0.0, 1.0), CsgStep::Union]);
    assert_eq!(refusal(Csg::new(&steps)), Fault::TooManySolids { given: 33 });
    // All solids are on the stack at once.
    let mut laid_down: Vec<_> = (0..32u8).map(|x| ball(f32::from(x), 0.25)).collect();
    laid_down.extend([CsgStep::Union; 31]);
    let mut memory = crate::arena::Workspace::<8192>::new();
    let row: PreparedCsg<'_, f32, _> =
        Csg::new(&laid_down).prepare(Scale::ONE, &mut Arena::new(memory.lend())).unwrap();
    assert_eq!(row.intersect(&Ray { origin: RIGHT * 31.0, direction: RIGHT }, Interval::AHEAD), Some(0.25));
}

#[test]
fn bad_trees_are_refused() {
    let one = ball(0.0, 1.0);
    for steps in [
        &[][..],
        &[one, one],
        &[CsgStep::Union],
        &[one, CsgStep::Union],
        &[one, CsgStep::Union, one],
        &[one, one, CsgStep::Union, CsgStep::Difference],
    ] {
        assert_eq!(refusal(Csg::new(steps)), Fault::NotOneSolid, "{steps:?}");
    }
    let open = Cylinder { base: Vec3::ZERO, top: UP, radius: 1.0, capped: false };
    let steps = [one, CsgStep::Solid(Solid::Cylinder(open)), CsgStep::Union];
    assert_eq!(refusal(Csg::new(&steps)), Fault::NotSolid { solid: 1 });
    assert_eq!(refusal(Csg::new(&[one, ball(0.0, -1.0), CsgStep::Union])), Fault::RadiusNotPositive);
}

#[test]
fn bytes_are_the_same_in_constants() {
    let steps = [ball(0.0, 1.0), pillar(0.5, -1.0, 1.0), CsgStep::Difference];
    let csg = Csg::new(&steps);
    assert_eq!(csg.const_bytes::<f32>(), Geometry::bytes::<f32>(&csg));
    assert_eq!(csg.const_bytes::<f64>(), Geometry::bytes::<f64>(&csg));
}

#[test]
fn facets_of_a_solid_without_end_are_those_near_the_others() {
    fn check<R: Real>() {
        // A floor with a hollow.
        let steps = [behind(Vec3::ZERO, UP), ball(0.5, 1.0), CsgStep::Difference];
        let csg = Csg::new(&steps);
        let mut memory = Memory::new();
        let scale = Scale::new::<R>(csg.extent(), UP);
        let prepared: PreparedCsg<'_, R, _> = csg.prepare(scale, &mut Arena::new(memory.lend())).unwrap();
        let mut counts = [0, 0];
        prepared.each_facet(&Tessellation { segments: 32, eye: scale.point(UP.to()) }, &mut |facet| {
            assert!(!facet.is_closed);
            counts[(facet.part >> PART_BITS) as usize] += 1;
            for corner in facet.corners {
                let corner = corner.to_f32() * (1.0 / scale.to_f32());
                let from_ball = (corner - RIGHT * 0.5).length() - 1.0;
                let is_on_floor = corner.y.abs() < 1e-4 && from_ball > -1e-4;
                assert!(is_on_floor || from_ball.abs() < 1e-4 && corner.y < 1e-4, "{corner:?}");
            }
        });
        assert!(counts.iter().all(|count| *count > 100), "{counts:?}");
    }
    check::<f32>();
    check::<f64>();
    check::<Fixed>();
}
