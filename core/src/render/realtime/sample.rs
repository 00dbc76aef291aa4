//! What is known of one pixel while its surroundings are refined.

use super::super::Light16;

/// What is known of one pixel: its light, and a digest of what it saw. Lent to the realtime mode in rows, see
/// [`Realtime::samples`](super::Realtime::samples).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    /// Light in units of 1/65536, at most 65535: on a display of up to 256 levels that looks like 65536.
    light: [u16; 3],
    /// Digest of what was seen, and flags above it.
    seen: u16,
}

/// It was traced, not interpolated.
const TRACED: u16 = 1 << 15;
/// A small highlight is near: interpolation could lose it.
const GLINT: u16 = 1 << 14;
const DIGEST: u16 = GLINT - 1;

impl Sample {
    /// Nothing known: to fill memory that is lent.
    pub const BLANK: Self = Self { light: [0; 3], seen: 0 };

    /// A traced pixel that saw this. Of `digest`, 14 bits count.
    pub(super) fn traced(light: Light16, digest: u16, near_glint: bool) -> Self {
        let channel = |light: u32| u16::try_from(light).unwrap_or(u16::MAX);
        let glint = if near_glint { GLINT } else { 0 };
        Self {
            light: [channel(light.r), channel(light.g), channel(light.b)],
            seen: TRACED | glint | digest & DIGEST,
        }
    }

    pub(super) fn is_traced(self) -> bool {
        self.seen & TRACED != 0
    }

    pub(super) fn light(self) -> Light16 {
        let [r, g, b] = self.light.map(u32::from);
        Light16 { r, g, b }
    }

    /// Whether something may lie between the two that a straight line between their colors would not show.
    pub(super) fn differs(self, other: Self, threshold: u16) -> bool {
        if (self.seen ^ other.seen) & DIGEST != 0 || (self.seen | other.seen) & GLINT != 0 {
            return true;
        }
        self.differs_in_color(other, threshold)
    }

    /// Whether the two are of different color.
    pub(super) fn differs_in_color(self, other: Self, threshold: u16) -> bool {
        let [r, g, b] = self.light;
        let [other_r, other_g, other_b] = other.light;
        let apart = |a: u16, b: u16| {
            // The eye, and the curve of sRGB, see ratios rather than differences: bright light may differ by more.
            let least = if a < b { a } else { b };
            u32::from(a.abs_diff(b)) > u32::from(threshold) + u32::from(least >> 4)
        };
        apart(r, other_r) || apart(g, other_g) || apart(b, other_b)
    }

    /// Halfway between two that do not differ.
    pub(super) fn middle(self, other: Self) -> Self {
        let [r, g, b] = self.light;
        let [other_r, other_g, other_b] = other.light;
        // Cannot overflow: half of two times 65535.
        let half = |a: u16, b: u16| ((u32::from(a) + u32::from(b)) >> 1) as u16;
        Self { light: [half(r, other_r), half(g, other_g), half(b, other_b)], seen: self.seen & !TRACED }
    }

    /// The light at places 0 to 2^`shift` - 1 of the way, 2^`shift` steps long, from here to there.
    pub(super) fn along(self, other: Self, step: u32, shift: u32) -> Self {
        let [r, g, b] = self.light;
        let [other_r, other_g, other_b] = other.light;
        let rest = (1u32 << shift).saturating_sub(step);
        // At most 65535 · 8.
        let mix = |a: u16, b: u16| ((u32::from(a) * rest + u32::from(b) * step) >> shift) as u16;
        Self { light: [mix(r, other_r), mix(g, other_g), mix(b, other_b)], seen: self.seen & !TRACED }
    }
}
