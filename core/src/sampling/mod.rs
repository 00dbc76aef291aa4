//! Samples: the places in a pixel through which rays go, and all other numbers that a sample draws.
//!
//! A [`PixelSample`] is one of the samples of one pixel. It draws pairs of numbers from 0 to 1, one pair for
//! each [`Dimension`]. A pair is a pure function of pixel, sample, dimension and seed, so lines can be
//! rendered in any order and on any core.
//!
//! [`Sampler`] names the ways to draw. [`Reconstruction`] maps a pair to a place around the center of the
//! pixel: the samples lie as densely as the filter weighs them, so that all of them count alike and a pixel
//! needs no sample of its neighbors (Ernst, Stamminger and Greiner, "Filter Importance Sampling", 2006).
//!
//! Without the feature `distributed` there are the sampler R2 and the box filter alone.

mod dimension;
mod hash;
mod permutation;
mod poisson;
mod reconstruction;
mod sobol;
mod strata;
#[cfg(all(test, feature = "distributed"))]
mod tests;
mod warp;

pub(crate) use dimension::Dimension;
pub use reconstruction::Reconstruction;
pub(crate) use warp::lobe;
#[cfg(feature = "distributed")]
pub(crate) use warp::{around, centered, disc, hemisphere};

use hash::hash;

/// The center of a pixel, in 65536ths of a pixel from its left or upper side.
pub(crate) const CENTER: i32 = 0x8000;

/// How many rays from the eye go through each pixel, and where.
///
/// ```
/// use rayline::{Sampler, Sampling, Settings};
/// let sampling = Sampling { sampler: Sampler::R2, seed: 7, ..Sampling::new(16) };
/// let settings = Settings { sampling, ..Settings::new(320, 240) };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Sampling {
    /// The number of samples of each pixel, and so of rays from the eye: 1 or more. A single sample lies in
    /// the center; more make edges smooth.
    pub samples: u16,
    /// The way in which the samples are spread.
    pub sampler: Sampler,
    /// The weight of the light around the center of a pixel.
    pub filter: Reconstruction,
    /// Fewer samples where they agree; `None`: all samples in all pixels.
    pub adaptive: Option<Adaptive>,
    /// Chooses other samples of the same kind.
    pub seed: u32,
}

impl Sampling {
    /// One sample, in the center of the pixel.
    pub const CENTER: Self = Self::new(1);

    /// This number of samples, by [`Sampler::R2`] and with the box filter: what every build can do.
    pub const fn new(samples: u16) -> Self {
        Self { samples, sampler: Sampler::R2, filter: Reconstruction::Box, adaptive: None, seed: 0 }
    }

    /// Whether these settings need the feature `distributed`.
    pub(crate) fn needs_distributed(&self) -> bool {
        self.sampler != Sampler::R2 || self.filter != Reconstruction::Box || self.adaptive.is_some()
    }
}

/// One sample, in the center of the pixel.
impl Default for Sampling {
    fn default() -> Self {
        Self::CENTER
    }
}

/// How samples are spread: over the pixel, and over lenses, lamps and lobes.
///
/// The error of a picture falls with the number of samples n: as n^-½ for [`Random`](Self::Random), faster
/// for all others. All but [`R2`](Self::R2) need the feature `distributed`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Sampler {
    /// The additive recurrence R2 (Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences",
    /// 2018), shifted in each pixel (Cranley and Patterson, "Randomization of Number Theoretic Methods",
    /// 1976). It spreads the places in the pixel; all else is spread as by [`Sobol`](Self::Sobol).
    #[default]
    R2,
    /// The middle of each cell of a regular grid. Square numbers of samples fill it best. Edges show steps,
    /// because all pixels have the same samples. Only the places in the pixel are regular; all else is
    /// spread as by [`Jittered`](Self::Jittered).
    Grid,
    /// Every sample by itself: noise, and clusters.
    Random,
    /// One sample somewhere in each cell of a grid (Cook, Porter and Carpenter, "Distributed Ray Tracing",
    /// 1984). The cells of two dimensions are combined by chance.
    Jittered,
    /// Samples that keep a distance from each other (Poisson disk: Cook, "Stochastic Sampling in Computer
    /// Graphics", 1986), from a tile of 256 points that is shifted in each pixel.
    Poisson,
    /// The first two dimensions of Sobol's sequence, scrambled after Owen (Burley, "Practical Hash-based Owen
    /// Scrambling", JCGT 2020). Neighboring pixels have neighboring parts of one sequence, so that their
    /// errors differ (Ahmed and Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via
    /// Hierarchical Ordering of Pixels", 2020). Best with 4, 8, 16 … samples.
    Sobol,
}

/// Adaptive sampling: a few samples first, and the others only where the first ones differ. They differ if
/// their rays met other objects, facets or shadows, or if their colors have too much contrast (Mitchell,
/// "Generating Antialiased Images at Low Sampling Densities", 1987).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Adaptive {
    /// The number of samples that every pixel takes: 2 or more.
    pub at_first: u16,
    /// The largest contrast `(max - min) / (max + min)` of green light at which samples agree, 0 to 1; 4/3
    /// and 2 times as much for red and blue light, to which the eye is less sensitive.
    pub contrast: f32,
}

impl Adaptive {
    /// Four samples, and Mitchell's contrast of 0.3.
    pub const NEW: Self = Self { at_first: 4, contrast: 0.3 };
}

/// [`Adaptive::NEW`].
impl Default for Adaptive {
    fn default() -> Self {
        Self::NEW
    }
}

/// One sample of one pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PixelSample {
    pub(crate) sampling: Sampling,
    pub(crate) x: u16,
    pub(crate) y: u16,
    /// Its number, from 0 on.
    pub(crate) index: u16,
}

/// The numbers that the rays of a sample draw. Without the feature `distributed`, rays draw none, and this
/// takes no memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayNumbers([PixelSample; DRAWS]);

/// The samples that rays draw from.
const DRAWS: usize = if cfg!(feature = "distributed") { 1 } else { 0 };

impl RayNumbers {
    /// For rays that draw nothing.
    pub(crate) const NONE: Self = Self::of(PixelSample { sampling: Sampling::CENTER, x: 0, y: 0, index: 0 });

    /// The numbers of a sample.
    #[inline]
    pub(crate) const fn of(sample: PixelSample) -> Self {
        Self([sample; DRAWS])
    }

    /// Two numbers, in 65536ths.
    pub(crate) fn pair(&self, dimension: Dimension) -> [u16; 2] {
        self.0.first().map_or([0; 2], |sample| sample.pair(dimension))
    }

    /// Whether the pixel has one sample alone.
    #[cfg(feature = "distributed")]
    pub(crate) fn is_of_one_sample(&self) -> bool {
        self.0.first().is_none_or(|sample| sample.sampling.samples <= 1)
    }

    /// The numbers of one of several rays that the sample sends in place of one.
    #[cfg(feature = "distributed")]
    pub(crate) fn part(&self, number: u16, parts: u16) -> Self {
        Self(self.0.map(|sample| {
            let sampling =
                Sampling { samples: sample.sampling.samples.saturating_mul(parts), ..sample.sampling };
            PixelSample { sampling, index: sample.index.wrapping_mul(parts).wrapping_add(number), ..sample }
        }))
    }
}

impl PixelSample {
    /// The distance of the sample from the left and the upper side of its pixel, in 65536ths of a pixel. It
    /// may lie beside the pixel, as far as the filter reaches. A single sample lies in the center.
    pub(crate) fn place(&self) -> [i32; 2] {
        if self.sampling.samples <= 1 {
            return [CENTER; 2];
        }
        let pair = self.pair(Dimension::PIXEL);
        if cfg!(feature = "distributed") {
            pair.map(|position| self.sampling.filter.place(position))
        } else {
            pair.map(i32::from)
        }
    }

    /// Two numbers that the sample draws, in 65536ths: 0 to 65535.
    pub(crate) fn pair(&self, dimension: Dimension) -> [u16; 2] {
        let Self { sampling: Sampling { samples, sampler, seed, .. }, x, y, index } = *self;
        if !cfg!(feature = "distributed") {
            return r2((x, y), index, seed);
        }
        let pixel = u32::from(y) << 16 | u32::from(x);
        let key = hash(pixel, seed ^ hash(dimension.number(), seed));
        let (index, samples) = (u32::from(index), u32::from(samples));
        match (sampler, dimension) {
            (Sampler::R2, Dimension::PIXEL) => r2((x, y), self.index, seed),
            (Sampler::Grid, Dimension::PIXEL) => strata::grid(index, samples),
            (Sampler::Random, _) => {
                let word = hash(index, key);
                [(word >> 16) as u16, word as u16]
            }
            (Sampler::Jittered | Sampler::Grid, _) => strata::jittered(index, samples, key),
            (Sampler::Poisson, _) => poisson::point(index, samples, key, dimension == Dimension::PIXEL),
            (Sampler::Sobol | Sampler::R2, _) => {
                sobol::point((x, y), (index, samples), hash(dimension.number(), seed))
            }
        }
    }
}

/// A point of the sequence R2, which is shifted in each pixel by a hash of pixel and seed.
fn r2((x, y): (u16, u16), index: u16, seed: u32) -> [u16; 2] {
    let shift = hash(u32::from(y) << 16 | u32::from(x), seed);
    // The steps are 2³² divided by the plastic number, and by its square.
    let along =
        |shift: u32, step: u32| (shift.wrapping_add(step.wrapping_mul(u32::from(index))) >> 16) as u16;
    [along(shift, 0xC13F_A9A9), along(hash(shift, seed), 0x91E1_0DA5)]
}
