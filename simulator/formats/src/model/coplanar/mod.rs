//! Meshes that lie in one plane, such as a carpet on a floor, are moved apart.
//!
//! Where two shapes are met at one distance, the earlier object of the scene is seen. The distances of two
//! meshes in one plane differ by rounding, so that the picture would show both in speckles. So the later mesh
//! is moved a small step behind the plane, as the camera sees it; behind a mesh that was moved itself, two
//! steps.
//!
//! # The step
//! A 32,768th of the largest coordinate of the triangles and the eye: three times the distance by which rays
//! leave a surface ([`RAY_OFFSET`](rayline::math::Real::RAY_OFFSET)), so that a ray through a transparent
//! mesh meets the one behind it, and a hundred times the rounding of a hit. From as far away as that
//! coordinate, it is a fortieth of a pixel of a picture of 640 by 480. In fixed point, coordinates have as
//! many digits everywhere in a scene, so the step is at least a fourth of that for the largest coordinate of
//! all.
//!
//! # The search
//! Only meshes whose boxes overlap are searched. A tree of boxes gives the pairs of triangles of different
//! objects near each other, in n log n steps unless very many boxes overlap: the search ends after [`STEPS`]
//! of them a triangle. Corners count as in one plane within an eighth of the step, which is far above the
//! rounding of coordinates, and well below the distance at which programs put a picture in front of a wall.

mod body;
mod boxes;
mod overlap;
#[cfg(test)]
mod tests;

use bumpalo::Bump;
use glam::DVec3;
use rayline::shape::{Instances, Model, Shape};
use rayline::{Mover, Object, Scene};

use crate::space::vector;
use body::{Body, Hidden};
use boxes::{Boxes, Item, each};
use overlap::shared_plane;

/// The step, relative to the largest coordinate.
const STEP: f64 = 1.0 / 32_768.0;
/// The least step, relative to the largest coordinate of the scene.
const LEAST_STEP: f64 = STEP / 4.0;
/// The largest distance from a plane, relative to the largest coordinate.
const TOLERANCE: f64 = STEP / 8.0;
/// The most steps: what lies behind more meshes of one plane stays at that depth.
const LAYERS: f64 = 64.0;
/// The most boxes and triangles that are looked at for each triangle, on average. Small scenes may take more,
/// and large ones less: they take a second or two.
const STEPS: u64 = 256;
const FEWEST_STEPS: u64 = 1 << 20;
const MOST_STEPS: u64 = 1 << 24;
/// The most triangles of all instances of a mesh that are compared.
const MOST_OF_INSTANCES: usize = 1 << 20;

/// A scene whose meshes were moved apart.
pub struct Parted<'a> {
    /// All objects.
    pub objects: &'a [Object<Shape<'a>>],
    /// The positions of objects that were moved.
    pub moved: Vec<usize>,
    /// Whether all pairs of meshes were compared.
    pub is_whole: bool,
}

/// Moves meshes that lie in one plane apart.
pub fn part<'a>(scene: &Scene<'a>, arena: &'a Bump) -> Parted<'a> {
    let (mut bodies, is_listed) = bodies(scene);
    let nothing = Parted { objects: scene.objects, moved: Vec::new(), is_whole: true };
    if bodies.first().map(|body| body.object) == bodies.last().map(|body| body.object) {
        return nothing;
    }
    let is_whole = hide(&mut bodies, vector(scene.camera.eye)) && is_listed;
    let mut moved: Vec<_> = bodies.iter().filter(|body| body.is_moved()).map(|body| body.object).collect();
    moved.dedup();
    if moved.is_empty() {
        return Parted { is_whole, ..nothing };
    }
    let objects = arena.alloc_slice_copy(scene.objects);
    for of_object in bodies.chunk_by(|a, b| a.object == b.object) {
        if let Some(body) = of_object.iter().find(|body| body.is_moved())
            && let Some(object) = objects.get_mut(body.object)
        {
            object.shape = match object.shape {
                Shape::Instances(instances) => {
                    let poses =
                        instances.poses.iter().zip(of_object).map(|(pose, body)| body.moved_pose(pose));
                    Shape::Instances(Instances { poses: arena.alloc_slice_fill_iter(poses), ..instances })
                }
                _ => body.shape(arena),
            };
        }
    }
    Parted { objects, moved, is_whole }
}

/// The meshes of a scene that stand still, in the order of the objects, and whether there are no instances of
/// too many triangles.
fn bodies<'a>(scene: &Scene<'a>) -> (Vec<Body<'a>>, bool) {
    let (mut bodies, mut is_whole) = (Vec::new(), true);
    let is_mover = |index: usize| {
        let of_it = |mover| matches!(mover, Mover::Object(id) if usize::from(id.0) == index);
        scene.motions.iter().any(|motion| of_it(motion.of))
    };
    for (index, object) in scene.objects.iter().enumerate().filter(|(index, _)| !is_mover(*index)) {
        match object.shape {
            Shape::Mesh(mesh) => bodies.push(Body::mesh(index, mesh)),
            Shape::Instances(Instances { model: Model::Mesh(mesh), size, poses }) => {
                if poses.len().saturating_mul(mesh.triangles.len()) <= MOST_OF_INSTANCES {
                    bodies.extend(poses.iter().map(|pose| Body::instance(index, *mesh, size, pose)));
                } else {
                    is_whole = false;
                }
            }
            _ => {}
        }
    }
    (bodies, is_whole)
}

/// Moves triangles behind those of earlier objects in one plane. The result is whether all were compared.
fn hide(bodies: &mut [Body<'_>], eye: DVec3) -> bool {
    let mut items = Vec::new();
    for (number, body) in bodies.iter().enumerate() {
        items.extend(body.triangles().filter_map(|triangle| item(body, number, triangle)));
    }
    let magnitudes = items.iter().flat_map(|item| [item.low, item.high]).flatten().map(f32::abs);
    let least_step = f64::from(magnitudes.fold(0.0, f32::max)).max(magnitude(eye)) * LEAST_STEP;
    let mut steps = STEPS.saturating_mul(items.len() as u64).clamp(FEWEST_STEPS, MOST_STEPS);
    let is_near = near(&items, bodies.len());
    items.retain(|item| is_near.get(item.body as usize).copied().unwrap_or_default());
    let boxes = Boxes::new(items.clone());
    for of_body in items.chunk_by(|a, b| a.body == b.body) {
        let Some(number) = of_body.first().map(|item| item.body as usize) else { continue };
        let Some(body) = bodies.get(number) else { continue };
        let mut hidden: Vec<Hidden> = Vec::new();
        for item in of_body {
            let mut deepest: Option<Hidden> = None;
            boxes.visit(item, &mut steps, |other| {
                let other = bodies.get(other.body as usize).map(|body| (body, other.triangle));
                let hidden = other.and_then(|other| behind((body, item.triangle), other, eye, least_step));
                if let Some(hidden) = hidden
                    && deepest.is_none_or(|deepest| hidden.depth > deepest.depth)
                {
                    deepest = Some(hidden);
                }
                deepest.is_none_or(|deepest| !deepest.is_last)
            });
            hidden.extend(deepest);
        }
        if let Some(body) = bodies.get_mut(number) {
            body.hide(&hidden, &mut steps);
        }
    }
    steps > 0
}

/// For each body, whether its box overlaps that of a body of another object: most bodies lie alone, and their
/// triangles need no search. If very many boxes overlap, all count as near. The items come body by body.
fn near(items: &[Item], bodies: usize) -> Vec<bool> {
    let around = |of_body: &[Item]| {
        of_body.iter().copied().reduce(|all, item| Item {
            low: each(all.low, item.low, f32::min),
            high: each(all.high, item.high, f32::max),
            ..all
        })
    };
    let around: Vec<_> = items.chunk_by(|a, b| a.body == b.body).filter_map(around).collect();
    let boxes = Boxes::new(around.clone());
    let (mut is_near, mut steps) = (vec![false; bodies], FEWEST_STEPS);
    for item in &around {
        boxes.visit(item, &mut steps, |other| {
            for body in [item.body, other.body] {
                if let Some(is_near) = is_near.get_mut(body as usize) {
                    *is_near = true;
                }
            }
            true
        });
    }
    if steps > 0 { is_near } else { vec![true; bodies] }
}

/// A triangle of a body, if it is so thick that it has a plane.
fn item(body: &Body<'_>, number: usize, triangle: u32) -> Option<Item> {
    let corners @ [a, b, c] = body.corners(triangle)?;
    let room = corners.into_iter().map(magnitude).fold(0.0, f64::max) * TOLERANCE;
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let longest = ab.length().max(ac.length()).max(bc.length());
    if !(ab.cross(ac).length() > 8.0 * room * longest) {
        return None;
    }
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    // Across the plane, add the tolerance. Along it, take it away: triangles that touch do not overlap.
    let wide = (high - low).max_element() / 8.0;
    let room = DVec3::from_array((high - low).to_array().map(|side| if side > wide { -room } else { room }));
    let [low, high] = [low - room, high + room].map(|corner| corner.as_vec3().to_array());
    Some(Item { low, high, object: body.object as u32, body: number as u32, triangle })
}

/// A triangle behind the plane that it shares with a triangle of an earlier object, if there is one.
fn behind(
    (body, triangle): (&Body<'_>, u32),
    (earlier, other): (&Body<'_>, u32),
    eye: DVec3,
    least_step: f64,
) -> Option<Hidden> {
    let (a, b) = (body.corners(triangle)?, earlier.corners(other)?);
    let largest = a.into_iter().chain(b).map(magnitude).fold(0.0, f64::max);
    let tolerance = largest * TOLERANCE;
    let plane = shared_plane(&a, &b, tolerance, eye)?;
    let step = (largest.max(magnitude(eye)) * STEP).max(least_step);
    let heights = earlier.moved_corners(other)?.map(|corner| plane.height(corner));
    let deepest = heights.into_iter().fold(0.0, f64::min);
    let is_last = step - deepest >= step * LAYERS;
    let depth = if is_last { step * LAYERS } else { step - deepest };
    Some(Hidden { triangle, plane, depth, is_last, tolerance })
}

/// The largest absolute coordinate.
fn magnitude(point: DVec3) -> f64 {
    point.abs().max_element()
}
