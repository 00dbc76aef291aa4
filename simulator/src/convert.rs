//! Writing of scenes in several formats.

use core::fmt;
use std::path::{Path, PathBuf};

use bumpalo::Bump;
use rayline::bake::BakeError;
use rayline::{BytesError, Scene, Settings};
use rayline_formats::Pictures;
use rayline_formats::povray::{PovrayError, to_povray};
use rayline_scenes::{FILE_SETTINGS, rust_source, to_bytes};

use crate::file::{extension, is_nameless, write_beside};
use crate::{FileError, Number, check_writable, ron};

/// A file that a scene will be written to. Its name is checked before the scene is read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneFile {
    path: PathBuf,
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    /// Text for people.
    Ron,
    /// Bytes for [`Scene::from_bytes`].
    Bytes,
    /// The language of POV-Ray.
    Povray,
    /// Source of a program that computes in this number system.
    Rust(Number),
}

/// The reason why a scene cannot be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum ConvertError {
    /// The extension is unknown. Name a `.ron`, `.rayline`, `.pov` or `.rs` file.
    Extension(PathBuf),
    /// Rust source is wanted, and the extension is another. Name a `.rs` file.
    NotRust(PathBuf),
    /// POV-Ray's language cannot express the scene. Remove the part that the error names.
    Povray(PovrayError),
    /// The scene cannot be written as Rust source. Remove the part that the error names.
    Rust(BakeError),
    /// Rust source cannot be written for `f64`. Choose `f32` or `fixed`.
    Number,
    /// RON cannot express the scene.
    Format(ron::FormatError),
    /// The scene cannot be written as bytes.
    Bytes(BytesError),
    /// The file cannot be written.
    File(FileError),
}

impl SceneFile {
    /// Checks the name of the file, and that there is a directory for it. Standard output (`-`), devices and
    /// pipes without an extension get RON. Rust source is for programs that compute in `number`.
    ///
    /// # Errors
    /// The extension is unknown, the directory is missing, or Rust source is wanted for `f64`.
    pub fn new(path: &Path, number: Number) -> Result<Self, ConvertError> {
        let format = match extension(path).as_deref() {
            Some("ron") => Format::Ron,
            Some("rayline") => Format::Bytes,
            Some("pov") => Format::Povray,
            Some("rs") => return Self::rust(path, number),
            _ if is_nameless(path) => Format::Ron,
            _ => return Err(ConvertError::Extension(path.to_owned())),
        };
        check_writable(path).map_err(ConvertError::File)?;
        Ok(Self { path: path.to_owned(), format })
    }

    /// A file of Rust source. Standard output, devices and pipes need no extension.
    ///
    /// # Errors
    /// The extension is not `.rs`, the directory is missing, or `number` is `f64`.
    pub fn rust(path: &Path, number: Number) -> Result<Self, ConvertError> {
        if extension(path).as_deref() != Some("rs") && !is_nameless(path) {
            return Err(ConvertError::NotRust(path.to_owned()));
        }
        if number == Number::F64 {
            return Err(ConvertError::Number);
        }
        check_writable(path).map_err(ConvertError::File)?;
        Ok(Self { path: path.to_owned(), format: Format::Rust(number) })
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The file's contents: the scene, with the settings if the format has them. Nothing is written yet.
    ///
    /// # Errors
    /// The format cannot hold the scene.
    pub fn contents<'a>(
        &self,
        scene: &Scene<'a>,
        settings: &Settings,
        arena: &'a Bump,
    ) -> Result<SceneContents<'_, 'a>, ConvertError> {
        let mut pictures = Pictures::beside(&self.path);
        let bytes = match self.format {
            Format::Ron => {
                let text = ron::write_beside(scene, settings, &FILE_SETTINGS, &mut pictures, arena);
                text.map_err(ConvertError::Format)?.into_bytes()
            }
            Format::Bytes => to_bytes(scene).map_err(ConvertError::Bytes)?,
            Format::Povray => {
                let text = to_povray(scene, settings, &mut pictures);
                text.map_err(ConvertError::Povray)?.into_bytes()
            }
            Format::Rust(number) => {
                let source = rust_source(scene, number == Number::Fixed);
                source.map_err(ConvertError::Rust)?.into_bytes()
            }
        };
        Ok(SceneContents { path: &self.path, bytes, pictures })
    }
}

/// The contents of a scene's file, and of the pictures beside it.
#[derive(Clone, Debug)]
pub struct SceneContents<'f, 'a> {
    path: &'f Path,
    bytes: Vec<u8>,
    pictures: Pictures<'a>,
}

impl SceneContents<'_, '_> {
    /// The length of the scene's file in bytes.
    pub fn length(&self) -> usize {
        self.bytes.len()
    }

    /// The number of pictures beside the scene's file.
    pub fn pictures(&self) -> usize {
        self.pictures.count()
    }

    /// The files of more than 50 MB, with their lengths, so that the caller can report the lengths before the
    /// files are written.
    pub fn large_files(&self) -> Vec<(PathBuf, usize)> {
        let scene = (self.path.to_owned(), self.bytes.len());
        let pictures = self.pictures.files().map(|(path, bytes)| (path, bytes.len()));
        [scene].into_iter().chain(pictures).filter(|(_, length)| *length > LARGE).collect()
    }

    /// Writes the files, all or none.
    ///
    /// # Errors
    /// The system refused. Existing files are then unchanged.
    pub fn write(&self) -> Result<(), ConvertError> {
        write_beside(self.path, &self.bytes, self.pictures.files()).map_err(ConvertError::File)
    }
}

/// The size in bytes above which the length of a file is reported before the file is written.
const LARGE: usize = 50_000_000;

impl fmt::Display for ConvertError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Extension(path) => {
                write!(f, "cannot write {}: scenes are .ron, .rayline, .pov or .rs files", path.display())
            }
            Self::NotRust(path) => {
                write!(f, "cannot write {}: Rust source is in .rs files", path.display())
            }
            Self::Povray(error) => error.fmt(f),
            Self::Rust(error) => error.fmt(f),
            Self::Number => {
                f.write_str("Rust source cannot be written for f64; use --number f32 or --number fixed")
            }
            Self::Format(error) => error.fmt(f),
            Self::Bytes(error) => error.fmt(f),
            Self::File(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for ConvertError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Extension(_) | Self::NotRust(_) | Self::Number => None,
            Self::Povray(error) => Some(error),
            Self::Rust(error) => Some(error),
            Self::Format(error) => Some(error),
            Self::Bytes(error) => Some(error),
            Self::File(error) => Some(error),
        }
    }
}
