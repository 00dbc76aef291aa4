//! Angles in fixed point: a rotation by a multiple of an eighth of a turn, and a polynomial of the arc
//! tangent for the rest (Hart et al., "Computer Approximations", 1968, for the reduction; the coefficients
//! interpolate at Chebyshev's points).
//!
//! | source of error | in units of 2⁻²⁴ of a turn |
//! |---|---|
//! | polynomial | 0.02 |
//! | reciprocal and roundings between | 0.05 |
//! | the last rounding | 0.5 |

use super::arch::{leading_zeros, reciprocal, upper_product};

/// The arc tangent in turns, divided by its argument r, as a polynomial in r² up to tan²(π/8); in units of
/// 2⁻³².
const SERIES: [i32; 5] = [683_565_263, -227_851_349, 136_535_892, -94_663_470, 54_523_161];

/// tan(π/8) in units of 2⁻³².
const TAN_EIGHTH: u32 = 1_779_033_704;

/// The angle of the vector (x, y) from the x axis, counterclockwise, in units of 2⁻²⁴ of a turn; 0 for the
/// vector of length 0.
pub(super) fn turn(y: i32, x: i32) -> i32 {
    let (long, short) = {
        let (across, up) = (x.unsigned_abs(), y.unsigned_abs());
        if up > across { (up, across) } else { (across, up) }
    };
    if long == 0 {
        return 0;
    }
    // The longer one from 2³⁰ up to 2³¹, so that their sum still fits.
    let up = leading_zeros(long);
    let scaled = |number: u32| number.wrapping_shl(up) >> 1;
    let (long, short) = (scaled(long), scaled(short));
    // Within an eighth of a turn, as the distance from the nearest sixteenth of it.
    let beyond = short > upper_product(long, TAN_EIGHTH);
    let angle = if beyond {
        (1u32 << 29).wrapping_sub(arc(long.wrapping_sub(short), long.wrapping_add(short)))
    } else {
        arc(short, long)
    };
    // Angles wrap as these numbers do.
    let angle = if y.unsigned_abs() > x.unsigned_abs() { (1u32 << 30).wrapping_sub(angle) } else { angle };
    let angle = if x < 0 { (1u32 << 31).wrapping_sub(angle) } else { angle };
    let angle = if y < 0 { angle.wrapping_neg() } else { angle };
    (angle.wrapping_add(1 << 7) >> 8) as i32
}

/// The arc tangent of the ratio of two numbers, up to tan(π/8), in units of 2⁻³² of a turn.
fn arc(part: u32, whole: u32) -> u32 {
    let up = leading_zeros(whole) & 31;
    // In units of 2⁻³².
    let ratio = upper_product(part << up, reciprocal(whole << up)) << 2;
    let square = upper_product(ratio, ratio);
    let sum = SERIES.into_iter().rev().fold(0, |sum: i32, coefficient| {
        let product = upper_product(sum.unsigned_abs(), square) as i32;
        coefficient.wrapping_add(if sum < 0 { product.wrapping_neg() } else { product })
    });
    upper_product(sum as u32, ratio)
}

#[cfg(test)]
mod tests {
    use super::super::tests::Random;
    use super::*;

    #[test]
    fn angles_keep_their_bound() {
        let mut worst = 0f64;
        let mut random = Random(1);
        for step in 0..400_000u32 {
            // Of all magnitudes, down to 2⁻¹² of the unit: shorter vectors are exact as well.
            let angle = f64::from(step) * 0.618;
            let length = 2f64.powi(12 + (random.next() >> 60) as i32 + 3);
            let (y, x) = ((angle.sin() * length) as i32, (angle.cos() * length) as i32);
            let exact = (f64::from(y).atan2(f64::from(x)) / core::f64::consts::TAU).rem_euclid(1.0);
            let error = (f64::from(turn(y, x)) - exact * 2f64.powi(24)).abs();
            worst = worst.max(error.min(2f64.powi(24) - error));
        }
        println!("{worst} units");
        assert!(worst < 0.6, "off by {worst} units");
    }

    #[test]
    fn ends_of_the_range_and_axes_are_exact() {
        for (y, x, eighths) in [
            (0, 1, 0),
            (1, 1, 1),
            (i32::MAX, i32::MAX, 1),
            (i32::MAX, 0, 2),
            (7, -7, 3),
            (0, i32::MIN, 4),
            (i32::MIN, i32::MIN, 5),
            (-1, 0, 6),
            (-5, 5, 7),
            (0, 0, 0),
        ] {
            assert_eq!(turn(y, x), eighths << 21, "{y}, {x}");
        }
        // Just below a whole turn is 0, never 1.
        assert_eq!(turn(-1, i32::MAX), 0);
    }
}
