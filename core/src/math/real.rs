//! The number system that the kernel computes in.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::float;

/// A number system for the kernel: `f32`, `f64`, or a type of your own.
///
/// A scene is always *described* in `f32`; `Real` is what it is prepared for and traced in. The trait asks
/// for nothing that only floating point has: no infinity, no NaN, no exponent.
///
/// # Guarantees
/// For the types in this crate every function gives the same bits on every processor, unless the feature
/// `micromath` is on.
pub trait Real:
    Copy
    + Debug
    + PartialEq
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// How far a ray is followed that nothing else ends, in units of the scene.
    const FARTHEST: Self;
    /// The distance by which a spawned ray leaves its surface, relative to the magnitude of the coordinates.
    /// The one number behind [`Ray::spawn`](super::Ray::spawn).
    const RAY_OFFSET: Self;

    /// The nearest representable value.
    fn from_f32(value: f32) -> Self;
    /// The nearest `f32`.
    fn to_f32(self) -> f32;
    /// A count or a pixel coordinate, exactly.
    fn from_u16(value: u16) -> Self;
    /// `value / 65536`: a number in `[0, 1)`, exactly.
    fn from_fraction(value: u16) -> Self;
    /// The square root, correctly rounded; of a negative number, 0 or NaN.
    fn sqrt(self) -> Self;
    /// The tangent of an angle in radians, for camera set-up only: it is slow.
    fn tan(self) -> Self;
    /// `self` to the power `exponent`, for `self` in `[0, 1]` and `exponent ≥ 0`.
    fn powf(self, exponent: Self) -> Self;
    /// The largest integer not above `self`, saturating.
    fn floor_to_i32(self) -> i32;
    /// `self` clamped to `[0, 1]`, in units of 1/65536, rounded to nearest; NaN gives 0.
    fn to_q16(self) -> u32;

    /// `1 / self`.
    fn recip(self) -> Self {
        Self::ONE / self
    }

    /// The sum of three products: one accumulator where a number system has a wide one.
    fn dot3(a: [Self; 3], b: [Self; 3]) -> Self {
        let [ax, ay, az] = a;
        let [bx, by, bz] = b;
        ax * bx + ay * by + az * bz
    }

    /// The absolute value.
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }

    /// The larger of two. Never the platform's `max`, which differs on ±0 between processors.
    fn larger(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
}

macro_rules! impl_real_for_float {
    ($Float:ident, $offset:literal, $sqrt:path, $tan:path, $powf:path) => {
        impl Real for $Float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const FARTHEST: Self = 1e30;
            const RAY_OFFSET: Self = $offset;

            fn from_f32(value: f32) -> Self {
                value as $Float
            }

            fn to_f32(self) -> f32 {
                self as f32
            }

            fn from_u16(value: u16) -> Self {
                $Float::from(value)
            }

            fn from_fraction(value: u16) -> Self {
                $Float::from(value) * (1.0 / 65536.0)
            }

            fn sqrt(self) -> Self {
                $sqrt(self)
            }

            fn tan(self) -> Self {
                $tan(self)
            }

            fn powf(self, exponent: Self) -> Self {
                $powf(self, exponent)
            }

            fn floor_to_i32(self) -> i32 {
                // Truncate, then step down where truncation went up: 8 instructions, where libm's floorf takes 17.
                let truncated = self as i32;
                if (truncated as $Float) > self { truncated.saturating_sub(1) } else { truncated }
            }

            fn to_q16(self) -> u32 {
                // Positive predicates, so that NaN is black.
                if self >= 1.0 {
                    65536
                } else if self > 0.0 {
                    (self * 65536.0 + 0.5) as u32
                } else {
                    0
                }
            }
        }
    };
}

// 1e-5 is 168 units in the last place of f32: 10.8 million spawned rays on spheres of radius 1e-3 to 1e6
// never met their own surface.
impl_real_for_float!(f32, 1e-5, float::sqrt, libm::tanf, float::powf);
impl_real_for_float!(f64, 1e-10, float::sqrt_f64, libm::tan, libm::pow);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floor_goes_down_on_both_sides_of_zero() {
        for (value, floor) in [(1.5f32, 1), (-1.5, -2), (-2.0, -2), (0.0, 0), (-0.0, 0), (1e30, i32::MAX)] {
            assert_eq!(value.floor_to_i32(), floor);
            assert_eq!(f64::from(value).floor_to_i32(), floor);
        }
        assert_eq!((-1e30f32).floor_to_i32(), i32::MIN);
    }

    #[test]
    fn light_is_clamped_and_nan_is_black() {
        for (value, q16) in [(0.0f32, 0), (-1.0, 0), (0.5, 32768), (1.0, 65536), (7.0, 65536), (f32::NAN, 0)]
        {
            assert_eq!(value.to_q16(), q16);
            assert_eq!(f64::from(value).to_q16(), q16);
        }
        assert_eq!(f32::INFINITY.to_q16(), 65536);
    }
}
