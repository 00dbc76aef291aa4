//! What is known of one pixel while its surroundings are refined.

use super::super::Tone;

/// What is known of one pixel: its tone, and digests of what it saw. Lent to the realtime mode in rows, see
/// [`Realtime::samples`](super::Realtime::samples).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    /// The tone's first two channels.
    pair: u32,
    /// Digests of what was seen, and flags, in the upper half; the tone's third channel in the lower.
    rest: u32,
}

/// It was traced, not interpolated.
const TRACED: u32 = 1 << 31;
/// A small highlight is near: interpolation could lose it.
const GLINT: u32 = 1 << 30;
/// Digest of what was met, on the way that light takes to the pixel: never 0.
const PATH: u32 = ((1 << 7) - 1) << 16;
/// Digest of what stood before the lights.
const SHADE: u32 = ((1 << 14) - 1) << 16 ^ PATH;

/// Digest of what a pixel met, of all that a sample keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Path(u32);

impl Path {
    pub(super) fn new(digest: u32) -> Self {
        // The upper bits depend on all that was folded.
        let digest = digest >> 6 & PATH;
        Self(if digest == 0 { PATH } else { digest })
    }
}

/// What a pixel is near, that interpolation could lose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Near {
    Nothing,
    /// A small highlight.
    Glint,
    /// Something that may lie between all pixels of a grid: what this pixel stands for is to be traced in full.
    Tiny,
}

impl Sample {
    /// Nothing known: to fill memory that is lent.
    pub const BLANK: Self = Self { pair: 0, rest: 0 };

    /// A traced pixel that met this.
    pub(super) fn traced(tone: Tone, path: Path, shade: u32, near: Near) -> Self {
        let marks = match near {
            Near::Nothing => shade >> 2 & SHADE,
            Near::Glint => GLINT | shade >> 2 & SHADE,
            Near::Tiny => GLINT | SHADE,
        };
        Self { pair: tone.pair(), rest: TRACED | marks | path.0 | u32::from(tone.third()) }
    }

    /// A pixel that was not traced, seen as this one.
    #[inline(always)]
    pub(super) fn like(self, tone: Tone) -> Self {
        Self { pair: tone.pair(), rest: self.rest & (GLINT | PATH | SHADE) | u32::from(tone.third()) }
    }

    /// A pixel like this one, but not traced.
    #[inline(always)]
    pub(super) fn again(self) -> Self {
        Self { rest: self.rest & !TRACED, ..self }
    }

    /// The same, near a small highlight or what is looked for as closely.
    pub(super) fn near_glint(self) -> Self {
        Self { rest: self.rest | GLINT, ..self }
    }

    pub(super) fn is_known(self) -> bool {
        self.rest & PATH != 0
    }

    pub(super) fn is_traced(self) -> bool {
        self.rest & TRACED != 0
    }

    pub(super) fn path(self) -> Path {
        Path(self.rest & PATH)
    }

    pub(super) fn is_shaded_like(self, other: Self) -> bool {
        (self.rest ^ other.rest) & SHADE == 0
    }

    #[inline(always)]
    pub(super) fn tone(self) -> Tone {
        Tone::of_pair(self.pair, self.rest as u16)
    }

    /// What was seen.
    pub(super) const SEEN: u32 = PATH | SHADE;

    /// Whether the two differ in any of these bits of what was seen.
    #[inline(always)]
    pub(super) fn marks_differ(self, other: Self, marks: u32) -> bool {
        (self.rest ^ other.rest) & marks != 0
    }

    /// Whether a small highlight may lie between the two.
    #[inline(always)]
    pub(super) fn is_near_glint(self, other: Self) -> bool {
        (self.rest | other.rest) & GLINT != 0
    }

    /// Whether one may lie near both.
    #[inline(always)]
    pub(super) fn are_near_glint(self, other: Self) -> bool {
        self.rest & other.rest & GLINT != 0
    }

    /// Whether something tiny may be near; one near a small highlight in 128 says so too.
    pub(super) fn is_near_tiny(self) -> bool {
        self.rest & (GLINT | SHADE) == GLINT | SHADE
    }

    /// Whether the two are of different color.
    #[inline(always)]
    pub(super) fn differs_in_color(self, other: Self, threshold: u16) -> bool {
        self.tone().differs(other.tone(), threshold)
    }

    /// So many quarters of the way between two that do not differ.
    pub(super) fn toward(self, other: Self, quarters: usize) -> Self {
        let mut tone = self.tone();
        let step = tone.step_toward(other.tone(), 2);
        for _ in 0..quarters {
            tone = tone.after(step);
        }
        self.like(tone)
    }

    /// Halfway between two that do not differ.
    pub(super) fn middle(self, other: Self) -> Self {
        self.like(self.tone().middle(other.tone()))
    }
}
