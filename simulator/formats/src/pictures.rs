//! Pictures that are written as PNG files beside a scene's file.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use png::BitDepth;
use rayline::{Encoding, Ends, Filter, Image, Pixels};

use crate::raster::{to_indexed_png, to_png};
use crate::srgb::byte;

/// The pictures of one scene, as PNG files in the folder of the scene's file. Equal pictures are one file.
///
/// No file is ever replaced: the files have names that are free, or hold the same bytes already.
#[derive(Clone, Debug)]
pub struct Pictures<'a> {
    folder: PathBuf,
    /// The beginning of all names.
    stem: String,
    /// The last number that is part of a name.
    last: u32,
    files: Vec<Picture<'a>>,
}

#[derive(Clone, Debug)]
struct Picture<'a> {
    size: (u16, u16),
    pixels: Pixels<'a>,
    name: String,
    /// `None` if there is such a file.
    bytes: Option<Vec<u8>>,
}

impl<'a> Pictures<'a> {
    /// Pictures beside this file of a scene: `scene-1.png`, `scene-2.png` and so on, beside `scene.ron`.
    pub fn beside(scene: &Path) -> Self {
        let stem = scene.file_stem().unwrap_or_default().to_string_lossy();
        // Languages of scenes differ in how they write other characters.
        let plain = |letter: char| {
            if letter.is_ascii_alphanumeric() || "-. ".contains(letter) { letter } else { '_' }
        };
        Self {
            folder: scene.parent().unwrap_or(Path::new("")).to_owned(),
            stem: stem.chars().map(plain).collect(),
            last: 0,
            files: Vec::new(),
        }
    }

    /// The name of the file that holds the pixels of this image, without a folder.
    ///
    /// # Errors
    /// The image has another number of pixels than width times height.
    pub fn name_of(&mut self, image: &Image<'a>) -> io::Result<String> {
        let Image { width, height, pixels, .. } = *image;
        let size = (width, height);
        let mut known = self.files.iter();
        if let Some(same) = known.find(|file| file.size == size && file.pixels == pixels) {
            return Ok(same.name.clone());
        }
        let bytes = png(image)?;
        let (name, is_new) = loop {
            self.last = self.last.saturating_add(1);
            let name = format!("{}-{}.png", self.stem, self.last);
            let path = self.folder.join(&name);
            if path.symlink_metadata().is_err() {
                break (name, true);
            }
            if path.is_file() && fs::read(&path).is_ok_and(|present| present == bytes) {
                break (name, false);
            }
        };
        self.files.push(Picture { size, pixels, name: name.clone(), bytes: is_new.then_some(bytes) });
        Ok(name)
    }

    /// The number of pictures.
    pub fn count(&self) -> usize {
        self.files.len()
    }

    /// The files that are to be written, with their bytes.
    pub fn files(&self) -> impl Iterator<Item = (PathBuf, &[u8])> {
        self.files.iter().filter_map(|file| Some((self.folder.join(&file.name), file.bytes.as_deref()?)))
    }
}

/// The bytes of a PNG file with the pixels of an image. A palette stays a palette.
fn png(image: &Image<'_>) -> io::Result<Vec<u8>> {
    let size = (image.width.into(), image.height.into());
    match image.pixels {
        Pixels::Rgb888(rgb) => to_png(size, 3, rgb),
        Pixels::Palette8 { indices, palette } => to_indexed_png(size, BitDepth::Eight, indices, palette),
        Pixels::Palette4 { indices, palette } => to_indexed_png(size, BitDepth::Four, indices, palette),
        Pixels::Rgb565(pixels) => {
            to_png(size, 3, &pixels.iter().flat_map(|pixel| codes(*pixel)).collect::<Vec<_>>())
        }
    }
}

/// The codes of 8 bits of a pixel of 16 bits.
pub(crate) fn codes(pixel: u16) -> [u8; 3] {
    // In linear encoding, the light of a pixel is its code over 255.
    let (encoding, filter, ends) = (Encoding::Linear, Filter::Nearest, Ends::Repeat);
    let image = Image { width: 1, height: 1, pixels: Pixels::Rgb565(&[pixel]), encoding, filter, ends };
    image.light(0, 0).channels().map(byte)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::raster::Raster;

    /// An image as it is read from a file.
    pub(crate) const IMAGE: Image = Image {
        width: 2,
        height: 1,
        pixels: Pixels::Rgb888(&[1, 2, 3, 4, 5, 6]),
        encoding: Encoding::Srgb,
        filter: Filter::Bilinear,
        ends: Ends::Repeat,
    };

    #[test]
    fn equal_pictures_are_one_file_and_no_file_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let scene = folder.path().join("my \"scene\".ron");
        fs::write(folder.path().join("my _scene_-2.png"), "of somebody else").unwrap();
        let mut pictures = Pictures::beside(&scene);
        let other = Image { pixels: Pixels::Rgb888(&[9, 2, 3, 4, 5, 6]), ..IMAGE };
        assert_eq!(pictures.name_of(&IMAGE).unwrap(), "my _scene_-1.png");
        assert_eq!(pictures.name_of(&other).unwrap(), "my _scene_-3.png");
        let linear = Image { encoding: Encoding::Linear, filter: Filter::Nearest, ..IMAGE };
        assert_eq!(pictures.name_of(&linear).unwrap(), "my _scene_-1.png");
        let files: Vec<_> = pictures.files().collect();
        assert_eq!((files.len(), pictures.count()), (2, 2));
        for (path, bytes) in files {
            assert_eq!(path.parent(), Some(folder.path()));
            fs::write(path, bytes).unwrap();
        }
        // The second time, all files are there.
        let mut again = Pictures::beside(&scene);
        let names = [IMAGE, other].map(|image| again.name_of(&image).unwrap());
        assert_eq!(names, ["my _scene_-1.png", "my _scene_-3.png"]);
        assert_eq!((again.files().count(), again.count()), (0, 2));
        assert!(pictures.name_of(&Image { width: 3, ..IMAGE }).is_err());
    }

    #[test]
    fn pixels_of_16_bits_keep_their_codes() {
        let image = Image { pixels: Pixels::Rgb565(&[0xF81F, 0x0841]), ..IMAGE };
        assert_eq!(Raster::decode(&png(&image).unwrap()).unwrap().rgb(), [255, 0, 255, 8, 8, 8]);
    }
}
