//! The statements of an OBJ file: each line is checked, and written again for `tobj`.
//!
//! The errors of `tobj` have no line numbers, and it takes polylines for faces. So it receives only the
//! statements for meshes, with valid numbers and absolute indices.

use core::fmt::Write;
use std::collections::BTreeMap;
use std::str::FromStr;

use rayline::limits::MAX_COORDINATE;

use super::error::{LineError, ObjFault};

/// The checked statements of an OBJ file.
#[derive(Clone, Debug, Default)]
pub(super) struct Statements {
    /// The statements for meshes, as text for `tobj`.
    pub(super) text: String,
    /// The names of MTL files, with their lines.
    pub(super) libraries: Vec<(usize, String)>,
    /// The names of materials, with their lines.
    pub(super) materials: Vec<(usize, String)>,
    /// The statements that were left out although they have a meaning, with the first line of each.
    pub(super) left_out: BTreeMap<&'static str, usize>,
}

/// The numbers of vertices, texture coordinates and normals so far.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    vertices: usize,
    uvs: usize,
    normals: usize,
}

/// The statements for shapes that have no faces.
const LEFT_OUT: [&str; 6] = ["p", "l", "curv", "curv2", "surf", "call"];

impl Statements {
    /// Reads and checks all lines.
    pub(super) fn new(text: &str) -> Result<Self, LineError> {
        // All materials are in one library, whose name does not matter.
        let mut statements = Self { text: "mtllib materials\n".to_owned(), ..Self::default() };
        let mut counts = Counts::default();
        for (line, statement) in lines(text) {
            statements.read(line, &statement, &mut counts).map_err(|fault| LineError { line, fault })?;
        }
        Ok(statements)
    }

    fn read(&mut self, line: usize, statement: &str, counts: &mut Counts) -> Result<(), ObjFault> {
        let mut words = statement.split_whitespace();
        let keyword = words.next().unwrap_or_default();
        let rest = statement.trim_start().get(keyword.len()..).unwrap_or_default().trim();
        match keyword {
            "v" => {
                let [x, y, z] = numbers(&mut words, "a coordinate of the vertex")?;
                // One more number is a weight; three more are a color, which is ignored.
                let after: Vec<_> = words.collect();
                let weight = match *after {
                    [weight] => number(Some(weight), "the weight of the vertex")?,
                    _ => 1.0,
                };
                let place = [x, y, z].map(|coordinate| coordinate / weight);
                if place.into_iter().any(|coordinate| !(coordinate.abs() <= MAX_COORDINATE)) {
                    return Err(ObjFault::OutOfRange { meaning: "a coordinate", found: rest.to_owned() });
                }
                counts.vertices += 1;
                self.vector("v", place);
            }
            "vt" => {
                let expected = "a texture coordinate";
                let u = number(words.next(), expected)?;
                // A third number is for solid textures, and is ignored.
                let v = words.next().map_or(Ok(0.0), |word| number(Some(word), expected))?;
                counts.uvs += 1;
                self.text += &format!("vt {u} {v}\n");
            }
            "vn" => {
                let normal = numbers(&mut words, "a coordinate of the normal")?;
                counts.normals += 1;
                self.vector("vn", normal);
            }
            "f" => self.face(words, counts)?,
            "o" | "g" => self.text += &format!("g {rest}\n"),
            "usemtl" => {
                let name = named(rest, "the name of a material")?;
                self.text += &format!("usemtl {name}\n");
                self.materials.push((line, name));
            }
            "mtllib" => self.libraries.push((line, named(rest, "the name of an MTL file")?)),
            other => {
                if let Some(known) = LEFT_OUT.into_iter().find(|known| *known == other) {
                    self.left_out.entry(known).or_insert(line);
                }
            }
        }
        Ok(())
    }

    fn vector(&mut self, keyword: &str, [x, y, z]: [f32; 3]) {
        let written = writeln!(self.text, "{keyword} {x} {y} {z}");
        debug_assert!(written.is_ok(), "strings take any text");
    }

    fn face<'w>(&mut self, corners: impl Iterator<Item = &'w str>, counts: &Counts) -> Result<(), ObjFault> {
        let mut face = "f".to_owned();
        let mut given = 0;
        for corner in corners {
            // A corner is vertex/texture/normal; all but the first may be missing.
            let mut parts = corner.split('/');
            let vertex = parts.next().unwrap_or_default();
            let mut next = || parts.next().filter(|part| !part.is_empty());
            let (uv, normal) = (next(), next());
            face += &format!(" {}", index(vertex, "vertex", counts.vertices)?);
            if let Some(uv) = uv {
                face += &format!("/{}", index(uv, "texture coordinate", counts.uvs)?);
            }
            if let Some(normal) = normal {
                let slashes = if uv.is_some() { "/" } else { "//" };
                face += &format!("{slashes}{}", index(normal, "normal", counts.normals)?);
            }
            given += 1;
        }
        if given < 3 {
            return Err(ObjFault::FewCorners { given });
        }
        self.text += &face;
        self.text.push('\n');
        Ok(())
    }
}

/// The lines of a file without comments, with their numbers from 1. A line that ends in a backslash continues
/// on the next. A backslash at the end of a comment does not count: it may be part of the name of a folder.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, String)> {
    let mut rest = text.lines().enumerate();
    core::iter::from_fn(move || {
        let (number, first) = rest.next()?;
        let mut line = without_comment(first).to_owned();
        while let Some(before) = line.trim_end().strip_suffix('\\') {
            line = format!("{before} {}", rest.next().map_or("", |(_, next)| without_comment(next)));
        }
        Some((number + 1, line))
    })
}

fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default()
}

/// Parses a finite number within the limits of a scene.
pub(super) fn number(word: Option<&str>, expected: &'static str) -> Result<f32, ObjFault> {
    let found = word.unwrap_or_default().to_owned();
    match f32::from_str(&found) {
        Ok(number) if number.is_finite() && number.abs() <= MAX_COORDINATE => Ok(number),
        Ok(_) => Err(ObjFault::OutOfRange { meaning: expected, found }),
        Err(_) => Err(ObjFault::Expected { expected, found }),
    }
}

/// Parses three numbers.
fn numbers<'w>(
    words: &mut impl Iterator<Item = &'w str>,
    expected: &'static str,
) -> Result<[f32; 3], ObjFault> {
    Ok([number(words.next(), expected)?, number(words.next(), expected)?, number(words.next(), expected)?])
}

fn named(name: &str, expected: &'static str) -> Result<String, ObjFault> {
    if name.is_empty() {
        return Err(ObjFault::Expected { expected, found: String::new() });
    }
    Ok(name.to_owned())
}

/// Parses an index, and makes a relative one absolute, counted from 1.
fn index(word: &str, what: &'static str, count: usize) -> Result<usize, ObjFault> {
    let found = || word.to_owned();
    let expected = "the number of a vertex, a texture coordinate or a normal";
    let number = i64::from_str(word).map_err(|_| ObjFault::Expected { expected, found: found() })?;
    // -1 is the last element so far.
    let index = if number < 0 { number.saturating_add(count as i64).saturating_add(1) } else { number };
    usize::try_from(index).ok().filter(|index| (1..=count).contains(index)).ok_or_else(|| ObjFault::Unknown {
        what,
        found: found(),
        count,
    })
}
