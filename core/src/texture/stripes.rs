//! Stripes of two colors.

use super::{check_reflectivity, check_unit};
use crate::color::LinearRgb;
use crate::fault::{Coefficient, Fault};
use crate::math::{LatticeCoordinate, Real};

/// Stripes across the pattern's x axis, one pair in each unit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Stripes<R = f32> {
    /// The color of the first stripe of each unit.
    pub first: LinearRgb<R>,
    /// The color of the second stripe.
    pub second: LinearRgb<R>,
    /// The width of the first stripe, as a share of the unit: 0 to 1.
    pub width: R,
}

impl Stripes {
    pub(super) fn prepare<R: Real>(&self) -> Result<Stripes<R>, Fault> {
        Ok(Stripes {
            first: check_reflectivity(self.first)?,
            second: check_reflectivity(self.second)?,
            width: check_unit(Coefficient::Width, self.width)?,
        })
    }
}

impl<R: Real> Stripes<R> {
    pub(super) fn color(&self, [x, ..]: [LatticeCoordinate<R>; 3]) -> LinearRgb<R> {
        if x.within < self.width { self.first } else { self.second }
    }
}
