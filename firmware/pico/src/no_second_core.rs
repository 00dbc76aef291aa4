//! Without the second core: it sleeps, and there are no lines of its.

use embassy_rp::Peri;
use embassy_rp::peripherals::CORE1;

use crate::fault::Fault;
use crate::picture::{Line, Prepared};

/// The lines that come from the second core: none.
#[derive(Debug)]
pub(crate) struct SecondCore;

/// Lets the second core sleep.
pub(crate) fn start(_: Peri<'static, CORE1>, _: Prepared) -> Result<SecondCore, Fault> {
    Ok(SecondCore)
}

impl SecondCore {
    /// Leaves the line as it is; no band has room for one.
    pub(crate) async fn next_line(&mut self, _: &mut Line) {}
}
