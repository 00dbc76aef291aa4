//! The panic handler, which only the HAL can call: it stops the program.

use core::panic::PanicInfo;

use cortex_m::asm;

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    loop {
        // A debugger stops here. Without a debugger this is a fault, and the processor locks up.
        asm::bkpt();
    }
}
