//! A square of the picture between four points of the grid, refined where they differ.

use super::Sample;

/// The largest side of a cell, in pixels.
pub(super) const LARGEST_SIDE: usize = 8;
/// Points along a side: both corners belong to the cell.
const POINTS: usize = LARGEST_SIDE + 1;

/// Where a cell lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Its upper left pixel.
    pub(super) left: u32,
    pub(super) top: u32,
    /// The last column and line of the picture. The grid ends there: points beyond are the same as those.
    pub(super) last_x: u32,
    pub(super) last_y: u32,
    /// Pixels along a side of this grid's cells: 2, 4 or 8.
    pub(super) side: usize,
}

impl Place {
    pub(super) fn x(&self, x: usize) -> u16 {
        (self.left + x as u32).min(self.last_x) as u16
    }

    pub(super) fn y(&self, y: usize) -> u16 {
        (self.top + y as u32).min(self.last_y) as u16
    }

    /// Whether column `x` is the picture's last, or beyond.
    fn ends_at_column(&self, x: usize) -> bool {
        self.left + x as u32 >= self.last_x
    }

    fn ends_at_line(&self, y: usize) -> bool {
        self.top + y as u32 >= self.last_y
    }

    /// Whether pixel (x, y) of the cell is in the picture.
    fn shows(&self, x: usize, y: usize) -> bool {
        self.left + x as u32 <= self.last_x && self.top + y as u32 <= self.last_y
    }

    /// Whether the whole cell is inside the picture, all four corners included.
    fn is_inside(&self) -> bool {
        self.left + self.side as u32 <= self.last_x && self.top + self.side as u32 <= self.last_y
    }
}

/// Traces pixels, and decides which are alike.
pub(super) trait Look {
    /// The pixel at (x, y) of the picture.
    fn trace(&mut self, x: u16, y: u16) -> Sample;

    /// Whether something may lie between two pixels.
    fn differ(&self, a: Sample, b: Sample) -> bool;
}

/// The points of a cell, with those on all four sides.
///
/// Its left column is the right one of the cell before; its top row is the bottom one of the cell above. On the
/// sides, every other point is known, whatever the cells on either side look like: it depends on its row or column
/// alone. So each cell traces no pixel that another one of its band has traced.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    points: [Sample; POINTS * POINTS],
}

impl Cell {
    pub(super) const BLANK: Self = Self { points: [Sample::BLANK; POINTS * POINTS] };

    pub(super) fn get(&self, x: usize, y: usize) -> Sample {
        self.points.get(y * POINTS + x).copied().unwrap_or(Sample::BLANK)
    }

    pub(super) fn set(&mut self, x: usize, y: usize, sample: Sample) {
        if let Some(point) = self.points.get_mut(y * POINTS + x) {
            *point = sample;
        }
    }

    /// Row `y` with every other point, in picture line `place.y(y)`: the first column must be known.
    pub(super) fn look_at_row(&mut self, place: &Place, y: usize, look: &mut impl Look) {
        let side = place.side;
        let corner =
            if place.ends_at_column(0) { self.get(0, y) } else { look.trace(place.x(side), place.y(y)) };
        self.set(side, y, corner);
        let mut half = side / 2;
        while half >= 2 {
            for x in (half..side).step_by(half * 2) {
                let point = if place.ends_at_column(x) {
                    corner
                } else {
                    between(self.get(x - half, y), self.get(x + half, y), look, (place.x(x), place.y(y)))
                };
                self.set(x, y, point);
            }
            half /= 2;
        }
    }

    /// The bottom row, where the left column is known.
    pub(super) fn look_at_bottom(&mut self, place: &Place, look: &mut impl Look) {
        if place.ends_at_line(0) {
            for x in (0..=place.side).step_by(2) {
                self.set(x, place.side, self.get(x, 0));
            }
        } else {
            self.look_at_row(place, place.side, look);
        }
    }

    /// Column `x` with every other point, where its ends are known.
    pub(super) fn look_at_column(&mut self, place: &Place, x: usize, look: &mut impl Look) {
        let side = place.side;
        let mut half = side / 2;
        while half >= 2 {
            for y in (half..side).step_by(half * 2) {
                let point = if x > 0 && place.ends_at_column(0) {
                    self.get(0, y)
                } else if place.ends_at_line(y) {
                    self.get(x, side)
                } else {
                    between(self.get(x, y - half), self.get(x, y + half), look, (place.x(x), place.y(y)))
                };
                self.set(x, y, point);
            }
            half /= 2;
        }
    }

    /// All points inside, where the sides are known, as fine as they must be. Tells whether all were interpolated
    /// between the corners.
    pub(super) fn refine(&mut self, place: &Place, look: &mut impl Look) -> bool {
        if place.is_inside() && self.is_smooth(place.side, look) {
            self.interpolate(place.side);
            return true;
        }
        let side = place.side;
        let mut half = side / 2;
        while half >= 1 {
            // Between points to the left and right, then above and below, then in the middle of four.
            for y in (0..side).step_by(half * 2) {
                for x in (half..side).step_by(half * 2) {
                    if y > 0 || half == 1 {
                        self.refine_point(place, (x, y), look, |cell| {
                            (cell.get(x - half, y), cell.get(x + half, y))
                        });
                    }
                }
            }
            for y in (half..side).step_by(half * 2) {
                for x in (0..side).step_by(half * 2) {
                    if x > 0 || half == 1 {
                        self.refine_point(place, (x, y), look, |cell| {
                            (cell.get(x, y - half), cell.get(x, y + half))
                        });
                    }
                }
                for x in (half..side).step_by(half * 2) {
                    let corner = |cell: &Self, right: bool, down: bool| {
                        cell.get(
                            if right { x + half } else { x - half },
                            if down { y + half } else { y - half },
                        )
                    };
                    self.refine_middle(
                        place,
                        (x, y),
                        look,
                        [
                            corner(self, false, false),
                            corner(self, true, false),
                            corner(self, false, true),
                            corner(self, true, true),
                        ],
                    );
                }
            }
            half /= 2;
        }
        false
    }

    /// Traces every pixel that the cell shows and that is not yet traced.
    pub(super) fn trace_all(&mut self, place: &Place, look: &mut impl Look) {
        for y in 0..place.side {
            for x in 0..place.side {
                if place.shows(x, y) && !self.get(x, y).is_traced() {
                    self.set(x, y, look.trace(place.x(x), place.y(y)));
                }
            }
        }
    }

    /// Makes the right column the left one of the next cell.
    pub(super) fn advance(&mut self, side: usize) {
        for y in (0..=side).step_by(2) {
            self.set(0, y, self.get(side, y));
        }
    }

    /// The color of the whole cell, if its corners are all the same.
    pub(super) fn uniform(&self, side: usize) -> Option<Sample> {
        let corner = self.get(0, 0);
        let same = |x, y| self.get(x, y).light() == corner.light();
        (same(side, 0) && same(0, side) && same(side, side)).then_some(corner)
    }

    /// Whether no two neighboring corners differ.
    fn is_smooth(&self, side: usize, look: &impl Look) -> bool {
        let corners = [self.get(0, 0), self.get(side, 0), self.get(side, side), self.get(0, side)];
        let [a, b, c, d] = corners;
        !(look.differ(a, b) || look.differ(b, c) || look.differ(c, d) || look.differ(d, a))
    }

    /// Fills the inside between the four corners.
    fn interpolate(&mut self, side: usize) {
        let shift = side.trailing_zeros();
        let (top_left, top_right) = (self.get(0, 0), self.get(side, 0));
        let (bottom_left, bottom_right) = (self.get(0, side), self.get(side, side));
        for y in 0..side {
            let left = top_left.along(bottom_left, y as u32, shift);
            let right = top_right.along(bottom_right, y as u32, shift);
            for x in 0..side {
                if x > 0 || y > 0 {
                    self.set(x, y, left.along(right, x as u32, shift));
                }
            }
        }
    }

    fn refine_point(
        &mut self,
        place: &Place,
        (x, y): (usize, usize),
        look: &mut impl Look,
        ends: impl Fn(&Self) -> (Sample, Sample),
    ) {
        if let Some(known) = self.known_at_end(place, x, y) {
            self.set(x, y, known);
        } else if place.shows(x, y) {
            let (a, b) = ends(self);
            self.set(x, y, between(a, b, look, (place.x(x), place.y(y))));
        }
    }

    fn refine_middle(
        &mut self,
        place: &Place,
        (x, y): (usize, usize),
        look: &mut impl Look,
        corners: [Sample; 4],
    ) {
        let point = if let Some(known) = self.known_at_end(place, x, y) {
            known
        } else if !place.shows(x, y) {
            return;
        } else {
            let [a, b, c, d] = corners;
            let differ = look.differ(a, b) || look.differ(a, c) || look.differ(b, d) || look.differ(c, d);
            if differ { look.trace(place.x(x), place.y(y)) } else { a.middle(b).middle(c.middle(d)) }
        };
        self.set(x, y, point);
    }

    /// At the picture's end, every other point of the last column and line is already known from the cell's side.
    fn known_at_end(&self, place: &Place, x: usize, y: usize) -> Option<Sample> {
        if place.ends_at_column(x) && place.ends_at_line(y) {
            Some(self.get(place.side, place.side))
        } else if place.ends_at_column(x) && y.is_multiple_of(2) {
            Some(self.get(place.side, y))
        } else if place.ends_at_line(y) && x.is_multiple_of(2) {
            Some(self.get(x, place.side))
        } else {
            None
        }
    }
}

/// The point halfway between two: traced where they differ.
fn between(a: Sample, b: Sample, look: &mut impl Look, (x, y): (u16, u16)) -> Sample {
    if look.differ(a, b) { look.trace(x, y) } else { a.middle(b) }
}
