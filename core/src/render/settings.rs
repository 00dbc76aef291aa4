//! How a picture is rendered.

use super::{Dither, SettingsError, Transfer};
use crate::limits::{MAX_BOUNCES, MAX_SIDE};

/// How a picture is rendered.
///
/// ```
/// use rayline::{Settings, Transfer};
/// let settings = Settings { bounces: 3, transfer: Transfer::Linear, ..Settings::new(320, 240) };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Width of the picture in pixels, 0 to 65535.
    pub width: u32,
    /// Height of the picture in pixels, 0 to 65535.
    pub height: u32,
    /// How often light may be mirrored or refracted on its way: 0 to
    /// [`MAX_BOUNCES`](crate::limits::MAX_BOUNCES).
    pub bounces: u8,
    /// The most rays that one pixel may spend, shadow rays included: 1 or more. What exceeds it is left out and
    /// counted.
    pub rays_per_pixel: u32,
    /// Rays that would bring a smaller share of their light than this to the pixel are left out: 0 to 1.
    pub cutoff: f32,
    /// How many places of each pixel are looked at: 1 or more. One looks at the center; more smooth the edges.
    pub samples_per_pixel: u16,
    /// Where in the pixel several samples lie.
    pub seed: u32,
    /// How light becomes a display's code.
    pub transfer: Transfer,
    /// How light is rounded to the display's levels.
    pub dither: Dither,
}

impl Settings {
    /// Four bounces, one sample per pixel, sRGB, no dithering.
    pub const fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            bounces: 4,
            rays_per_pixel: 4096,
            cutoff: 1.0 / 256.0,
            samples_per_pixel: 1,
            seed: 0,
            transfer: Transfer::Srgb,
            dither: Dither::None,
        }
    }

    /// Checks every setting and tells width and height.
    pub(super) fn check(&self) -> Result<(u16, u16), SettingsError> {
        let side = |side: u32| u16::try_from(side).map_err(|_| SettingsError::Size { side, most: MAX_SIDE });
        if self.bounces > MAX_BOUNCES {
            return Err(SettingsError::Bounces { given: self.bounces, most: MAX_BOUNCES });
        }
        if self.rays_per_pixel == 0 {
            return Err(SettingsError::RaysPerPixel);
        }
        if self.samples_per_pixel == 0 {
            return Err(SettingsError::SamplesPerPixel);
        }
        if !(0.0..=1.0).contains(&self.cutoff) {
            return Err(SettingsError::Cutoff);
        }
        Ok((side(self.width)?, side(self.height)?))
    }
}
