//! The parts of a picture, rendered by several threads.

use rayline::{LineError, RayCounts};
use rayon::prelude::*;

/// Renders the parts of a picture, of so many bytes each, by several threads. The job gets a part's number.
// With a generic job, there would be a copy of rayon for each number system and color: 8 % of the program.
pub(crate) fn render_parts(
    rgb: &mut [u8],
    bytes: usize,
    job: &(dyn Fn(usize, &mut [u8]) -> Result<RayCounts, LineError> + Sync),
) -> Result<RayCounts, LineError> {
    let sum = |mut a: RayCounts, b| {
        a += b;
        Ok(a)
    };
    let parts = rgb.par_chunks_mut(bytes).enumerate();
    parts.map(|(number, rgb)| job(number, rgb)).try_reduce(RayCounts::default, sum)
}
