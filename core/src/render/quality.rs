//! How a picture is drawn: the memory that a program lends says it.
//!
//! Exact quality needs a line of colors and nothing else. Realtime quality needs a band of colors, a row of
//! [samples](super::Sample) and its own settings. So the argument that lends memory is also the one that chooses the
//! quality:
//!
//! ```no_run
//! # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8};
//! # use rayline::{DrawError, Realtime, Renderer, Sample};
//! # fn draw<E>(renderer: &Renderer<'_, '_, f32>, mut display: MockDisplay<Gray8>) -> Result<(), DrawError<core::convert::Infallible>> {
//! // Exact: a line.
//! let mut line = [Gray8::new(0); 64];
//! renderer.draw(&mut display, &mut line)?;
//!
//! // Realtime: a quality with memory for it.
//! const QUALITY: Realtime = Realtime::new();
//! let mut colors = [Gray8::new(0); QUALITY.colors(64)];
//! let mut samples = [Sample::BLANK; QUALITY.samples(64)];
//! renderer.draw(&mut display, QUALITY.lend(&mut colors, &mut samples))?;
//! # Ok(())
//! # }
//! ```
//!
//! Each quality has its own type, and the type names the [`Painter`] that traces. A program links only the painters
//! that it names: 32 KB of flash hold an exact picture because no code of realtime quality is in the program. An `enum` of
//! both qualities would link both.

use super::DisplayColor;
use super::LineError;
use super::Renderer;
use super::exact::ExactPainter;
use super::painter::Painter;
use crate::math::Real;
use crate::shape::Geometry;

/// The quality in which a picture is drawn, with the memory that this takes. Three types implement it:
/// - `&mut [C]` and `&mut [C; N]`: exact quality, with memory for one line of the picture, or for several whole lines that
///   are sent to the display together;
/// - [`RealtimeBuffer`](super::RealtimeBuffer): realtime quality, see [`Realtime::lend`](super::Realtime::lend).
///
/// The trait is sealed: other crates cannot implement it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not memory to draw a picture in",
    note = "lend a slice of colors (`&mut line[..]`) for exact quality, or `Realtime::lend(…)` for realtime quality"
)]
pub trait Quality: Sized {
    /// The color of the display's pixels.
    type Color: DisplayColor;

    /// Traces lines in this quality.
    #[doc(hidden)]
    type Painter<'m, R: Real, S: Geometry + 'm>: Painter<'m, R, S, Color = Self::Color>;

    /// The painter of a frame.
    #[doc(hidden)]
    fn painter<'m, R: Real, S: Geometry + 'm>(
        self,
        renderer: &Renderer<'_, 'm, R, S>,
    ) -> Result<Self::Painter<'m, R, S>, LineError>;
}

impl<'b, C: DisplayColor> Quality for &'b mut [C] {
    type Color = C;
    type Painter<'m, R: Real, S: Geometry + 'm> = ExactPainter<'b, C>;

    fn painter<'m, R: Real, S: Geometry + 'm>(
        self,
        renderer: &Renderer<'_, 'm, R, S>,
    ) -> Result<ExactPainter<'b, C>, LineError> {
        ExactPainter::new(renderer, self)
    }
}

impl<'b, C: DisplayColor, const N: usize> Quality for &'b mut [C; N] {
    type Color = C;
    type Painter<'m, R: Real, S: Geometry + 'm> = ExactPainter<'b, C>;

    fn painter<'m, R: Real, S: Geometry + 'm>(
        self,
        renderer: &Renderer<'_, 'm, R, S>,
    ) -> Result<ExactPainter<'b, C>, LineError> {
        ExactPainter::new(renderer, self)
    }
}
