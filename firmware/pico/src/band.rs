//! A band of lines as a display, which the renderer draws on.

use core::convert::Infallible;

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Size};
use embedded_graphics::primitives::Rectangle;

use crate::panel_color::PanelColor;
use crate::picture::{HEIGHT, LINES, WIDTH};

/// A band of lines of the picture, drawn from the first to the last.
#[derive(Debug)]
pub(crate) struct Band {
    pixels: [PanelColor; WIDTH * LINES],
    /// Number of pixels that are drawn.
    drawn: usize,
}

impl Band {
    /// An empty band.
    pub(crate) const BLACK: Self = Self { pixels: [PanelColor::BLACK; WIDTH * LINES], drawn: 0 };

    /// Removes all pixels.
    pub(crate) fn clear(&mut self) {
        self.drawn = 0;
    }

    /// The pixels that are drawn.
    pub(crate) fn drawn(&self) -> &[PanelColor] {
        self.pixels.get(..self.drawn).unwrap_or(&self.pixels)
    }
}

impl OriginDimensions for Band {
    fn size(&self) -> Size {
        Size::new(WIDTH as u32, HEIGHT as u32)
    }
}

impl DrawTarget for Band {
    type Color = PanelColor;
    type Error = Infallible;

    /// Draws nothing: the renderer only draws whole lines, with `fill_contiguous`.
    fn draw_iter<I: IntoIterator<Item = Pixel<PanelColor>>>(&mut self, _: I) -> Result<(), Infallible> {
        Ok(())
    }

    fn fill_contiguous<I>(&mut self, _: &Rectangle, colors: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = PanelColor>,
    {
        // Count in a local variable: the field would be written to memory for each pixel.
        let mut drawn = self.drawn;
        for (pixel, color) in self.pixels.iter_mut().skip(drawn).zip(colors) {
            *pixel = color;
            drawn += 1;
        }
        self.drawn = drawn;
        Ok(())
    }
}
