//! A sky: a color gradient by the height above the horizon.

use crate::color::{LinearRgb, check_emission};
use crate::fault::{Fault, check_direction};
use crate::math::{Real, Vec3};
use crate::texture::blend;

/// A color gradient by the height above the horizon.
///
/// The height h of a direction is the sine of its angle above the horizon: 1 straight up, 0 at the horizon,
/// -1 straight down. Above the horizon the color is `horizon · (1 - |h|) + zenith · |h|`, below it `horizon ·
/// (1 - |h|) + nadir · |h|`, in linear light. Channels are 0 or more, and may be above 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Sky {
    /// The direction of the zenith; any length but 0.
    pub up: Vec3,
    /// The color straight above.
    pub zenith: LinearRgb,
    /// The color at the horizon.
    pub horizon: LinearRgb,
    /// The color straight below.
    pub nadir: LinearRgb,
}

#[cfg(feature = "serde")]
crate::read::read_struct!([] Sky as Sky { up = Vec3::new(0.0, 1.0, 0.0), zenith, horizon, nadir });

impl Sky {
    /// A sky from `horizon` to `zenith`, with up along the y axis; below the horizon it has the color
    /// `horizon`.
    pub const fn new(horizon: LinearRgb, zenith: LinearRgb) -> Self {
        Self { up: Vec3::new(0.0, 1.0, 0.0), zenith, horizon, nadir: horizon }
    }

    pub(super) fn prepare<R: Real>(&self) -> Result<PreparedSky<R>, Fault> {
        for color in [self.zenith, self.horizon, self.nadir] {
            check_emission::<R>(color)?;
        }
        Ok(PreparedSky {
            up: check_direction(self.up)?,
            zenith: self.zenith.to(),
            horizon: self.horizon.to(),
            nadir: self.nadir.to(),
        })
    }
}

/// A [`Sky`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedSky<R> {
    /// A unit vector.
    up: Vec3<R>,
    zenith: LinearRgb<R>,
    horizon: LinearRgb<R>,
    nadir: LinearRgb<R>,
}

/// The cosine of the largest slope of a ground that counts as level.
#[cfg(feature = "distributed")]
const LEVEL: f32 = 0.99;

impl<R: Real> PreparedSky<R> {
    pub(super) fn color(&self, direction: Vec3<R>) -> LinearRgb<R> {
        let height = self.up.dot(direction);
        let (end, share) = if height < R::ZERO { (self.nadir, -height) } else { (self.zenith, height) };
        // The rounded length of a unit vector may be slightly above 1.
        blend(self.horizon, end, if share < R::ONE { share } else { R::ONE })
    }

    /// The mean of the colors above a surface with this unit normal, weighted by the cosine.
    ///
    /// The color is linear in the height h above and below the horizon. The weighted mean of max(h, 0) is
    /// `2/3π · (sin γ + (π - γ) cos γ)`, where γ is the angle between the normal and the zenith: the integral
    /// of the product of two clamped cosines.
    ///
    /// A ground with this normal hides the sky below it, and leaves this share of an even sky. The result is
    /// exact for a ground that is level.
    #[cfg(feature = "distributed")]
    pub(super) fn light_on(&self, normal: Vec3<R>, ground: Option<(Vec3<R>, R)>) -> LinearRgb<R> {
        let (sine, cosine) = (self.up.cross(normal).length(), self.up.dot(normal));
        let angle = R::turn(sine, cosine) * R::from_f32(core::f32::consts::TAU);
        let scale = R::from_f32(2.0 / 3.0 * core::f32::consts::FRAC_1_PI);
        let below = ((sine - angle * cosine) * scale).larger(R::ZERO);
        let above = (below + cosine * R::from_f32(2.0 / 3.0)).larger(R::ZERO);
        let of_heights = |below: R, level: R| {
            self.horizon.scaled(level.larger(R::ZERO)) + self.zenith.scaled(above) + self.nadir.scaled(below)
        };
        match ground {
            Some((ground, share)) if ground.dot(self.up) > R::from_f32(LEVEL) => {
                of_heights(R::ZERO, share - above)
            }
            Some((_, share)) => of_heights(below, R::ONE - above - below).scaled(share),
            None => of_heights(below, R::ONE - above - below),
        }
    }

    /// Whether a direction is below the horizon.
    pub(super) fn is_below(&self, direction: Vec3<R>) -> bool {
        self.up.dot(direction) < R::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    const SKY: Sky = Sky {
        zenith: LinearRgb::new(0.0, 0.25, 2.0),
        nadir: LinearRgb::gray(0.125),
        ..Sky::new(LinearRgb::new(1.0, 0.75, 0.5), LinearRgb::WHITE)
    };

    /// The formula gives the weighted mean of the colors.
    #[cfg(feature = "distributed")]
    fn assert_light<R: Real>() {
        use crate::sampling::{around, disc};
        let sky = SKY.prepare::<R>().unwrap();
        for angle in [0.0f32, 0.5, 1.2, 1.6, 2.2, 3.1] {
            let normal = Vec3::new(angle.sin(), angle.cos(), 0.0).to::<R>().normalized().unwrap();
            let (mut sum, steps) = ([0.0; 3], 64u16);
            for pair in (0..steps).flat_map(|a| (0..steps).map(move |b| [a * 1024 + 512, b * 1024 + 512])) {
                let [x, y] = disc::<R>(pair);
                let sine_squared = x * x + y * y;
                let toward = around(normal, (R::ONE - sine_squared).sqrt(), sine_squared, [x, y]);
                let LinearRgb { r, g, b } = sky.color(toward).to_f32();
                sum = [sum[0] + r, sum[1] + g, sum[2] + b];
            }
            let LinearRgb { r, g, b } = sky.light_on(normal, None).to_f32();
            for (found, sum) in [r, g, b].iter().zip(sum) {
                let expected = sum / f32::from(steps).powi(2);
                assert!((found - expected).abs() < 2e-3, "{angle}: {found}, not {expected}");
            }
        }
    }

    #[test]
    #[cfg(feature = "distributed")]
    fn the_light_of_all_directions() {
        assert_light::<f32>();
        assert_light::<f64>();
        assert_light::<Fixed>();
    }

    fn assert_sky<R: Real>() {
        let seen = |sky: Sky, x: f32, y: f32, z: f32| {
            let direction = Vec3::new(x, y, z).to::<R>().normalized().unwrap();
            let color = sky.prepare::<R>().unwrap().color(direction).to_f32();
            [color.r, color.g, color.b]
        };
        for (direction, color) in [
            ((0.0, 1.0, 0.0), [0.0, 0.25, 2.0]),
            ((0.0, 0.0, -1.0), [1.0, 0.75, 0.5]),
            ((1.0, 0.0, 0.0), [1.0, 0.75, 0.5]),
            ((0.0, -1.0, 0.0), [0.125; 3]),
            // 30 degrees above the horizon: the height is 1/2, whatever the compass direction.
            ((0.75f32.sqrt(), 0.5, 0.0), [0.5, 0.5, 1.25]),
            ((0.0, 0.5, 0.75f32.sqrt()), [0.5, 0.5, 1.25]),
            ((0.6, -0.8, 0.0), [0.3, 0.25, 0.2]),
        ] {
            let (x, y, z) = direction;
            let got = seen(SKY, x, y, z);
            assert!(got.iter().zip(color).all(|(a, b)| (a - b).abs() < 1e-6), "{got:?}, not {color:?}");
            // A sky lying on its side, with an up vector that is no unit vector.
            let aside = seen(Sky { up: Vec3::new(0.0, 0.0, -7.0), ..SKY }, x, z, -y);
            assert!(aside.iter().zip(color).all(|(a, b)| (a - b).abs() < 1e-6), "{aside:?}, not {color:?}");
        }
        let below = seen(Sky::new(SKY.horizon, SKY.zenith), 0.6, -0.8, 0.0);
        assert!(below.iter().zip([1.0, 0.75, 0.5]).all(|(a, b)| (a - b).abs() < 1e-6), "{below:?}");
    }

    #[test]
    fn straight_lines_from_color_to_color() {
        assert_sky::<f32>();
        assert_sky::<f64>();
        assert_sky::<Fixed>();
    }

    #[test]
    fn no_color_leaves_its_ends() {
        // A color at the zenith stays 0, although a rounded unit vector may be longer than 1.
        let sky = Sky::new(LinearRgb::gray(1.0), LinearRgb::gray(0.0)).prepare::<f32>().unwrap();
        let color = sky.color(Vec3::new(0.0, 1.0 + 1e-6, 0.0));
        assert_eq!(color, LinearRgb::gray(0.0));
    }

    #[test]
    fn bad_skies_are_refused() {
        let refusal = |sky: Sky| sky.prepare::<f32>().err();
        assert_eq!(refusal(SKY), None);
        assert_eq!(refusal(Sky { up: Vec3::ZERO, ..SKY }), Some(Fault::ZeroLength));
        assert_eq!(refusal(Sky { up: Vec3::new(f32::NAN, 1.0, 0.0), ..SKY }), Some(Fault::NotFinite));
        for sky in [
            Sky { zenith: LinearRgb::gray(-0.5), ..SKY },
            Sky { horizon: LinearRgb::gray(-0.5), ..SKY },
            Sky { nadir: LinearRgb::gray(-0.5), ..SKY },
        ] {
            assert_eq!(refusal(sky), Some(Fault::NegativeColor { given: -0.5 }));
        }
        let bright = Sky { nadir: LinearRgb::gray(100.0), ..SKY };
        assert_eq!((refusal(bright), bright.prepare::<Fixed>().err()), (None, Some(Fault::OutOfRange)));
    }
}
