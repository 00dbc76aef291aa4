//! Numbers with a fixed point, for processors without a floating-point unit.
//!
//! # The format
//! A [`Fixed`] is an `i32` in units of 2⁻²⁴: ±128, and a unit vector is as exact as in `f32`. Positions have
//! no share in that choice, because [`Scale`](crate::math::Scale) multiplies the scene by a power of two
//! first: its solids then lie within half a unit of the origin, so that they keep 22 bits, and rays are
//! followed 118 times as far. No infinite plane is farther from the eye than half a unit, so that a floor
//! ends within half a degree of its horizon, and most often within a quarter: one line of the picture. All
//! other plain numbers (light, shares, squares of refractive indices) stay below 59 or are refused.
//!
//! Rejected formats: docs/experiments.md.
//!
//! # No overflow
//! Plain sums and products wrap, because testing each would cost a third of a sphere's intersection on
//! Cortex-M3 (which has no saturating addition), and because none can overflow:
//!
//! - Along each axis solids lie within 1/2, flat shapes, eye and lights within 8 units of the origin, and
//!   rays start within 59 ([`Real::FARTHEST`]): a plane is not met beyond. No two of them are farther apart
//!   than 67 √3 = 116. Infinite planes pass the origin within 1/4.
//! - Rays are followed for 59 units, so that `origin + direction · t` is below 118, and its difference from a
//!   vertex below 126.
//! - Instances move a ray into the space of their model, which lies within 1/2 of its origin. The ray starts
//!   within 59 √3 + 1/2 = 103 units there. A point 59 units on may wrap, to a place 93 units or more from the
//!   origin, where no model is.
//! - Squares, and the numbers they are compared with, stay 64 bits wide ([`FixedProduct`]): the square of 116
//!   units is below 2⁶².
//! - Numbers that can be large saturate: quotients, sums of light (`Kernel::add_saturating`), and numbers
//!   from floating point.
//!
//! # Roundings
//! | function | off by at most |
//! |---|---|
//! | `+`, `-` | exact |
//! | `*`, scalar product | 1 unit of 2⁻²⁴, downward, however many products are added up |
//! | light times a share | 2⁻¹⁵ of the light, downward |
//! | `/`, reciprocal | 2⁻²⁵ of the value, and 1 unit |
//! | square root, length | 2⁻²⁴ of the value, and 1 unit |
//! | unit vector | 2 units in each coordinate, if the vector is longer than 2⁻¹ |
//! | direction to a light | an angle of 2⁻¹³; length and cosine: 2⁻¹², and 2⁻¹³ for the cosine |
//! | power | see [`power`](self::power) |
//! | angle | 0.6 units of a turn, see [`turn`](self::turn) |
//!
//! # Pictures
//! Compared with pictures in `f64`, at 320×240 in 8 bits of linear light (tests/tests/all/fixed.rs prints
//! this table):
//!
//! | scene | fixed point | `f32` |
//! |---|---|---|
//! | classic | 43.0 dB | 42.4 dB |
//! | whitted | 54.0 dB | 54.1 dB |
//! | flake | 53.5 dB | 56.1 dB |
//! | prism | 57.9 dB | 59.7 dB |
//! | table | 60.3 dB | 60.6 dB |
//!
//! All pixels are within 1 of 255, but for 7 to 52 at edges, where a ray meets one side or the other.

mod arch;
mod linear;
mod newton;
mod power;
mod turn;
mod wide;

pub use linear::FixedLinear;
pub use wide::FixedProduct;

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::real::Kernel;
use super::{LatticeCoordinate, Ray, Real, Vec3};
use arch::product;

/// Bits after the point.
const FRACTION: u32 = 24;

/// A number in units of 2⁻²⁴, for processors without a floating-point unit. A scene must keep the limits
/// below.
///
/// # Sizes
/// A scene may be described in any unit: it is scaled by a power of two before it is traced
/// ([`PreparedScene::scale`]). Its parts must not be too small compared with its *extent*, the largest of
/// these distances from the origin:
///
/// | part | counts with |
/// |---|---|
/// | spheres and other curved shapes; instances | the farthest coordinate |
/// | flat shapes, boxes, polyhedra, meshes | 1/16 of the farthest coordinate |
/// | the eye | 1/16 of its distance from the origin |
/// | lights | nothing: they may be anywhere |
/// | *where there are infinite planes:* these | their distance from the origin |
/// | the eye | its farthest coordinate, and half of the distance from the origin to it and on to the plane |
/// | flat shapes, boxes, polyhedra, meshes | 1/32 of the farthest coordinate |
///
/// - Lay the scene around the origin: its extent is smaller, and all of it is more exact.
/// - Radii (of the tube of a torus, of the wider end of a cone), half the thickness of boxes and polyhedra,
///   and the height of rectangles and triangles above each edge must be a 65,536th of the extent or more, a
///   32,768th in a scene with infinite planes. Smaller parts may be refused.
/// - A picture may show a small part of the scene: a 32nd costs few digits (44 dB or more), a 256th more (36
///   dB), and a 1,024th shows in mirrors and glass (30 dB).
/// - The eye sees infinite planes up to about half a degree from the horizon, and most often to a quarter:
///   about a line of the picture.
/// - [`PreparedScene::set_camera`] takes eyes with coordinates of up to 8 divided by the scale, and no
///   farther than 1/2 divided by the scale from an infinite plane. Prepare the scene with the camera that is
///   farthest from the origin, and all others are near enough.
///
/// # Numbers
/// - The light of each light, of all ambient lights together, of the background, and of a glowing material is
///   59 or less. The sum for a pixel saturates at 128.
/// - Indices of refraction lie between 0.14 and 7.6.
/// - The radii of a cone differ by 7.6 times its length or less. An ellipsoid is at most 59 times as long as
///   it is thick. A bump is at most 59 times as high as its step is wide. The strengths of blobs add up to 59
///   or less, whatever their sign.
/// - Coordinates of textures that the vertices of a mesh have, and origins of patterns on a surface, are
///   within ±59; origins of patterns in the scene ([`Space::Scene`](crate::Space::Scene)) within ±59 divided
///   by the scale.
///
/// # Accuracy
/// The built-in scenes are 43 to 60 dB from `f64`, as `f32` is: all but a few pixels, at edges, are within 1
/// of 255. Directions are about as exact as in `f32`; positions have 22 bits of the extent, or 21 in a scene
/// with infinite planes.
///
/// # Errors
/// | fault | cause | what to do |
/// |---|---|---|
/// | [`TooSmall`](crate::Fault::TooSmall) | a size is too small | enlarge it, or reduce the extent |
/// | [`OutOfRange`](crate::Fault::OutOfRange) | a number is too large | keep it in the limits above |
/// | [`BeyondReach`](crate::Fault::BeyondReach) | an eye is too far | prepare the scene with that camera |
/// | [`BakedOtherwise`](crate::Fault::BakedOtherwise) | other baked numbers | bake the scene again |
///
/// In `f32` the last fault alone occurs.
///
/// [`PreparedScene::scale`]: crate::PreparedScene::scale
/// [`PreparedScene::set_camera`]: crate::PreparedScene::set_camera
///
/// # Guarantees
/// All operations are defined for all values, and give the same bits on every processor: sums and products
/// wrap, quotients and conversions saturate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fixed(i32);

impl Fixed {
    const ONE: Self = Self(1 << FRACTION);

    /// The number of `bits` times 2⁻²⁴.
    pub const fn from_bits(bits: i32) -> Self {
        Self(bits)
    }

    /// The number in units of 2⁻²⁴.
    pub const fn to_bits(self) -> i32 {
        self.0
    }

    /// The nearest of these numbers to many units of 2⁻²⁴.
    #[inline]
    fn saturated(bits: i64) -> Self {
        let low = bits as i32;
        if i64::from(low) == bits { Self(low) } else { Self(if bits < 0 { i32::MIN } else { i32::MAX }) }
    }
}

impl Add for Fixed {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl Sub for Fixed {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }
}

impl Neg for Fixed {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(self.0.wrapping_neg())
    }
}

impl Mul for Fixed {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self(arch::scaled_product(self.0, other.0))
    }
}

impl Div for Fixed {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.0 == 0 {
            return Self(if self.0 < 0 { i32::MIN } else { i32::MAX });
        }
        let (zeros, inverse) = arch::inverse(other.0);
        // The divisor is 2⁽⁸⁻ᶻᵉʳᵒˢ⁾ times a number in [1/2, 1), of which `inverse` holds the reciprocal in 30
        // bits.
        let quotient = Self(arch::shifted(product(self.0, inverse), 38u32.wrapping_sub(zeros)));
        if other.0 < 0 { Self(quotient.0.saturating_neg()) } else { quotient }
    }
}

impl Real for Fixed {
    type Setup = f32;
    type Product = FixedProduct;
    type Factor = Factor;
    type Linear = FixedLinear;

    const ZERO: Self = Self(0);
    const ONE: Self = Self::ONE;
    const FARTHEST: Self = Self(59 << FRACTION);
    // A 2¹⁷th part for what grows with the number: directions and normals are off by 2⁻²⁴. See `offset`.
    const RAY_OFFSET: Self = Self(1 << (FRACTION - 17));
    const IS_FIXED_POINT: bool = true;

    fn from_f32(value: f32) -> Self {
        // Truncation after adding a half is rounding; large numbers saturate, and NaN is 0.
        let bits = value * (1u32 << FRACTION) as f32;
        Self((if bits < 0.0 { bits - 0.5 } else { bits + 0.5 }) as i32)
    }

    fn to_f32(self) -> f32 {
        self.0 as f32 * (1.0 / (1u32 << FRACTION) as f32)
    }

    fn from_u16(value: u16) -> Self {
        Self((i32::from(value).min(127)) << FRACTION)
    }

    fn from_fraction(value: u16) -> Self {
        Self(i32::from(value) << (FRACTION - 16))
    }

    fn from_setup(value: f32) -> Self {
        Self::from_f32(value)
    }

    fn to_setup(self) -> f32 {
        self.to_f32()
    }

    fn sqrt(self) -> Self {
        FixedProduct::new(i64::from(self.0) << FRACTION).root()
    }

    fn turn(y: Self, x: Self) -> Self {
        Self(turn::turn(y.0, x.0) & ((1 << FRACTION) - 1))
    }

    fn split(self) -> LatticeCoordinate<Self> {
        LatticeCoordinate { index: self.0 >> FRACTION, within: Self(self.0 & ((1 << FRACTION) - 1)) }
    }

    fn floor_to_i32(self) -> i32 {
        self.0 >> FRACTION
    }

    // Forced, as in the rest of this file: without it, `classic` takes an M3 1.026 times the instructions.
    #[inline(always)]
    fn dot3(a: [Self; 3], b: [Self; 3]) -> Self {
        Self(arch::dot3(a.map(Self::to_bits), b.map(Self::to_bits)))
    }

    fn times(self, other: Self) -> FixedProduct {
        FixedProduct::new(product(self.0, other.0))
    }

    fn dot3_wide(a: [Self; 3], b: [Self; 3]) -> FixedProduct {
        FixedProduct::dot3(a, b)
    }

    #[inline(always)]
    fn unit_and_length(vector: [Self; 3]) -> ([Self; 3], Self) {
        let root = arch::root(FixedProduct::length_squared(vector).bits() as u64);
        let unit = |Self(coordinate): Self| Self(root.unit_coordinate(coordinate, product));
        (vector.map(unit), Self(root.length as i32))
    }

    #[inline(always)]
    fn unit(vector: [Self; 3]) -> [Self; 3] {
        arch::unit(vector.map(Self::to_bits)).map(Self)
    }

    fn offset(magnitude: Self) -> Self {
        // A computed point is off by a few units; 16 units are 4e-6 of the scene.
        Self((magnitude.0 >> 17).wrapping_add(16))
    }
}

impl Kernel for Fixed {
    fn from_pixel(pixel: u16, fraction: u16, shift: u32) -> Self {
        let position = u32::from(pixel) << 16 | u32::from(fraction);
        let down = shift.wrapping_sub(FRACTION - 16) & 31;
        Self(
            (if shift >= FRACTION - 16 { position >> down } else { position << (FRACTION - 16 - shift) })
                as i32,
        )
    }

    fn tan(self) -> Self {
        Self::from_f32(libm::tanf(self.to_f32()))
    }

    fn factor(value: f32) -> Factor {
        Factor::new(value)
    }

    fn powf(self, exponent: Factor) -> Self {
        if self >= Self::ONE || exponent.mantissa < 0 {
            return Self::ONE;
        }
        Self(power::power(self.0.max(0) as u32, exponent.mantissa as u32, exponent.shift) as i32)
    }

    fn halved(self) -> Self {
        Self(power::power(1 << (FRACTION - 1), self.0.max(0) as u32, FRACTION) as i32)
    }

    fn cell(self, per_unit: Factor) -> i32 {
        if per_unit.mantissa == 0 {
            return 0;
        }
        let product = product(self.0, per_unit.mantissa);
        // For most factors the upper word suffices. A shift of 64 bits is a call on some processors.
        match (per_unit.shift + FRACTION).checked_sub(32) {
            Some(shift) => ((product >> 32) as i32) >> shift.min(31),
            None => (product >> (per_unit.shift + FRACTION)) as i32,
        }
    }

    fn to_q16(self) -> u32 {
        let bits = self.0.clamp(0, 1 << FRACTION) as u32;
        bits.wrapping_add(1 << (FRACTION - 17)) >> (FRACTION - 16)
    }

    fn add_saturating(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }

    #[inline(always)]
    fn attenuated(self, share: Self) -> Self {
        Self(arch::attenuated(self.0, share.0))
    }

    #[inline(always)]
    fn dot3_sparse(sparse: [Self; 3], other: [Self; 3]) -> Self {
        Self(arch::dot3_sparse(sparse.map(Self::to_bits), other.map(Self::to_bits)))
    }

    #[inline(always)]
    fn dot3_bounds(a: [Self; 3], b: [Self; 3]) -> (Self, Self) {
        let (lower, upper) = arch::dot3_bounds(a.map(Self::to_bits), b.map(Self::to_bits));
        (Self(lower), Self(upper))
    }

    #[inline(always)]
    fn misses_ball(ray: &Ray<Self>, center: Vec3<Self>, radius: Self) -> bool {
        let bits = |vector: Vec3<Self>| [vector.x.0, vector.y.0, vector.z.0];
        arch::misses_ball(bits(ray.origin - center), bits(ray.direction), radius.0)
    }

    fn length_squared_wide(vector: [Self; 3]) -> FixedProduct {
        FixedProduct::length_squared(vector)
    }

    #[inline(always)]
    fn toward_light(way: [Self; 3], normal: [Self; 3]) -> Option<([Self; 3], Self, Self)> {
        let (unit, length, cosine) = arch::toward_light(way.map(Self::to_bits), normal.map(Self::to_bits))?;
        let unit = unit.map(Self);
        // A ray along a direction that points below the surface would meet the surface itself: there is no
        // light then.
        if cosine < arch::LOW_COSINE && Self::dot3(unit, normal) <= Self::ZERO {
            return None;
        }
        Some((unit, Self(length), Self(cosine)))
    }

    fn toward_light_error(distance: f32) -> f32 {
        distance * arch::TOWARD_LIGHT_ERROR
    }

    #[inline(always)]
    fn offset_along(unit: [Self; 3], magnitude: Self, outward: bool) -> [Self; 3] {
        // Below 2¹⁴: with 16 digits of the vector, products have 31.
        let Self(offset) = Self::offset(magnitude);
        unit.map(|Self(coordinate)| {
            let along = (coordinate >> 8).wrapping_mul(offset) >> 16;
            Self(if outward { along } else { along.wrapping_neg() })
        })
    }
}

/// A number of any magnitude, which is multiplied but never added: `mantissa / 2^shift`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Factor {
    mantissa: i32,
    shift: u32,
}

impl Factor {
    /// The nearest factor with 30 digits after the point or fewer; values beyond ±10⁹ saturate.
    fn new(value: f32) -> Self {
        let mut mantissa = if value.abs() < 1e9 { value } else { 1e9f32.copysign(value) };
        let mut shift = 0;
        while shift < 30 && mantissa.abs() < (1u32 << 29) as f32 {
            mantissa *= 2.0;
            shift += 1;
        }
        Self { mantissa: mantissa as i32, shift }
    }
}

#[cfg(test)]
mod tests;
