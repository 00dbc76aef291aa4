//! `f32` and `f64` as number systems.

use super::real::{Kernel, Linear, Product, Real};
use super::{LatticeCoordinate, Vec3, float, power};

/// A linear function in floating point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatLinear<R> {
    gradient: Vec3<R>,
    offset: R,
}

impl<R: Real<Setup = R>> Linear<R> for FloatLinear<R> {
    fn new(gradient: Vec3<R>, zero: Vec3<R>) -> Self {
        Self { gradient, offset: -gradient.dot(zero) }
    }

    fn at(&self, point: Vec3<R>) -> R {
        self.gradient.dot(point) + self.offset
    }

    fn gradient(&self) -> Vec3<R> {
        self.gradient
    }

    fn offset(&self) -> R {
        self.offset
    }
}

macro_rules! impl_real_for_float {
    (
        $Float:ident, $offset:literal, $sqrt:path, $tan:path, $powf:path, $turn:path, $halved:path,
        $no_larger:path, $less:path
    ) => {
        impl Product<$Float> for $Float {
            const ZERO: Self = 0.0;

            #[inline]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }

            #[inline]
            fn times(self, factor: Self) -> Self {
                self * factor
            }

            #[inline]
            fn over(self, divisor: Self) -> Self {
                self / divisor
            }

            #[inline]
            fn share(self, whole: Self) -> Self {
                self / whole
            }
        }

        impl Real for $Float {
            type Setup = Self;
            type Product = Self;
            type Factor = Self;
            type Linear = FloatLinear<Self>;

            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const FARTHEST: Self = 1e30;
            const RAY_OFFSET: Self = $offset;

            #[inline]
            fn abs(self) -> Self {
                self.abs()
            }

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

            fn from_setup(value: Self) -> Self {
                value
            }

            fn to_setup(self) -> Self {
                self
            }

            fn sqrt(self) -> Self {
                $sqrt(self)
            }

            fn times(self, other: Self) -> Self {
                self * other
            }

            // Without LTO, as on the desktop, calls of it would take a fifth of the time. Programs for boards
            // have LTO, and the hint would take 168 B of an M4F's flash.
            #[cfg_attr(not(target_arch = "arm"), inline)]
            fn dot3_wide(a: [Self; 3], b: [Self; 3]) -> Self {
                Self::dot3(a, b)
            }

            fn turn(y: Self, x: Self) -> Self {
                $turn(y, x)
            }

            fn split(self) -> LatticeCoordinate<Self> {
                let index = self.floor_to_i32();
                let within = self - index as $Float;
                // Far from 0 the difference has no digits left. For a number a little less than 0 it is
                // rounded to 1.
                let within = if (0.0..1.0).contains(&within) { within } else { 0.0 };
                LatticeCoordinate { index, within }
            }

            fn floor_to_i32(self) -> i32 {
                // Truncate, then step down where truncation went up: 8 instructions, where libm's floorf
                // takes 17.
                let truncated = self as i32;
                if (truncated as $Float) > self { truncated.saturating_sub(1) } else { truncated }
            }
        }

        impl Kernel for $Float {
            fn factor(value: f32) -> Self {
                value as $Float
            }

            fn cell(self, per_unit: Self) -> i32 {
                (self * per_unit).floor_to_i32()
            }

            fn tan(self) -> Self {
                $tan(self)
            }

            fn powf(self, exponent: Self) -> Self {
                $powf(self, exponent)
            }

            fn halved(self) -> Self {
                $halved(self)
            }

            #[inline]
            fn no_larger<const N: usize>(numbers: &[Self; N], others: &[Self; N]) -> u32 {
                $no_larger(numbers, others)
            }

            #[inline]
            fn less<const N: usize>(numbers: &[Self; N], others: &[Self; N]) -> u32 {
                $less(numbers, others)
            }

            fn to_q16(self) -> u32 {
                // The conversion saturates, and makes 0 of negative numbers and NaN.
                ((self * 65536.0 + 0.5) as u32).min(65536)
            }
        }
    };
}

// 1e-5 is 168 units in the last place of f32: 10.8 million spawned rays on spheres of radius 1e-3 to 1e6
// never met their own surface.
impl_real_for_float!(
    f32,
    1e-5,
    float::sqrt,
    libm::tanf,
    power::powf,
    float::turn,
    power::halved,
    float::no_larger_f32,
    float::less_f32
);
impl_real_for_float!(
    f64,
    1e-10,
    float::sqrt_f64,
    libm::tan,
    libm::pow,
    float::turn_f64,
    float::halved_f64,
    float::no_larger,
    float::less
);

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
    fn angles_keep_their_bound() {
        let mut worst = (0f64, 0f64);
        for step in 0..100_000u32 {
            let angle = f64::from(step) * 0.618;
            let (y, x) = ((angle.sin() * 7.0) as f32, (angle.cos() * 7.0) as f32);
            let (y64, x64) = (f64::from(y), f64::from(x));
            let exact = (y64.atan2(x64) / core::f64::consts::TAU).rem_euclid(1.0);
            let off = |got: f64| {
                assert!((0.0..1.0).contains(&got));
                let error = (got - exact).abs();
                if error > 0.5 { 1.0 - error } else { error }
            };
            worst = (worst.0.max(off(f64::from(f32::turn(y, x)))), worst.1.max(off(f64::turn(y64, x64))));
        }
        assert!(worst.0 < 2f64.powi(-23) && worst.1 < 2f64.powi(-51), "{worst:?}");
        assert_eq!((f32::turn(0.0, 0.0), f32::turn(-0.0, 1.0), f32::turn(-1e-30, 1.0)), (0.0, 0.0, 0.0));
        assert_eq!((f64::turn(1.0, 0.0), f64::turn(0.0, -1.0), f64::turn(-1.0, 0.0)), (0.25, 0.5, 0.75));
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
