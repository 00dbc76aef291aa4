//! The positions of samples inside of a pixel.

/// The center of a pixel, in 65536ths of a pixel.
pub(crate) const CENTER: u16 = 0x8000;

/// The position of one of several samples inside of its pixel, right and down from the upper left corner, in
/// 65536ths of a pixel. A single sample lies in the [`CENTER`].
///
/// The samples follow the additive recurrence R2 (Roberts, "The Unreasonable Effectiveness of Quasirandom
/// Sequences", 2018), shifted in each pixel by a hash of pixel and seed (Cranley and Patterson,
/// "Randomization of Number Theoretic Methods", 1976). The position is a pure function of its arguments, so
/// lines can be rendered in any order.
pub(crate) fn sample_position(x: u16, y: u16, sample: u16, seed: u32) -> (u16, u16) {
    let shift = hash(u32::from(y) << 16 | u32::from(x), seed);
    // The steps are 2³² divided by the plastic number, and by its square.
    let along =
        |shift: u32, step: u32| (shift.wrapping_add(step.wrapping_mul(u32::from(sample))) >> 16) as u16;
    (along(shift, 0xC13F_A9A9), along(hash(shift, seed), 0x91E1_0DA5))
}

/// Mixes two words into one, each bit of which depends on all bits of both (the finalizer lowbias32 of
/// Wellons, "Prospecting for Hash Functions", 2018).
fn hash(value: u32, seed: u32) -> u32 {
    let mut bits = value ^ seed.wrapping_mul(0x9E37_79B9);
    bits = (bits ^ bits >> 16).wrapping_mul(0x7FEB_352D);
    bits = (bits ^ bits >> 15).wrapping_mul(0x846C_A68B);
    bits ^ bits >> 16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_cover_the_pixel_evenly() {
        for seed in 0..20 {
            let mut quadrants = [0; 4];
            for sample in 0..64 {
                let (x, y) = sample_position(17, 4, sample, seed);
                quadrants[usize::from(x >> 15) * 2 + usize::from(y >> 15)] += 1;
            }
            // Independent random positions would be off by more than 4 in one quadrant of four.
            assert!(quadrants.iter().all(|count| (12..=20).contains(count)), "{quadrants:?}");
        }
    }

    #[test]
    fn pixels_and_seeds_differ() {
        let position = |x, y, seed| sample_position(x, y, 0, seed);
        assert_ne!(position(0, 0, 0), position(1, 0, 0));
        assert_ne!(position(0, 0, 0), position(0, 1, 0));
        assert_ne!(position(0, 0, 0), position(0, 0, 1));
    }
}
