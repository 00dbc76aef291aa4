//! A light that falls off with distance, or that is confined to a cone.

use crate::color::LinearRgb;
use crate::falloff::{Falloff, PreparedFalloff};
use crate::fault::{Fault, check_direction, check_finite};
use crate::math::{Product, Real, Vec3, float};

/// A light at one point that falls off with distance, or shines into a cone alone: a spot light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Lamp {
    /// Where the light is.
    pub position: Vec3,
    /// Its color and intensity, 0 or more.
    pub color: LinearRgb,
    /// How it fades with distance.
    #[cfg_attr(feature = "serde", serde(default))]
    pub falloff: Falloff,
    /// Where it shines; `None`: everywhere.
    pub cone: Option<LightCone>,
}

/// A cone into which a light shines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct LightCone {
    /// The way the light travels in its middle; any length but 0.
    pub direction: Vec3,
    /// Within this angle of the middle, in radians, it is as bright as can be.
    pub bright: f32,
    /// Beyond this angle, as large or larger and at most π, it is dark. Between the two it fades smoothly.
    pub dark: f32,
}

/// The part of a [`Lamp`] that a point light has not, prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedLamp<R> {
    falloff: Option<PreparedFalloff<R>>,
    cone: Option<PreparedCone<R>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct PreparedCone<R> {
    /// Unit vector from the middle back to the light.
    back: Vec3<R>,
    /// Cosine of the angle where it is dark.
    dark: R,
    /// From there to the cosine where it is bright; 0 where the edge is sharp.
    width: R,
}

impl Lamp {
    /// Checks what a point light has not, for distances that are so many times those of the scene.
    pub(super) fn prepare<R: Real>(&self, scale: f32) -> Result<PreparedLamp<R>, Fault> {
        let falloff = self.falloff.prepare(scale)?;
        let Some(cone) = self.cone else { return Ok(PreparedLamp { falloff, cone: None }) };
        let direction: Vec3<R::Setup> = check_direction(cone.direction)?;
        check_finite(cone.bright)?;
        check_finite(cone.dark)?;
        if !(cone.bright >= 0.0 && cone.bright <= cone.dark && cone.dark > 0.0)
            || cone.dark > core::f32::consts::PI
        {
            return Err(Fault::LightCone);
        }
        let (bright, dark) = (float::set_up_cos(cone.bright), float::set_up_cos(cone.dark));
        let cone = PreparedCone {
            back: Vec3::from_setup(-direction),
            dark: R::from_f32(dark),
            width: R::from_f32(bright - dark),
        };
        Ok(PreparedLamp { falloff, cone: Some(cone) })
    }
}

impl<R: Real> PreparedLamp<R> {
    /// The share of its light that the lamp sends to a point which sees it in this unit direction at this distance.
    pub(crate) fn share(&self, toward: Vec3<R>, distance: R) -> R {
        let inside = match self.cone {
            None => R::ONE,
            Some(PreparedCone { back, dark, width }) => {
                let past = back.dot(toward) - dark;
                if !(past > R::ZERO) {
                    return R::ZERO;
                }
                let x = if past < width { past.times(R::ONE).over(width) } else { R::ONE };
                // Smooth at both ends: 3x² - 2x³.
                x * x * (R::from_u16(3) - (x + x))
            }
        };
        match self.falloff {
            None => inside,
            Some(falloff) => inside * falloff.at(distance),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    const SPOT: Lamp = Lamp {
        position: Vec3::new(0.0, 4.0, 0.0),
        color: LinearRgb::WHITE,
        falloff: Falloff::NONE,
        cone: Some(LightCone { direction: Vec3::new(0.0, -3.0, 0.0), bright: 0.3, dark: 0.6 }),
    };

    fn share<R: Real>(lamp: Lamp, angle: f32) -> f32 {
        let toward = Vec3::new(angle.sin(), angle.cos(), 0.0).to::<R>();
        lamp.prepare::<R>(1.0).unwrap().share(toward, R::ONE).to_f32()
    }

    #[test]
    fn it_is_bright_inside_and_dark_outside() {
        for share in [share::<f32>, share::<f64>, share::<Fixed>] {
            for (angle, left) in [(0.0, 1.0), (0.29, 1.0), (-0.29, 1.0), (0.61, 0.0), (3.0, 0.0)] {
                assert_eq!(share(SPOT, angle), left, "{angle}");
            }
            // Halfway between the cosines it is half as bright.
            let middle = ((0.3f32.cos() + 0.6f32.cos()) / 2.0).acos();
            assert!((share(SPOT, middle) - 0.5).abs() < 1e-4);
            let sharp = Lamp { cone: SPOT.cone.map(|cone| LightCone { bright: 0.6, ..cone }), ..SPOT };
            assert!(share(sharp, 0.6001) == 0.0 && share(sharp, 0.5999) == 1.0);
            let hard = Lamp { cone: SPOT.cone.map(|cone| LightCone { bright: 0.59, ..cone }), ..SPOT };
            assert!(share(hard, 0.601) == 0.0 && share(hard, 0.589) == 1.0);
            assert_eq!(share(Lamp { cone: None, ..SPOT }, 2.0), 1.0);
        }
    }

    #[test]
    fn bad_cones_are_refused() {
        let refused = |bright, dark| {
            let cone = LightCone { direction: Vec3::new(1.0, 0.0, 0.0), bright, dark };
            Lamp { cone: Some(cone), ..SPOT }.prepare::<f32>(1.0).unwrap_err()
        };
        for (bright, dark) in [(0.5, 0.4), (-0.1, 0.4), (0.0, 0.0), (0.1, 3.2)] {
            assert_eq!(refused(bright, dark), Fault::LightCone);
        }
        assert_eq!(refused(f32::NAN, 1.0), Fault::NotFinite);
        let cone = LightCone { direction: Vec3::ZERO, bright: 0.1, dark: 0.2 };
        let lamp = Lamp { cone: Some(cone), ..SPOT };
        assert_eq!(lamp.prepare::<f32>(1.0).unwrap_err(), Fault::ZeroLength);
    }
}
