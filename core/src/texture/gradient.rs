//! Gradients from one color to another.

use super::{blend, check_reflectivity};
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::math::{LatticeCoordinate, Real};

/// A gradient along one unit of the pattern's x axis, in linear light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Gradient<R = f32> {
    /// The color at x = 0.
    pub from: LinearRgb<R>,
    /// The color at x = 1.
    pub to: LinearRgb<R>,
    /// The continuation beyond 0 and 1.
    #[cfg_attr(feature = "serde", serde(default))]
    pub ends: Ends,
}

/// The continuation of a figure beyond its ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Ends {
    /// Repeat the figure.
    #[default]
    Repeat,
    /// Repeat the figure, every second time mirrored, so that there are no edges.
    Mirror,
    /// Extend the color at the end.
    Extend,
}

impl Ends {
    /// Maps a coordinate to the position inside of the figure, from 0 to 1.
    pub(super) fn fold<R: Real>(self, at: LatticeCoordinate<R>) -> R {
        match self {
            Self::Mirror if at.index & 1 == 1 => R::ONE - at.within,
            Self::Extend if at.index < 0 => R::ZERO,
            Self::Extend if at.index > 0 => R::ONE,
            _ => at.within,
        }
    }
}

impl Gradient {
    pub(super) fn prepare<R: Real>(&self) -> Result<Gradient<R>, Fault> {
        Ok(Gradient {
            from: check_reflectivity(self.from)?,
            to: check_reflectivity(self.to)?,
            ends: self.ends,
        })
    }
}

impl<R: Real> Gradient<R> {
    pub(super) fn color(&self, [x, ..]: [LatticeCoordinate<R>; 3]) -> LinearRgb<R> {
        blend(self.from, self.to, self.ends.fold(x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_repeat_mirror_or_extend() {
        let folds = |at: f32| [Ends::Repeat, Ends::Mirror, Ends::Extend].map(|ends| ends.fold(at.split()));
        assert_eq!(folds(0.25), [0.25, 0.25, 0.25]);
        assert_eq!(folds(1.25), [0.25, 0.75, 1.0]);
        assert_eq!(folds(-0.75), [0.25, 0.75, 0.0]);
        assert_eq!(folds(2.25), [0.25, 0.25, 1.0]);
    }
}
