//! Reading of files: which are read, how much of them, and where the references of a scene may lead.
//!
//! - Only regular files and standard input are read: reading a named pipe may wait for ever, and a device may
//!   never end. The kind of the opened file is checked, so that symbolic links are covered as well.
//! - Everything has a limit: the constants of this module, and those of [`rayline::limits`].
//! - A file may refer only to files in the folder of the scene or below it, see [`Files::reference`].

use core::cell::{Cell, RefCell};
use std::fs::{File, FileType};
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use rayline::limits::{MAX_COUNT, MAX_SIDE};

use crate::raster::Raster;

/// The most bytes of one file.
pub const MAX_FILE_BYTES: u64 = 1 << 29;
/// The most bytes of all files of a scene together.
pub const MAX_SCENE_BYTES: u64 = 1 << 30;
/// The most files that a scene refers to, directly or by other files.
pub const MAX_REFERENCES: usize = 4096;
/// The most pixels of one picture, and of all pictures of a scene together. A decoded pixel takes 4 bytes.
pub const MAX_PIXELS: usize = 1 << 26;

/// The path that stands for standard input.
pub const STANDARD_INPUT: &str = "-";

/// The limits as text, for people.
pub fn limits() -> String {
    format!(
        "Only regular files and standard input are read: at most {} in one file and {} in all files of a \
         scene, which may refer to {MAX_REFERENCES} files. Its pictures may have {MAX_PIXELS} pixels \
         together ({} as decoded) and {MAX_SIDE} along each side. It may have {MAX_COUNT} objects, materials \
         and lights each.",
        mebibytes(MAX_FILE_BYTES),
        mebibytes(MAX_SCENE_BYTES),
        mebibytes(MAX_PIXELS as u64 * 4),
    )
}

/// Reads the files of one scene.
#[derive(Debug, Default)]
pub struct Files {
    /// The file of the scene.
    scene: PathBuf,
    is_standard_input: bool,
    allow_paths: bool,
    used: Cell<Used>,
    /// The bytes of the scene that were read to look at them.
    ahead: RefCell<Option<Vec<u8>>>,
}

/// The amounts that were read so far.
#[derive(Clone, Copy, Debug, Default)]
struct Used {
    references: usize,
    bytes: u64,
    pixels: usize,
}

impl Files {
    /// A reader of this scene's file, or of standard input for [`STANDARD_INPUT`], and of the files that it
    /// refers to: with `allow_paths` anywhere.
    pub fn new(scene: &Path, allow_paths: bool) -> Self {
        let is_standard_input = scene == Path::new(STANDARD_INPUT);
        let scene = if is_standard_input { Path::new("standard input") } else { scene };
        Self { scene: scene.to_owned(), is_standard_input, allow_paths, ..Self::default() }
    }

    /// The path of the scene's file, for messages and for [`read`](Self::read).
    pub fn scene(&self) -> &Path {
        &self.scene
    }

    /// Whether the scene may refer to files anywhere.
    pub fn allows_paths(&self) -> bool {
        self.allow_paths
    }

    /// Whether the scene is read from standard input.
    pub fn is_standard_input(&self) -> bool {
        self.is_standard_input
    }

    /// The folder of the scene's file; for standard input, the current folder.
    pub fn folder(&self) -> &Path {
        self.scene.parent().unwrap_or_else(|| Path::new(""))
    }

    /// The path of a file to which a file in `folder` refers by `name`.
    ///
    /// # Errors
    /// The path leads out of the folder of the scene: it is absolute, or has too many `..`. Move the file, or
    /// allow all paths. Symbolic links are followed later, by [`read`](Self::read).
    pub fn reference(&self, folder: &Path, name: impl AsRef<Path>) -> io::Result<PathBuf> {
        let name = name.as_ref();
        if self.allow_paths {
            return Ok(folder.join(name));
        }
        let inner = folder.strip_prefix(self.folder()).map_err(|_| outside())?;
        if has_drive(name) {
            return Err(outside());
        }
        let mut below = PathBuf::new();
        for part in inner.join(name).components() {
            match part {
                Component::Normal(part) => below.push(part),
                Component::CurDir => {}
                Component::ParentDir if below.pop() => {}
                _ => return Err(outside()),
            }
        }
        Ok(self.folder().join(below))
    }

    /// The bytes of the scene's file, or of a file to which it refers.
    ///
    /// # Errors
    /// The system refused, the file is no regular one, a limit is reached, or a symbolic link leads out of
    /// the folder of the scene. The text says what to do.
    pub fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let mut used = self.used.get();
        let bytes = if path != self.scene {
            used.references = used.references.saturating_add(1);
            if used.references > MAX_REFERENCES {
                return Err(refused(format!(
                    "the scene refers to more than {MAX_REFERENCES} files; use fewer"
                )));
            }
            if !self.allow_paths {
                self.check_links(path)?;
            }
            read_file(path, MAX_FILE_BYTES)?
        } else if let Some(bytes) = self.ahead.take() {
            return Ok(bytes);
        } else if self.is_standard_input {
            limited(io::stdin().lock(), Vec::new(), MAX_FILE_BYTES)?
        } else {
            read_file(path, MAX_FILE_BYTES)?
        };
        used.bytes = used.bytes.saturating_add(bytes.len() as u64);
        if used.bytes > MAX_SCENE_BYTES {
            let most = mebibytes(MAX_SCENE_BYTES);
            return Err(refused(format!("the files of the scene have more than {most} together; use less")));
        }
        self.used.set(used);
        Ok(bytes)
    }

    /// Looks at the bytes of the scene before they are read.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read).
    pub fn look<T>(&self, at: impl FnOnce(&[u8]) -> T) -> io::Result<T> {
        let bytes = self.read(&self.scene)?;
        let seen = at(&bytes);
        self.ahead.replace(Some(bytes));
        Ok(seen)
    }

    /// The picture in a file to which the scene refers.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read), of [`Raster::decode`] and of [`take_pixels`](Self::take_pixels).
    pub fn picture(&self, path: &Path) -> io::Result<Raster> {
        self.decode(&self.read(path)?)
    }

    /// The picture in these bytes of a file.
    ///
    /// # Errors
    /// The errors of [`Raster::decode`] and of [`take_pixels`](Self::take_pixels).
    pub fn decode(&self, bytes: &[u8]) -> io::Result<Raster> {
        let picture = Raster::decode(bytes).map_err(refused)?;
        self.take_pixels(picture.pixels.len())?;
        Ok(picture)
    }

    /// Counts the pixels of a picture.
    ///
    /// # Errors
    /// The pictures of the scene have more than [`MAX_PIXELS`] together. Use fewer or smaller ones.
    pub fn take_pixels(&self, pixels: usize) -> io::Result<()> {
        let mut used = self.used.get();
        used.pixels = used.pixels.saturating_add(pixels);
        if used.pixels > MAX_PIXELS {
            return Err(refused(format!(
                "the pictures of the scene have more than {MAX_PIXELS} pixels together; use smaller ones"
            )));
        }
        self.used.set(used);
        Ok(())
    }

    /// Refuses a file that lies outside of the scene's folder once all symbolic links are followed.
    fn check_links(&self, path: &Path) -> io::Result<()> {
        let folder = Path::new(".").join(self.folder()).canonicalize()?;
        if path.canonicalize()?.starts_with(folder) { Ok(()) } else { Err(outside()) }
    }
}

/// The bytes of a regular file.
///
/// # Errors
/// The system refused, the file is no regular one, or it has more than [`MAX_FILE_BYTES`].
pub fn read_regular(path: &Path) -> io::Result<Vec<u8>> {
    read_file(path, MAX_FILE_BYTES)
}

fn read_file(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // Opening alone may act on a device, so the kind of file is checked by its path first.
    check_regular(path.metadata()?.file_type())?;
    let mut options = File::options();
    options.read(true);
    #[cfg(unix)]
    {
        // A named pipe that takes the file's place in between is opened without waiting.
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags(libc::O_NONBLOCK | libc::O_NOCTTY);
    }
    let file = options.open(path)?;
    let metadata = file.metadata()?;
    check_regular(metadata.file_type())?;
    if metadata.len() > most {
        return Err(large(most));
    }
    let mut bytes = Vec::new();
    // The length of some files of the system is 0 before they are read.
    bytes.try_reserve_exact(usize::try_from(metadata.len()).unwrap_or(usize::MAX))?;
    limited(file, bytes, most)
}

/// All bytes of a source that has at most so many.
fn limited(source: impl Read, mut bytes: Vec<u8>, most: u64) -> io::Result<Vec<u8>> {
    source.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(large(most)) } else { Ok(bytes) }
}

fn check_regular(kind: FileType) -> io::Result<()> {
    if kind.is_file() {
        return Ok(());
    }
    let what = if kind.is_dir() { "a folder" } else { special(kind) };
    Err(refused(format!(
        "it is {what}, and only regular files are read; give the contents to standard input, as the scene `-`"
    )))
}

/// The kind of a file that is neither a regular file nor a folder.
#[cfg(unix)]
fn special(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    match () {
        () if kind.is_fifo() => "a pipe",
        () if kind.is_socket() => "a socket",
        () => "a device",
    }
}

#[cfg(not(unix))]
fn special(_: FileType) -> &'static str {
    "a device"
}

/// Whether a path begins with a drive, as those of other systems do.
fn has_drive(name: &Path) -> bool {
    let bytes = name.as_os_str().as_encoded_bytes();
    matches!(bytes, [letter, b':', b'/' | b'\\', ..] if letter.is_ascii_alphabetic())
}

fn outside() -> io::Error {
    refused("it is not in the folder of the scene or below it; move it there, or use --allow-paths")
}

fn large(most: u64) -> io::Error {
    refused(format!("it has more than {}, which is the limit; use a smaller file", mebibytes(most)))
}

fn refused(reason: impl Into<Box<dyn core::error::Error + Send + Sync>>) -> io::Error {
    io::Error::other(reason)
}

fn mebibytes(bytes: u64) -> String {
    if bytes < 1 << 20 { format!("{bytes} bytes") } else { format!("{} MiB", bytes >> 20) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told<T>(result: io::Result<T>) -> String {
        result.map(|_| ()).unwrap_err().to_string()
    }

    #[test]
    fn sources_are_read_up_to_the_limit() {
        assert_eq!(limited(&b"12345"[..], Vec::new(), 5).unwrap(), b"12345");
        let endless = io::repeat(7);
        assert_eq!(
            told(limited(endless, Vec::new(), 5)),
            "it has more than 5 bytes, which is the limit; use a smaller file"
        );
        assert_eq!(mebibytes(MAX_FILE_BYTES), "512 MiB");
    }

    #[test]
    fn references_and_pixels_are_counted_for_the_whole_scene() {
        let folder = tempfile::tempdir().unwrap();
        let scene = folder.path().join("scene.ron");
        std::fs::write(folder.path().join("part.obj"), "v 0 0 0").unwrap();
        let files = Files::new(&scene, false);
        let part = files.reference(folder.path(), "part.obj").unwrap();
        for _ in 0..MAX_REFERENCES {
            assert_eq!(files.read(&part).unwrap(), b"v 0 0 0");
        }
        assert_eq!(told(files.read(&part)), "the scene refers to more than 4096 files; use fewer");
        files.take_pixels(MAX_PIXELS - 1).unwrap();
        files.take_pixels(1).unwrap();
        assert_eq!(
            told(files.take_pixels(1)),
            "the pictures of the scene have more than 67108864 pixels together; use smaller ones"
        );
    }

    #[test]
    fn paths_stay_in_the_folder() {
        let files = Files::new(Path::new("scenes/scene.ron"), false);
        let refer = |folder: &str, name: &str| files.reference(Path::new(folder), name).ok();
        let inside = |path: &str| Some(Path::new("scenes").join(path));
        assert_eq!(refer("scenes", "wood.png"), inside("wood.png"));
        assert_eq!(refer("scenes", "./a/../b/wood.png"), inside("b/wood.png"));
        assert_eq!(refer("scenes/a", "../wood.png"), inside("wood.png"));
        for (folder, name) in [
            ("scenes", "../wood.png"),
            ("scenes", "a/../../wood.png"),
            ("scenes", "/wood.png"),
            ("scenes", "C:\\wood.png"),
            ("scenes", "c:/wood.png"),
            ("scenes/a", "../../wood.png"),
            ("elsewhere", "wood.png"),
        ] {
            assert_eq!(refer(folder, name), None, "{folder} {name}");
        }
        let all = Files::new(Path::new("scenes/scene.ron"), true);
        assert_eq!(all.reference(Path::new("scenes"), "/wood.png").unwrap(), Path::new("/wood.png"));
    }
}
