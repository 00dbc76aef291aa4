//! The gallery: a picture of each scene of a directory, and a page that shows them with measures of their
//! accuracy.

use core::fmt;
use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use bumpalo::Bump;
use rayline::{Integrator, Look, Sampling, Settings, Transfer};
use rayline_formats::files::read_regular;

use crate::povray::{self, RunError};
use crate::table::Table;
use crate::{
    FileError, LoadError, LoadedScene, Number, Picture, PictureFile, RenderError, RenderOptions, render,
    write_file,
};

/// The scenes of a directory: its `.ron` files, sorted by name.
#[derive(Clone, Debug)]
pub struct Gallery {
    directory: PathBuf,
    files: Vec<PathBuf>,
    /// The width and height of the pictures, in pixels.
    pub size: (u32, u32),
    /// The samples for each pixel of the pictures, in scenes without settings of their own. Measurements use
    /// one sample there.
    pub samples: u16,
}

/// The reason why a gallery cannot be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum GalleryError {
    /// The directory cannot be read. The system's text says why.
    Directory {
        /// The directory.
        path: PathBuf,
        /// The system's reason.
        error: io::Error,
    },
    /// The directory has no `.ron` file. Name another directory.
    Empty(PathBuf),
    /// The directory has a `README.md` that was not written by a gallery. Move it, so that it is not
    /// overwritten.
    NotOurs(PathBuf),
    /// A scene cannot be read. Correct it.
    Load(LoadError),
    /// A scene cannot be drawn. The text says why.
    Scene(String),
    /// POV-Ray failed.
    Povray {
        /// The name of the scene.
        scene: String,
        /// The reason.
        error: RunError,
    },
    /// The system refused a file.
    File(FileError),
}

/// The texts and figures of one scene on the page.
struct Exhibit {
    name: String,
    caption: String,
    rays_per_pixel: f64,
    f32: String,
    fixed: String,
    povray: Option<f64>,
    /// The differences to POV-Ray: parts that it cannot express or computes differently.
    remark: String,
}

impl Gallery {
    /// Finds the scenes of a directory.
    ///
    /// # Errors
    /// The directory cannot be read, or has no scenes.
    pub fn new(directory: &Path) -> Result<Self, GalleryError> {
        let refused = |error| GalleryError::Directory { path: directory.to_owned(), error };
        let mut files = Vec::new();
        for entry in fs::read_dir(directory).map_err(refused)? {
            let path = entry.map_err(refused)?.path();
            if path.extension().is_some_and(|extension| extension == "ron") {
                files.push(path);
            }
        }
        if files.is_empty() {
            return Err(GalleryError::Empty(directory.to_owned()));
        }
        files.sort();
        Ok(Self { directory: directory.to_owned(), files, size: (320, 240), samples: 4 })
    }

    /// The files of the scenes.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Renders each scene into a `.png` beside its file, and writes `README.md`. The page shows all pictures
    /// and their agreement with the reference in f64 and with POV-Ray, if that is installed. `say` is called
    /// with the name of each file.
    ///
    /// # Errors
    /// See [`GalleryError`]. Pictures that were written before the error stay.
    pub fn write(&self, say: &dyn Fn(&str)) -> Result<(), GalleryError> {
        let page = self.directory.join("README.md");
        if read_regular(&page).is_ok_and(|text| !text.starts_with(HEAD.as_bytes())) {
            return Err(GalleryError::NotOurs(page));
        }
        let mut exhibits = Vec::new();
        for file in &self.files {
            say(&file.display().to_string());
            exhibits.push(self.exhibit(file)?);
        }
        write_file(&page, self.page(&exhibits).as_bytes()).map_err(GalleryError::File)
    }

    /// The samples of a scene's picture: its own, or enough for smooth edges.
    fn sampling(&self, own: Sampling) -> Sampling {
        if own.samples > 1 { own } else { Sampling::new(self.samples) }
    }

    fn exhibit(&self, file: &Path) -> Result<Exhibit, GalleryError> {
        let arena = Bump::new();
        let scene = LoadedScene::open(file, &arena).map_err(GalleryError::Load)?;
        let (width, height) = self.size;
        let meant = Settings { width, height, ..scene.settings };
        let draw = |settings, number| {
            let options = RenderOptions { number, ..RenderOptions::new(settings) };
            render(&scene.scene, &options).map_err(|error| {
                GalleryError::Scene(match error {
                    RenderError::Scene(error) => scene.explain(&error),
                    error => format!("{}: {error}", scene.name),
                })
            })
        };

        let smooth = draw(Settings { sampling: self.sampling(meant.sampling), ..meant }, Number::F32)?;
        let picture = PictureFile::new(&file.with_extension("png")).map_err(GalleryError::File)?;
        picture.write(&smooth).map_err(GalleryError::File)?;

        let seen = draw(meant, Number::F32)?;
        let reference = draw(meant, Number::F64)?;
        let rays = seen.rays.total();
        let linear = Settings { transfer: Transfer::Linear, ..meant };
        let text = read_regular(file).unwrap_or_default();
        let text = String::from_utf8_lossy(&text);
        let remark = |key| {
            let line = text.lines().find_map(|line| line.trim_start().strip_prefix(key));
            line.unwrap_or_default().trim().to_owned()
        };
        let (povray, refusal) = beside_povray(&scene, &linear, &draw(linear, Number::F32)?)?;
        Ok(Exhibit {
            caption: remark("//"),
            rays_per_pixel: rays as f64 / f64::from(width * height),
            f32: seen.decibels(&reference),
            fixed: draw(meant, Number::Fixed)?.decibels(&reference),
            povray,
            remark: refusal.unwrap_or_else(|| remark("// POV-Ray:")),
            name: scene.name,
        })
    }

    /// The text of the page.
    fn page(&self, exhibits: &[Exhibit]) -> String {
        let (width, height) = self.size;
        let mut page =
            format!("{HEAD}: each picture is the scene of the same name, {width}x{height} in f32.\n");
        let mut groups: Vec<&str> = Vec::new();
        for exhibit in exhibits {
            if !groups.contains(&exhibit.group()) {
                groups.push(exhibit.group());
            }
        }
        // The showpieces come first.
        groups.sort_by_key(|group| *group != "show");
        for group in groups {
            let title = if group == "show" { "showpieces" } else { group };
            // Writing into a string cannot fail.
            let _ = write!(page, "\n## {}\n\n", capitalized(title));
            let members: Vec<_> = exhibits.iter().filter(|exhibit| exhibit.group() == group).collect();
            let _ = writeln!(page, "|  |  |  |\n|---|---|---|");
            for row in members.chunks(3) {
                for exhibit in row {
                    let Exhibit { name, caption, .. } = exhibit;
                    let _ = write!(page, "| ![{name}]({name}.png)<br>[{name}]({name}.ron): {caption} ");
                }
                let _ = writeln!(page, "|");
            }
        }
        let mut table =
            Table::new(1, ["scene", "rays a pixel", "f32 / f64, dB", "fixed / f64, dB", "as POV-Ray, %"]);
        let mut remarks = Table::new(2, ["scene", "and POV-Ray"]);
        for exhibit in exhibits {
            table.push([
                exhibit.name.clone(),
                format!("{:.2}", exhibit.rays_per_pixel),
                exhibit.f32.clone(),
                exhibit.fixed.clone(),
                exhibit.povray.map_or("-".to_owned(), |share| format!("{share:.2}")),
            ]);
            if !exhibit.remark.is_empty() {
                remarks.push([exhibit.name.clone(), exhibit.remark.clone()]);
            }
        }
        let _ = write!(
            page,
            "\n## Figures\n\nThe PSNR of the exact picture with one sample a pixel, and the share of pixels \
             whose channels all lie\nwithin {ALIKE} of 255 of POV-Ray's, in linear light, for scenes that \
             POV-Ray can express.\n\n{table}\n## Beside POV-Ray\n\nParts of scenes that POV-Ray cannot \
             express or computes differently:\n\n{remarks}"
        );
        page
    }
}

/// The beginning of every page that this module writes.
const HEAD: &str = "# Gallery\n\nWritten by `rayline gallery`";

/// The largest difference of a channel between pixels that count as alike.
const ALIKE: u8 = 3;

/// The share of pixels, in percent, that POV-Ray draws alike; or a text that says why it is unknown.
fn beside_povray(
    scene: &LoadedScene<'_>,
    settings: &Settings,
    picture: &Picture,
) -> Result<(Option<f64>, Option<String>), GalleryError> {
    if settings.integrator != Integrator::Whitted {
        return Ok((None, Some("POV-Ray does not trace paths".to_owned())));
    }
    if settings.look != Look::PHOTO {
        return Ok((None, Some("POV-Ray has no such looks".to_owned())));
    }
    let failed = |error| GalleryError::Povray { scene: scene.name.clone(), error };
    let directory = tempfile::tempdir().map_err(|error| failed(RunError::Io(error)))?;
    match povray::render(&scene.scene, settings, directory.path(), "scene") {
        Ok(Some(theirs)) => {
            let (ours, _) = picture.rgb.as_chunks::<3>();
            let (theirs, _) = theirs.rgb.as_chunks::<3>();
            let is_alike =
                |(a, b): &(&[u8; 3], &[u8; 3])| a.iter().zip(*b).all(|(a, b)| a.abs_diff(*b) <= ALIKE);
            let alike = ours.iter().zip(theirs).filter(is_alike).count();
            Ok((Some(100.0 * alike as f64 / ours.len().max(1) as f64), None))
        }
        Ok(None) => Ok((None, Some("POV-Ray is not installed".to_owned()))),
        Err(RunError::Scene(error)) => Ok((None, Some(error.to_string()))),
        Err(error) => Err(failed(error)),
    }
}

impl Exhibit {
    /// The group of the scene: the first word of its name.
    fn group(&self) -> &str {
        self.name.split('-').next().unwrap_or_default()
    }
}

fn capitalized(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

impl fmt::Display for GalleryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Directory { path, error } => write!(f, "cannot read {}: {error}", path.display()),
            Self::Empty(path) => {
                write!(f, "there is no .ron file in {}; name another directory", path.display())
            }
            Self::NotOurs(path) => {
                write!(f, "{} was not written by a gallery and would be overwritten; move it", path.display())
            }
            Self::Load(error) => error.fmt(f),
            Self::Scene(text) => f.write_str(text),
            Self::Povray { scene, error } => write!(f, "{scene}: {error}"),
            Self::File(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for GalleryError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Directory { error, .. } => Some(error),
            Self::Empty(_) | Self::NotOurs(_) | Self::Scene(_) => None,
            Self::Load(error) => Some(error),
            Self::Povray { error, .. } => Some(error),
            Self::File(error) => Some(error),
        }
    }
}
