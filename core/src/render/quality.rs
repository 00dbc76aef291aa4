//! The quality of a picture, which follows from the type of the memory that a program lends.
//!
//! Exact quality needs a line of colors and nothing else. Realtime quality needs a band of colors, a row of
//! [samples](super::Sample) and its own settings. So the argument that lends memory is also the one that
//! chooses the quality:
//!
//! ```
//! use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8};
//! use rayline::{DrawError, Real, Realtime, Renderer, Sample};
//!
//! const QUALITY: Realtime = Realtime::new();
//!
//! fn draw<R: Real>(
//!     renderer: &Renderer<'_, '_, R>,
//!     display: &mut MockDisplay<Gray8>,
//! ) -> Result<(), DrawError<core::convert::Infallible>> {
//!     // Exact quality: a line.
//!     let mut line = [Gray8::new(0); 64];
//!     renderer.draw(display, &mut line)?;
//!
//!     // Realtime quality: its settings, with memory.
//!     let mut colors = [Gray8::new(0); QUALITY.colors(64)];
//!     let mut samples = [Sample::BLANK; QUALITY.samples(64)];
//!     renderer.draw(display, QUALITY.lend(&mut colors, &mut samples))
//! }
//! ```
//!
//! Each quality has its own type, and the type names the [`Painter`] that traces. A program links only the
//! painters that it names: 32 KB of flash hold an exact picture because no code of realtime quality is in
//! the program. An `enum` of both qualities would link both.

use super::exact::ExactPainter;
use super::painter::Painter;
use super::{DisplayColor, LineError, Renderer};
use crate::math::Real;
use crate::shape::Geometry;

/// The quality in which a picture is drawn in the number system `R`, with the memory that this takes. These
/// types implement it:
/// - `&mut [C]` and `&mut [C; N]`: exact quality, with memory for one line of the picture, or for several
///   whole lines that are sent to the display together. Pixels that fill no whole line are not used;
/// - [`RealtimeBuffer`](super::RealtimeBuffer): realtime quality, see
///   [`Realtime::lend`](super::Realtime::lend);
/// - [`Progressive`](super::Progressive): exact quality, one sample of each pixel after the other.
///
/// The trait is sealed: other crates cannot implement it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not memory to draw a picture in",
    note = "for exact quality, lend a slice of colors: `&mut line[..]`",
    note = "for realtime quality, lend `Realtime::lend(…)`"
)]
pub trait Quality<R: Real>: Sized + Sealed {
    /// The color of the display's pixels.
    type Color: DisplayColor;

    /// Traces lines in this quality.
    #[doc(hidden)]
    type Painter<'m, S: Geometry + 'm>: Painter<'m, R, S, Color = Self::Color>;

    /// Whether the memory has the right length.
    #[doc(hidden)]
    fn check<S: Geometry>(&self, renderer: &Renderer<'_, '_, R, S>) -> Result<(), LineError>;

    /// The painter of a frame. It is large: it is made where it stays, in a function that cannot fail.
    #[doc(hidden)]
    fn painter<'m, S: Geometry + 'm>(self, renderer: &Renderer<'_, 'm, R, S>) -> Self::Painter<'m, S>;
}

/// No other crate can name this trait, and so none can implement [`Quality`].
pub trait Sealed {}

impl<C: DisplayColor> Sealed for &mut [C] {}

impl<'b, C: DisplayColor, R: Real> Quality<R> for &'b mut [C] {
    type Color = C;
    type Painter<'m, S: Geometry + 'm> = ExactPainter<'b, C>;

    fn check<S: Geometry>(&self, renderer: &Renderer<'_, '_, R, S>) -> Result<(), LineError> {
        renderer.check_line(self.len())
    }

    fn painter<'m, S: Geometry + 'm>(self, _: &Renderer<'_, 'm, R, S>) -> ExactPainter<'b, C> {
        ExactPainter::new(self)
    }
}

impl<C: DisplayColor, const N: usize> Sealed for &mut [C; N] {}

impl<'b, C: DisplayColor, R: Real, const N: usize> Quality<R> for &'b mut [C; N] {
    type Color = C;
    type Painter<'m, S: Geometry + 'm> = ExactPainter<'b, C>;

    fn check<S: Geometry>(&self, renderer: &Renderer<'_, '_, R, S>) -> Result<(), LineError> {
        renderer.check_line(N)
    }

    fn painter<'m, S: Geometry + 'm>(self, _: &Renderer<'_, 'm, R, S>) -> ExactPainter<'b, C> {
        ExactPainter::new(self)
    }
}
