//! The kinds of displays that a picture can be made for.

use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Gray8, Rgb565, Rgb888};
use rayline::DisplayColor;

/// The kind of display that a picture is made for, by the color of its pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Display {
    /// 256 levels of red, green and blue.
    #[default]
    Rgb888,
    /// 32 levels of red and blue and 64 of green, as on most color displays of boards.
    Rgb565,
    /// 256 levels of gray.
    Gray8,
    /// 16 levels of gray, as on many OLEDs.
    Gray4,
    /// Black and white.
    Mono,
}

/// A job that is generic over the color type of a display.
pub(crate) trait ForColor {
    /// The result of the job.
    type Output;

    /// Does the job for the color type `C`.
    fn with<C>(self) -> Self::Output
    where
        C: DisplayColor + Into<Rgb888> + From<Rgb888> + From<BinaryColor> + Send;
}

impl Display {
    /// Does a job for the color type of this display.
    pub(crate) fn color<F: ForColor>(self, job: F) -> F::Output {
        match self {
            Self::Rgb888 => job.with::<Rgb888>(),
            Self::Rgb565 => job.with::<Rgb565>(),
            Self::Gray8 => job.with::<Gray8>(),
            Self::Gray4 => job.with::<Gray4>(),
            Self::Mono => job.with::<BinaryColor>(),
        }
    }
}

impl core::fmt::Display for Display {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Rgb888 => "rgb888",
            Self::Rgb565 => "rgb565",
            Self::Gray8 => "gray8",
            Self::Gray4 => "gray4",
            Self::Mono => "mono",
        })
    }
}
