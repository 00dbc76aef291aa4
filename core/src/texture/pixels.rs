//! The pixels of images, in flash.

use super::srgb::LINEAR;
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::math::Real;

/// The pixels of an image, from left to right and then from top to bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Pixels<'a> {
    /// One `u16` for each pixel: 5 bits of red in the highest bits, 6 of green, 5 of blue.
    Rgb565(&'a [u16]),
    /// Three bytes for each pixel: red, green and blue.
    #[cfg_attr(feature = "serde", serde(serialize_with = "crate::read::bytes"))]
    Rgb888(&'a [u8]),
    /// One byte for each pixel: the number of a color in a palette.
    Palette8 {
        /// The number of each pixel's color.
        #[cfg_attr(feature = "serde", serde(serialize_with = "crate::read::bytes"))]
        indices: &'a [u8],
        /// The colors: red, green and blue.
        palette: &'a [[u8; 3]],
    },
    /// Half a byte for each pixel: the number of a color in a palette. The upper half of a byte is the left
    /// pixel of two, and each line begins with a new byte.
    Palette4 {
        /// The numbers of two pixels' colors in each byte.
        #[cfg_attr(feature = "serde", serde(serialize_with = "crate::read::bytes"))]
        indices: &'a [u8],
        /// The colors: red, green and blue.
        palette: &'a [[u8; 3]],
    },
}

/// The fields of [`Pixels::Palette8`] and [`Pixels::Palette4`], for reading files.
#[cfg(feature = "serde")]
#[derive(Clone, Copy)]
struct Indexed<'a> {
    indices: &'a [u8],
    palette: &'a [[u8; 3]],
}

#[cfg(feature = "serde")]
crate::read::read_struct!([] Indexed as Indexed<'m> { indices, palette });

#[cfg(feature = "serde")]
crate::read::read_enum! {
    [] Pixels as Pixels<'m> {
        Rgb565(&'m [u16]), Rgb888(&'m [u8]),
        Palette8 { Indexed<'m>: indices, palette },
        Palette4 { Indexed<'m>: indices, palette },
    }
}

/// The encoding of light in the numbers of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Encoding {
    /// The codes of sRGB, as in almost every image file.
    #[default]
    Srgb,
    /// Amounts proportional to light, or to the heights of a bump map.
    Linear,
}

impl Encoding {
    /// The linear light of a code.
    pub(crate) fn light<R: Real>(self, code: u8) -> R {
        let light = match self {
            Self::Srgb => LINEAR.get(usize::from(code)).copied().unwrap_or(u16::MAX),
            Self::Linear => u16::from(code).wrapping_mul(257),
        };
        if light == u16::MAX { R::ONE } else { R::from_fraction(light) }
    }
}

impl Pixels<'_> {
    /// Refuses a list that does not hold `width` times `height` pixels, and numbers of colors that the
    /// palette does not have.
    pub(super) fn check(&self, width: u16, height: u16) -> Result<(), Fault> {
        let (columns, lines) = (usize::from(width), usize::from(height));
        let (given, per_line) = match self {
            Self::Rgb565(pixels) => (pixels.len(), columns),
            Self::Rgb888(bytes) => (bytes.len(), columns.saturating_mul(3)),
            Self::Palette8 { indices, .. } => (indices.len(), columns),
            Self::Palette4 { indices, .. } => (indices.len(), columns.div_ceil(2)),
        };
        let needed = per_line.saturating_mul(lines);
        if given != needed || given == 0 {
            return Err(Fault::PixelCount { needed, given });
        }
        let (largest, colors) = match self {
            Self::Rgb565(_) | Self::Rgb888(_) => return Ok(()),
            Self::Palette8 { indices, palette } => (indices.iter().copied().max(), palette.len()),
            Self::Palette4 { indices, palette } => {
                (indices.iter().map(|pair| (pair >> 4).max(pair & 15)).max(), palette.len())
            }
        };
        match largest {
            Some(named) if usize::from(named) >= colors => {
                Err(Fault::PaletteColor { named: named.into(), colors })
            }
            _ => Ok(()),
        }
    }

    /// The linear light of a pixel; black where the list ends before it.
    pub(super) fn light<R: Real>(&self, encoding: Encoding, width: u16, x: u16, y: u16) -> LinearRgb<R> {
        let (width, x, y) = (usize::from(width), usize::from(x), usize::from(y));
        let place = y.wrapping_mul(width).wrapping_add(x);
        let color = |palette: &[[u8; 3]], name: u8| palette.get(usize::from(name)).copied();
        let codes = match self {
            Self::Rgb565(pixels) => pixels.get(place).map(|pixel| {
                let (r, g, b) = ((pixel >> 11) as u8, (pixel >> 5 & 63) as u8, (pixel & 31) as u8);
                // Repeat the upper bits in the lower ones: the largest code is then 255.
                [r << 3 | r >> 2, g << 2 | g >> 4, b << 3 | b >> 2]
            }),
            Self::Rgb888(bytes) => {
                bytes.get(place.wrapping_mul(3)..).and_then(<[u8]>::first_chunk::<3>).copied()
            }
            Self::Palette8 { indices, palette } => indices.get(place).and_then(|name| color(palette, *name)),
            Self::Palette4 { indices, palette } => {
                let pair = indices.get(y.wrapping_mul(width.div_ceil(2)).wrapping_add(x >> 1));
                pair.and_then(|pair| color(palette, if x & 1 == 0 { pair >> 4 } else { pair & 15 }))
            }
        };
        let [r, g, b] = codes.unwrap_or_default().map(|code| encoding.light(code));
        LinearRgb::new(r, g, b)
    }
}
