//! Rendering in realtime quality, by several threads.
//!
//! Each thread draws a part of the picture, because lines do not depend on their order. A part begins with a
//! row of the grid that the part above traces too, so that more threads trace a few more rays.

use core::ops::Range;

use embedded_graphics::pixelcolor::{BinaryColor, Rgb888, RgbColor};
use rayline::{DisplayColor, DrawError, Edges, LineError, RayCounts, Real, Realtime, Renderer, Sample};

use crate::canvas::Canvas;
use crate::display::ForColor;
use crate::parts::render_parts;

/// The job of rendering some lines in realtime quality.
pub(crate) struct Bands<'j, 'm, R: Real> {
    pub(crate) renderer: &'j Renderer<'j, 'm, R>,
    pub(crate) lines: Range<u32>,
    pub(crate) edges: Edges,
    pub(crate) rgb: &'j mut [u8],
    pub(crate) line_done: &'j (dyn Fn() + Sync),
}

impl<R: Real> ForColor for Bands<'_, '_, R> {
    type Output = Result<RayCounts, LineError>;

    fn with<C>(self) -> Self::Output
    where
        C: DisplayColor + Into<Rgb888> + From<BinaryColor> + Send,
    {
        let Self { renderer, lines, edges, rgb, line_done } = self;
        let quality = quality_for(renderer.width(), edges);
        let band = quality.grid.pixels();
        let part = lines.len().div_ceil(rayon::current_num_threads()).next_multiple_of(band).max(band);
        let line_bytes = renderer.width() as usize * 3;
        render_parts(rgb, line_bytes * part, &|number, rgb| {
            let first = lines.start + (number * part) as u32;
            let part = first..lines.end.min(first + part as u32);
            let width = renderer.width() as u16;
            let mut colors = vec![C::from(BinaryColor::Off); quality.colors(width)];
            let mut samples = vec![Sample::BLANK; quality.samples(width)];
            let keep = |color: C| {
                let color: Rgb888 = color.into();
                [color.r(), color.g(), color.b()]
            };
            let (pixels, _) = rgb.as_chunks_mut();
            let mut canvas = Canvas { width: renderer.width(), first, pixels, keep, line_done };
            let mut rays = RayCounts::default();
            let mut frame = renderer.frame(part, quality.lend(&mut colors, &mut samples))?;
            loop {
                match frame.step_watched(&mut canvas, u32::MAX, &mut rays) {
                    Ok(progress) if progress.is_done() => return Ok(rays),
                    Ok(_) => {}
                    Err(DrawError::Display { error, .. }) => match error {},
                    Err(DrawError::Line(error)) => return Err(error),
                    // There is no other error at present.
                    Err(_) => return Ok(rays),
                }
            }
        })
    }
}

/// Realtime quality for a picture of this width. Small pictures show smaller details, so they need a finer
/// grid.
pub(crate) fn quality_for(width: u32, edges: Edges) -> Realtime {
    let quality = if width < 240 { Realtime::fine() } else { Realtime::new() };
    Realtime { edges, ..quality }
}
