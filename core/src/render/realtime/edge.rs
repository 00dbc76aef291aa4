//! The straight line along which two differing parts of a square meet.

use super::cell::{Cell, Way};

/// A straight line through a square of four pixels, as twice the area between it and a point, which is linear over the square: its sign
/// tells the point's side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    is_steep: bool,
    /// That of the square's upper left point.
    first: i32,
    /// How much it grows from one point to the next: in a row of a steep edge, and else in a column; and across.
    along: i32,
    across: i32,
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
        // In half pixels.
        let way = (to.0 - from.0, to.1 - from.1);
        let is_steep = way.1.abs() > way.0.abs();
        let (right, down) = (-2 * way.1, 2 * way.0);
        let (along, across) = if is_steep { (right, down) } else { (down, right) };
        Some(Self { is_steep, first: way.1 * from.0 - way.0 * from.1, along, across })
    }

    /// Whether it crosses rows rather than columns: then `along` is that of a row, and `across` tells which row; else the other way around.
    pub(super) fn is_steep(&self) -> bool {
        self.is_steep
    }

    /// On which side a point of the square lies.
    #[inline]
    pub(super) fn side(&self, along: usize, across: usize) -> bool {
        self.area(along, across) < 0
    }

    /// Whether a point of the square is less than this far from the line along the row or column, in sixteenths of a pixel.
    #[inline]
    pub(super) fn is_near(&self, along: usize, across: usize, distance: u32) -> bool {
        // The area grows by this much from one point to the next: that saves a quotient.
        self.area(along, across).unsigned_abs() * 16 < distance * self.along.unsigned_abs()
    }

    #[inline]
    fn area(&self, along: usize, across: usize) -> i32 {
        self.first + along as i32 * self.along + across as i32 * self.across
    }
}
