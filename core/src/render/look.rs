//! Looks: pictures that look drawn, not photographed.
//!
//! A [`Look`] has two parts that go together in any way. [`Tones`] say how light becomes tone: as it is, in a
//! few steps, or from cool to warm. [`Contours`] are dark lines around objects and along edges.
//!
//! Each part is computed at the place in the code that has its input, and so works in every quality:
//!
//! | part | input | place |
//! |---|---|---|
//! | steps of toon tones | the light of one sample | `toon.rs`, before the mean of a pixel's samples |
//! | Gooch's tones | the normal, and the directions of lamps, also behind a surface | `integrator/gooch.rs` |
//! | contours | what neighboring pixels see | `contours.rs`, before the colors of the display |
//! | dots and lines for gray | the place of the pixel | `thresholds.rs`, by [`Dither`](super::Dither) |

use super::SettingsError;
use crate::color::LinearRgb;
use crate::integrator::{Gooch, Integrator};

/// How a picture looks: as a photograph, or as a drawing.
///
/// ```
/// use rayline::{Contours, Look, Settings, Tones};
/// let look = Look { tones: Tones::Toon { steps: 4 }, contours: Some(Contours::NEW) };
/// let settings = Settings { look, ..Settings::new(320, 240) };
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Look {
    /// How light becomes tone.
    pub tones: Tones,
    /// Dark lines around objects and along edges, if there are any.
    pub contours: Option<Contours>,
}

/// How light becomes tone. All but [`Light`](Self::Light) need [`Integrator::Whitted`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Tones {
    /// As it is.
    #[default]
    Light,
    /// In steps of the brightest channel, as in cartoons. The other channels keep their shares of it, so that
    /// hues stay (after Lake, Marshall, Harris and Blackstein, "Stylized Rendering Techniques for Scalable
    /// Real-Time 3D Animation", NPAR 2000).
    ///
    /// The steps are even to the eye: in step k of 0 to n, the brightest channel is (k / n)². Shadows,
    /// mirror images and the background have steps, too.
    Toon {
        /// The number of steps, black and white among them: 2 to 16.
        steps: u8,
    },
    /// From cool to warm tones, as in technical drawings.
    Gooch(Gooch),
}

/// Dark lines of one pixel around objects and along edges, by what neighboring pixels see (Saito and
/// Takahashi, "Comprehensible Rendering of 3-D Shapes", SIGGRAPH 1990; by rays: Choudhury and Parker, "Ray
/// Tracing NPR-Style Feature Lines", NPAR 2009).
///
/// A pixel has ink if it and its neighbor to the right or below see different objects, different parts of an
/// object with an edge between them, or one object at different depths. Only what the eye sees directly has
/// contours: no mirror image, shadow or texture has one. With several samples, each of them is compared with
/// the places a pixel beside it, so that lines are smooth.
///
/// Contours take rays without light: up to 2 for each pixel of one sample, up to 3 for each of several
/// samples and in scenes with a hierarchy. These rays come on top of
/// [`Settings::rays_per_pixel`](super::Settings::rays_per_pixel), and probes do not record them. Realtime
/// quality traces contours where neighbors on its grid differ, and where it traces more.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Contours {
    /// The least angle, in radians, between the normals of two parts of an object with a line between them: 0
    /// to π, with which there are no such lines. Within one part, such as the side and the lid of a cylinder,
    /// it is 0.79 or more.
    pub crease: f32,
    /// The least step in depth within an object that has a line, as a share of the distance from the eye: 0
    /// to 1. It is measured along the normals, so that slanted surfaces have none.
    pub depth: f32,
    /// The color of the lines, 0 to 1.
    pub ink: LinearRgb,
}

impl Look {
    /// As a photograph.
    pub const PHOTO: Self = Self { tones: Tones::Light, contours: None };

    /// Checks every number.
    pub(super) fn check(&self, integrator: Integrator) -> Result<(), SettingsError> {
        match self.tones {
            Tones::Light => {}
            _ if integrator != Integrator::Whitted => return Err(SettingsError::TonesOfPaths),
            Tones::Toon { steps: 2..=MOST_STEPS } => {}
            Tones::Toon { steps } => return Err(SettingsError::ToonSteps { given: steps, most: MOST_STEPS }),
            Tones::Gooch(gooch) if gooch.is_valid() => {}
            Tones::Gooch(_) => return Err(SettingsError::Gooch),
        }
        match self.contours {
            Some(contours) if !contours.is_valid() => Err(SettingsError::Contours),
            _ => Ok(()),
        }
    }
}

/// The most steps of toon tones.
const MOST_STEPS: u8 = 16;

impl Contours {
    /// Black lines, along edges of 29° and more and at steps of a 40th of the distance.
    pub const NEW: Self = Self { crease: 0.5, depth: 1.0 / 40.0, ink: LinearRgb::gray(0.0) };

    fn is_valid(&self) -> bool {
        // Comparisons refuse NaN.
        (0.0..=core::f32::consts::PI).contains(&self.crease)
            && (0.0..=1.0).contains(&self.depth)
            && self.ink.channels().iter().all(|channel| (0.0..=1.0).contains(channel))
    }
}

/// [`Contours::NEW`].
impl Default for Contours {
    fn default() -> Self {
        Self::NEW
    }
}
