//! Tones: light on the scale of a display, finer than its levels. Realtime quality interpolates them.

use super::Light16;

/// Light on the scale of a display, after its tone curve and finer than its levels, in up to three channels
/// of 16 bits.
///
/// Realtime quality interpolates tones, which takes two additions a pixel. To interpolate light would take
/// the tone curve for each pixel. See [`DisplayColor::tone`](super::DisplayColor::tone).
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
}
