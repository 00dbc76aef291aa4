//! Writing of files, whole or not at all.

use core::fmt;
use std::fs;
use std::io::{self, Write};
use std::iter;
use std::path::{Component, Path, PathBuf};

use rayline_formats::files::STANDARD_INPUT;

use crate::Picture;
use crate::raster::{to_png, to_ppm};

/// A file that a picture will be written to. Its name is checked before the picture is rendered.
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

/// The reason why a file cannot be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum FileError {
    /// The name does not end in `.png` or `.ppm`. Use one of these extensions.
    Extension(PathBuf),
    /// The name does not end in `.gif`, `.png` or `.apng`. Use one of these extensions.
    FilmExtension(PathBuf),
    /// The system refused. Its text says why.
    Io {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        error: io::Error,
    },
}

impl PictureFile {
    /// Checks the name of the file, and that there is a directory for it. Standard output (`-`), devices and
    /// pipes without an extension get a PNG file.
    ///
    /// # Errors
    /// The extension is neither `.png` nor `.ppm`, or the directory is missing.
    pub fn new(path: &Path) -> Result<Self, FileError> {
        let format = match extension(path).as_deref() {
            Some("png") => Format::Png,
            Some("ppm") => Format::Ppm,
            _ if is_nameless(path) => Format::Png,
            _ => return Err(FileError::Extension(path.to_owned())),
        };
        check_writable(path)?;
        Ok(Self { path: path.to_owned(), format })
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// This file, or if a file of this name exists, the file with the first free number after its name, from
    /// 2 on.
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
    /// The system refused. An existing file of this name is then unchanged.
    pub fn write(&self, picture: &Picture) -> Result<(), FileError> {
        let Picture { width, height, rgb, .. } = picture;
        let bytes = match self.format {
            Format::Png => to_png((*width, *height), 3, rgb),
            Format::Ppm => Ok(to_ppm((*width, *height), rgb)),
        };
        let bytes = bytes.map_err(|error| FileError::Io { path: self.path.clone(), error })?;
        write_file(&self.path, &bytes)
    }
}

/// The way in which bytes get to a path.
enum Way {
    /// To standard output.
    Output,
    /// To standard error.
    Error,
    /// Through a device, a named pipe, a socket or a file that is open already: it stays, and gets the bytes.
    Through(PathBuf),
    /// To a regular file, which is replaced whole. This path is no symbolic link to it.
    Replace(PathBuf),
}

impl Way {
    /// The way to the file that this path leads to, by symbolic links or without.
    fn to(path: &Path) -> io::Result<Self> {
        /// As many as Linux follows.
        const MOST_LINKS: usize = 40;
        if path == Path::new(STANDARD_OUTPUT) {
            return Ok(Self::Output);
        }
        let mut path = path.to_owned();
        for _ in 0..=MOST_LINKS {
            match path.to_str().unwrap_or_default() {
                "/dev/stdout" | "/dev/fd/1" | "/proc/self/fd/1" => return Ok(Self::Output),
                "/dev/stderr" | "/dev/fd/2" | "/proc/self/fd/2" => return Ok(Self::Error),
                // The files that are open already look like links to files.
                _ if path.starts_with("/dev/fd") || path.starts_with("/proc") => {
                    return Ok(Self::Through(path));
                }
                _ => {}
            }
            if let Ok(target) = path.read_link() {
                path = directory_of(&path).join(target);
                continue;
            }
            return Ok(match path.metadata() {
                Ok(data) if !data.is_file() && !data.is_dir() => Self::Through(path),
                _ => Self::Replace(path),
            });
        }
        Err(io::Error::other("its symbolic links lead in a circle; name another file"))
    }
}

/// The path that stands for standard output.
pub(crate) const STANDARD_OUTPUT: &str = "-";

/// Whether bytes that are written to this path go to standard output, so that nothing else may be written
/// there.
pub fn is_standard_output(path: &Path) -> bool {
    matches!(Way::to(path), Ok(Way::Output))
}

/// Whether a path is no file but standard output, a device or a pipe: such a path has no extension that gives
/// a format.
pub(crate) fn is_nameless(path: &Path) -> bool {
    !matches!(Way::to(path), Ok(Way::Replace(_)) | Err(_))
}

/// Refuses a file that surely cannot be written, before its contents are computed.
///
/// # Errors
/// The name is that of a directory, or its directory is missing.
pub fn check_writable(path: &Path) -> Result<(), FileError> {
    let refuse = |error| Err(FileError::Io { path: path.to_owned(), error });
    let file = match Way::to(path) {
        Ok(Way::Replace(file)) => file,
        Ok(_) => return Ok(()),
        Err(error) => return refuse(error),
    };
    if file.is_dir() {
        return refuse(io::Error::new(io::ErrorKind::IsADirectory, "it is a directory; name a file in it"));
    }
    let Some(missing) = missing_part_of(directory_of(&file)) else { return Ok(()) };
    let reason = format!("there is no directory {}; create it first", missing.display());
    refuse(io::Error::new(io::ErrorKind::NotFound, reason))
}

/// The part of a directory's path that has to be created, if any: all of it, unless `..` follows a component
/// that does not exist.
fn missing_part_of(directory: &Path) -> Option<&Path> {
    let first =
        directory.ancestors().take_while(|part| !part.as_os_str().is_empty() && !part.is_dir()).last()?;
    let is_straight = |part: &&Path| {
        part.strip_prefix(first).is_ok_and(|rest| !rest.components().any(|step| step == Component::ParentDir))
    };
    directory.ancestors().find(is_straight)
}

/// Refuses an output file that is the source file, perhaps under another name.
///
/// # Errors
/// Both are the same file.
pub fn check_apart(path: &Path, source: &Path) -> Result<(), FileError> {
    if is_nameless(path) || source == Path::new(STANDARD_INPUT) {
        return Ok(());
    }
    match (path.canonicalize(), source.canonicalize()) {
        (Ok(file), Ok(source)) if file == source => {
            let reason = "it is the file that the scene is read from; name another file";
            let error = io::Error::new(io::ErrorKind::AlreadyExists, reason);
            Err(FileError::Io { path: path.to_owned(), error })
        }
        _ => Ok(()),
    }
}

/// The extension of a file's name, in small letters.
pub(crate) fn extension(path: &Path) -> Option<String> {
    path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase())
}

fn directory_of(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes bytes to a path: to standard output for `-`, and through devices, pipes and sockets.
///
/// A regular file is written under a temporary name and renamed, so that no other program reads half of it.
/// Symbolic links to it stay, and so do its permissions.
///
/// # Errors
/// The system refused. An existing regular file of this name is then unchanged.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let write_to = |mut out: Box<dyn Write>| out.write_all(bytes).and_then(|()| out.flush());
    let written = Way::to(path).and_then(|way| match way {
        Way::Output => write_to(Box::new(io::stdout().lock())),
        Way::Error => write_to(Box::new(io::stderr().lock())),
        Way::Through(path) => write_to(Box::new(fs::OpenOptions::new().append(true).open(path)?)),
        Way::Replace(target) => replace(&target, bytes),
    });
    written.map_err(|error| FileError::Io { path: path.to_owned(), error })
}

/// Replaces a regular file whole, or creates it.
fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = temporary(path)?;
    file.write_all(bytes)?;
    if let Ok(known) = path.metadata() {
        keep_owner(&known, file.path());
        file.as_file().set_permissions(known.permissions())?;
    }
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// A file in the directory of `path`, which vanishes unless it is renamed.
fn temporary(path: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        // The permissions of any new file (the umask still applies), not those of a temporary file.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.prefix(".rayline-").tempfile_in(directory_of(path))
}

/// Writes new files beside a file, and then the file itself: all of them or none.
///
/// # Errors
/// The system refused, or one of the new files exists. All files are then as before.
pub(crate) fn write_beside<'b>(
    path: &Path,
    bytes: &[u8],
    new: impl Iterator<Item = (PathBuf, &'b [u8])>,
) -> Result<(), FileError> {
    let mut written = Vec::new();
    let write_all = || {
        for (path, bytes) in new {
            write_new(&path, bytes).map_err(|error| FileError::Io { path: path.clone(), error })?;
            written.push(path);
        }
        write_file(path, bytes)
    };
    let result = write_all();
    if result.is_err() {
        for path in written {
            // Nothing more can be done, and the first error says why.
            let _ = std::fs::remove_file(path);
        }
    }
    result
}

/// Writes a file that does not exist, under a temporary name first.
fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = temporary(path)?;
    file.write_all(bytes)?;
    file.persist_noclobber(path).map_err(|error| error.error)?;
    Ok(())
}

/// Gives a file the owner and the group of another, as far as the system allows.
#[cfg(unix)]
fn keep_owner(known: &fs::Metadata, path: &Path) {
    use std::os::unix::fs::{MetadataExt, chown};
    // A user may not give files away, but the pictures that root writes again stay those of the user.
    let _ = chown(path, Some(known.uid()), Some(known.gid()));
}

#[cfg(not(unix))]
fn keep_owner(_: &fs::Metadata, _: &Path) {}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Extension(path) => {
                write!(f, "cannot write {}: pictures are .png or .ppm files", path.display())
            }
            Self::FilmExtension(path) => {
                write!(f, "cannot write {}: films are .gif, .png or .apng files", path.display())
            }
            Self::Io { path, error } => write!(f, "cannot write {}: {error}", path.display()),
        }
    }
}

impl core::error::Error for FileError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Extension(_) | Self::FilmExtension(_) => None,
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

    #[test]
    fn files_are_written_together_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let names = || {
            let entries = std::fs::read_dir(folder.path()).unwrap();
            let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
            names.sort();
            names
        };
        std::fs::write(path("b.png"), "of others").unwrap();
        let new = |names: [&'static str; 2]| names.map(|name| (path(name), name.as_bytes())).into_iter();
        assert!(write_beside(&path("scene.ron"), b"scene", new(["a.png", "b.png"])).is_err());
        assert_eq!(names(), ["b.png"]);
        // The scene itself cannot be written.
        std::fs::create_dir(path("scene.ron")).unwrap();
        assert!(write_beside(&path("scene.ron"), b"scene", new(["a.png", "c.png"])).is_err());
        assert_eq!(names(), ["b.png", "scene.ron"]);
        write_beside(&path("other.ron"), b"scene", new(["a.png", "c.png"])).unwrap();
        assert_eq!(names(), ["a.png", "b.png", "c.png", "other.ron", "scene.ron"]);
        assert_eq!(std::fs::read(path("b.png")).unwrap(), b"of others");
    }

    /// `x/..` has no meaning as long as there is no `x`.
    #[test]
    fn the_missing_part_is_a_directory_that_can_be_created() {
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
