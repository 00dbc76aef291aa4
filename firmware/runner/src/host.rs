//! This computer's pictures, which the boards' are compared with.

use anyhow::{Context, Result};
use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Size as Dimensions};
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::pixelcolor::{Gray4, PixelColor, Rgb565};
use embedded_graphics::prelude::{GrayColor, RgbColor};
use rayline::limits::MAX_PREVIEW_FACETS;
use rayline::math::Fixed;
use rayline::{
    Digest, DisplayColor, PreparedScene, Preview, PreviewFacet, PreviewPixel, RayCounts, Real, Renderer,
    Sample,
};
use rayline_orbit::Orbit;

use crate::board::{Board, EmulatorKind, Output};
use crate::picture::{Mode, Number, Picture, Size};

/// The bytes of a picture's pixels, line by line, as the board's emulator writes them.
pub(crate) fn render(board: &Board, picture: &Picture) -> Result<Vec<u8>> {
    match (board.output, board.emulator) {
        (Output::Panel(_), _) => bytes_of_frame(picture, 0, Gray4::BLACK),
        (Output::Frames(panel), EmulatorKind::Rp2040js { frames }) => {
            let mut bytes = Vec::new();
            for frame in 0..frames {
                bytes.extend(centered(&bytes_of_frame(picture, frame, Rgb565::BLACK)?, picture.size, panel));
            }
            Ok(bytes)
        }
        (Output::File | Output::Frames(_), _) => bytes_of_frame(picture, 0, Rgb565::BLACK),
    }
}

/// The digest of bytes.
pub(crate) fn digest(bytes: &[u8]) -> u64 {
    let mut digest = Digest::new();
    digest.update(bytes);
    digest.value()
}

/// The bytes of a frame, in the picture's number system and mode.
pub(crate) fn bytes_of_frame<C>(picture: &Picture, frame: u32, black: C) -> Result<Vec<u8>>
where
    C: DisplayColor + PixelColor + ToBytes<Bytes: AsRef<[u8]>>,
{
    let canvas = match picture.number {
        Number::F32 => render_frame::<f32, _>(picture, frame, black)?,
        Number::Fixed => render_frame::<Fixed, _>(picture, frame, black)?,
    };
    Ok(canvas.colors.iter().flat_map(|color| color.to_le_bytes().as_ref().to_vec()).collect())
}

/// The digest of arithmetic, which a board reports before it draws a gallery.
pub(crate) fn digest_of_numbers(number: Number) -> u64 {
    match number {
        Number::F32 => rayline_arithmetic_digest::digest::<f32>(),
        Number::Fixed => rayline_arithmetic_digest::digest::<Fixed>(),
    }
}

/// A frame in the picture's mode, in any number system.
pub(crate) fn render_frame<R: Real, C: DisplayColor>(
    picture: &Picture,
    frame: u32,
    black: C,
) -> Result<Canvas<C>> {
    let mut memory = vec![std::mem::MaybeUninit::uninit(); picture.scene.scene.bytes::<R>()];
    let mut scene = PreparedScene::<R, _>::new(picture.scene.scene, &mut memory)?;
    scene.set_camera(&Orbit::around(picture.scene.scene).camera(frame))?;
    let renderer = Renderer::new(&scene, picture.settings())?;
    let mut canvas = Canvas { size: picture.size, colors: Vec::new(), rays: 0 };
    let mut counts = RayCounts::default();
    match picture.quality() {
        None if picture.mode == Mode::Preview => {
            let mut facets = vec![PreviewFacet::BLANK; MAX_PREVIEW_FACETS];
            let mut preview = Preview::new(&renderer, rayline_build_support::SEGMENTS, &mut facets)?;
            let width = usize::from(picture.size.width);
            let (mut line, mut pixels) = (vec![black; width], vec![PreviewPixel::BLANK; width]);
            let drawn = renderer.draw(&mut canvas, preview.lend(&mut line, &mut pixels));
            drawn.ok().context("the preview")?;
        }
        None => {
            let mut line = vec![black; usize::from(picture.size.width)];
            for y in 0..renderer.height() {
                renderer.lines(y, &mut line, &mut counts)?;
                canvas.colors.extend_from_slice(&line);
            }
        }
        Some(quality) => {
            let mut colors = vec![black; quality.colors(picture.size.width)];
            let mut samples = vec![Sample::BLANK; quality.samples(picture.size.width)];
            let mut frame = renderer.frame(0..renderer.height(), quality.lend(&mut colors, &mut samples))?;
            while !frame
                .step_watched(&mut canvas, u32::MAX, &mut counts)
                .ok()
                .context("the realtime picture")?
                .is_done()
            {}
        }
    }
    canvas.rays = counts.total();
    Ok(canvas)
}

/// A picture that is drawn from left to right and from top to bottom.
#[derive(Debug)]
pub(crate) struct Canvas<C> {
    size: Size,
    /// The pixels that were drawn.
    pub(crate) colors: Vec<C>,
    /// Number of rays that were traced.
    pub(crate) rays: u64,
}

impl<C> OriginDimensions for Canvas<C> {
    fn size(&self) -> Dimensions {
        Dimensions::new(self.size.width.into(), self.size.height.into())
    }
}

impl<C: PixelColor> DrawTarget for Canvas<C> {
    type Color = C;
    type Error = std::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        self.colors.extend(pixels.into_iter().map(|Pixel(_, color)| color));
        Ok(())
    }
}

/// The bytes of a black panel with a picture in the middle, as RGB565.
fn centered(picture: &[u8], size: Size, panel: Size) -> Vec<u8> {
    let (width, height) = (usize::from(panel.width), usize::from(panel.height));
    let left = (width - usize::from(size.width)) / 2;
    let top = (height - usize::from(size.height)) / 2;
    let mut bytes = vec![0; 2 * panel.pixels()];
    let lines = bytes.chunks_exact_mut(2 * width).skip(top);
    for (to, from) in lines.zip(picture.chunks_exact(2 * usize::from(size.width))) {
        for (to, from) in to.iter_mut().skip(2 * left).zip(from) {
            *to = *from;
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_is_in_the_middle_of_the_panel() {
        let (size, panel) = (Size { width: 1, height: 1 }, Size { width: 4, height: 3 });
        let mut expected = [0; 24];
        (expected[10], expected[11]) = (0xAB, 0xCD);
        assert_eq!(centered(&[0xAB, 0xCD], size, panel), expected);
    }
}
