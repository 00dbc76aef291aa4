//! The share of light that is left on its way to the pixel.

use core::ops::Mul;

use crate::color::LinearRgb;
use crate::math::Real;

/// Light is colored on its way only by the feature `optics`. Without it one channel stands for all three,
/// which keeps rays small; gray light has the same bytes with and without.
const CHANNELS: usize = if cfg!(feature = "optics") { 3 } else { 1 };

/// The share of light that is left on its way, 0 to 1 in each channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Throughput<R>([R; CHANNELS]);

impl<R: Real> Throughput<R> {
    /// One share for all channels.
    #[inline]
    pub(crate) fn even(share: R) -> Self {
        Self([share; CHANNELS])
    }

    /// A share for each channel. Without the feature `optics`, the red one for all.
    #[inline]
    pub(crate) fn colored(LinearRgb { r, g, b }: LinearRgb<R>) -> Self {
        Self([r, g, b].first_chunk().copied().unwrap_or([r; CHANNELS]))
    }

    /// The shares as a color.
    #[inline]
    pub(crate) fn color(self) -> LinearRgb<R> {
        match self.0.as_slice() {
            [r, g, b] => LinearRgb::new(*r, *g, *b),
            [gray, ..] => LinearRgb::even(*gray),
            [] => LinearRgb::BLACK,
        }
    }

    /// The largest of the channels.
    #[inline]
    pub(crate) fn largest(self) -> R {
        let LinearRgb { r, g, b } = self.color();
        if CHANNELS == 1 { r } else { r.larger(g).larger(b) }
    }

    /// This share of an amount of light.
    #[inline]
    pub(crate) fn of(self, light: LinearRgb<R>) -> LinearRgb<R> {
        light * self.color()
    }
}

impl<R: Real> Mul<R> for Throughput<R> {
    type Output = Self;
    #[inline]
    fn mul(self, share: R) -> Self {
        Self(self.0.map(|channel| channel.attenuated(share)))
    }
}

impl<R: Real> Mul for Throughput<R> {
    type Output = Self;
    #[inline]
    fn mul(mut self, other: Self) -> Self {
        self.0.iter_mut().zip(other.0).for_each(|(channel, share)| *channel = channel.attenuated(share));
        self
    }
}
