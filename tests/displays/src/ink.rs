//! The color of e-paper whose driver takes `BinaryColor::On` for black: the one of `docs/displays.md`.

use embedded_graphics::pixelcolor::PixelColor;
use embedded_graphics::pixelcolor::raw::RawU1;
use rayline::{DisplayColor, Light16, Quantizer};

#[derive(Clone, Copy, PartialEq)]
pub struct Ink(bool);

impl PixelColor for Ink {
    type Raw = RawU1;
}

impl DisplayColor for Ink {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self(quantizer.level(light.luminance(), 1) == 0)
    }
}

impl From<Ink> for epd_waveshare::color::Color {
    fn from(Ink(is_dark): Ink) -> Self {
        if is_dark { Self::Black } else { Self::White }
    }
}
