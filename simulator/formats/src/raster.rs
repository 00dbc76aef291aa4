//! Image files: PNG, JPEG and PPM in, PNG and PPM out.

use core::fmt;
use std::io::{self, Cursor};

use png::{BitDepth, ColorType, Transformations};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::files::MAX_PIXELS;

/// An image of pixels, line by line from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raster {
    /// Width in pixels, at most 65535.
    pub width: u32,
    /// Height in pixels, at most 65535.
    pub height: u32,
    /// Red, green, blue and opacity of each pixel.
    pub pixels: Vec<[u8; 4]>,
}

/// The reason why bytes are no image.
#[derive(Debug)]
#[non_exhaustive]
pub enum RasterError {
    /// They do not begin like a PNG, JPEG or PPM file. Convert the image to one of these formats.
    Format,
    /// The image has more than 65535 pixels a side, or more than [`MAX_PIXELS`]. Use a smaller one.
    Size,
    /// The image is broken, or in a form of its format that is not supported. The text says what is wrong.
    Broken(String),
}

/// The longest side.
const MOST_SIDE: usize = u16::MAX as usize;
/// The most bytes that a decoder may take.
const MOST_BYTES: usize = 1 << 29;
/// The most pixels of an image that is read piece by piece.
const MOST_PIXELS: usize = 1 << 28;

impl Raster {
    /// Reads a PNG, JPEG or PPM file.
    ///
    /// # Errors
    /// The bytes are in another format, are broken, or hold too large an image.
    pub fn decode(bytes: &[u8]) -> Result<Self, RasterError> {
        match bytes {
            [0x89, b'P', b'N', b'G', ..] => Self::of_png(bytes),
            [0xFF, 0xD8, 0xFF, ..] => Self::of_jpeg(bytes),
            [b'P', b'6', ..] => Self::of_ppm(bytes),
            _ => Err(RasterError::Format),
        }
    }

    /// Red, green and blue of each pixel.
    pub fn rgb(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect()
    }

    /// An image of so many `channels`: gray, gray and opacity, RGB, or RGB and opacity.
    fn of_channels(
        (width, height): (usize, usize),
        channels: usize,
        bytes: &[u8],
    ) -> Result<Self, RasterError> {
        let pixels: Vec<[u8; 4]> = match channels {
            1 => bytes.iter().map(|gray| [*gray, *gray, *gray, u8::MAX]).collect(),
            2 => bytes.as_chunks().0.iter().map(|[gray, alpha]| [*gray, *gray, *gray, *alpha]).collect(),
            3 => bytes.as_chunks().0.iter().map(|[r, g, b]| [*r, *g, *b, u8::MAX]).collect(),
            _ => bytes.as_chunks().0.to_vec(),
        };
        if width.checked_mul(height) != Some(pixels.len()) {
            return Err(RasterError::Broken("it has another number of pixels than it says".to_owned()));
        }
        Ok(Self { width: width as u32, height: height as u32, pixels })
    }

    fn of_png(bytes: &[u8]) -> Result<Self, RasterError> {
        let mut reader = png_reader(bytes)?;
        let size = (reader.info().width as usize, reader.info().height as usize);
        check(size)?;
        let mut pixels = room_for(&reader)?;
        let info = reader.next_frame(&mut pixels).map_err(broken)?;
        Self::of_channels(size, info.color_type.samples(), &pixels)
    }

    fn of_jpeg(bytes: &[u8]) -> Result<Self, RasterError> {
        let options = DecoderOptions::default().set_max_width(MOST_SIDE).set_max_height(MOST_SIDE);
        let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
        decoder.decode_headers().map_err(broken)?;
        let size = decoder.dimensions().ok_or(RasterError::Size)?;
        check(size)?;
        let pixels = decoder.decode().map_err(broken)?;
        let channels = pixels.len().checked_div(size.0 * size.1).unwrap_or(0);
        Self::of_channels(size, channels, &pixels)
    }

    /// Binary PPM of 8 bits: `P6`, width, height and 255, then the pixels.
    fn of_ppm(bytes: &[u8]) -> Result<Self, RasterError> {
        let mut rest = bytes.get(2..).unwrap_or_default();
        let mut numbers = [0usize; 3];
        for number in &mut numbers {
            rest = rest.trim_ascii_start();
            while let [b'#', comment @ ..] = rest {
                let end = comment.iter().position(|byte| *byte == b'\n').unwrap_or(comment.len());
                rest = comment.get(end..).unwrap_or_default().trim_ascii_start();
            }
            let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
            let (text, behind) = rest.split_at(digits);
            let parsed = core::str::from_utf8(text).ok().and_then(|text| text.parse().ok());
            *number = parsed.ok_or_else(|| broken("a number is missing in the header"))?;
            rest = behind;
        }
        let [width, height, most] = numbers;
        check((width, height))?;
        if most != 255 {
            return Err(broken(format!("its largest value is {most}, not 255")));
        }
        // One space or line end follows the header.
        let pixels = rest.get(1..).and_then(|pixels| pixels.get(..width * height * 3));
        let pixels = pixels.ok_or_else(|| broken("it ends before the last pixel"))?;
        Self::of_channels((width, height), 3, pixels)
    }
}

/// A reader of a PNG file, whose pixels have 8 bits in each channel.
fn png_reader(bytes: &[u8]) -> Result<png::Reader<Cursor<&[u8]>>, RasterError> {
    let limits = png::Limits { bytes: MOST_BYTES };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(Transformations::normalize_to_color8());
    decoder.read_info().map_err(broken)
}

/// Room for the pixels of a PNG file.
fn room_for(reader: &png::Reader<Cursor<&[u8]>>) -> Result<Vec<u8>, RasterError> {
    let length = reader.output_buffer_size();
    if length <= MOST_BYTES { Ok(vec![0; length]) } else { Err(RasterError::Size) }
}

/// Reads an image piece by piece, from the top: red, green, blue and opacity of each pixel. A PNG file that
/// is not interlaced is never held as a whole. The result is width and height.
///
/// # Errors
/// The errors of [`Raster::decode`].
pub(crate) fn each_pixel(bytes: &[u8], mut visit: impl FnMut([u8; 4])) -> Result<(u16, u16), RasterError> {
    if bytes.starts_with(&[0x89, b'P', b'N', b'G']) {
        let mut reader = png_reader(bytes)?;
        let info = reader.info();
        let (width, height, interlaced) = (info.width as usize, info.height as usize, info.interlaced);
        if !interlaced {
            if width > MOST_SIDE || height > MOST_SIDE || width * height > MOST_PIXELS {
                return Err(RasterError::Size);
            }
            let channels = reader.output_color_type().0.samples();
            while let Some(row) = reader.next_row().map_err(broken)? {
                row.data().chunks_exact(channels).map(rgba).for_each(&mut visit);
            }
            return Ok((width as u16, height as u16));
        }
    }
    let Raster { width, height, pixels } = Raster::decode(bytes)?;
    pixels.into_iter().for_each(visit);
    Ok((width as u16, height as u16))
}

/// Red, green, blue and opacity of a pixel of 1 to 4 channels.
fn rgba(channels: &[u8]) -> [u8; 4] {
    match *channels {
        [gray] => [gray, gray, gray, u8::MAX],
        [gray, alpha] => [gray, gray, gray, alpha],
        [r, g, b] => [r, g, b, u8::MAX],
        [r, g, b, alpha, ..] => [r, g, b, alpha],
        [] => [0; 4],
    }
}

/// Refuses images that are too large.
fn check((width, height): (usize, usize)) -> Result<(), RasterError> {
    let is_small = width <= MOST_SIDE && height <= MOST_SIDE && width * height <= MAX_PIXELS;
    if is_small { Ok(()) } else { Err(RasterError::Size) }
}

fn broken(reason: impl ToString) -> RasterError {
    RasterError::Broken(reason.to_string())
}

/// The bytes of a PNG file of an image with 3 channels, or with 4, in 8 bits.
///
/// # Errors
/// The image has no pixels, or another number of them.
pub fn to_png((width, height): (u32, u32), channels: usize, pixels: &[u8]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(if channels == 3 { ColorType::Rgb } else { ColorType::Rgba });
    encoder.set_depth(BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}

/// The bytes of a PNG file with a palette: of 4 bits a pixel, two of them in a byte, or of 8.
///
/// # Errors
/// The image has no pixels or no colors, or another number of pixels.
pub(crate) fn to_indexed_png(
    (width, height): (u32, u32),
    depth: BitDepth,
    indices: &[u8],
    palette: &[[u8; 3]],
) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(depth);
    let most = if depth == BitDepth::Four { 16 } else { 256 };
    encoder.set_palette(palette.iter().take(most).flatten().copied().collect::<Vec<_>>());
    let mut writer = encoder.write_header()?;
    writer.write_image_data(indices)?;
    writer.finish()?;
    Ok(bytes)
}

/// An image whose pixels are numbers of colors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Indexed {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// 4 bits a pixel, two of them in a byte, or 8.
    pub depth: BitDepth,
    /// The number of each pixel's color.
    pub indices: Vec<u8>,
    /// Red, green and blue of each color.
    pub palette: Vec<[u8; 3]>,
}

impl Indexed {
    /// Reads a PNG file with a palette of 16 or 256 colors; `None` for all others.
    pub fn decode(bytes: &[u8]) -> Option<Self> {
        let limits = png::Limits { bytes: MOST_BYTES };
        let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
        decoder.set_transformations(Transformations::IDENTITY);
        let mut reader = decoder.read_info().ok()?;
        let info = reader.info();
        let (width, height, depth) = (info.width, info.height, info.bit_depth);
        let is_known = matches!(depth, BitDepth::Four | BitDepth::Eight);
        if info.color_type != ColorType::Indexed || !is_known || info.trns.is_some() {
            return None;
        }
        check((width as usize, height as usize)).ok()?;
        let palette = info.palette.as_ref()?.as_chunks::<3>().0.to_vec();
        let mut indices = room_for(&reader).ok()?;
        reader.next_frame(&mut indices).ok()?;
        Some(Self { width, height, depth, indices, palette })
    }
}

/// The bytes of a binary PPM file of an RGB image.
pub fn to_ppm((width, height): (u32, u32), rgb: &[u8]) -> Vec<u8> {
    let mut bytes = format!("P6\n{width} {height}\n255\n").into_bytes();
    bytes.extend_from_slice(rgb);
    bytes
}

/// An RGB image, made smaller: each pixel is the mean of those that it covers.
pub fn shrunk(rgb: &[u8], (width, height): (u32, u32), (across, down): (u32, u32)) -> Vec<[u8; 3]> {
    let (width, height) = (u64::from(width), u64::from(height));
    let part = |index: u32, parts: u32, all: u64| {
        let start = u64::from(index) * all / u64::from(parts);
        start..(u64::from(index + 1) * all / u64::from(parts)).max(start + 1)
    };
    let mut pixels = Vec::new();
    for (y, x) in (0..down).flat_map(|y| (0..across).map(move |x| (y, x))) {
        let (mut sums, mut count) = ([0u64; 3], 0u64);
        for (row, column) in
            part(y, down, height).flat_map(|row| part(x, across, width).map(move |column| (row, column)))
        {
            let place = (row * width + column) as usize * 3;
            let pixel =
                rgb.get(place..).and_then(|rest| rest.first_chunk::<3>()).copied().unwrap_or_default();
            for (sum, code) in sums.iter_mut().zip(pixel) {
                *sum += u64::from(code);
            }
            count += 1;
        }
        pixels.push(sums.map(|sum| (sum / count.max(1)) as u8));
    }
    pixels
}

impl fmt::Display for RasterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Format => f.write_str("it is no PNG, JPEG or PPM file; convert it to one of them"),
            Self::Size => {
                write!(f, "it is too large; use at most {MOST_SIDE} pixels a side and {MAX_PIXELS} in all")
            }
            Self::Broken(reason) => f.write_str(reason),
        }
    }
}

impl core::error::Error for RasterError {}

#[cfg(test)]
mod tests {
    use super::*;

    const RGB: [u8; 12] = [255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 8, 7];

    #[test]
    fn what_is_written_is_read() {
        for bytes in [to_png((2, 2), 3, &RGB).unwrap(), to_ppm((2, 2), &RGB)] {
            let image = Raster::decode(&bytes).unwrap();
            assert_eq!((image.width, image.height, image.rgb()), (2, 2, RGB.to_vec()));
            assert!(image.pixels.iter().all(|pixel| pixel[3] == 255));
        }
        let clear = [1, 2, 3, 0, 4, 5, 6, 128];
        let image = Raster::decode(&to_png((1, 2), 4, &clear).unwrap()).unwrap();
        assert_eq!(image.pixels, [[1, 2, 3, 0], [4, 5, 6, 128]]);
        assert!(to_png((2, 2), 3, &RGB[..3]).is_err());
    }

    #[test]
    fn palettes_are_kept() {
        let palette = vec![[1, 2, 3], [4, 5, 6], [7, 8, 9]];
        for (depth, indices) in
            [(BitDepth::Eight, vec![2, 0, 1, 1, 2, 0]), (BitDepth::Four, vec![0x20, 0x10, 0x12, 0])]
        {
            let bytes = to_indexed_png((3, 2), depth, &indices, &palette).unwrap();
            let image = Indexed { width: 3, height: 2, depth, indices, palette: palette.clone() };
            assert_eq!(Indexed::decode(&bytes), Some(image));
            let colors = [[7, 8, 9], [1, 2, 3], [4, 5, 6], [4, 5, 6], [7, 8, 9], [1, 2, 3]];
            assert_eq!(Raster::decode(&bytes).unwrap().rgb().as_chunks::<3>().0, colors);
        }
        assert_eq!(Indexed::decode(&to_png((2, 2), 3, &RGB).unwrap()), None);
    }

    #[test]
    fn headers_of_ppm_may_have_comments() {
        let bytes = b"P6 # by hand\n1 # wide\n 1\n255\n\x01\x02\x03";
        assert_eq!(Raster::decode(bytes).unwrap().pixels, [[1, 2, 3, 255]]);
    }

    #[test]
    fn broken_images_are_refused() {
        let told = |bytes: &[u8]| Raster::decode(bytes).unwrap_err().to_string();
        assert_eq!(told(b"GIF89a"), "it is no PNG, JPEG or PPM file; convert it to one of them");
        assert_eq!(told(b""), told(b"GIF89a"));
        assert_eq!(told(b"P6 2 2 255 abc"), "it ends before the last pixel");
        assert_eq!(told(b"P6 2 x"), "a number is missing in the header");
        assert_eq!(told(b"P6 1 1 65535 ab"), "its largest value is 65535, not 255");
        assert!(told(b"P6 99999 1 255 a").starts_with("it is too large"));
        let png = to_png((2, 2), 3, &RGB).unwrap();
        for length in 8..png.len() - 12 {
            assert!(Raster::decode(&png[..length]).is_err(), "{length}");
        }
        assert!(Raster::decode(&[0xFF, 0xD8, 0xFF, 0xE0]).is_err());
    }

    #[test]
    fn shrunk_images_have_the_mean() {
        assert_eq!(shrunk(&RGB, (2, 2), (1, 1)), [[66, 65, 65]]);
        assert_eq!(shrunk(&RGB, (2, 2), (2, 1)), [[127, 0, 127], [4, 131, 3]]);
        assert_eq!(shrunk(&RGB, (2, 2), (2, 2)).as_flattened(), RGB);
    }
}
