//! The samples of a pixel that were taken so far.

use crate::color::LinearRgb;
use crate::math::Real;

/// The samples of one pixel that were taken so far, for [`Progressive`](super::Progressive).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSum<R> {
    /// The light of its samples, summed up as in one pass; the mean, once the pixel is complete.
    pub(super) light: LinearRgb<R>,
    /// The rays that it took.
    pub(super) rays: u32,
    pub(super) taken: u16,
    pub(super) is_complete: bool,
}

impl<R: Real> PixelSum<R> {
    /// Nothing yet.
    pub const EMPTY: Self = Self { light: LinearRgb::BLACK, rays: 0, taken: 0, is_complete: false };

    /// Whether the pixel has all samples that it needs.
    pub const fn is_complete(&self) -> bool {
        self.is_complete
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    #[test]
    fn a_pixel_takes_20_bytes() {
        assert_eq!((size_of::<PixelSum<f32>>(), size_of::<PixelSum<Fixed>>()), (20, 20));
    }
}
