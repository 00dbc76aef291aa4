//! Fast answers for ARMv6-M, from the upper halves of numbers: a product of two of those is one instruction there, in place of
//! seventeen.
//!
//! They serve to leave out what would come to nothing. Where an answer is not sure, all digits are asked, so that they change
//! no byte of a picture.

/// Digits of a coordinate below 1; the product of two has twice as many.
const DIGITS: u32 = 14;

/// How far squares are off below, in units of 2⁻²⁸, and a little more. Truncation takes less than one of 2⁻¹⁴ from each number, so that
/// the product of the distance (below √3) and the direction is off by 4.8 of 2⁻¹⁴, and by one more where it is rounded; its square by
/// 5.8 · 2 · √3 of them, the squared distance by 6.
const OFF: i32 = 27 << DIGITS;

/// The sum of three products of coordinates of unit vectors, in units of 2⁻²⁴; off by less than 2⁻¹³.
#[inline(always)]
pub(super) fn dot3(a: [i32; 3], b: [i32; 3]) -> i32 {
    // In units of 2⁻³⁰. Each factor is off by less than 2⁻¹⁵, and coordinates of a unit vector add up to √3 at most.
    let ([ax, ay, az], [bx, by, bz]) = (a.map(|number| number >> 9), b.map(|number| number >> 9));
    ax.wrapping_mul(bx).wrapping_add(ay.wrapping_mul(by)).wrapping_add(az.wrapping_mul(bz)) >> 6
}

/// Whether a ray surely misses a ball. It begins at this place, as seen from the middle, and goes in this unit direction.
#[inline(always)]
pub(super) fn misses_ball(from_center: [i32; 3], direction: [i32; 3], radius: i32) -> bool {
    let [fx, fy, fz] = from_center.map(|number| number >> (24 - DIGITS));
    let radius = (radius >> (24 - DIGITS)) + 1;
    // Whether all lie in -1 to 1. Solids do, and what is between them.
    let beyond = |number: i32| number ^ number >> 31;
    if (beyond(fx) | beyond(fy) | beyond(fz) | radius) >> DIGITS != 0 {
        return false;
    }
    let [dx, dy, dz] = direction.map(|number| number >> (24 - DIGITS));
    let outside = fx * fx + fy * fy + fz * fz - radius * radius - OFF;
    let along = (fx * dx + fy * dy + fz * dz) >> DIGITS;
    // From outside, it goes away from the ball, or its line passes the ball by.
    outside > 0 && (along > 6 || along * along < outside)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers from -1 to 1 in units of 2⁻²⁴, and unit vectors of them.
    struct Random(u64);

    impl Random {
        fn number(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }

        fn place(&mut self) -> [f64; 3] {
            [self.number(), self.number(), self.number()]
        }

        fn unit(&mut self) -> [f64; 3] {
            let place = self.place();
            let length = dot(place, place).sqrt();
            place.map(|number| number / length)
        }
    }

    fn dot([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> f64 {
        ax * bx + ay * by + az * bz
    }

    fn bits(vector: [f64; 3]) -> [i32; 3] {
        vector.map(|number| (number * 16_777_216.0) as i32)
    }

    #[test]
    fn products_keep_their_bound() {
        let mut random = Random(1);
        let mut worst = 0f64;
        for _ in 0..1_000_000 {
            let (a, b) = (random.unit(), random.unit());
            worst = worst.max((f64::from(dot3(bits(a), bits(b))) / 16_777_216.0 - dot(a, b)).abs());
        }
        println!("2^{}", worst.log2());
        assert!(worst < 2f64.powi(-13), "2^{}", worst.log2());
    }

    #[test]
    fn a_ball_that_is_met_is_never_missed() {
        let mut random = Random(1);
        let (mut missed, mut all) = (0, 0);
        for _ in 0..4_000_000 {
            let (radius, from_center) = ((random.number() * 0.5).abs(), random.place());
            // Half of them toward a place near the ball's edge.
            let direction = if random.number() > 0.0 {
                random.unit()
            } else {
                let (edge, around) = (radius * (1.0 + 0.02 * random.number()), random.unit());
                let toward = [0, 1, 2].map(|axis| around[axis] * edge - from_center[axis]);
                let length = dot(toward, toward).sqrt();
                toward.map(|number| number / length)
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
        // What is far away is not told.
        assert!(!misses_ball([1 << 25, 0, 0], [1 << 24, 0, 0], 1 << 20));
    }
}
