//! Unit normals of balls, without a root.
//!
//! A place on a ball is as far from the middle as its radius says, but for what was rounded on the way there. So the radius, of which all
//! is known beforehand, tells by what the way from the middle is to be divided, and its squared length how much is lacking: a step of
//! Newton's method for 1/√x, as `reciprocal_root` takes one from a table.
//!
//! An M0 takes about 110 instructions for that and the place in place of 230, an M3 fewer as well.

use super::arch::{inverse, upper_of_small, upper_product};
use super::{Fixed, FixedProduct};
use crate::math::Real;

/// A radius below 1, and what is known of it beforehand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedRadius {
    radius: Fixed,
    /// By how much it and what is as long is shifted up, to be from 2²⁹ to 2³⁰.
    up: u32,
    /// Then, its square in units of 2³².
    square: i32,
    /// One over that, in units of 2⁻⁷².
    inverse_square: i32,
    /// One over itself in units of 2⁻⁵⁶: up to 2²⁷.
    inverse: i32,
}

impl From<Fixed> for FixedRadius {
    fn from(radius: Fixed) -> Self {
        let (zeros, inverse) = inverse(radius.0);
        let up = zeros.wrapping_sub(2) & 31;
        let sized = (radius.0 as u32) << up;
        let inverse = inverse as u32 >> 4;
        Self {
            radius,
            up,
            square: upper_product(sized, sized) as i32,
            inverse_square: (upper_product(inverse, inverse) >> 8) as i32,
            inverse: inverse as i32,
        }
    }
}

impl From<FixedRadius> for Fixed {
    fn from(known: FixedRadius) -> Self {
        known.radius
    }
}

/// The unit vector, and the place, where a place that is seen from the middle of a ball is on it but for rounding.
#[inline(always)]
pub(super) fn on_ball(place: [Fixed; 3], known: &FixedRadius) -> ([Fixed; 3], [Fixed; 3]) {
    let FixedRadius { up, square, inverse_square, inverse, .. } = *known;
    let sized = place.map(|Fixed(number)| number << up);
    let squares = (FixedProduct::length_squared(sized.map(Fixed)).bits() >> 32) as i32;
    let lacking = square.wrapping_sub(squares);
    // Of a share of more than 2⁻¹³, one step would not be enough.
    if lacking.wrapping_abs() > square >> 12 {
        return from_afar(place, known);
    }
    // Half of it in units of 2⁻²⁷.
    let share = lacking.wrapping_mul(inverse_square) >> 14;
    let exact = sized.map(|number| number.wrapping_add((number >> 15).wrapping_mul(share) >> 12));
    let unit = exact.map(|number| Fixed(upper_of_small(number, inverse)));
    (unit, exact.map(|number| Fixed(number >> up)))
}

/// The same of a place that is not quite on the ball: a tiny one, met from far away.
#[cold]
#[inline(never)]
fn from_afar(place: [Fixed; 3], known: &FixedRadius) -> ([Fixed; 3], [Fixed; 3]) {
    let unit = Fixed::unit(place);
    (unit, unit.map(|coordinate| coordinate * known.radius))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Random, UNIT, length};
    use super::*;

    #[test]
    fn normals_and_places_keep_their_bounds() {
        let mut random = Random(1);
        let (mut off_length, mut off_unit, mut off_place) = (0f64, 0f64, 0f64);
        for i in 0..1_000_000 {
            // From 2⁻¹⁷ to 1/2, and as far off as a ray is that comes from afar, or hardly.
            let radius = Fixed(((1.5 + 0.5 * random.share()) * 2f64.powi(i % 16 - 17) / UNIT) as i32);
            let (way, off) = (random.place(), random.share() * if i % 2 == 0 { 64.0 } else { 2.0 });
            let size = (f64::from(radius.0) + off) / length(way);
            let place = way.map(|number| Fixed((number * size) as i32));
            let exact = place.map(|number| f64::from(number.0));
            let exact = exact.map(|number| number / length(exact));
            let (unit, on) = on_ball(place, &radius.into());
            let unit = unit.map(|number| f64::from(number.0) * UNIT);
            off_length = off_length.max((length(unit) - 1.0).abs());
            for axis in 0..3 {
                off_unit = off_unit.max((unit[axis] - exact[axis]).abs());
                let expected = exact[axis] * f64::from(radius.0);
                off_place = off_place.max((f64::from(on[axis].0) - expected).abs());
            }
        }
        println!("2^{} 2^{} {off_place}", off_length.log2(), off_unit.log2());
        assert!(off_length < 2f64.powi(-22), "2^{}", off_length.log2());
        assert!(off_unit <= 2.0 * UNIT, "{} units", off_unit / UNIT);
        assert!(off_place <= 2.0, "{off_place} units");
    }
}
