//! A digest of what the rays of a sample met, for adaptive sampling.

use crate::math::Real;
use crate::prepared::Hit;

/// A digest of the objects, facets and shadows that the rays of a sample met. Samples that met the same have
/// the same digest. Without the feature `distributed` nothing is recorded, and this takes no memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Seen([u32; DIGESTS]);

/// The digests that are kept.
const DIGESTS: usize = if cfg!(feature = "distributed") { 1 } else { 0 };

impl Seen {
    /// No ray was traced.
    pub(crate) const NOTHING: Self = Self([0; DIGESTS]);

    /// Records a hit.
    #[inline]
    pub(super) fn hit<R: Real>(&mut self, hit: &Hit<R>) {
        self.record(hit.object as u32 ^ hit.surface.facet().rotate_left(17));
    }

    /// Records that a ray met nothing.
    #[inline]
    pub(super) fn miss(&mut self) {
        self.record(u32::MAX);
    }

    /// Records a light that is blocked, in full or in part.
    #[inline]
    pub(super) fn shadow(&mut self, light: usize) {
        self.record(1 << 24 | light as u32);
    }

    #[inline]
    fn record(&mut self, what: u32) {
        for digest in &mut self.0 {
            *digest = fold(*digest, what);
        }
    }
}

/// The digest of `digest` and one thing more.
#[inline]
pub(crate) fn fold(digest: u32, what: u32) -> u32 {
    (digest.rotate_left(5) ^ what).wrapping_mul(0x9E37_79B9)
}
