//! Sets of objects, in scenes of few objects.

use core::num::NonZero;

use crate::limits::FEW_OBJECTS;

/// A set of up to [`ObjectSet::CAPACITY`] objects: a bit for each position in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ObjectSet(u32);

impl ObjectSet {
    /// Scenes of up to this many objects have sets.
    pub(crate) const CAPACITY: usize = if cfg!(feature = "candidates") { FEW_OBJECTS } else { 0 };
    /// No object.
    pub(crate) const NONE: Self = Self(0);
    /// Any object: which ones is not known, or the scene has no sets. Bits beyond the scene's objects are set
    /// too, and stand for nothing.
    pub(crate) const UNKNOWN: Self = Self(u32::MAX);

    /// The first `count` objects.
    pub(crate) const fn first(count: usize) -> Self {
        if count >= FEW_OBJECTS { Self(u32::MAX) } else { Self((1 << count) - 1) }
    }

    pub(crate) const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The objects that are in both sets.
    pub(crate) const fn common(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// The objects that are not in another set.
    #[cfg(feature = "distributed")]
    pub(super) const fn but(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    pub(crate) const fn contains(self, object: usize) -> bool {
        !self.common(Self::NONE.with(object)).is_empty()
    }

    pub(crate) const fn with(self, object: usize) -> Self {
        Self(self.0 | 1 << (object & 31))
    }

    pub(crate) const fn without(self, object: usize) -> Self {
        Self(self.0 & !(1 << (object & 31)))
    }

    /// The lowest position.
    #[inline]
    pub(super) fn lowest(self) -> Option<usize> {
        if Self::CAPACITY == 0 && !cfg!(feature = "distributed") {
            // A build without sets makes no code for their objects.
            return None;
        }
        // `NonZero` spares ARMv6-M a test for 0: 1.01 times the instructions without it.
        NonZero::new(self.0).map(|bits| bits.trailing_zeros() as usize)
    }

    /// The set without its lowest position.
    #[inline]
    pub(super) const fn without_lowest(self) -> Self {
        Self(self.0 & self.0.wrapping_sub(1))
    }
}

/// The positions of the objects, in ascending order.
impl Iterator for ObjectSet {
    type Item = usize;

    #[inline]
    fn next(&mut self) -> Option<usize> {
        let lowest = self.lowest()?;
        *self = self.without_lowest();
        Some(lowest)
    }
}
