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

/// The continuation of a figure beyond its ends. An image has four edges: the names of two words are for
/// images that continue to the left and right by the first word, and upward and downward by the second.
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
    /// Repeat to the left and right, mirror upward and downward.
    RepeatMirror,
    /// Repeat to the left and right, extend upward and downward.
    RepeatExtend,
    /// Mirror to the left and right, repeat upward and downward.
    MirrorRepeat,
    /// Mirror to the left and right, extend upward and downward.
    MirrorExtend,
    /// Extend to the left and right, repeat upward and downward.
    ExtendRepeat,
    /// Extend to the left and right, mirror upward and downward.
    ExtendMirror,
}

impl Ends {
    /// The continuation to the left and right, and that upward and downward: each is
    /// [`Repeat`](Self::Repeat), [`Mirror`](Self::Mirror) or [`Extend`](Self::Extend).
    pub const fn axes(self) -> [Self; 2] {
        match self {
            Self::Repeat | Self::Mirror | Self::Extend => [self, self],
            Self::RepeatMirror => [Self::Repeat, Self::Mirror],
            Self::RepeatExtend => [Self::Repeat, Self::Extend],
            Self::MirrorRepeat => [Self::Mirror, Self::Repeat],
            Self::MirrorExtend => [Self::Mirror, Self::Extend],
            Self::ExtendRepeat => [Self::Extend, Self::Repeat],
            Self::ExtendMirror => [Self::Extend, Self::Mirror],
        }
    }

    /// The continuation with these [`axes`](Self::axes); of an axis with a name of two words, the first
    /// counts.
    pub const fn of_axes([across, up]: [Self; 2]) -> Self {
        match (across.axes()[0], up.axes()[0]) {
            (Self::Repeat, Self::Mirror) => Self::RepeatMirror,
            (Self::Repeat, Self::Extend) => Self::RepeatExtend,
            (Self::Mirror, Self::Repeat) => Self::MirrorRepeat,
            (Self::Mirror, Self::Extend) => Self::MirrorExtend,
            (Self::Extend, Self::Repeat) => Self::ExtendRepeat,
            (Self::Extend, Self::Mirror) => Self::ExtendMirror,
            (both, _) => both,
        }
    }

    /// Maps a coordinate to the position inside of the figure along one of the [`axes`](Self::axes), from 0
    /// to 1.
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
            ends: self.ends.axes()[0],
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

    #[test]
    fn axes_have_ends_of_their_own() {
        let simple = [Ends::Repeat, Ends::Mirror, Ends::Extend];
        for across in simple {
            for up in simple {
                assert_eq!(Ends::of_axes([across, up]).axes(), [across, up]);
            }
            assert_eq!(Ends::of_axes([across; 2]), across);
        }
    }
}
