//! A run of neighboring pixels in a line.

use crate::math::Real;

/// The pixels `start..end` of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) start: u16,
    pub(super) end: u16,
}

impl Span {
    pub(super) const NOWHERE: Self = Self { start: u16::MAX, end: u16::MAX };
    pub(super) const EVERYWHERE: Self = Self { start: 0, end: u16::MAX };

    /// Whether the span holds pixel `x`. Lowers `until` to the next pixel at which that changes.
    #[inline]
    pub(super) fn change_after(self, x: u16, until: &mut u16) -> bool {
        let is_inside = x >= self.start && x < self.end;
        let change = if is_inside { self.end } else { self.start };
        if change > x && change < *until {
            *until = change;
        }
        is_inside
    }

    /// The shortest span that holds the pixels of both.
    pub(super) fn hull(self, other: Self) -> Self {
        if other.start >= other.end {
            return self;
        }
        let end = if self.start < self.end { self.end.max(other.end) } else { other.end };
        Self { start: self.start.min(other.start), end }
    }

    /// Whether it holds any of the pixels from `left` to `right`, both included.
    pub(super) fn reaches(self, left: u16, right: u16) -> bool {
        self.start <= right && left < self.end
    }

    /// The pixels that are in both.
    pub(super) fn common(self, other: Self) -> Self {
        Self { start: self.start.max(other.start), end: self.end.min(other.end) }
    }
}

/// The pixel in which a place lies, in pixels from the picture's left or upper side, moved by `more` pixels;
/// no less than 0 and no more than [`u16::MAX`].
pub(super) fn pixel<N: Real>(place: N, more: i32) -> u16 {
    let place = place.floor_to_i32().saturating_add(more).max(0);
    u16::try_from(place).unwrap_or(u16::MAX)
}
