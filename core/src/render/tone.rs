//! Tones: light on the scale of a display, finer than its levels. Realtime quality interpolates them.

use super::quantize::{decode_srgb, encode};
use super::{Light16, Transfer};

/// Light on the scale of a display, after its tone curve and finer than its levels, in up to three channels
/// of 16 bits.
///
/// Realtime quality interpolates tones, which takes two additions a pixel. To interpolate light would take
/// the tone curve for each pixel. A [`ToneScale`] makes tones of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tone {
    /// The first channel in the upper half, the second in the lower: one addition for both.
    pair: u32,
    third: u32,
}

impl Tone {
    /// A tone of three channels, 0 to 65535.
    #[inline]
    pub const fn new(first: u16, second: u16, third: u16) -> Self {
        Self { pair: (first as u32) << 16 | second as u32, third: third as u32 }
    }

    /// The first channel.
    #[inline]
    pub const fn first(self) -> u16 {
        (self.pair >> 16) as u16
    }

    /// The second channel.
    #[inline]
    pub const fn second(self) -> u16 {
        self.pair as u16
    }

    /// The third channel.
    #[inline]
    pub const fn third(self) -> u16 {
        self.third as u16
    }

    /// The first two channels.
    #[inline]
    pub(super) const fn pair(self) -> u32 {
        self.pair
    }

    #[inline]
    pub(super) const fn of_pair(pair: u32, third: u16) -> Self {
        Self { pair, third: third as u32 }
    }

    /// The tone whose channels are those of light, at most 65535.
    #[inline]
    pub(super) fn from_light(light: Light16) -> Self {
        let channel = |light: u32| u16::try_from(light).unwrap_or(u16::MAX);
        Self::new(channel(light.r), channel(light.g), channel(light.b))
    }

    /// The tone's channels as light.
    #[inline]
    pub(super) fn to_light(self) -> Light16 {
        Light16 { r: self.first().into(), g: self.second().into(), b: self.third().into() }
    }

    /// The step that leads from this tone to `other` in 2^`shift` steps.
    #[inline]
    pub(super) fn step_toward(self, other: Self, shift: u32) -> Step {
        // Rounded toward zero, so that no channel leaves the range between the two tones.
        let part = |from: u32, to: u32| {
            let way = to.wrapping_sub(from) as i32;
            (way.wrapping_add((way >> 31) & ((1 << shift) - 1)) >> shift) as u32
        };
        let first = part(self.pair >> 16, other.pair >> 16);
        let second = part(self.pair & 0xFFFF, other.pair & 0xFFFF);
        Step { pair: (first << 16).wrapping_add(second), third: part(self.third, other.third) }
    }

    /// The tone after this step.
    #[inline]
    pub(super) fn after(self, step: Step) -> Self {
        // A carry between the channels of a pair cancels out in a sum of several steps.
        Self { pair: self.pair.wrapping_add(step.pair), third: self.third.wrapping_add(step.third) }
    }

    /// The tone halfway between two tones.
    #[inline]
    pub(super) fn middle(self, other: Self) -> Self {
        let half = |a: u16, b: u16| ((u32::from(a) + u32::from(b)) >> 1) as u16;
        Self::new(
            half(self.first(), other.first()),
            half(self.second(), other.second()),
            half(self.third(), other.third()),
        )
    }

    /// Whether any channel differs by more than `threshold`.
    #[inline]
    pub(super) fn differs(self, other: Self, threshold: u16) -> bool {
        self.first().abs_diff(other.first()) > threshold
            || self.second().abs_diff(other.second()) > threshold
            || self.third().abs_diff(other.third()) > threshold
    }
}

/// The scale of a display's tones: what their channels are. See
/// [`DisplayColor::TONES`](super::DisplayColor::TONES).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ToneScale(Channels);

/// The channels of a tone, with the bits of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Channels {
    Light,
    Rgb([u8; 3]),
    Luminance(u8),
}

impl ToneScale {
    /// Red, green and blue light itself. For displays whose levels are no even steps of a tone curve.
    pub const LIGHT: Self = Self(Channels::Light);

    /// Even steps of red, green and blue after the tone curve: the bits of each, 1 to 8.
    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self(Channels::Rgb([bits(r), bits(g), bits(b)]))
    }

    /// Even steps of luminance after the tone curve: its bits, 1 to 8.
    pub const fn luminance(count: u8) -> Self {
        Self(Channels::Luminance(bits(count)))
    }

    /// The tone of light on a display of this tone curve.
    pub(super) fn tone(self, light: Light16, curve: Transfer) -> Tone {
        match self.0 {
            Channels::Light => Tone::from_light(light),
            Channels::Rgb([r, g, b]) => {
                Tone::new(tone_of(light.r, r, curve), tone_of(light.g, g, curve), tone_of(light.b, b, curve))
            }
            Channels::Luminance(bits) => Tone::new(0, tone_of(light.luminance(), bits, curve), 0),
        }
    }

    /// The tone of a mixture of light: this share of `other`, in 32768ths, and the rest of a tone's light.
    /// Smooth edges ([`Edges::Smooth`](super::Edges::Smooth)) and contours are such mixtures.
    #[cfg_attr(not(any(feature = "distributed", feature = "looks")), allow(dead_code))]
    pub(super) fn mixed(self, tone: Tone, other: Light16, share: u32, curve: Transfer) -> Tone {
        self.tone(self.light(tone, curve).mixed(other, share), curve)
    }

    /// The light of a tone, as exact as the bits of the tone.
    pub(super) fn light(self, tone: Tone, curve: Transfer) -> Light16 {
        match self.0 {
            Channels::Light => tone.to_light(),
            Channels::Rgb([r, g, b]) => Light16 {
                r: light_of(tone.first(), r, curve),
                g: light_of(tone.second(), g, curve),
                b: light_of(tone.third(), b, curve),
            },
            Channels::Luminance(bits) => Light16::gray(light_of(tone.second(), bits, curve)),
        }
    }
}

/// A channel of the tone of light from 0 to 65536, for a display of 1 to 8 `bits`: half a level is added,
/// because [`Quantizer::cut`](super::Quantizer::cut) rounds down.
pub(super) fn tone_of(light: u32, bits: u8, curve: Transfer) -> u16 {
    let code = encode(light, curve);
    // At most 65536 - 2^(16 - bits) + 2^(15 - bits).
    ((((code << bits) - code) >> bits) + (0x8000 >> bits)) as u16
}

/// The light from 0 to 65536 of a channel that [`tone_of`] made.
fn light_of(tone: u16, bits: u8, curve: Transfer) -> u32 {
    let code = u32::from(tone).saturating_sub(0x8000 >> bits) << bits;
    let code = code.checked_div((1 << bits) - 1).unwrap_or(code);
    match curve {
        Transfer::Linear => code.min(65536),
        Transfer::Srgb => decode_srgb(code),
    }
}

/// A number of bits, brought to 1 to 8.
const fn bits(count: u8) -> u8 {
    match count {
        0 => 1,
        1..=8 => count,
        _ => 8,
    }
}

/// The difference of two neighboring tones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Step {
    pair: u32,
    third: u32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_lead_from_one_tone_to_the_other() {
        let ends = [0u16, 1, 7, 500, 32768, 65535];
        for (from, to) in ends.iter().flat_map(|from| ends.iter().map(move |to| (*from, *to))) {
            let (start, end) = (Tone::new(from, to, from), Tone::new(to, from, to));
            for shift in 1..=3 {
                let step = start.step_toward(end, shift);
                let mut tone = start;
                for i in 1..=1u16 << shift {
                    tone = tone.after(step);
                    let exact =
                        i32::from(from) + (i32::from(to) - i32::from(from)) * i32::from(i) / (1 << shift);
                    assert!((i32::from(tone.first()) - exact).abs() <= 1 << shift, "{from} to {to}");
                    let least = if from < to { from } else { to };
                    let most = if from < to { to } else { from };
                    for channel in [tone.first(), tone.second(), tone.third()] {
                        assert!(channel >= least && channel <= most, "{from} to {to}");
                    }
                }
            }
        }
    }

    #[test]
    fn tones_keep_their_light() {
        for bits in [1, 4, 8] {
            for (light, curve) in
                (0..=65536).step_by(7).flat_map(|light| [(light, Transfer::Srgb), (light, Transfer::Linear)])
            {
                let again = light_of(tone_of(light, bits, curve), bits, curve);
                // A step of the tone is up to 2.3 steps of light, and the scale of few bits is shorter.
                let most = if bits == 1 { 12 } else { 8 };
                assert!(again.abs_diff(light) < most, "{light}: {again}, {bits} bits, {curve:?}");
            }
        }
    }

    #[test]
    fn scales_have_one_to_eight_bits() {
        assert_eq!(ToneScale::rgb(0, 8, 200), ToneScale::rgb(1, 8, 8));
        assert_eq!(ToneScale::luminance(9), ToneScale::luminance(8));
    }
}
