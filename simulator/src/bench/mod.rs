//! How fast pictures are: tables in Markdown.
//!
//! Times are of whole pictures, from the scene's description on: the scene is prepared, then traced. What is compared is
//! measured in turn, so that a machine that slows down slows all of it. One thread beside POV-Ray's is measured by the
//! processor's time, which POV-Ray reports as well and other programs disturb less; all others by the clock.

mod builtin;
mod rival;
mod times;

use core::fmt;
use std::io;
use std::path::Path;

use crate::RenderError;
use crate::nff::NffError;
use crate::povray::RunError;

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bench {
    /// Width and height of the built-in scenes.
    pub size: (u32, u32),
    /// Side of the pictures that POV-Ray renders as well.
    pub rival_side: u32,
    /// How often each picture is rendered.
    pub runs: usize,
}

impl Bench {
    /// What takes about a minute.
    pub const FULL: Self = Self { size: (320, 240), rival_side: 512, runs: 7 };
    /// What takes a second, to see that it works.
    pub const QUICK: Self = Self { size: (64, 48), rival_side: 64, runs: 1 };

    /// Measures the built-in scenes in both qualities and all number systems. `say` is told what is being measured.
    ///
    /// # Errors
    /// See [`BenchError`].
    pub fn builtin_scenes(&self, say: &dyn Fn(&str)) -> Result<String, BenchError> {
        builtin::measure(self, say)
    }

    /// Measures Rayline beside POV-Ray, on one thread each; `None` where `povray` is not installed. Files that POV-Ray needs
    /// are written to `directory`.
    ///
    /// # Errors
    /// See [`BenchError`].
    pub fn beside_povray(&self, directory: &Path, say: &dyn Fn(&str)) -> Result<Option<String>, BenchError> {
        rival::measure(self, directory, say)
    }
}

/// Why there are no figures.
#[derive(Debug)]
#[non_exhaustive]
pub enum BenchError {
    /// A picture could not be rendered. Mend what it says.
    Render(RenderError),
    /// POV-Ray gave no picture. Mend what it says.
    Povray(RunError),
    /// POV-Ray's report does not tell the time of this step. Install version 3.7.
    NoTime(&'static str),
    /// A scene that comes with this program is broken. Report it.
    Scene(NffError),
    /// The system refused a file. Mend what it says.
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
            Self::NoTime(step) => write!(f, "POV-Ray does not tell its {step}; install version 3.7"),
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
