//! Jobs: bands of lines that the cores trace and the panel shows.
//!
//! A core that has traced a band takes the next one, if need be of the next frame, so that neither core waits
//! for the other at the end of a frame. The pixels of a band do not depend on other bands, so either core can
//! trace any band.

use core::ops::Range;

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use rayline_orbit::Orbit;

use crate::band::Band;
use crate::picture::{HEIGHT, LINES};

/// Number of bands that there is memory for. Some parts of a picture take twenty times as long as others;
/// with five bands a core rarely waits for a slower band of the other core.
pub(crate) const BANDS: usize = 5;

/// Some lines of a frame, and the band that holds their pixels.
#[derive(Debug)]
pub(crate) struct Job {
    pub(crate) frame: u32,
    pub(crate) lines: Range<u32>,
    pub(crate) band: &'static mut Band,
    /// The band's number: the panel shows bands in the order of their numbers.
    pub(crate) number: usize,
}

/// Jobs to trace, in the order in which they are shown.
pub(crate) static TO_TRACE: Channel<CriticalSectionRawMutex, Job, BANDS> = Channel::new();

/// Jobs that were traced, in the order in which they were completed.
pub(crate) static TRACED: Channel<CriticalSectionRawMutex, Job, BANDS> = Channel::new();

/// The lines of the next job, for all frames.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Schedule {
    frame: u32,
    top: u32,
}

impl Schedule {
    /// A schedule that starts with the first lines of the first frame.
    pub(crate) fn new() -> Self {
        Self { frame: 0, top: 0 }
    }

    /// The next job, whose pixels go to this band.
    pub(crate) fn next(&mut self, number: usize, band: &'static mut Band) -> Job {
        let lines = self.top..(self.top + LINES as u32).min(HEIGHT as u32);
        let job = Job { frame: self.frame, lines: lines.clone(), band, number };
        self.top = lines.end;
        if self.top == HEIGHT as u32 {
            *self = Self { frame: (self.frame + 1) % Orbit::FRAMES, top: 0 };
        }
        job
    }
}
