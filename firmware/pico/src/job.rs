//! Bands of lines: handed out to whichever core has time, and from there to the panel.
//!
//! A core that is done takes the next band, of the next frame if need be, so that neither waits for the other
//! at the end of a frame. What a band looks like does not depend on the others, so it does not matter which
//! core traces it.

use core::ops::Range;

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use rayline_orbit::Orbit;

use crate::band::Band;
use crate::picture::{HEIGHT, LINES};

/// Bands that there is memory for: a frame. Some parts of a picture take twenty times as long as others: with
/// so many, the core that has an easy part is not soon held up by the other.
pub(crate) const BANDS: usize = 5;

/// Some lines of a frame, and the memory for them.
#[derive(Debug)]
pub(crate) struct Job {
    pub(crate) frame: u32,
    pub(crate) lines: Range<u32>,
    pub(crate) band: &'static mut Band,
    /// Which of the bands it is: they go to the panel in turn.
    pub(crate) number: usize,
}

/// What is to be traced, first things first.
pub(crate) static TO_TRACE: Channel<CriticalSectionRawMutex, Job, BANDS> = Channel::new();

/// What was traced, in the order in which it was done.
pub(crate) static TRACED: Channel<CriticalSectionRawMutex, Job, BANDS> = Channel::new();

/// Goes through all bands of all frames.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Schedule {
    frame: u32,
    top: u32,
}

impl Schedule {
    /// Starts with the first lines of the first frame.
    pub(crate) fn new() -> Self {
        Self { frame: 0, top: 0 }
    }

    /// Fits a band out with the lines that come next.
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
