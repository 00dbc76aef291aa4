//! Reciprocals and square roots: a straight line from a table, then one step of Newton's method (Ito, Takagi
//! and Yajima, "Efficient Initial Approximation for Multiplicative Division and Square Root by a
//! Multiplication with Operand Modification", IEEE Trans. Computers 1997, for the line; any numerics text for
//! the step).
//!
//! | function | error of the line | error after the step |
//! |---|---|---|
//! | `reciprocal` | 2⁻¹³ | 2⁻²⁶ of the value |
//! | `reciprocal_root` | 2⁻¹³ | 2⁻²⁵ of the value |
//! | `square_root` | 2⁻¹² | 2⁻²⁴ of the value |
//!
//! This file has the tables and what all processors compute in the same way; [`arch`](super::arch) has the
//! rest. docs/experiments.md.

/// A straight piece of a curve in one word, to be loaded at once. The upper half is the value at the left end
/// in units of 2⁻¹⁵, the lower half is how much the curve falls to the right end.
type Line = u32;

/// The curve 1/x over [1/2, 1) in 64 pieces.
pub(super) static RECIPROCALS: [Line; 64] = {
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

/// The curve 1/√x over [1/4, 1) in pieces of 1/128. The first 32 entries fill the table up, so that every
/// index of 7 bits is in it.
pub(super) static RECIPROCAL_ROOTS: [Line; 128] = {
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

/// The square root by Heron's method, for the tables.
const fn sqrt(x: f64) -> f64 {
    let mut root = 1.0;
    let mut step = 0;
    while step < 20 {
        root = 0.5 * (root + x / root);
        step += 1;
    }
    root
}

/// The value of a line at `x`, whose upper seven bits are the number of the piece.
#[inline]
pub(super) fn at(line: Line, x: u32) -> u32 {
    // The word still holds the fall below the value: that adds less than a unit.
    let along = x >> 9 & 0xFFFF;
    line.wrapping_sub((line & 0xFFFF).wrapping_mul(along)) >> 16
}

/// 1/x in units of 2⁻³⁰, for x from 2³¹ up in units of 2⁻³². `upper_product` gives the upper 32 bits of a
/// product. The result is below 2³¹, because a step of Newton's method ends below the exact value.
#[inline]
#[allow(clippy::indexing_slicing)] // There are 64 pieces.
pub(super) fn reciprocal(x: u32, upper_product: impl FnOnce(u32, u32) -> u32) -> u32 {
    let y = at(RECIPROCALS[(x >> 25 & 63) as usize], x);
    // The error is so small that a product of 32 bits holds it.
    let error = (1i32 << 30).wrapping_sub(upper_product(x, y << 15) as i32);
    let correction = (y as i32).wrapping_mul(error >> 3) >> 12;
    (y << 15).wrapping_add(correction as u32)
}

/// A square root and its reciprocal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Root {
    /// The root, in 31 bits.
    pub(super) length: u32,
    /// The reciprocal of the root: 2³⁰ · 2³⁰⁻ᵘᵖ / length, at least 2³⁰ and below 2³¹.
    pub(super) inverse: u32,
    /// How far the root was shifted down from 31 digits.
    pub(super) up: u32,
}

impl Root {
    /// The coordinate of a unit vector, from that of a vector of this length, in units of 2⁻²⁴. `product`
    /// gives a product exactly.
    #[inline]
    pub(super) fn unit_coordinate(self, coordinate: i32, product: impl FnOnce(i32, i32) -> i64) -> i32 {
        // The coordinate is shifted up as far as it fits before it is scaled, and rounded afterwards.
        let upper = (product(coordinate << self.up, self.inverse as i32) >> 32) as i32;
        upper.wrapping_add(1 << 4) >> 5
    }
}
