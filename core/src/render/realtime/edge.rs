//! The straight line along which two differing parts of a square meet.

/// Where edges cross the four sides of a square of four pixels. In each mask, bit i is set if the points i
/// and i + 1 of that side differ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossings {
    pub(super) top: u8,
    pub(super) right: u8,
    pub(super) bottom: u8,
    pub(super) left: u8,
}

/// A straight line through a square of four pixels.
///
/// The line is stored as a function that is linear over the square: twice the signed area of the triangle
/// between a point and the two ends of the line. The sign of the function shows on which side of the line the
/// point lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    is_steep: bool,
    /// The function at the square's upper left point.
    first: i32,
    /// How much the function grows from one point to the next: in a row of a steep edge or a column of a flat
    /// one.
    along: i32,
    /// How much the function grows from one of these rows or columns to the next.
    across: i32,
}

impl Edge {
    /// The line between the two places where the sides of a square are crossed; `None` if there are not
    /// exactly two.
    pub(super) fn between(crossings: Crossings) -> Option<Self> {
        let Crossings { top, right, bottom, left } = crossings;
        let mut all = u32::from(top) | u32::from(right) << 4 | u32::from(bottom) << 8 | u32::from(left) << 12;
        // Places are in half pixels: a crossing lies halfway between two points.
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
        let is_steep = way.1.abs() > way.0.abs();
        let (right, down) = (-2 * way.1, 2 * way.0);
        let (along, across) = if is_steep { (right, down) } else { (down, right) };
        Some(Self { is_steep, first: way.1 * from.0 - way.0 * from.1, along, across })
    }

    /// Whether the line is steeper than 45°, and so crosses rows. A flat line crosses columns. In the methods
    /// below, `along` counts points in a row of a steep line and in a column of a flat one, `across` those
    /// rows or columns.
    pub(super) fn is_steep(&self) -> bool {
        self.is_steep
    }

    /// Whether the function is negative at a point of the square: the same for all points on one side of the
    /// line.
    #[inline]
    pub(super) fn is_negative(&self, along: usize, across: usize) -> bool {
        self.area(along, across) < 0
    }

    /// Whether a point is nearer to the line than `distance`, measured along the row or column in 1/16 of a
    /// pixel.
    #[inline]
    pub(super) fn is_near(&self, along: usize, across: usize, distance: u32) -> bool {
        // The area divided by its growth per pixel is the distance; compare products instead.
        self.area(along, across).unsigned_abs() * 16 < distance * self.along.unsigned_abs()
    }

    #[inline]
    fn area(&self, along: usize, across: usize) -> i32 {
        self.first + along as i32 * self.along + across as i32 * self.across
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_parts_the_points_of_a_square() {
        // From between points 1 and 2 of the top to between points 2 and 3 of the bottom.
        let edge = Edge::between(Crossings { top: 0b10, right: 0, bottom: 0b100, left: 0 }).unwrap();
        assert!(edge.is_steep());
        for (across, first_beyond) in [2, 2, 2, 3, 3].into_iter().enumerate() {
            let first = edge.is_negative(0, across);
            for along in 0..=4 {
                // The line crosses the middle row at point 2 itself.
                if (along, across) != (2, 2) {
                    assert_eq!(
                        edge.is_negative(along, across) == first,
                        along < first_beyond,
                        "{along} {across}"
                    );
                }
            }
        }
        // The line is half a pixel from the points beside it in the first row.
        assert!(edge.is_near(1, 0, 9) && !edge.is_near(1, 0, 8) && !edge.is_near(3, 0, 9));
        assert!(edge.is_near(2, 2, 1));
    }

    #[test]
    fn only_two_crossings_make_a_line() {
        for (top, right, bottom, left) in [(0, 0, 0, 0), (1, 0, 0, 0), (1, 2, 0, 8), (0b1010, 0, 1, 0)] {
            assert!(Edge::between(Crossings { top, right, bottom, left }).is_none());
        }
    }
}
