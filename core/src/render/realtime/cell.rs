//! A square of the picture between four points of the grid, refined where they differ.

use super::Sample;
use super::edge::Edge;

/// The largest side of a cell, in pixels.
pub(super) const LARGEST_SIDE: usize = 8;
/// The side of the squares that are looked at one by one.
pub(super) const SQUARE: usize = 4;
/// Points along a side: both corners belong to the cell.
const POINTS: usize = LARGEST_SIDE + 1;

/// The points between the ends of a side, halved again and again: place, and distance to what it lies between. The first of them serve
/// shorter sides, in smaller units.
const HALVES: [(u8, u8); LARGEST_SIDE - 1] = [(4, 4), (2, 2), (6, 2), (1, 1), (3, 1), (5, 1), (7, 1)];

/// Traces pixels, and decides which are alike.
pub(super) trait Look {
    /// The point of the cell at (x, y).
    fn trace(&mut self, x: usize, y: usize) -> Sample;

    /// The same, where its tone is all that is asked for.
    fn tone(&mut self, x: usize, y: usize) -> Sample;

    /// The point of the cell at (x, y), which is likely to see what one of two others sees that are so many pixels apart.
    fn choose(&mut self, x: usize, y: usize, a: Sample, b: Sample, distance: usize) -> Sample;

    /// Whether something may lie between two points so many pixels apart.
    fn differ(&self, a: Sample, b: Sample, distance: usize) -> bool;

    /// Whether there are rays left for more than the corners.
    fn may_trace(&self) -> bool;

    /// Pixels are looked at that are less than this far from an edge, in 1/16 of a pixel.
    fn near(&self) -> u32;
}

/// A row or a column of a cell, or a part of one, from a point on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    Right,
    Down,
}

/// The corners of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners {
    pub(super) top_left: Sample,
    pub(super) top_right: Sample,
    pub(super) bottom_left: Sample,
    pub(super) bottom_right: Sample,
}

impl Corners {
    /// Four that are the same.
    pub(super) fn all(corner: Sample) -> Self {
        Self { top_left: corner, top_right: corner, bottom_left: corner, bottom_right: corner }
    }
}

/// The points of a cell, with those on all four sides.
///
/// Its left column is the right one of the cell before; its top row is the bottom one of the cell above. What a side
/// looks like depends on its two ends alone, so that the cells on either side agree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    points: [Sample; POINTS * POINTS],
    /// Where edges cross each row and each column: bit i is set if points i and i + 1 differ.
    rows: [u8; POINTS],
    columns: [u8; POINTS],
}

impl Cell {
    pub(super) const BLANK: Self =
        Self { points: [Sample::BLANK; POINTS * POINTS], rows: [0; POINTS], columns: [0; POINTS] };

    #[inline(always)]
    pub(super) fn get(&self, x: usize, y: usize) -> Sample {
        self.points.get(y * POINTS + x).copied().unwrap_or(Sample::BLANK)
    }

    /// The points of a row.
    #[inline(always)]
    pub(super) fn row(&self, y: usize) -> &[Sample] {
        self.points.get(y * POINTS..).unwrap_or_default()
    }

    #[inline(always)]
    pub(super) fn set(&mut self, x: usize, y: usize, sample: Sample) {
        if let Some(point) = self.points.get_mut(y * POINTS + x) {
            *point = sample;
        }
    }

    /// All points, as if nothing were between the corners.
    pub(super) fn smooth(&mut self, corners: &Corners, side: usize) {
        self.set(0, 0, corners.top_left);
        self.set(side, 0, corners.top_right);
        self.set(0, side, corners.bottom_left);
        self.set(side, side, corners.bottom_right);
        self.bridge((0, 0), Way::Right, side);
        self.bridge((0, 0), Way::Down, side);
        self.bridge((side, 0), Way::Down, side);
        self.interpolate((0, 0), side);
    }

    /// Looks whether pixels are as they were taken to be: one in each row and each column. Where one is not, at those around it, and on along
    /// whatever it is.
    #[inline(never)]
    pub(super) fn verify(&mut self, side: usize, look: &mut impl Look) {
        // A bit for each pixel, row after row.
        let bit = |x: usize, y: usize| 1u64 << ((y * LARGEST_SIDE + x) & 63);
        let rows: &[u8] = match side {
            LARGEST_SIDE => &[0, 3, 6, 1, 4, 7, 2, 5],
            SQUARE => &[1, 3, 0, 2],
            _ => &[0, 1],
        };
        let (mut asked, mut looked) = (0u64, 0u64);
        for (x, y) in rows.iter().enumerate() {
            asked |= bit(x, usize::from(*y));
        }
        while asked != 0 && look.may_trace() {
            let place = asked.trailing_zeros() as usize;
            let (x, y) = (place % LARGEST_SIDE, place / LARGEST_SIDE);
            asked &= !bit(x, y);
            looked |= bit(x, y);
            let taken = self.get(x, y);
            if taken.is_traced() {
                continue;
            }
            let seen = look.trace(x, y);
            // Single pixels that are a little different would show.
            if look.differ(taken, seen, 2) {
                self.set(x, y, seen);
                for y in y.saturating_sub(1)..(y + 2).min(side) {
                    for x in x.saturating_sub(1)..(x + 2).min(side) {
                        asked |= bit(x, y) & !looked;
                    }
                }
            }
        }
    }

    /// The edges that cross four points from (x, y) on, to the right or down.
    pub(super) fn crossings(&self, (x, y): (usize, usize), way: Way) -> u8 {
        let (lines, line, along) = match way {
            Way::Right => (&self.rows, y, x),
            Way::Down => (&self.columns, x, y),
        };
        lines.get(line).map_or(0, |crossings| crossings >> (along & 7) & 15)
    }

    /// All points of a side from (x, y) on, where its ends are known: halved where they differ, down to the pixel.
    // Called from many places: one copy is enough.
    #[inline(never)]
    pub(super) fn look_along(
        &mut self,
        (x, y): (usize, usize),
        way: Way,
        length: usize,
        look: &mut impl Look,
    ) {
        let mut line = Line::new(self, (x, y), way);
        let (from, to) = (line.get(0), line.get(length));
        let mut crossings = 0u8;
        if look.differ(from, to, length) {
            let shift = LARGEST_SIDE.trailing_zeros() - length.trailing_zeros();
            for (i, half) in HALVES.iter().take(length - 1) {
                let (i, half) = (usize::from(i >> shift), usize::from(half >> shift));
                let (a, b) = (line.get(i - half), line.get(i + half));
                // The ends are known to differ.
                if half * 2 == length || look.differ(a, b, half * 2) {
                    let (x, y) = line.place(i);
                    let point = look.choose(x, y, a, b, half * 2);
                    line.set(i, point);
                    if half == 1 {
                        crossings |= u8::from(look.differ(a, point, 1)) << ((i - 1) & 7);
                        crossings |= u8::from(look.differ(point, b, 1)) << (i & 7);
                    }
                } else {
                    line.set(i, a.middle(b));
                }
            }
        } else {
            line.interpolate(from, to, length);
        }
        self.set_crossings((x, y), way, length, crossings);
    }

    /// All points of a side, as if nothing were between its ends.
    #[inline(never)]
    pub(super) fn bridge(&mut self, start: (usize, usize), way: Way, length: usize) {
        let mut line = Line::new(self, start, way);
        let (from, to) = (line.get(0), line.get(length));
        line.interpolate(from, to, length);
    }

    /// The points of the top row, found by the band above.
    pub(super) fn know_top(&mut self, known: &[Sample], side: usize, look: &impl Look) {
        let mut crossings = 0u8;
        let mut last = self.get(0, 0);
        for (x, sample) in (1..=side).zip(known) {
            self.set(x, 0, *sample);
            crossings |= u8::from(look.differ(last, *sample, 1)) << ((x - 1) & 7);
            last = *sample;
        }
        self.set_crossings((0, 0), Way::Right, side, crossings);
    }

    fn set_crossings(&mut self, (x, y): (usize, usize), way: Way, length: usize, crossings: u8) {
        let (lines, line, along) = match way {
            Way::Right => (&mut self.rows, y, x),
            Way::Down => (&mut self.columns, x, y),
        };
        if let Some(line) = lines.get_mut(line) {
            let part = ((1u32 << length) - 1) << (along & 7);
            *line = *line & !(part as u8) | crossings << (along & 7);
        }
    }

    /// All points inside, where the sides are known.
    pub(super) fn refine(&mut self, side: usize, look: &mut impl Look) {
        if side > SQUARE {
            self.quarter((0, 0), side, look);
        }
        let square = side.min(SQUARE);
        for y in (0..side).step_by(square) {
            for x in (0..side).step_by(square) {
                if self.is_near_tiny((x, y), square) {
                    self.trace_all((x, y), square, look);
                } else if square < SQUARE {
                    self.fill_two((x, y), look);
                } else {
                    self.fill_four((x, y), look);
                }
            }
        }
    }

    /// Fills a square with what is between its left and its right side.
    fn interpolate(&mut self, (x, y): (usize, usize), side: usize) {
        for y in y + 1..y + side {
            let (from, to) = (self.get(x, y), self.get(x + side, y));
            Line::new(self, (x, y), Way::Right).interpolate(from, to, side);
        }
    }

    /// Fills a square of four pixels whose sides are known.
    fn fill_four(&mut self, (x, y): (usize, usize), look: &mut impl Look) {
        let (a, b) = (self.get(x, y), self.get(x + 4, y));
        let (c, d) = (self.get(x, y + 4), self.get(x + 4, y + 4));
        // A small highlight ends in no straight line.
        if !(a.is_near_glint(b) || c.is_near_glint(d))
            && let Some(edge) = Edge::across(self, (x, y))
        {
            for line in 1..4 {
                self.fill_line(&edge, (x, y), line, look);
            }
            return;
        }
        if look.differ(a, b, 4) || look.differ(c, d, 4) || look.differ(a, c, 4) || look.differ(b, d, 4) {
            self.quarter((x, y), 4, look);
            for (x, y) in [(x, y), (x + 2, y), (x, y + 2), (x + 2, y + 2)] {
                self.fill_two((x, y), look);
            }
            return;
        }
        self.interpolate((x, y), SQUARE);
    }

    /// A row of a square that a steep edge may cross, or a column for one that is not.
    #[inline(never)]
    fn fill_line(&mut self, edge: &Edge, (x, y): (usize, usize), i: usize, look: &mut impl Look) {
        let is_steep = edge.is_steep();
        let place = |along: usize, across: usize| {
            if is_steep { (x + along, y + across) } else { (x + across, y + along) }
        };
        let get = |cell: &Self, (x, y): (usize, usize)| cell.get(x, y);
        let (from, to) = (get(self, place(0, i)), get(self, place(4, i)));
        let begins = edge.side(0, i);
        if begins == edge.side(4, i) {
            let (start, way) = (place(0, i), if is_steep { Way::Right } else { Way::Down });
            return Line::new(self, start, way).interpolate(from, to, 4);
        }
        for along in 1..4 {
            let here = edge.side(along, i);
            let (x, y) = place(along, i);
            let point = if edge.is_near(along, i, look.near()) {
                look.choose(x, y, from, to, 2)
            } else if edge.side(along, 0) == here && edge.side(along, 4) == here {
                // Along the edge all is even: what changes does so on the way to it.
                get(self, place(along, 0)).toward(get(self, place(along, 4)), i)
            } else if here == begins {
                from.again()
            } else {
                to.again()
            };
            self.set(x, y, point);
        }
    }

    /// The point in the middle of a square of two pixels.
    fn fill_two(&mut self, (x, y): (usize, usize), look: &mut impl Look) {
        let (left, right) = (self.get(x, y + 1), self.get(x + 2, y + 1));
        let (above, below) = (self.get(x + 1, y), self.get(x + 1, y + 2));
        let (level, upright) = (!look.differ(left, right, 2), !look.differ(above, below, 2));
        let point = if left.is_near_glint(above) && !(level && upright) {
            look.trace(x + 1, y + 1)
        } else if level {
            left.middle(right)
        } else if upright {
            above.middle(below)
        } else {
            look.choose(x + 1, y + 1, left, right, 2)
        };
        self.set(x + 1, y + 1, point);
    }

    /// The point in the middle of a square, and the way from there to each side.
    fn quarter(&mut self, (x, y): (usize, usize), size: usize, look: &mut impl Look) {
        let half = size / 2;
        let middle = if look.may_trace() {
            look.trace(x + half, y + half)
        } else {
            self.get(x, y).middle(self.get(x + size, y + size))
        };
        self.set(x + half, y + half, middle);
        self.look_along((x, y + half), Way::Right, half, look);
        self.look_along((x + half, y + half), Way::Right, half, look);
        self.look_along((x + half, y), Way::Down, half, look);
        self.look_along((x + half, y + half), Way::Down, half, look);
    }

    /// Whether something tiny is near a corner of a square.
    fn is_near_tiny(&self, (x, y): (usize, usize), side: usize) -> bool {
        let corners =
            [self.get(x, y), self.get(x + side, y), self.get(x, y + side), self.get(x + side, y + side)];
        corners.into_iter().any(Sample::is_near_tiny)
    }

    /// Traces every pixel of a square that is not yet traced; what there are no rays for is interpolated.
    pub(super) fn trace_all(&mut self, (left, top): (usize, usize), side: usize, look: &mut impl Look) {
        self.interpolate((left, top), side);
        for y in top..top + side {
            for x in left..left + side {
                if !self.get(x, y).is_traced() && look.may_trace() {
                    let point = look.tone(x, y);
                    self.set(x, y, point);
                }
            }
        }
    }

    /// Makes the right column the left one of the next cell.
    pub(super) fn advance(&mut self, side: usize) {
        for y in 0..=side {
            self.set(0, y, self.get(side, y));
        }
        if let (Some(right), Some(left)) = (self.columns.get(side).copied(), self.columns.first_mut()) {
            *left = right;
        }
    }
}

/// Points of a cell in a row or a column.
struct Line<'c> {
    points: &'c mut [Sample],
    start: (usize, usize),
    way: Way,
    /// How far apart they are in the cell.
    stride: usize,
}

impl<'c> Line<'c> {
    /// The points from (x, y) on.
    #[inline(always)]
    fn new(cell: &'c mut Cell, (x, y): (usize, usize), way: Way) -> Self {
        let points = cell.points.get_mut(y * POINTS + x..).unwrap_or_default();
        let stride = if way == Way::Right { 1 } else { POINTS };
        Self { points, start: (x, y), way, stride }
    }

    /// Where a point is in the cell.
    fn place(&self, i: usize) -> (usize, usize) {
        let (x, y) = self.start;
        if self.way == Way::Right { (x + i, y) } else { (x, y + i) }
    }

    #[inline(always)]
    fn get(&self, i: usize) -> Sample {
        self.points.get(i * self.stride).copied().unwrap_or(Sample::BLANK)
    }

    #[inline(always)]
    fn set(&mut self, i: usize, sample: Sample) {
        if let Some(point) = self.points.get_mut(i * self.stride) {
            *point = sample;
        }
    }

    /// The points between two that do not differ.
    fn interpolate(&mut self, from: Sample, to: Sample, length: usize) {
        let mut tone = from.tone();
        let step = tone.step_toward(to.tone(), length.trailing_zeros());
        for i in 1..length {
            tone = tone.after(step);
            self.set(i, from.like(tone));
        }
    }
}
