//! The falloff of light with distance.

use crate::fault::Fault;
use crate::limits::MAX_COORDINATE;
use crate::math::Real;

/// The falloff of light with distance d: the factor min(1, 1 / (constant + linear d + quadratic d²)) (Hall
/// and Greenberg, "A Testbed for Realistic Image Synthesis", IEEE CG&A 1983).
///
/// Each coefficient lies in 0 to 1e6, and at least one is above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
pub struct Falloff {
    /// Coefficient without a unit.
    pub constant: f32,
    /// Coefficient per unit of length.
    pub linear: f32,
    /// Coefficient per square of a unit of length.
    pub quadratic: f32,
}

impl Falloff {
    /// No falloff: light is as bright at any distance.
    pub const NONE: Self = Self { constant: 1.0, linear: 0.0, quadratic: 0.0 };

    /// Falloff with the inverse square of the distance, as in nature. The factor is 1 up to `distance`, which
    /// lies in 0.001 to 1e19, and 1/4 at twice that distance.
    pub const fn inverse_square(distance: f32) -> Self {
        Self { constant: 0.0, linear: 0.0, quadratic: 1.0 / (distance * distance) }
    }

    pub(crate) const fn is_none(&self) -> bool {
        self.constant == 1.0 && self.linear == 0.0 && self.quadratic == 0.0
    }

    /// Checks every number and converts it, for distances that are `scale` times those of the scene; `None`
    /// where there is no falloff.
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
        // Divide by the largest coefficient, so that none is above 1. Where the inverse of the largest would
        // be out of range, divide by 1 / `BRIGHTEST`.
        let largest = c.larger(l).larger(q);
        let unit = if R::holds(largest.recip()) { largest } else { R::Setup::from_f32(1.0 / BRIGHTEST) };
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

/// A brightness that every number system can hold.
const BRIGHTEST: f32 = 32.0;

/// A prepared [`Falloff`], whose largest coefficient is at most 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedFalloff<R> {
    constant: R,
    linear: R,
    quadratic: R,
    /// The inverse of the number by which the described coefficients were divided.
    brightness: R,
}

impl<R: Real> PreparedFalloff<R> {
    /// The share of light that is left at this distance, 0 to 1.
    pub(crate) fn at(&self, distance: R) -> R {
        let Self { constant, linear, quadratic, brightness } = *self;
        // For distances above 1, compute with the inverse of the distance, so that no square is out of range.
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
            // The formula gives 1 / 0.5 here, but the factor is never above 1.
            assert_eq!(left(mixed, 0.0), 1.0);
            assert!((left(mixed, 60.0) - 1.0 / 465.5).abs() < 1e-5);
            let lamp = Falloff::inverse_square(5.0);
            assert!((left(lamp, 5.0) - 1.0).abs() < 1e-3, "{}", left(lamp, 5.0));
            assert!((left(lamp, 10.0) - 0.25).abs() < 1e-4);
            assert!((left(lamp, 50.0) - 0.01).abs() < 1e-5);
            assert_eq!(left(lamp, 1.0), 1.0);
            assert_eq!(left(Falloff::NONE, 1000.0), 1.0);
            // In fixed point the inverse of this coefficient is out of range; the falloff must still be
            // right.
            let window = Falloff::inverse_square(200.0);
            assert!((left(window, 400.0) - 0.25).abs() < 1e-4, "{}", left(window, 400.0));
            assert_eq!(left(Falloff { constant: 1e-6, linear: 1e-9, quadratic: 0.0 }, 400.0), 1.0);
        }
    }

    /// Earlier versions blamed the scale of the scene for a distance of 0 or 1e-4, and called one of 1e30
    /// negative.
    #[test]
    fn an_inverse_square_refuses_distances_out_of_range() {
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
