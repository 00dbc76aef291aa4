//! Products of 32 by 32 bits from products of 16 by 16 bits (Warren, "Hacker's Delight", 2nd ed. 2012, §8-2),
//! leading zeros and shifts, for processors whose compiler calls a library for them. The bits are those of
//! [`portable`](super::portable), where the functions are described; ARMv6-M takes a quarter of the
//! instructions of its compiler's library for a product.

// Forced, as in the rest of this file: without it, `classic` takes an M0 1.009 times the instructions.
#[inline(always)]
fn halves(number: i32) -> (i32, i32) {
    (number >> 16, number & 0xFFFF)
}

#[inline(always)]
fn unsigned_halves(number: u32) -> (u32, u32) {
    (number >> 16, number & 0xFFFF)
}

/// `a · b`.
pub(crate) fn product(a: i32, b: i32) -> i64 {
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    let low = (a_low as u32).wrapping_mul(b_low as u32);
    // Neither sum overflows: 32767 · 65535 + 65535 < 2³¹.
    let cross = a_high.wrapping_mul(b_low).wrapping_add((low >> 16) as i32);
    let other = a_low.wrapping_mul(b_high).wrapping_add(cross & 0xFFFF);
    let high = a_high.wrapping_mul(b_high).wrapping_add(cross >> 16).wrapping_add(other >> 16);
    let low = (other as u32) << 16 | low & 0xFFFF;
    i64::from(high) << 32 | i64::from(low)
}

/// `a · b` in units of 2²⁴, rounded down, without the bits that do not fit: three instructions fewer than
/// [`product`] and a shift, which the compiler does not join.
#[inline(always)]
pub(crate) fn scaled_product(a: i32, b: i32) -> i32 {
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    let low = (a_low as u32).wrapping_mul(b_low as u32);
    let cross = a_high.wrapping_mul(b_low).wrapping_add((low >> 16) as i32);
    let other = a_low.wrapping_mul(b_high).wrapping_add(cross & 0xFFFF);
    let high = a_high.wrapping_mul(b_high).wrapping_add(cross >> 16);
    high.wrapping_shl(8).wrapping_add(other >> 8)
}

/// The scalar product in units of 2²⁴, rounded down, if two coordinates of the first vector are 0. `classic`
/// and `whitted` take an M0 1.04 times the instructions without it.
#[inline(always)]
pub(crate) fn product_along_axis(sparse: [i32; 3], other: [i32; 3]) -> Option<i32> {
    along_axis(sparse, other, scaled_product)
}

/// The scalar product, exactly, if two coordinates of the first vector are 0.
#[inline]
pub(crate) fn wide_product_along_axis(sparse: [i32; 3], other: [i32; 3]) -> Option<i64> {
    match sparse {
        [0, 0, 0] => Some(0),
        _ => along_axis(sparse, other, product),
    }
}

/// The only product of the scalar product that is not 0, if two coordinates of the first vector are 0.
#[inline]
fn along_axis<T>(sparse: [i32; 3], [x, y, z]: [i32; 3], product: impl Fn(i32, i32) -> T) -> Option<T> {
    match sparse {
        [along, 0, 0] => Some(product(along, x)),
        [0, along, 0] => Some(product(along, y)),
        [0, 0, along] => Some(product(along, z)),
        _ => None,
    }
}

/// `light · digits` in units of 2¹⁵, rounded down, without the bits that do not fit, for `digits` of 16 bits.
#[inline(always)]
pub(crate) fn attenuated(light: i32, digits: i32) -> i32 {
    let (high, low) = halves(light);
    let low = (low as u32).wrapping_mul(digits as u32);
    high.wrapping_mul(digits).wrapping_shl(1).wrapping_add((low >> 15) as i32)
}

/// The upper 32 bits of `a · b`. `opaque` gives back its argument and hides where it comes from: where the
/// compiler recognizes a product of 64 bits, it calls its library, which takes four times as long.
#[inline(always)]
pub(crate) fn upper_product(a: u32, b: u32, opaque: impl FnOnce(u32) -> u32) -> u32 {
    let ((a_high, a_low), (b_high, b_low)) = (unsigned_halves(a), unsigned_halves(b));
    let cross = opaque(a_high.wrapping_mul(b_low).wrapping_add(a_low.wrapping_mul(b_low) >> 16));
    let other = a_low.wrapping_mul(b_high).wrapping_add(cross & 0xFFFF);
    a_high.wrapping_mul(b_high).wrapping_add(cross >> 16).wrapping_add(other >> 16)
}

/// Leading zeros by a binary search: 16 cycles, where the library takes 42 and a call.
#[inline(always)]
pub(crate) fn leading_zeros(bits: u32) -> u32 {
    let (mut zeros, mut rest) = (0, bits);
    for step in [16, 8, 4, 2] {
        if rest >> (32 - step) == 0 {
            rest <<= step;
            zeros += step;
        }
    }
    let odd = if rest >> 31 == 0 { 1 } else { 0 };
    let none = if bits == 0 { 1 } else { 0 };
    zeros + odd + none
}

/// A number shifted down by 1 to 63, saturated, a word at a time: a shift of two words is a call of the
/// library.
#[inline(always)]
pub(crate) fn shifted(bits: i64, down: u32) -> i32 {
    let (high, low) = ((bits >> 32) as i32, bits as u32);
    if down & 32 != 0 {
        return high >> (down & 31);
    }
    let down = down & 31;
    // The bits that are lost above must be copies of the sign.
    let shifted = (high << 1 << (31 - down)) as u32 | low >> down;
    let sign = high >> 31;
    let fits = high >> down == sign && (shifted as i32) >> 31 == sign;
    if fits { shifted as i32 } else { sign ^ i32::MAX }
}

#[cfg(test)]
mod tests {
    use super::super::{portable, share_digits};
    use super::*;
    use crate::math::fixed::tests::Random;

    #[test]
    fn halves_give_the_same_bits() {
        let edges = [0, 1, -1, 2, 0x7FFF, 0x8000, 0xFFFF, 0x1_0000, i32::MAX, i32::MIN, -0x8000, -0x1_0000];
        let mut random = Random(1);
        let pairs = edges.into_iter().flat_map(|a| edges.map(|b| (a, b)));
        let randoms: Vec<_> = (0..1_000_000).map(|_| (random.bits(), random.bits())).collect();
        for (a, b) in pairs.chain(randoms) {
            assert_eq!(product(a, b), portable::product(a, b), "{a} · {b}");
            assert_eq!(scaled_product(a, b), portable::scaled_product(a, b), "{a} · {b}");
            assert_eq!(attenuated(a, share_digits(b)), portable::attenuated(a, b), "{a} · {b}");
            assert_eq!(leading_zeros(a as u32), portable::leading_zeros(a as u32), "{a}");
            let (a, b) = (a as u32, b as u32);
            assert_eq!(upper_product(a, b, |cross| cross), portable::upper_product(a, b), "{a} · {b}");
        }
    }

    #[test]
    fn products_along_axes_are_scalar_products() {
        let mut random = Random(5);
        for i in 0..100_000 {
            let mut sparse = [0; 3];
            sparse[i % 3] = if i & 8 == 0 { 1 << 24 } else { random.bits() >> 6 };
            let other = [(); 3].map(|()| random.bits());
            assert_eq!(
                product_along_axis(sparse, other),
                Some(portable::dot3(sparse, other)),
                "{sparse:?} {other:?}"
            );
            assert_eq!(
                wide_product_along_axis(sparse, other),
                Some(portable::dot3_wide(sparse, other)),
                "{sparse:?} {other:?}"
            );
        }
        assert_eq!(product_along_axis([1, 0, 1], [1; 3]), None);
    }

    #[test]
    fn zeros_are_found() {
        for bits in (0..32).map(|bit| u32::MAX >> bit).chain([0]) {
            assert_eq!(leading_zeros(bits), portable::leading_zeros(bits), "{bits:#x}");
        }
    }

    #[test]
    fn shifts_saturate() {
        let mut random = Random(3);
        for _ in 0..1_000_000 {
            let (high, low) = (i64::from(random.bits()), i64::from(random.bits() as u32));
            let bits = (high << 32 | low) >> (random.bits() & 63);
            let down = (random.bits() & 63) as u32;
            let exact = (bits >> down).clamp(i32::MIN.into(), i32::MAX.into());
            assert_eq!(i64::from(portable::shifted(bits, down)), exact, "{bits:#x} >> {down}");
            assert_eq!(i64::from(shifted(bits, down)), exact, "{bits:#x} >> {down}");
        }
    }
}
