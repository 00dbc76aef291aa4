//! Answers from 14 or 15 digits of each number, for ARMv6-M: a product of two such numbers is one instruction
//! there, in place of seventeen. Where an answer is not certain, the caller computes with all digits, so that
//! no byte of a picture changes.

/// Digits of a coordinate below 1; the product of two coordinates has twice as many.
const DIGITS: u32 = 14;

/// The most by which a squared distance is too small, in units of 2⁻²⁸, rounded up. Truncation takes less
/// than 2⁻¹⁴ from each number. So the product of the distance (below √3) and the direction is off by 4.8 ·
/// 2⁻¹⁴, and by 2⁻¹⁴ more where it is rounded; the square of that product is off by 5.8 · 2 · √3 · 2⁻¹⁴, and
/// the squared distance by 6 · 2⁻¹⁴.
const OFF: i32 = 27 << DIGITS;

/// A lower and an upper bound of the scalar product of two unit vectors, in units of 2⁻²⁴, from 15 digits of
/// each coordinate.
#[inline]
pub(crate) fn dot3_bounds(a: [i32; 3], b: [i32; 3]) -> (i32, i32) {
    let digits = |number: i32| number >> 9;
    let ([ax, ay, az], [bx, by, bz]) = (a.map(digits), b.map(digits));
    // In units of 2⁻³⁰. Each factor is off by less than 2⁻¹⁵, and coordinates of a unit vector add up to √3
    // at most: the sum is off by less than 2⁻¹³.
    let product =
        ax.wrapping_mul(bx).wrapping_add(ay.wrapping_mul(by)).wrapping_add(az.wrapping_mul(bz)) >> 6;
    (product.wrapping_sub(1 << 11), product.wrapping_add(1 << 11))
}

/// `true` if a ray surely misses a ball: its origin is given as seen from the middle of the ball, its
/// direction is a unit vector. Sees no miss from an origin with a coordinate of 1 or more.
#[inline]
pub(crate) fn misses_ball(from_center: [i32; 3], direction: [i32; 3], radius: i32) -> bool {
    let [x, y, z] = from_center.map(|number| number ^ number >> 31);
    if (x | y | z) >> 24 != 0 {
        return false;
    }
    let [fx, fy, fz] = from_center.map(|number| number >> (24 - DIGITS));
    let radius = (radius >> (24 - DIGITS)) + 1;
    let [dx, dy, dz] = direction.map(|number| number >> (24 - DIGITS));
    let outside = fx * fx + fy * fy + fz * fz - radius * radius - OFF;
    let along = (fx * dx + fy * dy + fz * dz) >> DIGITS;
    // The ray begins outside, and goes away from the ball or passes it by.
    outside > 0 && (along > 6 || along * along < outside)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::fixed::tests::{Random, dot, length};

    fn bits(vector: [f64; 3]) -> [i32; 3] {
        vector.map(|number| (number * 16_777_216.0) as i32)
    }

    #[test]
    fn products_lie_between_their_bounds() {
        let mut random = Random(1);
        for _ in 0..1_000_000 {
            let (a, b) = (random.unit(), random.unit());
            let (lower, upper) = dot3_bounds(bits(a), bits(b));
            let product = dot(a, b) * 16_777_216.0;
            assert!(f64::from(lower) < product && product < f64::from(upper), "{a:?} {b:?}");
        }
    }

    #[test]
    fn a_ball_that_is_met_is_never_missed() {
        let mut random = Random(1);
        let (mut missed, mut all) = (0, 0);
        for _ in 0..4_000_000 {
            let (radius, from_center) = ((random.share() * 0.5).abs(), random.place());
            // Half of them toward a place near the ball's edge.
            let direction = if random.share() > 0.0 {
                random.unit()
            } else {
                let (edge, around) = (radius * (1.0 + 0.02 * random.share()), random.unit());
                let toward = [0, 1, 2].map(|axis| around[axis] * edge - from_center[axis]);
                toward.map(|number| number / length(toward))
            };
            let outside = dot(from_center, from_center) - radius * radius;
            let along = dot(from_center, direction);
            // A little more than nothing, as rounding would have it.
            let meets = !(outside > 1e-5) || along < 1e-5 && along * along > outside - 1e-5;
            let misses = misses_ball(bits(from_center), bits(direction), (radius * 16_777_216.0) as i32);
            assert!(!(meets && misses), "{from_center:?} {direction:?} {radius}");
            missed += u32::from(misses);
            all += u32::from(!meets);
        }
        println!("{missed} of {all}");
        assert!(f64::from(missed) > 0.9 * f64::from(all), "{missed} of {all}");
        let (one, back) = (1 << 24, [0, 0, 1 << 24]);
        assert!(misses_ball([0, 0, one - 1], back, 1 << 20) && !misses_ball([0, 0, one], back, 1 << 20));
    }
}
