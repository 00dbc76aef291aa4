//! Marble: veins distorted by noise (Perlin, "An Image Synthesizer", SIGGRAPH 1985).

use super::noise::{check_octaves, check_turbulence, octaves, wave};
use super::{blend, check_reflectivity};
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::math::{LatticeCoordinate, Real};

/// Marble: veins across the pattern's x axis, one in each unit, displaced by noise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Marble<R = f32> {
    /// The color of the stone.
    pub stone: LinearRgb<R>,
    /// The color of the veins.
    pub vein: LinearRgb<R>,
    /// The strength of the displacement in units of the pattern: 0 to 16. With 0 the veins are straight.
    pub turbulence: R,
    /// The octaves of the noise: 1 to [`MAX_OCTAVES`](super::MAX_OCTAVES).
    pub octaves: u8,
}

impl Marble {
    pub(super) fn prepare<R: Real>(&self) -> Result<Marble<R>, Fault> {
        Ok(Marble {
            stone: check_reflectivity(self.stone)?,
            vein: check_reflectivity(self.vein)?,
            turbulence: check_turbulence(self.turbulence)?,
            octaves: check_octaves(self.octaves)?,
        })
    }
}

impl<R: Real> Marble<R> {
    pub(super) fn color(&self, at: [LatticeCoordinate<R>; 3]) -> LinearRgb<R> {
        let [x, ..] = at;
        let moved = x.plus(octaves(at, self.octaves) * self.turbulence);
        // The square of the wave makes thin veins.
        let share = wave(moved);
        blend(self.stone, self.vein, share * share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_turbulence_veins_are_straight() {
        let marble =
            Marble { stone: LinearRgb::WHITE, vein: LinearRgb::gray(0.0), turbulence: 0.0, octaves: 3 };
        let marble = marble.prepare::<f32>().unwrap();
        for y in [0.3, 7.7] {
            let at = |x: f32| marble.color([x.split(), y.split(), y.split()]).r;
            assert_eq!((at(-2.0), at(0.5), at(3.25)), (1.0, 0.0, 0.75));
        }
    }
}
