//! Fast answers for ARMv6-M, from the upper halves of numbers: a product of two of those is one instruction there, in place of
//! seventeen.
//!
//! Most serve to leave out what would come to nothing. Where an answer is not sure, all digits are asked, so that they change
//! no byte of a picture. [Directions to lights](toward_light) have these digits alone, on every processor.

use super::newton::rsqrt;
use super::zeros::zeros;

/// Digits of a coordinate below 1; the product of two has twice as many.
const DIGITS: u32 = 14;

/// How far squares are off below, in units of 2⁻²⁸, and a little more. Truncation takes less than one of 2⁻¹⁴ from each number, so that
/// the product of the distance (below √3) and the direction is off by 4.8 of 2⁻¹⁴, and by one more where it is rounded; its square by
/// 5.8 · 2 · √3 of them, the squared distance by 6.
const OFF: i32 = 27 << DIGITS;

/// The digits of a coordinate of a unit vector that count, in units of 2⁻¹⁵.
#[inline(always)]
pub(super) fn coordinate(number: i32) -> i32 {
    number >> 9
}

/// The sum of three products of such coordinates, in units of 2⁻²⁴; off by less than 2⁻¹³.
#[inline(always)]
pub(super) fn dot3([ax, ay, az]: [i32; 3], [bx, by, bz]: [i32; 3]) -> i32 {
    // In units of 2⁻³⁰. Each factor is off by less than 2⁻¹⁵, and coordinates of a unit vector add up to √3 at most.
    ax.wrapping_mul(bx).wrapping_add(ay.wrapping_mul(by)).wrapping_add(az.wrapping_mul(bz)) >> 6
}

/// Whether a place lies within 1/2 of the origin along each axis, as balls do, so that it is seen from the middle of any in coordinates
/// below 1.
#[inline(always)]
pub(super) fn is_central(place: [i32; 3]) -> bool {
    let [x, y, z] = place.map(|number| number ^ number >> 31);
    (x | y | z) >> 23 == 0
}

/// Whether a ray surely misses a ball. It begins at this place, as seen from the middle, in coordinates below 1, and goes in this unit
/// direction.
#[inline(always)]
pub(super) fn misses_ball(from_center: [i32; 3], direction: [i32; 3], radius: i32) -> bool {
    let [fx, fy, fz] = from_center.map(|number| number >> (24 - DIGITS));
    let radius = (radius >> (24 - DIGITS)) + 1;
    let [dx, dy, dz] = direction.map(|number| number >> (24 - DIGITS));
    let outside = fx * fx + fy * fy + fz * fz - radius * radius - OFF;
    let along = (fx * dx + fy * dy + fz * dz) >> DIGITS;
    // From outside, it goes away from the ball, or its line passes the ball by.
    outside > 0 && (along > 6 || along * along < outside)
}

/// By how much directions to lights are off at most, as an angle in radians: each coordinate by less than one of at least 2¹⁴.
pub(super) const ASTRAY: f32 = 1.0 / 8192.0;

/// Cosines of 2⁻¹¹ and more stay positive by whatever [`toward_light`] is off: by [`ASTRAY`], and by as much
/// in the cosine itself.
pub(super) const LOW: i32 = 1 << 13;

/// Along the way from a point to a light: the unit vector, the length, and the cosine of the angle with a unit normal, if the light is above the
/// surface; if that is by no digit that counts, a cosine of 0.
///
/// The way has 15 digits in its largest coordinate, which move shadows by a small part of a pixel. What is divided by is the exact length of
/// those digits: the direction is as long as any unit vector, or rays would meet the surface that they leave. Rejected: to divide by what a
/// fine table has for it (1.015 times faster on an M0), as the tips of cones shade themselves where a direction is off by 2⁻¹⁷ in length.
/// An M0 takes about half the instructions for it, 145 in place of 270 with the scalar product, an M3 as many. The bits are the same everywhere.
///
/// The length is off by 2⁻¹² of itself and two units, the cosine by as much of itself, 2⁻¹³, and two units over the length.
#[inline(always)]
pub(super) fn toward_light(way: [i32; 3], normal: [i32; 3]) -> Option<([i32; 3], i32, i32)> {
    #[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
    if super::product::IS_ARMV6M {
        return super::armv6m::toward_light(way, normal);
    }
    // Lights behind a surface are frequent: find them first.
    let (wide, [nx, ny, nz]) = (way.map(i64::from), normal.map(|number| i64::from(number >> 10)));
    let [x, y, z] = wide;
    let height = ((x * nx + y * ny + z * nz) >> 14) as i32;
    if height <= 0 {
        return None;
    }
    let beyond = |number: i32| (number ^ number >> 31) as u32;
    let [x, y, z] = way.map(beyond);
    let up = zeros(x | y | z).wrapping_sub(1) & 31;
    // The digits are in the upper half of each.
    let digits = way.map(|number| number << up & !0xFFFF);
    let [x, y, z] = digits.map(|number| i64::from(number) * i64::from(number));
    let squares = (x.wrapping_add(y).wrapping_add(z) as u64 >> 32) as u32;
    // From 2²⁸ up, so that this is 0 or 2.
    let even = squares.leading_zeros() & 2;
    // 2⁴⁵ over the length of the digits.
    let inverse = rsqrt(squares << even) >> (even >> 1 ^ 1);
    let unit = digits.map(|number| ((i64::from(number) * i64::from(inverse as i32)) >> 32) as i32 >> 5);
    let length = ((squares >> 15) * (inverse >> 15)) >> up << 1;
    let height = (height as u32) << up & !0xFFFF;
    let cosine = (u64::from(height) * u64::from(inverse)) >> 37;
    Some((unit, length as i32, cosine as i32))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Random, dot, length};
    use super::*;

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
    fn directions_to_lights_keep_their_bounds() {
        let mut random = Random(1);
        let (mut astray, mut off_length, mut off_unit, mut off_cosine) = (0f64, 0f64, 0f64, 0f64);
        for i in 0..1_000_000 {
            let (near, normal) = (random.place(), random.unit());
            // From 2⁻¹⁰ to 2⁶.
            let way = near.map(|number| number * 2f64.powi(i % 17 - 10));
            let way_bits = bits(way);
            let way = way_bits.map(|number| f64::from(number) / 16_777_216.0);
            let exact = dot(way, normal) / length(way);
            let found = toward_light(way_bits, bits(normal));
            assert!(found.is_some() || exact < 1e-4, "{way:?} {normal:?}");
            let Some((unit, distance, cosine)) = found else { continue };
            let [unit, [distance, cosine, _]] =
                [unit, [distance, cosine, 0]].map(|bits| bits.map(|number| f64::from(number) / 16_777_216.0));
            let along = dot(unit, way) / length(way);
            let across = [0, 1, 2].map(|axis| unit[axis] - way[axis] / length(way) * along);
            astray = astray.max(length(across) / along);
            off_unit = off_unit.max((length(unit) - 1.0).abs());
            // Of short ways two units of 2⁻²⁴ are more.
            off_length = off_length.max(((distance - length(way)).abs() - 2f64.powi(-23)) / length(way));
            let units = 2f64.powi(-23) / length(way);
            off_cosine = off_cosine.max((cosine - exact).abs() - exact * 2f64.powi(-12) - units);
        }
        println!("2^{} 2^{} 2^{}", astray.log2(), off_length.log2(), off_unit.log2());
        assert!(astray < f64::from(ASTRAY), "2^{}", astray.log2());
        assert!(off_unit < 2f64.powi(-22), "2^{}", off_unit.log2());
        assert!(off_length < 2f64.powi(-12), "2^{}", off_length.log2());
        assert!(off_cosine < 2f64.powi(-13), "2^{}", off_cosine.log2());
        // A light that is above the surface by no digit that counts.
        let grazing = toward_light([0, 0x7FFF, i32::MIN], [0, 1 << 24, 0]);
        assert_eq!(grazing.map(|(_, _, cosine)| cosine), Some(0));
        // What has no digits, or all of them.
        assert_eq!(toward_light([0; 3], [1 << 24, 0, 0]), None);
        assert!(toward_light([-1; 3], [-1 << 24, 0, 0]).is_some());
        let (unit, distance, cosine) = toward_light([i32::MAX, 0, 0], [1 << 24, 0, 0]).unwrap();
        assert!(unit[0] > (1 << 24) - 256 && distance > i32::MAX - (1 << 19) && cosine > (1 << 24) - 2048);
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
