//! The parts of a line that lie inside a solid.

use crate::math::{Interval, Real};

/// The parts of a line that lie inside a solid: at most [`MOST`](Self::MOST), in order along the line,
/// without overlap.
///
/// A part without end is stored with its end at ±[`Real::FARTHEST`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spans<R> {
    parts: [Interval<R>; 2],
    count: usize,
}

impl<R: Real> Spans<R> {
    /// The most parts. A line that crosses a torus four times has two, and no other single shape has more.
    pub const MOST: usize = 2;

    /// No parts: the line misses the solid.
    pub const NONE: Self = Self { parts: [Interval { min: R::ZERO, max: R::ZERO }; 2], count: 0 };

    /// One part from `from` to `to`, or none if `from` is not less than `to`.
    pub fn one(from: R, to: R) -> Self {
        let mut spans = Self::NONE;
        spans.push(from, to);
        spans
    }

    /// Adds a part behind the existing ones. A part without length is left out, and so is one beyond
    /// [`MOST`](Self::MOST).
    pub fn push(&mut self, from: R, to: R) {
        if from < to
            && let Some(part) = self.parts.get_mut(self.count)
        {
            *part = Interval { min: from, max: to };
            self.count += 1;
        }
    }

    /// The parts.
    pub fn as_slice(&self) -> &[Interval<R>] {
        self.parts.get(..self.count).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_without_length_are_left_out() {
        let mut spans = Spans::one(2.0f32, 1.0);
        assert_eq!(spans, Spans::NONE);
        spans.push(f32::NAN, 1.0);
        spans.push(1.0, 3.0);
        spans.push(4.0, 5.0);
        spans.push(6.0, 7.0);
        assert_eq!(spans.as_slice(), [Interval { min: 1.0, max: 3.0 }, Interval { min: 4.0, max: 5.0 }]);
    }
}
