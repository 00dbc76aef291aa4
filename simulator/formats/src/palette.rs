//! Pictures in as few bytes as their colors need.

use std::collections::HashMap;

use bumpalo::Bump;

use crate::raster::{RasterError, each_pixel};

/// The colors of a picture: red, green, blue and opacity of each pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Colors<'a> {
    /// At most 256 colors, and the number of each pixel's color.
    Few { indices: &'a [u8], palette: &'a [[u8; 4]] },
    /// Red, green and blue of each pixel, and the opacity of each pixel if not all are opaque.
    Many { rgb: &'a [u8], alpha: Option<&'a [u8]> },
}

/// A picture whose colors are kept in an arena. A picture of a single color is one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Compact<'a> {
    pub(crate) width: u16,
    pub(crate) height: u16,
    pub(crate) colors: Colors<'a>,
}

impl<'a> Compact<'a> {
    /// Reads a PNG, JPEG or PPM file.
    ///
    /// # Errors
    /// The bytes are in another format, are broken, or hold too large an image.
    pub(crate) fn decode(arena: &'a Bump, bytes: &[u8]) -> Result<Self, RasterError> {
        let mut held = Held::default();
        let (width, height) = each_pixel(bytes, |pixel| held.add(pixel))?;
        if held.count() != usize::from(width) * usize::from(height) {
            return Err(RasterError::Broken("it has another number of pixels than it says".to_owned()));
        }
        if let ([color], None) = (&*held.palette, &held.many) {
            let colors = Colors::Few { indices: &[0], palette: arena.alloc_slice_copy(&[*color]) };
            return Ok(Self { width: 1, height: 1, colors });
        }
        Ok(Self { width, height, colors: held.colors(arena) })
    }

    /// The number of pixels.
    pub(crate) fn len(&self) -> usize {
        usize::from(self.width) * usize::from(self.height)
    }

    /// All colors, each with the number of pixels that have it. A color may come more than once.
    pub(crate) fn each(&self, mut visit: impl FnMut([u8; 4], usize)) {
        match self.colors {
            Colors::Few { indices, palette } => {
                let mut counts = [0usize; 256];
                for index in indices {
                    if let Some(count) = counts.get_mut(usize::from(*index)) {
                        *count += 1;
                    }
                }
                palette.iter().zip(counts).for_each(|(color, count)| visit(*color, count));
            }
            Colors::Many { .. } => self.pixels().for_each(|color| visit(color, 1)),
        }
    }

    /// The color of each pixel.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = [u8; 4]> {
        let (few, many) = match self.colors {
            Colors::Few { indices, palette } => {
                (Some(indices.iter().filter_map(|index| palette.get(usize::from(*index)).copied())), None)
            }
            Colors::Many { rgb, alpha } => {
                let colors = rgb.as_chunks::<3>().0.iter().enumerate().map(move |(pixel, [r, g, b])| {
                    let alpha = alpha.and_then(|alpha| alpha.get(pixel)).copied();
                    [*r, *g, *b, alpha.unwrap_or(u8::MAX)]
                });
                (None, Some(colors))
            }
        };
        few.into_iter().flatten().chain(many.into_iter().flatten())
    }
}

/// The pixels read so far. Nothing but their number is held as long as all have one color.
#[derive(Debug, Default)]
struct Held {
    /// The pixels before the first one of a second color.
    equal: usize,
    palette: Vec<[u8; 4]>,
    numbers: HashMap<[u8; 4], u8>,
    indices: Vec<u8>,
    /// The last color and its number.
    last: Option<([u8; 4], u8)>,
    /// Red, green and blue, and opacity, of all pixels, once there are more than 256 colors.
    many: Option<(Vec<u8>, Option<Vec<u8>>)>,
}

impl Held {
    fn add(&mut self, color: [u8; 4]) {
        if let Some(many) = &mut self.many {
            return append(many, color);
        }
        let number = match self.last {
            Some((last, number)) if last == color => number,
            _ => match self.number(color) {
                Some(number) => number,
                None => return self.widen(color),
            },
        };
        self.last = Some((color, number));
        if self.palette.len() == 1 {
            self.equal += 1;
        } else {
            if self.indices.is_empty() {
                self.indices = vec![0; self.equal];
            }
            self.indices.push(number);
        }
    }

    /// The number of a color in the palette; `None` if the palette is full.
    fn number(&mut self, color: [u8; 4]) -> Option<u8> {
        if let Some(number) = self.numbers.get(&color) {
            return Some(*number);
        }
        let number = u8::try_from(self.palette.len()).ok()?;
        self.palette.push(color);
        self.numbers.insert(color, number);
        Some(number)
    }

    /// Goes over to red, green and blue of each pixel.
    fn widen(&mut self, color: [u8; 4]) {
        let mut many = (Vec::new(), None);
        for index in core::mem::take(&mut self.indices) {
            append(&mut many, self.palette.get(usize::from(index)).copied().unwrap_or_default());
        }
        append(&mut many, color);
        self.many = Some(many);
    }

    fn count(&self) -> usize {
        match &self.many {
            Some((rgb, _)) => rgb.len() / 3,
            None => self.indices.len().max(self.equal),
        }
    }

    /// Keeps the colors in the arena.
    fn colors<'a>(mut self, arena: &'a Bump) -> Colors<'a> {
        // Small pictures are smaller without a palette.
        if self.many.is_none() && 3 * self.palette.len() + self.indices.len() >= 3 * self.indices.len() {
            let mut many = (Vec::new(), None);
            for index in &self.indices {
                append(&mut many, self.palette.get(usize::from(*index)).copied().unwrap_or_default());
            }
            self.many = Some(many);
        }
        match self.many {
            Some((rgb, alpha)) => Colors::Many {
                rgb: arena.alloc_slice_copy(&rgb),
                alpha: alpha.map(|alpha| &*arena.alloc_slice_copy(&alpha)),
            },
            None => Colors::Few {
                indices: arena.alloc_slice_copy(&self.indices),
                palette: arena.alloc_slice_copy(&self.palette),
            },
        }
    }
}

/// Appends a pixel to red, green and blue, and to the opacity if not all pixels are opaque.
fn append((rgb, alpha): &mut (Vec<u8>, Option<Vec<u8>>), [r, g, b, opacity]: [u8; 4]) {
    let before = rgb.len() / 3;
    rgb.extend([r, g, b]);
    if opacity != u8::MAX || alpha.is_some() {
        alpha.get_or_insert_with(|| vec![u8::MAX; before]).push(opacity);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::to_png;

    fn decoded(size: (u32, u32), pixels: &[[u8; 4]], look: impl FnOnce(Compact<'_>)) {
        let png = to_png(size, 4, pixels.as_flattened()).unwrap();
        let arena = Bump::new();
        let compact = Compact::decode(&arena, &png).unwrap();
        let is_one = pixels.iter().all(|pixel| Some(pixel) == pixels.first());
        assert!(is_one || compact.pixels().eq(pixels.iter().copied()));
        look(compact);
    }

    #[test]
    fn pictures_take_as_few_bytes_as_their_colors_need() {
        // One color: one pixel, and nothing held for the others.
        decoded((200, 100), &[[9, 8, 7, 200]; 20_000], |compact| {
            assert_eq!((compact.width, compact.height), (1, 1));
            assert_eq!(compact.colors, Colors::Few { indices: &[0], palette: &[[9, 8, 7, 200]] });
        });
        // Three colors: a byte a pixel.
        let stripes: Vec<_> = (0..900u32).map(|i| [(i % 3) as u8, 0, 0, 255]).collect();
        decoded((30, 30), &stripes, |compact| {
            let Colors::Few { indices, palette } = compact.colors else { unreachable!() };
            assert_eq!((indices.len(), palette.len()), (900, 3));
            let mut all = Vec::new();
            compact.each(|color, count| all.push((color[0], count)));
            assert_eq!(all, [(0, 300), (1, 300), (2, 300)]);
        });
        // 300 colors: three bytes a pixel, and a fourth one only with the first pixel that is not opaque.
        let many = |opacity| -> Vec<_> {
            (0..900u32)
                .map(|i| [(i % 20) as u8, (i / 20) as u8, 0, if i == 899 { opacity } else { 255 }])
                .collect()
        };
        decoded((30, 30), &many(255), |compact| {
            let Colors::Many { rgb, alpha } = compact.colors else { unreachable!() };
            assert_eq!((rgb.len(), alpha), (2700, None));
        });
        decoded((30, 30), &many(7), |compact| {
            let Colors::Many { alpha, .. } = compact.colors else { unreachable!() };
            assert_eq!(alpha.map(|alpha| (alpha.len(), alpha[898], alpha[899])), Some((900, 255, 7)));
        });
    }
}
