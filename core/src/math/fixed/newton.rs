//! Reciprocals and reciprocal square roots: a straight line from a small table, then one step of Newton's method
//! (Ito, Takagi and Yajima, "Efficient Initial Approximation for Multiplicative Division and Square Root by a
//! Multiplication with Operand Modification", IEEE Trans. Computers 1997, for the line; any numerics text for
//! the step).
//!
//! | function | line | after the step |
//! |---|---|---|
//! | [`recip`] | 2⁻¹³ | 2⁻²⁶ of the value |
//! | [`rsqrt`] | 2⁻¹³ | 2⁻²⁵ of the value |
//! | [`square_root`] | 2⁻¹² | 2⁻²⁴ of the value |
//!
//! A piece is one word, to be loaded at once. A step costs one long product and one or two short ones. Two steps from a table without
//! lines would cost two more long ones, which weigh 20 instructions each on ARMv6-M.
//!
//! Rejected: unit vectors by the line alone, in products of 16 bits, and a step of Newton's method for each coordinate afterwards. `classic`
//! takes an M0 0.96 times the instructions so, but an M3, for which a long product is one of them, 1.03 times.

use super::product::upper;
use super::zeros::even_zeros;

/// A straight piece of a curve in one word: its value at the left end in units of 2⁻¹⁵ above, and below how much it falls to
/// the right end.
type Line = u32;

/// The curve 1/x over [1/2, 1) in 64 pieces.
pub(super) static RECIP: [Line; 64] = {
    let mut lines = [0; 64];
    let mut i = 0;
    while i < 64 {
        let (left, right) = ((64 + i) as f64 / 128.0, (65 + i) as f64 / 128.0);
        #[allow(clippy::indexing_slicing)] // evaluated by the compiler
        {
            lines[i] = line(1.0 / left, 2.0 / (left + right), 1.0 / right);
        }
        i += 1;
    }
    lines
};

/// The curve 1/√x over [1/4, 1) in pieces of 1/128. The 32 below 1/4 are there so that every index has one, and none is tested.
pub(super) static RSQRT: [Line; 128] = {
    let mut lines = [0; 128];
    let mut i = 32;
    while i < 128 {
        let (left, right) = (i as f64 / 128.0, (i + 1) as f64 / 128.0);
        let middle = (left + right) / 2.0;
        #[allow(clippy::indexing_slicing)] // evaluated by the compiler
        {
            lines[i] = line(1.0 / sqrt(left), 1.0 / sqrt(middle), 1.0 / sqrt(right));
        }
        i += 1;
    }
    lines
};

/// The line that is off by as much at the ends as in the middle.
const fn line(left: f64, middle: f64, right: f64) -> Line {
    let lower = ((left + right) / 2.0 - middle) / 2.0;
    let value = ((left - lower) * 32768.0 + 0.5) as u16;
    let fall = ((left - right) * 32768.0 + 0.5) as u16;
    (value as u32) << 16 | fall as u32
}

/// By Heron's method, for tables.
const fn sqrt(x: f64) -> f64 {
    let mut root = 1.0;
    let mut step = 0;
    while step < 20 {
        root = 0.5 * (root + x / root);
        step += 1;
    }
    root
}

/// The value of a curve's piece at `x`, whose upper seven bits are the number of the piece.
#[inline(always)]
fn at(line: Line, x: u32) -> u32 {
    // That the fall is below the value makes less than a unit.
    let along = x >> 9 & 0xFFFF;
    line.wrapping_sub((line & 0xFFFF).wrapping_mul(along)) >> 16
}

/// 1/x in units of 2⁻³⁰, for x from 2³¹ up in units of 2⁻³². Below 2³¹, as a step from either side ends below what it seeks.
#[inline]
#[allow(clippy::indexing_slicing)] // There are 64 pieces.
pub(super) fn recip(x: u32) -> u32 {
    let y = at(RECIP[(x >> 25 & 63) as usize], x);
    // The error, small enough to be multiplied in 32 bits.
    let error = (1i32 << 30).wrapping_sub(upper(x, y << 15) as i32);
    let correction = (y as i32).wrapping_mul(error >> 3) >> 12;
    (y << 15).wrapping_add(correction as u32)
}

/// 1/√x in units of 2⁻¹⁵ by the line alone, for x from 2³⁰ up in units of 2⁻³².
#[inline(always)]
#[allow(clippy::indexing_slicing)] // There are 128 pieces.
fn line_of_rsqrt(x: u32) -> u32 {
    at(RSQRT[(x >> 25) as usize], x)
}

/// 1/√x in units of 2⁻³⁰, for x from 2³⁰ up in units of 2⁻³². Below 2³¹, as a step from either side ends below what it seeks.
#[inline]
pub(super) fn rsqrt(x: u32) -> u32 {
    let y = line_of_rsqrt(x);
    let error = (1i32 << 30).wrapping_sub(upper(x, y.wrapping_mul(y)) as i32);
    let correction = (y as i32).wrapping_mul(error >> 3) >> 13;
    (y << 15).wrapping_add(correction as u32)
}

/// The square root of a number below 2⁶², in 31 bits or fewer: by the line, and a step of Heron's method.
#[inline(always)]
pub(super) fn square_root(squared: u64) -> u32 {
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    if super::product::IS_ARMV6M {
        return super::armv6m::square_root(squared);
    }
    let (zeros, x) = even_zeros(squared);
    let y = line_of_rsqrt(x);
    // 16 digits of the root, and what their square leaves, times half their reciprocal.
    let root = (x >> 16).wrapping_mul(y) >> 15;
    let rest = x.wrapping_sub(root.wrapping_mul(root)) as i32;
    let correction = (rest >> 5).wrapping_mul(y as i32) >> 12;
    (root << 15).wrapping_add(correction as u32) >> shift(zeros)
}

/// How far a root is shifted down, of a number of so many leading zeros.
#[inline(always)]
fn shift(zeros: u32) -> u32 {
    zeros.saturating_sub(1) >> 1 & 31
}

/// What [`root`] finds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Root {
    /// The root, which a number below 2⁶² has in 31 bits.
    pub(super) length: u32,
    /// Its reciprocal: 2³⁰ · 2³⁰⁻ᵘᵖ / length, at least 2³⁰ and below 2³¹.
    pub(super) inverse: u32,
    /// How far the root was shifted down from 31 digits.
    pub(super) up: u32,
}

/// The square root of a number below 2⁶², and its reciprocal.
#[inline(always)]
pub(super) fn root(squared: u64) -> Root {
    // Both, so that what follows is compiled there, and not dead.
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    if super::product::IS_ARMV6M {
        return super::armv6m::root(squared);
    }
    let (zeros, digits) = even_zeros(squared);
    let inverse = rsqrt(digits);
    let up = shift(zeros);
    Root { length: (upper(digits, inverse) << 1) >> up, inverse, up }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All beginnings of 20 bits, with different ends.
    fn normalized(from: u32) -> impl Iterator<Item = u32> {
        (from >> 12..=u32::MAX >> 12)
            .map(|top| top << 12 | top.wrapping_mul(0x9E37) & 0xFFF)
            .chain([from, u32::MAX])
    }

    #[test]
    fn reciprocals_have_31_bits() {
        // Both fall: farther on they are smaller.
        for next in 0..1 << 16 {
            let ([a, b], limit) = ([recip((1 << 31) + next), rsqrt((1 << 30) + next)], 1 << 31);
            assert!(a < limit && b < limit, "{next}: {a:#x} {b:#x}");
        }
        for x in normalized(1 << 30) {
            assert!(rsqrt(x) < 1 << 31 && (x < 1 << 31 || recip(x) < 1 << 31), "{x:#x}");
        }
    }

    #[test]
    fn reciprocals_keep_their_bound() {
        let mut worst = 0f64;
        for x in normalized(1 << 31) {
            let exact = 2f64.powi(62) / f64::from(x);
            worst = worst.max((f64::from(recip(x)) / exact - 1.0).abs());
        }
        println!("2^{}", worst.log2());
        assert!(worst < 2f64.powi(-26), "2^{}", worst.log2());
    }

    #[test]
    fn square_roots_keep_their_bound() {
        let mut worst = 0f64;
        for x in normalized(1 << 30) {
            let exact = f64::from(x).sqrt() * 32_768.0;
            worst = worst.max((f64::from(square_root(u64::from(x) << 30)) / exact - 1.0).abs());
        }
        println!("2^{}", worst.log2());
        assert!(worst < 2f64.powi(-24), "2^{}", worst.log2());
    }

    #[test]
    fn reciprocal_roots_keep_their_bound() {
        let mut worst = 0f64;
        for x in normalized(1 << 30) {
            let exact = 2f64.powi(46) / f64::from(x).sqrt();
            worst = worst.max((f64::from(rsqrt(x)) / exact - 1.0).abs());
        }
        println!("2^{}", worst.log2());
        assert!(worst < 2f64.powi(-25), "2^{}", worst.log2());
    }
}
