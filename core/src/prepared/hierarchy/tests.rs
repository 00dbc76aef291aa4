//! What a hierarchy promises, of boxes that are spread well and badly.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)]

use core::mem::MaybeUninit;
use std::vec;
use std::vec::Vec;

use super::*;
use crate::math::{Aabb, Fixed};

type Boxes = Vec<Option<Aabb<f32>>>;

/// Builds the hierarchy of these boxes and checks all that it promises; returns the depth.
fn check(boxes: &Boxes) -> usize {
    let mut memory = vec![MaybeUninit::uninit(); Hierarchy::<f32>::bytes(boxes.len())];
    let mut arena = Arena::new(&mut memory);
    let hierarchy = build::build(boxes.len(), |object| boxes[usize::from(object)], &mut arena).unwrap();
    let mut found: Vec<u16> = hierarchy.order[..hierarchy.unbounded].to_vec();
    assert!(found.iter().all(|object| boxes[usize::from(*object)].is_none()));
    let mut deepest = 0;
    let mut stack = vec![(0u16, Vec::new())];
    while let Some((index, path)) = stack.pop() {
        let path: Vec<u16> = path.into_iter().chain([index]).collect();
        let node = hierarchy.nodes[usize::from(index)];
        match node.content {
            Content::Nodes { second, .. } => {
                deepest = deepest.max(path.len());
                stack.push((second, path.clone()));
                stack.push((index + 1, path));
            }
            Content::Objects { count, first } => {
                let first = usize::from(first);
                for object in &hierarchy.order[first..first + usize::from(count)] {
                    found.push(*object);
                    let bounds = boxes[usize::from(*object)].unwrap();
                    for around in &path {
                        assert!(holds(&hierarchy.nodes[usize::from(*around)], bounds));
                    }
                }
            }
        }
        if found.len() == boxes.len() {
            break;
        }
    }
    found.sort_unstable();
    assert!(found.iter().enumerate().all(|(index, object)| index == usize::from(*object)));
    assert_eq!(found.len(), boxes.len());
    assert!(deepest <= MAX_HIERARCHY_DEPTH);
    deepest
}

/// Whether a box lies in a node's.
fn holds(node: &Node<f32>, bounds: Aabb<f32>) -> bool {
    let around = Aabb::around(node.center, node.reach);
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
        assert!(deepest <= 12, "{count}: {deepest}");
    }
}

#[test]
fn nothing_has_bounds_or_little() {
    check(&vec![None; 40]);
    for bounded in 1..6 {
        check(&(0..40).map(|i| (i % 40 < bounded).then(|| cube(i as f32, 0.0, 0.0, 1.0).unwrap())).collect());
    }
}

#[test]
fn no_tree_is_too_deep() {
    // All at one place; each so much farther than the last that every cut parts as few as it may.
    check(&vec![cube(1.0, 2.0, 3.0, 0.5); 5000]);
    let growing = |i: i32| cube(1.3f32.powi(i), 0.0, 1.2f32.powi(i), 0.1);
    check(&(0..50).map(growing).collect());
    check(&(0..5000).map(|i| if i < 40 { growing(i) } else { cube(0.0, 0.0, 0.0, 0.1) }).collect());
    check(&vec![cube(1.0, 2.0, 3.0, 0.5); 65_535]);
}

#[test]
fn a_fixed_point_node_is_as_small() {
    assert_eq!(size_of::<Node<Fixed>>(), 28);
    assert_eq!(Hierarchy::<f32>::bytes(32), 0);
    // 30 bytes for each object, and what alignment takes.
    assert_eq!(Hierarchy::<f32>::bytes(1000), 30_000 + 3 + 1);
}

/// All rays that meet a box, however flat and however they run, find it: along axes, along diagonals and from far away.
fn boxes_are_met<R: Real>(far: f32) {
    let unit = |x: f32, y: f32, z: f32| {
        Vec3::<R>::from_setup(Vec3::new(x, y, z).to::<R::Setup>().normalized().unwrap())
    };
    let targets = [-0.25f32, -0.1, 0.0, 0.125, 0.25];
    for (reach_y, reach_z) in [(0.25, 0.25), (0.0, 0.25), (0.0, 0.0)] {
        let node = Node::<R> {
            center: Vec3::ZERO,
            reach: Vec3::new(0.25, reach_y, reach_z).to(),
            content: Content::Objects { count: 0, first: 0 },
        };
        for (x, y, z) in
            [(1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (1.0, 1.0, 0.0), (-0.3, 0.7, 0.2), (1e-4, 1.0, -1e-4)]
        {
            let direction = unit(x, y, z);
            for target in targets {
                let point = Vec3::new(target, reach_y, -reach_z).to::<R>();
                let ray = Ray { origin: point - direction * R::from_f32(far), direction };
                assert!(Segment::new(&ray, R::FARTHEST).meets(&node), "{ray:?} {node:?}");
                // It ends at the point, at its rounded distance.
                assert!(Segment::new(&ray, R::from_f32(far)).meets(&node), "{ray:?} {node:?}");
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

#[test]
fn boxes_behind_beside_and_beyond_are_passed() {
    let node = Node::<f32> {
        center: Vec3::new(0.0, 0.0, 5.0),
        reach: Vec3::new(1.0, 1.0, 1.0),
        content: Content::Objects { count: 0, first: 0 },
    };
    let meets = |x: f32, z: f32, max: f32| {
        let direction = Vec3::new(x, 0.0, z).normalized().unwrap();
        Segment::new(&Ray { origin: Vec3::ZERO, direction }, max).meets(&node)
    };
    assert!(meets(0.0, 1.0, 1e30) && meets(0.0, 1.0, 4.1) && meets(1.0, 4.1, 1e30));
    assert!(!meets(0.0, -1.0, 1e30), "behind");
    assert!(!meets(0.0, 1.0, 3.9), "beyond the end");
    assert!(!meets(1.0, 3.9, 1e30), "beside");
    assert!(!meets(1.0, 0.0, 1e30), "across");
}
