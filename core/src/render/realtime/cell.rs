//! A cell: the square of the picture between four neighboring pixels of the grid.

use super::edge::Crossings;
use super::grid::SQUARE;
use super::pixel_source::PixelSource;
use super::sample::Sample;
use super::side::{POINTS, Side, SideSamples, Way};

/// The four corners of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners {
    pub(super) top_left: Sample,
    pub(super) top_right: Sample,
    pub(super) bottom_left: Sample,
    pub(super) bottom_right: Sample,
}

impl Corners {
    /// Four equal corners.
    pub(super) fn all(corner: Sample) -> Self {
        Self { top_left: corner, top_right: corner, bottom_left: corner, bottom_right: corner }
    }
}

/// The points of a cell, with those on all four sides: (0, 0) is the upper left corner, (size, size) the
/// lower right.
///
/// The left column is the right column of the cell before, the top row the bottom row of the cell above. The
/// points on a side follow from its two ends alone, so that the cells on either side agree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// Row after row.
    points: [Sample; POINTS * POINTS],
    /// A mask for each row: bit i is set if the points i and i + 1 differ.
    rows: [u8; POINTS],
    /// A mask for each column.
    columns: [u8; POINTS],
}

impl Cell {
    pub(super) const BLANK: Self =
        Self { points: [Sample::BLANK; POINTS * POINTS], rows: [0; POINTS], columns: [0; POINTS] };

    /// The point at (x, y).
    #[inline]
    pub(super) fn get(&self, x: usize, y: usize) -> Sample {
        self.points.get(y * POINTS + x).copied().unwrap_or(Sample::BLANK)
    }

    /// The points of a row.
    #[inline]
    pub(super) fn row(&self, y: usize) -> &[Sample] {
        self.points.get(y * POINTS..).unwrap_or_default()
    }

    /// The points along a side.
    #[inline]
    pub(super) fn side_mut(&mut self, side: Side) -> SideSamples<'_> {
        SideSamples::of(&mut self.points, side)
    }

    /// Sets the point at (x, y).
    #[inline]
    pub(super) fn set(&mut self, x: usize, y: usize, sample: Sample) {
        if let Some(point) = self.points.get_mut(y * POINTS + x) {
            *point = sample;
        }
    }

    /// Interpolates all points between the corners.
    pub(super) fn fill_smooth(&mut self, corners: &Corners, size: usize) {
        self.set(0, 0, corners.top_left);
        self.set(size, 0, corners.top_right);
        self.set(0, size, corners.bottom_left);
        self.set(size, size, corners.bottom_right);
        self.interpolate_side(Side::right((0, 0), size));
        self.interpolate_side(Side::right((0, size), size));
        self.interpolate_side(Side::down((0, 0), size));
        self.interpolate_side(Side::down((size, 0), size));
        self.interpolate((0, 0), size);
    }

    /// Interpolates the points between the ends of a side.
    pub(super) fn interpolate_side(&mut self, side: Side) {
        self.side_mut(side).interpolate(side.length());
    }

    /// Fills the inside of a square, row by row, between the points on its left and its right side.
    pub(super) fn interpolate(&mut self, (x, y): (usize, usize), length: usize) {
        for y in y + 1..y + length {
            self.side_mut(Side::right((x, y), length)).interpolate(length);
        }
    }

    /// Takes the points of the top row from the band above.
    pub(super) fn take_top(&mut self, known: &[Sample], size: usize, pixels: &impl PixelSource) {
        let mut crossings = 0u8;
        let mut last = self.get(0, 0);
        for (x, sample) in (1..=size).zip(known) {
            self.set(x, 0, *sample);
            crossings |= u8::from(pixels.differ(last, *sample, 1)) << ((x - 1) & 7);
            last = *sample;
        }
        self.set_crossings(Side::right((0, 0), size), crossings);
    }

    /// Sets where edges cross a side.
    pub(super) fn set_crossings(&mut self, side: Side, crossings: u8) {
        let (x, y) = side.start();
        let (lines, line, along) = match side.way() {
            Way::Right => (&mut self.rows, y, x),
            Way::Down => (&mut self.columns, x, y),
        };
        if let Some(line) = lines.get_mut(line) {
            let part = ((1u32 << side.length()) - 1) << (along & 7);
            *line = *line & !(part as u8) | crossings << (along & 7);
        }
    }

    /// Where edges cross the sides of the square of four pixels at (x, y).
    pub(super) fn crossings(&self, (x, y): (usize, usize)) -> Crossings {
        let four = |lines: &[u8; POINTS], line: usize, along: usize| {
            lines.get(line).map_or(0, |crossings| crossings >> (along & 7) & 15)
        };
        Crossings {
            top: four(&self.rows, y, x),
            right: four(&self.columns, x + SQUARE, y),
            bottom: four(&self.rows, y + SQUARE, x),
            left: four(&self.columns, x, y),
        }
    }

    /// Makes the right column the left one of the next cell.
    pub(super) fn advance(&mut self, size: usize) {
        for y in 0..=size {
            self.set(0, y, self.get(size, y));
        }
        if let (Some(right), Some(left)) = (self.columns.get(size).copied(), self.columns.first_mut()) {
            *left = right;
        }
    }
}
