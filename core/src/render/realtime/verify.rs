//! Verifies a drawn cell with a few traced pixels, and follows what it has missed.

use super::cell::Cell;
use super::grid::{LARGEST_SIZE, SQUARE};
use super::pixel_source::PixelSource;

/// A set of pixels of a cell, without those of its right and lower side.
#[derive(Clone, Copy)]
struct Pixels(u64);

impl Pixels {
    const NONE: Self = Self(0);

    fn bit(x: usize, y: usize) -> u64 {
        1 << ((y * LARGEST_SIZE + x) & 63)
    }

    fn add(&mut self, x: usize, y: usize) {
        self.0 |= Self::bit(x, y);
    }

    fn contains(self, x: usize, y: usize) -> bool {
        self.0 & Self::bit(x, y) != 0
    }

    /// Takes out the first pixel, row by row.
    fn take_first(&mut self) -> Option<(usize, usize)> {
        if self.0 == 0 {
            return None;
        }
        let place = self.0.trailing_zeros() as usize;
        self.0 &= self.0.wrapping_sub(1);
        Some((place % LARGEST_SIZE, place / LARGEST_SIZE))
    }
}

impl Cell {
    /// Traces one pixel in each row and each column. Where the traced pixel differs from the drawn one, its
    /// eight neighbors are traced too, and so on along whatever the cell has missed.
    pub(super) fn verify(&mut self, size: usize, pixels: &mut impl PixelSource) {
        // The row in which each column's pixel lies.
        let rows: &[u8] = match size {
            LARGEST_SIZE => &[0, 3, 6, 1, 4, 7, 2, 5],
            SQUARE => &[1, 3, 0, 2],
            _ => &[0, 1],
        };
        let (mut waiting, mut done) = (Pixels::NONE, Pixels::NONE);
        for (x, y) in rows.iter().enumerate() {
            waiting.add(x, usize::from(*y));
        }
        while pixels.may_trace()
            && let Some((x, y)) = waiting.take_first()
        {
            done.add(x, y);
            let drawn = self.get(x, y);
            if drawn.is_traced() {
                continue;
            }
            let traced = pixels.trace(x, y);
            // A small difference is left as it is: one right pixel among interpolated ones would show.
            if !pixels.differ(drawn, traced, 2) {
                continue;
            }
            self.set(x, y, traced);
            for y in y.saturating_sub(1)..(y + 2).min(size) {
                for x in x.saturating_sub(1)..(x + 2).min(size) {
                    if !done.contains(x, y) {
                        waiting.add(x, y);
                    }
                }
            }
        }
    }
}
