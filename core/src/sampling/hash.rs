//! Hashes: words in which each bit depends on all bits of the input.

/// Mixes two words into one, each bit of which depends on all bits of both (the finalizer lowbias32 of
/// Wellons, "Prospecting for Hash Functions", 2018).
pub(super) fn hash(value: u32, seed: u32) -> u32 {
    let mut bits = value ^ seed.wrapping_mul(0x9E37_79B9);
    bits = (bits ^ bits >> 16).wrapping_mul(0x7FEB_352D);
    bits = (bits ^ bits >> 15).wrapping_mul(0x846C_A68B);
    bits ^ bits >> 16
}
