//! Colors in the byte order of the panel.

use embedded_graphics::pixelcolor::raw::{RawU16, ToBytes};
use embedded_graphics::pixelcolor::{PixelColor, Rgb565};
use rayline::{DisplayColor, Light16, Quantizer, Tone, ToneScale};
use zerocopy::{Immutable, IntoBytes};

/// An [`Rgb565`] with the high byte first. Lines of these colors are sent to the panel without conversion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoBytes, Immutable)]
#[repr(transparent)]
pub(crate) struct PanelColor([u8; 2]);

impl PanelColor {
    /// No light.
    pub(crate) const BLACK: Self = Self([0; 2]);
}

impl PixelColor for PanelColor {
    type Raw = RawU16;
}

impl DisplayColor for PanelColor {
    const TONES: ToneScale = Rgb565::TONES;

    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self(Rgb565::from_light(light, quantizer).to_be_bytes())
    }

    fn from_tone(tone: Tone, quantizer: &Quantizer) -> Self {
        Self(Rgb565::from_tone(tone, quantizer).to_be_bytes())
    }
}
