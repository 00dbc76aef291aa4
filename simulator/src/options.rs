//! The options for rendering a scene.

use core::ops::Range;

use rayline::{Edges, Sampler, Settings};

use crate::Display;

/// The options for rendering a scene.
///
/// ```
/// use rayline::Settings;
/// use rayline_simulator::{Number, RenderOptions};
/// let options = RenderOptions { number: Number::F64, ..RenderOptions::new(Settings::new(320, 240)) };
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RenderOptions {
    /// The settings of the core.
    pub settings: Settings,
    /// The number system of the core.
    pub number: Number,
    /// The display that the picture is made for, by the color of its pixels.
    pub display: Display,
    /// The quality of the picture.
    pub mode: Mode,
    /// The edges of pictures in [`Mode::Realtime`].
    pub edges: Edges,
    /// The sides of the polygons that take the place of circles in [`Mode::Preview`].
    pub segments: u16,
    /// The contents of the picture.
    pub show: Show,
    /// The lines to render; `None` for all.
    pub lines: Option<Range<u32>>,
    /// The number of threads; 0 for one on each processor. The picture does not depend on it.
    pub threads: usize,
}

/// The quality of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Mode {
    /// Every pixel is traced.
    #[default]
    Exact,
    /// Pixels are interpolated where the rays of their neighbors hit the same.
    Realtime,
    /// Scan conversion in place of rays: no shadows, and mirrors and glass show the background.
    Preview,
}

/// The contents of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Show {
    /// The colors of the pixels.
    #[default]
    Colors,
    /// The samples that each pixel takes: black for none, white for as many as it may take.
    Samples,
}

/// The samplers of the core, with their names on the command line and in tables.
pub const SAMPLERS: [(&str, Sampler); 6] = [
    ("random", Sampler::Random),
    ("grid", Sampler::Grid),
    ("jittered", Sampler::Jittered),
    ("poisson", Sampler::Poisson),
    ("r2", Sampler::R2),
    ("sobol", Sampler::Sobol),
];

/// A number system of the core.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Number {
    /// 32-bit floating point, for boards with an FPU.
    #[default]
    F32,
    /// Fixed point in 32 bits, for boards without an FPU.
    Fixed,
    /// 64-bit floating point: the reference.
    F64,
}

impl RenderOptions {
    /// Options for the whole picture, exact, in `f32`, for [`Display::Rgb888`], on all processors.
    pub const fn new(settings: Settings) -> Self {
        Self {
            settings,
            number: Number::F32,
            display: Display::Rgb888,
            mode: Mode::Exact,
            edges: Edges::Stepped,
            segments: 32,
            show: Show::Colors,
            lines: None,
            threads: 0,
        }
    }
}

impl core::fmt::Display for Mode {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Exact => "exact",
            Self::Realtime => "realtime",
            Self::Preview => "preview",
        })
    }
}

impl core::fmt::Display for Number {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::F32 => "f32",
            Self::Fixed => "fixed",
            Self::F64 => "f64",
        })
    }
}
