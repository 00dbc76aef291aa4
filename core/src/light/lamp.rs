//! Lights with falloff, or with a cone (spot lights).

use crate::color::LinearRgb;
use crate::falloff::{Falloff, PreparedFalloff};
use crate::fault::{Fault, check_direction, check_finite};
use crate::math::{Product, Real, Vec3, float};

/// A point light with falloff over the distance, with a cone (a spot light), or with both.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Lamp {
    /// The position of the light.
    pub position: Vec3,
    /// Its color and intensity, 0 or more.
    pub color: LinearRgb,
    /// The falloff with distance.
    #[cfg_attr(feature = "serde", serde(default))]
    pub falloff: Falloff,
    /// The cone of light; `None`: all directions.
    pub cone: Option<LightCone>,
}

/// The cone of a spot light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct LightCone {
    /// The direction in which the light travels along the axis of the cone; any length but 0.
    pub direction: Vec3,
    /// The angle from the axis, in radians, up to which the light has its full intensity; 0 or more.
    pub bright: f32,
    /// The angle from the axis, in radians, beyond which it is dark: at least `bright`, 1e-4 to π. Between
    /// the two angles the light fades smoothly. Unit vectors are not precise enough for narrower cones.
    pub dark: f32,
}

/// The falloff and the cone of a [`Lamp`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedLamp<R> {
    falloff: Option<PreparedFalloff<R>>,
    cone: Option<PreparedCone<R>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct PreparedCone<R> {
    /// The unit vector along the axis, back to the light.
    back: Vec3<R>,
    edge: Edge<R>,
}

/// The edge of a cone of light.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Edge<R> {
    /// `dark` is the cosine of the dark angle, and `width` the cosine of the bright angle minus that; it is 0
    /// for a sharp edge.
    Wide { dark: R, width: R },
    /// The chords of both angles: the distance between two unit vectors at this angle. Cosines of angles
    /// below 1° differ in only half of their digits.
    Narrow { dark: R, bright: R },
}

/// Cones with a dark angle below this, in radians, are computed with chords.
const NARROW: f32 = 0.02;
/// The smallest dark angle, in radians. In narrower cones the rounding of unit vectors would show as speckle.
const NARROWEST: f32 = 1e-4;

impl Lamp {
    /// Checks the falloff and the cone, and converts them for distances that are `scale` times those of the
    /// scene.
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
        if cone.dark < NARROWEST {
            return Err(Fault::LightConeTooNarrow);
        }
        let edge = if cone.dark < NARROW {
            let chord = |angle: f32| R::from_f32(2.0 * float::set_up_sin_cos(0.5 * angle).0);
            Edge::Narrow { dark: chord(cone.dark), bright: chord(cone.bright) }
        } else {
            let (bright, dark) = (float::set_up_cos(cone.bright), float::set_up_cos(cone.dark));
            Edge::Wide { dark: R::from_f32(dark), width: R::from_f32(bright - dark) }
        };
        let cone = PreparedCone { back: Vec3::from_setup(-direction), edge };
        Ok(PreparedLamp { falloff, cone: Some(cone) })
    }
}

impl<R: Real> PreparedLamp<R> {
    /// The share of its light that the lamp sends to a point. `toward` is the unit vector from the point to
    /// the lamp.
    pub(crate) fn share(&self, toward: Vec3<R>, distance: R) -> R {
        let inside = match self.cone {
            None => R::ONE,
            Some(PreparedCone { back, edge }) => {
                let Some(x) = edge.passed(back, toward) else { return R::ZERO };
                // The smooth step 3x² - 2x³.
                x * x * (R::from_u16(3) - (x + x))
            }
        };
        match self.falloff {
            None => inside,
            Some(falloff) => inside * falloff.at(distance),
        }
    }
}

impl<R: Real> Edge<R> {
    /// The position of a direction between the dark and the bright angle, 0 to 1; `None` where it is dark.
    /// Both vectors are unit vectors: the axis back to the lamp, and the direction to the lamp.
    fn passed(&self, back: Vec3<R>, toward: Vec3<R>) -> Option<R> {
        match *self {
            Self::Wide { dark, width } => {
                let past = back.dot(toward) - dark;
                let x = || if past < width { past.times(R::ONE).over(width) } else { R::ONE };
                (past > R::ZERO).then(x)
            }
            Self::Narrow { dark, bright } => {
                // The difference of squared chords is twice the difference of cosines.
                let (dark, bright) = (dark.times(dark), bright.times(bright));
                let (past, width) = (dark - (toward - back).length_squared_wide(), dark - bright);
                let x = || if past < width { past.share(width) } else { R::ONE };
                (past > R::Product::ZERO).then(x)
            }
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
    fn lamps_are_bright_inside_of_the_cone_and_dark_outside() {
        for share in [share::<f32>, share::<f64>, share::<Fixed>] {
            for (angle, left) in [(0.0, 1.0), (0.29, 1.0), (-0.29, 1.0), (0.61, 0.0), (3.0, 0.0)] {
                assert_eq!(share(SPOT, angle), left, "{angle}");
            }
            // Halfway between the cosines the light is half as bright.
            let middle = ((0.3f32.cos() + 0.6f32.cos()) / 2.0).acos();
            assert!((share(SPOT, middle) - 0.5).abs() < 1e-4);
            let sharp = Lamp { cone: SPOT.cone.map(|cone| LightCone { bright: 0.6, ..cone }), ..SPOT };
            assert!(share(sharp, 0.6001) == 0.0 && share(sharp, 0.5999) == 1.0);
            let hard = Lamp { cone: SPOT.cone.map(|cone| LightCone { bright: 0.59, ..cone }), ..SPOT };
            assert!(share(hard, 0.601) == 0.0 && share(hard, 0.589) == 1.0);
            assert_eq!(share(Lamp { cone: None, ..SPOT }, 2.0), 1.0);
        }
    }

    /// Between the cosines of 0.1° and 0° there are only 26 numbers, in `f32` and in fixed point.
    #[test]
    fn narrow_cones_fade_as_smoothly_as_wide_ones() {
        fn assert_smooth<R: Real>() {
            let direction = Vec3::new(1.0, -2.0, 0.7).to::<f64>().normalized().unwrap();
            let (across, _) = direction.around();
            for dark in [0.019f32, 1e-3, 3e-4, NARROWEST] {
                for bright in [0.0, dark * 0.5] {
                    let cone = Some(LightCone { direction: Vec3::new(1.0, -2.0, 0.7), bright, dark });
                    let lamp = Lamp { cone, ..SPOT }.prepare::<R>(1.0).unwrap();
                    for step in 0..200 {
                        let angle = f64::from(dark) * f64::from(step) / 160.0;
                        let toward = across * angle.sin() - direction * angle.cos();
                        let toward = Vec3::new(toward.x as f32, toward.y as f32, toward.z as f32);
                        let squared = |angle: f32| (f64::from(angle) * 0.5).sin().powi(2);
                        let x = squared(dark) - (angle * 0.5).sin().powi(2);
                        let x = (x / (squared(dark) - squared(bright))).clamp(0.0, 1.0);
                        let expected = x * x * (3.0 - 2.0 * x);
                        let share = f64::from(lamp.share(toward.to(), R::ONE).to_f32());
                        let bound = 2e-3 + 1e-6 / f64::from(dark);
                        assert!(
                            (share - expected).abs() < bound,
                            "{dark} {bright} {angle}: {share}, not {expected}"
                        );
                    }
                }
            }
        }
        assert_smooth::<f32>();
        assert_smooth::<f64>();
        assert_smooth::<Fixed>();
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
        assert_eq!(refused(0.0, 0.9e-4), Fault::LightConeTooNarrow);
        assert_eq!(refused(f32::NAN, 1.0), Fault::NotFinite);
        let cone = LightCone { direction: Vec3::ZERO, bright: 0.1, dark: 0.2 };
        let lamp = Lamp { cone: Some(cone), ..SPOT };
        assert_eq!(lamp.prepare::<f32>(1.0).unwrap_err(), Fault::ZeroLength);
    }
}
