//! Numbers with a fixed point, for processors without a floating-point unit.
//!
//! # The format
//! A [`Fixed`] is an `i32` in units of 2⁻²⁴: ±128, and a unit vector is as exact as in `f32`. Positions have no share in that
//! choice, because [`Scale`](crate::math::Scale) multiplies the scene by a power of two first: its solids then lie within half a unit of the origin, so
//! that they keep 22 bits, and rays are followed 118 times as far. No infinite plane is farther from the eye than that half,
//! so that a floor ends within half a degree of its horizon, and most often within a quarter: one line of the picture. Everything else that is a plain number (light, shares, squares of refractive indices) stays below 59
//! or is refused.
//!
//! Rejected: Q16.16, on which the first prototypes ran. Its unit vectors are off by 2⁻¹⁷, 5e-4 units at a distance of
//! 60, and squares end at 181 units, so that it needs wide products all the same. Rejected as well: a block exponent
//! for each vector, which costs a normalization for each sum. Rejected as well: that a plane which is met too far away is met at the end
//! of the ray. It would be seen up to the horizon from any height, but with shadows of other places than those that the outlines of
//! shadows tell a line of the picture: the same scene without acceleration would be another picture.
//!
//! # No overflow
//! Plain sums and products wrap, because testing each would cost a third of a sphere's intersection on Cortex-M3
//! (which has no saturating addition), and because none can overflow:
//!
//! - Along each axis solids lie within 1/2, flat shapes, eye and lights within 8 units of the origin, and rays start
//!   within 59 ([`Real::REACH`]): a plane is not met beyond. No two of them are farther apart than 67 √3 = 116. Infinite planes pass
//!   the origin within 1/4.
//! - Rays are followed for 59 units, so that `origin + direction · t` is below 118, and its difference from a vertex below
//!   126.
//! - Instances take a ray to where their model is, within 1/2 of its origin. It starts within 59 √3 + 1/2 = 103 there. What is 59 units
//!   on may wrap, to a place that is 93 units or more from the origin: no model is there.
//! - Squares, and what they are compared with, stay 64 bits wide ([`FixedProduct`]): the square of 116 units is
//!   below 2⁶².
//! - What can be large is saturated: quotients, light that is added up ([`Real::add_saturating`]), and numbers that
//!   come from floating point.
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
//! | normal of a ball | 2 units in each coordinate of that place's direction, see [`radius`] |
//! | direction to a light | an angle of 2⁻¹³, see [`coarse`] |
//! | power | see [`power`](self::power) |
//! | angle | 0.6 units of a turn, see [`turn`](self::turn) |
//!
//! # Pictures
//! Beside those in `f64`, at 320×240 in 8 bits of linear light (tests/tests/all/fixed.rs prints this table):
//!
//! | scene | fixed point | `f32` |
//! |---|---|---|
//! | classic | 43.0 dB | 42.4 dB |
//! | whitted | 54.0 dB | 54.1 dB |
//! | flake | 53.5 dB | 56.1 dB |
//! | prism | 57.9 dB | 59.7 dB |
//! | table | 60.3 dB | 60.6 dB |
//!
//! All but 7 to 52 pixels, at edges of which one side or the other is met, are within 1 of 255.

#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
mod armv6m;
mod coarse;
mod linear;
mod newton;
mod power;
mod product;
mod radius;
mod turn;
mod wide;
mod zeros;

pub use linear::FixedLinear;
pub use radius::FixedRadius;
pub use wide::FixedProduct;
pub(crate) use zeros::trailing_zeros;

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::{Cell, Ray, Real, Vec3};
use newton::{Root, recip, root};
use product::{IS_ARMV6M, attenuated, product, scaled};
use zeros::zeros;

/// Bits after the point.
const FRACTION: u32 = 24;

/// A number in units of 2⁻²⁴, for processors without a floating-point unit; and what it asks of a scene.
///
/// # Sizes
/// A scene may be described in any unit: it is scaled by a power of two before it is traced ([`PreparedScene::scale`]). What matters is
/// how large its parts are beside how far it *extends* from the origin. That is the largest of these:
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
/// - Lay the scene around the origin: it extends less, and all of it is more exact.
/// - Radii (of a torus that of its tube, of a cone the wider end) and half the thickness of boxes and polyhedra are a 65,536th of that or
///   more, a 32,768th where there are infinite planes. What is smaller may be refused.
/// - What a picture shows may be much smaller than the scene: 32 times costs few digits (44 dB or more), 256 times more (36 dB), and
///   1,024 times shows in mirrors and glass (30 dB).
/// - The eye sees infinite planes up to about half a degree from the horizon, and most often to a quarter: about a line of the picture.
/// - [`PreparedScene::set_camera`] takes eyes with coordinates of up to 8 divided by the scale, and no farther than 1/2 divided by the
///   scale from an infinite plane. Prepare the scene with the camera that is farthest from the origin, and all others are near enough.
///
/// # Numbers
/// - Light is 59 or less: that of lights, of all ambient lights together, of backgrounds, and a material's own. What a pixel gets is
///   added up to 128 and no further.
/// - Indices of refraction lie between 0.14 and 7.6.
/// - The radii of a cone differ by 7.6 times its length or less. An ellipsoid is at most 59 times as long as
///   it is thick. A bump is at most 59 times as high as its step is wide. The strengths of blobs add up to 59 or less, whatever their sign.
/// - Coordinates of textures that the vertices of a mesh have, and origins of patterns on a surface, are within ±59; origins of patterns
///   in the scene ([`Space::Scene`](crate::Space::Scene)) within ±59 divided by the scale.
///
/// # Accuracy
/// The built-in scenes are 43 to 60 dB from `f64`, as `f32` is: all but a few pixels, at edges, are within 1 of 255. Directions are
/// about as exact as in `f32`; positions have 22 bits of how far the scene extends, or 21 where there are infinite planes.
///
/// # Errors
/// | fault | what does not fit | what to do |
/// |---|---|---|
/// | [`TooSmall`](crate::Fault::TooSmall) | a size | enlarge it, or bring what extends farthest nearer to the origin |
/// | [`OutOfRange`](crate::Fault::OutOfRange) | a number | keep it in the limits above |
/// | [`BeyondReach`](crate::Fault::BeyondReach) | an eye in `set_camera` | prepare the scene with that camera |
/// | [`BakedOtherwise`](crate::Fault::BakedOtherwise) | a mesh that was baked for another number system or scale | bake the scene again |
///
/// In `f32` all of these are legal, but for the last.
///
/// [`PreparedScene::scale`]: crate::PreparedScene::scale
/// [`PreparedScene::set_camera`]: crate::PreparedScene::set_camera
///
/// # Guarantees
/// All operations are defined for all values, and give the same bits on every processor: sums and products wrap,
/// quotients and conversions saturate.
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

    /// The nearest of these numbers to many units, shifted down by 1 to 63.
    #[inline(always)]
    fn shifted(bits: i64, down: u32) -> Self {
        if IS_ARMV6M { Self::shifted_by_words(bits, down) } else { Self::saturated(bits >> (down & 63)) }
    }

    /// The same. On ARMv6-M, to shift two words together is a call.
    #[inline(always)]
    fn shifted_by_words(bits: i64, down: u32) -> Self {
        let (high, low) = ((bits >> 32) as i32, bits as u32);
        if down & 32 != 0 {
            return Self(high >> (down & 31));
        }
        let down = down & 31;
        // What is lost above must be copies of the sign.
        let shifted = (high << 1 << (31 - down)) as u32 | low >> down;
        let sign = high >> 31;
        let is_held = high >> down == sign && (shifted as i32) >> 31 == sign;
        Self(if is_held { shifted as i32 } else { sign ^ i32::MAX })
    }

    /// The nearest of these numbers to many units of 2⁻²⁴.
    #[inline(always)]
    fn saturated(bits: i64) -> Self {
        let low = bits as i32;
        if i64::from(low) == bits { Self(low) } else { Self(if bits < 0 { i32::MIN } else { i32::MAX }) }
    }
}

impl Add for Fixed {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl Sub for Fixed {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }
}

impl Neg for Fixed {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.wrapping_neg())
    }
}

impl Mul for Fixed {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(scaled(self.0, other.0))
    }
}

impl Div for Fixed {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.0 == 0 {
            return Self(if self.0 < 0 { i32::MIN } else { i32::MAX });
        }
        let (zeros, inverse) = inverse(other);
        // The divisor is 2⁽⁸⁻ᶻᵉʳᵒˢ⁾ times a number in [1/2, 1), of which `inverse` holds the reciprocal in 30 bits.
        let quotient = Self::shifted(product(self.0, inverse), 38u32.wrapping_sub(zeros));
        if other.0 < 0 { Self(quotient.0.saturating_neg()) } else { quotient }
    }
}

/// Leading zeros of the absolute value, and the reciprocal of the digits after them.
#[inline(always)]
fn inverse(divisor: Fixed) -> (u32, i32) {
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    if IS_ARMV6M {
        return armv6m::inverse(divisor.0);
    }
    let digits = divisor.0.unsigned_abs();
    let zeros = zeros(digits) & 31;
    (zeros, recip(digits << zeros) as i32)
}

impl Real for Fixed {
    type Setup = f32;
    type Product = FixedProduct;
    type Factor = Factor;
    type Linear = FixedLinear;
    type Radius = FixedRadius;

    const ZERO: Self = Self(0);
    const ONE: Self = Self::ONE;
    const FARTHEST: Self = Self(59 << FRACTION);
    // A 2¹⁷th part for what grows with the number: directions and normals are off by 2⁻²⁴. See `offset`.
    const RAY_OFFSET: Self = Self(1 << (FRACTION - 17));
    const REACH: Option<f32> = Some(59.0);
    const SEEKS_FACTORS: bool = true;
    const COARSE: f32 = 1.0 / 8192.0;
    const ASTRAY: f32 = coarse::ASTRAY;
    const SAVES_PRODUCTS: bool = IS_ARMV6M;

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

    fn from_pixel(pixel: u16, fraction: u16, shift: u32) -> Self {
        let position = u32::from(pixel) << 16 | u32::from(fraction);
        let down = shift.wrapping_sub(FRACTION - 16) & 31;
        Self(
            (if shift >= FRACTION - 16 { position >> down } else { position << (FRACTION - 16 - shift) })
                as i32,
        )
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
        // Of most factors the upper half alone counts. A shift of 64 bits is a call on some processors.
        match (per_unit.shift + FRACTION).checked_sub(32) {
            Some(shift) => ((product >> 32) as i32) >> shift.min(31),
            None => (product >> (per_unit.shift + FRACTION)) as i32,
        }
    }

    fn turn(y: Self, x: Self) -> Self {
        Self(turn::turn(y.0, x.0) & ((1 << FRACTION) - 1))
    }

    fn split(self) -> Cell<Self> {
        Cell { index: self.0 >> FRACTION, within: Self(self.0 & ((1 << FRACTION) - 1)) }
    }

    fn floor_to_i32(self) -> i32 {
        self.0 >> FRACTION
    }

    fn to_q16(self) -> u32 {
        let bits = self.0.clamp(0, 1 << FRACTION) as u32;
        bits.wrapping_add(1 << (FRACTION - 17)) >> (FRACTION - 16)
    }

    fn add_saturating(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }

    #[inline(always)]
    fn times_few(vector: [Self; 3], few: Self) -> [Self; 3] {
        // The same bits in fewer instructions, where the number is below 2 and has no digits but those that `attenuated` takes.
        if IS_ARMV6M && few.0 as u32 >> (FRACTION + 1) == 0 && few.0 << 23 == 0 {
            return vector.map(|coordinate| coordinate.attenuated(few));
        }
        vector.map(|coordinate| coordinate * few)
    }

    #[inline(always)]
    fn attenuated(self, share: Self) -> Self {
        Self(attenuated(self.0, share.0))
    }

    #[inline(always)]
    fn dot3(a: [Self; 3], b: [Self; 3]) -> Self {
        #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
        {
            Self(armv6m::dot3(a.map(Self::to_bits), b.map(Self::to_bits)))
        }
        #[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
        Self((FixedProduct::dot3(a, b).bits() >> FRACTION) as i32)
    }

    #[inline(always)]
    fn coarse(self) -> Self {
        if IS_ARMV6M { Self(coarse::coordinate(self.0)) } else { self }
    }

    #[inline(always)]
    fn dot3_coarse(a: [Self; 3], b: [Self; 3]) -> Self {
        if IS_ARMV6M {
            Self(coarse::dot3(a.map(Self::to_bits), b.map(Self::to_bits)))
        } else {
            Self::dot3(a, b)
        }
    }

    #[inline(always)]
    fn is_central(Vec3 { x, y, z }: Vec3<Self>) -> bool {
        Self::SAVES_PRODUCTS && coarse::is_central([x.0, y.0, z.0])
    }

    #[inline(always)]
    fn misses_ball(ray: &Ray<Self>, center: Vec3<Self>, radius: Self) -> bool {
        let bits = |vector: Vec3<Self>| [vector.x.0, vector.y.0, vector.z.0];
        Self::SAVES_PRODUCTS && coarse::misses_ball(bits(ray.origin - center), bits(ray.direction), radius.0)
    }

    fn times(self, other: Self) -> FixedProduct {
        FixedProduct::new(product(self.0, other.0))
    }

    fn dot3_wide(a: [Self; 3], b: [Self; 3]) -> FixedProduct {
        FixedProduct::dot3(a, b)
    }

    fn length_squared_wide(vector: [Self; 3]) -> FixedProduct {
        FixedProduct::length_squared(vector)
    }

    #[inline(always)]
    fn polar(vector: [Self; 3]) -> ([Self; 3], Self) {
        let Root { length, inverse, up } = root(FixedProduct::length_squared(vector).bits() as u64);
        // Each coordinate is shifted up as far as fits before it is scaled, and rounded afterwards.
        let unit = |Self(x): Self| {
            let upper = (product(x << up, inverse as i32) >> 32) as i32;
            Self(upper.wrapping_add(1 << 4) >> 5)
        };
        (vector.map(unit), Self(length as i32))
    }

    #[inline(always)]
    fn unit(vector: [Self; 3]) -> [Self; 3] {
        #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
        if IS_ARMV6M {
            return armv6m::unit(vector.map(Self::to_bits)).map(Self);
        }
        Self::polar(vector).0
    }

    #[inline(always)]
    fn on_ball(place: [Self; 3], radius: &FixedRadius) -> ([Self; 3], [Self; 3]) {
        radius::on_ball(place, radius)
    }

    #[inline(always)]
    fn toward_light(way: [Self; 3], normal: [Self; 3]) -> Option<([Self; 3], Self, Self)> {
        let (unit, length, cosine) = coarse::toward_light(way.map(Self::to_bits), normal.map(Self::to_bits))?;
        let unit = unit.map(Self);
        // A ray along a direction that points below the surface would meet the surface itself: there is no
        // light then.
        if cosine < coarse::LOW && Self::dot3(unit, normal) <= Self::ZERO {
            return None;
        }
        Some((unit, Self(length), Self(cosine)))
    }

    fn offset(magnitude: Self) -> Self {
        // A point that was computed is off by a few units; 16 of them are 4e-6 of the scene.
        Self((magnitude.0 >> 17).wrapping_add(16))
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

/// A number of any magnitude, for what is multiplied but never added: `mantissa / 2^shift`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Factor {
    mantissa: i32,
    shift: u32,
}

impl Factor {
    /// The nearest factor with 30 digits after the point or fewer; what is larger than 2³⁰ saturates.
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
