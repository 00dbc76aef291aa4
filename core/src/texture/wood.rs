//! Wood: rings distorted by noise (Peachey, "Solid Texturing of Complex Surfaces", SIGGRAPH 1985).

use super::noise::{check_octaves, check_turbulence, octaves, wave};
use super::{blend, check_reflectivity};
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::math::{LatticeCoordinate, Product, Real};

/// Wood: rings about the pattern's z axis, one in each unit, displaced by noise. There are at most 60 rings.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Wood<R = f32> {
    /// The color at the edges of a ring.
    pub early: LinearRgb<R>,
    /// The color in the middle of a ring.
    pub late: LinearRgb<R>,
    /// The strength of the displacement in units of the pattern: 0 to 16. With 0 the rings are circles.
    pub turbulence: R,
    /// The octaves of the noise: 1 to [`MAX_OCTAVES`](super::MAX_OCTAVES).
    pub octaves: u8,
}

impl Wood {
    pub(super) fn prepare<R: Real>(&self) -> Result<Wood<R>, Fault> {
        Ok(Wood {
            early: check_reflectivity(self.early)?,
            late: check_reflectivity(self.late)?,
            turbulence: check_turbulence(self.turbulence)?,
            octaves: check_octaves(self.octaves)?,
        })
    }
}

impl<R: Real> Wood<R> {
    pub(super) fn color(&self, at: [LatticeCoordinate<R>; 3]) -> LinearRgb<R> {
        let [x, y, _] = at.map(LatticeCoordinate::number);
        let radius = (x.times(x) + y.times(y)).sqrt();
        let ring = radius.split().plus(octaves(at, self.octaves) * self.turbulence);
        blend(self.early, self.late, wave(ring))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_turbulence_rings_are_circles() {
        let wood = Wood { early: LinearRgb::WHITE, late: LinearRgb::gray(0.0), turbulence: 0.0, octaves: 1 };
        let wood = wood.prepare::<f32>().unwrap();
        let at = |x: f32, y: f32| wood.color([x.split(), y.split(), 9.3f32.split()]).r;
        assert_eq!((at(0.0, 0.0), at(-3.0, 4.0), at(0.0, -2.5), at(1.5, 2.0)), (1.0, 1.0, 0.0, 0.0));
    }
}
