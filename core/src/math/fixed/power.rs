//! Powers for highlights: 2 to the exponent times the binary logarithm, each from a table of 64 values and a
//! short series (Tang, "Table-Driven Implementation of the Logarithm Function in IEEE Floating-Point
//! Arithmetic", ACM TOMS 1990).
//!
//! The error against the exact power of the same base is below 2⁻²² + 2⁻²⁷ · exponent · power: at shininess
//! 1425 that is 1e-5.

use super::arch::{leading_zeros, product, unsigned_product, upper_product};

/// Around the middle c of each 64th part of [1/2, 1): 1/c in units of 2⁻³¹, and -log₂ c in units of 2⁻²⁷.
static LOG: [(u32, u32); 64] = {
    let mut table = [(0, 0); 64];
    let mut i = 0;
    while i < 64 {
        let middle = (2 * (64 + i) + 1) as f64 / 256.0;
        #[allow(clippy::indexing_slicing)] // evaluated by the compiler
        {
            table[i] =
                ((2_147_483_648.0 / middle + 0.5) as u32, (-log2(middle) * 134_217_728.0 + 0.5) as u32);
        }
        i += 1;
    }
    table
};

/// 2 to the power -(i + 1/2)/64, in units of 2⁻³¹.
static EXP: [u32; 64] = {
    let mut table = [0; 64];
    let mut i = 0;
    while i < 64 {
        #[allow(clippy::indexing_slicing)] // evaluated by the compiler
        {
            table[i] = (exp(-LN_2 * (2 * i + 1) as f64 / 128.0) * 2_147_483_648.0 + 0.5) as u32;
        }
        i += 1;
    }
    table
};

const LN_2: f64 = core::f64::consts::LN_2;

/// The series of the exponential, for tables: 25 terms are exact for arguments to 1.
const fn exp(x: f64) -> f64 {
    let (mut sum, mut term, mut n) = (1.0, 1.0, 1);
    while n < 25 {
        term *= x / n as f64;
        sum += term;
        n += 1;
    }
    sum
}

/// By Newton's method on the exponential, for tables.
const fn log2(x: f64) -> f64 {
    let (mut y, mut step) = (0.0, 0);
    while step < 20 {
        y += x * exp(-y) - 1.0;
        step += 1;
    }
    y / LN_2
}

/// -log₂ in units of 2⁻²⁷, of a number in units of 2⁻²⁴ that is above 0 and below 1.
#[inline]
fn negative_log2(base: u32) -> u32 {
    let zeros = leading_zeros(base);
    let x = base << (zeros & 31);
    let (inverse, log) = LOG.get((x >> 25 & 63) as usize).copied().unwrap_or((0, 0));
    // x = c (1 + z), |z| < 2⁻⁷, in units of 2⁻³¹; ln(1 + z) = z - z²/2 + z³/3.
    let z = upper_product(x, inverse).wrapping_sub(1 << 31) as i32;
    let short = z >> 9;
    let square = short.wrapping_mul(short);
    let cube = (square >> 15).wrapping_mul(short) >> 20;
    let ln = z.wrapping_sub(square >> 14).wrapping_add(cube.wrapping_mul(21_845) >> 16);
    // 1/ln 2 in units of 2⁻³⁰.
    let fraction = (product(ln, 1_549_082_005) >> 34) as i32;
    let whole = zeros.wrapping_sub(8) << 27;
    let sum = whole.wrapping_add(log) as i64 - i64::from(fraction);
    if sum > 0 { sum as u32 } else { 0 }
}

/// `base` to the power of `mantissa / 2^shift`, for a base below 1 in units of 2⁻²⁴.
#[inline]
pub(super) fn power(base: u32, mantissa: u32, shift: u32) -> u32 {
    if base == 0 {
        return if mantissa == 0 { 1 << 24 } else { 0 };
    }
    // log · exponent in units of 2⁻³².
    let log = unsigned_product(negative_log2(base), mantissa);
    let bits = match shift.checked_sub(5) {
        Some(shift) => log >> shift.min(63),
        None => log.saturating_mul(1 << 5u32.wrapping_sub(shift)),
    };
    let whole = (bits >> 32) as u32;
    if bits >> 32 > 24 {
        return 0;
    }
    let fraction = bits as u32;
    let start = EXP.get((fraction >> 26) as usize).copied().unwrap_or(0);
    // How far the fraction is from the middle of its 64th, times ln 2; in units of 2⁻³², below 2⁻⁷ · ln 2.
    let from_middle = (fraction & 0x03FF_FFFF) as i32 - (1 << 25);
    // ln 2 in units of 2⁻³¹.
    let a = (product(from_middle, 1_488_522_236) >> 31) as i32;
    let short = a >> 11;
    // 1 - a + a²/2.
    let rest = a.wrapping_neg().wrapping_add(short.wrapping_mul(short) >> 11);
    let power = i64::from(start) + (product(start as i32 & i32::MAX, rest) >> 32);
    // From units of 2⁻³¹ to units of 2⁻²⁴, rounded.
    let down = whole.wrapping_add(7);
    ((power as u32).wrapping_add(1 << (down.wrapping_sub(1) & 31))) >> (down & 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_keep_their_bound() {
        for exponent in [0.0f64, 0.25, 0.5, 1.0, 3.0827, 10.0, 50.0, 101.148, 1425.0, 1e5, 1e6] {
            let mut shift = 12;
            let mut mantissa = exponent * 4096.0;
            while mantissa > 0.0 && mantissa < 2f64.powi(30) {
                mantissa *= 2.0;
                shift += 1;
            }
            let steps = (1..1 << 24).step_by(997).chain((1 << 24) - 3000..1 << 24);
            let mut worst = 0f64;
            for base in steps {
                let exact = (f64::from(base) * 2f64.powi(-24)).powf(exponent);
                let got = f64::from(power(base, mantissa as u32, shift)) * 2f64.powi(-24);
                let error = (got - exact).abs();
                let bound = 2f64.powi(-22) + exact * exponent * 2f64.powi(-27);
                worst = worst.max(error);
                assert!(error < bound, "{base}^{exponent}: {got} not {exact}");
            }
            println!("{exponent}: {worst:e}");
        }
    }

    #[test]
    fn zero_to_the_power_of_zero_is_one() {
        assert_eq!((power(0, 0, 12), power(0, 1 << 30, 30), power(5, 0, 12)), (1 << 24, 0, 1 << 24));
    }
}
