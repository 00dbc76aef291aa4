//! A picture in 8-bit linear light.

use std::path::Path;

use rayline_simulator::raster::{Raster, to_png};

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
        let fail = |error: &dyn core::fmt::Display| -> ! { panic!("{}: {error}", path.display()) };
        let bytes = std::fs::read(path).unwrap_or_else(|error| fail(&error));
        let image = Raster::decode(&bytes).unwrap_or_else(|error| fail(&error));
        Self { width: image.width, pixels: image.pixels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect() }
    }

    /// Writes a PNG file.
    pub fn write(&self, path: &Path) {
        let height = (self.pixels.len() / self.width as usize) as u32;
        let png = to_png((self.width, height), 3, self.pixels.as_flattened()).expect("whole lines");
        std::fs::write(path, png).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
}
