//! Leading and trailing zeros: an instruction or two on most processors, but not on ARMv6-M. For leading zeros its compiler's library takes
//! 42 cycles and a call, a binary search in place 16.

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

/// What multiplied by a power of 2 has another number for each in its upper five bits, and the powers that these are for (Leiserson, Prokop
/// and Randall, "Using de Bruijn Sequences to Index a 1 in a Computer Word", 1998).
#[cfg(any(all(target_arch = "arm", not(target_has_atomic = "32")), test))]
const SEQUENCE: u32 = 0x077C_B531;
#[cfg(any(all(target_arch = "arm", not(target_has_atomic = "32")), test))]
static POWERS: [u8; 32] = [
    0, 1, 28, 2, 29, 14, 24, 3, 30, 22, 20, 15, 25, 17, 4, 8, 31, 27, 13, 23, 21, 19, 16, 7, 26, 12, 18, 6,
    11, 5, 10, 9,
];

/// Trailing zeros of what is not 0. The compiler makes the same of it on ARMv6-M, but for what may be 0: three instructions more of eight.
#[inline(always)]
pub(crate) fn trailing_zeros(bits: u32) -> u32 {
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    #[allow(unsafe_code)]
    {
        let zeros;
        // SAFETY: what is left of 32 bits without 27 is a place of the table.
        unsafe {
            core::arch::asm!(
                "rsbs {zeros}, {bits}, #0",
                "ands {zeros}, {bits}",
                "muls {zeros}, {sequence}, {zeros}",
                "lsrs {zeros}, {zeros}, #27",
                "ldrb {zeros}, [{powers}, {zeros}]",
                bits = in(reg) bits,
                sequence = in(reg) SEQUENCE,
                powers = in(reg) POWERS.as_ptr(),
                zeros = out(reg) zeros,
                options(pure, readonly, nostack)
            );
        }
        zeros
    }
    #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
    bits.trailing_zeros()
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

    #[test]
    fn powers_of_two_are_found_in_their_table() {
        for power in 0..32 {
            let place = (1u32 << power).wrapping_mul(SEQUENCE) >> 27;
            assert_eq!(u32::from(POWERS[place as usize]), power);
            assert_eq!(trailing_zeros(u32::MAX << power), power);
        }
    }
}
