//! Measurements of the speed of rendering, as tables in Markdown.
//!
//! A time covers a whole picture: preparing the scene and tracing it. Pictures that are compared are rendered
//! in turn, so that a slowdown of the machine affects all of them. Beside POV-Ray, CPU time on one thread is
//! measured, because POV-Ray reports it too and other programs disturb it less. All other times are
//! wall-clock times.

mod builtin;
mod convergence;
mod povray;
mod times;

pub use convergence::Convergence;

use core::fmt;
use std::io;
use std::path::Path;

use crate::RenderError;
use crate::nff::NffError;
use crate::povray::RunError;

/// The extent of a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bench {
    /// The width and height of the pictures of built-in scenes, in pixels.
    pub size: (u32, u32),
    /// The width and height of the pictures that POV-Ray renders as well, in pixels.
    pub povray_side: u32,
    /// How many times each picture is rendered.
    pub runs: usize,
}

impl Bench {
    /// A measurement of about a minute.
    pub const FULL: Self = Self { size: (320, 240), povray_side: 512, runs: 7 };
    /// A measurement of a second, to test that it works.
    pub const QUICK: Self = Self { size: (64, 48), povray_side: 64, runs: 1 };

    /// Measures the built-in scenes in both qualities and all number systems. `say` is called with a text for
    /// each measurement.
    ///
    /// # Errors
    /// See [`BenchError`].
    pub fn builtin_scenes(&self, say: &dyn Fn(&str)) -> Result<String, BenchError> {
        builtin::measure(self, say)
    }

    /// Measures Rayline and POV-Ray in turn, on one thread each; `None` if `povray` is not installed. Files
    /// for POV-Ray are written to `directory`.
    ///
    /// # Errors
    /// See [`BenchError`].
    pub fn beside_povray(&self, directory: &Path, say: &dyn Fn(&str)) -> Result<Option<String>, BenchError> {
        povray::measure(self, directory, say)
    }
}

/// The reason why a measurement failed.
#[derive(Debug)]
#[non_exhaustive]
pub enum BenchError {
    /// A picture could not be rendered.
    Render(RenderError),
    /// POV-Ray failed.
    Povray(RunError),
    /// POV-Ray's report does not have the time of this step. Install version 3.7.
    NoTime(&'static str),
    /// A scene of this program is broken. Report the bug.
    Scene(NffError),
    /// The system refused a file.
    Io(io::Error),
}

impl From<RenderError> for BenchError {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}

impl fmt::Display for BenchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Render(error) => error.fmt(f),
            Self::Povray(error) => error.fmt(f),
            Self::NoTime(step) => write!(f, "POV-Ray does not report its {step}; install version 3.7"),
            Self::Scene(error) => error.fmt(f),
            Self::Io(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for BenchError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Render(error) => Some(error),
            Self::Povray(error) => Some(error),
            Self::NoTime(_) => None,
            Self::Scene(error) => Some(error),
            Self::Io(error) => Some(error),
        }
    }
}
