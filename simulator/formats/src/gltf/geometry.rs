//! Triangles, normals and texture coordinates of meshes (glTF 2.0 Specification, section 3.7).

use rayline::Vec3;
use rayline::limits::MAX_COORDINATE;

use super::accessor::{Lists, MOST};
use super::error::{At, GltfFault, Wrong};
use super::json::Primitive;
use super::nodes::Place;
use super::skins::{self, Places};
use super::textures::Coordinates;
use crate::model::Whole;
use crate::srgb::code;

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
    /// Texture coordinates, and how many times they were halved.
    uvs: Option<(Vec<[f32; 2]>, u8)>,
    /// Codes of sRGB.
    colors: Option<Vec<[u8; 3]>>,
    /// Notes about parts that are left out.
    pub(super) notes: Vec<&'static str>,
}

/// The way in which the vertices of a primitive are placed in the scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Posture<'p> {
    /// The transform of the node.
    pub(super) place: &'p Place,
    /// The transforms of the joints of its skin; `None` without a skin.
    pub(super) joints: Option<&'p [Place]>,
    /// The weights of morph targets.
    pub(super) weights: &'p [f32],
}

impl Geometry {
    /// Reads the triangles of a primitive. `room` is the number of vertices and corners of triangles that may
    /// still be read.
    pub(super) fn read(
        lists: Lists<'_>,
        primitive: &Primitive,
        posture: Posture<'_>,
        coordinates: &Coordinates,
        room: &mut usize,
    ) -> Result<Self, Wrong> {
        let nothing = |note| Ok(Self { notes: vec![note], ..Self::default() });
        let mode = match primitive.mode {
            4 => Mode::Triangles,
            5 => Mode::Strip,
            6 => Mode::Fan,
            0..=3 => return nothing("points and lines are left out"),
            other => {
                let found = other.to_string();
                return Err(GltfFault::Kind { expected: "a mode from 0 to 6", found }.into());
            }
        };
        let Some(positions) = primitive.attributes.get("POSITION").copied() else {
            return nothing("left out: it has no positions");
        };
        let corners = primitive.indices.unwrap_or(positions);
        let needed = lists.count(positions)?.saturating_add(lists.count(corners)?);
        let too_many = GltfFault::TooMany { what: "vertices and corners of triangles", most: MOST };
        *room = room.checked_sub(needed).ok_or(too_many)?;

        let mut positions = lists.vectors::<3>(positions).at(|| "POSITION".to_owned())?;
        let corners = match primitive.indices {
            Some(indices) => lists.indices(indices).at(|| "indices".to_owned())?,
            None => (0..positions.len() as u32).collect(),
        };
        check_corners(&corners, positions.len()).at(|| "indices".to_owned())?;
        let mut reading = Reading { lists, primitive, posture, vertices: positions.len(), notes: Vec::new() };
        reading.morph("POSITION", &mut positions);
        let places = reading.places();
        let vertices = positions.iter().enumerate().map(|(vertex, at)| placed(places.of(vertex), *at));
        let vertices = vertices.collect::<Result<Vec<_>, _>>()?;
        let normals = reading.normals(&places);
        let uvs = reading.uvs(coordinates);
        let colors = reading.colors();
        let mut triangles = triangles(mode, &corners);
        if places.mirror() {
            for [_, second, third] in &mut triangles {
                core::mem::swap(second, third);
            }
        }
        Ok(Self { vertices, triangles, normals, uvs, colors, notes: reading.notes })
    }

    /// How many times the texture coordinates of the primitive were halved; `None` if it has none.
    pub(super) fn halvings(&self) -> Option<u8> {
        self.uvs.as_ref().map(|(_, halvings)| *halvings)
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
            uvs: self.uvs.as_ref().map(|(uvs, _)| &**uvs),
            colors: self.colors.as_deref(),
        }
    }
}

/// The reading of the attributes of a primitive's vertices. An attribute that is wrong is left out with a
/// note.
#[derive(Debug)]
struct Reading<'r> {
    lists: Lists<'r>,
    primitive: &'r Primitive,
    posture: Posture<'r>,
    /// The number of vertices.
    vertices: usize,
    notes: Vec<&'static str>,
}

impl Reading<'_> {
    /// Adds the morph targets to positions or normals.
    fn morph(&mut self, meaning: &str, vectors: &mut [[f32; 3]]) {
        let targets = (self.primitive, self.posture.weights);
        if !skins::morph(self.lists, targets, meaning, vectors).unwrap_or(false) {
            self.notes.push("a morph target is left out: it is not one vector for each vertex");
        }
    }

    /// The transforms of the vertices.
    fn places(&mut self) -> Places {
        let place = *self.posture.place;
        let Some(joints) = self.posture.joints else { return Places::One(place) };
        Places::skinned(self.lists, self.primitive, joints, place).unwrap_or_else(|_| {
            self.notes.push("its skin is left out: it is not joints and weights for each vertex");
            Places::One(place)
        })
    }

    /// The values of an attribute; `None` with a note if they are wrong.
    fn attribute<const N: usize>(
        &mut self,
        meaning: &str,
        wrong: &'static str,
        many: &'static str,
    ) -> Option<Vec<[f32; N]>> {
        let accessor = self.primitive.attributes.get(meaning).copied()?;
        let values = self.lists.vectors::<N>(accessor).map_err(|_| wrong);
        let values =
            values.and_then(|values| if values.len() == self.vertices { Ok(values) } else { Err(many) });
        values.map_err(|note| self.notes.push(note)).ok()
    }

    fn normals(&mut self, places: &Places) -> Option<Vec<Vec3>> {
        let mut normals = self.attribute::<3>(
            "NORMAL",
            "normals are left out: they cannot be read",
            "normals are left out: there are not as many as positions",
        )?;
        self.morph("NORMAL", &mut normals);
        Some(match places {
            Places::One(place) => normals.into_iter().map(place.of_normals()).collect(),
            Places::Each(..) => {
                let turned = |(vertex, normal)| places.of(vertex).of_normals()(normal);
                normals.into_iter().enumerate().map(turned).collect()
            }
        })
    }

    /// The colors of vertices. Their opacity is left out.
    fn colors(&mut self) -> Option<Vec<[u8; 3]>> {
        let accessor = self.primitive.attributes.get("COLOR_0").copied()?;
        let wrong = "colors of vertices are left out: they cannot be read";
        let many = "colors of vertices are left out: there are not as many as positions";
        let code = |[r, g, b]: [f32; 3]| [r, g, b].map(|light| code(light.clamp(0.0, 1.0)));
        if self.lists.vectors::<3>(accessor).is_ok() {
            let colors = self.attribute::<3>("COLOR_0", wrong, many)?;
            return Some(colors.into_iter().map(code).collect());
        }
        let colors = self.attribute::<4>("COLOR_0", wrong, many)?;
        if colors.iter().any(|[.., alpha]| *alpha < 0.999) {
            self.notes.push("the opacity of colors of vertices is left out");
        }
        Some(colors.into_iter().map(|[r, g, b, _]| code([r, g, b])).collect())
    }

    fn uvs(&mut self, coordinates: &Coordinates) -> Option<(Vec<[f32; 2]>, u8)> {
        let uvs = self.attribute::<2>(
            &format!("TEXCOORD_{}", coordinates.set),
            "texture coordinates are left out: they cannot be read",
            "texture coordinates are left out: there are not as many as positions",
        )?;
        let mut uvs: Vec<_> = uvs.into_iter().map(|uv| coordinates.upward(uv)).collect();
        let halvings = coordinates.reduce(&mut uvs);
        if halvings.is_none() && coordinates.are_used() {
            self.notes.push("texture coordinates are left out: some are beyond ±30,000,000");
        }
        halvings.map(|halvings| (uvs, halvings))
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
