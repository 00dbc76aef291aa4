//! The formats of scene files, and how such files are opened.

use std::path::Path;

use crate::Exposure;
use crate::model::ModelView;
use crate::text::without_mark;

/// The format of a scene's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Rayline's own text format, in the crate `rayline-scenes`.
    Ron,
    /// Rayline's own bytes: [`Scene::from_bytes`](rayline::Scene::from_bytes).
    Rayline,
    /// Neutral File Format: [`nff`](crate::nff).
    Nff,
    /// Wavefront OBJ: [`obj`](crate::obj).
    Obj,
    /// glTF, as JSON or as a binary file: [`gltf`](crate::gltf).
    Gltf,
}

impl Format {
    /// The formats with the extensions of their files.
    pub const EXTENSIONS: [(&str, Self); 6] = [
        ("ron", Self::Ron),
        ("rayline", Self::Rayline),
        ("nff", Self::Nff),
        ("obj", Self::Obj),
        ("gltf", Self::Gltf),
        ("glb", Self::Gltf),
    ];

    /// The format of a file by the extension of its name.
    pub fn of_name(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        let known = Self::EXTENSIONS.iter().find(|(name, _)| extension.eq_ignore_ascii_case(name))?;
        Some(known.1)
    }

    /// The format of a file by its first bytes; `None` if these bytes do not identify a format.
    pub fn of_bytes(bytes: &[u8]) -> Option<Self> {
        let text = without_mark(bytes).trim_ascii_start();
        match text {
            [b'g', b'l', b'T', b'F', ..] | [b'{', ..] => Some(Self::Gltf),
            [b'R', b'A', b'Y', b'L', ..] => Some(Self::Rayline),
            [b'S', b'c', b'e', b'n', b'e', ..] | [b'(' | b'/', ..] => Some(Self::Ron),
            _ => None,
        }
    }
}

/// How files are opened.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OpenOptions {
    /// The view of a model without a camera of its own.
    pub view: ModelView,
    /// The format of the file; `None`: by the name of the file, or by the first bytes of standard input.
    pub format: Option<Format>,
    /// The exposure, in place of that of the file. Lights of glTF files are measured in the middle of the
    /// scene then, and not by what the camera sees: see [`gltf`](crate::gltf).
    pub exposure: Option<Exposure>,
    /// Lets files refer to any other file, not only to those in the folder of the scene or below it.
    pub allow_paths: bool,
}
