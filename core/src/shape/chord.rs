//! The part of a line that lies behind several planes: how rays meet boxes and polyhedra.

use super::Spans;
use crate::math::{Interval, Real};

/// The part of a line that lies behind all planes that were cut with so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chord<R> {
    from: End<R>,
    to: End<R>,
}

/// A distance along the line, as the fraction `height / slope` with a denominator of 0 or more.
///
/// In fixed point a division takes many instructions. So two ends are compared by products, and a chord takes
/// at most two divisions, however many planes there are. Floating point divides at once.
#[derive(Clone, Copy, Debug)]
struct End<R> {
    height: R,
    slope: R,
}

impl<R: Real> End<R> {
    #[inline]
    fn new(height: R, slope: R) -> Self {
        // Adding 0 turns -0 into 0, so that the quotient is infinite with the right sign.
        if R::IS_FIXED_POINT { Self { height, slope } } else { Self::at(height / (slope + R::ZERO)) }
    }

    #[inline]
    fn at(t: R) -> Self {
        Self { height: t, slope: R::ONE }
    }

    #[inline]
    fn is_before(self, other: Self) -> bool {
        self.height.times(other.slope) < other.height.times(self.slope)
    }

    #[inline]
    fn distance(self) -> R {
        if R::IS_FIXED_POINT { self.height / self.slope } else { self.height }
    }
}

impl<R: Real> Chord<R> {
    /// The whole line.
    #[inline]
    pub(super) fn whole() -> Self {
        Self { from: End::at(-R::FARTHEST), to: End::at(R::FARTHEST) }
    }

    /// Cuts off the part in front of a plane: keeps all `t` with `slope · t` at most `height`.
    #[inline]
    pub(super) fn below(&mut self, height: R, slope: R) {
        if slope < R::ZERO {
            self.begin(End::new(-height, -slope));
        } else {
            self.end(End::new(height, slope));
        }
    }

    /// Cuts off the parts outside of two parallel planes: keeps all `t` with `slope · t` from `least` to
    /// `most`.
    #[inline]
    pub(super) fn between(&mut self, least: R, most: R, slope: R) {
        let (least, most, slope) =
            if slope < R::ZERO { (-most, -least, -slope) } else { (least, most, slope) };
        self.begin(End::new(least, slope));
        self.end(End::new(most, slope));
    }

    #[inline]
    fn begin(&mut self, end: End<R>) {
        if self.from.is_before(end) {
            self.from = end;
        }
    }

    #[inline]
    fn end(&mut self, end: End<R>) {
        if end.is_before(self.to) {
            self.to = end;
        }
    }

    /// Whether any part of the line is left.
    #[inline]
    pub(super) fn is_left(&self) -> bool {
        self.from.is_before(self.to)
    }

    /// The first end behind the beginning of the range, if it lies inside the range.
    #[inline]
    pub(super) fn first(&self, range: Interval<R>) -> Option<R> {
        if !self.is_left() {
            return None;
        }
        let from = self.from.distance();
        let first = if from > range.min { from } else { self.to.distance() };
        range.contains(first).then_some(first)
    }

    /// The part that is left, if any.
    pub(super) fn spans(&self) -> Spans<R> {
        if self.is_left() { Spans::one(self.from.distance(), self.to.distance()) } else { Spans::NONE }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    /// Calls `check` with slabs, each as (least, most, slope); it returns the chord in each of three number
    /// systems.
    fn in_each_number_system(check: impl Fn(&[(f32, f32, f32)]) -> [Option<(f32, f32)>; 3]) {
        // A slab that is parallel to the line keeps all of it or nothing, whatever the sign of the zero.
        for zero in [0.0, -0.0] {
            assert_eq!(check(&[(-1.0, 1.0, zero), (2.0, 6.0, 2.0)]), [Some((1.0, 3.0)); 3]);
            assert_eq!(check(&[(1.0, 2.0, zero), (2.0, 6.0, 2.0)]), [None; 3]);
            assert_eq!(check(&[(2.0, 6.0, 2.0), (-2.0, -1.0, zero)]), [None; 3]);
        }
        assert_eq!(check(&[(2.0, 6.0, -2.0), (-2.0, 1.0, 1.0)]), [Some((-2.0, -1.0)); 3]);
        assert_eq!(check(&[(2.0, 6.0, 2.0), (4.0, 8.0, 1.0)]), [None; 3]);
    }

    fn ends<R: Real>(chord: Chord<R>) -> Option<(f32, f32)> {
        // Quotients in fixed point are off by one unit in the last place.
        let rounded = |t: R| (t.to_f32() * 1e6).round() / 1e6;
        chord.spans().as_slice().first().map(|part| (rounded(part.min), rounded(part.max)))
    }

    #[test]
    fn several_slabs_are_intersected() {
        fn cut<R: Real>(slabs: &[(f32, f32, f32)]) -> Option<(f32, f32)> {
            let mut chord = Chord::whole();
            for (least, most, slope) in slabs {
                chord.between(R::from_f32(*least), R::from_f32(*most), R::from_f32(*slope));
            }
            ends(chord)
        }
        in_each_number_system(|slabs| [cut::<f32>(slabs), cut::<f64>(slabs), cut::<Fixed>(slabs)]);
    }

    #[test]
    fn a_slab_is_what_lies_behind_two_planes() {
        fn cut<R: Real>(slabs: &[(f32, f32, f32)]) -> Option<(f32, f32)> {
            let mut chord = Chord::whole();
            for (least, most, slope) in slabs {
                chord.below(R::from_f32(*most), R::from_f32(*slope));
                chord.below(R::from_f32(-*least), R::from_f32(-*slope));
            }
            ends(chord)
        }
        in_each_number_system(|slabs| [cut::<f32>(slabs), cut::<f64>(slabs), cut::<Fixed>(slabs)]);
    }

    #[test]
    fn the_farther_end_counts_where_the_nearer_lies_behind() {
        let mut chord = Chord::whole();
        chord.between(2.0, 6.0, 2.0f64);
        assert_eq!(chord.first(Interval { min: 0.0, max: 9.0 }), Some(1.0));
        assert_eq!(chord.first(Interval { min: 1.0, max: 9.0 }), Some(3.0));
        assert_eq!(chord.first(Interval { min: 1.5, max: 3.0 }), None);
        assert_eq!(chord.first(Interval { min: 0.0, max: 1.0 }), None);
    }
}
