//! The coordinate axes.

use crate::math::Vec3;

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    /// All axes.
    pub(super) const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// The coordinate along this axis.
    #[inline]
    pub(super) fn of<R>(self, vector: Vec3<R>) -> R {
        match self {
            Self::X => vector.x,
            Self::Y => vector.y,
            Self::Z => vector.z,
        }
    }
}
