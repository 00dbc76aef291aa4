//! The proof that no panic can be reached: the panic handler calls a function that does not exist, so a
//! program that calls the handler does not link.

use core::panic::PanicInfo;

#[cfg(not(feature = "twin-linked"))]
#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    #[allow(unsafe_code)]
    unsafe extern "C" {
        safe fn rayline_panic_is_reachable() -> !;
    }
    rayline_panic_is_reachable()
}

/// The handler of the twin that links: it shows that the search for symbols of panics finds them.
#[cfg(feature = "twin-linked")]
#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    loop {}
}

/// A panic that the compiler cannot rule out.
#[cfg(feature = "twin")]
pub(crate) fn reachable_panic() -> u32 {
    let numbers = [1, 2, 3];
    #[allow(clippy::indexing_slicing)]
    numbers[core::hint::black_box(2)]
}

/// Reports a fault of the processor, which would otherwise stop without a word.
#[cfg(target_arch = "arm")]
#[allow(unsafe_code)]
#[cortex_m_rt::exception]
unsafe fn HardFault(_: &cortex_m_rt::ExceptionFrame) -> ! {
    crate::report::fail(crate::Fault::Processor)
}
