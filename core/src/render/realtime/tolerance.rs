//! The difference between two pixels up to which the pixels between them are interpolated.

use super::budget::Detail;
use super::sample::Sample;

/// The difference between two pixels up to which the pixels between them are interpolated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerance {
    /// The bits of a sample's digests that must be the same: all or none.
    marks: u32,
    /// The largest difference of tones for pixels more than two pixels apart.
    far: u16,
    /// The largest difference of tones for pixels up to two pixels apart.
    near: u16,
    /// The largest difference of tones near a small highlight.
    glint: u16,
    /// Whether any pixels but those of the grid are traced.
    traces: bool,
    /// The distance of the grid's pixels.
    grid: usize,
}

impl Tolerance {
    /// Everything between the pixels of the grid is interpolated.
    pub(super) const NONE: Self =
        Self { marks: 0, far: u16::MAX, near: u16::MAX, glint: u16::MAX, traces: false, grid: 0 };

    /// `threshold` is that of [`Realtime`](super::Realtime), `grid` the distance of the grid's pixels.
    pub(super) fn new(threshold: u16, detail: Detail, grid: usize) -> Self {
        match detail {
            // Two pixels apart, more is allowed, as one pixel at most is wrong. Near a small highlight, less
            // is allowed, as it may just begin.
            Detail::Full => Self {
                marks: Sample::DIGESTS,
                far: threshold,
                near: threshold.saturating_add(threshold / 2),
                glint: threshold / 4,
                traces: true,
                grid,
            },
            Detail::Coarse => {
                let far = threshold.saturating_mul(4);
                Self { marks: 0, far, near: far, glint: far, traces: true, grid }
            }
            Detail::Grid => Self::NONE,
        }
    }

    /// Whether two pixels at this distance differ so much that something may lie between them.
    #[inline]
    pub(super) fn differ(&self, a: Sample, b: Sample, distance: usize) -> bool {
        if a.marks_differ(b, self.marks) {
            return true;
        }
        let limit = if a.either_near_glint(b) {
            if self.is_full() && (distance >= self.grid || distance > 2 && a.both_near_glint(b)) {
                return true;
            }
            self.glint
        } else if distance > 2 {
            self.far
        } else {
            self.near
        };
        a.differs_in_color(b, limit)
    }

    /// Whether any pixels but those of the grid are traced.
    pub(super) fn may_trace(&self) -> bool {
        self.traces
    }

    /// Whether pixels are compared by their digests too: [`Detail::Full`].
    #[inline]
    pub(super) fn is_full(&self) -> bool {
        self.marks != 0
    }
}
