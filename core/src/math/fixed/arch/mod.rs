//! The arithmetic that depends on the processor: one list of functions, with the same bits on every
//! processor.
//!
//! [`portable`] holds the list in plain Rust, for processors that multiply 32 by 32 bits to 64 in an
//! instruction or two. ARMv6-M keeps the lower 32 bits of a product alone: [`armv6m`] holds the same list for
//! it, partly in assembly. This file has the only `cfg` for a processor. The numbers of a
//! [`Fixed`](super::Fixed) are `i32` in units of 2⁻²⁴ here.
//!
//! | function | result |
//! |---|---|
//! | `product`, `unsigned_product` | `a · b`, exactly |
//! | `scaled_product` | `a · b` in units of 2²⁴, rounded down, without the bits that do not fit |
//! | `upper_product` | the upper 32 bits of `a · b` |
//! | `attenuated` | light times a share below 2, of which 16 bits count, see [`share_digits`] |
//! | `dot3`, `dot3_wide` | a scalar product: in units of 2²⁴, rounded down; exactly |
//! | `dot3_sparse`, `dot3_wide_sparse` | both where the first vector often lies along an axis |
//! | `length_squared` | the scalar product of a vector with itself, exactly |
//! | `leading_zeros` | leading zeros |
//! | `shifted` | a number shifted down by 1 to 63, saturated |
//! | `reciprocal` | 1/x in units of 2⁻³⁰, for x from 2³¹ up in units of 2⁻³² |
//! | `inverse` | leading zeros of the absolute value (not 0), and the reciprocal of the digits after them |
//! | `root`, `square_root` | the square root of a number below 2⁶²: with its reciprocal; alone |
//! | `unit` | the unit vector along a vector |
//! | `toward_light` | see [`Real::toward_light`](crate::math::Real::toward_light) |
//! | `dot3_bounds` | two bounds of the scalar product of unit vectors |
//! | `misses_ball` | `true` if a ray surely misses a ball, and this is known sooner than by intersecting it |

#[cfg(armv6m)]
mod armv6m;
#[cfg(any(armv6m, test))]
mod coarse;
#[cfg(any(armv6m, test))]
mod halves;
#[cfg(any(not(armv6m), test))]
mod portable;

#[cfg(armv6m)]
use armv6m as processor;
#[cfg(not(armv6m))]
use portable as processor;

pub(super) use processor::{
    attenuated, dot3, dot3_bounds, dot3_sparse, dot3_wide, dot3_wide_sparse, inverse, leading_zeros,
    length_squared, misses_ball, product, reciprocal, root, scaled_product, shifted, square_root,
    toward_light, unit, unsigned_product, upper_product,
};

/// The most by which a direction of [`toward_light`] is off, as an angle in radians: each coordinate is off
/// by less than one of at least 2¹⁴.
pub(super) const TOWARD_LIGHT_ERROR: f32 = 1.0 / 8192.0;

/// 2⁻¹¹: a cosine from [`toward_light`] that is larger is above 0 for certain. Its error and that of the
/// direction together are smaller.
pub(super) const LOW_COSINE: i32 = 1 << 13;

/// The 16 bits of a share below 2 that [`attenuated`] uses: those from 1 to 2⁻¹⁵. A display shows so few
/// levels that light is off by 1/128 of a step of 255 at most, and ARMv6-M takes two products of 16 bits in
/// place of four.
#[inline]
fn share_digits(share: i32) -> i32 {
    share >> 9 & 0xFFFF
}

#[cfg(test)]
mod tests;
