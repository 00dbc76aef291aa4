//! Answers from 14 or 15 digits of each number, for ARMv6-M: a product of two such numbers is one instruction there, in place of
//! seventeen. Where an answer is not certain, the caller computes with all digits, so that no byte of a picture changes.

/// Digits of a coordinate below 1; the product of two coordinates has twice as many.
const DIGITS: u32 = 14;

/// The most by which a squared distance is too small, in units of 2⁻²⁸, rounded up. Truncation takes less than 2⁻¹⁴ from each number. So the
/// product of the distance (below √3) and the direction is off by 4.8 · 2⁻¹⁴, and by 2⁻¹⁴ more where it is rounded; the square of that
/// product is off by 5.8 · 2 · √3 · 2⁻¹⁴, and the squared distance by 6 · 2⁻¹⁴.
const OFF: i32 = 27 << DIGITS;

/// The digits of a coordinate of a unit vector that count, in units of 2⁻¹⁵.
#[inline(always)]
pub(crate) fn coordinate(number: i32) -> i32 {
    number >> 9
}

/// The sum of three products of such coordinates, in units of 2⁻²⁴; off by less than 2⁻¹³.
#[inline(always)]
pub(crate) fn dot3([ax, ay, az]: [i32; 3], [bx, by, bz]: [i32; 3]) -> i32 {
    // In units of 2⁻³⁰. Each factor is off by less than 2⁻¹⁵, and coordinates of a unit vector add up to √3 at most.
    ax.wrapping_mul(bx).wrapping_add(ay.wrapping_mul(by)).wrapping_add(az.wrapping_mul(bz)) >> 6
}

/// Whether a place lies within 1/2 of the origin along each axis, as balls do, so that it is seen from the middle of any in coordinates
/// below 1.
#[inline(always)]
pub(crate) fn is_central(place: [i32; 3]) -> bool {
    let [x, y, z] = place.map(|number| number ^ number >> 31);
    (x | y | z) >> 23 == 0
}

/// Whether a ray surely misses a ball. It begins at this place, as seen from the middle, in coordinates below 1, and goes in this unit
/// direction.
#[inline(always)]
pub(crate) fn misses_ball(from_center: [i32; 3], direction: [i32; 3], radius: i32) -> bool {
    let [fx, fy, fz] = from_center.map(|number| number >> (24 - DIGITS));
    let radius = (radius >> (24 - DIGITS)) + 1;
    let [dx, dy, dz] = direction.map(|number| number >> (24 - DIGITS));
    let outside = fx * fx + fy * fy + fz * fz - radius * radius - OFF;
    let along = (fx * dx + fy * dy + fz * dz) >> DIGITS;
    // From outside, it goes away from the ball, or its line passes the ball by.
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
    fn products_keep_their_bound() {
        let mut random = Random(1);
        let mut worst = 0f64;
        for _ in 0..1_000_000 {
            let (a, b) = (random.unit(), random.unit());
            let product = dot3(bits(a).map(coordinate), bits(b).map(coordinate));
            worst = worst.max((f64::from(product) / 16_777_216.0 - dot(a, b)).abs());
        }
        println!("2^{}", worst.log2());
        assert!(worst < 2f64.powi(-13), "2^{}", worst.log2());
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
        let half = (1 << 23) - 1;
        assert!(
            is_central([half, -half - 1, 0])
                && !is_central([0, half + 1, 0])
                && !is_central([0, 0, -half - 2])
        );
    }
}
