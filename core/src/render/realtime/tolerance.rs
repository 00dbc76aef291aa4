//! How much two pixels may differ before one looks between them.

use super::Sample;
use super::budget::Detail;

/// How much two pixels may differ before one looks between them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerance {
    /// Of what both saw, the bits that count.
    marks: u32,
    /// The most that their tones may differ: far apart, two pixels apart, and there near a small highlight.
    far: u16,
    near: u16,
    glint: u16,
    /// Whether anything but the pixels of the grid is traced.
    traces: bool,
    grid: usize,
}

impl Tolerance {
    /// Nothing between the pixels of the grid is looked at.
    pub(super) const NONE: Self =
        Self { marks: 0, far: u16::MAX, near: u16::MAX, glint: u16::MAX, traces: false, grid: 0 };

    pub(super) fn new(threshold: u16, detail: Detail, grid: usize) -> Self {
        match detail {
            // Two pixels away, more is allowed: it is wrong for one pixel. But a small highlight may just begin.
            Detail::Full => Self {
                marks: Sample::SEEN,
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

    /// Whether something may lie between two points so many pixels apart.
    #[inline(always)]
    pub(super) fn differ(&self, a: Sample, b: Sample, distance: usize) -> bool {
        if a.marks_differ(b, self.marks) {
            return true;
        }
        let limit = if a.is_near_glint(b) {
            if self.is_full() && (distance >= self.grid || distance > 2 && a.are_near_glint(b)) {
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

    /// Whether anything but the pixels of the grid is traced.
    pub(super) fn may_trace(&self) -> bool {
        self.traces
    }

    /// Whether neighbors are looked at wherever they differ.
    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.marks != 0
    }
}
