//! The functions of [`arch`](super) in plain Rust.

use super::share_digits;
use crate::math::fixed::newton::{self, RECIPROCAL_ROOTS, Root};

#[inline]
pub(crate) fn product(a: i32, b: i32) -> i64 {
    i64::from(a).wrapping_mul(i64::from(b))
}

#[inline]
pub(crate) fn unsigned_product(a: u32, b: u32) -> u64 {
    u64::from(a).wrapping_mul(u64::from(b))
}

#[inline]
pub(crate) fn scaled_product(a: i32, b: i32) -> i32 {
    (product(a, b) >> 24) as i32
}

#[inline]
pub(crate) fn upper_product(a: u32, b: u32) -> u32 {
    (unsigned_product(a, b) >> 32) as u32
}

#[inline]
pub(crate) fn attenuated(light: i32, share: i32) -> i32 {
    (product(light, share_digits(share)) >> 15) as i32
}

#[inline]
pub(crate) fn dot3(a: [i32; 3], b: [i32; 3]) -> i32 {
    (dot3_wide(a, b) >> 24) as i32
}

#[inline]
pub(crate) fn dot3_wide([ax, ay, az]: [i32; 3], [bx, by, bz]: [i32; 3]) -> i64 {
    product(ax, bx).wrapping_add(product(ay, by)).wrapping_add(product(az, bz))
}

#[inline]
pub(crate) fn length_squared(vector: [i32; 3]) -> i64 {
    dot3_wide(vector, vector)
}

#[inline]
pub(crate) fn leading_zeros(bits: u32) -> u32 {
    bits.leading_zeros()
}

#[inline]
pub(crate) fn shifted(bits: i64, down: u32) -> i32 {
    let bits = bits >> (down & 63);
    let low = bits as i32;
    if i64::from(low) == bits {
        low
    } else if bits < 0 {
        i32::MIN
    } else {
        i32::MAX
    }
}

#[inline]
pub(crate) fn reciprocal(x: u32) -> u32 {
    newton::reciprocal(x, upper_product)
}

#[inline]
pub(crate) fn inverse(number: i32) -> (u32, i32) {
    let digits = number.unsigned_abs();
    let zeros = digits.leading_zeros() & 31;
    (zeros, reciprocal(digits << zeros) as i32)
}

/// 1/√x in units of 2⁻¹⁵ by the line alone, for x from 2³⁰ up in units of 2⁻³².
#[inline]
#[allow(clippy::indexing_slicing)] // There are 128 pieces.
fn line_of_reciprocal_root(x: u32) -> u32 {
    newton::at(RECIPROCAL_ROOTS[(x >> 25) as usize], x)
}

/// 1/√x in units of 2⁻³⁰, for x from 2³⁰ up in units of 2⁻³². The result is below 2³¹, because a step of
/// Newton's method ends below the exact value.
#[inline]
fn reciprocal_root(x: u32) -> u32 {
    let y = line_of_reciprocal_root(x);
    let error = (1i32 << 30).wrapping_sub(upper_product(x, y.wrapping_mul(y)) as i32);
    let correction = (y as i32).wrapping_mul(error >> 3) >> 13;
    (y << 15).wrapping_add(correction as u32)
}

/// The square root by the line and a step of Heron's method.
#[inline]
pub(crate) fn square_root(squared: u64) -> u32 {
    let (zeros, x) = even_zeros(squared);
    let y = line_of_reciprocal_root(x);
    // 16 digits of the root, then the rest of the square times half their reciprocal.
    let root = (x >> 16).wrapping_mul(y) >> 15;
    let rest = x.wrapping_sub(root.wrapping_mul(root)) as i32;
    let correction = (rest >> 5).wrapping_mul(y as i32) >> 12;
    (root << 15).wrapping_add(correction as u32) >> shift_of_root(zeros)
}

#[inline]
pub(crate) fn root(squared: u64) -> Root {
    let (zeros, digits) = even_zeros(squared);
    let inverse = reciprocal_root(digits);
    let up = shift_of_root(zeros);
    Root { length: (upper_product(digits, inverse) << 1) >> up, inverse, up }
}

#[inline]
pub(crate) fn unit(vector: [i32; 3]) -> [i32; 3] {
    let root = root(length_squared(vector) as u64);
    vector.map(|coordinate| root.unit_coordinate(coordinate, product))
}

/// The leading zeros of a number, rounded down to an even number up to 62, and the 32 digits after them.
///
/// With the digits in units of 2⁻³², a number that is not 0 is digits · 2⁶⁴⁻ᶻᵉʳᵒˢ with digits in [1/4, 1).
#[inline]
fn even_zeros(bits: u64) -> (u32, u32) {
    // A word at a time: processors of 32 bits take 10 instructions so, in place of 14. The lowest bit is set
    // so that 0 has 30 zeros; it changes no other result.
    let even = |word: u32| (word | 1).leading_zeros() & 30;
    let (high, low) = ((bits >> 32) as u32, bits as u32);
    if high == 0 {
        let zeros = even(low);
        return (32 + zeros, low << zeros);
    }
    let zeros = even(high);
    // In two steps, as one step could shift by 32.
    (zeros, high << zeros | low >> 1 >> (31 - zeros))
}

/// How far a root is shifted down, from the leading zeros of the number.
#[inline]
fn shift_of_root(zeros: u32) -> u32 {
    zeros.saturating_sub(1) >> 1 & 31
}

// On every processor: the direction has 15 digits of each coordinate of the way, which moves shadows by a
// small part of a pixel. It is divided by the exact length of those digits: it must be as long as any unit
// vector, or rays would meet the surface that they leave.
#[inline]
pub(crate) fn toward_light(way: [i32; 3], normal: [i32; 3]) -> Option<([i32; 3], i32, i32)> {
    // Lights behind a surface are frequent: find them first.
    let (wide, [nx, ny, nz]) = (way.map(i64::from), normal.map(|number| i64::from(number >> 10)));
    let [x, y, z] = wide;
    let height = ((x * nx + y * ny + z * nz) >> 14) as i32;
    if height <= 0 {
        return None;
    }
    let beyond = |number: i32| (number ^ number >> 31) as u32;
    let [x, y, z] = way.map(beyond);
    let up = (x | y | z).leading_zeros().wrapping_sub(1) & 31;
    // The digits are in the upper half of each.
    let digits = way.map(|number| number << up & !0xFFFF);
    let [x, y, z] = digits.map(|number| i64::from(number) * i64::from(number));
    let squares = (x.wrapping_add(y).wrapping_add(z) as u64 >> 32) as u32;
    // 0 or 2, because the sum is 2²⁸ or more.
    let even = squares.leading_zeros() & 2;
    // 2⁴⁵ over the length of the digits.
    let inverse = reciprocal_root(squares << even) >> (even >> 1 ^ 1);
    let unit = digits.map(|number| ((i64::from(number) * i64::from(inverse as i32)) >> 32) as i32 >> 5);
    let length = ((squares >> 15) * (inverse >> 15)) >> up << 1;
    let height = (height as u32) << up & !0xFFFF;
    let cosine = (u64::from(height) * u64::from(inverse)) >> 37;
    Some((unit, length as i32, cosine as i32))
}

#[inline]
pub(crate) fn dot3_sparse(sparse: [i32; 3], other: [i32; 3]) -> i32 {
    dot3(sparse, other)
}

#[inline]
pub(crate) fn dot3_wide_sparse(sparse: [i32; 3], other: [i32; 3]) -> i64 {
    dot3_wide(sparse, other)
}

#[inline]
pub(crate) fn dot3_bounds(a: [i32; 3], b: [i32; 3]) -> (i32, i32) {
    let product = dot3(a, b);
    (product, product)
}

// Products are fast: to intersect the ball takes no longer.
#[inline]
pub(crate) fn misses_ball(_from_center: [i32; 3], _direction: [i32; 3], _radius: i32) -> bool {
    false
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
        // Both functions fall: farther on, the values are smaller.
        for next in 0..1 << 16 {
            let ([a, b], limit) =
                ([reciprocal((1 << 31) + next), reciprocal_root((1 << 30) + next)], 1 << 31);
            assert!(a < limit && b < limit, "{next}: {a:#x} {b:#x}");
        }
        for x in normalized(1 << 30) {
            assert!(reciprocal_root(x) < 1 << 31 && (x < 1 << 31 || reciprocal(x) < 1 << 31), "{x:#x}");
        }
    }

    #[test]
    fn reciprocals_keep_their_bound() {
        let mut worst = 0f64;
        for x in normalized(1 << 31) {
            let exact = 2f64.powi(62) / f64::from(x);
            worst = worst.max((f64::from(reciprocal(x)) / exact - 1.0).abs());
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
            worst = worst.max((f64::from(reciprocal_root(x)) / exact - 1.0).abs());
        }
        println!("2^{}", worst.log2());
        assert!(worst < 2f64.powi(-25), "2^{}", worst.log2());
    }

    #[test]
    fn zeros_and_the_digits_after_them_make_the_number() {
        let around = |bit: u32| {
            let one = 1u64 << bit;
            [one, one - 1, one + 1, u64::MAX >> bit, 0x9E37_79B9_7F4A_7C15 >> bit]
        };
        for bits in (0..64).flat_map(around) {
            let expected = (bits | 1).leading_zeros() & 62;
            assert_eq!(even_zeros(bits), (expected, ((bits << expected) >> 32) as u32), "{bits:#x}");
            assert!(bits == 0 || even_zeros(bits).1 >= 1 << 30, "{bits:#x}");
        }
    }
}
