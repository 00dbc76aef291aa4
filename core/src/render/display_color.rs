//! The colors that displays take.

use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Gray8, PixelColor, Rgb565, Rgb888};

use super::{Light16, Quantizer, Tone};

/// The color of a display's pixels, made from light. Implement it for the color of your own display:
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

    /// Light on this display's own scale, which realtime quality interpolates. The default is light itself.
    #[inline]
    fn tone(light: Light16, quantizer: &Quantizer) -> Tone {
        let _ = quantizer;
        Tone::from_light(light)
    }

    /// The light that has this [`tone`](Self::tone), as exactly as the tone tells. Smooth edges
    /// ([`Edges::Smooth`](super::Edges::Smooth)) mix light. Override it if you override `tone`.
    #[inline]
    fn light(tone: Tone, quantizer: &Quantizer) -> Light16 {
        let _ = quantizer;
        tone.to_light()
    }

    /// The color of a pixel that shows `tone`. The color of [`tone`](Self::tone) must be
    /// [`from_light`](Self::from_light) of the same light.
    #[inline]
    fn from_tone(tone: Tone, quantizer: &Quantizer) -> Self {
        Self::from_light(tone.to_light(), quantizer)
    }
}

impl PixelColor for Light16 {
    type Raw = ();
}

/// Light itself, for a program that makes colors of lines later, or for several displays:
/// [`Renderer::lines`](super::Renderer::lines) into a slice of light, then
/// [`from_light`](DisplayColor::from_light) of the display's color with [`Quantizer::new`].
impl DisplayColor for Light16 {
    fn from_light(light: Light16, _quantizer: &Quantizer) -> Self {
        light
    }
}

impl DisplayColor for Rgb888 {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self::new(quantizer.level(light.r, 255), quantizer.level(light.g, 255), quantizer.level(light.b, 255))
    }

    #[inline]
    fn tone(light: Light16, quantizer: &Quantizer) -> Tone {
        Tone::new(quantizer.tone::<8>(light.r), quantizer.tone::<8>(light.g), quantizer.tone::<8>(light.b))
    }

    fn light(tone: Tone, quantizer: &Quantizer) -> Light16 {
        Light16 {
            r: quantizer.light::<8>(tone.first()),
            g: quantizer.light::<8>(tone.second()),
            b: quantizer.light::<8>(tone.third()),
        }
    }

    #[inline]
    fn from_tone(tone: Tone, quantizer: &Quantizer) -> Self {
        Self::new(
            quantizer.cut::<8>(tone.first()),
            quantizer.cut::<8>(tone.second()),
            quantizer.cut::<8>(tone.third()),
        )
    }
}

impl DisplayColor for Rgb565 {
    #[inline(always)]
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self::new(quantizer.level(light.r, 31), quantizer.level(light.g, 63), quantizer.level(light.b, 31))
    }

    #[inline]
    fn tone(light: Light16, quantizer: &Quantizer) -> Tone {
        Tone::new(quantizer.tone::<5>(light.r), quantizer.tone::<6>(light.g), quantizer.tone::<5>(light.b))
    }

    fn light(tone: Tone, quantizer: &Quantizer) -> Light16 {
        Light16 {
            r: quantizer.light::<5>(tone.first()),
            g: quantizer.light::<6>(tone.second()),
            b: quantizer.light::<5>(tone.third()),
        }
    }

    #[inline]
    fn from_tone(tone: Tone, quantizer: &Quantizer) -> Self {
        Self::new(
            quantizer.cut::<5>(tone.first()),
            quantizer.cut::<6>(tone.second()),
            quantizer.cut::<5>(tone.third()),
        )
    }
}

impl DisplayColor for Gray8 {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self::new(quantizer.level(light.luminance(), 255))
    }

    #[inline]
    fn tone(light: Light16, quantizer: &Quantizer) -> Tone {
        Tone::new(0, quantizer.tone::<8>(light.luminance()), 0)
    }

    fn light(tone: Tone, quantizer: &Quantizer) -> Light16 {
        Light16::gray(quantizer.light::<8>(tone.second()))
    }

    #[inline]
    fn from_tone(tone: Tone, quantizer: &Quantizer) -> Self {
        Self::new(quantizer.cut::<8>(tone.second()))
    }
}

impl DisplayColor for Gray4 {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self::new(quantizer.level(light.luminance(), 15))
    }

    #[inline]
    fn tone(light: Light16, quantizer: &Quantizer) -> Tone {
        Tone::new(0, quantizer.tone::<4>(light.luminance()), 0)
    }

    fn light(tone: Tone, quantizer: &Quantizer) -> Light16 {
        Light16::gray(quantizer.light::<4>(tone.second()))
    }

    #[inline]
    fn from_tone(tone: Tone, quantizer: &Quantizer) -> Self {
        Self::new(quantizer.cut::<4>(tone.second()))
    }
}

impl DisplayColor for BinaryColor {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self::from(quantizer.level(light.luminance(), 1) == 1)
    }

    #[inline]
    fn tone(light: Light16, quantizer: &Quantizer) -> Tone {
        Tone::new(0, quantizer.tone::<1>(light.luminance()), 0)
    }

    fn light(tone: Tone, quantizer: &Quantizer) -> Light16 {
        Light16::gray(quantizer.light::<1>(tone.second()))
    }

    #[inline]
    fn from_tone(tone: Tone, quantizer: &Quantizer) -> Self {
        Self::from(quantizer.cut::<1>(tone.second()) == 1)
    }
}
