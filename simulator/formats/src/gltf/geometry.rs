//! Triangles, normals and texture coordinates of meshes (glTF 2.0 Specification, section 3.7).

use rayline::Vec3;
use rayline::limits::MAX_COORDINATE;

use super::accessor::{Lists, MOST};
use super::error::{At, GltfFault, Wrong};
use super::json::Primitive;
use super::nodes::Place;
use super::textures::Coordinates;
use crate::model::{FARTHEST_UV, Whole};

/// How triangles follow from corners.
#[derive(Clone, Copy, Debug)]
enum Mode {
    /// Each three corners are a triangle.
    Triangles,
    /// Each corner makes a triangle with the two before it.
    Strip,
    /// Each corner makes a triangle with the one before it and the first.
    Fan,
}

/// A primitive of a mesh, in the coordinates of the scene.
#[derive(Clone, Debug, Default)]
pub(super) struct Geometry {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    normals: Option<Vec<Vec3>>,
    uvs: Option<Vec<[f32; 2]>>,
    /// Notes about parts that are left out.
    pub(super) notes: Vec<&'static str>,
}

impl Geometry {
    /// Reads the triangles of a primitive. `room` is the number of vertices and corners of triangles that may
    /// still be read.
    pub(super) fn read(
        lists: Lists<'_>,
        primitive: &Primitive,
        place: &Place,
        coordinates: &Coordinates,
        room: &mut usize,
    ) -> Result<Self, Wrong> {
        let mode = match primitive.mode {
            4 => Mode::Triangles,
            5 => Mode::Strip,
            6 => Mode::Fan,
            0..=3 => {
                let notes = vec!["points and lines are left out"];
                return Ok(Self { notes, ..Self::default() });
            }
            other => {
                let found = other.to_string();
                return Err(GltfFault::Kind { expected: "a mode from 0 to 6", found }.into());
            }
        };
        let mut notes = left_out(primitive);
        let attribute = |meaning: &str| primitive.attributes.get(meaning).copied();
        let Some(positions) = attribute("POSITION") else {
            let found = "none".to_owned();
            return Err(GltfFault::Kind { expected: "an attribute POSITION", found }.into());
        };
        let corners = primitive.indices.unwrap_or(positions);
        let needed = lists.count(positions)?.saturating_add(lists.count(corners)?);
        let too_many = GltfFault::TooMany { what: "vertices and corners of triangles", most: MOST };
        *room = room.checked_sub(needed).ok_or(too_many)?;

        let positions = lists.vectors::<3>(positions).at(|| "POSITION".to_owned())?;
        let vertices =
            positions.iter().map(|position| placed(place, *position)).collect::<Result<Vec<_>, _>>()?;
        let normals = match attribute("NORMAL") {
            Some(normals) => Some(self::normals(lists, normals, place, vertices.len())?),
            None => None,
        };
        let uvs = match attribute(&format!("TEXCOORD_{}", coordinates.set)) {
            Some(uvs) => Some(self::uvs(lists, uvs, coordinates, vertices.len())?),
            None => None,
        };
        if uvs.as_ref().is_some_and(|uvs| is_too_far(uvs)) {
            notes.push("texture coordinates are left out: some are beyond ±59");
        }
        let corners = match primitive.indices {
            Some(indices) => lists.indices(indices).at(|| "indices".to_owned())?,
            None => (0..vertices.len() as u32).collect(),
        };
        check_corners(&corners, vertices.len()).at(|| "indices".to_owned())?;
        let mut triangles = triangles(mode, &corners);
        if place.mirrors() {
            for [_, second, third] in &mut triangles {
                core::mem::swap(second, third);
            }
        }
        let uvs = uvs.filter(|uvs| !is_too_far(uvs));
        Ok(Self { vertices, triangles, normals, uvs, notes })
    }

    /// Whether the primitive has texture coordinates.
    pub(super) fn has_uvs(&self) -> bool {
        self.uvs.is_some()
    }

    /// Whether the primitive has no triangles.
    pub(super) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    pub(super) fn whole(&self) -> Whole<'_> {
        Whole {
            vertices: &self.vertices,
            triangles: &self.triangles,
            normals: self.normals.as_deref(),
            uvs: self.uvs.as_deref(),
            colors: None,
        }
    }
}

/// Notes about parts of a primitive that are left out.
fn left_out(primitive: &Primitive) -> Vec<&'static str> {
    let has_targets = !primitive.targets.is_empty();
    let has_colors = primitive.attributes.contains_key("COLOR_0");
    let notes =
        [(has_targets, "morph targets are left out"), (has_colors, "colors of vertices are left out")];
    notes.into_iter().filter_map(|(is_there, note)| is_there.then_some(note)).collect()
}

/// The normals of a primitive with this number of vertices.
fn normals(lists: Lists<'_>, accessor: usize, place: &Place, vertices: usize) -> Result<Vec<Vec3>, Wrong> {
    let at = || "NORMAL".to_owned();
    let normals = lists.vectors::<3>(accessor).at(at)?;
    check_count(normals.len(), vertices).at(at)?;
    Ok(normals.into_iter().map(place.of_normals()).collect())
}

/// The texture coordinates of a primitive with this number of vertices.
fn uvs(
    lists: Lists<'_>,
    accessor: usize,
    coordinates: &Coordinates,
    vertices: usize,
) -> Result<Vec<[f32; 2]>, Wrong> {
    let at = || format!("TEXCOORD_{}", coordinates.set);
    let uvs = lists.vectors::<2>(accessor).at(at)?;
    check_count(uvs.len(), vertices).at(at)?;
    Ok(uvs.into_iter().map(|uv| coordinates.upward(uv)).collect())
}

/// Whether texture coordinates are beyond the range of fixed point.
fn is_too_far(uvs: &[[f32; 2]]) -> bool {
    uvs.as_flattened().iter().any(|coordinate| !(coordinate.abs() <= FARTHEST_UV))
}

/// Refuses a list that does not have one element for each vertex.
fn check_count(given: usize, vertices: usize) -> Result<(), GltfFault> {
    match given == vertices {
        true => Ok(()),
        false => Err(GltfFault::Kind {
            expected: "as many as positions",
            found: format!("{given} for {vertices}"),
        }),
    }
}

/// Refuses a corner of a triangle that is none of the vertices.
fn check_corners(corners: &[u32], vertices: usize) -> Result<(), GltfFault> {
    match corners.iter().find(|corner| **corner as usize >= vertices) {
        Some(unknown) => {
            Err(GltfFault::Unknown { what: "vertex", named: *unknown as usize, count: vertices })
        }
        None => Ok(()),
    }
}

/// A vertex in the coordinates of the scene, or an error if it is out of range.
fn placed(place: &Place, position: [f32; 3]) -> Result<Vec3, GltfFault> {
    let point = place.point(position);
    let beyond = [point.x, point.y, point.z].into_iter().find(|number| !(number.abs() <= MAX_COORDINATE));
    match beyond {
        Some(found) => Err(GltfFault::Number { meaning: "a coordinate in the scene", found: found.into() }),
        None => Ok(point),
    }
}

fn triangles(mode: Mode, corners: &[u32]) -> Vec<[u32; 3]> {
    let windows = || corners.windows(3).filter_map(|window| window.first_chunk::<3>().copied());
    match mode {
        // Every second triangle of a strip has the opposite orientation.
        Mode::Strip => windows()
            .enumerate()
            .map(|(index, [a, b, c])| if index % 2 == 0 { [a, b, c] } else { [a, c, b] })
            .collect(),
        Mode::Fan => match corners.split_first() {
            Some((hub, rim)) => {
                rim.windows(2).filter_map(|edge| edge.first_chunk()).map(|[a, b]| [*a, *b, *hub]).collect()
            }
            None => Vec::new(),
        },
        Mode::Triangles => corners.as_chunks::<3>().0.to_vec(),
    }
}
