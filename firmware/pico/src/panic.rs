//! The HAL's panics stop the program.

use core::panic::PanicInfo;

use cortex_m::asm;

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    loop {
        // A debugger stops here; without one, this is a fault, and the processor locks up.
        asm::bkpt();
    }
}
