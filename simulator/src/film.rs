//! Files with moving pictures.

use std::io;
use std::path::{Path, PathBuf};

use rayline_scenes::animation::Length;

use crate::Picture;
use crate::file::{FileError, check_writable, extension, is_nameless, write_file};

/// A file that moving pictures will be written to. Its name is checked before they are rendered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilmFile {
    path: PathBuf,
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Gif,
    Apng,
}

/// How carefully a GIF chooses its 256 colors if a picture has more: 1 is best, 30 is fastest.
const SPEED: i32 = 10;

/// A film that is being written: its frames so far.
enum Film<'b> {
    Gif(gif::Encoder<&'b mut Vec<u8>>),
    Apng(png::Writer<&'b mut Vec<u8>>),
}

impl FilmFile {
    /// Checks the name of the file, and that there is a directory for it. Standard output (`-`), devices and
    /// pipes without an extension get a GIF.
    ///
    /// # Errors
    /// The extension is neither `.gif`, `.png` nor `.apng`, or the directory is missing.
    pub fn new(path: &Path) -> Result<Self, FileError> {
        let format = match extension(path).as_deref() {
            Some("gif") => Format::Gif,
            Some("png" | "apng") => Format::Apng,
            _ if is_nameless(path) => Format::Gif,
            _ => return Err(FileError::FilmExtension(path.to_owned())),
        };
        check_writable(path)?;
        Ok(Self { path: path.to_owned(), format })
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a film that repeats without end, from the pictures of the frames, and returns its length in
    /// bytes. Each frame of a GIF has 256 colors of its own.
    ///
    /// # Errors
    /// The errors of `frame`, or the system refused. An existing file of this name is then unchanged.
    pub fn write<E: From<FileError>>(
        &self,
        length: Length,
        mut frame: impl FnMut(u32) -> Result<Picture, E>,
    ) -> Result<usize, E> {
        let refused = |error: io::Error| FileError::Io { path: self.path.clone(), error };
        let mut bytes = Vec::new();
        let first = frame(0)?;
        let mut film = Film::new(self.format, &first, length.frames(), &mut bytes).map_err(refused)?;
        film.add(&first, delay(length, 0)).map_err(refused)?;
        for number in 1..length.frames() {
            film.add(&frame(number)?, delay(length, number)).map_err(refused)?;
        }
        film.finish().map_err(refused)?;
        write_file(&self.path, &bytes)?;
        Ok(bytes.len())
    }
}

/// The time that a frame is shown, in hundredths of a second: rounded so that the whole film has its length.
fn delay(length: Length, frame: u32) -> u16 {
    let end = |frame: u32| (f64::from(length.time(frame)) * 100.0).round();
    (end(frame + 1) - end(frame)).clamp(1.0, f64::from(u16::MAX)) as u16
}

impl<'b> Film<'b> {
    /// An empty film for pictures of the size of this one.
    fn new(format: Format, picture: &Picture, frames: u32, bytes: &'b mut Vec<u8>) -> io::Result<Self> {
        let Picture { width, height, .. } = *picture;
        Ok(match format {
            Format::Gif => {
                let mut film =
                    gif::Encoder::new(bytes, width as u16, height as u16, &[]).map_err(io::Error::other)?;
                film.set_repeat(gif::Repeat::Infinite).map_err(io::Error::other)?;
                Self::Gif(film)
            }
            Format::Apng => {
                let mut film = png::Encoder::new(bytes, width, height);
                film.set_color(png::ColorType::Rgb);
                film.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
                film.set_animated(frames, 0)?;
                Self::Apng(film.write_header()?)
            }
        })
    }

    /// Adds a frame that is shown for so many hundredths of a second.
    fn add(&mut self, picture: &Picture, delay: u16) -> io::Result<()> {
        match self {
            Self::Gif(film) => {
                let (width, height) = (picture.width as u16, picture.height as u16);
                let mut frame = gif::Frame::from_rgb_speed(width, height, &picture.rgb, SPEED);
                frame.delay = delay;
                film.write_frame(&frame).map_err(io::Error::other)
            }
            Self::Apng(film) => {
                film.set_frame_delay(delay, 100)?;
                Ok(film.write_image_data(&picture.rgb)?)
            }
        }
    }

    fn finish(self) -> io::Result<()> {
        match self {
            Self::Gif(film) => film.into_inner().map(|_| ()).map_err(io::Error::other),
            Self::Apng(film) => Ok(film.finish()?),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_add_up_to_the_length() {
        for (seconds, frames_per_second) in [(3.0, 12.0), (1.0, 30.0), (0.1, 50.0), (10.0, 0.5)] {
            let length = Length::new(seconds, frames_per_second).unwrap();
            let sum: u32 = (0..length.frames()).map(|frame| u32::from(delay(length, frame))).sum();
            assert_eq!(sum, (seconds * 100.0) as u32, "{seconds} s, {frames_per_second} frames a second");
        }
    }
}
