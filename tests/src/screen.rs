//! A display that tests draw to.

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Point, Size};
use embedded_graphics::pixelcolor::{PixelColor, Rgb888};
use embedded_graphics::primitives::Rectangle;
use rayline::{Real, Renderer};

/// A display that records every pixel and every window, and can fail at any pixel.
#[derive(Clone, Debug)]
pub struct Screen<C = Rgb888> {
    /// The size in pixels.
    pub size: Size,
    /// The pixels that were drawn, line by line.
    pub pixels: Vec<Option<C>>,
    /// The areas that were filled, in order.
    pub windows: Vec<Rectangle>,
    /// The number of pixels after which the display fails.
    pub pixels_until_failure: Option<usize>,
}

impl Screen {
    /// A blank screen with the size of the renderer's picture.
    pub fn new<R: Real>(renderer: &Renderer<R>) -> Self {
        Self::blank(Size::new(renderer.width(), renderer.height()))
    }
}

impl<C: Copy> Screen<C> {
    /// A blank screen for any color.
    pub fn blank(size: Size) -> Self {
        let count = (size.width * size.height) as usize;
        Self { size, pixels: vec![None; count], windows: Vec::new(), pixels_until_failure: None }
    }

    /// All pixels, which must have been drawn.
    pub fn picture(&self) -> Vec<C> {
        self.pixels.iter().map(|pixel| pixel.expect("every pixel is drawn")).collect()
    }
}

/// The error of a [`Screen`].
#[derive(Debug, PartialEq, Eq)]
pub struct Unplugged;

impl<C> OriginDimensions for Screen<C> {
    fn size(&self) -> Size {
        self.size
    }
}

impl<C: PixelColor> DrawTarget for Screen<C> {
    type Color = C;
    type Error = Unplugged;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Unplugged> {
        for Pixel(Point { x, y }, color) in pixels {
            if let Some(left) = &mut self.pixels_until_failure {
                *left = left.checked_sub(1).ok_or(Unplugged)?;
            }
            self.pixels[(y as u32 * self.size.width + x as u32) as usize] = Some(color);
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Unplugged> {
        self.windows.push(*area);
        let width = area.size.width;
        let points = (0..).map(|i| area.top_left + Point::new((i % width) as i32, (i / width) as i32));
        self.draw_iter(points.zip(colors).map(|(point, color)| Pixel(point, color)))
    }
}
