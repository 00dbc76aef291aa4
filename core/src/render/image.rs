//! A picture as an image of embedded-graphics.

use core::marker::PhantomData;

use embedded_graphics::draw_target::{DrawTarget, DrawTargetExt};
use embedded_graphics::geometry::{OriginDimensions, Point, Size};
use embedded_graphics::image::ImageDrawable;
use embedded_graphics::primitives::Rectangle;

use super::line::LinePainter;
use super::region::Region;
use super::{DisplayColor, Renderer};
use crate::math::Real;
use crate::shape::Geometry;

/// A picture in exact quality that embedded-graphics places, as it places bitmaps: see [`Renderer::image`].
///
/// The display takes all pixels in one window. Each pixel is traced when the display reads it, so no memory
/// is lent; for scenes of many objects, [`Renderer::draw`] with several lines is faster.
#[derive(Clone, Copy, Debug)]
pub struct RenderedImage<'r, 'm, R: Real, S: Geometry + 'm, C> {
    renderer: &'r Renderer<'r, 'm, R, S>,
    color: PhantomData<C>,
}

impl<'m, R: Real, S: Geometry + 'm> Renderer<'_, 'm, R, S> {
    /// The picture as an image, which [`Image`](embedded_graphics::image::Image) places anywhere.
    ///
    /// ```
    /// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use rayline::{Real, Renderer};
    ///
    /// fn draw<R: Real>(renderer: &Renderer<'_, '_, R>, display: &mut MockDisplay<Gray8>) {
    ///     let picture = renderer.image();
    ///     let _ = Image::new(&picture, Point::new(40, 20)).draw(display);
    /// }
    /// ```
    pub fn image<C: DisplayColor>(&self) -> RenderedImage<'_, 'm, R, S, C> {
        RenderedImage { renderer: self, color: PhantomData }
    }
}

impl<R: Real, S: Geometry, C> OriginDimensions for RenderedImage<'_, '_, R, S, C> {
    fn size(&self) -> Size {
        Size::new(self.renderer.width(), self.renderer.height())
    }
}

impl<R: Real, S: Geometry, C: DisplayColor> ImageDrawable for RenderedImage<'_, '_, R, S, C> {
    type Color = C;

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<(), D::Error> {
        let region = self.renderer.whole().shown_in(&target.bounding_box());
        if region.is_empty() {
            return Ok(());
        }
        let Region { left, right, top, bottom } = region;
        let pixels = (top..bottom).flat_map(|y| {
            let mut line = LinePainter::new(self.renderer, y as u16);
            (left..right).map(move |x| line.pixel(x as u16))
        });
        target.fill_contiguous(&region.area(), pixels)
    }

    fn draw_sub_image<D: DrawTarget<Color = C>>(
        &self,
        target: &mut D,
        area: &Rectangle,
    ) -> Result<(), D::Error> {
        let Point { x, y } = area.top_left;
        let corner = Point::new(0i32.saturating_sub(x), 0i32.saturating_sub(y));
        self.draw(&mut target.translated(corner).clipped(area))
    }
}
