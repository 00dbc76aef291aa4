//! Meshes and instances whose parts can be moved.

use std::collections::{HashMap, HashSet};

use bumpalo::Bump;
use glam::{DMat3, DVec3};
use rayline::Vec3;
use rayline::limits::MAX_COORDINATE;
use rayline::shape::{Mesh, Pose, Shape};

use super::overlap::Plane;
use crate::space::{rotation, vector};

/// A mesh, or an instance of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Body<'a> {
    /// The position of its object in the scene.
    pub(super) object: usize,
    mesh: Mesh<'a>,
    /// For an instance: its turn with its size, and the place of its origin.
    pose: Option<(DMat3, DVec3)>,
    /// The shifts of vertices, by their place.
    shifts: HashMap<Place, DVec3>,
}

/// A place in a mesh, as the bits of its coordinates: all vertices in one place move together. An instance
/// moves as a whole.
type Place = [u32; 3];

/// A triangle that must lie at a depth behind a plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hidden {
    pub(super) triangle: u32,
    pub(super) plane: Plane,
    pub(super) depth: f64,
    /// Whether that is the largest depth.
    pub(super) is_last: bool,
    /// The largest distance of a triangle in the plane from it.
    pub(super) tolerance: f64,
}

impl<'a> Body<'a> {
    pub(super) fn mesh(object: usize, mesh: Mesh<'a>) -> Self {
        Self { object, mesh, pose: None, shifts: HashMap::new() }
    }

    pub(super) fn instance(object: usize, mesh: Mesh<'a>, size: f32, pose: &Pose) -> Self {
        let pose = (rotation(pose.rotation) * f64::from(size), vector(pose.origin));
        Self { pose: Some(pose), ..Self::mesh(object, mesh) }
    }

    pub(super) fn triangles(&self) -> core::ops::Range<u32> {
        0..self.mesh.triangles.len() as u32
    }

    fn vertices(&self, triangle: u32) -> Option<[Vec3; 3]> {
        let [a, b, c] = *self.mesh.triangles.get(triangle as usize)?;
        let at = |vertex: u16| self.mesh.vertices.get(usize::from(vertex)).copied();
        Some([at(a)?, at(b)?, at(c)?])
    }

    fn in_scene(&self, vertex: Vec3) -> DVec3 {
        self.pose.map_or(vector(vertex), |(turn, origin)| turn * vector(vertex) + origin)
    }

    /// The corners of a triangle as they are described.
    pub(super) fn corners(&self, triangle: u32) -> Option<[DVec3; 3]> {
        Some(self.vertices(triangle)?.map(|vertex| self.in_scene(vertex)))
    }

    /// The corners of a triangle where they were moved to.
    pub(super) fn moved_corners(&self, triangle: u32) -> Option<[DVec3; 3]> {
        Some(self.vertices(triangle)?.map(|vertex| self.in_scene(vertex) + self.shift(vertex)))
    }

    fn place(&self, vertex: Vec3) -> Place {
        match self.pose {
            Some(_) => [0; 3],
            None => [vertex.x, vertex.y, vertex.z].map(|coordinate| (coordinate + 0.0).to_bits()),
        }
    }

    fn shift(&self, vertex: Vec3) -> DVec3 {
        self.shifts.get(&self.place(vertex)).copied().unwrap_or(DVec3::ZERO)
    }

    /// Whether any part was moved.
    pub(super) fn is_moved(&self) -> bool {
        !self.shifts.is_empty()
    }

    /// Moves triangles to their depths. In a mesh, connected triangles in the plane of one that moves have
    /// the same depth, so that the plane keeps its normal. Each triangle that is looked at takes one of
    /// `steps`.
    pub(super) fn hide(&mut self, hidden: &[Hidden], steps: &mut u64) {
        if self.pose.is_some() {
            hidden.iter().for_each(|hidden| self.push(hidden.triangle, &hidden.plane, hidden.depth));
            return;
        }
        let around = if hidden.is_empty() { HashMap::new() } else { self.around() };
        let depths: HashMap<u32, f64> = hidden.iter().map(|hidden| (hidden.triangle, hidden.depth)).collect();
        let mut known = HashSet::new();
        for first in hidden {
            if !known.insert(first.triangle) {
                continue;
            }
            let (mut connected, mut next, mut depth) = (vec![first.triangle], 0, first.depth);
            while let Some(triangle) = connected.get(next).copied() {
                next += 1;
                depth = depths.get(&triangle).map_or(depth, |own| depth.max(*own));
                for vertex in self.vertices(triangle).into_iter().flatten() {
                    for other in around.get(&self.place(vertex)).into_iter().flatten() {
                        *steps = steps.saturating_sub(1);
                        if *steps > 0 && self.is_in(first, *other) && known.insert(*other) {
                            connected.push(*other);
                        }
                    }
                }
            }
            connected.iter().for_each(|triangle| self.push(*triangle, &first.plane, depth));
        }
    }

    /// The triangles around each place.
    fn around(&self) -> HashMap<Place, Vec<u32>> {
        let mut around: HashMap<_, Vec<_>> = HashMap::new();
        for triangle in self.triangles() {
            for vertex in self.vertices(triangle).into_iter().flatten() {
                around.entry(self.place(vertex)).or_default().push(triangle);
            }
        }
        around
    }

    /// Whether a triangle lies in the plane of a hidden one.
    fn is_in(&self, hidden: &Hidden, triangle: u32) -> bool {
        let is_near = |corner: DVec3| hidden.plane.height(corner).abs() <= hidden.tolerance;
        self.corners(triangle).is_some_and(|corners| corners.into_iter().all(is_near))
    }

    /// Moves a triangle to a depth behind a plane, where it is not as deep.
    fn push(&mut self, triangle: u32, plane: &Plane, depth: f64) {
        for vertex in self.vertices(triangle).into_iter().flatten() {
            let at = self.in_scene(vertex) + self.shift(vertex);
            *self.shifts.entry(self.place(vertex)).or_insert(DVec3::ZERO) += plane.shift(at, depth);
        }
    }

    /// The mesh with its vertices where they were moved to.
    pub(super) fn shape(&self, arena: &'a Bump) -> Shape<'a> {
        let moved = |vertex: &Vec3| rounded(vector(*vertex) + self.shift(*vertex));
        let vertices = arena.alloc_slice_fill_iter(self.mesh.vertices.iter().map(moved));
        Shape::Mesh(Mesh { vertices, ..self.mesh })
    }

    /// The pose of the instance where it was moved to.
    pub(super) fn moved_pose(&self, pose: &Pose) -> Pose {
        Pose { origin: rounded(vector(pose.origin) + self.shift(Vec3::ZERO)), ..*pose }
    }
}

/// A point within the limits of a scene.
fn rounded(point: DVec3) -> Vec3 {
    let [x, y, z] = point.as_vec3().to_array().map(|at| at.clamp(-MAX_COORDINATE, MAX_COORDINATE));
    Vec3::new(x, y, z)
}
