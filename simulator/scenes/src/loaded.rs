//! Opening of scenes by name or from files.

use core::fmt;
use core::mem::MaybeUninit;
use std::io;
use std::path::{Path, PathBuf};

use bumpalo::Bump;
use rayline::builtin;
use rayline::{BytesError, ObjectId, Part, Scene, SceneError, Settings, Transfer};
use rayline_formats::files::Files;
use rayline_formats::gltf::{self, GltfError};
use rayline_formats::nearest::{DidYouMean, nearest};
use rayline_formats::nff::{self, NffError};
use rayline_formats::obj::{self, ObjError};
use rayline_formats::{Exposure, Format, ModelView, Notes, OpenOptions, Parted, part};

use crate::ron::{self, Position, RonError};

/// A built-in scene or a scene from a file, with the settings of its picture.
#[derive(Clone, Debug)]
pub struct LoadedScene<'a> {
    /// The name of the scene, also for the files of its pictures.
    pub name: String,
    /// The scene.
    pub scene: Scene<'a>,
    /// The settings that its picture is meant to have.
    pub settings: Settings,
    /// Notes about everything that was added to the contents of the file, or left out.
    pub notes: Vec<String>,
    /// The exposure. The scene has it already.
    exposure: Exposure,
    /// The file that it was read from; `None` for a built-in scene.
    file: Option<(PathBuf, Import<'a>)>,
}

/// The usual settings of files in Rayline's own formats.
pub const FILE_SETTINGS: Settings = Settings { bounces: 6, ..Settings::new(640, 480) };

/// The settings for the scenes of other formats.
const fn of_size((width, height): (u32, u32)) -> Settings {
    Settings::new(width, height)
}

/// The imported scene, with the positions of its parts in the file as far as they are known.
#[derive(Clone, Debug)]
enum Import<'a> {
    Nff(nff::Import<'a>),
    Obj(obj::Import<'a>),
    Gltf(gltf::Import<'a>),
    Ron(ron::Import<'a>),
    Bytes,
}

/// The reason why a scene cannot be opened.
#[derive(Debug)]
#[non_exhaustive]
pub enum LoadError {
    /// The first bytes of standard input do not tell their format. Name it.
    Format,
    /// There is no built-in scene of this name. Use one of the built-in scenes, or a file that ends in
    /// `.ron`, `.rayline`, `.nff`, `.obj`, `.gltf` or `.glb`.
    Unknown {
        /// The name.
        name: String,
    },
    /// A view is asked for, but the scene has a camera of its own. Leave out the view.
    OwnCamera {
        /// The file, or the name of a built-in scene.
        name: String,
    },
    /// The system cannot read the file. Its text says why.
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        error: io::Error,
    },
    /// The file breaks the grammar of its format. Correct the line.
    Nff {
        /// The file.
        path: PathBuf,
        /// Line and reason.
        error: NffError,
    },
    /// The file, or a file that it refers to, cannot be read or breaks the grammar of its format. Correct the
    /// line.
    Obj(ObjError),
    /// The file, or a file that it refers to, cannot be read or is broken. Correct the part that the error
    /// names.
    Gltf(GltfError),
    /// The bytes of the file are no scene. Write the file again.
    Bytes {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: BytesError,
    },
    /// The file cannot be read, or is not a valid scene. Correct it at the position in the error.
    Ron(RonError),
}

impl<'a> LoadedScene<'a> {
    /// Reads a `.ron`, `.rayline`, `.nff`, `.obj`, `.gltf` or `.glb` file into `arena`, or finds a built-in
    /// scene.
    ///
    /// # Errors
    /// The scene does not exist or cannot be read.
    pub fn open(source: &Path, arena: &'a Bump) -> Result<Self, LoadError> {
        Self::open_with(source, &OpenOptions::default(), arena)
    }

    /// As [`open`](Self::open), with options. A scene of the name
    /// [`STANDARD_INPUT`](rayline_formats::files::STANDARD_INPUT) is read from there, and the files that it
    /// refers to are those in the current folder.
    ///
    /// # Errors
    /// The scene does not exist or cannot be read, or has a camera of its own where the options have a view.
    pub fn open_with(source: &Path, options: &OpenOptions, arena: &'a Bump) -> Result<Self, LoadError> {
        let mut scene = Self::read(source, options, arena)?;
        if options.view != ModelView::default() && scene.has_own_camera() {
            return Err(LoadError::OwnCamera { name: source.to_string_lossy().into_owned() });
        }
        scene.exposure = options.exposure.unwrap_or(scene.exposure);
        let mut notes = Notes::default();
        scene.scene = scene.exposure.of(&scene.scene, arena, &mut notes);
        scene.notes.extend(notes.lines().into_iter().map(|note| format!("{}: {note}", source.display())));
        Ok(scene)
    }

    fn read(source: &Path, options: &OpenOptions, arena: &'a Bump) -> Result<Self, LoadError> {
        let files = &*arena.alloc(Files::new(source, options.allow_paths));
        let refused = |error| LoadError::Read { path: files.scene().to_owned(), error };
        let format = match options.format.or_else(|| Format::of_name(source)) {
            Some(format) => format,
            None if files.is_standard_input() => {
                files.look(Format::of_bytes).map_err(refused)?.ok_or(LoadError::Format)?
            }
            None => return Self::find(&source.to_string_lossy()),
        };
        let scene = match format {
            Format::Rayline => return Self::read_bytes(files, arena),
            Format::Ron => Self::read_ron(files, arena),
            Format::Nff => Self::read_nff(files, arena),
            Format::Obj => Self::read_obj(files, options, arena),
            Format::Gltf => Self::read_gltf(files, options, arena),
        };
        Ok(scene?.parted(arena))
    }

    /// The scene, whose meshes do not lie in one plane where they overlap.
    fn parted(mut self, arena: &'a Bump) -> Self {
        let Parted { objects, moved, is_whole } = part(&self.scene, arena);
        self.scene.objects = objects;
        let mut notes = Notes::default();
        if let Some((path, import)) = &self.file {
            let path = path.display();
            for index in moved {
                let place = import.place(Part::Object(index)).unwrap_or_default();
                notes.add(
                    format!("{path}:{place}"),
                    "moved slightly behind an earlier mesh in the same plane, which is the one seen",
                );
            }
            if !is_whole {
                notes.add(
                    path.to_string(),
                    "not all meshes are compared for common planes: there are too many",
                );
            }
        }
        self.notes.extend(notes.lines());
        self
    }

    fn read_bytes(files: &Files, arena: &'a Bump) -> Result<Self, LoadError> {
        let bytes = arena.alloc_slice_copy(&read(files)?);
        let mut room = bytes.len().saturating_mul(16).max(1 << 12);
        let most = bytes.len().saturating_mul(256).clamp(1 << 16, 1 << 30);
        let scene = loop {
            let memory = arena.alloc_slice_fill_copy(room.min(most), MaybeUninit::uninit());
            match Scene::from_bytes(bytes, memory) {
                Ok(scene) => break scene,
                // No description takes more than 256 times the memory of its bytes.
                Err(BytesError::Memory { .. }) if room < most => room = room.saturating_mul(4),
                Err(error) => return Err(LoadError::Bytes { path: files.scene().to_owned(), error }),
            }
        };
        Ok(Self::of_file(files, scene, Import::Bytes))
    }

    fn read_ron(files: &'a Files, arena: &'a Bump) -> Result<Self, LoadError> {
        let import = ron::read_with(arena, files).map_err(LoadError::Ron)?;
        let settings = import.settings.over(FILE_SETTINGS);
        let exposure = import.settings.exposure.unwrap_or_default();
        Ok(Self { settings, exposure, ..Self::of_file(files, import.scene, Import::Ron(import)) })
    }

    fn read_obj(files: &'a Files, options: &OpenOptions, arena: &'a Bump) -> Result<Self, LoadError> {
        let import = obj::read_with(arena, files.scene(), options.view, files);
        let mut import = import.map_err(LoadError::Obj)?;
        let (settings, notes) = (of_size(import.resolution), core::mem::take(&mut import.notes));
        Ok(Self { settings, notes, ..Self::of_file(files, import.scene, Import::Obj(import)) })
    }

    fn read_gltf(files: &Files, options: &OpenOptions, arena: &'a Bump) -> Result<Self, LoadError> {
        let mut import = gltf::read_with(arena, options, files).map_err(LoadError::Gltf)?;
        let (settings, notes) = (of_size(import.resolution), core::mem::take(&mut import.notes));
        Ok(Self { settings, notes, ..Self::of_file(files, import.scene, Import::Gltf(import)) })
    }

    fn read_nff(files: &Files, arena: &'a Bump) -> Result<Self, LoadError> {
        let mut import = nff::parse_bytes(arena, &read(files)?)
            .map_err(|error| LoadError::Nff { path: files.scene().to_owned(), error })?;
        let settings = Settings { transfer: Transfer::Linear, ..of_size(import.resolution) };
        let notes = core::mem::take(&mut import.notes);
        Ok(Self { settings, notes, ..Self::of_file(files, import.scene, Import::Nff(import)) })
    }

    /// A scene from a file, with the usual settings.
    fn of_file(files: &Files, scene: Scene<'a>, import: Import<'a>) -> Self {
        let path = files.scene();
        let name = if files.is_standard_input() { Path::new("stdin") } else { path };
        Self {
            name: name.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            scene,
            settings: FILE_SETTINGS,
            notes: Vec::new(),
            exposure: Exposure::default(),
            file: Some((path.to_owned(), import)),
        }
    }

    fn find(name: &str) -> Result<Self, LoadError> {
        let builtin = builtin::all().find(|builtin| builtin.name == name);
        let builtin = builtin.ok_or_else(|| LoadError::Unknown { name: name.to_owned() })?;
        Ok(Self {
            name: builtin.name.to_owned(),
            scene: *builtin.scene,
            settings: Settings { bounces: builtin.bounces, ..FILE_SETTINGS },
            notes: Vec::new(),
            exposure: Exposure::default(),
            file: None,
        })
    }

    /// Whether the camera is that of the file, or of a built-in scene.
    fn has_own_camera(&self) -> bool {
        match &self.file {
            Some((_, Import::Obj(_))) => false,
            Some((_, Import::Gltf(import))) => import.name_of(Part::Camera).is_some(),
            _ => true,
        }
    }

    /// The exposure, which the scene has already.
    pub(crate) fn exposure(&self) -> Exposure {
        self.exposure
    }

    /// The line of the scene's file that describes an object, counted from 1; `None` if it is unknown.
    pub fn line_of_object(&self, index: usize) -> Option<usize> {
        match &self.file {
            Some((_, Import::Nff(import))) => import.line_of(Part::Object(index)),
            Some((_, Import::Ron(import))) => Some(import.position_of(Part::Object(index))?.line),
            _ => None,
        }
    }

    /// The object with this name or number.
    pub fn object(&self, name: &str) -> Option<ObjectId> {
        let named = self.names_of("objects").iter().position(|other| other == name);
        let object = named.or_else(|| name.parse().ok()).filter(|object| *object < self.scene.objects.len());
        object.and_then(|object| u16::try_from(object).ok()).map(ObjectId)
    }

    /// The names of the parts in one of the scene's lists, such as `objects` or `lights`, in their order.
    /// Empty if they have no names.
    pub(crate) fn names_of(&self, list: &'static str) -> Vec<String> {
        match &self.file {
            Some((_, Import::Ron(import))) => import.names_of(list),
            _ => Vec::new(),
        }
    }

    /// A message of one line for an error in this scene, with the file and the line or name of the part in
    /// it.
    pub fn explain(&self, error: &SceneError) -> String {
        let Some((path, import)) = &self.file else { return format!("{}: {error}", self.name) };
        let path = path.display();
        // Parts inside of an object have the position of the object.
        let (part, inside) = match error.part {
            Part::Solid { object, solid } => (Part::Object(object), format!("solid {solid}: ")),
            Part::Model(object) => (Part::Object(object), "model: ".to_owned()),
            part => (part, String::new()),
        };
        match import.place(part) {
            Some(place) => format!("{path}:{place}: {inside}{}", error.fault),
            None => format!("{path}: {error}"),
        }
    }
}

impl Import<'_> {
    /// The position of a part of the scene in the file, as text after the name of the file and a colon.
    fn place(&self, part: Part) -> Option<String> {
        match self {
            Self::Nff(import) => import.line_of(part).map(|line| line.to_string()),
            Self::Obj(import) => import.name_of(part).map(|name| format!(" `{}`", name.escape_debug())),
            Self::Gltf(import) => import.name_of(part).map(|name| format!(" {name}")),
            Self::Ron(import) => {
                import.position_of(part).map(|Position { line, column }| format!("{line}:{column}"))
            }
            Self::Bytes => None,
        }
    }
}

/// The bytes of the scene's file.
fn read(files: &Files) -> Result<Vec<u8>, LoadError> {
    let path = files.scene();
    files.read(path).map_err(|error| LoadError::Read { path: path.to_owned(), error })
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Format => f.write_str(
                "the format of standard input is not known; name it with --format, as in --format obj",
            ),
            Self::Unknown { name } => {
                let names = builtin::ALL.map(|builtin| builtin.name);
                let meant = nearest(name, names);
                write!(f, "there is no scene `{name}`{}", DidYouMean(meant))?;
                f.write_str(if meant.is_some() { " " } else { ". " })?;
                write!(
                    f,
                    "Use {}, or a file that ends in .ron, .rayline, .nff, .obj, .gltf or .glb",
                    names.join(", ")
                )
            }
            Self::OwnCamera { name } => write!(
                f,
                "{name} has a camera of its own, but --up and --from are for models without one; leave them \
                 out"
            ),
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
            Self::Format | Self::Unknown { .. } | Self::OwnCamera { .. } => None,
            Self::Read { error, .. } => Some(error),
            Self::Nff { error, .. } => Some(error),
            Self::Obj(error) => Some(error),
            Self::Gltf(error) => Some(error),
            Self::Ron(error) => Some(error),
            Self::Bytes { error, .. } => Some(error),
        }
    }
}
