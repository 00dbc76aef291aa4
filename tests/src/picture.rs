//! A picture in 8-bit linear light.

use std::path::Path;

/// A picture in 8-bit linear light, line by line from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// The width in pixels.
    pub width: u32,
    /// Red, green and blue of each pixel.
    pub pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// Reads a picture in any format that the tests enable.
    pub fn read(path: &Path) -> Self {
        let image = image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let image = image.into_rgb8();
        Self { width: image.width(), pixels: image.pixels().map(|pixel| pixel.0).collect() }
    }

    /// Writes a PNG file.
    pub fn write(&self, path: &Path) {
        let height = (self.pixels.len() / self.width as usize) as u32;
        let bytes = self.pixels.iter().flatten().copied().collect();
        let image = image::RgbImage::from_raw(self.width, height, bytes).expect("whole lines");
        image.save(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
}
