//! The statements of an OBJ file: vertices, faces, and the state that holds for each face.

use std::collections::HashMap;
use std::str::FromStr;

use glam::DVec3;

use super::error::{LineError, ObjFault};
use super::lines;
use crate::notes::Notes;

/// The largest number of a file: its square is far below the largest `f64`.
pub(super) const LARGEST: f64 = 1e30;

/// The contents of an OBJ file.
#[derive(Clone, Debug, Default)]
pub(super) struct Contents {
    /// The vertices; NaN for those that are no numbers.
    pub(super) vertices: Vec<DVec3>,
    /// The colors of vertices, up to the last vertex that has one.
    colors: Vec<[f32; 3]>,
    /// The texture coordinates; NaN for those that are no numbers.
    pub(super) uvs: Vec<[f64; 2]>,
    /// The normals; NaN for those that have no direction.
    pub(super) normals: Vec<DVec3>,
    /// The corners of all faces, in the order of the faces.
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<Face>,
    pub(super) parts: Vec<Part>,
    /// The names of materials, with the first lines that name them.
    pub(super) materials: Vec<(usize, String)>,
    /// The names of MTL files, with their lines.
    pub(super) libraries: Vec<(usize, String)>,
}

/// The color of a vertex without one.
const WHITE: [f32; 3] = [1.0; 3];

impl Contents {
    /// The colors of all vertices as codes of sRGB; `None` if there are none. Programs write codes from 0 to
    /// 255, or divided by 255.
    pub(super) fn colors(&self) -> Option<Vec<[u8; 3]>> {
        if self.colors.is_empty() {
            return None;
        }
        let is_in_codes = self.colors.iter().flatten().any(|channel| *channel > 1.0);
        let factor = if is_in_codes { 1.0 } else { 255.0 };
        let code = |channel: &f32| (channel * factor).round().clamp(0.0, 255.0) as u8;
        let codes = self.colors.iter().map(|[red, green, blue]| [code(red), code(green), code(blue)]);
        let missing = self.vertices.len().saturating_sub(self.colors.len());
        Some(codes.chain(core::iter::repeat_n([u8::MAX; 3], missing)).collect())
    }
}

/// A corner of a face: positions in the lists of a file, which may be beyond their ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) vertex: u32,
    pub(super) uv: Option<u32>,
    pub(super) normal: Option<u32>,
}

/// A face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Face {
    /// The number of its corners.
    pub(super) corners: u32,
    pub(super) line: u32,
    /// The position of its part.
    pub(super) part: u32,
    /// The smoothing group; 0 for none.
    pub(super) smoothing: u32,
}

/// Faces in a row with the same group and material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Part {
    /// The name of the group.
    pub(super) name: String,
    /// The position of the material's name.
    pub(super) material: Option<u32>,
}

/// The statements for shapes that have no faces.
const LEFT_OUT: [&str; 7] = ["p", "l", "curv", "curv2", "surf", "call", "csh"];

/// The reader of statements, with the state that holds for the next face.
struct Reader<'r> {
    contents: Contents,
    known: HashMap<String, u32>,
    current: Part,
    smoothing: u32,
    /// The name of the file, for notes.
    path: &'r str,
    notes: &'r mut Notes,
}

impl Contents {
    /// Reads and checks all lines of a file. `path` is its name in notes.
    pub(super) fn read(bytes: &[u8], path: &str, notes: &mut Notes) -> Result<Self, LineError> {
        let mut foreign = Notes::default();
        let note_foreign = |line| foreign.add(format!("{path}:{line}"), FOREIGN);
        let mut reader = Reader {
            contents: Self::default(),
            known: HashMap::new(),
            current: Part { name: "unnamed".to_owned(), material: None },
            smoothing: 0,
            path,
            notes,
        };
        for (line, statement) in lines::statements(bytes, note_foreign) {
            reader.read(line, &statement).map_err(|fault| LineError { line, fault })?;
        }
        let contents = reader.contents;
        notes.append(foreign);
        Ok(contents)
    }
}

/// The note about lines that are not UTF-8.
pub(super) const FOREIGN: &str = "not UTF-8, so read as Latin-1 (Windows-1252)";

impl Reader<'_> {
    fn read(&mut self, line: usize, statement: &str) -> Result<(), ObjFault> {
        let statement = statement.trim();
        let mut words = statement.split_whitespace();
        let keyword = words.next().unwrap_or_default();
        let rest = statement.get(keyword.len()..).unwrap_or_default().trim();
        match keyword {
            "v" => self.vertex(line, rest)?,
            "vt" => {
                let u = words.next().and_then(number).unwrap_or(f64::NAN);
                // A third number is for solid textures, and is ignored.
                let v = words.next().map_or(Some(0.0), number).unwrap_or(f64::NAN);
                let is_number = u.is_finite() && v.is_finite();
                if !is_number {
                    self.note(line, "left out: a texture coordinate is no number");
                }
                self.contents.uvs.push(if is_number { [u, v] } else { [f64::NAN; 2] });
            }
            "vn" => {
                let [x, y, z] = [(); 3].map(|()| words.next().and_then(number).unwrap_or(f64::NAN));
                let normal = checked_normal(DVec3::new(x, y, z));
                if normal.is_nan() {
                    self.note(line, "left out: the normal has no direction");
                }
                self.contents.normals.push(normal);
            }
            // `fo` is an old name of `f`.
            "f" | "fo" => self.face(line, words)?,
            "o" | "g" => rest.clone_into(&mut self.current.name),
            "s" => self.smoothing = smoothing(rest),
            "usemtl" => {
                if rest.is_empty() {
                    self.note(line, "`usemtl` without a name");
                }
                self.current.material = Some(self.material(line, rest));
            }
            "mtllib" if rest.is_empty() => self.note(line, "left out: `mtllib` without a name"),
            "mtllib" => self.contents.libraries.push((line, rest.to_owned())),
            other => {
                if let Some(known) = LEFT_OUT.into_iter().find(|known| *known == other) {
                    self.note(line, format!("`{known}` is left out"));
                }
            }
        }
        Ok(())
    }

    fn note(&mut self, line: usize, what: impl Into<String>) {
        self.notes.add(format!("{}:{line}", self.path), what);
    }

    fn vertex(&mut self, line: usize, rest: &str) -> Result<(), ObjFault> {
        let expected = "a coordinate of the vertex";
        let mut words = rest.split_whitespace();
        let mut coordinate = || {
            let found = words.next().unwrap_or_default();
            number(found).ok_or_else(|| ObjFault::Expected { expected, found: found.to_owned() })
        };
        let place = DVec3::new(coordinate()?, coordinate()?, coordinate()?);
        // One more number is a weight, three are a color, and four are both.
        let after: Vec<_> = words.collect();
        let place = match *after {
            [weight] | [weight, _, _, _] => place / number(weight).unwrap_or(1.0),
            _ => place,
        };
        if let [.., red, green, blue] = *after {
            match [red, green, blue].map(number) {
                [Some(red), Some(green), Some(blue)] => {
                    self.contents.colors.resize(self.contents.vertices.len(), WHITE);
                    self.contents.colors.push([red, green, blue].map(|channel| channel as f32));
                }
                _ => self.note(line, "the color of the vertex is left out, as it is no number"),
            }
        }
        if place.abs().max_element() > LARGEST && place.is_finite() {
            return Err(ObjFault::OutOfRange { meaning: "a coordinate", found: rest.to_owned() });
        }
        self.contents.vertices.push(if place.is_finite() { place } else { DVec3::NAN });
        Ok(())
    }

    /// The position of a material's name in the list.
    fn material(&mut self, line: usize, name: &str) -> u32 {
        if let Some(known) = self.known.get(name) {
            return *known;
        }
        let position = self.contents.materials.len() as u32;
        self.contents.materials.push((line, name.to_owned()));
        self.known.insert(name.to_owned(), position);
        position
    }

    fn face<'w>(&mut self, line: usize, words: impl Iterator<Item = &'w str>) -> Result<(), ObjFault> {
        let before = self.contents.corners.len();
        for corner in words {
            // A corner is vertex/texture/normal; all but the first may be missing.
            let mut parts = corner.split('/');
            let found = parts.next().unwrap_or_default();
            let vertex = index(found, self.contents.vertices.len()).map_err(|known| match known {
                true => ObjFault::Unknown { found: found.to_owned(), count: self.contents.vertices.len() },
                false => ObjFault::Expected {
                    expected: "the number of a vertex, a texture coordinate or a normal",
                    found: found.to_owned(),
                },
            })?;
            // A wrong number becomes one beyond the end of the list, which is noted later.
            let mut next = |count| {
                let part = parts.next().filter(|part| !part.is_empty());
                part.map(|part| index(part, count).unwrap_or(u32::MAX))
            };
            let (uv, normal) = (next(self.contents.uvs.len()), next(self.contents.normals.len()));
            self.contents.corners.push(Corner { vertex, uv, normal });
        }
        let corners = self.contents.corners.len() - before;
        if corners < 3 {
            self.contents.corners.truncate(before);
            self.note(line, "left out: a face of fewer than three corners");
            return Ok(());
        }
        if self.contents.parts.last() != Some(&self.current) {
            self.contents.parts.push(self.current.clone());
        }
        self.contents.faces.push(Face {
            corners: corners as u32,
            line: line as u32,
            part: (self.contents.parts.len() - 1) as u32,
            smoothing: self.smoothing,
        });
        Ok(())
    }
}

/// The number of a smoothing group; 0 for none.
fn smoothing(text: &str) -> u32 {
    match text.split_whitespace().next() {
        Some("on") => 1,
        Some(number) => number.parse().unwrap_or(0),
        None => 0,
    }
}

/// A normal within the range of `f32`, unchanged where that is possible; NaN for one without a direction.
fn checked_normal(normal: DVec3) -> DVec3 {
    let largest = normal.abs().max_element();
    match () {
        () if !(normal.is_finite() && largest > 0.0) => DVec3::NAN,
        () if (1e-6..=1e6).contains(&largest) => normal,
        () => (normal / largest).normalize(),
    }
}

/// Parses a number; NaN for what programs write in place of one that they could not compute.
pub(super) fn number(word: &str) -> Option<f64> {
    let is_none = |word: &str| {
        let word = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
        word.starts_with("nan") || word.starts_with("inf") || word.contains(".#")
    };
    f64::from_str(word).ok().or_else(|| is_none(word).then_some(f64::NAN))
}

/// Parses an index, counted from 1, and makes it a position; a relative one counts back from the end of the
/// list so far.
///
/// # Errors
/// The word is no such index; with whether it is a number.
fn index(word: &str, count: usize) -> Result<u32, bool> {
    let number = i64::from_str(word).map_err(|_| false)?;
    let position = if number < 0 { number.saturating_add(count as i64) } else { number.saturating_sub(1) };
    u32::try_from(position).ok().filter(|position| *position < u32::MAX).ok_or(true)
}
