//! A point, a direction or a normal in space.

use core::ops::{Add, Mul, Neg, Sub};

use super::{Product, Real, float, turned};

/// A point, a direction or a normal in space: right-handed, in the scene's units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec3<R = f32> {
    /// First coordinate.
    pub x: R,
    /// Second coordinate.
    pub y: R,
    /// Third coordinate.
    pub z: R,
}

#[cfg(feature = "serde")]
crate::math::triple!(Vec3 { x, y, z });

impl<R> Vec3<R> {
    /// The vector (x, y, z).
    pub const fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }
}

impl Vec3 {
    /// The vector in another number system.
    pub fn to<R: Real>(self) -> Vec3<R> {
        Vec3::new(R::from_f32(self.x), R::from_f32(self.y), R::from_f32(self.z))
    }
}

impl<R: Real> Vec3<R> {
    /// The origin.
    pub const ZERO: Self = Self::new(R::ZERO, R::ZERO, R::ZERO);

    /// The scalar product.
    pub fn dot(self, other: Self) -> R {
        R::dot3([self.x, self.y, self.z], [other.x, other.y, other.z])
    }

    /// The scalar product of a vector that often lies along an axis, as the normals of floors and walls do.
    #[inline]
    pub(crate) fn dot_sparse(self, other: Self) -> R {
        R::dot3_sparse([self.x, self.y, self.z], [other.x, other.y, other.z])
    }

    /// A lower and an upper bound of the scalar product of two unit vectors, see [`Kernel::dot3_bounds`].
    #[inline]
    pub(crate) fn dot_bounds(self, other: Self) -> (R, R) {
        R::dot3_bounds([self.x, self.y, self.z], [other.x, other.y, other.z])
    }

    /// The vector product: perpendicular to both, by the right-hand rule.
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// The scalar product, not yet rounded.
    pub fn dot_wide(self, other: Self) -> R::Product {
        R::dot3_wide([self.x, self.y, self.z], [other.x, other.y, other.z])
    }

    /// The squared length, not yet rounded.
    pub fn length_squared_wide(self) -> R::Product {
        R::length_squared_wide([self.x, self.y, self.z])
    }

    /// The squared length.
    pub fn length_squared(self) -> R {
        self.dot(self)
    }

    /// The length.
    pub fn length(self) -> R {
        self.length_squared_wide().sqrt()
    }

    /// The unit vector of the same direction, and the length. If the length is 0, the unit vector has no
    /// meaning.
    pub fn unit_and_length(self) -> (Self, R) {
        let ([x, y, z], length) = R::unit_and_length([self.x, self.y, self.z]);
        (Self::new(x, y, z), length)
    }

    /// The unit vector of the same direction. If the length is 0, it has no meaning.
    #[inline]
    pub(crate) fn unit(self) -> Self {
        let [x, y, z] = R::unit([self.x, self.y, self.z]);
        Self::new(x, y, z)
    }

    /// The unit vector of the same direction, or `None` where the length is 0.
    pub fn normalized(self) -> Option<Self> {
        let (unit, length) = self.unit_and_length();
        (length > R::ZERO).then_some(unit)
    }

    /// A unit vector whose length is off by rounding, made a unit vector again. In fixed point the vector is
    /// returned as it is.
    #[inline]
    pub(crate) fn unit_again(self) -> Self {
        if R::IS_FIXED_POINT { self } else { self.unit() }
    }

    /// The vector, turned about the x axis, then about y, then about z; counterclockwise as seen from the
    /// axis' end. Slow: for the preparation of a scene.
    pub(crate) fn rotated(self, angles: Vec3) -> Self {
        let Vec3 { x, y, z } = angles;
        let cosine_and_sine = |angle: f32| {
            let (sine, cosine) = float::set_up_sin_cos(angle);
            (R::from_f32(cosine), R::from_f32(sine))
        };
        turned(self, [x, y, z].map(cosine_and_sine))
    }

    /// Two unit vectors perpendicular to this unit vector and to each other: first, second and this vector
    /// are right-handed in this order. The first leans toward the x axis, or toward y if this vector lies
    /// almost along x.
    pub fn around(self) -> (Self, Self) {
        let (one, none) = (R::ONE, R::ZERO);
        let lies_along_x = self.x.abs() > R::from_f32(0.9);
        let toward = if lies_along_x { Self::new(none, one, none) } else { Self::new(one, none, none) };
        let first = (toward - self * self.dot(toward)).normalized().unwrap_or(toward);
        (first, self.cross(first))
    }

    /// The largest absolute value among the coordinates.
    pub fn magnitude(self) -> R {
        self.x.abs().larger(self.y.abs()).larger(self.z.abs())
    }

    /// `true` if a ray may begin at this point: in fixed point the range of numbers is small.
    #[inline]
    pub(crate) fn is_in_reach(self) -> bool {
        !R::IS_FIXED_POINT || self.magnitude() < R::FARTHEST
    }

    /// Of this vector and its opposite, the one that points against `direction`; the scalar product of the
    /// result with `-direction`, which is at least 0; and `true` if the result is the opposite.
    pub fn facing(self, direction: Self) -> (Self, R, bool) {
        let along = self.dot(direction);
        if along > R::ZERO { (-self, along, true) } else { (self, -along, false) }
    }

    /// A vector from the preparation, rounded.
    pub fn from_setup(vector: Vec3<R::Setup>) -> Self {
        Self::new(R::from_setup(vector.x), R::from_setup(vector.y), R::from_setup(vector.z))
    }

    /// The vector in the number system of the preparation.
    pub fn to_setup(self) -> Vec3<R::Setup> {
        Vec3::new(self.x.to_setup(), self.y.to_setup(), self.z.to_setup())
    }

    /// The vector in `f32`, for people to read.
    pub fn to_f32(self) -> Vec3 {
        Vec3::new(self.x.to_f32(), self.y.to_f32(), self.z.to_f32())
    }
}

impl<R: Real> Add for Vec3<R> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<R: Real> Sub for Vec3<R> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<R: Real> Neg for Vec3<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<R: Real> Mul<R> for Vec3<R> {
    type Output = Self;
    fn mul(self, scale: R) -> Self {
        Self::new(self.x * scale, self.y * scale, self.z * scale)
    }
}
