//! From pairs of numbers to places on a disc and directions in a lobe.

use crate::math::{Real, Vec3};

/// A place on the disc of radius 1, for a pair that is spread over a square: neighbors stay neighbors
/// (Shirley and Chiu, "A Low Distortion Map Between Disk and Square", 1997).
pub(crate) fn disc<R: Real>(pair: [u16; 2]) -> [R; 2] {
    let [a, b] = pair.map(centered::<R>);
    if a.abs() > b.abs() {
        let (sine, cosine) = eighth_turns(b / a);
        [a * cosine, a * sine]
    } else {
        let (sine, cosine) = eighth_turns(a / b);
        [b * sine, b * cosine]
    }
}

/// A number of 65536ths as one from -1 to 1, at the middle of a step so that none is 0.
pub(crate) fn centered<R: Real>(number: u16) -> R {
    let number = R::from_fraction(number);
    number + number + R::from_fraction(1) - R::ONE
}

/// Sine and cosine of a number of eighths of a turn from -1 to 1, by Taylor's series: the error is below
/// 4 · 10⁻⁷.
fn eighth_turns<R: Real>(eighths: R) -> (R, R) {
    let number = R::from_f32;
    let square = eighths * eighths;
    let sine = number(core::f32::consts::FRAC_PI_4)
        - square * (number(0.080_745_51) - square * (number(0.002_490_394_6) - square * number(3.657_62e-5)));
    let cosine = R::ONE
        - square
            * (number(0.308_425_14)
                - square
                    * (number(0.015_854_344)
                        - square * (number(3.259_919e-4) - square * number(3.590_86e-6))));
    (eighths * sine, cosine)
}

/// A direction around the unit vector `axis`: a pair that is spread over a square gives directions whose
/// density falls with the cosine of their angle to the axis, to the power n. `exponent` is 1 / (n + 1)
/// (Lafortune and Willems, "Using the Modified Phong Reflectance Model for Physically Based Rendering", 1994,
/// eq. 10).
pub(crate) fn lobe<R: Real>(axis: Vec3<R>, exponent: R::Factor, pair: [u16; 2]) -> Vec3<R> {
    let [x, y] = disc::<R>(pair);
    // The square of the radius is evenly spread over 0 to 1.
    let share = x * x + y * y;
    let left = R::ONE - share;
    let cosine = if left > R::ZERO { left.powf(exponent) } else { R::ZERO };
    around(axis, cosine, R::ONE - cosine * cosine, [x, y])
}

/// A direction in the hemisphere around the unit vector `normal`, with the density of the cosine: the places
/// below it are spread evenly over the disc (Malley's method).
#[cfg(feature = "distributed")]
pub(crate) fn hemisphere<R: Real>(normal: Vec3<R>, pair: [u16; 2]) -> Vec3<R> {
    let [x, y] = disc::<R>(pair);
    let sine_squared = (x * x + y * y).smaller(R::ONE);
    around(normal, (R::ONE - sine_squared).sqrt(), sine_squared, [x, y])
}

/// The unit vector at an angle from the unit vector `axis`. A place on the disc says to which side; `axis` if
/// it is the center or the angle is 0.
pub(crate) fn around<R: Real>(axis: Vec3<R>, cosine: R, sine_squared: R, [x, y]: [R; 2]) -> Vec3<R> {
    let square = x * x + y * y;
    if !(sine_squared > R::ZERO && square > R::ZERO) {
        return axis;
    }
    let across = sine_squared.sqrt() / square.sqrt();
    let (first, second) = axis.around();
    (axis * cosine + first * (x * across) + second * (y * across)).normalized().unwrap_or(axis)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    fn pairs() -> impl Iterator<Item = [u16; 2]> {
        (0..256).flat_map(|x| (0..256).map(move |y| [x * 256 + 128, y * 256 + 128]))
    }

    /// All places lie on the disc, and each half and each ring of it has its share of them.
    fn assert_disc_is_even<R: Real>() {
        let (mut inner, mut right, mut count) = (0, 0, 0);
        for pair in pairs() {
            let [x, y] = disc::<R>(pair).map(|number| f64::from(number.to_f32()));
            let square = x * x + y * y;
            assert!(square < 1.00001, "{pair:?}: {square}");
            inner += usize::from(square < 0.25);
            right += usize::from(x > 0.0);
            count += 1;
        }
        assert!((inner as f64 / count as f64 - 0.25).abs() < 0.005, "{inner} of {count}");
        assert_eq!(right * 2, count);
    }

    #[test]
    fn places_on_the_disc_are_even() {
        assert_disc_is_even::<f32>();
        assert_disc_is_even::<f64>();
        assert_disc_is_even::<Fixed>();
    }

    #[test]
    fn eighths_of_a_turn_are_precise() {
        for step in -100..=100 {
            let eighths = f64::from(step) / 100.0;
            let (sine, cosine) = eighth_turns(eighths);
            let (exact_sine, exact_cosine) = (eighths * core::f64::consts::FRAC_PI_4).sin_cos();
            assert!((sine - exact_sine).abs() < 4e-7 && (cosine - exact_cosine).abs() < 4e-7, "{eighths}");
        }
    }

    /// The mean cosine of a lobe of exponent n is (n + 1) / (n + 2).
    fn assert_lobe_has_its_width<R: Real>() {
        let axis = Vec3::new(0.48, -0.6, 0.64);
        for n in [0.0f32, 1.0, 10.0, 100.0, 3000.0] {
            let exponent = R::factor(1.0 / (n + 1.0));
            let (mut sum, mut count) = (0.0, 0.0);
            for pair in pairs() {
                let direction = lobe::<R>(axis.to(), exponent, pair);
                let [x, y, z] = [direction.x, direction.y, direction.z].map(|c| f64::from(c.to_f32()));
                assert!((x * x + y * y + z * z - 1.0).abs() < 1e-5);
                let cosine = x * 0.48 - y * 0.6 + z * 0.64;
                assert!(cosine > -1e-5, "{n}");
                sum += cosine;
                count += 1.0;
            }
            let expected = f64::from((n + 1.0) / (n + 2.0));
            // The share that is missing to 1, because lobes are narrow.
            let (missing, found) = (1.0 - expected, 1.0 - sum / count);
            assert!((found - missing).abs() < 0.02 * missing + 2e-6, "{n}: {found}, not {missing}");
        }
    }

    #[test]
    fn lobes_have_their_width() {
        assert_lobe_has_its_width::<f32>();
        assert_lobe_has_its_width::<f64>();
        assert_lobe_has_its_width::<Fixed>();
    }
}
