//! The record of one pixel that is kept while its surroundings are drawn.

use crate::render::Tone;

/// The record of one pixel, in 8 bytes: its tone, and two digests of what its rays met. Realtime quality is
/// lent a row of samples, see [`Realtime::samples`](super::Realtime::samples).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    /// The tone's first two channels.
    pair: u32,
    /// Flags and digests in the upper half, the tone's third channel in the lower.
    rest: u32,
}

/// Flag: the pixel was traced, not interpolated.
const TRACED: u32 = 1 << 31;
/// Flag: something is near that interpolation could lose: a small highlight, a tip, or a low shadow.
const GLINT: u32 = 1 << 30;
/// Bits of the [`PathDigest`]: 7 bits that are never all 0.
const PATH: u32 = ((1 << 7) - 1) << 16;
/// Bits of the digest of what stood between the hits and the lights: 7 bits. All of them are 1 for
/// [`Near::Tiny`].
const SHADE: u32 = ((1 << 14) - 1) << 16 ^ PATH;

/// An unknown pixel.
impl Default for Sample {
    fn default() -> Self {
        Self::BLANK
    }
}

/// A digest of the objects that a pixel's rays met, cut to the 7 bits that a sample keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PathDigest(u32);

impl PathDigest {
    /// From a digest of 32 bits.
    pub(super) fn new(digest: u32) -> Self {
        // The upper bits depend on all that was folded into the digest.
        let digest = digest >> 6 & PATH;
        Self(if digest == 0 { PATH } else { digest })
    }
}

/// Small things near a pixel that interpolation could lose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Near {
    /// Nothing that is known.
    Nothing,
    /// A small highlight: pixels between two such points are traced down to every second one.
    Glint,
    /// Something so small that it may lie between all pixels of the grid: every pixel around is traced.
    Tiny,
}

impl Sample {
    /// An unknown pixel, to fill memory that is lent.
    pub const BLANK: Self = Self { pair: 0, rest: 0 };

    /// Bits of [`marks_differ`](Self::marks_differ): both digests.
    pub(super) const DIGESTS: u32 = PATH | SHADE;

    /// A traced pixel. `shade` is a digest of 32 bits of what stood before the lights.
    pub(super) fn traced(tone: Tone, path: PathDigest, shade: u32, near: Near) -> Self {
        let marks = match near {
            Near::Nothing => shade >> 2 & SHADE,
            Near::Glint => GLINT | shade >> 2 & SHADE,
            Near::Tiny => GLINT | SHADE,
        };
        Self { pair: tone.pair(), rest: TRACED | marks | path.0 | u32::from(tone.third()) }
    }

    /// An interpolated pixel of this tone, with the digests of `self`.
    #[inline]
    pub(super) fn with_tone(self, tone: Tone) -> Self {
        Self { pair: tone.pair(), rest: self.rest & (GLINT | PATH | SHADE) | u32::from(tone.third()) }
    }

    /// A copy of this pixel that counts as not traced.
    #[inline]
    pub(super) fn untraced(self) -> Self {
        Self { rest: self.rest & !TRACED, ..self }
    }

    /// This pixel, marked as near a small highlight. Pixels near other small things are marked in the same
    /// way.
    pub(super) fn marked_near_glint(self) -> Self {
        Self { rest: self.rest | GLINT, ..self }
    }

    /// Whether this is more than [`BLANK`](Self::BLANK).
    pub(super) fn is_known(self) -> bool {
        self.rest & PATH != 0
    }

    /// Whether the pixel was traced, not interpolated or copied.
    pub(super) fn is_traced(self) -> bool {
        self.rest & TRACED != 0
    }

    /// The digest of what its rays met: objects, their parts and checks, and the background.
    pub(super) fn path(self) -> PathDigest {
        PathDigest(self.rest & PATH)
    }

    /// Whether two pixels have the same digest of what stood before the lights.
    pub(super) fn is_shaded_like(self, other: Self) -> bool {
        (self.rest ^ other.rest) & SHADE == 0
    }

    /// The color, on the display's scale.
    #[inline]
    pub(super) fn tone(self) -> Tone {
        Tone::of_pair(self.pair, self.rest as u16)
    }

    /// Whether two pixels differ in any of the bits `marks`, which are [`DIGESTS`](Self::DIGESTS) or none.
    #[inline]
    pub(super) fn marks_differ(self, other: Self, marks: u32) -> bool {
        (self.rest ^ other.rest) & marks != 0
    }

    /// Whether at least one of two pixels is near a small highlight.
    #[inline]
    pub(super) fn either_near_glint(self, other: Self) -> bool {
        (self.rest | other.rest) & GLINT != 0
    }

    /// Whether both pixels are near a small highlight.
    #[inline]
    pub(super) fn both_near_glint(self, other: Self) -> bool {
        self.rest & other.rest & GLINT != 0
    }

    /// Whether something tiny is near. One in 128 pixels near a small highlight has the same bits by chance,
    /// and its surroundings are traced for nothing.
    pub(super) fn is_near_tiny(self) -> bool {
        self.rest & (GLINT | SHADE) == GLINT | SHADE
    }

    /// Whether the tones differ by more than `threshold` in a channel.
    #[inline]
    pub(super) fn differs_in_color(self, other: Self, threshold: u16) -> bool {
        self.tone().differs(other.tone(), threshold)
    }

    /// The interpolated pixel that is this many quarters of the way from here to `other`.
    pub(super) fn toward(self, other: Self, quarters: usize) -> Self {
        let mut tone = self.tone();
        let step = tone.step_toward(other.tone(), 2);
        for _ in 0..quarters {
            tone = tone.after(step);
        }
        self.with_tone(tone)
    }

    /// The interpolated pixel halfway from here to `other`.
    pub(super) fn middle(self, other: Self) -> Self {
        self.with_tone(self.tone().middle(other.tone()))
    }
}
