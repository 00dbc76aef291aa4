//! Scenes in Rusty Object Notation (RON): the description in the notation of Rust, for people to write.
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
//! All types and fields are those of the crate `rayline`, whose documentation describes them. These fields
//! may be left out:
//!
//! | in | field | default |
//! |---|---|---|
//! | scene | `background`, `lights`, `motions`, `settings` | black, none, none, the usual ones |
//! | material | `color`, `diffuse`, `ior` | white, 1, 1 |
//! | | all others | 0, none |
//! | `optics` | all | [`Optics::PLAIN`](rayline::Optics::PLAIN) |
//! | `Placed` | `placement` and all in it | [`Placement::SURFACE`](rayline::Placement::SURFACE) |
//! | image | `encoding`, `filter`, `ends` | `Srgb`, `Nearest`, `Repeat` |
//! | gradient | `ends` | `Repeat` |
//! | mesh, triangle | `normals`, `uvs` | none |
//! | disc | `hole` | 0 |
//! | lamp | `falloff`, `cone` | none |
//! | falloff | `constant`, `linear`, `quadratic` | 1, 0, 0 |
//! | instances | `size`, `rotation` | 1, not turned |
//! | motion | `by`, `spin` | 0, none |
//!
//! The format also allows:
//!
//! - Lists may be written as maps, whose keys are names. The name of a material or of an object may be
//!   used in place of its number.
//! - In place of a material, the name of one in [`rayline::materials`] may be written, see [`PRESETS`].
//! - In place of a mesh, the name of an `.obj` file may be written; in place of an image, that of a `.png` or
//!   `.ppm` file, which is taken as sRGB with `Bilinear` and `Repeat`;
//!   `Image(file: "wood.png", ends: Mirror)` says otherwise. A PNG file with a palette of 4 or 8 bits keeps
//!   it. Names are relative to the folder of the scene's file, and stay in it; see [`files`].
//! - `settings` of the scene say how its picture is meant to be drawn, see [`FileSettings`]; options of the
//!   command line overrule them.
//! - `Some` and the inner parentheses of `Sphere((center: …))` are omitted.

mod error;
mod names;
mod pictures;
mod scan;
mod settings;

use core::mem::MaybeUninit;
use std::collections::HashSet;
use std::io;
use std::path::Path;

use bumpalo::Bump;
use rayline::read::{Reader, Seed};
use rayline::{Fault, Part, Scene, Settings};
use rayline_formats::files::{self, Files};
use rayline_formats::{Pictures, text};
use ron::Options;
use ron::extensions::Extensions;
use serde::de::DeserializeOwned;

/// The reason why RON cannot express a scene.
pub use ::ron::Error as FormatError;
use error::MOST_LEVELS;
pub use error::{Position, RonError, RonFault};
use names::Known;
pub use names::PRESETS;
use pictures::Marked;
use settings::File;
pub use settings::FileSettings;

/// A scene that was read from a file.
#[derive(Clone, Debug)]
pub struct Import<'a> {
    /// The scene; it is checked when it is prepared.
    pub scene: Scene<'a>,
    /// How its picture is meant to be drawn.
    pub settings: FileSettings,
    text: &'a str,
}

impl Import<'_> {
    /// The position of this part of the scene in the file, for errors of the scene. `None` for a part that is
    /// not in the file.
    pub fn position_of(&self, part: Part) -> Option<Position> {
        scan::position_of(self.text, part)
    }

    /// The names of the parts in a list, if they have names.
    pub(crate) fn names_of(&self, list: &'static str) -> Vec<String> {
        // The text was read before, so it has no error.
        scan::names(self.text, list).unwrap_or_default()
    }
}

/// Reads a scene from a file. Its lists are kept in `arena`.
///
/// # Errors
/// The file cannot be read, or breaks the grammar at a position. Numbers that are refused for their value,
/// such as a negative radius, are found by [`PreparedScene::new`](rayline::PreparedScene::new);
/// [`Import::position_of`] gives the position of such an error.
pub fn read<'a>(arena: &'a Bump, path: &Path) -> Result<Import<'a>, RonError> {
    read_with(arena, arena.alloc(Files::new(path, false)))
}

/// Reads a scene by the reader of its files.
pub(crate) fn read_with<'a>(arena: &'a Bump, files: &'a Files) -> Result<Import<'a>, RonError> {
    let path = files.scene();
    let text = arena.alloc_str(&text_of(path, files.read(path))?);
    parse(arena, text, files).map_err(|(position, fault)| RonError::new(path, Some(position), fault))
}

/// Reads a value that is not a scene from a file.
pub(crate) fn read_value<T: DeserializeOwned>(path: &Path) -> Result<T, RonError> {
    options().from_str(&text_of(path, files::read_regular(path))?).map_err(|error| {
        let (position, fault) = RonFault::from_ron(error, None);
        RonError::new(path, Some(position), fault)
    })
}

fn text_of(path: &Path, bytes: io::Result<Vec<u8>>) -> Result<String, RonError> {
    let bytes = bytes.map_err(|io| RonError::new(path, None, RonFault::Read(io)))?;
    let not_utf8 = |line| RonError::new(path, Some(Position { line, column: 1 }), RonFault::NotUtf8);
    text::of_bytes(&bytes).map(str::to_owned).map_err(not_utf8)
}

/// The options of the format.
fn options() -> Options {
    Options::default().with_recursion_limit(MOST_LEVELS).with_default_extension(
        Extensions::IMPLICIT_SOME | Extensions::UNWRAP_NEWTYPES | Extensions::UNWRAP_VARIANT_NEWTYPES,
    )
}

/// Reads a scene from a text. Names of files are relative to the folder of the scene.
fn parse<'a>(arena: &'a Bump, text: &'a str, files: &'a Files) -> Result<Import<'a>, (Position, RonFault)> {
    let materials = scan::material_names(text).map_err(|error| RonFault::from_ron(error, None))?;
    let mut seen = HashSet::new();
    for (index, name) in materials.iter().enumerate() {
        if !seen.insert(name) {
            let position = scan::position_of(text, Part::Material(index));
            return Err((
                position.unwrap_or(Position { line: 1, column: 1 }),
                RonFault::SameName { name: name.clone() },
            ));
        }
    }
    let known = &*arena.alloc(Known::new(arena, files, text, &materials));
    let names = arena.alloc(move |what: &'static str, name: &str| known.find(what, name));
    // Eight bytes for each character are enough for lists of numbers with two digits.
    let mut bytes = text.len().saturating_mul(8).max(1 << 10);
    loop {
        let memory = arena.alloc_slice_fill_copy(bytes, MaybeUninit::uninit());
        let mut reader = Reader::new(memory).with_names(names);
        let file = options().from_str_seed(text, Seed::<File<'a>>::new(&mut reader));
        match (file, reader.failure()) {
            (Ok(file), _) => return Ok(Import { scene: file.scene(), settings: file.settings, text }),
            // The items that names stand for may be much longer than the text.
            (Err(_), Some(Fault::Memory { .. })) => bytes = bytes.saturating_mul(4),
            (Err(error), _) => return Err(RonFault::from_ron(error, known.unknown())),
        }
    }
}

/// Writes a scene as text, with its pictures as files beside it, and with those settings that differ from the
/// `usual` ones of a file.
///
/// # Errors
/// The format cannot express the scene, or an image has another number of pixels than width times height.
pub fn write_beside<'a>(
    scene: &Scene<'a>,
    settings: &Settings,
    usual: &Settings,
    pictures: &mut Pictures<'a>,
    arena: &'a Bump,
) -> Result<String, ron::Error> {
    let mut marked = Marked::new(arena, pictures);
    let scene = marked.scene(scene).map_err(|error| ron::Error::Message(error.to_string()))?;
    Ok(marked.name(&write(&scene, settings, usual)?))
}

/// Writes a scene as text, with those settings that differ from the `usual` ones of a file.
///
/// # Errors
/// The format cannot express the scene.
pub fn write(scene: &Scene<'_>, settings: &Settings, usual: &Settings) -> Result<String, ron::Error> {
    let style = ron::ser::PrettyConfig::new().struct_names(false).indentor("    ");
    let style = style.depth_limit(5).separate_tuple_members(false);
    let file = File::new(scene, FileSettings::beside(usual, settings));
    // Writers of RON are long, and there would be one for each type of a field.
    let mut text = options().to_string_pretty::<dyn erased_serde::Serialize>(&file, style)?;
    text.push('\n');
    Ok(text)
}
