//! Powers in `f32`, for highlights and for light that is absorbed: 2 to the power of exponent times binary
//! logarithm. Each comes from a minimax polynomial (by Remez's exchange algorithm; see Muller, "Elementary
//! Functions", ch. 3).
//!
//! The binary logarithm of a power has a relative error of up to 2⁻²². Where it is large, the power is small:
//! so the error of a power is at most 2e-7, for any exponent. libm's `powf` has all digits, of which a
//! display shows few, and takes 4 times the instructions and 1 KB of flash. Its `exp2f` computes in `f64`,
//! for which an M4F has no FPU. Sums are in pairs (Estrin's scheme), so that a processor need not wait for
//! each.

use core::f32::consts::LN_2;

/// `base` to the power `exponent`, for `base` in `[0, 1]` and an exponent of 0 or more.
pub(crate) fn powf(base: f32, exponent: f32) -> f32 {
    if base > 0.0 {
        halved(-log2(base) * exponent)
    } else if exponent > 0.0 {
        0.0
    } else {
        1.0
    }
}

/// 2 to the power `-times`, for `times` of 0 or more.
pub(crate) fn halved(times: f32) -> f32 {
    // Smaller powers count as 0. So does the power of NaN.
    if !(times < 126.0) {
        return 0.0;
    }
    // Round to a whole number by adding a number whose unit in the last place is 1: this is faster than a
    // conversion to an integer and back.
    const ROUNDER: f32 = 12_582_912.0;
    let rounded = times + ROUNDER;
    let rest = times - (rounded - ROUNDER);
    // The series of the exponential, in rest · ln 2.
    let square = rest * rest;
    let low = (1.0 - LN_2 * rest) + square * (0.240_226_47 - 0.055_503_288 * rest);
    let high = (0.009_618_489 - 0.001_339_993_1 * rest) + square * 0.000_153_458_12;
    let power = low + (square * square) * high;
    power * f32::from_bits((127u32 << 23).wrapping_sub(rounded.to_bits() << 23))
}

/// The binary logarithm of a number above 0. Below 2⁻¹²⁶, about -126.
#[inline]
fn log2(x: f32) -> f32 {
    // x = m · 2^e, with m between the roots of 1/2 and 2.
    const ROOT_OF_HALF: u32 = 0x3F35_04F3;
    let bits = x.to_bits();
    let e = (bits.wrapping_sub(ROOT_OF_HALF) as i32) >> 23;
    let m = f32::from_bits(bits.wrapping_sub((e << 23) as u32));
    // The logarithm of m is 2 artanh(s), and artanh(s) / s is a series in even powers of s.
    let s = (m - 1.0) / (m + 1.0);
    let t = s * s;
    let series = (2.885_39 + t * 0.961_798_85) + (t * t) * (0.576_714_4 + t * 0.431_735_88);
    e as f32 + s * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_keep_their_bound() {
        for exponent in [0.0, 1e-3, 0.25, 0.5, 1.0, 3.0827, 10.0, 50.0, 101.148, 1425.0, 1e5, 1e6] {
            let near_one = (0..1000).map(|i| 1.0 - i as f32 * f32::EPSILON * 0.5);
            let evenly = (0..=2000).map(|i| i as f32 / 2000.0);
            let tiny = (8..250).map(|i| f32::from_bits(i << 20));
            for base in near_one.chain(evenly).chain(tiny) {
                let exact = f64::from(base).powf(f64::from(exponent));
                let error = (f64::from(powf(base, exponent)) - exact).abs();
                assert!(error < 2e-7, "{base:e} to the power {exponent} is off by {error:e}");
            }
        }
    }

    #[test]
    fn halving_keeps_its_bound_and_no_times_is_one() {
        assert_eq!((halved(0.0), halved(1.0), halved(24.0)), (1.0, 0.5, 1.0 / 16_777_216.0));
        for step in 0..140_000u32 {
            let times = step as f32 * 1e-3;
            let exact = (-f64::from(times)).exp2();
            let error = (f64::from(halved(times)) - exact).abs();
            assert!(error <= exact * 2e-7 || times > 125.9, "{times}: off by {error:e}");
        }
        assert_eq!((halved(f32::INFINITY), halved(f32::NAN)), (0.0, 0.0));
    }
}
