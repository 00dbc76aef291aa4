//! How light fades with distance.

use crate::fault::Fault;
use crate::limits::MAX_COORDINATE;
use crate::math::Real;

/// How light fades with distance d: to 1 / (constant + linear d + quadratic d²), but never to more than it was (Hall and Greenberg,
/// "A Testbed for Realistic Image Synthesis", IEEE CG&A 1983).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
pub struct Falloff {
    /// 0 or more, and so the others; one of the three is more.
    pub constant: f32,
    /// Per unit of length.
    pub linear: f32,
    /// Per unit of length, squared.
    pub quadratic: f32,
}

impl Falloff {
    /// None: light as in the first lectures.
    pub const NONE: Self = Self { constant: 1.0, linear: 0.0, quadratic: 0.0 };

    /// The law of nature, where the color of the light is what arrives at a distance of `distance`, 0.001 to 1e19; nearer it is no brighter.
    pub const fn inverse_square(distance: f32) -> Self {
        Self { constant: 0.0, linear: 0.0, quadratic: 1.0 / (distance * distance) }
    }

    pub(crate) const fn is_none(&self) -> bool {
        self.constant == 1.0 && self.linear == 0.0 && self.quadratic == 0.0
    }

    /// Checks every number and converts it, for distances that are so many times those of the scene; `None` where nothing fades.
    pub(crate) fn prepare<R: Real>(&self, scale: f32) -> Result<Option<PreparedFalloff<R>>, Fault> {
        let mut sum = 0.0;
        for coefficient in [self.constant, self.linear, self.quadratic] {
            if coefficient.is_nan() {
                return Err(Fault::NotFinite);
            }
            if !(0.0..=MAX_COORDINATE).contains(&coefficient) {
                return Err(Fault::Falloff);
            }
            sum += coefficient;
        }
        if sum <= 0.0 {
            return Err(Fault::Falloff);
        }
        if self.is_none() {
            return Ok(None);
        }
        let per_unit = R::Setup::from_f32(1.0 / scale);
        let [c, l, q] = [self.constant, self.linear, self.quadratic].map(R::Setup::from_f32);
        let (l, q) = (l * per_unit, q * per_unit * per_unit);
        // The largest is made 1, and so none is out of range; or less, where the brightness would be.
        let largest = c.larger(l).larger(q);
        let unit = if R::fits(largest.recip()) { largest } else { R::Setup::from_f32(1.0 / BRIGHTEST) };
        let part = |coefficient: R::Setup| R::from_setup(coefficient / unit);
        let brightness = R::from_setup(unit.recip());
        Ok(Some(PreparedFalloff { constant: part(c), linear: part(l), quadratic: part(q), brightness }))
    }
}

impl Default for Falloff {
    fn default() -> Self {
        Self::NONE
    }
}

/// Within what all number systems hold.
const BRIGHTEST: f32 = 32.0;

/// A [`Falloff`], prepared: its largest coefficient is 1, or less.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedFalloff<R> {
    constant: R,
    linear: R,
    quadratic: R,
    /// 1 over what a coefficient of 1 was.
    brightness: R,
}

impl<R: Real> PreparedFalloff<R> {
    /// What is left at this distance, 0 to 1.
    pub(crate) fn at(&self, distance: R) -> R {
        let Self { constant, linear, quadratic, brightness } = *self;
        // Far away by the inverse of the distance, so that no square is out of range.
        let (most, sum) = if distance > R::ONE {
            let near = distance.recip();
            (brightness * (near * near), quadratic + near * (linear + near * constant))
        } else {
            (brightness, constant + distance * (linear + distance * quadratic))
        };
        if !(sum > R::ZERO) {
            return R::ONE;
        }
        let left = most / sum;
        if left < R::ONE { left } else { R::ONE }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Extent, Fixed, Scale, Vec3};

    fn left<R: Real>(falloff: Falloff, distance: f32) -> f32 {
        let scale = Scale::new::<R>(Extent::solid(20.0), Vec3::ZERO);
        let distance = scale.length::<R>(R::Setup::from_f32(distance));
        falloff.prepare::<R>(scale.to_f32()).unwrap().map_or(1.0, |falloff| falloff.at(distance).to_f32())
    }

    #[test]
    fn light_fades_by_the_formula() {
        let mixed = Falloff { constant: 0.5, linear: 0.25, quadratic: 0.125 };
        for left in [left::<f32>, left::<f64>, left::<Fixed>] {
            assert!((left(mixed, 4.0) - 1.0 / 3.5).abs() < 1e-4);
            // 1 / 0.5 would be more than there was.
            assert_eq!(left(mixed, 0.0), 1.0);
            assert!((left(mixed, 60.0) - 1.0 / 465.5).abs() < 1e-5);
            let lamp = Falloff::inverse_square(5.0);
            assert!((left(lamp, 5.0) - 1.0).abs() < 1e-3, "{}", left(lamp, 5.0));
            assert!((left(lamp, 10.0) - 0.25).abs() < 1e-4);
            assert!((left(lamp, 50.0) - 0.01).abs() < 1e-5);
            assert_eq!(left(lamp, 1.0), 1.0);
            assert_eq!(left(Falloff::NONE, 1000.0), 1.0);
            // In fixed point 1 over the coefficient is out of range, and its light fades all the same.
            let window = Falloff::inverse_square(200.0);
            assert!((left(window, 400.0) - 0.25).abs() < 1e-4, "{}", left(window, 400.0));
            assert_eq!(left(Falloff { constant: 1e-6, linear: 1e-9, quadratic: 0.0 }, 400.0), 1.0);
        }
    }

    /// A distance of 0 or 1e-4 had to do with the scale of the scene, and one of 1e30 was negative.
    #[test]
    fn an_inverse_square_without_a_sane_distance_is_told_so() {
        let prepare = |distance| Falloff::inverse_square(distance).prepare::<f32>(1.0).err();
        for distance in [0.0, 1e-30, 1e-4, 1e30, f32::INFINITY] {
            assert_eq!(prepare(distance), Some(Fault::Falloff), "{distance}");
        }
        assert!(Fault::Falloff.to_string().contains("`inverse_square` a distance from 0.001 to 1e19"));
        for distance in [0.001, 1.0, 1e19] {
            assert_eq!(prepare(distance), None, "{distance}");
        }
        assert_eq!(prepare(f32::NAN), Some(Fault::NotFinite));
    }

    #[test]
    fn bad_coefficients_are_refused() {
        let refused = |falloff: Falloff| falloff.prepare::<f32>(1.0).unwrap_err();
        assert_eq!(refused(Falloff { linear: -1.0, ..Falloff::NONE }), Fault::Falloff);
        assert_eq!(refused(Falloff { constant: 0.0, ..Falloff::NONE }), Fault::Falloff);
        assert_eq!(refused(Falloff { quadratic: f32::NAN, ..Falloff::NONE }), Fault::NotFinite);
        assert_eq!(refused(Falloff { quadratic: f32::INFINITY, ..Falloff::NONE }), Fault::Falloff);
    }
}
