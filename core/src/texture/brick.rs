//! Bricks and mortar (after Ebert et al., "Texturing and Modeling: A Procedural Approach", 3rd ed. 2003, ch.
//! 2).

use super::{check_reflectivity, check_unit};
use crate::color::LinearRgb;
use crate::fault::{Coefficient, Fault};
use crate::math::{LatticeCoordinate, Real};

/// A wall of bricks in the pattern's x-y plane, constant along z. A brick and its mortar take one unit, and
/// every second row is shifted by half a unit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Brick<R = f32> {
    /// The color of the bricks.
    pub brick: LinearRgb<R>,
    /// The color of the mortar between them.
    pub mortar: LinearRgb<R>,
    /// The share of each unit that is mortar, along x and y: 0 to 1.
    pub gap: [R; 2],
}

impl Brick {
    pub(super) fn prepare<R: Real>(&self) -> Result<Brick<R>, Fault> {
        let [x, y] = self.gap;
        Ok(Brick {
            brick: check_reflectivity(self.brick)?,
            mortar: check_reflectivity(self.mortar)?,
            gap: [check_unit(Coefficient::Gap, x)?, check_unit(Coefficient::Gap, y)?],
        })
    }
}

impl<R: Real> Brick<R> {
    /// The position relative to its row of bricks: every second row is shifted by half a unit.
    pub(super) fn in_row([x, y, z]: [LatticeCoordinate<R>; 3]) -> [LatticeCoordinate<R>; 3] {
        [if y.index & 1 == 1 { x.plus(R::from_fraction(1 << 15)) } else { x }, y, z]
    }

    pub(super) fn color(&self, at: [LatticeCoordinate<R>; 3]) -> LinearRgb<R> {
        let ([gap_x, gap_y], [x, y, _]) = (self.gap, Self::in_row(at));
        if x.within < gap_x || y.within < gap_y { self.mortar } else { self.brick }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_second_row_begins_in_the_middle() {
        let wall = Brick { brick: LinearRgb::WHITE, mortar: LinearRgb::gray(0.0), gap: [0.1, 0.2] };
        let wall = wall.prepare::<f32>().unwrap();
        let is_brick = |x: f32, y: f32| wall.color([x.split(), y.split(), 0f32.split()]).r == 1.0;
        assert!(is_brick(0.11, 0.21) && is_brick(-0.01, 0.99) && is_brick(5.5, 2.5));
        assert!(!is_brick(0.09, 0.5) && !is_brick(0.5, 0.19) && !is_brick(-1.0, 0.5));
        assert!(is_brick(0.05, 1.5) && is_brick(0.49, -0.5));
        assert!(!is_brick(0.55, 1.5) && !is_brick(-0.45, -0.5));
    }
}
