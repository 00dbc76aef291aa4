//! What is decided about a picture besides its scene.

use core::ops::Range;

use rayline::Settings;

use crate::Display;

/// What is decided about a picture besides its scene.
///
/// ```
/// use rayline::Settings;
/// use rayline_simulator::{Number, RenderOptions};
/// let options = RenderOptions { number: Number::F64, ..RenderOptions::new(Settings::new(320, 240)) };
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RenderOptions {
    /// What the core is told.
    pub settings: Settings,
    /// What the core computes in.
    pub number: Number,
    /// The display that the picture is made for.
    pub display: Display,
    /// Whether every pixel is traced.
    pub mode: Mode,
    /// The lines to render; `None`: all.
    pub lines: Option<Range<u32>>,
    /// How many threads share the lines; 0: one for each processor. Changes no byte.
    pub threads: usize,
}

/// Whether every pixel is traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Mode {
    /// Every pixel is traced.
    #[default]
    Exact,
    /// Pixels are interpolated where their neighbors saw the same.
    Realtime,
}

/// A number system of the core.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Number {
    /// 32-bit floating point: what boards with an FPU compute in.
    #[default]
    F32,
    /// Fixed point with 32 bits: what boards without an FPU compute in.
    Fixed,
    /// 64-bit floating point: the reference.
    F64,
}

impl RenderOptions {
    /// The whole picture in `f32` for [`Display::Rgb888`], on all processors.
    pub const fn new(settings: Settings) -> Self {
        Self {
            settings,
            number: Number::F32,
            display: Display::Rgb888,
            mode: Mode::Exact,
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
