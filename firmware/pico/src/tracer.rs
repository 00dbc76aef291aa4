//! The first core's part of every frame.

use core::convert::Infallible;

use embassy_futures::yield_now;
use embassy_sync::blocking_mutex::raw::NoopRawMutex;
use embassy_sync::zerocopy_channel::Sender;

use crate::fault::Fault;
use crate::frames::Frames;
use crate::line;
use crate::picture::{Band, CORES, HEIGHT, Prepared};
use crate::second_core::SecondCore;

/// Traces the first line of every band. The other, if there is one, comes from the second core.
#[derive(Debug)]
pub(crate) struct Tracer {
    frames: Frames,
    second_core: SecondCore,
}

impl Tracer {
    pub(crate) fn new(scene: Prepared, second_core: SecondCore) -> Self {
        Self { frames: Frames::new(scene), second_core }
    }

    /// Traces bands for ever, frame after frame.
    pub(crate) async fn trace(
        mut self,
        bands: &mut Sender<'_, NoopRawMutex, Band>,
    ) -> Result<Infallible, Fault> {
        loop {
            let renderer = self.frames.next()?;
            for y in (0..HEIGHT as u32).step_by(CORES) {
                let [first, others @ ..] = bands.send().await;
                line::trace(&renderer, y, first)?;
                for line in others {
                    self.second_core.next_line(line).await;
                }
                bands.send_done();
                // Here the panel is given the band, if it is not busy with the one before.
                yield_now().await;
            }
        }
    }
}
