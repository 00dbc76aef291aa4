//! The parts of a picture, rendered by several threads.

use rayline::{LineError, RayCounts};
use rayon::prelude::*;

/// Renders one part: its number, and the bytes of its pixels.
// With a generic job, there would be a copy of rayon for each number system and color: 8 % of the program.
type Job<'j> = dyn Fn(usize, &mut [u8]) -> Result<RayCounts, LineError> + Sync + 'j;

/// Renders the parts of a picture, of so many bytes each, by several threads.
pub(crate) fn render_parts(rgb: &mut [u8], bytes: usize, job: &Job<'_>) -> Result<RayCounts, LineError> {
    let sum = |mut a: RayCounts, b| {
        a += b;
        Ok(a)
    };
    let parts = rgb.par_chunks_mut(bytes).enumerate();
    parts.map(|(number, rgb)| job(number, rgb)).try_reduce(RayCounts::default, sum)
}
