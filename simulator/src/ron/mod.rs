//! Scenes in Rusty Object Notation: the description as it is in Rust, for people to write.
//!
//! ```text
//! Scene(
//!     camera: (eye: (0, 2, 6), target: (0, 1, 0), up: (0, 1, 0), vertical_fov: 0.7),
//!     background: Solid(0.2, 0.3, 0.5),
//!     materials: {
//!         "floor": (color: Checker(even: (0.9, 0.9, 0.9), odd: (0.1, 0.1, 0.1), cells_per_unit: (1, 0, 1))),
//!         "ball": "gold",
//!     },
//!     objects: [
//!         (shape: Plane(point: (0, 0, 0), normal: (0, 1, 0)), material: "floor"),
//!         (shape: Sphere(center: (0, 1, 0), radius: 1), material: "ball"),
//!     ],
//!     lights: [Point(position: (4, 6, 5), color: (1, 1, 1))],
//! )
//! ```
//!
//! All types and fields are those of the crate `rayline`; it tells what they mean. What may be left out:
//!
//! | in | field | is then |
//! |---|---|---|
//! | scene | `background`, `lights` | black, none |
//! | material | `color`, `diffuse`, `ior` | white, 1, 1 |
//! | | all others | 0, none |
//! | `optics` | all | as in [`Optics::PLAIN`](rayline::Optics::PLAIN) |
//! | `Placed` | `placement` and all in it | [`Placement::SURFACE`](rayline::Placement::SURFACE) |
//! | image | `encoding`, `filter`, `ends` | `Srgb`, `Nearest`, `Repeat` |
//! | gradient | `ends` | `Repeat` |
//! | mesh, triangle | `normals`, `uvs` | none |
//! | disc | `hole` | 0 |
//! | lamp | `falloff`, `cone` | none |
//! | falloff | `constant`, `linear`, `quadratic` | 1, 0, 0 |
//! | instances | `size`, `rotation` | 1, not turned |
//!
//! Beyond that:
//!
//! - Lists may be maps: their keys are names. That of a material stands for its number.
//! - In place of a material, the name of one in [`rayline::materials`] may stand: [`PRESETS`].
//! - In place of a mesh, the name of an `.obj` file; in place of an image, that of a `.png` or `.ppm` file, whose pixels
//!   are sRGB, blended and repeated; both as seen from the file of the scene.
//! - `Some` and the inner parentheses of `Sphere((center: …))` are left out.

mod error;
mod names;
mod outline;
#[cfg(test)]
mod tests;

use core::mem::MaybeUninit;
use std::collections::HashSet;
use std::fs;
use std::path::Path;

use bumpalo::Bump;
use rayline::read::{Reader, Seed};
use rayline::{Fault, Part, Scene};
use ron::Options;
use ron::extensions::Extensions;

use crate::text;

pub use error::{Position, RonError, RonFault};
use names::Known;
pub use names::PRESETS;

/// A scene that was read from a file.
#[derive(Clone, Debug)]
pub struct Import<'a> {
    /// The scene; it is checked when it is prepared.
    pub scene: Scene<'a>,
    text: &'a str,
}

impl Import<'_> {
    /// Where the file describes this part of the scene: where to look when the scene is refused. `None` for what is not in the
    /// file.
    pub fn position_of(&self, part: Part) -> Option<Position> {
        outline::position_of(self.text, part)
    }
}

/// Reads a scene from a file. Its lists are kept in `arena`.
///
/// # Errors
/// What cannot be read, or where the file says what is not understood. Numbers that make no scene, such as a negative radius, are
/// found by [`PreparedScene::new`](rayline::PreparedScene::new); for those [`Import::position_of`] tells the place.
pub fn read<'a>(arena: &'a Bump, path: &Path) -> Result<Import<'a>, RonError> {
    let error = |position, fault| RonError { path: path.to_owned(), position, fault: Box::new(fault) };
    let bytes = fs::read(path).map_err(|io| error(None, RonFault::Read(io)))?;
    let text = text::of_bytes(&bytes)
        .map_err(|line| error(Some(Position { line, column: 1 }), RonFault::NotUtf8))?;
    let text = arena.alloc_str(text);
    let directory = arena.alloc_str(&path.parent().unwrap_or(Path::new("")).to_string_lossy());
    parse(arena, text, Path::new(directory)).map_err(|(position, fault)| error(Some(position), fault))
}

/// How files are to be understood.
fn options() -> Options {
    Options::default().with_default_extension(
        Extensions::IMPLICIT_SOME | Extensions::UNWRAP_NEWTYPES | Extensions::UNWRAP_VARIANT_NEWTYPES,
    )
}

/// Reads a scene from a text, whose names of files are as seen from `directory`.
fn parse<'a>(
    arena: &'a Bump,
    text: &'a str,
    directory: &'a Path,
) -> Result<Import<'a>, (Position, RonFault)> {
    let materials = outline::material_names(text).map_err(|error| RonFault::from_ron(error, None))?;
    let mut seen = HashSet::new();
    for (index, name) in materials.iter().enumerate() {
        if !seen.insert(name) {
            let position = outline::position_of(text, Part::Material(index));
            return Err((
                position.unwrap_or(Position { line: 1, column: 1 }),
                RonFault::SameName { name: name.clone() },
            ));
        }
    }
    let known = &*arena.alloc(Known::new(arena, directory, &materials));
    let names = arena.alloc(move |what: &'static str, name: &str| known.find(what, name));
    // So much is enough for lists of numbers of two digits.
    let mut bytes = text.len().saturating_mul(8).max(1 << 10);
    loop {
        let memory = arena.alloc_slice_fill_copy(bytes, MaybeUninit::uninit());
        let mut reader = Reader::new(memory).with_names(names);
        let scene = options().from_str_seed(text, Seed::<Scene<'a>>::new(&mut reader));
        match (scene, reader.failure()) {
            (Ok(scene), _) => return Ok(Import { scene, text }),
            // What names stand for may be much longer than the text.
            (Err(_), Some(Fault::Memory { .. })) => bytes = bytes.saturating_mul(4),
            (Err(error), _) => return Err(RonFault::from_ron(error, known.unknown())),
        }
    }
}

/// The text of a scene.
pub fn write(scene: &Scene<'_>) -> Result<String, ron::Error> {
    let style = ron::ser::PrettyConfig::new().struct_names(false).indentor("    ");
    let style = style.depth_limit(5).separate_tuple_members(false);
    let mut text = options().to_string_pretty(scene, style)?;
    text.push('\n');
    Ok(text)
}
