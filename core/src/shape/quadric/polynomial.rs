//! A polynomial of second degree, in units in which nothing is large.

use crate::fault::Fault;
use crate::math::{Product, Real, Vec3};

/// The power of two next above, so that dividing by it rounds nothing.
pub(super) fn power_of_two_above(value: f32) -> f32 {
    f32::from_bits(value.to_bits() & 0x7F80_0000) * 2.0
}

/// z · Q z + 2 g · z + k, for z in the unit ball: no coefficient is larger than 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Polynomial<R> {
    /// The diagonal of Q.
    squares: Vec3<R>,
    /// Beside it: yz, xz, xy.
    mixed: Vec3<R>,
    /// g
    linear: Vec3<R>,
    /// k
    constant: R,
}

impl<N: Real<Setup = N>> Polynomial<N> {
    /// The polynomial of `middle + unit · z`.
    pub(super) fn new(coefficients: [f32; 10], middle: Vec3<N>, unit: N) -> Result<Self, Fault> {
        let largest = coefficients.iter().fold(0.0, |most: f32, one| most.larger(one.abs()));
        // Also of what is too small for the exponent of its inverse.
        if coefficients.iter().take(9).all(|one| one.abs() < 1e-30) {
            return Err(Fault::NoSurface);
        }
        // In two steps, since neither the largest nor the smallest may have an inverse.
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
    /// Q z
    fn map(&self, z: Vec3<R>) -> Vec3<R> {
        let Self { squares: s, mixed: m, .. } = *self;
        Vec3::new(
            Vec3::new(s.x, m.z, m.y).dot(z),
            Vec3::new(m.z, s.y, m.x).dot(z),
            Vec3::new(m.y, m.x, s.z).dot(z),
        )
    }

    pub(super) fn half_gradient(&self, z: Vec3<R>) -> Vec3<R> {
        self.map(z) + self.linear
    }

    fn at_wide(&self, z: Vec3<R>) -> R::Product {
        (self.half_gradient(z) + self.linear).dot_wide(z) + self.constant.times(R::ONE)
    }

    pub(super) fn at(&self, z: Vec3<R>) -> R {
        self.at_wide(z).over(R::ONE)
    }

    /// Where it is 0 along `start + direction · t`.
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
        // q is 0 only where the discriminant has no root that can be told from 0.
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

/// Where a line is inside a quadric.
pub(super) enum Roots<R> {
    AllInside,
    AllOutside,
    /// From here on.
    Enters(R),
    /// Up to here.
    Leaves(R),
    /// Between these.
    Inside(R, R),
    /// But between these.
    Outside(R, R),
}
