//! A range of distances along a ray.

use super::Real;

/// The open range of distances along a ray in which a hit counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<R> {
    /// Hits at this distance or nearer do not count.
    pub min: R,
    /// Hits at this distance or farther do not count.
    pub max: R,
}

impl<R: Real> Interval<R> {
    /// Everything in front of a ray's origin.
    pub const AHEAD: Self = Self { min: R::ZERO, max: R::FARTHEST };

    /// Whether `t` lies strictly inside. NaN never does.
    pub fn contains(self, t: R) -> bool {
        t > self.min && t < self.max
    }

    /// The first of two distances, `near` and `far` in this order, that lies inside.
    #[inline]
    pub fn first(self, near: R, far: R) -> Option<R> {
        let first = if near > self.min { near } else { far };
        if first > self.min && first < self.max { Some(first) } else { None }
    }
}
