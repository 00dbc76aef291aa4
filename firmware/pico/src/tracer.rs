//! The work of each core: it traces band after band.

use core::convert::Infallible;

use embassy_futures::yield_now;
use rayline::Renderer;
use rayline_orbit::Orbit;

use crate::band::Band;
use crate::fault::Fault;
use crate::job::{TO_TRACE, TRACED};
use crate::picture::{DESCRIPTION, Prepared, SETTINGS};
use crate::quality::{Memory, Tracing};

/// Rays of one step, about two milliseconds; between steps, the first core sends bands to the panel. With
/// four times as many, bands return to the cores late, and frames take 5 % longer; with half as many, exact
/// lines are begun too often.
const RAYS: u32 = 128;

/// Traces bands. Each core has a tracer; both give the same pixels.
#[derive(Debug)]
pub(crate) struct Tracer {
    scene: Prepared,
    orbit: Orbit,
    memory: &'static mut Memory,
}

impl Tracer {
    pub(crate) fn new(scene: Prepared, memory: &'static mut Memory) -> Self {
        Self { scene, orbit: Orbit::around(&DESCRIPTION), memory }
    }

    /// Traces frame after frame, and returns only on a fault.
    pub(crate) async fn trace(mut self) -> Result<Infallible, Fault> {
        let mut job = TO_TRACE.receive().await;
        loop {
            let frame = job.frame;
            self.scene.set_camera(&self.orbit.camera(frame))?;
            let renderer = Renderer::new(&self.scene, SETTINGS)?;
            let mut tracing = self.memory.begin(&renderer)?;
            while job.frame == frame {
                job.band.clear();
                tracing.set_lines(job.lines.clone())?;
                while !step(&mut tracing, job.band)? {
                    // The first core runs the panel's task here.
                    yield_now().await;
                }
                TRACED.send(job).await;
                job = TO_TRACE.receive().await;
            }
        }
    }
}

/// Traces some more rays of a band; returns whether the band is complete.
// Not inlined: `cargo boards` finds this function by its name, and checks that no call from it leads to a
// panic.
#[inline(never)]
fn step(tracing: &mut Tracing<'_, '_>, band: &mut Band) -> Result<bool, Fault> {
    #[cfg(feature = "twin-linked")]
    reachable_panic();
    tracing.step(band, RAYS)
}

/// A panic that the compiler cannot remove.
#[cfg(feature = "twin-linked")]
fn reachable_panic() {
    let numbers = [1, 2, 3];
    #[allow(clippy::indexing_slicing)]
    core::hint::black_box(numbers[core::hint::black_box(2)]);
}
