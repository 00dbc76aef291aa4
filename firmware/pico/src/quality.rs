//! Tracing of bands in the quality that `build.rs` wrote: exact or realtime.

use core::ops::Range;

use rayline::{Frame, LineError, Realtime, RealtimeBuffer, RealtimeFrame, Renderer, Sample};

use crate::band::Band;
use crate::fault::Fault;
use crate::panel_color::PanelColor;
use crate::picture::{Number, QUALITY, Set, WIDTH};

const COLORS: usize = match QUALITY {
    None => WIDTH,
    Some(quality) => quality.colors(WIDTH as u16),
};
const SAMPLES: usize = match QUALITY {
    None => 0,
    Some(quality) => quality.samples(WIDTH as u16),
};

/// The memory that a core needs to trace lines.
#[derive(Debug)]
pub(crate) struct Memory {
    colors: [PanelColor; COLORS],
    samples: [Sample; SAMPLES],
}

/// Lines that are being traced.
#[derive(Debug)]
pub(crate) enum Tracing<'r, 'b> {
    Exact(Frame<'r, 'static, 'b, Number, Set, PanelColor>),
    Realtime(RealtimeFrame<'r, 'static, 'b, Number, Set, PanelColor>),
}

impl Memory {
    pub(crate) const fn new() -> Self {
        Self { colors: [PanelColor::BLACK; COLORS], samples: [Sample::BLANK; SAMPLES] }
    }

    /// Begins a frame, with no lines yet.
    pub(crate) fn begin<'r, 'b>(
        &'b mut self,
        renderer: &'r Renderer<'r, 'static, Number, Set>,
    ) -> Result<Tracing<'r, 'b>, LineError> {
        let Self { colors, samples } = self;
        Ok(match QUALITY {
            None => Tracing::Exact(renderer.frame(0..0, colors)?),
            Some(quality) => {
                let buffer = RealtimeBuffer { colors, samples };
                Tracing::Realtime(renderer.realtime_frame(0..0, quality, buffer)?)
            }
        })
    }
}

impl Tracing<'_, '_> {
    /// Continues with other lines of the same frame.
    pub(crate) fn set_lines(&mut self, lines: Range<u32>) -> Result<(), LineError> {
        match self {
            Self::Exact(frame) => frame.set_lines(lines),
            Self::Realtime(frame) => frame.set_lines(lines),
        }
    }

    /// Traces about `rays` rays; returns whether the band is complete.
    pub(crate) fn step(&mut self, band: &mut Band, rays: u32) -> Result<bool, Fault> {
        // `QUALITY` is constant, so the compiler removes the code of the other quality.
        let progress = match (QUALITY, self) {
            (None, Self::Exact(frame)) => frame.step(band, rays),
            (Some(Realtime { .. }), Self::Realtime(frame)) => frame.step(band, rays),
            (_, Self::Exact(_) | Self::Realtime(_)) => return Err(Fault::Line),
        };
        Ok(progress.map_err(|_| Fault::Line)?.is_done())
    }
}
