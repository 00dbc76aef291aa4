//! How the floating-point unit computes.

/// Whether numbers close to zero are flushed to it: then pictures have other bytes than elsewhere.
#[cfg(target_abi = "eabihf")]
pub(crate) fn flushes_to_zero() -> bool {
    cortex_m::register::fpscr::read().fz()
}

/// Software never flushes.
#[cfg(not(target_abi = "eabihf"))]
pub(crate) fn flushes_to_zero() -> bool {
    false
}
