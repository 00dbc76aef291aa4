//! Linear functions over space in fixed point.

use super::arch::dot3_wide_sparse;
use super::{FRACTION, Fixed};
use crate::math::real::{Linear, Real};
use crate::math::{LatticeCoordinate, Vec3};

/// A linear function over space, for instance a barycentric coordinate of a triangle.
///
/// A triangle of size 10⁻³ has a gradient of 10³: the gradient has an exponent of its own, chosen so that it
/// keeps all digits, and the sum is exact until it is shifted down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedLinear {
    /// The gradient in units of 2⁻³⁰ · 2^exponent: the largest coordinate has 30 digits.
    gradient: [i32; 3],
    /// The value at the origin, in units of the sum.
    offset: i64,
    /// How far the sum is shifted down to units of a `Fixed`.
    shift: u32,
}

impl FixedLinear {
    /// Gradients along an axis are frequent: those of images, and of faces that are aligned with the axes.
    fn sum(gradient: [i32; 3], at: Vec3<Fixed>) -> i64 {
        dot3_wide_sparse(gradient, [at.x.0, at.y.0, at.z.0])
    }
}

impl Linear<Fixed> for FixedLinear {
    fn new(gradient: Vec3<f32>, zero: Vec3<f32>) -> Self {
        let magnitude = gradient.magnitude();
        let (mut unit, mut shift) = (1.0f32, 0);
        // 2²⁹ ≤ magnitude · unit < 2³⁰; no gradient of a valid shape needs more than 60 doublings.
        while shift < 60 && magnitude * unit < (1u32 << 29) as f32 {
            unit *= 2.0;
            shift += 1;
        }
        let gradient = [gradient.x, gradient.y, gradient.z].map(|slope| (slope * unit) as i32);
        let zero = Vec3::new(Fixed::from_setup(zero.x), Fixed::from_setup(zero.y), Fixed::from_setup(zero.z));
        Self { gradient, offset: Self::sum(gradient, zero).wrapping_neg(), shift }
    }

    fn at(&self, point: Vec3<Fixed>) -> Fixed {
        Fixed::saturated(Self::sum(self.gradient, point).wrapping_add(self.offset) >> (self.shift & 63))
    }

    fn split_at(&self, point: Vec3<Fixed>) -> LatticeCoordinate<Fixed> {
        let value = Self::sum(self.gradient, point).wrapping_add(self.offset) >> (self.shift & 63);
        LatticeCoordinate {
            index: (value >> FRACTION) as i32,
            within: Fixed(value as i32 & ((1 << FRACTION) - 1)),
        }
    }

    fn gradient(&self) -> Vec3<f32> {
        let [x, y, z] = self.gradient.map(|slope| slope as f32 / (1u64 << (self.shift & 63)) as f32);
        Vec3::new(x, y, z)
    }

    fn offset(&self) -> f32 {
        self.offset as f32 / (1u64 << (self.shift & 63)) as f32 / (1u32 << FRACTION) as f32
    }
}
