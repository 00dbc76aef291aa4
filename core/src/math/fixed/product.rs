//! Products of 32 by 32 bits, exact in 64.
//!
//! Processors from ARMv7-M on, and RISC-V with its M extension, have an instruction or two for it. ARMv6-M multiplies 32
//! bits only, and its compiler's library takes 64 by 64 bits for a product that needs a quarter of that: there four products of 16
//! bits are added up by hand (Warren, "Hacker's Delight", 2nd ed. 2012, §8-2). The bits are the same.

/// Whether this is ARMv6-M: Arm without compare-and-swap, the one thing by which stable Rust can tell it.
pub(super) const IS_ARMV6M: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));

/// `a · b`.
#[inline(always)]
pub(super) fn product(a: i32, b: i32) -> i64 {
    if IS_ARMV6M { by_halves(a, b) } else { i64::from(a).wrapping_mul(i64::from(b)) }
}

/// `a · b` in units of 2²⁴, downward, without what does not fit.
#[inline(always)]
pub(super) fn scaled(a: i32, b: i32) -> i32 {
    if IS_ARMV6M { scaled_by_halves(a, b) } else { (i64::from(a).wrapping_mul(i64::from(b)) >> 24) as i32 }
}

/// `light · share` in units of 2²⁴, downward, without what does not fit; with the 16 digits from 1 to 2⁻¹⁵ of a share below 2. On ARMv6-M that
/// is two products of 16 bits in place of four; light that a display shows is off by 1/128 of a step of 255 at most.
#[inline(always)]
pub(super) fn attenuated(light: i32, share: i32) -> i32 {
    let share = share >> 9 & 0xFFFF;
    if IS_ARMV6M {
        attenuated_by_halves(light, share)
    } else {
        (i64::from(light).wrapping_mul(i64::from(share)) >> 15) as i32
    }
}

/// The upper 32 bits of `a · b`.
#[inline(always)]
pub(super) fn upper(a: u32, b: u32) -> u32 {
    if IS_ARMV6M { upper_by_halves(a, b) } else { (u64::from(a).wrapping_mul(u64::from(b)) >> 32) as u32 }
}

/// The upper 32 bits of `a · b`, downward, of an `a` within 2³⁰ and a `b` from 0 to 2²⁷.
#[inline(always)]
pub(super) fn upper_of_small(a: i32, b: i32) -> i32 {
    if IS_ARMV6M {
        upper_of_small_by_halves(a, b)
    } else {
        (i64::from(a).wrapping_mul(i64::from(b)) >> 32) as i32
    }
}

/// `a · b` without signs.
#[inline(always)]
pub(super) fn unsigned_product(a: u32, b: u32) -> u64 {
    if IS_ARMV6M {
        u64::from(upper_by_halves(a, b)) << 32 | u64::from(a.wrapping_mul(b))
    } else {
        u64::from(a).wrapping_mul(u64::from(b))
    }
}

fn by_halves(a: i32, b: i32) -> i64 {
    let (a_high, a_low) = (a >> 16, a & 0xFFFF);
    let (b_high, b_low) = (b >> 16, b & 0xFFFF);
    let low = (a_low as u32).wrapping_mul(b_low as u32);
    // Neither sum overflows: 32767 · 65535 + 65535 < 2³¹.
    let cross = a_high.wrapping_mul(b_low).wrapping_add((low >> 16) as i32);
    let other = a_low.wrapping_mul(b_high).wrapping_add(cross & 0xFFFF);
    let high = a_high.wrapping_mul(b_high).wrapping_add(cross >> 16).wrapping_add(other >> 16);
    let low = (other as u32) << 16 | low & 0xFFFF;
    i64::from(high) << 32 | i64::from(low)
}

/// As [`by_halves`], which the compiler does not see through: three instructions fewer.
#[inline(always)]
fn scaled_by_halves(a: i32, b: i32) -> i32 {
    let (a_high, a_low) = (a >> 16, a & 0xFFFF);
    let (b_high, b_low) = (b >> 16, b & 0xFFFF);
    let low = (a_low as u32).wrapping_mul(b_low as u32);
    let cross = a_high.wrapping_mul(b_low).wrapping_add((low >> 16) as i32);
    let other = a_low.wrapping_mul(b_high).wrapping_add(cross & 0xFFFF);
    let high = a_high.wrapping_mul(b_high).wrapping_add(cross >> 16);
    high.wrapping_shl(8).wrapping_add(other >> 8)
}

/// `light · share` in units of 2¹⁵, downward, without what does not fit; of 16 digits of a share.
#[inline(always)]
fn attenuated_by_halves(light: i32, share: i32) -> i32 {
    let (high, low) = (light >> 16, light & 0xFFFF);
    let low = (low as u32).wrapping_mul(share as u32);
    high.wrapping_mul(share).wrapping_shl(1).wrapping_add((low >> 15) as i32)
}

fn upper_by_halves(a: u32, b: u32) -> u32 {
    let (a_high, a_low) = (a >> 16, a & 0xFFFF);
    let (b_high, b_low) = (b >> 16, b & 0xFFFF);
    let cross = opaque(a_high.wrapping_mul(b_low).wrapping_add(a_low.wrapping_mul(b_low) >> 16));
    let other = a_low.wrapping_mul(b_high).wrapping_add(cross & 0xFFFF);
    a_high.wrapping_mul(b_high).wrapping_add(cross >> 16).wrapping_add(other >> 16)
}

/// No sum overflows: they are below 2³⁰ + 2²⁷ + 2¹⁶.
#[inline(always)]
fn upper_of_small_by_halves(a: i32, b: i32) -> i32 {
    let (a_high, a_low) = (a >> 16, a & 0xFFFF);
    let (b_high, b_low) = (b >> 16, b & 0xFFFF);
    let low = (a_low as u32).wrapping_mul(b_low as u32) >> 16;
    let cross = a_high.wrapping_mul(b_low).wrapping_add(a_low.wrapping_mul(b_high)).wrapping_add(low as i32);
    a_high.wrapping_mul(b_high).wrapping_add(cross >> 16)
}

/// The same number. The compiler must not see through it: where it recognizes a product of 64 bits, it calls its library, which
/// takes four times as long.
#[inline(always)]
fn opaque(number: u32) -> u32 {
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    #[allow(unsafe_code)]
    {
        let same;
        // SAFETY: there is no instruction, but a comment.
        unsafe {
            core::arch::asm!("/* {} */", inlateout(reg) number => same, options(pure, nomem, nostack, preserves_flags));
        }
        same
    }
    #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
    number
}

#[cfg(test)]
mod tests {
    use super::super::tests::Random;
    use super::*;

    #[test]
    fn halves_give_the_same_bits() {
        let edges = [0, 1, -1, 2, 0x7FFF, 0x8000, 0xFFFF, 0x1_0000, i32::MAX, i32::MIN, -0x8000, -0x1_0000];
        let mut random = Random(1);
        let pairs = edges.into_iter().flat_map(|a| edges.map(|b| (a, b)));
        let randoms: Vec<_> = (0..1_000_000).map(|_| (random.bits(), random.bits())).collect();
        for (a, b) in pairs.chain(randoms) {
            assert_eq!(by_halves(a, b), i64::from(a) * i64::from(b), "{a} · {b}");
            assert_eq!(product(a, b), by_halves(a, b));
            assert_eq!(scaled_by_halves(a, b), (by_halves(a, b) >> 24) as i32, "{a} · {b}");
            assert_eq!(scaled(a, b), scaled_by_halves(a, b));
            let digits = b >> 9 & 0xFFFF;
            assert_eq!(attenuated(a, b), attenuated_by_halves(a, digits), "{a} · {b}");
            assert_eq!(attenuated(a, b), (by_halves(a, digits) >> 15) as i32, "{a} · {b}");
            let (few, fewer) = (a >> 1, (b & i32::MAX) >> 4);
            assert_eq!(upper_of_small(few, fewer), upper_of_small_by_halves(few, fewer), "{few} · {fewer}");
            assert_eq!(upper_of_small(few, fewer), (by_halves(few, fewer) >> 32) as i32, "{few} · {fewer}");
            let (a, b) = (a as u32, b as u32);
            assert_eq!(upper_by_halves(a, b), ((u64::from(a) * u64::from(b)) >> 32) as u32, "{a} · {b}");
            assert_eq!(upper(a, b), upper_by_halves(a, b));
            assert_eq!(
                u64::from(upper_by_halves(a, b)) << 32 | u64::from(a.wrapping_mul(b)),
                unsigned_product(a, b)
            );
        }
    }
}
