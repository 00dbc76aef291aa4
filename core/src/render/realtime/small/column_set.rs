//! Columns of a picture, as a set.

use crate::render::line_candidates::Span;

/// Columns of a picture: a bit for some that lie together, in wide pictures for more.
#[derive(Clone, Copy, Debug)]
pub(super) struct ColumnSet {
    bits: [u32; WORDS],
    /// A bit stands for so many columns: a power of two.
    shift: u32,
}

/// Enough for a picture of 2,048 pixels with a bit for eight of them.
const PLACES: usize = WORDS * 32;
const WORDS: usize = 8;

impl ColumnSet {
    /// None, in a picture of this width, with a bit for 2 to the power of `finest` columns or more.
    pub(super) fn none(width: u16, finest: u32) -> Self {
        let mut shift = finest;
        while usize::from(width.saturating_sub(1)) >> shift >= PLACES {
            shift += 1;
        }
        Self { bits: [0; WORDS], shift }
    }

    /// Adds these, and what has the same bits.
    pub(super) fn add(&mut self, Span { start, end }: Span) {
        if start >= end {
            return;
        }
        // Much may end far beyond the picture.
        let last = usize::from(end - 1) >> self.shift;
        for place in usize::from(start) >> self.shift..=last.min(PLACES - 1) {
            if let Some(word) = self.bits.get_mut(place >> 5) {
                *word |= 1 << (place & 31);
            }
        }
    }

    /// Whether they hold a column.
    pub(super) fn hold(&self, x: u32) -> bool {
        let place = x >> self.shift;
        self.bits.get((place >> 5) as usize).is_some_and(|word| word >> (place & 31) & 1 != 0)
    }
}
