//! Images as textures.

use super::gradient::Ends;
use super::pixels::{Encoding, Pixels};
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::math::{LatticeCoordinate, Linear, Real, Vec3};

/// An image. Its width is one unit along the pattern's x axis, its height one unit along y, upward. It is
/// constant along z.
///
/// ```
/// use rayline::{Encoding, Ends, Figure, Filter, Image, Pixels, Placed, Placement, Texture};
/// /// Two pixels wide, one high.
/// static FLAG: Image = Image {
///     width: 2,
///     height: 1,
///     pixels: Pixels::Rgb565(&[0xF800, 0x001F]),
///     encoding: Encoding::Srgb,
///     filter: Filter::Nearest,
///     ends: Ends::Repeat,
/// };
/// static PLACED: Placed = Placed::new(Figure::Image(FLAG), Placement::SURFACE);
/// let _texture = Texture::Placed(&PLACED);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Image<'a> {
    /// The width in pixels, 1 or more.
    pub width: u16,
    /// The height in pixels, 1 or more.
    pub height: u16,
    /// The pixels: as many as width times height.
    pub pixels: Pixels<'a>,
    /// The encoding of light in the numbers of the pixels.
    pub encoding: Encoding,
    /// The interpolation between the centers of pixels.
    pub filter: Filter,
    /// The continuation beyond the edges.
    pub ends: Ends,
}

#[cfg(feature = "serde")]
mod reading {
    use serde::de::{Deserializer, Error, MapAccess, SeqAccess};

    use super::{Encoding, Ends, Filter, Image};
    use crate::read::{Fields, Read, Reader, next_field, next_value, read_fields, set_field};

    /// An image may be named. Where the name stands in the field `file`, it gives the fields that are left
    /// out.
    impl<'m> Fields<'m> for Image<'m> {
        const NAME: &'static str = "Image";
        const FIELDS: &'static [&'static str] =
            &["width", "height", "pixels", "encoding", "filter", "ends", "file"];
        const MAY_BE_NAMED: bool = true;

        fn from_values<A: SeqAccess<'m>>(mut values: A, reader: &mut Reader<'m>) -> Result<Self, A::Error> {
            Ok(Self {
                width: next_value(&mut values, reader, "width")?,
                height: next_value(&mut values, reader, "height")?,
                pixels: next_value(&mut values, reader, "pixels")?,
                encoding: next_value(&mut values, reader, "encoding")?,
                filter: next_value(&mut values, reader, "filter")?,
                ends: next_value(&mut values, reader, "ends")?,
            })
        }

        fn from_map<A: MapAccess<'m>>(mut map: A, reader: &mut Reader<'m>) -> Result<Self, A::Error> {
            let (mut width, mut height, mut pixels) = (None, None, None);
            let (mut encoding, mut filter, mut ends) = (None, None, None);
            let mut file: Option<Self> = None;
            while let Some(name) = next_field(&mut map, Self::FIELDS)? {
                match name {
                    "width" => set_field(&mut width, &mut map, reader, name)?,
                    "height" => set_field(&mut height, &mut map, reader, name)?,
                    "pixels" => set_field(&mut pixels, &mut map, reader, name)?,
                    "encoding" => set_field(&mut encoding, &mut map, reader, name)?,
                    "filter" => set_field(&mut filter, &mut map, reader, name)?,
                    "ends" => set_field(&mut ends, &mut map, reader, name)?,
                    _ => set_field(&mut file, &mut map, reader, name)?,
                }
            }
            let missing = A::Error::missing_field;
            Ok(Self {
                width: width.or(file.map(|file| file.width)).ok_or_else(|| missing("width"))?,
                height: height.or(file.map(|file| file.height)).ok_or_else(|| missing("height"))?,
                pixels: pixels.or(file.map(|file| file.pixels)).ok_or_else(|| missing("pixels"))?,
                encoding: encoding.or(file.map(|file| file.encoding)).unwrap_or(Encoding::Srgb),
                filter: filter.or(file.map(|file| file.filter)).unwrap_or(Filter::Nearest),
                ends: ends.or(file.map(|file| file.ends)).unwrap_or(Ends::Repeat),
            })
        }
    }

    impl<'m> Read<'m> for Image<'m> {
        fn read<D: Deserializer<'m>>(from: D, reader: &mut Reader<'m>) -> Result<Self, D::Error> {
            read_fields(from, reader)
        }
    }
}

/// The interpolation between the centers of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Filter {
    /// None: the color of the nearest pixel.
    #[default]
    Nearest,
    /// Bilinear, of the four nearest pixels in linear light.
    Bilinear,
}

impl<'a> Image<'a> {
    /// The linear light of the pixel in this column and line, counted from the upper left corner; black
    /// outside of the image.
    pub fn light(&self, column: u16, line: u16) -> LinearRgb {
        let Self { width, height, pixels, encoding, .. } = *self;
        if column < width && line < height {
            pixels.light(encoding, width, column, line)
        } else {
            LinearRgb::gray(0.0)
        }
    }

    pub(super) fn prepare<R: Real>(&self) -> Result<PreparedImage<'a, R>, Fault> {
        self.prepare_with(self.ends.axes())
    }

    /// Prepares the image of a panorama, which repeats horizontally and is clamped vertically.
    pub(crate) fn prepare_around<R: Real>(&self) -> Result<PreparedImage<'a, R>, Fault> {
        self.prepare_with([Ends::Repeat, Ends::Extend])
    }

    fn prepare_with<R: Real>(&self, ends: [Ends; 2]) -> Result<PreparedImage<'a, R>, Fault> {
        self.pixels.check(self.width, self.height)?;
        let half = R::Setup::from_f32(match self.filter {
            Filter::Nearest => 0.0,
            Filter::Bilinear => 0.5,
        });
        let counts = [self.width, self.height].map(|pixels| R::Setup::from_f32(f32::from(pixels)));
        let (none, [columns, lines]) = (R::Setup::ZERO, counts);
        Ok(PreparedImage {
            image: *self,
            ends,
            column: R::Linear::new(Vec3::new(columns, none, none), Vec3::new(half / columns, none, none)),
            line: R::Linear::new(Vec3::new(none, lines, none), Vec3::new(none, half / lines, none)),
        })
    }
}

/// An [`Image`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedImage<'m, R: Real> {
    image: Image<'m>,
    /// The continuation beyond the left and right edges, and beyond the upper and lower ones.
    ends: [Ends; 2],
    /// Maps x from 0 to 1 to a column. `line` maps y from 0 to 1 to a line, counted from below.
    column: R::Linear,
    line: R::Linear,
}

impl<R: Real> PreparedImage<'_, R> {
    pub(super) fn color(&self, [x, y, _]: [LatticeCoordinate<R>; 3]) -> LinearRgb<R> {
        let [across, up] = self.ends;
        self.at(across.fold(x), up.fold(y))
    }

    /// The color at a position from (0, 0) at the lower left to (1, 1).
    pub(crate) fn at(&self, x: R, y: R) -> LinearRgb<R> {
        let (column, line) = self.cells(x, y);
        match self.image.filter {
            Filter::Nearest => self.nearest_pixel(column.index, line.index),
            Filter::Bilinear => {
                let left = self.continued_column(column.index);
                let right = self.continued_column(column.index.wrapping_add(1));
                let in_line = |line: i32| {
                    let line = self.continued_line(line);
                    between(self.light(left, line), self.light(right, line), column.within)
                };
                between(in_line(line.index), in_line(line.index.wrapping_add(1)), line.within)
            }
        }
    }

    /// The column and the line, counted from below, of a position from 0 to 1.
    #[inline]
    fn cells(&self, x: R, y: R) -> (LatticeCoordinate<R>, LatticeCoordinate<R>) {
        let place = Vec3::new(x, y, R::ZERO);
        (self.column.split_at(place), self.line.split_at(place))
    }

    /// Whether the color jumps at the edges of pixels.
    pub(super) fn has_steps(&self) -> bool {
        self.image.filter == Filter::Nearest
    }

    /// Three numbers that identify a pixel of an image that [has steps](Self::has_steps), if the pixel
    /// differs from a neighbor: its column and line, each combined with the number of the repeated copy of
    /// the image. All pixels that are like their neighbors share `[0; 3]`, because a change of pixel inside
    /// of a smooth area is not an edge.
    pub(super) fn step(&self, [x, y, _]: [LatticeCoordinate<R>; 3]) -> [i32; 3] {
        let [across, up] = self.ends;
        let (column, line) = self.cells(across.fold(x), up.fold(y));
        let (column, line) = (column.index, line.index);
        let levels = |light: LinearRgb<R>| [light.r, light.g, light.b].map(R::to_q16);
        let here = levels(self.nearest_pixel(column, line));
        let differs = |right: i32, up: i32| {
            let beside = levels(self.continued_pixel(column.wrapping_add(right), line.wrapping_add(up)));
            // Colors differ if a channel differs by more than 1/16, the step of `level_mark`.
            here.into_iter().zip(beside).any(|(here, beside)| here.abs_diff(beside) > 1 << 12)
        };
        if differs(-1, 0) || differs(1, 0) || differs(0, -1) || differs(0, 1) {
            let copy = |at: LatticeCoordinate<R>, ends| if ends == Ends::Extend { 0 } else { at.index << 16 };
            [column ^ copy(x, across), line ^ copy(y, up), 1]
        } else {
            [0; 3]
        }
    }

    /// The color of the pixel at a position. A position exactly on the far edge belongs to the last pixel.
    fn nearest_pixel(&self, column: i32, line: i32) -> LinearRgb<R> {
        let nearest = |at: i32, count: u16| at.min(i32::from(count).wrapping_sub(1));
        self.light(nearest(column, self.image.width), nearest(line, self.image.height))
    }

    /// The color of a pixel of the image or one beyond its edge, where [`Ends`] says how the image goes on.
    fn continued_pixel(&self, column: i32, line: i32) -> LinearRgb<R> {
        self.light(self.continued_column(column), self.continued_line(line))
    }

    fn continued_column(&self, column: i32) -> i32 {
        let [across, _] = self.ends;
        continued(column, self.image.width, across)
    }

    fn continued_line(&self, line: i32) -> i32 {
        let [_, up] = self.ends;
        continued(line, self.image.height, up)
    }

    /// The color of a pixel inside of the image, by its column and its line, counted from below.
    fn light(&self, column: i32, line: i32) -> LinearRgb<R> {
        let Image { width, height, pixels, encoding, .. } = self.image;
        let line = i32::from(height).wrapping_sub(1).wrapping_sub(line);
        pixels.light(encoding, width, column as u16, line as u16)
    }
}

/// The pixel of `count` that stands at a place, which may be one pixel beyond an edge.
fn continued(at: i32, count: u16, ends: Ends) -> i32 {
    let last = i32::from(count).wrapping_sub(1);
    match ends {
        Ends::Repeat if at < 0 => last,
        Ends::Repeat if at > last => 0,
        _ => at.max(0).min(last),
    }
}

/// The color at a share, below 1, of the way between two, with half the products of
/// [`blend`](super::blend).
fn between<R: Real>(from: LinearRgb<R>, to: LinearRgb<R>, share: R) -> LinearRgb<R> {
    let channel = |from: R, to: R| from + (to - from) * share;
    LinearRgb::new(channel(from.r, to.r), channel(from.g, to.g), channel(from.b, to.b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    const RED: [u8; 3] = [255, 0, 0];
    const BLUE: [u8; 3] = [0, 0, 255];
    /// Red and blue above, blue and black below.
    const IMAGE: Image = Image {
        width: 2,
        height: 2,
        pixels: Pixels::Rgb888(&[255, 0, 0, 0, 0, 255, 0, 0, 255, 0, 0, 0]),
        encoding: Encoding::Linear,
        filter: Filter::Nearest,
        ends: Ends::Repeat,
    };

    fn at<R: Real>(image: Image<'_>, x: f32, y: f32) -> [f32; 3] {
        let prepared = image.prepare::<R>().unwrap();
        let color = prepared.color([x, y, 0.0].map(|value| R::from_f32(value).split())).to_f32();
        [color.r, color.g, color.b]
    }

    #[test]
    fn pixels_lie_upright_in_all_formats() {
        let formats = [
            IMAGE.pixels,
            Pixels::Rgb565(&[0xF800, 0x001F, 0x001F, 0]),
            Pixels::Palette8 { indices: &[2, 1, 1, 0], palette: &[[0; 3], BLUE, RED] },
            Pixels::Palette4 { indices: &[0x21, 0x10], palette: &[[0; 3], BLUE, RED] },
        ];
        for pixels in formats {
            for encoding in [Encoding::Srgb, Encoding::Linear] {
                let image = Image { pixels, encoding, ..IMAGE };
                for (x, y, color) in [
                    (0.25, 0.75, [1.0, 0.0, 0.0]),
                    (0.75, 0.75, [0.0, 0.0, 1.0]),
                    (0.25, 0.25, [0.0, 0.0, 1.0]),
                    (0.75, 0.25, [0.0; 3]),
                    (-0.75, 1.75, [1.0, 0.0, 0.0]),
                    (0.0, 0.5, [1.0, 0.0, 0.0]),
                ] {
                    assert_eq!(at::<f32>(image, x, y), color, "{pixels:?} at {x}, {y}");
                    assert_eq!(at::<f64>(image, x, y), color);
                    assert_eq!(at::<Fixed>(image, x, y), color);
                }
            }
        }
    }

    #[test]
    fn bilinear_blends_and_wraps() {
        let image = Image { filter: Filter::Bilinear, ..IMAGE };
        for (ends, x, y, color) in [
            (Ends::Repeat, 0.25, 0.75, [1.0, 0.0, 0.0]),
            (Ends::Repeat, 0.5, 0.75, [0.5, 0.0, 0.5]),
            (Ends::Repeat, 0.5, 0.5, [0.25, 0.0, 0.5]),
            // Blended half and half with the edge on the other side.
            (Ends::Repeat, 0.0, 0.75, [0.5, 0.0, 0.5]),
            (Ends::Extend, 0.0, 0.75, [1.0, 0.0, 0.0]),
            (Ends::Extend, 7.0, 9.0, [0.0, 0.0, 1.0]),
            (Ends::Mirror, 1.0, 0.75, [0.0, 0.0, 1.0]),
            (Ends::Mirror, 1.75, 0.75, [1.0, 0.0, 0.0]),
            // Each axis has its own continuation.
            (Ends::RepeatExtend, 3.25, 9.0, [1.0, 0.0, 0.0]),
            (Ends::RepeatExtend, 1.25, -3.0, [0.0, 0.0, 1.0]),
            (Ends::ExtendMirror, -4.0, 1.25, [1.0, 0.0, 0.0]),
            (Ends::ExtendMirror, 4.0, 1.75, [0.0, 0.0, 0.0]),
        ] {
            let image = Image { ends, ..image };
            for got in [at::<f32>(image, x, y), at::<f64>(image, x, y), at::<Fixed>(image, x, y)] {
                let same = got.iter().zip(color).all(|(a, b)| (a - b).abs() < 1e-6);
                assert!(same, "{got:?}, not {color:?}, at {x}, {y} of {ends:?}");
            }
        }
    }

    #[test]
    fn codes_are_decoded() {
        let gray = Image { width: 1, height: 1, pixels: Pixels::Rgb888(&[188, 188, 188]), ..IMAGE };
        assert!((at::<f32>(Image { encoding: Encoding::Srgb, ..gray }, 0.5, 0.5)[0] - 0.5029).abs() < 1e-4);
        assert!((at::<Fixed>(gray, 0.5, 0.5)[0] - 188.0 / 255.0).abs() < 2e-5);
    }

    #[test]
    fn bad_images_are_refused() {
        let refusal = |image: Image<'_>| image.prepare::<f32>().err();
        assert_eq!(refusal(Image { width: 3, ..IMAGE }), Some(Fault::PixelCount { needed: 18, given: 12 }));
        let none = Image { width: 0, pixels: Pixels::Rgb565(&[]), ..IMAGE };
        assert_eq!(refusal(none), Some(Fault::PixelCount { needed: 0, given: 0 }));
        let pixels = Pixels::Palette8 { indices: &[0, 1, 2, 0], palette: &[RED, BLUE] };
        assert_eq!(refusal(Image { pixels, ..IMAGE }), Some(Fault::PaletteColor { named: 2, colors: 2 }));
        let pixels = Pixels::Palette4 { indices: &[0x10, 0x03], palette: &[RED, BLUE] };
        assert_eq!(refusal(Image { pixels, ..IMAGE }), Some(Fault::PaletteColor { named: 3, colors: 2 }));
    }
}
