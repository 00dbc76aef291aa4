//! Scenes from one format into another.

use core::fmt;
use std::path::{Path, PathBuf};

use rayline::bake::{self, BakeError};
use rayline::math::Fixed;
use rayline::{BytesError, Scene, Settings};

use crate::povray::{PovrayError, to_povray};
use crate::{FileError, Number, check_writable, ron, write_file};

/// A file that a scene will be written to: its format is known before anything is done.
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

/// Why a scene could not be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum ConvertError {
    /// The name of the file ends in something else. Name a `.ron`, `.rayline`, `.pov` or `.rs` file.
    Extension(PathBuf),
    /// POV-Ray cannot be told. Leave out what it says.
    Povray(PovrayError),
    /// Rust source cannot say it. Leave out what it says.
    Rust(BakeError),
    /// Nothing is baked for `f64`. Choose `f32` or `fixed`.
    Number,
    /// The format of the file cannot hold it.
    Format(::ron::Error),
    /// The scene does not fit into bytes.
    Bytes(BytesError),
    /// The file cannot be written.
    File(FileError),
}

impl SceneFile {
    /// Checks the name of the file, and that there is a directory for it. Rust source is for programs that compute in `number`.
    ///
    /// # Errors
    /// An extension that is none of these formats'; a directory that is missing; Rust source for `f64`.
    pub fn new(path: &Path, number: Number) -> Result<Self, ConvertError> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        let format = match extension.as_deref() {
            Some("ron") => Format::Ron,
            Some("rayline") => Format::Bytes,
            Some("pov") => Format::Povray,
            Some("rs") if number == Number::F64 => return Err(ConvertError::Number),
            Some("rs") => Format::Rust(number),
            _ => return Err(ConvertError::Extension(path.to_owned())),
        };
        check_writable(path).map_err(ConvertError::File)?;
        Ok(Self { path: path.to_owned(), format })
    }

    /// Where the file will be.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the scene; POV-Ray is told the settings as well. Tells how many bytes the file has.
    ///
    /// # Errors
    /// The format cannot hold it, or the system's; then there is no file, or the one that was there before.
    pub fn write(&self, scene: &Scene<'_>, settings: &Settings) -> Result<usize, ConvertError> {
        let bytes = match self.format {
            Format::Ron => ron::write(scene).map_err(ConvertError::Format)?.into_bytes(),
            Format::Bytes => to_bytes(scene)?,
            Format::Povray => to_povray(scene, settings).map_err(ConvertError::Povray)?.into_bytes(),
            Format::Rust(number) => {
                let source = match number {
                    Number::Fixed => bake::scene::<Fixed>(scene),
                    _ => bake::scene::<f32>(scene),
                };
                source.map_err(ConvertError::Rust)?.into_bytes()
            }
        };
        write_file(&self.path, &bytes).map_err(ConvertError::File)?;
        Ok(bytes.len())
    }
}

/// The bytes of a scene, however many.
pub(crate) fn to_bytes(scene: &Scene<'_>) -> Result<Vec<u8>, ConvertError> {
    /// More than anything that fits a controller.
    const MOST: usize = 1 << 30;
    let mut room = 1 << 12;
    loop {
        let mut bytes = vec![0; room];
        match scene.to_bytes(&mut bytes).map(|written| written.len()) {
            Ok(written) => {
                bytes.truncate(written);
                return Ok(bytes);
            }
            Err(BytesError::NoRoom) if room < MOST => room *= 4,
            Err(error) => return Err(ConvertError::Bytes(error)),
        }
    }
}

impl fmt::Display for ConvertError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Extension(path) => {
                write!(f, "cannot write {}: scenes are .ron, .rayline, .pov or .rs files", path.display())
            }
            Self::Povray(error) => error.fmt(f),
            Self::Rust(error) => error.fmt(f),
            Self::Number => {
                f.write_str("Rust source is for f32 or fixed, not for f64; choose one by --number")
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
            Self::Extension(_) | Self::Number => None,
            Self::Povray(error) => Some(error),
            Self::Rust(error) => Some(error),
            Self::Format(error) => Some(error),
            Self::Bytes(error) => Some(error),
            Self::File(error) => Some(error),
        }
    }
}
