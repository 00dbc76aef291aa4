//! What a display's color is made of.

use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Gray8, PixelColor, Rgb565, Rgb888};

use super::{Light16, Quantizer};

/// A display's color that light can become. Implement it for the color of your own display:
///
/// ```
/// use embedded_graphics::pixelcolor::{PixelColor, raw::RawU2};
/// use rayline::{DisplayColor, Light16, Quantizer};
///
/// /// Four shades of e-paper.
/// #[derive(Clone, Copy, PartialEq)]
/// struct Shade(u8);
///
/// impl PixelColor for Shade {
///     type Raw = RawU2;
/// }
///
/// impl DisplayColor for Shade {
///     fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
///         Self(quantizer.level(light.luminance(), 3))
///     }
/// }
/// ```
pub trait DisplayColor: PixelColor {
    /// The color of a pixel that shows `light`.
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self;
}

impl DisplayColor for Rgb888 {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self::new(quantizer.level(light.r, 255), quantizer.level(light.g, 255), quantizer.level(light.b, 255))
    }
}

impl DisplayColor for Rgb565 {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self::new(quantizer.level(light.r, 31), quantizer.level(light.g, 63), quantizer.level(light.b, 31))
    }
}

impl DisplayColor for Gray8 {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self::new(quantizer.level(light.luminance(), 255))
    }
}

impl DisplayColor for Gray4 {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self::new(quantizer.level(light.luminance(), 15))
    }
}

impl DisplayColor for BinaryColor {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self::from(quantizer.level(light.luminance(), 1) == 1)
    }
}
