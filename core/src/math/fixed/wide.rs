//! Sums of products of fixed-point numbers, not yet rounded.

use core::ops::{Add, Sub};

use super::arch::{self, product};
use super::{FRACTION, Fixed};
use crate::math::real::Product;

/// A sum of products of two [`Fixed`]: exact, in units of 2⁻⁴⁸.
///
/// Multiply-and-accumulate is one instruction on processors from ARMv7-M on, and small differences of
/// squares, which decide whether a ray meets a sphere, keep all their digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FixedProduct(i64);

impl FixedProduct {
    #[inline]
    pub(super) fn new(bits: i64) -> Self {
        Self(bits)
    }

    #[inline]
    pub(super) fn bits(self) -> i64 {
        self.0
    }

    #[inline]
    pub(super) fn dot3(a: [Fixed; 3], b: [Fixed; 3]) -> Self {
        Self(arch::dot3_wide(a.map(Fixed::to_bits), b.map(Fixed::to_bits)))
    }

    /// The sum of three squares.
    #[inline]
    pub(super) fn length_squared(vector: [Fixed; 3]) -> Self {
        Self(arch::length_squared(vector.map(Fixed::to_bits)))
    }

    /// The square root.
    #[inline]
    pub(super) fn root(self) -> Fixed {
        if self.0 <= 0 {
            return Fixed(0);
        }
        if self.0 >> 62 != 0 {
            return Fixed(i32::MAX);
        }
        Fixed(arch::square_root(self.0 as u64) as i32)
    }
}

impl Add for FixedProduct {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl Sub for FixedProduct {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }
}

impl Product<Fixed> for FixedProduct {
    const ZERO: Self = Self(0);

    fn sqrt(self) -> Fixed {
        self.root()
    }

    fn times(self, factor: Fixed) -> Self {
        // In two pieces of 32 and 31 bits: 64 by 32 bits, without what falls below the point.
        let (high, low) = ((self.0 >> 31) as i32, (self.0 & 0x7FFF_FFFF) as i32);
        let high = product(high, factor.0).wrapping_shl(31 - FRACTION);
        Self(high.wrapping_add(product(low, factor.0) >> FRACTION))
    }

    fn over(self, divisor: Fixed) -> Fixed {
        if divisor.0 == 0 {
            return Fixed(if self.0 < 0 { i32::MIN } else { i32::MAX });
        }
        // Shift up as far as fits in 31 bits, for a product of 31 by 31 bits.
        let up = self.0.unsigned_abs().leading_zeros().saturating_sub(1) & 63;
        let digits = ((self.0 << up) >> 32) as i32;
        let (zeros, inverse) = arch::inverse(divisor.0);
        // 2⁻⁴⁸ · 2³² · 2⁻ᵘᵖ over 2⁻²⁴ · 2³² · 2⁻ᶻᵉʳᵒˢ, times 2⁻³⁰ for the reciprocal.
        let quotient = product(digits, inverse);
        let down = 30u32.wrapping_add(up).wrapping_sub(zeros);
        let quotient = if down < 64 { quotient >> down } else { 0 };
        Fixed::saturated(if divisor.0 < 0 { quotient.wrapping_neg() } else { quotient })
    }

    fn share(self, whole: Self) -> Fixed {
        let (part, whole) = (self.0.unsigned_abs(), whole.0.unsigned_abs());
        // The upper 31 digits of the whole, and the digits of the part down to the same place.
        let up = whole.leading_zeros().saturating_sub(1) & 63;
        let digits = ((whole << up) >> 32) as i32;
        Self(((part << up) >> 8) as i64).over(Fixed(digits))
    }
}
