//! Access to the registers of peripherals, by their addresses.

/// Reads a register.
pub(crate) fn read(address: usize) -> u32 {
    // SAFETY: this program only reads registers of peripherals that it owns, at their own addresses.
    #[allow(unsafe_code)]
    unsafe {
        (address as *const u32).read_volatile()
    }
}

/// Writes a register.
pub(crate) fn write(address: usize, value: u32) {
    // SAFETY: this program only writes registers of peripherals that it owns, at their own addresses.
    #[allow(unsafe_code)]
    unsafe {
        (address as *mut u32).write_volatile(value);
    }
}

/// Reads a register, changes the value, and writes it back.
pub(crate) fn modify(address: usize, change: impl FnOnce(u32) -> u32) {
    write(address, change(read(address)));
}
