//! A set of columns of a picture.

use crate::render::span::Span;

/// A set of columns of a picture. Each bit stands for a few neighboring columns, more in a wide picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct ColumnSet {
    bits: [u32; WORDS],
    /// A bit stands for 2 to the power of `shift` columns.
    shift: u32,
}

/// Enough words for a picture of 2,048 pixels with a bit for eight of them.
const WORDS: usize = 8;
const BITS: usize = WORDS * 32;

impl ColumnSet {
    /// The empty set, in a picture of this width. A bit stands for 2 to the power of `finest` columns, or for
    /// more.
    pub(super) fn none(width: u16, finest: u32) -> Self {
        let mut shift = finest;
        while usize::from(width.saturating_sub(1)) >> shift >= BITS {
            shift += 1;
        }
        Self { bits: [0; WORDS], shift }
    }

    /// Adds the columns of a span, and those that share a bit with them.
    pub(super) fn add(&mut self, Span { start, end }: Span) {
        if start >= end {
            return;
        }
        // A span may end far beyond the picture.
        let last = usize::from(end - 1) >> self.shift;
        for bit in usize::from(start) >> self.shift..=last.min(BITS - 1) {
            if let Some(word) = self.bits.get_mut(bit >> 5) {
                *word |= 1 << (bit & 31);
            }
        }
    }

    /// Whether the set holds a column.
    pub(super) fn hold(&self, x: u32) -> bool {
        let bit = x >> self.shift;
        self.bits.get((bit >> 5) as usize).is_some_and(|word| word >> (bit & 31) & 1 != 0)
    }
}
