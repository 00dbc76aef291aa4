//! Leading zeros: an instruction on most processors, but not on ARMv6-M. Its compiler's library takes 42 cycles and a call, a
//! binary search in place 16.

use super::product::IS_ARMV6M;

/// Leading zeros.
#[inline(always)]
pub(super) fn zeros(bits: u32) -> u32 {
    if IS_ARMV6M { zeros_by_search(bits) } else { bits.leading_zeros() }
}

#[inline(always)]
fn zeros_by_search(bits: u32) -> u32 {
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

/// Leading zeros, as far as they are an even number up to 62, and the 32 digits after them.
///
/// With digits in units of 2⁻³², all but 0 is digits · 2⁶⁴⁻ᶻᵉʳᵒˢ with digits in [1/4, 1). Where processors have 32 bits, a word at
/// a time is 4 instructions of 14 less.
#[inline(always)]
pub(super) fn even_zeros(bits: u64) -> (u32, u32) {
    // The lowest bit makes no difference, except that 0 has as many zeros as anything may have.
    let even = |word: u32| (word | 1).leading_zeros() & 30;
    let (high, low) = ((bits >> 32) as u32, bits as u32);
    if high == 0 {
        let zeros = even(low);
        return (32 + zeros, low << zeros);
    }
    let zeros = even(high);
    // 32 places at once are more than can be shifted by.
    (zeros, high << zeros | low >> 1 >> (31 - zeros))
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let bits = bits as u32;
            assert_eq!(zeros(bits), zeros_by_search(bits), "{bits:#x}");
        }
    }
}
