//! What either core does for a line.

use rayline::Renderer;
use rayline_show::Number;

use crate::fault::Fault;
use crate::picture::Line;

/// Traces a line. A function of its own: `cargo boards` looks at all that it calls, and finds no panic.
#[inline(never)]
pub(crate) fn trace(renderer: &Renderer<'_, 'static, Number>, y: u32, line: &mut Line) -> Result<(), Fault> {
    #[cfg(feature = "twin-linked")]
    reachable_panic();
    Ok(renderer.line(y, line)?)
}

/// A panic that the compiler cannot rule out.
#[cfg(feature = "twin-linked")]
fn reachable_panic() {
    let numbers = [1, 2, 3];
    #[allow(clippy::indexing_slicing)]
    core::hint::black_box(numbers[core::hint::black_box(2)]);
}
