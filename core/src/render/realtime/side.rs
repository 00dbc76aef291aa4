//! The sides of a cell, and of the squares in it: points along a row or a column.

use super::grid::LARGEST_SIZE;
use super::sample::Sample;

/// The points along a side of the largest cell: both of its ends belong to it.
pub(super) const POINTS: usize = LARGEST_SIZE + 1;

/// The direction in which the points of a side follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Along a row, from left to right.
    Right,
    /// Along a column, from top to bottom.
    Down,
}

/// A side of a cell, or of a square in it: a part of a row or a column of the cell's points, with both ends.
/// In bytes, so that it fits into a register.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    x: u8,
    y: u8,
    way: Way,
    length: u8,
}

impl Side {
    /// The points from `start` to the right, as far as `length`.
    #[inline]
    pub(super) const fn right((x, y): (usize, usize), length: usize) -> Self {
        Self { x: x as u8, y: y as u8, way: Way::Right, length: length as u8 }
    }

    /// The points from `start` down, as far as `length`.
    #[inline]
    pub(super) const fn down((x, y): (usize, usize), length: usize) -> Self {
        Self { x: x as u8, y: y as u8, way: Way::Down, length: length as u8 }
    }

    /// The first point.
    #[inline]
    pub(super) fn start(self) -> (usize, usize) {
        (usize::from(self.x), usize::from(self.y))
    }

    #[inline]
    pub(super) fn way(self) -> Way {
        self.way
    }

    /// The distance from the first point to the last.
    #[inline]
    pub(super) fn length(self) -> usize {
        usize::from(self.length)
    }

    /// The point at this distance from the first.
    #[inline]
    pub(super) fn point(self, i: usize) -> (usize, usize) {
        let (x, y) = self.start();
        if self.way == Way::Right { (x + i, y) } else { (x, y + i) }
    }
}

/// The samples of a cell along a side.
pub(super) struct SideSamples<'c> {
    samples: &'c mut [Sample],
    /// The distance of two neighbors in the cell's samples.
    stride: usize,
}

impl<'c> SideSamples<'c> {
    /// The samples of `side`, out of all samples of a cell, row after row.
    #[inline]
    pub(super) fn of(cell: &'c mut [Sample], side: Side) -> Self {
        let (x, y) = side.start();
        let samples = cell.get_mut(y * POINTS + x..).unwrap_or_default();
        Self { samples, stride: if side.way() == Way::Right { 1 } else { POINTS } }
    }

    #[inline]
    pub(super) fn get(&self, i: usize) -> Sample {
        self.samples.get(i * self.stride).copied().unwrap_or(Sample::BLANK)
    }

    #[inline]
    pub(super) fn set(&mut self, i: usize, sample: Sample) {
        if let Some(place) = self.samples.get_mut(i * self.stride) {
            *place = sample;
        }
    }

    /// Interpolates the samples between the first and the one at `length`, a power of two.
    pub(super) fn interpolate(&mut self, length: usize) {
        let (from, to) = (self.get(0), self.get(length));
        let mut tone = from.tone();
        let step = tone.step_toward(to.tone(), length.trailing_zeros());
        for i in 1..length {
            tone = tone.after(step);
            self.set(i, from.with_tone(tone));
        }
    }
}
