//! The memory that realtime quality draws in.

use super::quality::Realtime;
use super::sample::Sample;

/// Realtime quality, with the memory that it takes: see [`Realtime::lend`].
#[derive(Debug)]
pub struct RealtimeBuffer<'b, C> {
    /// How much the picture may differ from the exact one.
    pub quality: Realtime,
    /// A band of lines: [`Realtime::colors`] pixels.
    pub colors: &'b mut [C],
    /// A row of samples: [`Realtime::samples`].
    pub samples: &'b mut [Sample],
}

impl Realtime {
    /// This quality with memory to draw in, for [`Renderer::draw`](crate::Renderer::draw) and
    /// [`Renderer::frame`](crate::Renderer::frame). The memory holds
    /// [`colors`](Self::colors) pixels and [`samples`](Self::samples) samples, or more.
    pub fn lend<'b, C>(self, colors: &'b mut [C], samples: &'b mut [Sample]) -> RealtimeBuffer<'b, C> {
        RealtimeBuffer { quality: self, colors, samples }
    }
}
