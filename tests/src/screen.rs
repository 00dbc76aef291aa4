//! A display that tests draw to.

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, Point, Size};
use embedded_graphics::pixelcolor::{PixelColor, Rgb888};
use embedded_graphics::primitives::Rectangle;
use rayline::{Real, Renderer};

/// A display that records every pixel and every window, and can fail at any pixel. It panics when somebody
/// draws beside it.
#[derive(Clone, Debug)]
pub struct Screen<C = Rgb888> {
    /// The bounding box.
    pub area: Rectangle,
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
        Self::over(Rectangle::new(Point::zero(), size))
    }

    /// A blank screen with this bounding box.
    pub fn over(area: Rectangle) -> Self {
        let count = (area.size.width * area.size.height) as usize;
        Self { area, pixels: vec![None; count], windows: Vec::new(), pixels_until_failure: None }
    }

    /// All pixels, which must have been drawn.
    pub fn picture(&self) -> Vec<C> {
        self.pixels.iter().map(|pixel| pixel.expect("every pixel is drawn")).collect()
    }
}

/// The error of a [`Screen`].
#[derive(Debug, PartialEq, Eq)]
pub struct Unplugged;

impl<C> Dimensions for Screen<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Screen<C> {
    type Color = C;
    type Error = Unplugged;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Unplugged> {
        for Pixel(point, color) in pixels {
            assert!(self.area.contains(point), "{point} is not in {:?}", self.area);
            if let Some(left) = &mut self.pixels_until_failure {
                *left = left.checked_sub(1).ok_or(Unplugged)?;
            }
            let Point { x, y } = point - self.area.top_left;
            self.pixels[(y as u32 * self.area.size.width + x as u32) as usize] = Some(color);
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
