//! Drawing by scan conversion, on one thread: see [`rayline::Preview`].

use core::ops::Range;

use rayline::limits::MAX_PREVIEW_FACETS;
use rayline::{DrawError, Light16, LineError, Preview, PreviewFacet, PreviewPixel, Real, Renderer};

use crate::canvas::Canvas;

/// Memory for as many facets as a preview can have: 4 MB.
pub(crate) fn facets() -> Vec<PreviewFacet> {
    vec![PreviewFacet::BLANK; MAX_PREVIEW_FACETS]
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
    let mut canvas = Canvas { width, first, pixels: lights, keep: |light| light, line_done };
    match renderer.frame(lines, preview.lend(&mut line, &mut pixels))?.draw(&mut canvas) {
        Err(DrawError::Line(error)) => Err(error),
        _ => Ok(()),
    }
}
