//! Meshes from the statements of an OBJ file: polygons become triangles, and corners become vertices.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use glam::DVec3;
use rayline::Vec3;
use rayline::limits::MAX_COUNT;

use super::error::{LineError, ObjFault};
use super::statements::{Contents, Corner, Face};
use crate::model::{FARTHEST_UV, Moved, Whole, polygon};
use crate::nff::Excerpt;
use crate::notes::Notes;

/// The faces of a file, checked.
pub(super) struct Faces<'c> {
    contents: &'c Contents,
    /// The colors of vertices, as codes of sRGB.
    colors: Option<Vec<[u8; 3]>>,
    /// The faces that can be drawn, with their corners.
    all: Vec<Placed>,
    /// The translation and scale of all vertices.
    pub(super) moved: Moved,
    /// The normals of vertices in smoothing groups: sums, weighted by angle.
    smooth: HashMap<(u32, u32), DVec3>,
    path: &'c str,
}

/// A face and the places of its corners in the list of corners.
#[derive(Clone, Debug)]
struct Placed {
    face: Face,
    corners: Range<usize>,
    /// The unit normal; zero for a face without an area.
    normal: DVec3,
}

/// The faces of a mesh: a group and a material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Group {
    /// The name in the file.
    pub(super) name: String,
    /// The position of the material's name; `None` for faces before the first `usemtl`.
    pub(super) material: Option<u32>,
    /// Positions of its faces.
    faces: Vec<usize>,
}

/// A mesh of any size.
#[derive(Debug, Default)]
pub(super) struct Assembled {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<Vec3>,
    uvs: Option<Vec<[f32; 2]>>,
    /// Empty if no vertex of the file has a color.
    colors: Vec<[u8; 3]>,
}

/// How the vertices of a mesh get texture coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Uvs {
    None,
    AsGiven,
    /// In each face by whole numbers.
    Reduced,
}

/// The source of a corner's normal, which distinguishes vertices at one place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Source {
    /// The mesh has no normals.
    None,
    /// A normal of the file.
    Given(u32),
    /// A smoothing group.
    Smooth(u32),
    /// The face.
    Flat(u32),
}

/// The identity of a vertex in a mesh: its place, its texture coordinates and the whole numbers that are
/// taken from them, and its normal.
type Identity = (u32, Option<(u32, [i64; 2])>, Source);

impl<'c> Faces<'c> {
    /// Checks all faces. Missing texture coordinates and normals give notes, missing vertices an error.
    pub(super) fn new(contents: &'c Contents, path: &'c str, notes: &mut Notes) -> Result<Self, LineError> {
        let colors = contents.colors();
        let (all, smooth) = (Vec::new(), HashMap::new());
        let mut faces = Self { contents, colors, all, moved: Moved::NOT, smooth, path };
        let mut end = 0usize;
        for face in &contents.faces {
            let corners = end..end.saturating_add(face.corners as usize);
            end = corners.end;
            let placed = Placed { face: *face, corners, normal: DVec3::ZERO };
            if faces.check(&placed, notes)? {
                faces.all.push(placed);
            }
        }
        let used = faces.all.iter().flat_map(|placed| faces.corners(placed));
        faces.moved = Moved::of(used.map(|corner| faces.file_vertex(corner.vertex)), false);
        let normals: Vec<_> = faces.all.iter().map(|placed| faces.face_normal(placed)).collect();
        for (placed, normal) in faces.all.iter_mut().zip(normals) {
            placed.normal = normal;
        }
        faces.smooth();
        Ok(faces)
    }

    /// Whether a face can be drawn.
    fn check(&self, placed: &Placed, notes: &mut Notes) -> Result<bool, LineError> {
        let line = placed.face.line as usize;
        let mut note = |what: &str| notes.add(format!("{}:{line}", self.path), what);
        let mut is_drawn = true;
        for corner in self.corners(placed) {
            match self.contents.vertices.get(corner.vertex as usize) {
                None => {
                    let (found, count) =
                        ((u64::from(corner.vertex) + 1).to_string(), self.contents.vertices.len());
                    return Err(LineError { line, fault: ObjFault::Unknown { found, count } });
                }
                Some(vertex) => is_drawn &= vertex.is_finite(),
            }
            if corner.uv.is_some() && self.uv(corner).is_none() {
                note("a texture coordinate that is not there is left out");
            }
            if corner.normal.is_some() && self.given_normal(corner).is_none() {
                note("a normal that is not there is left out");
            }
        }
        if !is_drawn {
            note("left out: a face with a vertex that is no number");
        }
        Ok(is_drawn)
    }

    fn corners(&self, placed: &Placed) -> &'c [Corner] {
        self.contents.corners.get(placed.corners.clone()).unwrap_or_default()
    }

    fn file_vertex(&self, vertex: u32) -> DVec3 {
        self.contents.vertices.get(vertex as usize).copied().unwrap_or_default()
    }

    /// The places of a face's corners.
    fn places(&self, placed: &Placed) -> Vec<DVec3> {
        self.corners(placed).iter().map(|corner| self.moved.vertex(self.file_vertex(corner.vertex))).collect()
    }

    /// The unit normal of a face; zero for a face without an area. If the file has normals, they decide which
    /// side is the front, whatever the order of the corners.
    fn face_normal(&self, placed: &Placed) -> DVec3 {
        let normal = polygon::normal(&self.places(placed)).try_normalize().unwrap_or(DVec3::ZERO);
        let given = self.corners(placed).iter().find_map(|corner| self.given_normal(corner));
        let is_back = given.is_some_and(|(_, given)| given.dot(normal) < 0.0);
        if is_back { -normal } else { normal }
    }

    /// The position of a corner's texture coordinates, if they are there, and the coordinates.
    fn uv(&self, corner: &Corner) -> Option<(u32, [f64; 2])> {
        let position = corner.uv?;
        let uv = self.contents.uvs.get(position as usize)?;
        uv.iter().all(|number| number.is_finite()).then_some((position, *uv))
    }

    fn given_normal(&self, corner: &Corner) -> Option<(u32, DVec3)> {
        let position = corner.normal?;
        let normal = self.contents.normals.get(position as usize)?;
        normal.is_finite().then_some((position, *normal))
    }

    /// Sums up the normals of smoothing groups at their vertices, each weighted by the angle of its face
    /// there (Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998).
    fn smooth(&mut self) {
        let mut smooth = HashMap::new();
        for placed in &self.all {
            let (group, corners) = (placed.face.smoothing, self.corners(placed));
            if group == 0 || corners.iter().all(|corner| self.given_normal(corner).is_some()) {
                continue;
            }
            let places = self.places(placed);
            let last = places.len().saturating_sub(1);
            let at = |index: usize| places.get(index).copied().unwrap_or_default();
            for (index, corner) in corners.iter().enumerate() {
                let before = at(if index == 0 { last } else { index - 1 }) - at(index);
                let after = at(if index == last { 0 } else { index + 1 }) - at(index);
                let angle = before.angle_between(after);
                if angle.is_finite() {
                    *smooth.entry((corner.vertex, group)).or_insert(DVec3::ZERO) += placed.normal * angle;
                }
            }
        }
        self.smooth = smooth;
    }

    /// The meshes in the order of the file. If there are more than a scene can have, those of one material
    /// become one.
    pub(super) fn groups(&self) -> Vec<Group> {
        let is_few = self.contents.parts.len() < MAX_COUNT / 2;
        let mut groups: Vec<Group> = Vec::new();
        let mut places = HashMap::new();
        for (index, placed) in self.all.iter().enumerate() {
            let Some(part) = self.contents.parts.get(placed.face.part as usize) else { continue };
            let key = if is_few { (placed.face.part, None) } else { (0, part.material) };
            let place = *places.entry(key).or_insert(groups.len());
            if place == groups.len() {
                let (name, material) = (part.name.clone(), part.material);
                groups.push(Group { name, material, faces: Vec::new() });
            }
            if let Some(group) = groups.get_mut(place) {
                group.faces.push(index);
            }
        }
        groups
    }

    /// The group in two: the faces whose corners all have texture coordinates, and the others.
    pub(super) fn split(&self, group: Group) -> [Group; 2] {
        let has_uvs = |index: &usize| {
            let corners = self.all.get(*index).map(|placed| self.corners(placed));
            corners.is_some_and(|corners| corners.iter().all(|corner| self.uv(corner).is_some()))
        };
        let Group { name, material, faces } = group;
        let (with, without) = faces.into_iter().partition(has_uvs);
        [Group { name: name.clone(), material, faces: with }, Group { name, material, faces: without }]
    }

    /// The faces of a group, with their positions.
    fn of<'g>(&'g self, group: &'g Group) -> impl Iterator<Item = (usize, &'g Placed)> {
        group.faces.iter().filter_map(|index| Some((*index, self.all.get(*index)?)))
    }

    /// The triangles of a group. Texture coordinates may be reduced by whole numbers if textures repeat.
    pub(super) fn assemble(&self, group: &Group, repeats: bool, notes: &mut Notes) -> Assembled {
        let has_normals = self.of(group).any(|(_, placed)| {
            placed.face.smoothing > 0
                || self.corners(placed).iter().any(|corner| self.given_normal(corner).is_some())
        });
        let uvs = self.uvs_of(group, repeats, notes);
        let mut mesh = Assembled { uvs: (uvs != Uvs::None).then(Vec::new), ..Assembled::default() };
        let (mut polygons, mut known) = (polygon::Polygons::default(), HashMap::new());
        for (index, placed) in self.of(group) {
            let (triangles, covers) = polygons.triangles(&self.places(placed));
            if !covers {
                let most = polygon::MOST_CORNERS;
                let what = "cut as a fan: a face that crosses itself, or has notches and more than";
                notes.add(format!("{}:{}", self.path, placed.face.line), format!("{what} {most} corners"));
            }
            let period = if uvs == Uvs::Reduced { self.period(placed) } else { [0.0; 2] };
            let vertex = |corner: &Corner| {
                let uv = if uvs == Uvs::None { None } else { self.reduced(corner, period) };
                let source = if has_normals { self.source(index, placed, corner) } else { Source::None };
                let identity: Identity = (corner.vertex, uv.map(|(at, period, _)| (at, period)), source);
                *known.entry(identity).or_insert_with(|| {
                    let normal = has_normals.then(|| self.normal(placed, source, corner.vertex));
                    let place = self.moved.rounded(self.file_vertex(corner.vertex));
                    mesh.colors.extend(self.color(corner.vertex));
                    mesh.add_vertex(place, uv.map(|(.., uv)| uv), normal)
                })
            };
            let vertices: Vec<u32> = self.corners(placed).iter().map(vertex).collect();
            let vertex = |corner: u32| vertices.get(corner as usize).copied().unwrap_or_default();
            mesh.add_triangles(triangles.iter().map(|triangle| triangle.map(vertex)), vertices.len() > 4);
        }
        mesh
    }

    /// How the vertices of a group get texture coordinates, with a note if they are left out.
    fn uvs_of(&self, group: &Group, repeats: bool, notes: &mut Notes) -> Uvs {
        let corners = || self.of(group).flat_map(|(_, placed)| self.corners(placed));
        let known = corners().filter(|corner| self.uv(corner).is_some()).count();
        if known == 0 {
            return Uvs::None;
        }
        let mut note = |what: &str| {
            notes.add(format!("{}: `{}`", self.path, Excerpt(&group.name)), what);
            Uvs::None
        };
        if known != corners().count() {
            return note("texture coordinates are left out: not all of its corners have them");
        }
        let is_far = |(.., uv): (u32, [i64; 2], [f64; 2])| {
            uv.iter().any(|number| number.abs() > f64::from(FARTHEST_UV))
        };
        let reaches_far = |placed: &Placed, period| {
            self.corners(placed).iter().filter_map(|corner| self.reduced(corner, period)).any(is_far)
        };
        if !self.of(group).any(|(_, placed)| reaches_far(placed, [0.0; 2])) {
            return Uvs::AsGiven;
        }
        if repeats && !self.of(group).any(|(_, placed)| reaches_far(placed, self.period(placed))) {
            return Uvs::Reduced;
        }
        note("texture coordinates are left out: some are beyond ±59")
    }

    /// The color of a vertex, if the file has colors.
    fn color(&self, vertex: u32) -> Option<[u8; 3]> {
        self.colors.as_ref()?.get(vertex as usize).copied()
    }

    /// The position of a corner's texture coordinates, and the coordinates without a whole number of periods.
    fn reduced(&self, corner: &Corner, period: [f64; 2]) -> Option<(u32, [i64; 2], [f64; 2])> {
        let (position, [u, v]) = self.uv(corner)?;
        Some((position, period.map(|number| number as i64), [u - period[0], v - period[1]]))
    }

    /// The whole numbers by which the texture coordinates of a face can be reduced.
    fn period(&self, placed: &Placed) -> [f64; 2] {
        let (mut sum, mut count) = ([0.0; 2], 0.0);
        for (_, [u, v]) in self.corners(placed).iter().filter_map(|corner| self.uv(corner)) {
            (sum, count) = ([sum[0] + u, sum[1] + v], count + 1.0);
        }
        sum.map(|sum| if count > 0.0 { (sum / count).floor() } else { 0.0 })
    }

    fn source(&self, index: usize, placed: &Placed, corner: &Corner) -> Source {
        let group = placed.face.smoothing;
        match self.given_normal(corner) {
            Some((position, _)) => Source::Given(position),
            None if group > 0 && self.smooth_normal(corner.vertex, group).is_some() => Source::Smooth(group),
            None => Source::Flat(index as u32),
        }
    }

    fn smooth_normal(&self, vertex: u32, group: u32) -> Option<DVec3> {
        self.smooth.get(&(vertex, group))?.try_normalize()
    }

    fn normal(&self, placed: &Placed, source: Source, vertex: u32) -> Vec3 {
        let normal = match source {
            Source::Given(position) => self.contents.normals.get(position as usize).copied(),
            Source::Smooth(group) => self.smooth_normal(vertex, group),
            Source::Flat(_) | Source::None => Some(placed.normal),
        };
        let [x, y, z] = normal.unwrap_or_default().as_vec3().to_array();
        Vec3::new(x, y, z)
    }
}

impl Assembled {
    /// Adds a vertex, and returns its position.
    fn add_vertex(&mut self, place: Vec3, uv: Option<[f64; 2]>, normal: Option<Vec3>) -> u32 {
        self.vertices.push(place);
        self.normals.extend(normal);
        if let (Some(uvs), Some(uv)) = (&mut self.uvs, uv) {
            uvs.push(uv.map(|number| number as f32));
        }
        (self.vertices.len() - 1) as u32
    }

    /// Adds the triangles of a face. A face may go around several times: each triangle is needed once.
    fn add_triangles(&mut self, triangles: impl Iterator<Item = [u32; 3]>, may_repeat: bool) {
        let mut known = HashSet::new();
        self.triangles.extend(triangles.filter(|triangle| {
            let mut corners = *triangle;
            corners.sort_unstable();
            let [a, b, c] = corners;
            !may_repeat || (a != b && b != c && known.insert(corners))
        }));
    }

    /// Whether the vertices have colors.
    pub(super) fn is_colored(&self) -> bool {
        self.colors.iter().any(|codes| *codes != [u8::MAX; 3])
    }

    /// The mesh in the form that is split for the core.
    pub(super) fn whole(&self) -> Whole<'_> {
        Whole {
            vertices: &self.vertices,
            triangles: &self.triangles,
            normals: (!self.normals.is_empty()).then_some(&self.normals),
            uvs: self.uvs.as_deref(),
            colors: self.is_colored().then_some(&self.colors),
        }
    }

    /// The mean length of a unit of the texture coordinates on the surface, in units of the scene; `None`
    /// without texture coordinates.
    pub(super) fn length_of_uv(&self) -> Option<f64> {
        let uvs = self.uvs.as_ref()?;
        let (mut area, mut area_of_uv) = (0.0, 0.0);
        for triangle in &self.triangles {
            let at = |corner: u32| self.vertices.get(corner as usize).copied().unwrap_or(Vec3::ZERO);
            let of = |corner: u32| uvs.get(corner as usize).copied().unwrap_or_default().map(f64::from);
            let ([a, b, c], [p, q, r]) = (triangle.map(at), triangle.map(of));
            area += (b - a).to::<f64>().cross((c - a).to::<f64>()).length();
            area_of_uv += ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])).abs();
        }
        let length = (area / area_of_uv).sqrt();
        Some(if length.is_finite() { length } else { 0.0 })
    }
}
