//! Pictures that materials name: each file is read once, and so are the images for the core that are made of
//! it.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use bumpalo::Bump;
use rayline::{Encoding, Ends, Figure, Filter, Image, Pixels, Placed, Placement};

use crate::files::{Files, MAX_PIXELS};
use crate::raster::Raster;
use crate::srgb::{Codes, byte};

/// How a picture lies on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wrapping {
    pub(crate) placement: Placement,
    pub(crate) ends: Ends,
}

/// The part of each pixel that an image is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Part {
    /// The color, with its light multiplied by these factors, as bits.
    Color([u32; 3]),
    /// The brightness of the codes, or the opacity.
    Level { is_alpha: bool },
}

/// The pictures of a model, read when a material needs them.
#[derive(Debug)]
pub(crate) struct Pictures<'a> {
    arena: &'a Bump,
    files: &'a Files,
    read: HashMap<PathBuf, Result<Rc<Raster>, String>>,
    /// The pixels of images for the core, by the address of the picture.
    made: HashMap<(usize, Part), &'a [u8]>,
    /// The number of pixels that images for the core may still have.
    room: usize,
}

impl<'a> Pictures<'a> {
    pub(crate) fn new(arena: &'a Bump, files: &'a Files) -> Self {
        Self { arena, files, read: HashMap::new(), made: HashMap::new(), room: MAX_PIXELS }
    }

    /// The picture in a file.
    ///
    /// # Errors
    /// The file cannot be read, is no picture, or there are too many pixels. The text says why.
    pub(crate) fn open(&mut self, path: &Path) -> Result<Rc<Raster>, String> {
        if let Some(known) = self.read.get(path) {
            return known.clone();
        }
        let raster = self.files.picture(path).map(Rc::new).map_err(|error| error.to_string());
        self.read.insert(path.to_owned(), raster.clone());
        raster
    }

    /// Counts pixels, and refuses too many.
    fn take(&mut self, pixels: usize) -> Result<(), String> {
        let too_many =
            || format!("the pictures have more than {MAX_PIXELS} pixels together; use smaller ones");
        self.room = self.room.checked_sub(pixels).ok_or_else(too_many)?;
        Ok(())
    }

    /// The image of a picture's color, with its linear light multiplied by factors from 0 to 1.
    ///
    /// # Errors
    /// There are too many pixels.
    pub(crate) fn color(
        &mut self,
        picture: &Rc<Raster>,
        factor: [f32; 3],
        wrapping: Wrapping,
    ) -> Result<&'a Placed<'a>, String> {
        let pixels = self.pixels(picture, Part::Color(factor.map(f32::to_bits)), || {
            let [red, green, blue] = factor.map(Codes::new);
            picture.pixels.iter().flat_map(|[r, g, b, _]| [red.of(*r), green.of(*g), blue.of(*b)]).collect()
        })?;
        Ok(self.placed(picture, Pixels::Rgb888(pixels), Encoding::Srgb, wrapping))
    }

    /// The image of a picture's numbers, as a map of normals has them.
    ///
    /// # Errors
    /// There are too many pixels.
    pub(crate) fn numbers(
        &mut self,
        picture: &Rc<Raster>,
        wrapping: Wrapping,
    ) -> Result<&'a Placed<'a>, String> {
        let pixels = self.pixels(picture, Part::Color([1.0f32; 3].map(f32::to_bits)), || picture.rgb())?;
        Ok(self.placed(picture, Pixels::Rgb888(pixels), Encoding::Linear, wrapping))
    }

    /// An image of one level for each pixel: its brightness or its opacity, from 0 to 255, as light from 0 to
    /// 1 by the function `light`.
    ///
    /// # Errors
    /// There are too many pixels.
    pub(crate) fn levels(
        &mut self,
        picture: &Rc<Raster>,
        is_alpha: bool,
        wrapping: Wrapping,
        light: impl Fn(f32) -> f32,
    ) -> Result<&'a Placed<'a>, String> {
        let indices = self.pixels(picture, Part::Level { is_alpha }, || {
            let level = |[r, g, b, a]: &[u8; 4]| {
                let brightness = (u16::from(*r) + 2 * u16::from(*g) + u16::from(*b) + 2) / 4;
                if is_alpha { *a } else { brightness as u8 }
            };
            picture.pixels.iter().map(level).collect()
        })?;
        let palette = (0..=u8::MAX).map(|level| [byte(light(f32::from(level) / 255.0)); 3]);
        let palette = self.arena.alloc_slice_fill_iter(palette);
        Ok(self.placed(picture, Pixels::Palette8 { indices, palette }, Encoding::Linear, wrapping))
    }

    fn pixels(
        &mut self,
        picture: &Rc<Raster>,
        part: Part,
        make: impl FnOnce() -> Vec<u8>,
    ) -> Result<&'a [u8], String> {
        let key = (Rc::as_ptr(picture).addr(), part);
        if let Some(known) = self.made.get(&key) {
            return Ok(known);
        }
        self.take(picture.pixels.len())?;
        let pixels = &*self.arena.alloc_slice_copy(&make());
        self.made.insert(key, pixels);
        Ok(pixels)
    }

    fn placed(
        &self,
        picture: &Raster,
        pixels: Pixels<'a>,
        encoding: Encoding,
        Wrapping { placement, ends }: Wrapping,
    ) -> &'a Placed<'a> {
        let image = Image {
            // The limits of the decoder exclude larger pictures.
            width: picture.width as u16,
            height: picture.height as u16,
            pixels,
            encoding,
            filter: Filter::Bilinear,
            ends,
        };
        self.arena.alloc(Placed::new(Figure::Image(image), placement))
    }
}

/// The mean of a picture's codes, 0 to 1, in each channel.
pub(crate) fn mean_of_codes(picture: &Raster) -> [f64; 3] {
    let mut sums = [0u64; 3];
    for pixel in &picture.pixels {
        for (sum, code) in sums.iter_mut().zip(pixel) {
            *sum += u64::from(*code);
        }
    }
    sums.map(|sum| sum as f64 / 255.0 / picture.pixels.len().max(1) as f64)
}
