//! Tests of the hierarchy, with boxes that are spread well and badly.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)]

use core::mem::MaybeUninit;
use std::vec;
use std::vec::Vec;

use super::*;
use crate::math::{Aabb, Fixed};

type Boxes = Vec<Option<Aabb<f32>>>;

/// A list of so many objects.
fn list(objects: usize) -> Vec<u16> {
    (0..objects).map(|object| object as u16).collect()
}

/// Random numbers from -1 to 1, the same on every run.
fn random(mut state: u32) -> impl FnMut() -> f32 {
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 23) as f32 - 1.0
    }
}

/// Memory for the hierarchy of so many objects.
fn memory<R: Real, const W: usize>(objects: usize, leaf: usize) -> Vec<MaybeUninit<u8>> {
    vec![MaybeUninit::uninit(); Hierarchy::<R, W>::bytes(objects, leaf)]
}

/// Builds hierarchies of these boxes and checks all their invariants. Returns the depth for nodes of four
/// boxes and leaves of two objects.
fn check(boxes: &Boxes) -> usize {
    check_leaves::<8>(boxes, 3);
    check_leaves::<NARROW>(boxes, 4);
    check_leaves::<NARROW>(boxes, 2)
}

fn check_leaves<const W: usize>(boxes: &Boxes, leaf: usize) -> usize {
    let (mut order, mut memory) = (list(boxes.len()), memory::<f32, W>(boxes.len(), leaf));
    let bounds = |object| boxes[usize::from(object)];
    let hierarchy = Hierarchy::<_, W>::new(&mut order, leaf, bounds, &mut Arena::new(&mut memory)).unwrap();
    let mut found: Vec<u16> = hierarchy.order[..hierarchy.unbounded].to_vec();
    assert!(found.iter().all(|object| boxes[usize::from(*object)].is_none()));
    let mut deepest = 0;
    let mut stack = vec![(0u16, Vec::<(u16, usize)>::new())];
    while let Some((index, path)) = stack.pop() {
        let node = hierarchy.nodes[usize::from(index)];
        deepest = deepest.max(path.len() + 1);
        for slot in 0..W {
            let path: Vec<_> = path.iter().copied().chain([(index, slot)]).collect();
            match node.content(slot) {
                Content { count: NODE, first } => stack.push((first, path)),
                Content { count, first } => {
                    assert!(usize::from(count) <= leaf);
                    let first = usize::from(first);
                    for object in &hierarchy.order[first..first + usize::from(count)] {
                        found.push(*object);
                        let bounds = boxes[usize::from(*object)].unwrap();
                        for (node, slot) in &path {
                            assert!(holds(&hierarchy.nodes[usize::from(*node)], *slot, bounds));
                        }
                    }
                }
            }
        }
    }
    found.sort_unstable();
    assert!(found.iter().enumerate().all(|(index, object)| index == usize::from(*object)));
    assert_eq!(found.len(), boxes.len());
    assert!(deepest <= MAX_HIERARCHY_DEPTH);
    deepest
}

/// Whether one of a node's boxes contains a box.
fn holds<const W: usize>(node: &Node<f32, W>, slot: usize, bounds: Aabb<f32>) -> bool {
    let [min, max] = node.corners(slot);
    let around = Aabb { min, max };
    around.contains(bounds.min) && around.contains(bounds.max)
}

fn cube(x: f32, y: f32, z: f32, reach: f32) -> Option<Aabb<f32>> {
    Some(Aabb::around(Vec3::new(x, y, z), Vec3::new(reach, reach, reach)))
}

#[test]
fn every_object_is_in_one_leaf_within_all_boxes_around_it() {
    for count in [33, 34, 100, 1000] {
        let grid = (0..count).map(|i| cube((i % 10) as f32, (i / 10 % 10) as f32, (i / 100) as f32, 0.6));
        let deepest = check(&grid.collect());
        assert!(deepest <= 7, "{count}: {deepest}");
    }
}

#[test]
fn few_objects_or_none_have_bounds() {
    check(&vec![None; 40]);
    for bounded in 1..6 {
        check(&(0..40).map(|i| (i % 40 < bounded).then(|| cube(i as f32, 0.0, 0.0, 1.0).unwrap())).collect());
    }
}

#[test]
fn no_tree_is_too_deep() {
    // Objects in one place, and objects each of which is so much farther than the last that cuts separate as
    // few as possible.
    check(&vec![cube(1.0, 2.0, 3.0, 0.5); 5000]);
    let growing = |i: i32| cube(1.3f32.powi(i), 0.0, 1.2f32.powi(i), 0.1);
    check(&(0..50).map(growing).collect());
    check(&(0..5000).map(|i| if i < 40 { growing(i) } else { cube(0.0, 0.0, 0.0, 0.1) }).collect());
    check(&vec![cube(1.0, 2.0, 3.0, 0.5); 65_535]);
}

#[test]
fn at_most_64_bytes_an_object() {
    assert_eq!(size_of::<Node<Fixed>>(), 108);
    for objects in [33, 820, 65_535] {
        assert!(Hierarchy::<f32>::bytes(objects, 2) <= 48 * objects);
        assert!(Hierarchy::<Fixed>::bytes(objects, 2) <= 48 * objects);
        assert!(Hierarchy::<f32>::bytes(objects, 4) <= 37 * objects);
        assert!(Hierarchy::<f32, 8>::bytes(objects, 3) <= 62 * objects);
    }
}

/// A node with one box, in the third place.
fn node<R: Real>(center: Vec3<R>, reach: Vec3<R>) -> Node<R> {
    let mut node = Node { planes: [[[-R::ONE; NARROW]; 2]; 3], ..Node::EMPTY };
    node.enclose(2, Aabb::around(center, reach));
    node
}

/// Whether the test of this number system finds the box in the third place, and the ray reaches it.
fn meets<R: Real>(ray: &Ray<R>, max: R, node: &Node<R>) -> bool {
    fn found<R: Real>(test: impl RayTest<R, NARROW>, node: &Node<R>) -> bool {
        let (mut key_there, mut met) = (None, false);
        test.each_met(node, |slot, key| key_there = (slot == 2).then_some(key).or(key_there));
        test.any_met(node, |slot| {
            met |= slot == 2;
            false
        });
        assert_eq!(met, key_there.is_some());
        key_there.is_some_and(|key| test.reaches(key))
    }
    if R::IS_FIXED_POINT { found(Segment::new(ray, max), node) } else { found(Slabs::new(ray, max), node) }
}

/// Rays that meet a box find it, however flat the box is: rays along axes, along diagonals and from far away.
fn boxes_are_met<R: Real>(far: f32) {
    let unit = |x: f32, y: f32, z: f32| {
        Vec3::<R>::from_setup(Vec3::new(x, y, z).to::<R::Setup>().normalized().unwrap())
    };
    let targets = [-0.25f32, -0.1, 0.0, 0.125, 0.25];
    for (reach_y, reach_z) in [(0.25, 0.25), (0.0, 0.25), (0.0, 0.0)] {
        let node = node::<R>(Vec3::ZERO, Vec3::new(0.25, reach_y, reach_z).to());
        for (x, y, z) in [
            (1.0, 0.0, 0.0),
            (-1.0, -0.0, -0.0),
            (0.0, -1.0, 0.0),
            (1.0, 1.0, 0.0),
            (-0.3, 0.7, 0.2),
            (1e-4, 1.0, -1e-4),
            (1e-25, 1.0, -1e-38),
        ] {
            let direction = unit(x, y, z);
            for target in targets {
                let point = Vec3::new(target, reach_y, -reach_z).to::<R>();
                let ray = Ray { origin: point - direction * R::from_f32(far), direction };
                assert!(meets(&ray, R::FARTHEST, &node), "{ray:?} {node:?}");
                // A ray that ends at the point, at its rounded distance.
                assert!(meets(&ray, R::from_f32(far), &node), "{ray:?} {node:?}");
            }
        }
    }
}

#[test]
fn no_box_is_missed() {
    for far in [0.5, 3.0, 50.0] {
        boxes_are_met::<f32>(far);
        boxes_are_met::<f64>(far);
        boxes_are_met::<Fixed>(far);
    }
}

fn boxes_are_passed<R: Real>() {
    let number = R::from_f32;
    let node = node::<R>(Vec3::new(0.0, 0.0, 5.0).to(), Vec3::new(1.0, 1.0, 1.0).to());
    let meets = |x: f32, z: f32, max: R| {
        let direction = Vec3::from_setup(Vec3::new(x, 0.0, z).to::<R::Setup>().normalized().unwrap());
        meets(&Ray { origin: Vec3::ZERO, direction }, max, &node)
    };
    assert!(meets(0.0, 1.0, R::FARTHEST) && meets(0.0, 1.0, number(4.1)) && meets(1.0, 4.1, R::FARTHEST));
    assert!(!meets(0.0, -1.0, R::FARTHEST), "behind");
    assert!(!meets(0.0, 1.0, number(3.9)), "beyond the end");
    assert!(!meets(1.0, 3.9, R::FARTHEST), "beside");
    assert!(!meets(1.0, 0.0, R::FARTHEST), "across");
}

#[test]
fn boxes_behind_beside_and_beyond_are_passed() {
    boxes_are_passed::<f32>();
    boxes_are_passed::<f64>();
    boxes_are_passed::<Fixed>();
}

#[test]
fn the_nearest_box_comes_first_and_hides_the_others() {
    fn check<R: Real, const W: usize>() {
        let at = |x: f32| Aabb::around(Vec3::new(x, 0.0, 0.0).to::<R>(), Vec3::new(0.25, 0.25, 0.25).to());
        let (mut order, mut memory) = (list(40), memory::<R, W>(40, 2));
        let place = |object: usize| object * 7 % 40;
        let bounds = |object: u16| Some(at(place(usize::from(object)) as f32 - 20.0));
        let hierarchy = Hierarchy::<_, W>::new(&mut order, 2, bounds, &mut Arena::new(&mut memory)).unwrap();
        for (x, first) in [(1.0f32, 0), (-1.0, 39)] {
            let direction = Vec3::new(x, 0.0, 0.0).to::<R>();
            let ray = Ray { origin: Vec3::new(x * -30.0, 0.0, 0.0).to(), direction };
            let visits = |end: f32| {
                let mut visited = Vec::new();
                hierarchy.walk(&ray, R::FARTHEST, |object| {
                    visited.push(place(object));
                    R::from_f32(end)
                });
                visited
            };
            let all = visits(100.0);
            assert!(all.len() == 40 && all[..2].contains(&first), "{all:?}");
            // The first object ends the ray. After that, only its neighbor in the leaf is tested.
            let hidden = visits(10.0);
            assert!(hidden.len() <= 2, "{hidden:?}");
        }
    }
    check::<f32, NARROW>();
    check::<f64, NARROW>();
    check::<Fixed, NARROW>();
    check::<f32, 8>();
    check::<Fixed, 8>();
}

/// Processors that compute one number at a time test boxes one by one: they meet the same boxes at the same
/// distances.
#[test]
fn boxes_are_met_alone_as_they_are_together() {
    fn check<R: Real, const W: usize>() {
        let mut number = random(3);
        let mut number = || R::from_f32(number());
        let mut point = || Vec3::new(number(), number(), number());
        let (mut met, mut missed) = (0, 0);
        for round in 0..500 {
            let mut node = Node::<R, W>::EMPTY;
            for slot in 0..W {
                node.enclose(slot, Aabb::point(point()).union(Aabb::point(point())));
            }
            let (origin, target) = (point(), point());
            let (direction, distance) = (target - origin).unit_and_length();
            let max = if round % 2 == 0 { distance } else { R::FARTHEST };
            let slabs = Slabs::new(&Ray { origin, direction }, max);
            let (bits, keys) = slabs.meet(&node);
            for (slot, key) in keys.into_iter().enumerate() {
                let together = (bits >> slot & 1 != 0).then_some(key);
                assert_eq!(slabs.enters(&node, slot), together, "{origin:?} {target:?} {node:?}");
                *(if together.is_some() { &mut met } else { &mut missed }) += 1;
            }
        }
        assert!(met > 300 && missed > 1000, "{met} {missed}");
    }
    check::<f32, NARROW>();
    check::<f32, 8>();
    check::<f64, NARROW>();
}

/// The mean number of objects that a ray tests. Unlike a time, it is the same on every run.
#[test]
fn a_ray_tests_few_of_many_objects() {
    tests_few::<NARROW>(2, [(91, 0.9), (820, 3.07)]);
    tests_few::<8>(3, [(91, 1.04), (820, 4.47)]);
}

fn tests_few<const W: usize>(leaf: usize, bounds: [(usize, f32); 2]) {
    // Random boxes of two sizes in a cube, and rays between random points of the cube.
    let mut number = random(1);
    let mut point = || Vec3::new(number(), number(), number());
    for (count, most) in bounds {
        let boxes: Vec<_> = (0..count)
            .map(|i| {
                let reach = if i % 9 == 0 { 0.1 } else { 0.03 };
                Aabb::around(point(), Vec3::new(reach, reach, reach))
            })
            .collect();
        let (mut order, mut memory) = (list(count), memory::<f32, W>(count, leaf));
        let bounds = |object| Some(boxes[usize::from(object)]);
        let hierarchy =
            Hierarchy::<_, W>::new(&mut order, leaf, bounds, &mut Arena::new(&mut memory)).unwrap();
        let mut tested = 0u32;
        for _ in 0..1000 {
            let (origin, target) = (point(), point());
            let ray = Ray { origin, direction: (target - origin).normalized().unwrap() };
            hierarchy.walk(&ray, (target - origin).length(), |_| {
                tested += 1;
                (target - origin).length()
            });
        }
        let tested = tested as f32 / 1000.0;
        std::println!("{count} boxes: {tested} tested");
        assert!(tested <= most, "{count} boxes: {tested} tested");
    }
}

/// A beam meets every box that one of its rays meets, and few others: beams of rays that spread, that run
/// along an axis, and that leave a box toward a point or in one direction.
#[test]
fn a_beam_meets_what_its_rays_meet() {
    beams_meet_what_rays_meet::<NARROW>(2);
    beams_meet_what_rays_meet::<8>(3);
}

/// A beam, and its rays with their ends: rays from some origins in one direction, to a point, or spread; by
/// turns.
fn bundle(
    round: usize,
    origins: &[Vec3],
    [place, target]: [Vec3; 2],
    mut spread: impl FnMut() -> Vec3,
) -> (Beam<f32>, Vec<(Ray<f32>, f32)>) {
    let around = origins.iter().copied().map(Aabb::point).reduce(Aabb::union).unwrap();
    let (to_target, far) = ((target - place).normalized().unwrap(), f32::FARTHEST);
    match round % 4 {
        0 => {
            let direction = if round.is_multiple_of(8) { Vec3::new(1.0, 0.0, 0.0) } else { to_target };
            let beam = Beam::toward(around, 0.0, direction);
            (beam, origins.iter().map(|origin| (Ray { origin: *origin, direction }, far)).collect())
        }
        1 => {
            let rays = origins.iter().map(|origin| {
                let (direction, distance) = (target - *origin).unit_and_length();
                (Ray { origin: *origin, direction }, distance)
            });
            (Beam::toward_point(around, 0.0, target), rays.collect())
        }
        _ => {
            let from = if round % 4 == 2 { Some(place) } else { None };
            let rays: Vec<_> = (origins.iter())
                .map(|origin| {
                    let direction = (to_target + spread()).normalized().unwrap();
                    (Ray { origin: from.unwrap_or(*origin), direction }, far)
                })
                .collect();
            (Beam::around(rays.iter().map(|(ray, _)| ray)).unwrap(), rays)
        }
    }
}

/// Marks each of `count` objects that a search finds, if its test never returns `true`.
fn marked(count: usize, search: impl FnOnce(&mut dyn FnMut(usize) -> bool) -> bool) -> Vec<bool> {
    let mut marked = vec![false; count];
    assert!(!search(&mut |object| {
        assert!(!marked[object], "found twice");
        marked[object] = true;
        false
    }));
    marked
}

fn beams_meet_what_rays_meet<const W: usize>(leaf: usize) {
    let mut number = random(7);
    let count = 300;
    let mut point = || Vec3::new(number(), number(), number());
    let mut boxes: Vec<_> = (0..count)
        .map(|_| {
            let (center, reach) = (point(), point() * 0.05);
            Some(Aabb::around(center, Vec3::new(reach.x.abs(), reach.y.abs(), reach.z.abs())))
        })
        .collect();
    boxes[17] = None;
    let (mut order, mut memory) = (list(count), memory::<f32, W>(count, leaf));
    let bounds = |object| boxes[usize::from(object)];
    let hierarchy = Hierarchy::<_, W>::new(&mut order, leaf, bounds, &mut Arena::new(&mut memory)).unwrap();
    let (mut met, mut met_by_beams) = (0, 0);
    for round in 0..400 {
        let (place, target, spread) = (point(), point() * 2.0, [0.0, 0.01, 0.3][round % 3]);
        let origins: Vec<Vec3> = (0..8).map(|_| place + point() * spread).collect();
        let (beam, rays) = bundle(round, &origins, [place, target], || point() * spread);
        let gathered = marked(count, |test| hierarchy.any_in_beam(&beam, test));
        let mut any = vec![false; count];
        for (ray, max) in &rays {
            let mut walked = vec![false; count];
            hierarchy.walk(ray, *max, |object| {
                walked[object] = true;
                *max
            });
            assert_eq!(marked(count, |test| hierarchy.any(ray, *max, test)), walked);
            any.iter_mut().zip(walked).for_each(|(any, met)| *any |= met);
        }
        assert!(gathered[17] && any[17]);
        let count_of = |found: &[bool]| found.iter().filter(|found| **found).count();
        let all_in = |found: &[bool]| any.iter().zip(found).all(|(any, found)| *found || !any);
        assert!(all_in(&gathered), "{round}");
        if round.is_multiple_of(4) {
            // Parallel rays: they are as far beside the first one as their origins are.
            let (ray, max) = rays[0];
            let reach = origins.iter().map(|origin| (*origin - ray.origin).length()).fold(0.0, f32::max);
            let end = max.min(hierarchy.farthest_from(ray.origin));
            let beside = marked(count, |test| hierarchy.any_beside(&ray, end, reach, test));
            assert!(all_in(&beside), "{round}");
            assert!(spread > 0.1 || count_of(&beside) < count / 2, "{round}");
        }
        if spread < 0.1 {
            met += count_of(&any);
            met_by_beams += count_of(&gathered);
        }
        let mut told = 0;
        let stops = hierarchy.any_in_beam(&beam, |_| {
            told += 1;
            told == 2
        });
        assert_eq!((stops, told), if count_of(&gathered) < 2 { (false, 1) } else { (true, 2) });
    }
    std::println!("{met} met by rays, {met_by_beams} by beams");
    assert!(met_by_beams < 2 * met);
}
