//! Reciprocals and reciprocal square roots: a straight line from a small table, then one step of Newton's method
//! (Ito, Takagi and Yajima, "Efficient Initial Approximation for Multiplicative Division and Square Root by a
//! Multiplication with Operand Modification", IEEE Trans. Computers 1997, for the line; any numerics text for
//! the step).
//!
//! | function | line | after the step |
//! |---|---|---|
//! | [`recip`] | 2⁻¹³ | 2⁻²⁶ of the value |
//! | [`rsqrt`] | 2⁻¹³ | 2⁻²⁵ of the value |
//!
//! A step costs one long product and one or two short ones. Two steps from a table without lines would cost two more
//! long ones, which weigh 20 instructions each on ARMv6-M.

use super::product::upper;

/// A straight piece of a curve: its value at the left end in units of 2⁻¹⁵, and how much it falls to the right end.
#[derive(Clone, Copy)]
struct Line {
    value: u16,
    fall: u16,
}

/// The curve 1/x over [1/2, 1) in 64 pieces.
static RECIP: [Line; 64] = {
    let mut lines = [Line { value: 0, fall: 0 }; 64];
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

/// The curve 1/√x over [1/4, 1) in 96 pieces.
static RSQRT: [Line; 96] = {
    let mut lines = [Line { value: 0, fall: 0 }; 96];
    let mut i = 0;
    while i < 96 {
        let (left, right) = ((32 + i) as f64 / 128.0, (33 + i) as f64 / 128.0);
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
    Line { value, fall: ((left - right) * 32768.0 + 0.5) as u16 }
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

/// 1/x in units of 2⁻¹⁵, by the table whose first piece is number `first` of 128.
#[inline(always)]
fn start<const PIECES: usize>(table: &[Line; PIECES], first: usize, x: u32) -> u32 {
    let piece = ((x >> 25) as usize).wrapping_sub(first);
    // There is a piece for every normalized x.
    let Line { value, fall } = table.get(piece).copied().unwrap_or(Line { value: u16::MAX, fall: 0 });
    let along = x >> 9 & 0xFFFF;
    ((u32::from(value) << 16).wrapping_sub(u32::from(fall).wrapping_mul(along))) >> 16
}

/// 1/x in units of 2⁻³⁰, for x from 2³¹ up in units of 2⁻³².
#[inline]
pub(super) fn recip(x: u32) -> u32 {
    let y = start(&RECIP, 64, x);
    // The error, small enough to be multiplied in 32 bits.
    let error = (1i32 << 30).wrapping_sub(upper(x, y << 15) as i32);
    let correction = (y as i32).wrapping_mul(error >> 3) >> 12;
    (y << 15).wrapping_add(correction as u32)
}

/// 1/√x in units of 2⁻³⁰, for x from 2³⁰ up in units of 2⁻³².
#[inline]
pub(super) fn rsqrt(x: u32) -> u32 {
    let y = start(&RSQRT, 32, x);
    let error = (1i32 << 30).wrapping_sub(upper(x, y.wrapping_mul(y)) as i32);
    let correction = (y as i32).wrapping_mul(error >> 3) >> 13;
    (y << 15).wrapping_add(correction as u32)
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
