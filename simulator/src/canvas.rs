//! A display that keeps the lines of a picture in memory.

use core::convert::Infallible;

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Size};
use embedded_graphics::pixelcolor::PixelColor;
use embedded_graphics::primitives::{PointsIter, Rectangle};

/// A display that keeps some lines of a picture, each color as what `keep` makes of it.
pub(crate) struct Canvas<'c, C, P> {
    pub(crate) width: u32,
    /// The number of the first line that is kept.
    pub(crate) first: u32,
    pub(crate) pixels: &'c mut [P],
    pub(crate) keep: fn(C) -> P,
    pub(crate) line_done: &'c (dyn Fn() + Sync),
}

impl<C, P> OriginDimensions for Canvas<'_, C, P> {
    fn size(&self) -> Size {
        let lines = self.pixels.len() / self.width as usize;
        Size::new(self.width, self.first + lines as u32)
    }
}

impl<C: PixelColor, P> DrawTarget for Canvas<'_, C, P> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(point, color) in pixels {
            let place = (point.y as usize - self.first as usize) * self.width as usize + point.x as usize;
            if let Some(pixel) = self.pixels.get_mut(place) {
                *pixel = (self.keep)(color);
            }
        }
        Ok(())
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = C>,
    {
        self.draw_iter(area.points().zip(colors).map(|(point, color)| Pixel(point, color)))?;
        (0..area.size.height).for_each(|_| (self.line_done)());
        Ok(())
    }
}
