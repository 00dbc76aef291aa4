//! The same picture, rendered by this computer.

use anyhow::Result;
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::pixelcolor::{Gray4, PixelColor, Rgb565};
use embedded_graphics::prelude::{GrayColor, RgbColor};
use rayline::{Digest, DisplayColor, PreparedScene, Renderer};

use crate::board::Output;
use crate::picture::Picture;

/// The bytes of a picture's pixels, line by line, as the board hands them out.
pub(crate) fn render(picture: &Picture, output: Output) -> Result<Vec<u8>> {
    match output {
        Output::File => render_as(picture, Rgb565::BLACK),
        Output::Panel(_) => render_as(picture, Gray4::BLACK),
    }
}

/// One number for these bytes.
pub(crate) fn digest(bytes: &[u8]) -> u64 {
    let mut digest = Digest::new();
    digest.update(bytes);
    digest.value()
}

fn render_as<C>(picture: &Picture, black: C) -> Result<Vec<u8>>
where
    C: DisplayColor + PixelColor + ToBytes<Bytes: AsRef<[u8]>>,
{
    // In f32, as on the boards.
    let mut memory = vec![std::mem::MaybeUninit::uninit(); picture.scene.scene.bytes::<f32>()];
    let scene = PreparedScene::<f32, _>::new(picture.scene.scene, &mut memory)?;
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
