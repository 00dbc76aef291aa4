//! How a picture is rendered.

use super::SettingsError;
#[cfg(feature = "looks")]
use super::look::Look;
use crate::integrator::{AreaLights, Integrator};
use crate::limits::{MAX_BOUNCES, MAX_SIDE};
use crate::sampling::{Adaptive, Sampling};

/// How a picture is rendered.
///
/// ```
/// use rayline::{Settings, Transfer};
/// let settings = Settings { bounces: 3, transfer: Transfer::Linear, ..Settings::new(320, 240) };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Settings {
    /// Width of the picture in pixels, 1 to 65535.
    pub width: u32,
    /// Height of the picture in pixels, 1 to 65535.
    pub height: u32,
    /// How often light may be mirrored or refracted on its way: 0 to
    /// [`MAX_BOUNCES`](crate::limits::MAX_BOUNCES).
    pub bounces: u8,
    /// The most rays that one pixel may spend, shadow rays included: 1 or more. Rays beyond it are left
    /// out, and counted as [`Cut::Rays`](crate::Cut::Rays).
    pub rays_per_pixel: u32,
    /// Rays of which a smaller share of light than this reaches the pixel are left out: 0 to 1.
    pub cutoff: f32,
    /// The rays from the eye through each pixel: how many, and where.
    pub sampling: Sampling,
    /// The rays by which light finds its way to the eye.
    pub integrator: Integrator,
    /// How the light of lamps with a size is found.
    pub area_lights: AreaLights,
    /// The curve from light to the codes of a display.
    pub transfer: Transfer,
    /// The rounding of light to the levels of a display.
    pub dither: Dither,
    /// The look: as a photograph or as a drawing.
    #[cfg(feature = "looks")]
    pub look: Look,
}

impl Settings {
    /// Four bounces, one sample for each pixel, Whitted's rays, lamps with a size by rays, sRGB, no
    /// dithering.
    pub const fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            bounces: 4,
            rays_per_pixel: 4096,
            cutoff: 1.0 / 256.0,
            sampling: Sampling::CENTER,
            integrator: Integrator::Whitted,
            area_lights: AreaLights::Sampled,
            transfer: Transfer::Srgb,
            dither: Dither::None,
            #[cfg(feature = "looks")]
            look: Look::PHOTO,
        }
    }

    /// Checks every setting. Returns width and height.
    pub(super) fn check(&self) -> Result<(u16, u16), SettingsError> {
        let side = |side: u32| match u16::try_from(side) {
            Ok(length @ 1..) => Ok(length),
            _ => Err(SettingsError::Size { side, most: MAX_SIDE }),
        };
        if self.bounces > MAX_BOUNCES {
            return Err(SettingsError::Bounces { given: self.bounces, most: MAX_BOUNCES });
        }
        self.check_sampling()?;
        if !(0.0..=1.0).contains(&self.cutoff) {
            return Err(SettingsError::Cutoff);
        }
        #[cfg(feature = "looks")]
        self.look.check(self.integrator)?;
        Ok((side(self.width)?, side(self.height)?))
    }

    fn check_sampling(&self) -> Result<(), SettingsError> {
        let Sampling { samples, adaptive, .. } = self.sampling;
        if samples == 0 {
            return Err(SettingsError::Samples);
        }
        // Each sample takes a ray or more.
        if u32::from(samples) > self.rays_per_pixel {
            return Err(SettingsError::SamplesBeyondRays { samples, rays: self.rays_per_pixel });
        }
        if !cfg!(feature = "distributed") && self.sampling.needs_distributed() {
            return Err(SettingsError::WithoutDistributed);
        }
        if cfg!(feature = "distributed")
            && let Some(Adaptive { at_first, contrast }) = adaptive
        {
            if !(2..=samples).contains(&at_first) {
                return Err(SettingsError::AtFirst { given: at_first, samples });
            }
            if !(0.0..=1.0).contains(&contrast) {
                return Err(SettingsError::Contrast);
            }
        }
        Ok(())
    }
}

/// The curve from light to the codes of a display.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Transfer {
    /// The curve of IEC 61966-2-1, which displays expect.
    #[default]
    Srgb,
    /// Codes proportional to light: for LED matrices (WS2812, HUB75), for dithering to black and white, and
    /// for comparisons.
    Linear,
}

/// The rounding of light to the levels of a display.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Dither {
    /// To the nearest level.
    #[default]
    None,
    /// Up or down by an 8×8 threshold matrix, so that areas keep their mean (Bayer, "An Optimum Method for
    /// Two-Level Rendition of Continuous-Tone Pictures", 1973).
    Ordered,
    /// As `Ordered`, with dots that are spread evenly, as in blue noise (Roberts, "The Unreasonable
    /// Effectiveness of Quasirandom Sequences", 2018).
    #[cfg(feature = "looks")]
    Stippling,
    /// As `Ordered`, with lines in two directions: the darker, the denser.
    #[cfg(feature = "looks")]
    Hatching,
    /// As `Ordered`, by a mask of 64×64 pixels without a pattern: blue noise, as it is best for photographs
    /// (Ulichney, "The Void-and-Cluster Method for Dither Array Generation", SPIE 1993).
    #[cfg(feature = "looks")]
    BlueNoise,
}
