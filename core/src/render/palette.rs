//! Palettes: panels of a few colors that are no levels of channels, as e-paper of black, white and red.
//!
//! A pixel that is not dithered has the nearest color by the codes of sRGB, which are close to how the eye
//! sees differences. A dithered pixel has one of [`PARTS`] colors, whose mean is the light. These colors are
//! chosen one after the other: each is the color of the palette nearest to the sum of the light and the error
//! that the colors before have left. The chosen colors are sorted from dark to bright, and the threshold of
//! the pixel picks one of them (Knoll, "Pattern Dithering", US patent 6,606,166 of 1999, expired; as
//! described by Yliluoma, "Arbitrary-Palette Positional Dithering Algorithm", 2011). Unlike in error
//! diffusion, a pixel depends on no other pixel, so lines may come in any order.

use super::quantize::{encode_srgb, light_of_srgb};
use super::{Light16, Quantizer};

/// The pixels whose mean is the light.
const PARTS: u32 = 16;

/// The colors that a panel can show, 2 to 255 of them, for [`Quantizer::nearest_of`].
///
/// ```
/// use embedded_graphics::pixelcolor::{PixelColor, raw::RawU2};
/// use rayline::{DisplayColor, Light16, Palette, Quantizer};
///
/// /// Ink of an e-paper: its number in the palette.
/// #[derive(Clone, Copy, PartialEq)]
/// struct Ink(u8);
///
/// static INKS: Palette<3> = Palette::BLACK_WHITE_RED;
///
/// impl PixelColor for Ink {
///     type Raw = RawU2;
/// }
///
/// impl DisplayColor for Ink {
///     fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
///         Self(quantizer.nearest_of(light, &INKS))
///     }
/// }
/// # let settings = rayline::Settings::new(1, 1);
/// # let red = Light16 { r: 40_000, g: 1000, b: 1000 };
/// # assert!(Ink::from_light(red, &Quantizer::new(&settings, 0, 0)) == Ink(2));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Palette<const N: usize> {
    colors: [[u8; 3]; N],
    /// The light of each color.
    lights: [Light16; N],
    /// The numbers of the colors, from dark to bright.
    order: [u8; N],
}

impl Palette<3> {
    /// Black, white, and the red of e-paper.
    pub const BLACK_WHITE_RED: Self = Self::new([[20, 20, 22], [235, 235, 230], [190, 25, 30]]);
    /// Black, white, and the yellow of e-paper.
    pub const BLACK_WHITE_YELLOW: Self = Self::new([[20, 20, 22], [235, 235, 230], [235, 190, 20]]);
}

impl Palette<4> {
    /// Black, white, yellow and red.
    pub const BLACK_WHITE_YELLOW_RED: Self =
        Self::new([[20, 20, 22], [235, 235, 230], [235, 190, 20], [190, 25, 30]]);
}

impl<const N: usize> Palette<N> {
    /// Of colors as they look on the panel: red, green and blue in sRGB. Their numbers are their positions.
    #[allow(clippy::indexing_slicing)] // evaluated by the compiler
    pub const fn new(colors: [[u8; 3]; N]) -> Self {
        const { assert!(N >= 2 && N <= 255, "a palette has 2 to 255 colors") };
        let (mut lights, mut order) = ([Light16::BLACK; N], [0; N]);
        let mut i = 0;
        while i < N {
            let [r, g, b] = colors[i];
            lights[i] = Light16 { r: light_of(r), g: light_of(g), b: light_of(b) };
            // Insert the color behind the darker ones.
            let mut place = i;
            while place > 0 && brightness(lights[order[place - 1] as usize]) > brightness(lights[i]) {
                order[place] = order[place - 1];
                place -= 1;
            }
            order[place] = i as u8;
            i += 1;
        }
        Self { colors, lights, order }
    }

    /// Red, green and blue of the color of this number, or of color 0 if there is none.
    pub fn color(&self, number: u8) -> [u8; 3] {
        self.colors.get(usize::from(number)).or(self.colors.first()).copied().unwrap_or_default()
    }

    /// The number of the nearest of some colors.
    fn nearest(colors: impl Iterator<Item = [i32; 3]>, wanted: [i32; 3]) -> u8 {
        let (mut nearest, mut least) = (0, u32::MAX);
        for (number, color) in colors.enumerate() {
            let distance = distance(color, wanted);
            if distance < least {
                (nearest, least) = (number as u8, distance);
            }
        }
        nearest
    }

    /// How many of [`PARTS`] pixels have each color, so that their mean is the light.
    fn parts(&self, light: Light16) -> [u8; N] {
        let light = channels(light);
        let (mut parts, mut lacking) = ([0u8; N], [0i32; 3]);
        for _ in 0..PARTS {
            let add = |i: usize| light.get(i).copied().unwrap_or(0) + lacking.get(i).copied().unwrap_or(0);
            // A lack that no mixture can fill would grow without end.
            let wanted = [add(0), add(1), add(2)].map(|channel| channel.clamp(-WHOLE, 2 * WHOLE));
            let number = usize::from(Self::nearest(self.lights.into_iter().map(channels), wanted));
            if let (Some(part), Some(color)) = (parts.get_mut(number), self.lights.get(number)) {
                *part += 1;
                let [r, g, b] = wanted;
                let [red, green, blue] = channels(*color);
                lacking = [r - red, g - green, b - blue];
            }
        }
        parts
    }
}

impl Quantizer {
    /// The number of the color of a palette for light: the nearest, or if
    /// [`Settings::dither`](super::Settings::dither) says so, one of a pattern with the mean of the light.
    ///
    /// Colors are mixed as light, whatever [`Settings::transfer`](super::Settings::transfer) is.
    pub fn nearest_of<const N: usize>(&self, light: Light16, palette: &Palette<N>) -> u8 {
        let light = Light16 { r: light.r.min(65536), g: light.g.min(65536), b: light.b.min(65536) };
        let Some(threshold) = self.dithers_by() else {
            let Light16 { r, g, b } = light;
            let codes = palette.colors.into_iter().map(|color| color.map(code_of));
            return Palette::<N>::nearest(codes, [r, g, b].map(|light| encode_srgb(light) as i32));
        };
        let mut place = (threshold * PARTS) >> 16;
        let parts = palette.parts(light);
        let mut last = 0;
        for number in palette.order {
            let part = u32::from(parts.get(usize::from(number)).copied().unwrap_or(0));
            last = number;
            match place.checked_sub(part) {
                Some(left) => place = left,
                None => break,
            }
        }
        last
    }
}

/// Full light.
const WHOLE: i32 = 65536;

fn channels(Light16 { r, g, b }: Light16) -> [i32; 3] {
    [r as i32, g as i32, b as i32]
}

/// The squared distance of two colors. With the weights of luminance, yellow would stand for light gray.
fn distance(color: [i32; 3], wanted: [i32; 3]) -> u32 {
    let mut sum = 0;
    for (channel, wanted) in color.into_iter().zip(wanted) {
        // At most 2 · 65536 / 16, whose square times 3 fits.
        let way = (channel - wanted).unsigned_abs() >> 4;
        sum += way * way;
    }
    sum
}

const fn brightness(Light16 { r, g, b }: Light16) -> u32 {
    3 * r + 6 * g + b
}

/// The sRGB code, 0 to 65536, of one from 0 to 255.
fn code_of(byte: u8) -> i32 {
    i32::from(byte) * 257 + i32::from(byte >> 7)
}

const fn light_of(byte: u8) -> u32 {
    light_of_srgb(byte as f64 / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::{Dither, Settings};

    const INKS: Palette<4> = Palette::BLACK_WHITE_YELLOW_RED;

    fn mean(settings: &Settings, light: Light16) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (x, y) in (0..64).flat_map(|y| (0..64).map(move |x| (x, y))) {
            let number = Quantizer::new(settings, x, y).nearest_of(light, &INKS);
            let color = channels(INKS.lights[usize::from(number)]);
            sum.iter_mut().zip(color).for_each(|(sum, channel)| *sum += f64::from(channel) / 4096.0);
        }
        sum
    }

    /// Light that the panel can mix has its own mean, in every pattern.
    #[test]
    fn patterns_keep_the_mean_of_light() {
        for dither in [Dither::Ordered, Dither::Stippling, Dither::Hatching, Dither::BlueNoise] {
            let settings = Settings { dither, ..Settings::new(64, 64) };
            for shares in [[8, 8, 0, 0], [4, 4, 4, 4], [1, 13, 2, 0], [3, 3, 0, 10], [15, 0, 1, 0]] {
                let mut light = [0; 3];
                for (share, color) in shares.into_iter().zip(INKS.lights) {
                    light.iter_mut().zip(channels(color)).for_each(|(sum, c)| *sum += share * c / 16);
                }
                let [r, g, b] = light.map(|channel| channel as u32);
                for (mean, light) in mean(&settings, Light16 { r, g, b }).into_iter().zip(light) {
                    let error = (mean - f64::from(light)).abs() / 65536.0;
                    // Parts are sixteenths.
                    assert!(error < 0.04, "{dither:?}, {shares:?}: {error}");
                }
            }
        }
    }

    #[test]
    fn colors_of_the_palette_are_themselves() {
        for dither in [Dither::None, Dither::Ordered, Dither::BlueNoise] {
            let settings = Settings { dither, ..Settings::new(64, 64) };
            for (number, light) in INKS.lights.into_iter().enumerate() {
                for (x, y) in [(0, 0), (1, 0), (13, 7), (63, 63)] {
                    let found = Quantizer::new(&settings, x, y).nearest_of(light, &INKS);
                    assert_eq!(usize::from(found), number, "{dither:?}");
                }
            }
        }
        assert_eq!(INKS.order, [0, 3, 2, 1]);
    }

    /// Not dithered, a gray is black or white by what the eye sees: the middle is at a fifth of the light.
    #[test]
    fn the_nearest_color_is_the_nearest_to_the_eye() {
        let quantizer = Quantizer::new(&Settings::new(1, 1), 0, 0);
        let of = |light: f64| quantizer.nearest_of(Light16::gray((light * 65536.0) as u32), &INKS);
        assert_eq!([0.0, 0.1, 0.3, 1.0].map(of), [0, 0, 1, 1]);
        // A program may make light beyond the range.
        assert_eq!(quantizer.nearest_of(Light16::gray(u32::MAX), &INKS), 1);
    }
}
