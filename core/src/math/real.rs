//! The number systems that rays are traced in.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use super::{LatticeCoordinate, Ray, Vec3, float};

/// A number system that rays are traced in: `f32`, `f64` or [`Fixed`](super::Fixed).
///
/// A scene is always *described* in `f32`; `Real` is what it is prepared for and traced in. The trait demands
/// nothing that only floating point has: no infinity, no NaN, no exponent. Sums of products and linear
/// functions, which need more digits or more range, have types of their own; in floating point these are
/// plain numbers.
///
/// This trait is sealed: it requires a hidden trait, which may change in any release.
///
/// # Guarantees
/// For the types in this crate every function gives the same bits on every processor, unless the feature
/// `micromath` is on.
pub trait Real: Kernel {
    /// The floating-point number in which a scene is prepared, before the first ray.
    type Setup: Real<Setup = Self::Setup>;
    /// A sum of products, before it is rounded.
    type Product: Product<Self>;
    /// A number of any magnitude, which is multiplied but never added.
    type Factor: Copy + Debug + PartialEq + Send + Sync + 'static;
    /// A linear function over space.
    type Linear: Linear<Self>;

    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// The length of a ray that meets nothing, in units of the traced scene. In fixed point also the largest
    /// coordinate and the largest plain number.
    const FARTHEST: Self;
    /// The distance by which a spawned ray leaves its surface, relative to the magnitude of the coordinates.
    /// All rays that leave a surface use it: see [`Ray::spawn`](super::Ray::spawn) and
    /// [`offset`](Self::offset).
    const RAY_OFFSET: Self;
    /// `true` for numbers with a fixed point: their range is small, a quotient takes many instructions, and a
    /// product that may overflow must be kept in a [`Product`](Self::Product). A scene is scaled into their
    /// range before it is traced, see [`Scale`](super::Scale).
    const IS_FIXED_POINT: bool = false;

    /// The nearest representable value.
    fn from_f32(value: f32) -> Self;
    /// The nearest `f32`.
    fn to_f32(self) -> f32;
    /// A count or a pixel coordinate, exactly.
    fn from_u16(value: u16) -> Self;
    /// `value / 65536`: a number in `[0, 1)`, exactly.
    fn from_fraction(value: u16) -> Self;
    /// A number from the preparation, rounded.
    fn from_setup(value: Self::Setup) -> Self;
    /// The number in the number system of the preparation.
    fn to_setup(self) -> Self::Setup;
    /// The square root, correctly rounded in floating point. The root of a negative number is 0 or NaN.
    fn sqrt(self) -> Self;
    /// The angle of the vector (x, y) from the x axis, counterclockwise, in turns: at least 0, less than 1,
    /// and 0 for the vector of length 0. The error is at most 2⁻²³ in `f32`, 2⁻⁵¹ in `f64`, and 0.6 · 2⁻²⁴ in
    /// fixed point.
    fn turn(y: Self, x: Self) -> Self;
    /// The largest whole number not above `self`, and the rest.
    fn split(self) -> LatticeCoordinate<Self>;
    /// The largest integer not above `self`, saturating.
    fn floor_to_i32(self) -> i32;
    /// The product, not yet rounded.
    fn times(self, other: Self) -> Self::Product;
    /// The sum of three products, not yet rounded.
    fn dot3_wide(a: [Self; 3], b: [Self; 3]) -> Self::Product;

    /// The sum of three products. It is rounded once where a number system has a wide accumulator.
    fn dot3(a: [Self; 3], b: [Self; 3]) -> Self {
        let [ax, ay, az] = a;
        let [bx, by, bz] = b;
        ax * bx + ay * by + az * bz
    }

    /// The unit vector along a vector, and the vector's length. If the length is 0, the unit vector has no
    /// meaning.
    fn unit_and_length(vector: [Self; 3]) -> ([Self; 3], Self) {
        let length = Self::length_squared_wide(vector).sqrt();
        let scale = length.recip();
        (vector.map(|coordinate| coordinate * scale), length)
    }

    /// The unit vector along a vector. If the vector's length is 0, the unit vector has no meaning.
    #[inline]
    fn unit(vector: [Self; 3]) -> [Self; 3] {
        Self::unit_and_length(vector).0
    }

    /// The distance by which a spawned ray leaves its surface, where the largest number in the computation of
    /// the point is `magnitude`: above every rounding error.
    fn offset(magnitude: Self) -> Self {
        Self::RAY_OFFSET * magnitude
    }

    /// `true` if the number system has room for `value`, a number from the preparation.
    fn fits(value: Self::Setup) -> bool {
        !Self::IS_FIXED_POINT || !(value.abs() > Self::FARTHEST.to_setup())
    }

    /// `1 / self`.
    fn recip(self) -> Self {
        Self::ONE / self
    }

    /// The absolute value.
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }

    /// The larger of two numbers. Never the platform's `max`, which differs on ±0 between processors.
    fn larger(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    /// The smaller of two numbers. Never the platform's `min`, which differs on ±0 between processors.
    fn smaller(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
}

/// The operations of a number system that only this crate and its tests use. The trait seals [`Real`].
///
/// Some operations have a default that is right for all number systems. A number system or a processor with a
/// faster way overrides the default.
pub trait Kernel:
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
    /// The tangent of an angle in radians, for camera set-up only: it is slow.
    fn tan(self) -> Self;
    /// The nearest factor.
    fn factor(value: f32) -> Self::Factor
    where
        Self: Real;
    /// `self` to the power `exponent`, for `self` in `[0, 1]` and `exponent ≥ 0`.
    fn powf(self, exponent: Self::Factor) -> Self
    where
        Self: Real;
    /// 2 to the power `-self`, for `self ≥ 0`: the share that is left after `self` half-lives.
    fn halved(self) -> Self;
    /// The number of the cell in which a coordinate lies, of `per_unit` cells in each unit:
    /// `floor(self · per_unit)`. Beyond the range of the number system, the number wraps, and so stays even
    /// or odd, or it is the same for all cells.
    fn cell(self, per_unit: Self::Factor) -> i32
    where
        Self: Real;
    /// `self` clamped to `[0, 1]`, in units of 1/65536, rounded to nearest; NaN gives 0.
    fn to_q16(self) -> u32;

    /// `pixel + fraction/65536` pixels: in units of `2^shift` pixels if the number system
    /// [has a fixed point](Real::IS_FIXED_POINT), else in pixels.
    fn from_pixel(pixel: u16, fraction: u16, _shift: u32) -> Self
    where
        Self: Real,
    {
        Self::from_u16(pixel) + Self::from_fraction(fraction)
    }

    /// The sum of two amounts of light, or the largest number there is.
    fn add_saturating(self, other: Self) -> Self {
        self + other
    }

    /// An amount of light times a share of 0 to 1. The share may be cut to 16 bits: a display shows fewer
    /// levels.
    #[inline]
    fn attenuated(self, share: Self) -> Self {
        self * share
    }

    /// The squared length of a vector, not yet rounded.
    #[inline]
    fn length_squared_wide(vector: [Self; 3]) -> Self::Product
    where
        Self: Real,
    {
        Self::dot3_wide(vector, vector)
    }

    /// A unit vector times [`offset`](Real::offset) of `magnitude`, or the opposite vector if not `outward`.
    #[inline]
    fn offset_along(unit: [Self; 3], magnitude: Self, outward: bool) -> [Self; 3]
    where
        Self: Real,
    {
        let offset = Self::offset(if outward { magnitude } else { -magnitude });
        unit.map(|coordinate| coordinate * offset)
    }

    /// The sum of three products, where the first vector often lies along an axis, as the normals of floors
    /// and walls do.
    #[inline]
    fn dot3_sparse(sparse: [Self; 3], other: [Self; 3]) -> Self
    where
        Self: Real,
    {
        Self::dot3(sparse, other)
    }

    /// A lower and an upper bound of the scalar product of two unit vectors: 2⁻¹² apart where products are
    /// slow, else both the exact product. If a bound decides a comparison, the exact product is not needed.
    #[inline]
    fn dot3_bounds(a: [Self; 3], b: [Self; 3]) -> (Self, Self)
    where
        Self: Real,
    {
        let product = Self::dot3(a, b);
        (product, product)
    }

    /// `true` if a test that is faster than an intersection shows that a ray misses a ball; `false` proves
    /// nothing.
    #[inline]
    fn misses_ball(_ray: &Ray<Self>, _center: Vec3<Self>, _radius: Self) -> bool {
        false
    }

    /// From the way from a point to a light: the unit vector, the length, and the cosine of the angle with a
    /// unit normal; `None` if the light is not above the surface. The direction may have fewer digits than
    /// others, see [`toward_light_error`](Self::toward_light_error).
    #[inline]
    fn toward_light(way: [Self; 3], normal: [Self; 3]) -> Option<([Self; 3], Self, Self)>
    where
        Self: Real,
    {
        // Lights behind a surface are the most frequent: find them before the root and the division. In
        // floating point, the square of a height below this is 0, and that of the length may be, too.
        let height = Self::dot3(way, normal);
        if !(height >= Self::from_f32(1.0 / (1u64 << 61) as f32)) {
            return None;
        }
        let length = Self::length_squared_wide(way).sqrt();
        let scale = length.recip();
        Some((way.map(|coordinate| coordinate * scale), length, height * scale))
    }

    /// The largest distance at which a ray in the direction of [`toward_light`](Self::toward_light) passes a
    /// light that is this far away.
    fn toward_light_error(_distance: Self::Setup) -> Self::Setup
    where
        Self: Real,
    {
        Self::Setup::ZERO
    }

    /// Which of some numbers are no larger than as many others, up to 32: a bit for each.
    #[inline]
    fn no_larger<const N: usize>(numbers: &[Self; N], others: &[Self; N]) -> u32 {
        float::no_larger(numbers, others)
    }

    /// Which of some numbers are less than as many others, up to 32: a bit for each.
    #[inline]
    fn less<const N: usize>(numbers: &[Self; N], others: &[Self; N]) -> u32 {
        float::less(numbers, others)
    }
}

/// A sum of products before it is rounded to `R`; in floating point, a plain number.
pub trait Product<R: Real>:
    Copy + Debug + PartialEq + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Send + Sync + 'static
{
    /// 0.
    const ZERO: Self;
    /// The square root. The root of a negative number is 0 or NaN.
    fn sqrt(self) -> R;
    /// The product with a number. It must be in range.
    fn times(self, factor: R) -> Self;
    /// The quotient, rounded.
    fn over(self, divisor: R) -> R;
    /// `self / whole`, for a `self` between 0 and `whole`.
    fn share(self, whole: Self) -> R;
}

/// A linear function over space: `gradient · point + offset`, however steep.
pub trait Linear<R: Real>: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// The function with this gradient that is 0 at the point `zero`.
    fn new(gradient: Vec3<R::Setup>, zero: Vec3<R::Setup>) -> Self;
    /// The value at a point.
    fn at(&self, point: Vec3<R>) -> R;
    /// The value at a point, [split](Real::split) into whole number and rest. It may be beyond the range of
    /// the number system.
    fn split_at(&self, point: Vec3<R>) -> LatticeCoordinate<R> {
        self.at(point).split()
    }
    /// The gradient.
    fn gradient(&self) -> Vec3<R::Setup>;
    /// The value at the origin.
    fn offset(&self) -> R::Setup;
}
