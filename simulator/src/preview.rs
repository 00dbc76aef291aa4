//! Drawing by scan conversion, on one thread: see [`rayline::Preview`].

use core::convert::Infallible;
use core::ops::Range;

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Size};
use embedded_graphics::primitives::Rectangle;
use rayline::{
    DrawError, Light16, LineError, Preview, PreviewError, PreviewFacet, PreviewPixel, Real, Renderer,
};

/// Memory for facets: at first for some, and then for as many as a picture needs.
pub(crate) struct Facets(Vec<PreviewFacet>);

impl Facets {
    pub(crate) fn new() -> Self {
        Self(vec![PreviewFacet::BLANK; 4096])
    }

    /// The preview of a picture.
    ///
    /// # Errors
    /// More facets are seen than a preview can have, or the picture is too large.
    pub(crate) fn preview<R: Real>(
        &mut self,
        renderer: &Renderer<'_, '_, R>,
        segments: u16,
    ) -> Result<Preview<'_>, PreviewError> {
        if let Err(PreviewError::Facets { needed, lent }) = Preview::new(renderer, segments, &mut self.0)
            && needed > lent
        {
            self.0.resize(needed, PreviewFacet::BLANK);
        }
        Preview::new(renderer, segments, &mut self.0)
    }
}

/// Draws some lines of a preview as light, into as many pixels.
///
/// # Errors
/// The picture has no such lines.
pub(crate) fn draw_lines<R: Real>(
    preview: &mut Preview<'_>,
    renderer: &Renderer<'_, '_, R>,
    lines: Range<u32>,
    lights: &mut [Light16],
    line_done: &(dyn Fn() + Sync),
) -> Result<(), LineError> {
    let (width, first) = (renderer.width(), lines.start);
    let mut line = vec![Light16::BLACK; width as usize];
    let mut pixels = vec![PreviewPixel::BLANK; width as usize];
    let mut canvas = Canvas { size: Size::new(width, renderer.height()), first, lights, line_done };
    match renderer.frame(lines, preview.lend(&mut line, &mut pixels))?.draw(&mut canvas) {
        Err(DrawError::Line(error)) => Err(error),
        _ => Ok(()),
    }
}

/// A display that keeps lines as light.
struct Canvas<'c> {
    size: Size,
    /// The number of the first line that is kept.
    first: u32,
    lights: &'c mut [Light16],
    line_done: &'c (dyn Fn() + Sync),
}

impl OriginDimensions for Canvas<'_> {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Canvas<'_> {
    type Color = Light16;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Light16>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(point, light) in pixels {
            let place =
                (point.y as usize - self.first as usize) * self.size.width as usize + point.x as usize;
            if let Some(pixel) = self.lights.get_mut(place) {
                *pixel = light;
            }
        }
        Ok(())
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Light16>,
    {
        let place = (area.top_left.y as usize - self.first as usize) * self.size.width as usize;
        let line = self.lights.get_mut(place..).unwrap_or_default();
        line.iter_mut().zip(colors).for_each(|(pixel, light)| *pixel = light);
        (0..area.size.height).for_each(|_| (self.line_done)());
        Ok(())
    }
}
