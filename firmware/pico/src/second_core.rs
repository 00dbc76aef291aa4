//! The second core's part of every frame.

use core::convert::Infallible;

use cortex_m::asm;
use embassy_futures::block_on;
use embassy_rp::Peri;
use embassy_rp::multicore::{Stack, spawn_core1};
use embassy_rp::peripherals::CORE1;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::zerocopy_channel::{Channel, Receiver, Sender};

use crate::fault::Fault;
use crate::frames::Frames;
use crate::line;
use crate::picture::{BLACK, CORES, HEIGHT, Line, Prepared};

/// Bytes of stack for the second core: twice what the first was seen to use.
const STACK_BYTES: usize = 8192;

/// Lines that the second core may be ahead.
const AHEAD: usize = 4;

/// The lines that come from the second core.
#[derive(Debug)]
pub(crate) struct SecondCore {
    lines: Receiver<'static, CriticalSectionRawMutex, Line>,
}

/// Starts the second core.
pub(crate) fn start(core: Peri<'static, CORE1>, scene: Prepared) -> Result<SecondCore, Fault> {
    let [black, ..] = BLACK;
    let stack = cortex_m::singleton!(STACK: Stack<STACK_BYTES> = Stack::new()).ok_or(Fault::Taken)?;
    let lines = cortex_m::singleton!(LINES: [Line; AHEAD] = [black; AHEAD]).ok_or(Fault::Taken)?;
    let channel =
        cortex_m::singleton!(CHANNEL: Channel<'static, CriticalSectionRawMutex, Line> = Channel::new(lines))
            .ok_or(Fault::Taken)?;
    let (mut traced, lines) = channel.split();
    spawn_core1(core, stack, move || {
        // Without its lines the first core waits, and the picture stands still.
        let Err(_) = trace(scene, &mut traced);
        loop {
            asm::wfi();
        }
    });
    Ok(SecondCore { lines })
}

impl SecondCore {
    /// The second core's next line.
    pub(crate) async fn next_line(&mut self, line: &mut Line) {
        *line = *self.lines.receive().await;
        self.lines.receive_done();
    }
}

/// Traces the second line of every band, for ever.
fn trace(
    scene: Prepared,
    lines: &mut Sender<'_, CriticalSectionRawMutex, Line>,
) -> Result<Infallible, Fault> {
    let mut frames = Frames::new(scene);
    loop {
        let renderer = frames.next()?;
        for y in (1..HEIGHT as u32).step_by(CORES) {
            line::trace(&renderer, y, block_on(lines.send()))?;
            lines.send_done();
        }
    }
}
