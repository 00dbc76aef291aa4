//! Files that are written whole or not at all.

use core::fmt;
use std::io::{self, Write};
use std::iter;
use std::path::{Component, Path, PathBuf};

use image::ImageEncoder;
use image::codecs::png::PngEncoder;
use image::codecs::pnm::{PnmEncoder, PnmSubtype, SampleEncoding};
use image::{ExtendedColorType, ImageError};

use crate::Picture;

/// A file that a picture will be written to: its format is known before the first ray.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureFile {
    path: PathBuf,
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Ppm,
}

/// Why a file cannot be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum FileError {
    /// The name ends in something else than `.png` or `.ppm`. Name one of these.
    Extension(PathBuf),
    /// The system refused. Mend what it says.
    Io {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        error: io::Error,
    },
}

impl PictureFile {
    /// Checks the name of the file, and that there is a directory for it.
    ///
    /// # Errors
    /// An extension that is neither `.png` nor `.ppm`; a directory that is missing.
    pub fn new(path: &Path) -> Result<Self, FileError> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        let format = match extension.as_deref() {
            Some("png") => Format::Png,
            Some("ppm") => Format::Ppm,
            _ => return Err(FileError::Extension(path.to_owned())),
        };
        check_writable(path)?;
        Ok(Self { path: path.to_owned(), format })
    }

    /// Where the file will be.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The same, or where there is such a file already, one with a number after its name that there is not: from 2 on.
    pub fn untaken(&self) -> Self {
        let numbered = |number: u32| {
            let [name, extension] = [self.path.file_stem(), self.path.extension()];
            let [name, extension] = [name, extension].map(|part| part.unwrap_or_default().to_string_lossy());
            self.path.with_file_name(format!("{name}-{number}.{extension}"))
        };
        let names = iter::once(self.path.clone()).chain((2..).map(numbered));
        let is_free = |path: &PathBuf| path.symlink_metadata().is_err();
        let path = { names }.find(is_free).unwrap_or_else(|| self.path.clone());
        Self { path, ..*self }
    }

    /// Writes the picture.
    ///
    /// # Errors
    /// The system's; then there is no file, or the one that was there before.
    pub fn write(&self, picture: &Picture) -> Result<(), FileError> {
        let Picture { width, height, rgb, .. } = picture;
        let mut bytes = Vec::new();
        match self.format {
            Format::Png => {
                PngEncoder::new(&mut bytes).write_image(rgb, *width, *height, ExtendedColorType::Rgb8)
            }
            Format::Ppm => PnmEncoder::new(&mut bytes)
                .with_subtype(PnmSubtype::Pixmap(SampleEncoding::Binary))
                .write_image(rgb, *width, *height, ExtendedColorType::Rgb8),
        }
        .map_err(|error| FileError::Io { path: self.path.clone(), error: into_io(error) })?;
        write_file(&self.path, &bytes)
    }
}

fn into_io(error: ImageError) -> io::Error {
    match error {
        ImageError::IoError(error) => error,
        error => io::Error::other(error),
    }
}

/// Refuses a file that surely cannot be written, before work is spent on what goes into it.
///
/// # Errors
/// The name is a directory's, or names one that is missing.
pub fn check_writable(path: &Path) -> Result<(), FileError> {
    let refuse = |error| Err(FileError::Io { path: path.to_owned(), error });
    if path.is_dir() {
        return refuse(io::Error::new(io::ErrorKind::IsADirectory, "it is a directory; name a file"));
    }
    let Some(missing) = missing_part_of(directory_of(path)) else { return Ok(()) };
    let reason = format!("there is no directory {}; make it first", missing.display());
    refuse(io::Error::new(io::ErrorKind::NotFound, reason))
}

/// How much of the name of a directory is to be made, if anything: all of it, unless it goes on by `..` from what is not there.
fn missing_part_of(directory: &Path) -> Option<&Path> {
    let first =
        directory.ancestors().take_while(|part| !part.as_os_str().is_empty() && !part.is_dir()).last()?;
    let is_straight = |part: &&Path| {
        part.strip_prefix(first).is_ok_and(|rest| !rest.components().any(|step| step == Component::ParentDir))
    };
    directory.ancestors().find(is_straight)
}

/// Refuses a file that is another by another name, before that is overwritten with what is made of it.
///
/// # Errors
/// Both are the same file.
pub fn check_apart(path: &Path, source: &Path) -> Result<(), FileError> {
    match (path.canonicalize(), source.canonicalize()) {
        (Ok(file), Ok(source)) if file == source => {
            let reason = "the scene itself is read from there; name another file";
            let error = io::Error::new(io::ErrorKind::AlreadyExists, reason);
            Err(FileError::Io { path: path.to_owned(), error })
        }
        _ => Ok(()),
    }
}

fn directory_of(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes a file under another name and renames it, so that nobody ever finds half of it.
///
/// # Errors
/// The system's; then there is no file, or the one that was there before.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let write = || -> io::Result<()> {
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            // As any other new file, and not for the owner alone: the system's mask still applies.
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let mut file = builder.prefix(".rayline-").tempfile_in(directory_of(path))?;
        file.write_all(bytes)?;
        file.persist(path).map_err(|error| error.error)?;
        Ok(())
    };
    write().map_err(|error| FileError::Io { path: path.to_owned(), error })
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Extension(path) => {
                write!(f, "cannot write {}: pictures are .png or .ppm files", path.display())
            }
            Self::Io { path, error } => write!(f, "cannot write {}: {error}", path.display()),
        }
    }
}

impl core::error::Error for FileError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Extension(_) => None,
            Self::Io { error, .. } => Some(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_taken_get_a_number() {
        let folder = tempfile::tempdir().unwrap();
        let file = PictureFile::new(&folder.path().join("a ball.png")).unwrap();
        for expected in ["a ball.png", "a ball-2.png", "a ball-3.png"] {
            let path = file.untaken().path().to_owned();
            assert_eq!(path, folder.path().join(expected));
            std::fs::write(path, "a picture").unwrap();
        }
    }

    /// Of `x/..` nobody knows what it is as long as there is no `x`.
    #[test]
    fn what_is_missing_is_a_directory_that_can_be_made() {
        let folder = tempfile::tempdir().unwrap();
        let missing = |name: &str| {
            let directory = folder.path().join(name);
            missing_part_of(&directory).map(|part| part.strip_prefix(folder.path()).unwrap().to_owned())
        };
        for (name, expected) in [("x/..", "x"), ("x/y/../z", "x/y"), ("x/y", "x/y"), ("x", "x")] {
            assert_eq!(missing(name), Some(PathBuf::from(expected)), "{name}");
        }
        assert_eq!(missing("."), None);
        std::fs::create_dir(folder.path().join("x")).unwrap();
        assert_eq!(missing("x/.."), None);
        assert_eq!(missing("x/../y"), Some(PathBuf::from("x/../y")));
    }
}
