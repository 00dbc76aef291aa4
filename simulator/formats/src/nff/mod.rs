//! Reading of scenes in Neutral File Format (NFF), the output of Eric Haines' Standard Procedural Databases
//! ("A Proposal for Standard Graphics Environments", IEEE Computer Graphics & Applications, 1987).
//!
//! ```text
//! v from X Y Z at X Y Z up X Y Z angle DEG hither H resolution W H
//! b R G B                              background; without it, black
//! l X Y Z [R G B]                      a light
//! f R G B Kd Ks shine T ior            material of everything that follows
//! s X Y Z radius                       a sphere
//! c X Y Z radius X Y Z radius          a cone or cylinder, without caps
//! p  n (X Y Z)*n                       a planar polygon
//! pp n (X Y Z NX NY NZ)*n              a patch with vertex normals
//! # a comment, to the end of the line
//! ```
//!
//! Words are separated by white space, and line breaks only end comments. The words mean:
//!
//! - `angle` is the full vertical angle of view in degrees, and pixels are square.
//! - `hither` is the distance of a clipping plane. It must be a number, but is ignored: rays begin at the
//!   eye.
//! - A light without a color has intensity 1/√(number of lights) in each channel. Light does not fall off
//!   with distance.
//! - `f` becomes a material with diffuse Kd, specular and reflectance Ks, exponent `shine` and transmittance
//!   T; there is no ambient light. Opaque materials often have an `ior` of 0, which has no effect: it is read
//!   as 1.
//! - A polygon of three vertices becomes a triangle. A patch becomes a fan of triangles around its first
//!   vertex, with interpolated normals.
//!
//! Colors are meant as codes: in the pictures published with the databases, codes are 255 times the numbers.
//! So `LoadedScene` gives a scene from NFF the transfer
//! [`Linear`](rayline::Transfer::Linear), and `rayline convert` keeps it in the settings of a `.ron` file.
//!
//! [`Import::notes`] lists everything that is added to the contents of a file, or left out:
//!
//! | in the file | becomes |
//! |---|---|
//! | no `v` | the whole model is seen from the front, slightly from the right and above |
//! | no `l` | a light from the camera's upper left |
//! | an object before the first `f` | white and matte |
//! | Ks + T above 1 | both scaled to a sum of 1; the highlight keeps Ks, at most 1 |
//! | a negative radius of a sphere, negative radii of a cone | the same shape; not only its inside is seen |
//! | a polygon that is not flat | triangles |
//! | a normal of length 0, or that is no number | that of the triangle's plane |
//! | radius 0, a cone without length or with radii of different signs | left out |
//! | a polygon or triangle without area, or with fewer than three corners | left out |

mod error;
mod objects;
mod statements;
#[cfg(test)]
mod tests;
mod tokens;

use bumpalo::Bump;
use rayline::{Part, Scene};

use crate::text;

pub(crate) use error::Excerpt;
pub use error::{NffError, NffFault};
use statements::Reader;
use tokens::Tokens;

/// A scene that was read from a file.
#[derive(Clone, Debug)]
pub struct Import<'a> {
    /// The scene; it is checked when it is prepared.
    pub scene: Scene<'a>,
    /// The width and height of the picture by the file, in pixels: 1 to 65535.
    pub resolution: (u32, u32),
    /// Notes about everything that was added to the contents of the file, or left out.
    pub notes: Vec<String>,
    lines: Lines,
}

/// The line of the file in which each part of the scene begins.
#[derive(Clone, Debug, Default)]
struct Lines {
    camera: Option<usize>,
    background: Option<usize>,
    objects: Vec<usize>,
    materials: Vec<usize>,
    lights: Vec<usize>,
}

impl Import<'_> {
    /// The line in which the file describes this part of the scene, counted from 1, for errors of the scene.
    /// `None` for a part that is not in the file.
    pub fn line_of(&self, part: Part) -> Option<usize> {
        match part {
            Part::Camera => self.lines.camera,
            Part::Background => self.lines.background,
            Part::Object(index) => self.lines.objects.get(index).copied(),
            Part::Material(index) => self.lines.materials.get(index).copied(),
            Part::Light(index) => self.lines.lights.get(index).copied(),
            _ => None,
        }
    }
}

/// Reads a scene from the bytes of an NFF file.
///
/// # Errors
/// The errors of [`parse`], or the line that is not UTF-8.
pub fn parse_bytes<'a>(arena: &'a Bump, bytes: &[u8]) -> Result<Import<'a>, NffError> {
    let text = text::of_bytes(bytes).map_err(|line| NffError { line, fault: NffFault::NotUtf8 })?;
    parse(arena, text)
}

/// Reads a scene from the text of an NFF file. Its lists are kept in `arena`.
///
/// # Errors
/// The first line that breaks the grammar, and what was expected there. Numbers that are refused for their
/// value, such as a negative color, are found by [`PreparedScene::new`](rayline::PreparedScene::new);
/// [`Import::line_of`] gives the line of such an error.
pub fn parse<'a>(arena: &'a Bump, text: &str) -> Result<Import<'a>, NffError> {
    let mut tokens = Tokens::new(text);
    let mut reader = Reader::new(arena);
    while let Some(keyword) = tokens.next() {
        reader.statement(keyword, &mut tokens)?;
    }
    reader.finish(tokens.last_line())
}
