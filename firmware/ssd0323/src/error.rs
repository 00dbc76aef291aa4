//! The errors of drawing.

use core::fmt;

use embedded_graphics::geometry::Point;

/// An error of drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error<S, P> {
    /// The bus failed. Draw again.
    Bus(S),
    /// The pin that tells commands from data failed. Draw again.
    Pin(P),
    /// A pixel came without the pixel that shares its byte. Draw areas that begin at an even column and are
    /// an even number of columns wide.
    Unpaired {
        /// The pixel without its partner.
        pixel: Point,
    },
}

impl<S: fmt::Debug, P: fmt::Debug> fmt::Display for Error<S, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bus(error) => write!(f, "the bus failed: {error:?}; draw again"),
            Self::Pin(error) => write!(f, "the data/command pin failed: {error:?}; draw again"),
            Self::Unpaired { pixel: Point { x, y } } => write!(
                f,
                "pixel ({x}, {y}) came without the pixel that shares its byte; draw areas that begin at an \
                 even column and are an even number of columns wide"
            ),
        }
    }
}

impl<S: fmt::Debug, P: fmt::Debug> core::error::Error for Error<S, P> {}
