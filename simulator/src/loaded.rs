//! A scene, found by its name or read from its file.

use core::fmt;
use core::mem::MaybeUninit;
use std::io;
use std::path::{Path, PathBuf};

use bumpalo::Bump;
use rayline::builtin;
use rayline::{BytesError, Scene, SceneError};

use crate::RenderOptions;
use crate::gltf::{self, GltfError};
use crate::nearest::{DidYouMean, nearest};
use crate::nff::{self, NffError};
use crate::obj::{self, ObjError};
use crate::ron::{self, Position, RonError};

/// A scene, found by its name or read from its file, with what is said about its picture.
#[derive(Clone, Debug)]
pub struct LoadedScene<'a> {
    /// What to call its pictures.
    pub name: String,
    /// The scene.
    pub scene: Scene<'a>,
    /// Width and height that it is meant to be seen in.
    pub size: (u32, u32),
    /// Bounces that it is meant to be seen with.
    pub bounces: u8,
    /// What was added to the scene that its file does not say, and what was left out.
    pub notes: Vec<String>,
    /// Where it was read from; `None`: it is built in.
    file: Option<(PathBuf, Import<'a>)>,
}

/// What was read, with what is known of where its parts stand in the file.
#[derive(Clone, Debug)]
enum Import<'a> {
    Nff(nff::Import<'a>),
    Obj(obj::Import<'a>),
    Gltf(gltf::Import<'a>),
    Ron(ron::Import<'a>),
    Bytes,
}

/// Why there is no scene.
#[derive(Debug)]
#[non_exhaustive]
pub enum LoadError {
    /// There is no such built-in scene. Name one that there is, or a file that ends in
    /// `.ron`, `.rayline`, `.nff`, `.obj`, `.gltf` or `.glb`.
    Unknown {
        /// What was asked for.
        name: String,
    },
    /// The system cannot read the file. Mend what it says.
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        error: io::Error,
    },
    /// The file breaks the grammar of its format. Mend the line.
    Nff {
        /// The file.
        path: PathBuf,
        /// Line and reason.
        error: NffError,
    },
    /// The file, or one that it names, cannot be read or breaks the grammar of its format. Mend the line.
    Obj(ObjError),
    /// The file, or one that it names, cannot be read or is broken. Mend the part that the error names.
    Gltf(GltfError),
    /// The file holds bytes that are no scene. Write it again.
    Bytes {
        /// The file.
        path: PathBuf,
        /// What is wrong with them.
        error: BytesError,
    },
    /// The file cannot be read, or says what is not understood. Mend it where the error says.
    Ron(RonError),
}

impl<'a> LoadedScene<'a> {
    /// Reads a `.ron`, `.rayline`, `.nff`, `.obj`, `.gltf` or `.glb` file into `arena`, or finds a built-in scene.
    ///
    /// # Errors
    /// The scene does not exist or cannot be read.
    pub fn open(source: &Path, arena: &'a Bump) -> Result<Self, LoadError> {
        let ends_in =
            |format| source.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(format));
        if ends_in("rayline") {
            Self::read_bytes(source, arena)
        } else if ends_in("ron") {
            Self::read_ron(source, arena)
        } else if ends_in("nff") {
            Self::read_nff(source, arena)
        } else if ends_in("obj") {
            Self::read_obj(source, arena)
        } else if ends_in("gltf") || ends_in("glb") {
            Self::read_gltf(source, arena)
        } else {
            Self::find(&source.to_string_lossy())
        }
    }

    fn read_bytes(path: &Path, arena: &'a Bump) -> Result<Self, LoadError> {
        let bytes = std::fs::read(path).map_err(|error| LoadError::Read { path: path.to_owned(), error })?;
        let bytes = arena.alloc_slice_copy(&bytes);
        let mut room = bytes.len().saturating_mul(16).max(1 << 12);
        let most = bytes.len().saturating_mul(256).clamp(1 << 16, 1 << 30);
        let scene = loop {
            let memory = arena.alloc_slice_fill_copy(room.min(most), MaybeUninit::uninit());
            match Scene::from_bytes(bytes, memory) {
                Ok(scene) => break scene,
                // No description is 256 times as long as its bytes.
                Err(BytesError::Memory { .. }) if room < most => room = room.saturating_mul(4),
                Err(error) => return Err(LoadError::Bytes { path: path.to_owned(), error }),
            }
        };
        Ok(Self {
            name: name_of(path),
            scene,
            size: (640, 480),
            bounces: 6,
            notes: Vec::new(),
            file: Some((path.to_owned(), Import::Bytes)),
        })
    }

    fn read_ron(path: &Path, arena: &'a Bump) -> Result<Self, LoadError> {
        let import = ron::read(arena, path).map_err(LoadError::Ron)?;
        Ok(Self {
            name: name_of(path),
            scene: import.scene,
            size: (640, 480),
            bounces: 6,
            notes: Vec::new(),
            file: Some((path.to_owned(), Import::Ron(import))),
        })
    }

    fn read_obj(path: &Path, arena: &'a Bump) -> Result<Self, LoadError> {
        let import = obj::read(arena, path).map_err(LoadError::Obj)?;
        Ok(Self {
            name: name_of(path),
            scene: import.scene,
            size: import.resolution,
            bounces: 4,
            notes: import.notes.clone(),
            file: Some((path.to_owned(), Import::Obj(import))),
        })
    }

    fn read_gltf(path: &Path, arena: &'a Bump) -> Result<Self, LoadError> {
        let import = gltf::read(arena, path).map_err(LoadError::Gltf)?;
        Ok(Self {
            name: name_of(path),
            scene: import.scene,
            size: import.resolution,
            bounces: 4,
            notes: import.notes.clone(),
            file: Some((path.to_owned(), Import::Gltf(import))),
        })
    }

    fn read_nff(path: &Path, arena: &'a Bump) -> Result<Self, LoadError> {
        let path = path.to_owned();
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) => return Err(LoadError::Read { path, error }),
        };
        match nff::parse_bytes(arena, &bytes) {
            Ok(import) => Ok(Self {
                name: name_of(&path),
                scene: import.scene,
                size: import.resolution,
                bounces: 4,
                notes: Vec::new(),
                file: Some((path, Import::Nff(import))),
            }),
            Err(error) => Err(LoadError::Nff { path, error }),
        }
    }

    fn find(name: &str) -> Result<Self, LoadError> {
        let builtin = builtin::all().find(|builtin| builtin.name == name);
        let builtin = builtin.ok_or_else(|| LoadError::Unknown { name: name.to_owned() })?;
        Ok(Self {
            name: builtin.name.to_owned(),
            scene: *builtin.scene,
            size: (640, 480),
            bounces: builtin.bounces,
            notes: Vec::new(),
            file: None,
        })
    }

    /// The options for its picture as it is meant to be seen.
    pub fn options(&self) -> RenderOptions {
        let (width, height) = self.size;
        RenderOptions::new(rayline::Settings {
            bounces: self.bounces,
            ..rayline::Settings::new(width, height)
        })
    }

    /// Where in the scene's file an object is described.
    pub fn line_of_object(&self, index: usize) -> Option<usize> {
        match &self.file {
            Some((_, Import::Nff(import))) => import.line_of(rayline::Part::Object(index)),
            Some((_, Import::Ron(import))) => Some(import.position_of(rayline::Part::Object(index))?.line),
            _ => None,
        }
    }

    /// What is wrong with this scene, in one line: with the file, and the line or the name that the part has there.
    pub fn explain(&self, error: &SceneError) -> String {
        match &self.file {
            None => format!("{}: {error}", self.name),
            Some((path, Import::Bytes)) => format!("{}: {error}", path.display()),
            Some((path, Import::Nff(import))) => match import.line_of(error.part) {
                Some(line) => format!("{}:{line}: {}", path.display(), error.fault),
                None => format!("{}: {error}", path.display()),
            },
            Some((path, Import::Obj(import))) => match import.name_of(error.part) {
                Some(name) => format!("{}: `{}`: {}", path.display(), name.escape_debug(), error.fault),
                None => format!("{}: {error}", path.display()),
            },
            Some((path, Import::Gltf(import))) => match import.name_of(error.part) {
                Some(name) => format!("{}: {name}: {}", path.display(), error.fault),
                None => format!("{}: {error}", path.display()),
            },
            Some((path, Import::Ron(import))) => match import.position_of(error.part) {
                Some(Position { line, column }) => {
                    format!("{}:{line}:{column}: {}", path.display(), error.fault)
                }
                None => format!("{}: {error}", path.display()),
            },
        }
    }
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { name } => {
                let names = builtin::ALL.map(|builtin| builtin.name);
                let meant = nearest(name, names);
                write!(f, "there is no scene `{name}`{}", DidYouMean(meant))?;
                f.write_str(if meant.is_some() { " " } else { ". " })?;
                write!(
                    f,
                    "There are {}, and files that end in .ron, .rayline, .nff, .obj, .gltf or .glb",
                    names.join(", ")
                )
            }
            Self::Read { path, error } => write!(f, "cannot read {}: {error}", path.display()),
            Self::Nff { path, error } => write!(f, "{}:{}: {}", path.display(), error.line, error.fault),
            Self::Obj(error) => error.fmt(f),
            Self::Gltf(error) => error.fmt(f),
            Self::Ron(error) => error.fmt(f),
            Self::Bytes { path, error } => write!(f, "{}: {error}", path.display()),
        }
    }
}

impl core::error::Error for LoadError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Unknown { .. } => None,
            Self::Read { error, .. } => Some(error),
            Self::Nff { error, .. } => Some(error),
            Self::Obj(error) => Some(error),
            Self::Gltf(error) => Some(error),
            Self::Ron(error) => Some(error),
            Self::Bytes { error, .. } => Some(error),
        }
    }
}

/// What to call the pictures of a file.
fn name_of(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
