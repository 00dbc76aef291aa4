//! The same picture, rendered by this computer.

use anyhow::Result;
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::pixelcolor::{Gray4, PixelColor, Rgb565};
use embedded_graphics::prelude::{GrayColor, RgbColor};
use rayline::math::Fixed;
use rayline::{Digest, DisplayColor, PreparedScene, Real, Renderer};
use rayline_show::Orbit;

use crate::board::{Board, Emulator, Output};
use crate::picture::{Number, Picture, Size};

/// The bytes of a picture's pixels, line by line, as the board's emulator hands them out.
pub(crate) fn render(board: &Board, picture: &Picture) -> Result<Vec<u8>> {
    match (board.output, board.emulator) {
        (Output::Panel(_), _) => render_frame(picture, 0, Gray4::BLACK),
        (Output::Frames(panel), Emulator::Rp2040js { frames }) => {
            let mut bytes = Vec::new();
            for frame in 0..frames {
                bytes.extend(centered(&render_frame(picture, frame, Rgb565::BLACK)?, picture.size, panel));
            }
            Ok(bytes)
        }
        (Output::File | Output::Frames(_), _) => render_frame(picture, 0, Rgb565::BLACK),
    }
}

/// One number for these bytes.
pub(crate) fn digest(bytes: &[u8]) -> u64 {
    let mut digest = Digest::new();
    digest.update(bytes);
    digest.value()
}

/// A frame in the board's number system.
fn render_frame<C>(picture: &Picture, frame: u32, black: C) -> Result<Vec<u8>>
where
    C: DisplayColor + PixelColor + ToBytes<Bytes: AsRef<[u8]>>,
{
    match picture.number {
        Number::F32 => render_as::<f32, _>(picture, frame, black),
        Number::Fixed => render_as::<Fixed, _>(picture, frame, black),
    }
}

fn render_as<R: Real, C>(picture: &Picture, frame: u32, black: C) -> Result<Vec<u8>>
where
    C: DisplayColor + PixelColor + ToBytes<Bytes: AsRef<[u8]>>,
{
    let mut memory = vec![std::mem::MaybeUninit::uninit(); picture.scene.scene.bytes::<R>()];
    let mut scene = PreparedScene::<R, _>::new(picture.scene.scene, &mut memory)?;
    scene.set_camera(&Orbit::around(picture.scene.scene).camera(frame))?;
    let renderer = Renderer::new(&scene, picture.settings())?;
    let mut line = vec![black; usize::from(picture.size.width)];
    let mut bytes = Vec::new();
    for y in 0..u32::from(picture.size.height) {
        renderer.line(y, &mut line)?;
        for color in &line {
            bytes.extend_from_slice(color.to_le_bytes().as_ref());
        }
    }
    Ok(bytes)
}

/// A black panel with a picture of RGB565 in the middle.
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
