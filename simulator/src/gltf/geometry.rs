//! Triangles, normals and texture coordinates of meshes (glTF 2.0 Specification, section 3.7).

use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use rayline::Vec3;
use rayline::limits::MAX_COORDINATE;

use super::accessor::{Lists, MOST};
use super::error::{At, GltfFault, Wrong};
use super::nodes::Place;
use super::textures::Coordinates;
use crate::model::{FARTHEST_UV, Whole};

/// A primitive of a mesh, in the place of a node.
#[derive(Clone, Debug)]
pub(super) struct Geometry {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    normals: Option<Vec<Vec3>>,
    uvs: Option<Vec<[f32; 2]>>,
    /// What of it is left out.
    pub(super) notes: Vec<&'static str>,
}

impl Geometry {
    /// Reads the triangles of a primitive. `room` is how many vertices, and triangles, may still come.
    pub(super) fn read(
        lists: Lists<'_>,
        primitive: &Primitive,
        place: &Place,
        coordinates: &Coordinates,
        room: &mut usize,
    ) -> Result<Self, Wrong> {
        let mut notes = Vec::new();
        let mode = match primitive.mode {
            Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => mode,
            Checked::Valid(_) => {
                notes.push("points and lines are left out");
                return Ok(Self {
                    vertices: Vec::new(),
                    triangles: Vec::new(),
                    normals: None,
                    uvs: None,
                    notes,
                });
            }
            Checked::Invalid => {
                let found = "what is none of glTF's".to_owned();
                return Err(GltfFault::Kind { expected: "a mode from 0 to 6", found }.into());
            }
        };
        if primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty()) {
            notes.push("morph targets are left out");
        }
        let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        if attribute(Semantic::Colors(0)).is_some() {
            notes.push("colors of vertices are left out");
        }
        let Some(positions) = attribute(Semantic::Positions) else {
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
        let matches = |given: usize| match given == vertices.len() {
            true => Ok(()),
            false => Err(GltfFault::Kind {
                expected: "as many as positions",
                found: format!("{given} for {}", vertices.len()),
            }),
        };
        let normals = match attribute(Semantic::Normals) {
            Some(normals) => Some(lists.vectors::<3>(normals).at(|| "NORMAL".to_owned())?),
            None => None,
        };
        if let Some(normals) = &normals {
            matches(normals.len()).at(|| "NORMAL".to_owned())?;
        }
        let normals = normals.map(|normals| normals.into_iter().map(place.of_normals()).collect());
        let mut uvs = None;
        if let Some(given) = attribute(Semantic::TexCoords(coordinates.set)) {
            let at = || format!("TEXCOORD_{}", coordinates.set);
            let given = lists.vectors::<2>(given).at(at)?;
            matches(given.len()).at(at)?;
            let given: Vec<_> = given.into_iter().map(|uv| coordinates.upward(uv)).collect();
            if given.as_flattened().iter().all(|coordinate| coordinate.abs() <= FARTHEST_UV) {
                uvs = Some(given);
            } else {
                notes.push("texture coordinates are left out: some are beyond ±59");
            }
        }
        let corners = match primitive.indices {
            Some(indices) => lists.indices(indices).at(|| "indices".to_owned())?,
            None => (0..vertices.len() as u32).collect(),
        };
        if let Some(unknown) = corners.iter().find(|corner| **corner as usize >= vertices.len()) {
            let (named, count) = (*unknown as usize, vertices.len());
            return Err(GltfFault::Unknown { what: "vertex", named, count }).at(|| "indices".to_owned());
        }
        let mut triangles = triangles(mode, &corners);
        if place.mirrors() {
            for [_, second, third] in &mut triangles {
                core::mem::swap(second, third);
            }
        }
        Ok(Self { vertices, triangles, normals, uvs, notes })
    }

    /// Whether it has texture coordinates.
    pub(super) fn has_uvs(&self) -> bool {
        self.uvs.is_some()
    }

    /// Whether there is no triangle.
    pub(super) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    pub(super) fn whole(&self) -> Whole<'_> {
        Whole {
            vertices: &self.vertices,
            triangles: &self.triangles,
            normals: self.normals.as_deref(),
            uvs: self.uvs.as_deref(),
        }
    }
}

/// A vertex in the scene, if it is in reach.
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
        // Every second one runs the other way.
        Mode::TriangleStrip => windows()
            .enumerate()
            .map(|(index, [a, b, c])| if index % 2 == 0 { [a, b, c] } else { [a, c, b] })
            .collect(),
        Mode::TriangleFan => match corners.split_first() {
            Some((hub, rim)) => {
                rim.windows(2).filter_map(|edge| edge.first_chunk()).map(|[a, b]| [*a, *b, *hub]).collect()
            }
            None => Vec::new(),
        },
        _ => corners.as_chunks::<3>().0.to_vec(),
    }
}
