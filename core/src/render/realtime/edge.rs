//! The straight line along which two differing parts of a square meet.

use super::cell::{Cell, Way};

/// A straight line through a square of four pixels, in half pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    from: (i32, i32),
    way: (i32, i32),
    /// The larger of the two sides of `way`.
    length: i32,
}

impl Edge {
    /// The edge of the square at (x, y), if one crosses its sides in two places and no other does.
    pub(super) fn across(cell: &Cell, (x, y): (usize, usize)) -> Option<Self> {
        let top = cell.crossings((x, y), Way::Right);
        let right = cell.crossings((x + 4, y), Way::Down);
        let bottom = cell.crossings((x, y + 4), Way::Right);
        let left = cell.crossings((x, y), Way::Down);
        let mut all = u32::from(top) | u32::from(right) << 4 | u32::from(bottom) << 8 | u32::from(left) << 12;
        let mut next = || {
            let place = all.trailing_zeros();
            all &= all.wrapping_sub(1);
            let along = (place & 3) as i32 * 2 + 1;
            match place >> 2 {
                0 => Some((along, 0)),
                1 => Some((8, along)),
                2 => Some((along, 8)),
                3 => Some((0, along)),
                _ => None,
            }
        };
        let (from, to) = (next()?, next()?);
        if next().is_some() {
            return None;
        }
        let way = (to.0 - from.0, to.1 - from.1);
        Some(Self { from, way, length: way.0.abs().max(way.1.abs()) })
    }

    /// Whether it crosses rows rather than columns.
    pub(super) fn is_steep(&self) -> bool {
        self.way.1.abs() > self.way.0.abs()
    }

    /// On which side a point of the square lies, and how far from the line along a row or a column, in sixteenths of
    /// a pixel.
    #[inline]
    pub(super) fn at(&self, x: usize, y: usize) -> (bool, u32) {
        // Twice the area between the line and the point.
        let area = self.way.0 * (y as i32 * 2 - self.from.1) - self.way.1 * (x as i32 * 2 - self.from.0);
        (area < 0, (area.unsigned_abs() * 8).checked_div(self.length.unsigned_abs()).unwrap_or(0))
    }
}
