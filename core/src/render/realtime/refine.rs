//! Draws a cell whose corners or sides differ: traces where something may lie, and interpolates the rest.
//!
//! First the four sides are refined, then what is inside, in squares of four pixels. A square that one
//! straight edge crosses is cut along it; a square whose corners differ otherwise gets its middle traced, and
//! then is drawn in squares of two pixels; all others are interpolated.

use super::cell::Cell;
use super::edge::Edge;
use super::grid::{LARGEST_SIZE, SQUARE};
use super::pixel_source::PixelSource;
use super::sample::Sample;
use super::side::Side;

/// The points between the ends of the longest side, in the order in which it is halved: the point, and its
/// distance from the two points that it lies between. A shorter side uses the first of them, divided by the
/// same power of two.
const HALVES: [(u8, u8); LARGEST_SIZE - 1] = [(4, 4), (2, 2), (6, 2), (1, 1), (3, 1), (5, 1), (7, 1)];

impl Cell {
    /// Draws the points of a side whose ends are known. If the ends differ, the point in the middle is
    /// traced, and so on for both halves; else the points between are interpolated.
    // Called from many places: one copy is enough.
    pub(super) fn refine_side(&mut self, side: Side, pixels: &mut impl PixelSource) {
        let length = side.length();
        let mut samples = self.side_mut(side);
        let mut crossings = 0u8;
        if pixels.differ(samples.get(0), samples.get(length), length) {
            let shift = LARGEST_SIZE.trailing_zeros() - length.trailing_zeros();
            for (i, half) in HALVES.iter().take(length - 1) {
                let (i, half) = (usize::from(i >> shift), usize::from(half >> shift));
                let (a, b) = (samples.get(i - half), samples.get(i + half));
                // The ends are known to differ.
                if half * 2 == length || pixels.differ(a, b, half * 2) {
                    let point = pixels.trace_between(side.point(i), a, b, half * 2);
                    samples.set(i, point);
                    if half == 1 {
                        crossings |= u8::from(pixels.differ(a, point, 1)) << ((i - 1) & 7);
                        crossings |= u8::from(pixels.differ(point, b, 1)) << (i & 7);
                    }
                } else {
                    samples.set(i, a.middle(b));
                }
            }
        } else {
            samples.interpolate(length);
        }
        self.set_crossings(side, crossings);
    }

    /// Draws all points inside of a cell whose sides are known.
    pub(super) fn refine(&mut self, size: usize, pixels: &mut impl PixelSource) {
        if size > SQUARE {
            self.quarter((0, 0), size, pixels);
        }
        let square = size.min(SQUARE);
        for y in (0..size).step_by(square) {
            for x in (0..size).step_by(square) {
                if self.is_near_tiny((x, y), square) {
                    self.trace_all((x, y), square, pixels);
                } else if square < SQUARE {
                    self.fill_two((x, y), pixels);
                } else {
                    self.fill_four((x, y), pixels);
                }
            }
        }
    }

    /// Draws a square of four pixels whose sides are known.
    fn fill_four(&mut self, (x, y): (usize, usize), pixels: &mut impl PixelSource) {
        let (a, b) = (self.get(x, y), self.get(x + 4, y));
        let (c, d) = (self.get(x, y + 4), self.get(x + 4, y + 4));
        // The edge of a small highlight is not straight.
        if !(a.either_near_glint(b) || c.either_near_glint(d))
            && let Some(edge) = Edge::between(self.crossings((x, y)))
        {
            for across in 1..4 {
                self.fill_across(&edge, (x, y), across, pixels);
            }
            return;
        }
        let differ = |a, b| pixels.differ(a, b, 4);
        if differ(a, b) || differ(c, d) || differ(a, c) || differ(b, d) {
            self.quarter((x, y), 4, pixels);
            for (x, y) in [(x, y), (x + 2, y), (x, y + 2), (x + 2, y + 2)] {
                self.fill_two((x, y), pixels);
            }
            return;
        }
        self.interpolate((x, y), SQUARE);
    }

    /// Draws row `across` of a square of four pixels that a steep edge crosses, or the column of a flat edge.
    // Called in a loop of three: one copy is enough.
    fn fill_across(
        &mut self,
        edge: &Edge,
        (x, y): (usize, usize),
        across: usize,
        pixels: &mut impl PixelSource,
    ) {
        let is_steep = edge.is_steep();
        let point = |along: usize, across: usize| {
            if is_steep { (x + along, y + across) } else { (x + across, y + along) }
        };
        let get = |cell: &Self, (x, y): (usize, usize)| cell.get(x, y);
        let first = edge.is_negative(0, across);
        if first == edge.is_negative(4, across) {
            let start = point(0, across);
            let side = if is_steep { Side::right(start, 4) } else { Side::down(start, 4) };
            return self.side_mut(side).interpolate(4);
        }
        let (from, to) = (get(self, point(0, across)), get(self, point(4, across)));
        for along in 1..4 {
            let here = edge.is_negative(along, across);
            let (x, y) = point(along, across);
            let sample = if edge.is_near(along, across, pixels.traced_beside_edge()) {
                pixels.trace_between((x, y), from, to, 2)
            } else if edge.is_negative(along, 0) == here && edge.is_negative(along, 4) == here {
                // The two points of the square's sides in the other direction lie on the same side of the
                // edge.
                get(self, point(along, 0)).toward(get(self, point(along, 4)), across)
            } else if here == first {
                from.untraced()
            } else {
                to.untraced()
            };
            self.set(x, y, sample);
        }
    }

    /// Draws the point in the middle of a square of two pixels whose sides are known.
    fn fill_two(&mut self, (x, y): (usize, usize), pixels: &mut impl PixelSource) {
        let (left, right) = (self.get(x, y + 1), self.get(x + 2, y + 1));
        let (above, below) = (self.get(x + 1, y), self.get(x + 1, y + 2));
        let (level, upright) = (!pixels.differ(left, right, 2), !pixels.differ(above, below, 2));
        let middle = if left.either_near_glint(above) && !(level && upright) {
            pixels.trace(x + 1, y + 1)
        } else if level {
            left.middle(right)
        } else if upright {
            above.middle(below)
        } else {
            pixels.trace_between((x + 1, y + 1), left, right, 2)
        };
        self.set(x + 1, y + 1, middle);
    }

    /// Draws the point in the middle of a square, and the points from there to the middle of each side.
    fn quarter(&mut self, (x, y): (usize, usize), length: usize, pixels: &mut impl PixelSource) {
        let half = length / 2;
        let middle = if pixels.may_trace() {
            pixels.trace(x + half, y + half)
        } else {
            self.get(x, y).middle(self.get(x + length, y + length))
        };
        self.set(x + half, y + half, middle);
        self.refine_side(Side::right((x, y + half), half), pixels);
        self.refine_side(Side::right((x + half, y + half), half), pixels);
        self.refine_side(Side::down((x + half, y), half), pixels);
        self.refine_side(Side::down((x + half, y + half), half), pixels);
    }

    /// Whether something tiny is near a corner of a square.
    fn is_near_tiny(&self, (x, y): (usize, usize), length: usize) -> bool {
        let top = [self.get(x, y), self.get(x + length, y)];
        let bottom = [self.get(x, y + length), self.get(x + length, y + length)];
        top.into_iter().chain(bottom).any(Sample::is_near_tiny)
    }

    /// Traces every pixel of a square that is not yet traced, and interpolates those for which there are no
    /// rays.
    pub(super) fn trace_all(
        &mut self,
        (left, top): (usize, usize),
        length: usize,
        pixels: &mut impl PixelSource,
    ) {
        self.interpolate((left, top), length);
        for y in top..top + length {
            for x in left..left + length {
                self.trace_tone(x, y, pixels);
            }
        }
    }

    /// Traces the points of the right and the bottom side that are not yet traced.
    pub(super) fn trace_far_sides(&mut self, size: usize, pixels: &mut impl PixelSource) {
        for along in 0..size {
            self.trace_tone(size, along, pixels);
            self.trace_tone(along, size, pixels);
        }
    }

    fn trace_tone(&mut self, x: usize, y: usize, pixels: &mut impl PixelSource) {
        if !self.get(x, y).is_traced() && pixels.may_trace() {
            let sample = pixels.trace_tone(x, y);
            self.set(x, y, sample);
        }
    }
}
