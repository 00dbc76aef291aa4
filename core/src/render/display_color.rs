//! The colors that displays take.

use embedded_graphics::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb555, Rgb565, Rgb666,
    Rgb888,
};

use super::{Light16, Quantizer, Tone, ToneScale};

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
    /// The scale of the tones that realtime quality interpolates. The default is light itself. A type that
    /// wraps another color, such as an [`Rgb565`] with its bytes swapped, uses the scale and
    /// [`from_tone`](Self::from_tone) of that color.
    const TONES: ToneScale = ToneScale::LIGHT;

    /// The color of a pixel that shows `light`.
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self;

    /// The color of a pixel that shows a tone of the scale [`TONES`](Self::TONES). Override it together with
    /// the scale. The color of a tone must be [`from_light`](Self::from_light) of its light.
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

/// Implements [`DisplayColor`] for colors with bits of red, green and blue.
macro_rules! of_channels {
    (#[$inline:meta] $($Color:ty),+: $r:literal $g:literal $b:literal) => {$(
        impl DisplayColor for $Color {
            const TONES: ToneScale = ToneScale::rgb($r, $g, $b);

            #[$inline]
            fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
                let level = |light, bits: u32| quantizer.level(light, (1u16 << bits).wrapping_sub(1) as u8);
                Self::new(level(light.r, $r), level(light.g, $g), level(light.b, $b))
            }

            #[inline]
            fn from_tone(tone: Tone, quantizer: &Quantizer) -> Self {
                Self::new(
                    quantizer.cut::<$r>(tone.first()),
                    quantizer.cut::<$g>(tone.second()),
                    quantizer.cut::<$b>(tone.third()),
                )
            }
        }
    )+};
}

of_channels!(#[inline] Rgb888, Bgr888: 8 8 8);
of_channels!(#[inline] Rgb666, Bgr666: 6 6 6);
of_channels!(#[inline(always)] Rgb565, Bgr565: 5 6 5);
of_channels!(#[inline] Rgb555, Bgr555: 5 5 5);

/// Implements [`DisplayColor`] for a gray of some bits, which is made by this function of its level.
macro_rules! of_luminance {
    ($Color:ty: $bits:literal, $of_level:expr) => {
        impl DisplayColor for $Color {
            const TONES: ToneScale = ToneScale::luminance($bits);

            #[inline]
            fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
                $of_level(quantizer.level(light.luminance(), (1u16 << $bits).wrapping_sub(1) as u8))
            }

            #[inline]
            fn from_tone(tone: Tone, quantizer: &Quantizer) -> Self {
                $of_level(quantizer.cut::<$bits>(tone.second()))
            }
        }
    };
}

of_luminance!(Gray8: 8, Self::new);
of_luminance!(Gray4: 4, Self::new);
of_luminance!(Gray2: 2, Self::new);
of_luminance!(BinaryColor: 1, |level| Self::from(level == 1));

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::{Settings, Transfer};
    use core::fmt::Debug;
    use embedded_graphics::pixelcolor::{GrayColor, RgbColor};

    /// Black, white, and colors by tone and by light are the same.
    fn assert_color<C: DisplayColor + Debug>(black: C, white: C) {
        for transfer in [Transfer::Linear, Transfer::Srgb] {
            let quantizer = Quantizer::new(&Settings { transfer, ..Settings::new(1, 1) }, 0, 0);
            let of = |r, g, b| C::from_light(Light16 { r, g, b }, &quantizer);
            assert_eq!((of(0, 0, 0), of(65536, 65536, 65536)), (black, white));
            for (r, g, b) in [(0, 9_000, 65_536), (30_000, 31_000, 32_000), (65_536, 77, 1_000)] {
                let light = Light16 { r, g, b };
                assert_eq!(
                    C::from_tone(C::TONES.tone(light, transfer), &quantizer),
                    of(r, g, b),
                    "{light:?}"
                );
            }
        }
    }

    fn assert_channels<C: DisplayColor + RgbColor + Debug>() {
        assert_color(C::BLACK, C::WHITE);
        let settings = Settings { transfer: Transfer::Linear, ..Settings::new(1, 1) };
        let light = Light16 { r: 65_536, g: 0, b: 32_768 };
        let color = C::from_light(light, &Quantizer::new(&settings, 0, 0));
        assert_eq!((color.r(), color.g(), color.b()), (C::MAX_R, 0, C::MAX_B / 2 + 1), "{color:?}");
    }

    #[test]
    fn every_color_of_embedded_graphics_has_all_its_levels() {
        assert_channels::<Rgb555>();
        assert_channels::<Bgr555>();
        assert_channels::<Rgb565>();
        assert_channels::<Bgr565>();
        assert_channels::<Rgb666>();
        assert_channels::<Bgr666>();
        assert_channels::<Rgb888>();
        assert_channels::<Bgr888>();
        assert_color(Gray2::BLACK, Gray2::WHITE);
        assert_color(Gray4::BLACK, Gray4::WHITE);
        assert_color(Gray8::BLACK, Gray8::WHITE);
        assert_color(BinaryColor::Off, BinaryColor::On);
    }
}
