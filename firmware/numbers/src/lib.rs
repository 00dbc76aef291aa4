//! Arithmetic on many numbers, as a digest.
//!
//! Board and host both compute it, so that it tells whether a number system gives the same bits on both: pictures ask little of what
//! lies far from the origin, where halves of products overflow.

#![cfg_attr(not(test), no_std)]

use rayline::Digest;
use rayline::math::{Product, Real, Vec3};

/// Numbers where something ends, in units of 2⁻²⁴.
const EDGES: [i32; 12] =
    [0, 1, -1, 0x7FFF, 0x8000, 0xFFFF, 0x1_0000, -0x1_0000, 1 << 24, 1 << 30, i32::MAX, i32::MIN];

/// How many vectors are not made of edges.
const RANDOM: usize = 3_000;

/// The digest of what comes out.
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
    results.digest.value()
}

/// A number in units of 2⁻²⁴, of which the type keeps as many digits as it has.
fn number<R: Real>(bits: i32) -> R {
    let (upper, lower) = ((bits >> 16) as f32, (bits & 0xFFFF) as f32);
    R::from_f32(upper / 256.0) + R::from_f32(lower / 16_777_216.0)
}

/// Numbers that look random (Knuth, "The Art of Computer Programming" vol. 2, for the generator; MMIX's constants).
struct Random(u64);

impl Random {
    /// A number of any magnitude.
    fn number<R: Real>(&mut self) -> R {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        number((self.0 >> 32) as i32 >> (self.0 >> 27 & 31))
    }

    fn vector<R: Real>(&mut self) -> Vec3<R> {
        Vec3::new(self.number(), self.number(), self.number())
    }
}

/// What came out so far.
struct Results<R> {
    digest: Digest,
    /// The vector before this one.
    last: Vec3<R>,
}

impl<R: Real> Results<R> {
    /// Takes in all digits of a number.
    fn take(&mut self, number: R) {
        let upper = number.to_f32();
        let lower = (number - R::from_f32(upper)).to_f32();
        // One zero: a number without digits has no sign.
        for part in [upper, lower] {
            self.digest.update(&(part + 0.0).to_bits().to_le_bytes());
        }
    }

    fn take_vector(&mut self, Vec3 { x, y, z }: Vec3<R>) {
        [x, y, z].into_iter().for_each(|number| self.take(number));
    }

    /// Takes in a sum of products: its upper digits, and its root if it has one.
    fn take_product(&mut self, product: R::Product) {
        self.take(product.over(R::ONE));
        let is_negative = product < R::Product::ZERO;
        self.digest.update(&[u8::from(is_negative)]);
        if !is_negative {
            self.take(product.sqrt());
        }
    }

    /// Computes with a vector and the one before it.
    fn compute(&mut self, a: Vec3<R>) {
        let b = self.last;
        self.take(a.dot(b));
        self.take_product(a.dot_wide(b));
        // Of these the lowest digits alone are left.
        self.take_product(a.dot_wide(b) - a.x.times(b.x) - a.y.times(b.y) - a.z.times(b.z));
        self.take_product(a.length_squared_wide() - a.x.times(a.x) - a.y.times(a.y) - a.z.times(a.z));
        // What is divided by nothing may be anything.
        let (unit, length) = a.unit_and_length();
        self.take(length);
        if length > R::ZERO {
            self.take_vector(unit);
            let [x, y, z] = R::unit([a.x, a.y, a.z]);
            self.take_vector(Vec3::new(x, y, z));
            // Of a vector that is out of reach, what is said to be its unit vector is none.
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
