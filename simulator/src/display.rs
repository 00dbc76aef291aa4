//! The kinds of displays that a picture can be made for.

use embedded_graphics::pixelcolor::raw::RawU2;
use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Gray8, PixelColor, Rgb565, Rgb888, RgbColor};
use rayline::{DisplayColor, Light16, Palette, Quantizer};

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
    /// Black, white and red, as on e-paper.
    BlackWhiteRed,
    /// Black, white, yellow and red, as on e-paper.
    BlackWhiteYellowRed,
}

/// Defines the color of a panel with a palette, of which color 0 is black and color 1 is white.
macro_rules! inks {
    ($Ink:ident: $colors:literal, $palette:expr) => {
        #[derive(Clone, Copy, Debug, PartialEq)]
        struct $Ink(u8);

        impl $Ink {
            const PALETTE: Palette<$colors> = $palette;
        }

        impl PixelColor for $Ink {
            type Raw = RawU2;
        }

        impl DisplayColor for $Ink {
            fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
                Self(quantizer.nearest_of(light, &Self::PALETTE))
            }
        }

        impl From<$Ink> for Rgb888 {
            fn from(ink: $Ink) -> Self {
                let [r, g, b] = $Ink::PALETTE.color(ink.0);
                Self::new(r, g, b)
            }
        }

        impl From<Rgb888> for $Ink {
            fn from(color: Rgb888) -> Self {
                let wanted = [color.r(), color.g(), color.b()];
                let far = |ink: &u8| -> u32 {
                    let ways = Self::PALETTE.color(*ink).into_iter().zip(wanted);
                    ways.map(|(ink, wanted)| u32::from(ink.abs_diff(wanted)).pow(2)).sum()
                };
                Self((0..$colors).min_by_key(far).unwrap_or_default())
            }
        }

        impl From<BinaryColor> for $Ink {
            fn from(color: BinaryColor) -> Self {
                Self(u8::from(color.is_on()))
            }
        }
    };
}

inks!(ThreeInks: 3, Palette::BLACK_WHITE_RED);
inks!(FourInks: 4, Palette::BLACK_WHITE_YELLOW_RED);

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
            Self::BlackWhiteRed => job.with::<ThreeInks>(),
            Self::BlackWhiteYellowRed => job.with::<FourInks>(),
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
            Self::BlackWhiteRed => "black-white-red",
            Self::BlackWhiteYellowRed => "black-white-yellow-red",
        })
    }
}
