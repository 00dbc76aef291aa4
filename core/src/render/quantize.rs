//! From linear light to the levels of a display, in integers: the same bytes on every processor.

use super::settings::{Dither, Settings, Transfer};
#[cfg(feature = "looks")]
use super::thresholds;
use crate::color::LinearRgb;
use crate::math::Real;

/// Light at a pixel, clamped to the range of a display: in each channel, 0 is black and 65536 is full
/// light. A channel has 17 bits: 2¹⁶ parts, and full light itself.
///
/// A renderer makes no light above 65536. In light that a program makes itself, a higher number counts as
/// full light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Light16 {
    /// Red, 0 to 65536.
    pub r: u32,
    /// Green, 0 to 65536.
    pub g: u32,
    /// Blue, 0 to 65536.
    pub b: u32,
}

impl Light16 {
    /// No light.
    pub const BLACK: Self = Self { r: 0, g: 0, b: 0 };

    /// The same light in all channels.
    pub(super) const fn gray(light: u32) -> Self {
        Self { r: light, g: light, b: light }
    }

    /// A mixture: this share of other light, in 32768ths, and the rest of this one.
    pub(super) fn mixed(self, other: Self, share: u32) -> Self {
        // At most 65536 · 32768, which fits in 32 bits.
        let mix = |a: u32, b: u32| (a * 32768u32.saturating_sub(share) + b * share) >> 15;
        Self { r: mix(self.r, other.r), g: mix(self.g, other.g), b: mix(self.b, other.b) }
    }

    /// Light that a display can show.
    pub(super) fn clamped(self) -> Self {
        let [r, g, b] = [self.r, self.g, self.b].map(|channel| channel.min(65536));
        Self { r, g, b }
    }

    /// Clamps light to the range of a display.
    pub(super) fn new<R: Real>(light: LinearRgb<R>) -> Self {
        Self { r: light.r.to_q16(), g: light.g.to_q16(), b: light.b.to_q16() }
    }

    /// The luminance, 0 to 65536 (ITU-R BT.709: 0.2126 R + 0.7152 G + 0.0722 B).
    #[inline]
    pub fn luminance(&self) -> u32 {
        // The compiler leaves this out for light that a renderer makes.
        let [r, g, b] = [self.r, self.g, self.b].map(|channel| channel.min(65536));
        // The weights in units of 1/32768, so that the sum fits in 32 bits: they add up to 32768.
        (r * 6966 + g * 23436 + b * 2366 + 0x4000) >> 15
    }
}

/// Makes the levels of a display from light, for one pixel.
#[derive(Clone, Copy, Debug)]
pub struct Quantizer {
    transfer: Transfer,
    /// The part of a level, in units of 1/65536, that is added before rounding down.
    threshold: u32,
}

impl Quantizer {
    /// For pixel (x, y) of a picture.
    pub fn new(settings: &Settings, x: u16, y: u16) -> Self {
        let threshold = match settings.dither {
            Dither::None => 0x8000,
            Dither::Ordered => bayer(x, y) * 1024 + 512,
            #[cfg(feature = "looks")]
            Dither::Stippling => thresholds::stippling(x, y),
            #[cfg(feature = "looks")]
            Dither::Hatching => thresholds::hatching(x, y),
            #[cfg(feature = "looks")]
            Dither::BlueNoise => thresholds::blue_noise(x, y),
        };
        Self { transfer: settings.transfer, threshold }
    }

    /// The level, 0 to `most`, of a display that has `most + 1`, for light from 0 to 65536.
    #[inline]
    pub fn level(&self, light: u32, most: u8) -> u8 {
        let code = encode(light.min(65536), self.transfer);
        ((code * u32::from(most) + self.threshold) >> 16) as u8
    }

    /// The threshold of the pixel, 0 to 65535; `None` if it is that of the nearest level.
    #[cfg(feature = "looks")]
    pub(super) const fn dithers_by(&self) -> Option<u32> {
        if self.threshold == 0x8000 { None } else { Some(self.threshold) }
    }

    /// Rounds to the nearest level, for any pixel.
    pub(super) const fn nearest(transfer: Transfer) -> Self {
        Self { transfer, threshold: 0x8000 }
    }

    /// The level of a channel of a tone: the [`level`](Self::level) of the light from which
    /// [`tone_of`](super::tone::tone_of) made it.
    #[inline]
    pub(super) const fn cut<const BITS: u32>(&self, tone: u16) -> u8 {
        let dithered =
            (tone as u32).wrapping_add(((self.threshold.wrapping_sub(0x8000) as i32) >> BITS) as u32);
        (dithered >> (16 - BITS)) as u8
    }
}

/// The position of a pixel, 0 to 63, in the order in which Bayer's 8×8 matrix turns pixels on: the bits of
/// x ^ y and of y, interleaved, lowest bit first.
fn bayer(x: u16, y: u16) -> u32 {
    let (a, b) = (u32::from(x ^ y), u32::from(y));
    (a & 1) << 5 | (b & 1) << 4 | (a & 2) << 2 | (b & 2) << 1 | (a & 4) >> 1 | (b & 4) >> 2
}

/// Segments of the tone curve.
const SEGMENTS: usize = 512;
/// The light of a segment.
const SEGMENT: u32 = 65536 / SEGMENTS as u32;

/// The sRGB curve at every 512th part of the range, in units of 1/65535: 1 KB of flash. Between these
/// points it is interpolated, with an error below 0.2 of 255 levels.
static SRGB: [u16; SEGMENTS + 1] = srgb_curve();

const fn srgb_curve() -> [u16; SEGMENTS + 1] {
    let mut curve = [0; SEGMENTS + 1];
    let mut i = 0;
    while i <= SEGMENTS {
        let light = i as f64 / SEGMENTS as f64;
        let code = if light <= 0.003_130_8 {
            light * 12.92
        } else {
            // light^(1/2.4) = y with y¹² = light⁵: Newton's method from above.
            let target = light * light * light * light * light;
            let mut y = 1.0;
            let mut step = 0;
            while step < 100 {
                let y2 = y * y;
                let y4 = y2 * y2;
                let y11 = y4 * y4 * y2 * y;
                y -= (y11 * y - target) / (12.0 * y11);
                step += 1;
            }
            1.055 * y - 0.055
        };
        #[allow(clippy::indexing_slicing)] // evaluated by the compiler
        {
            curve[i] = (code * 65535.0 + 0.5) as u16;
        }
        i += 1;
    }
    curve
}

/// The code, 0 to 65536, of light from 0 to 65536.
#[inline]
pub(super) fn encode(light: u32, curve: Transfer) -> u32 {
    match curve {
        Transfer::Linear => light,
        Transfer::Srgb => encode_srgb(light),
    }
}

/// The sRGB code, 0 to 65536, of light from 0 to 65536.
pub(super) fn encode_srgb(light: u32) -> u32 {
    let (position, along) = ((light / SEGMENT) as usize, light % SEGMENT);
    match SRGB.get(position..) {
        Some([below, above, ..]) => {
            let (below, above) = (u32::from(*below), u32::from(*above));
            let code = below + (above - below) * along / SEGMENT;
            code + (code >> 15)
        }
        _ => 65536,
    }
}

/// Segments of the inverse of the tone curve.
const INVERSE_SEGMENTS: usize = 64;
/// The codes of a segment.
const INVERSE_SEGMENT: u32 = 65536 / INVERSE_SEGMENTS as u32;

/// The light of every 64th part of the sRGB codes, in units of 1/65536: 260 bytes of flash, in programs with
/// smooth edges. Between these points it is interpolated, with an error below 4 units.
static INVERSE_SRGB: [u32; INVERSE_SEGMENTS + 1] = inverse_srgb_curve();

const fn inverse_srgb_curve() -> [u32; INVERSE_SEGMENTS + 1] {
    let mut curve = [0; INVERSE_SEGMENTS + 1];
    let mut i = 0;
    while i <= INVERSE_SEGMENTS {
        #[allow(clippy::indexing_slicing)] // evaluated by the compiler
        {
            curve[i] = light_of_srgb(i as f64 / INVERSE_SEGMENTS as f64);
        }
        i += 1;
    }
    curve
}

/// The light, 0 to 65536, of an sRGB code from 0 to 1. For constants: it is slow.
pub(super) const fn light_of_srgb(code: f64) -> u32 {
    let light = if code <= 0.040_45 {
        code / 12.92
    } else {
        // y = x^(12/5) with y⁵ = x¹²: Newton's method from above.
        let x = (code + 0.055) / 1.055;
        let x3 = x * x * x;
        let target = x3 * x3 * x3 * x3;
        let mut y = 1.0;
        let mut step = 0;
        while step < 100 {
            let y4 = y * y * y * y;
            y -= (y4 * y - target) / (5.0 * y4);
            step += 1;
        }
        y
    };
    (light * 65536.0 + 0.5) as u32
}

/// The light, 0 to 65536, of an sRGB code from 0 to 65536.
pub(super) fn decode_srgb(code: u32) -> u32 {
    let (position, along) = ((code / INVERSE_SEGMENT) as usize, code % INVERSE_SEGMENT);
    match INVERSE_SRGB.get(position..) {
        Some([below, above, ..]) => below + (above - below) * along / INVERSE_SEGMENT,
        _ => 65536,
    }
}

#[cfg(test)]
mod tests {
    use super::super::tone::tone_of;
    use super::*;

    #[test]
    fn srgb_is_within_a_fifth_of_a_code() {
        for light in 0..=65536u32 {
            let linear = f64::from(light) / 65536.0;
            let exact =
                if linear <= 0.0031308 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
            let error = (f64::from(encode_srgb(light)) / 65536.0 - exact).abs() * 255.0;
            assert!(error < 0.2, "{light} is off by {error}");
        }
        assert_eq!((encode_srgb(0), encode_srgb(65536)), (0, 65536));
    }

    #[test]
    fn levels_are_rounded_to_nearest() {
        let quantizer = Quantizer { transfer: Transfer::Linear, threshold: 0x8000 };
        for most in [1u8, 15, 31, 63, 255] {
            for light in 0..=65536u32 {
                let exact = f64::from(light) / 65536.0 * f64::from(most);
                assert_eq!(quantizer.level(light, most), (exact + 0.5).floor() as u8);
            }
        }
    }

    #[test]
    fn tones_have_the_levels_of_their_light() {
        fn check<const BITS: u32>(quantizer: Quantizer) {
            for light in 0..=65536u32 {
                let level = quantizer.level(light, ((1u32 << BITS) - 1) as u8);
                assert_eq!(
                    quantizer.cut::<BITS>(tone_of(light, BITS as u8, quantizer.transfer)),
                    level,
                    "{light}, {BITS} bits"
                );
            }
        }
        for transfer in [Transfer::Srgb, Transfer::Linear] {
            for threshold in [0x8000, 512, 63 * 1024 + 512, 17 * 1024 + 512] {
                let quantizer = Quantizer { transfer, threshold };
                check::<1>(quantizer);
                check::<4>(quantizer);
                check::<5>(quantizer);
                check::<6>(quantizer);
                check::<8>(quantizer);
            }
        }
    }

    #[test]
    fn mixtures_have_the_share_of_each_light() {
        let (dark, bright) = (Light16::gray(1000), Light16 { r: 65536, g: 0, b: 3000 });
        assert_eq!(dark.mixed(bright, 0), dark);
        assert_eq!(dark.mixed(bright, 32768), bright);
        assert_eq!(dark.mixed(bright, 8192), Light16 { r: 17134, g: 750, b: 1500 });
    }

    #[test]
    fn every_place_of_the_matrix_is_taken_once() {
        let mut seen = [false; 64];
        for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (x, y))) {
            assert!(!core::mem::replace(&mut seen[bayer(x, y) as usize], true));
        }
        // The first row of the classic matrix.
        assert_eq!([0, 1, 2, 3, 4, 5, 6, 7].map(|x| bayer(x, 0)), [0, 32, 8, 40, 2, 34, 10, 42]);
    }

    #[test]
    fn dithering_keeps_the_mean() {
        let settings =
            Settings { dither: Dither::Ordered, transfer: Transfer::Linear, ..Settings::new(8, 8) };
        for sixtyfourths in 0..=64u32 {
            let on: u32 = (0..8u16)
                .flat_map(|y| (0..8u16).map(move |x| (x, y)))
                .map(|(x, y)| u32::from(Quantizer::new(&settings, x, y).level(sixtyfourths * 1024, 1)))
                .sum();
            assert_eq!(on, sixtyfourths);
        }
    }

    #[test]
    fn luminance_of_white_is_full() {
        assert_eq!(Light16 { r: 65536, g: 65536, b: 65536 }.luminance(), 65536);
        assert_eq!(Light16 { r: 0, g: 65536, b: 0 }.luminance(), 46872);
    }

    /// The sum went beyond 32 bits.
    #[test]
    fn more_than_full_light_is_full() {
        assert_eq!(Light16 { r: u32::MAX, g: 65537, b: 1 << 20 }.luminance(), 65536);
        assert_eq!(Light16 { r: 0, g: 1 << 24, b: 0 }.luminance(), 46872);
        // A renderer makes no such light.
        let of = |r| Light16::new(LinearRgb { r, g: 0.5, b: -1.0 });
        for (red, expected) in [(f32::INFINITY, 65536), (1e30, 65536), (1.0, 65536), (f32::NAN, 0)] {
            assert_eq!(of(red), Light16 { r: expected, g: 32768, b: 0 });
        }
    }
}
