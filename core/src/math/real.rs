//! The number system that the kernel computes in.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::{Cell, Ray, Vec3, float, power};

/// A number system for the kernel: `f32`, `f64`, [`Fixed`](super::Fixed), or a type of your own.
///
/// A scene is always *described* in `f32`; `Real` is what it is prepared for and traced in. The trait asks
/// for nothing that only floating point has: no infinity, no NaN, no exponent. What has more digits or more range than
/// the numbers themselves has types of its own, which for floating point are the numbers.
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
    /// What everything is computed in before the first ray: floating point.
    type Setup: Real<Setup = Self::Setup>;
    /// A sum of products, before it is rounded.
    type Product: Product<Self>;
    /// A number of any magnitude, for what is multiplied but never added.
    type Factor: Copy + Debug + PartialEq + Send + Sync + 'static;
    /// A linear function over space.
    type Linear: Linear<Self>;

    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// How far a ray is followed that nothing else ends, in units of the scene.
    const FARTHEST: Self;
    /// The distance by which a spawned ray leaves its surface, relative to the magnitude of the coordinates.
    /// The one number behind [`Ray::spawn`](super::Ray::spawn), see [`offset`](Self::offset).
    const RAY_OFFSET: Self;
    /// The largest coordinate and number that may be computed with, where that is less than a scene may name. A
    /// scene is then scaled before it is traced, see [`Scale`](super::Scale).
    const REACH: Option<f32> = None;
    /// Whether a product takes longer than to look for a factor of 0 or 1.
    const SEEKS_FACTORS: bool = false;
    /// How far [`dot3_coarse`](Self::dot3_coarse) is off at most.
    const COARSE: f32 = 0.0;
    /// By how much the directions of [`toward_light`](Self::toward_light) may be off, as an angle in radians.
    const ASTRAY: f32 = 0.0;
    /// Whether products take so long that time is saved by fewer digits first, as in [`dot3_coarse`](Self::dot3_coarse) and
    /// [`misses_ball`](Self::misses_ball), and by a look at whether a factor is 0 or 1.
    const SAVES_PRODUCTS: bool = false;

    /// The nearest representable value.
    fn from_f32(value: f32) -> Self;
    /// The nearest `f32`.
    fn to_f32(self) -> f32;
    /// A count or a pixel coordinate, exactly.
    fn from_u16(value: u16) -> Self;
    /// `value / 65536`: a number in `[0, 1)`, exactly.
    fn from_fraction(value: u16) -> Self;
    /// What was computed before the first ray, rounded.
    fn from_setup(value: Self::Setup) -> Self;
    /// The same number before the first ray.
    fn to_setup(self) -> Self::Setup;
    /// The square root, correctly rounded in floating point; of a negative number, 0 or NaN.
    fn sqrt(self) -> Self;
    /// The tangent of an angle in radians, for camera set-up only: it is slow.
    fn tan(self) -> Self;
    /// The nearest factor.
    fn factor(value: f32) -> Self::Factor;
    /// `self` to the power `exponent`, for `self` in `[0, 1]` and `exponent ≥ 0`.
    fn powf(self, exponent: Self::Factor) -> Self;
    /// 2 to the power `-self`, for `self ≥ 0`: what is left after so many halvings.
    fn halved(self) -> Self;
    /// The number of the cell in which a coordinate lies: `floor(self · per_unit)`. Very far cells keep at least whether
    /// they are even, or are all the same.
    fn cell(self, per_unit: Self::Factor) -> i32;
    /// The angle of the vector (x, y) from the x axis, counterclockwise, as a share of a turn: 0 or more and less than 1,
    /// and 0 of no vector. Off by at most 2⁻²³ in `f32`, 2⁻⁵¹ in `f64`, and 0.6 · 2⁻²⁴ in fixed point.
    fn turn(y: Self, x: Self) -> Self;
    /// The whole number below `self`, and what is left.
    fn split(self) -> Cell<Self>;
    /// The largest integer not above `self`, saturating.
    fn floor_to_i32(self) -> i32;
    /// `self` clamped to `[0, 1]`, in units of 1/65536, rounded to nearest; NaN gives 0.
    fn to_q16(self) -> u32;

    /// `1 / self`.
    fn recip(self) -> Self {
        Self::ONE / self
    }

    /// Whether a number that is one is more than 0: processors with 32 bits take less time for it than to compare floats.
    #[inline(always)]
    fn is_positive(self) -> bool {
        self > Self::ZERO
    }

    /// Whether a number that is one is more than 0, and its square as well.
    #[inline(always)]
    fn has_square(self) -> bool {
        self.is_positive()
    }

    /// The sum of three products: one accumulator where a number system has a wide one.
    fn dot3(a: [Self; 3], b: [Self; 3]) -> Self {
        let [ax, ay, az] = a;
        let [bx, by, bz] = b;
        ax * bx + ay * by + az * bz
    }

    /// A coordinate between -1 and 1, as [`dot3_coarse`](Self::dot3_coarse) takes it.
    #[inline(always)]
    fn coarse(self) -> Self {
        self
    }

    /// The sum of three products of [coarse](Self::coarse) coordinates, for what must be fast and is asked again where it is close.
    #[inline(always)]
    fn dot3_coarse(a: [Self; 3], b: [Self; 3]) -> Self {
        Self::dot3(a, b)
    }

    /// Whether a place is so near the middle of the scene that [`misses_ball`](Self::misses_ball) may be asked of rays from there.
    #[inline(always)]
    fn is_central(_place: Vec3<Self>) -> bool {
        false
    }

    /// Whether a ray from a [central](Self::is_central) place surely misses a ball, where [that](Self::SAVES_PRODUCTS) can be told faster than by
    /// meeting it.
    #[inline(always)]
    fn misses_ball(_ray: &Ray<Self>, _center: Vec3<Self>, _radius: Self) -> bool {
        false
    }

    /// What is left of an amount of light by a share of it, 0 to 1. A display shows so few levels that 15 digits of a share may do.
    #[inline(always)]
    fn attenuated(self, share: Self) -> Self {
        self * share
    }

    /// The product, not yet rounded.
    fn times(self, other: Self) -> Self::Product;

    /// The sum of three products, not yet rounded.
    fn dot3_wide(a: [Self; 3], b: [Self; 3]) -> Self::Product;

    /// The squared length of a vector, not yet rounded.
    #[inline(always)]
    fn length_squared_wide(vector: [Self; 3]) -> Self::Product {
        Self::dot3_wide(vector, vector)
    }

    /// The unit vector along a vector, and the vector's length. Where that is 0 the unit vector is anything.
    fn polar(vector: [Self; 3]) -> ([Self; 3], Self) {
        let length = Self::length_squared_wide(vector).sqrt();
        let scale = length.recip();
        (vector.map(|coordinate| coordinate * scale), length)
    }

    /// The unit vector along a vector, and nothing else.
    #[inline(always)]
    fn unit(vector: [Self; 3]) -> [Self; 3] {
        Self::polar(vector).0
    }

    /// Along the way from a point to a light: the unit vector, the length, and the cosine of the angle with a unit normal; `None` where the light
    /// is not above the surface. What a shadow looks like takes fewer digits than where a ray ends: the direction is a unit vector, but
    /// [may be off](Self::ASTRAY).
    #[inline(always)]
    fn toward_light(way: [Self; 3], normal: [Self; 3]) -> Option<([Self; 3], Self, Self)> {
        // Lights behind a surface are the most frequent: find them before the root and the division.
        let height = Self::dot3(way, normal);
        if !height.has_square() {
            return None;
        }
        let length = Self::length_squared_wide(way).sqrt();
        let scale = length.recip();
        Some((way.map(|coordinate| coordinate * scale), length, height * scale))
    }

    /// `pixel + fraction/65536` pixels in units of `2^shift` pixels, where the number system needs units so large
    /// ([`REACH`](Self::REACH)), else in pixels.
    fn from_pixel(pixel: u16, fraction: u16, _shift: u32) -> Self {
        Self::from_u16(pixel) + Self::from_fraction(fraction)
    }

    /// The distance by which a spawned ray leaves its surface, where the numbers in play are as large as
    /// `magnitude`: above every rounding error.
    fn offset(magnitude: Self) -> Self {
        Self::RAY_OFFSET * magnitude
    }

    /// A unit vector times [`offset`](Self::offset), or the opposite.
    #[inline(always)]
    fn offset_along(unit: [Self; 3], magnitude: Self, outward: bool) -> [Self; 3] {
        let offset = Self::offset(if outward { magnitude } else { -magnitude });
        unit.map(|coordinate| coordinate * offset)
    }

    /// The sum of two amounts of light, or the largest number there is.
    fn add_saturating(self, other: Self) -> Self {
        self + other
    }

    /// Whether `value` may be computed with.
    fn holds(value: Self::Setup) -> bool {
        Self::REACH.is_none_or(|reach| !(value.abs() > Self::Setup::from_f32(reach)))
    }

    /// Which of some numbers are no larger than as many others, up to 32: a bit for each.
    #[inline(always)]
    fn no_larger<const N: usize>(numbers: &[Self; N], others: &[Self; N]) -> u32 {
        float::no_larger(numbers, others)
    }

    /// Which of some numbers are less than as many others, up to 32: a bit for each.
    #[inline(always)]
    fn less<const N: usize>(numbers: &[Self; N], others: &[Self; N]) -> u32 {
        float::less(numbers, others)
    }

    /// The absolute value.
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }

    /// The larger of two. Never the platform's `max`, which differs on ±0 between processors.
    fn larger(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    /// The smaller of two: as [`larger`](Self::larger).
    fn smaller(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
}

/// A sum of products before it is rounded to `R`: for floating point, a number like any other.
pub trait Product<R: Real>:
    Copy + Debug + PartialEq + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Send + Sync + 'static
{
    /// 0.
    const ZERO: Self;
    /// The square root; of a negative number, 0 or NaN.
    fn sqrt(self) -> R;
    /// The product with a number that keeps it in range.
    fn times(self, factor: R) -> Self;
    /// The quotient, rounded.
    fn over(self, divisor: R) -> R;
    /// Which share of a whole this is, 0 to 1: of the same sign as the whole, or 0, and not beyond it.
    fn share(self, whole: Self) -> R;
}

/// A linear function over space: `gradient · point + offset`, however steep.
pub trait Linear<R: Real>: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// The function with this gradient that is 0 at the point `zero`.
    fn new(gradient: Vec3<R::Setup>, zero: Vec3<R::Setup>) -> Self;
    /// Its value at a point.
    fn at(&self, point: Vec3<R>) -> R;
    /// Its value at a point, as a cell and the place within: also where the number system has no such large numbers.
    fn cell(&self, point: Vec3<R>) -> Cell<R> {
        self.at(point).split()
    }
    /// The gradient.
    fn gradient(&self) -> Vec3<R::Setup>;
    /// The value at the origin.
    fn offset(&self) -> R::Setup;
}

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
    ($Float:ident, $offset:literal, $sqrt:path, $tan:path, $powf:path, $turn:path, $halved:path, $no_larger:path, $less:path) => {
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

            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }

            #[inline(always)]
            fn is_positive(self) -> bool {
                if cfg!(target_pointer_width = "32") { self.to_bits().cast_signed() > 0 } else { self > 0.0 }
            }

            #[inline(always)]
            fn has_square(self) -> bool {
                const LEAST: $Float = 1.0 / (1u64 << 61) as $Float;
                if cfg!(target_pointer_width = "32") {
                    self.to_bits().cast_signed() >= LEAST.to_bits().cast_signed()
                } else {
                    self >= LEAST
                }
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

            fn factor(value: f32) -> Self {
                value as $Float
            }

            fn cell(self, per_unit: Self) -> i32 {
                (self * per_unit).floor_to_i32()
            }

            fn times(self, other: Self) -> Self {
                self * other
            }

            fn dot3_wide(a: [Self; 3], b: [Self; 3]) -> Self {
                Self::dot3(a, b)
            }

            fn tan(self) -> Self {
                $tan(self)
            }

            fn powf(self, exponent: Self) -> Self {
                $powf(self, exponent)
            }

            fn turn(y: Self, x: Self) -> Self {
                $turn(y, x)
            }

            fn split(self) -> Cell<Self> {
                let index = self.floor_to_i32();
                let within = self - index as $Float;
                // What is far out has no digits left, and what is a little less than 0 is rounded to 1.
                let within = if (0.0..1.0).contains(&within) { within } else { 0.0 };
                Cell { index, within }
            }

            fn halved(self) -> Self {
                $halved(self)
            }

            fn floor_to_i32(self) -> i32 {
                // Truncate, then step down where truncation went up: 8 instructions, where libm's floorf takes 17.
                let truncated = self as i32;
                if (truncated as $Float) > self { truncated.saturating_sub(1) } else { truncated }
            }

            #[inline(always)]
            fn no_larger<const N: usize>(numbers: &[Self; N], others: &[Self; N]) -> u32 {
                $no_larger(numbers, others)
            }

            #[inline(always)]
            fn less<const N: usize>(numbers: &[Self; N], others: &[Self; N]) -> u32 {
                $less(numbers, others)
            }

            fn to_q16(self) -> u32 {
                // The conversion saturates, and makes 0 of what is negative or NaN.
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
