//! A polynomial of second degree, scaled so that no coefficient is larger than 1.

use crate::fault::Fault;
use crate::math::{Product, Real, Vec3};

/// The next power of two above `value`. Dividing by it rounds nothing.
pub(super) fn power_of_two_above(value: f32) -> f32 {
    f32::from_bits(value.to_bits() & 0x7F80_0000) * 2.0
}

/// The polynomial z · Q z + 2 g · z + k of a vector z in the unit ball, with coefficients of at most 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Polynomial<R> {
    /// The diagonal of the symmetric matrix Q.
    squares: Vec3<R>,
    /// The other elements of Q: yz, xz, xy.
    mixed: Vec3<R>,
    /// g
    linear: Vec3<R>,
    /// k
    constant: R,
}

impl<N: Real<Setup = N>> Polynomial<N> {
    /// The polynomial of z with these coefficients at `middle + unit · z`.
    pub(super) fn new(coefficients: [f32; 10], middle: Vec3<N>, unit: N) -> Result<Self, Fault> {
        let largest = coefficients.iter().fold(0.0, |most: f32, one| most.larger(one.abs()));
        // Refuse equations without x, y and z, and coefficients that are so small that their inverse is out
        // of range.
        if coefficients.iter().take(9).all(|one| one.abs() < 1e-30) {
            return Err(Fault::NoSurface);
        }
        // Divide by the root twice, since the inverse of the largest coefficient itself may be out of range.
        let (down, half) = (power_of_two_above(Real::sqrt(largest)).recip(), N::from_f32(0.5));
        let [a, b, c, d, e, f, g, h, i, j] = coefficients.map(|one| N::from_f32(one * down * down));
        let raw = Self {
            squares: Vec3::new(a, b, c),
            mixed: Vec3::new(f * half, e * half, d * half),
            linear: Vec3::new(g * half, h * half, i * half),
            constant: j,
        };
        let unit_squared = unit * unit;
        let moved = Self {
            squares: raw.squares * unit_squared,
            mixed: raw.mixed * unit_squared,
            linear: raw.half_gradient(middle) * unit,
            constant: raw.at(middle),
        };
        let largest = [moved.squares, moved.mixed, moved.linear]
            .into_iter()
            .fold(moved.constant.abs(), |most, vector| most.larger(vector.magnitude()));
        let down = N::from_f32(power_of_two_above(largest.to_f32()).recip());
        Ok(Self {
            squares: moved.squares * down,
            mixed: moved.mixed * down,
            linear: moved.linear * down,
            constant: moved.constant * down,
        })
    }

    /// The polynomial in the number system `R`.
    pub(super) fn rounded<R: Real<Setup = N>>(self) -> Polynomial<R> {
        Polynomial {
            squares: Vec3::from_setup(self.squares),
            mixed: Vec3::from_setup(self.mixed),
            linear: Vec3::from_setup(self.linear),
            constant: R::from_setup(self.constant),
        }
    }
}

impl<R: Real> Polynomial<R> {
    /// The product Q z.
    fn map(&self, z: Vec3<R>) -> Vec3<R> {
        let Self { squares: s, mixed: m, .. } = *self;
        Vec3::new(
            Vec3::new(s.x, m.z, m.y).dot(z),
            Vec3::new(m.z, s.y, m.x).dot(z),
            Vec3::new(m.y, m.x, s.z).dot(z),
        )
    }

    /// Half the gradient at z.
    pub(super) fn half_gradient(&self, z: Vec3<R>) -> Vec3<R> {
        self.map(z) + self.linear
    }

    /// The value at z, not yet rounded.
    fn at_wide(&self, z: Vec3<R>) -> R::Product {
        (self.half_gradient(z) + self.linear).dot_wide(z) + self.constant.times(R::ONE)
    }

    /// The value at z.
    pub(super) fn at(&self, z: Vec3<R>) -> R {
        self.at_wide(z).over(R::ONE)
    }

    /// The roots t of the polynomial along `start + direction · t`.
    pub(super) fn roots(&self, start: Vec3<R>, direction: Vec3<R>) -> Roots<R> {
        // a t² + 2 b t + c
        let a = self.map(direction).dot(direction);
        let b = self.half_gradient(start).dot(direction);
        let c = self.at_wide(start);
        let discriminant = b.times(b) - c.times(a);
        if !(discriminant > R::Product::ZERO) {
            return if c < R::Product::ZERO { Roots::AllInside } else { Roots::AllOutside };
        }
        let root = discriminant.sqrt();
        let q = if b > R::ZERO { -b - root } else { root - b };
        // q is 0 only if the root of the discriminant is rounded to 0.
        if q == R::ZERO {
            return if c < R::Product::ZERO { Roots::AllInside } else { Roots::AllOutside };
        }
        let one = c.over(q);
        if a == R::ZERO {
            return if b > R::ZERO { Roots::Leaves(one) } else { Roots::Enters(one) };
        }
        let other = q / a;
        let (near, far) = if one < other { (one, other) } else { (other, one) };
        if a > R::ZERO { Roots::Inside(near, far) } else { Roots::Outside(near, far) }
    }
}

/// The places along a line at which the polynomial changes its sign.
pub(super) enum Roots<R> {
    /// The whole line is inside the quadric.
    AllInside,
    /// The whole line is outside.
    AllOutside,
    /// The line is inside from here on.
    Enters(R),
    /// The line is inside up to here.
    Leaves(R),
    /// The line is inside between these.
    Inside(R, R),
    /// The line is inside except between these.
    Outside(R, R),
}
