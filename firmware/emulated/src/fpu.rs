//! The rounding mode of the floating-point unit.

/// Whether the unit flushes numbers close to zero to zero, which would change the bytes of pictures.
#[cfg(target_abi = "eabihf")]
pub(crate) fn flushes_to_zero() -> bool {
    cortex_m::register::fpscr::read().fz()
}

/// Floating point in software never flushes to zero.
#[cfg(not(target_abi = "eabihf"))]
pub(crate) fn flushes_to_zero() -> bool {
    false
}
