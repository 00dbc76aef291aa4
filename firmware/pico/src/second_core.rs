//! The second core: it traces bands, as the first core does.

use cortex_m::asm;
use embassy_futures::block_on;
use embassy_rp::Peri;
use embassy_rp::multicore::{Stack, spawn_core1};
use embassy_rp::peripherals::CORE1;

use crate::fault::Fault;
use crate::picture::Prepared;
use crate::quality::Memory;
use crate::tracer::Tracer;

/// Bytes of stack of the second core: twice the most that the first core was measured to use.
const STACK_BYTES: usize = 24576;

/// Starts the second core.
pub(crate) fn start(core: Peri<'static, CORE1>, scene: Prepared) -> Result<(), Fault> {
    let stack = cortex_m::singleton!(STACK: Stack<STACK_BYTES> = Stack::new()).ok_or(Fault::Taken)?;
    let memory = cortex_m::singleton!(MEMORY: Memory = Memory::new()).ok_or(Fault::Taken)?;
    spawn_core1(core, stack, move || {
        // After a fault the panel waits for the bands that this core holds, and the picture stands still.
        let Err(_) = block_on(Tracer::new(scene, memory).trace());
        loop {
            asm::wfi();
        }
    });
    Ok(())
}
