//! Roots of a function where it changes its sign: Newton's steps, and halves of the interval where a step
//! does not converge (Press et al., "Numerical Recipes", §9.4).

use super::Real;

/// The most steps. If a step of Newton's method is not less than half as long as the step before, the
/// interval is halved instead: in the worst case by every second step, which leaves a 2¹⁶th of it. Five steps
/// are usual.
const MOST_STEPS: u8 = 32;

/// The root between `from` and `to`, where the function has different signs. `look` gives for an argument
/// whether the function is negative there, and Newton's step from there: minus the value, divided by the
/// slope.
pub(crate) fn root_between<R: Real>(
    mut from: R,
    mut to: R,
    from_is_negative: bool,
    look: impl Fn(R) -> (bool, R),
) -> R {
    let half = R::from_fraction(1 << 15);
    // Newton's next step would be no longer than the square of this.
    let tolerance = R::RAY_OFFSET * R::from_fraction(1 << 13);
    let mut at = (from + to) * half;
    let mut previous = to - from;
    for _ in 0..MOST_STEPS {
        let (is_negative, step) = look(at);
        if is_negative == from_is_negative {
            from = at;
        } else {
            to = at;
        }
        let newton = at + step;
        let next = if newton >= from && newton <= to && step.abs() < previous * half {
            newton
        } else {
            (from + to) * half
        };
        previous = (next - at).abs();
        at = next;
        if !(previous > tolerance) {
            break;
        }
    }
    at
}

/// The real roots of t³ + a t + b between `from` and `to`, in order. Between two arguments with slope 0 lies
/// one root at most.
pub(crate) fn cubic_roots<R: Real>(a: R, b: R, from: R, to: R) -> impl Iterator<Item = R> {
    let value = move |t: R| (t * t + a) * t + b;
    let look = move |t: R| {
        let (value, square) = (value(t), t * t);
        (value < R::ZERO, -value / (square + square + square + a))
    };
    let turn = (-a * R::from_f32(1.0 / 3.0)).larger(R::ZERO).sqrt();
    let within = move |t: R| {
        if t < from {
            from
        } else if t > to {
            to
        } else {
            t
        }
    };
    let places = [from, within(-turn), within(turn), to];
    places.into_iter().zip(places.into_iter().skip(1)).filter_map(move |(from, to)| {
        let (from_is_negative, to_is_negative) = (value(from) < R::ZERO, value(to) < R::ZERO);
        (from_is_negative != to_is_negative).then(|| root_between(from, to, from_is_negative, look))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    fn assert_roots(a: f64, b: f64, expected: &[f64]) {
        fn check<R: Real>(a: f64, b: f64, expected: &[f64], tolerance: f64) {
            let number = |value: f64| R::from_f32(value as f32);
            let roots: Vec<f64> = cubic_roots(number(a), number(b), number(-2.0), number(2.0))
                .map(|root| f64::from(root.to_f32()))
                .collect();
            let near = roots.iter().zip(expected).all(|(a, b)| (a - b).abs() < tolerance);
            assert!(near && roots.len() == expected.len(), "{roots:?}, not {expected:?}");
        }
        check::<f32>(a, b, expected, 2e-6);
        check::<f64>(a, b, expected, 1e-6);
        check::<Fixed>(a, b, expected, 2e-6);
    }

    #[test]
    fn cubics_with_known_roots() {
        assert_roots(0.0, -1.0, &[1.0]);
        assert_roots(0.0, 0.125, &[-0.5]);
        assert_roots(1.0, -2.0, &[1.0]);
        // (t - 1) (t - 1/2) (t + 3/2)
        assert_roots(-1.75, 0.75, &[-1.5, 0.5, 1.0]);
        // (t + 1) (t - 1/4) (t - 3/4)
        assert_roots(-0.8125, 0.1875, &[-1.0, 0.25, 0.75]);
        // The others are 5/2 and -7/2.
        assert_roots(-9.75, 8.75, &[1.0]);
    }

    #[test]
    fn roots_are_found_where_newton_goes_astray() {
        // The slope of the arc tangent is next to 0 far out; that of the cube at the root.
        let arc = root_between(-60.0, 100.0, true, |t: f64| (t < 0.0, -t.atan() * (1.0 + t * t)));
        assert!(arc.abs() < 1e-9, "{arc}");
        let cube = root_between(-1.0, 1.5, true, |t: f64| (t < 0.0, -t / 3.0));
        assert!(cube.abs() < 1e-4, "{cube}");
        // No step is of any use.
        let nan = root_between(0.0, 1.0, true, |t: f32| (t < 0.3, f32::NAN));
        assert!((nan - 0.3).abs() < 1e-5, "{nan}");
    }
}
