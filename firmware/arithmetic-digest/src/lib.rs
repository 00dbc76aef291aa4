//! A digest of the results of arithmetic on many numbers, and of pictures with several samples.
//!
//! Board and host both compute it, and the two must agree to the bit. Pictures do not test that enough: few
//! of them have coordinates far from the origin, where halves of products overflow.

#![cfg_attr(not(test), no_std)]

mod samples;

use rayline::Digest;
use rayline::math::{Product, Real, Vec3};

/// Numbers at the ends of ranges, in units of 2⁻²⁴.
const EDGES: [i32; 12] =
    [0, 1, -1, 0x7FFF, 0x8000, 0xFFFF, 0x1_0000, -0x1_0000, 1 << 24, 1 << 30, i32::MAX, i32::MIN];

/// The number of random vectors.
const RANDOM: usize = 3_000;

/// The digest of all results in a number system.
pub fn digest<R: Real>() -> u64 {
    let mut results = Results { digest: Digest::new(), last: Vec3::new(R::ONE, R::ZERO, R::ZERO) };
    for x in EDGES {
        for y in EDGES {
            for z in EDGES {
                results.compute(Vec3::new(number(x), number(y), number(z)));
            }
        }
    }
    let mut random = Random(1);
    for _ in 0..RANDOM {
        results.compute(random.vector());
    }
    samples::update::<R>(&mut results.digest);
    results.digest.value()
}

/// The number `bits` × 2⁻²⁴, rounded to the digits that the number system has.
fn number<R: Real>(bits: i32) -> R {
    let (upper, lower) = ((bits >> 16) as f32, (bits & 0xFFFF) as f32);
    R::from_f32(upper / 256.0) + R::from_f32(lower / 16_777_216.0)
}

/// A linear congruential generator (Knuth, "The Art of Computer Programming" vol. 2; MMIX's constants).
struct Random(u64);

impl Random {
    /// A random number of random magnitude.
    fn number<R: Real>(&mut self) -> R {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        number((self.0 >> 32) as i32 >> (self.0 >> 27 & 31))
    }

    fn vector<R: Real>(&mut self) -> Vec3<R> {
        Vec3::new(self.number(), self.number(), self.number())
    }
}

/// The results so far.
struct Results<R> {
    digest: Digest,
    /// The previous vector.
    last: Vec3<R>,
}

impl<R: Real> Results<R> {
    /// Adds all digits of a number to the digest.
    fn take(&mut self, number: R) {
        let upper = number.to_f32();
        let lower = (number - R::from_f32(upper)).to_f32();
        // Adding 0 turns -0 into +0: the sign of zero may differ.
        for part in [upper, lower] {
            self.digest.update(&(part + 0.0).to_bits().to_le_bytes());
        }
    }

    fn take_vector(&mut self, Vec3 { x, y, z }: Vec3<R>) {
        [x, y, z].into_iter().for_each(|number| self.take(number));
    }

    /// Adds a sum of products to the digest: its upper digits, its sign, and its square root if that is real.
    fn take_product(&mut self, product: R::Product) {
        self.take(product.over(R::ONE));
        let is_negative = product < R::Product::ZERO;
        self.digest.update(&[u8::from(is_negative)]);
        if !is_negative {
            self.take(product.sqrt());
        }
    }

    /// Computes with a vector and the previous one.
    fn compute(&mut self, a: Vec3<R>) {
        let b = self.last;
        self.take(a.dot(b));
        self.take_product(a.dot_wide(b));
        // The upper digits cancel: these two results consist of the lowest digits.
        self.take_product(a.dot_wide(b) - a.x.times(b.x) - a.y.times(b.y) - a.z.times(b.z));
        self.take_product(a.length_squared_wide() - a.x.times(a.x) - a.y.times(a.y) - a.z.times(a.z));
        // Division by zero is undefined.
        let (unit, length) = a.unit_and_length();
        self.take(length);
        if length > R::ZERO {
            self.take_vector(unit);
            let [x, y, z] = R::unit([a.x, a.y, a.z]);
            self.take_vector(Vec3::new(x, y, z));
            // The unit vector of a vector beyond the supported range is undefined.
            let is_unit = (unit.length_squared() - R::ONE).abs() < R::RAY_OFFSET;
            let normal = if is_unit { unit } else { Vec3::new(R::ONE, R::ZERO, R::ZERO) };
            let seen = R::toward_light([b.x, b.y, b.z], [normal.x, normal.y, normal.z]);
            let (toward, distance, cosine) = seen.unwrap_or(([R::ZERO; 3], R::ZERO, R::ZERO));
            toward.into_iter().chain([distance, cosine]).for_each(|number| self.take(number));
        }
        if b.x != R::ZERO {
            self.take(a.x / b.x);
        }
        self.take_vector(a * b.x);
        self.take(a.x.attenuated(b.x));
        self.take(a.y.abs().sqrt());
        self.take(R::turn(a.y, a.x));
        self.last = a;
    }
}

#[cfg(test)]
mod tests {
    use rayline::math::Fixed;

    use super::*;

    #[test]
    fn fixed_numbers_keep_all_digits() {
        for bits in EDGES {
            assert_eq!(number::<Fixed>(bits).to_bits(), bits);
        }
    }

    #[test]
    fn one_digit_makes_another_digest() {
        let digest = |bits| {
            let mut results =
                Results { digest: Digest::new(), last: Vec3::new(Fixed::ONE, Fixed::ZERO, Fixed::ZERO) };
            results.compute(Vec3::new(
                Fixed::from_bits(bits),
                Fixed::from_bits(5),
                Fixed::from_bits(i32::MIN),
            ));
            results.digest.value()
        };
        assert_ne!(digest(i32::MAX), digest(i32::MAX - 1));
        assert_ne!(super::digest::<Fixed>(), super::digest::<f32>());
    }
}
