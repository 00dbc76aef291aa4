//! What can go wrong between a prepared scene and the display.

use core::fmt;

use crate::limits::{MAX_PREVIEW_FACETS, MAX_PREVIEW_SIDE, MAX_SEGMENTS, MIN_SEGMENTS};

/// A setting is out of range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SettingsError {
    /// The picture has no pixels, or is too wide or too high. Use sides that are allowed.
    Size {
        /// The side that is not allowed.
        side: u32,
        /// The longest that is allowed.
        most: u32,
    },
    /// Too many bounces. Use fewer.
    Bounces {
        /// Bounces in the settings.
        given: u8,
        /// The most that are allowed.
        most: u8,
    },
    /// Not even one sample for each pixel. Take at least 1.
    Samples,
    /// More samples than rays for each pixel. Allow more rays, or take fewer samples.
    SamplesBeyondRays {
        /// Samples of a pixel.
        samples: u16,
        /// The most rays of a pixel.
        rays: u32,
    },
    /// Adaptive sampling cannot begin with this number of samples. Begin with 2 to all of them.
    AtFirst {
        /// The number of samples at first.
        given: u16,
        /// The number of all samples.
        samples: u16,
    },
    /// The contrast of adaptive sampling is not between 0 and 1. Mitchell's is 0.3.
    Contrast,
    /// The sampling needs the feature `distributed`, which this build of the crate does not have. Switch the
    /// feature on, or use [`Sampling::new`](crate::Sampling::new).
    WithoutDistributed,
    /// The cut-off is not between 0 and 1. Use 0 to follow every ray.
    Cutoff,
    /// Toon tones cannot have this number of steps. Use 2 or more; 4 are usual.
    #[cfg(feature = "looks")]
    ToonSteps {
        /// The number of steps.
        given: u8,
        /// The most steps.
        most: u8,
    },
    /// A number of Gooch's tones is not between 0 and 1. Use [`Gooch::NEW`](crate::Gooch::NEW).
    #[cfg(feature = "looks")]
    Gooch,
    /// Toon tones and Gooch's take the place of light that path tracing scatters. Use
    /// [`Integrator::Whitted`](crate::Integrator::Whitted), or contours alone.
    #[cfg(feature = "looks")]
    TonesOfPaths,
    /// The angle of a crease is not between 0 and π, or the step in depth or the color of the ink not between
    /// 0 and 1. Use [`Contours::NEW`](crate::Contours::NEW).
    #[cfg(feature = "looks")]
    Contours,
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { side, most } => {
                write!(f, "a picture cannot have a side of {side} pixels; use 1 to {most}")
            }
            Self::Bounces { given, most } => write!(f, "{given} bounces are too many; use at most {most}"),
            Self::Samples => f.write_str("no samples for a pixel; take at least 1"),
            Self::SamplesBeyondRays { samples, rays } => write!(
                f,
                "{samples} samples of a pixel need more than {rays} rays; allow more rays or take fewer \
                 samples"
            ),
            Self::AtFirst { given, samples } => write!(
                f,
                "adaptive sampling cannot begin with {given} of {samples} samples; begin with 2 to {samples}"
            ),
            Self::Contrast => f.write_str("the contrast is not between 0 and 1; 0.3 is usual"),
            Self::WithoutDistributed => f.write_str(
                "the sampling needs the feature `distributed` of the crate rayline; switch it on, or use \
                 `Sampling::new`",
            ),
            Self::Cutoff => f.write_str("the cut-off is not between 0 and 1; use 0 to follow every ray"),
            #[cfg(feature = "looks")]
            Self::ToonSteps { given, most } => {
                write!(f, "toon tones cannot have {given} steps; use 2 to {most}, 4 are usual")
            }
            #[cfg(feature = "looks")]
            Self::Gooch => f.write_str("a number of Gooch's tones is not between 0 and 1; use `Gooch::NEW`"),
            #[cfg(feature = "looks")]
            Self::TonesOfPaths => f.write_str(
                "toon tones and Gooch's take the place of light that path tracing scatters; use \
                 `Integrator::Whitted`, or contours alone",
            ),
            #[cfg(feature = "looks")]
            Self::Contours => f.write_str(
                "the crease of contours is not between 0 and 3.14 radians, or their depth or ink not between \
                 0 and 1; use `Contours::NEW`",
            ),
        }
    }
}

impl core::error::Error for SettingsError {}

/// A line cannot be rendered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum LineError {
    /// The buffer does not hold one line. Lend as many pixels as the picture is wide, or a multiple to draw
    /// several lines together.
    BufferLength {
        /// Pixels of the buffer.
        given: usize,
        /// Width of the picture.
        width: u32,
    },
    /// The buffer of colors for realtime quality does not hold one band of lines. Lend
    /// [`Realtime::colors`](crate::Realtime::colors) pixels or more.
    BandLength {
        /// Pixels of the buffer.
        given: usize,
        /// Pixels of a band.
        needed: usize,
    },
    /// The buffer of samples for realtime quality is too short. Lend
    /// [`Realtime::samples`](crate::Realtime::samples) samples or more.
    SampleCount {
        /// Samples of the buffer.
        given: usize,
        /// Samples of a row.
        needed: usize,
    },
    /// There is not one [`PixelSum`](crate::PixelSum) for each pixel. Lend width times height of them.
    SumCount {
        /// Sums that were lent.
        given: usize,
        /// Pixels of the picture.
        needed: usize,
    },
    /// Smooth edges need the feature `distributed`, which this build of the crate does not have. Switch the
    /// feature on, or draw with [`Edges::Stepped`](crate::Edges::Stepped).
    WithoutDistributed,
    /// The picture has no such line. Name one below its height.
    NoSuchLine {
        /// The line that was named.
        line: u32,
        /// The number of lines of the picture.
        height: u32,
    },
    /// The preview is that of a picture of another size. Make one with this renderer.
    OtherPicture,
}

impl fmt::Display for LineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BufferLength { given, width } => {
                write!(
                    f,
                    "a buffer of {given} pixels does not hold a line of {width}; lend {width}, or a \
                     multiple to draw several"
                )
            }
            Self::BandLength { given, needed } => {
                write!(
                    f,
                    "a buffer of {given} pixels does not hold a band of lines; lend {needed}: \
                     `Realtime::colors`"
                )
            }
            Self::SampleCount { given, needed } => {
                write!(
                    f,
                    "a buffer of {given} samples does not hold a row; lend {needed}: `Realtime::samples`"
                )
            }
            Self::SumCount { given, needed } => {
                write!(f, "{given} sums do not fit a picture of {needed} pixels; lend one for each pixel")
            }
            Self::WithoutDistributed => f.write_str(
                "smooth edges need the feature `distributed` of the crate rayline; switch it on, or draw \
                 with `Edges::Stepped`",
            ),
            Self::NoSuchLine { line, height } => {
                write!(
                    f,
                    "there is no line {line}: the picture has {height}, counted from 0; ask for one below {height}"
                )
            }
            Self::OtherPicture => f.write_str(
                "the preview is that of a picture of another size; make one with the renderer that draws it",
            ),
        }
    }
}

impl core::error::Error for LineError {}

/// A scene has no preview.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum PreviewError {
    /// The polygons that take the place of circles cannot have so many sides.
    Segments {
        /// The number of sides.
        given: u16,
    },
    /// The picture is too wide or too high.
    Size {
        /// The longer side in pixels.
        side: u16,
    },
    /// There are more facets than the lent memory holds.
    Facets {
        /// The facets that can be seen.
        needed: usize,
        /// The facets that the memory holds.
        lent: usize,
    },
}

impl fmt::Display for PreviewError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Segments { given } => write!(
                f,
                "circles cannot become polygons of {given} sides; use {MIN_SEGMENTS} to {MAX_SEGMENTS}, \
                 16 is usual"
            ),
            Self::Size { side } => {
                write!(f, "a preview cannot have a side of {side} pixels; use at most {MAX_PREVIEW_SIDE}")
            }
            Self::Facets { needed, lent } => write!(
                f,
                "memory for {lent} facets does not hold the {needed} that are seen; lend more, at most \
                 {MAX_PREVIEW_FACETS}, or use fewer segments"
            ),
        }
    }
}

impl core::error::Error for PreviewError {}

/// Drawing stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum DrawError<E> {
    /// Nothing was drawn, because memory or lines do not fit the picture.
    Line(LineError),
    /// The display failed. All lines before `line` are on the display; draw again from there.
    Display {
        /// The first line that may not have been drawn.
        line: u32,
        /// The display's own error.
        error: E,
    },
}

impl<E> From<LineError> for DrawError<E> {
    fn from(error: LineError) -> Self {
        Self::Line(error)
    }
}

impl<E: fmt::Debug> fmt::Display for DrawError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(error) => error.fmt(f),
            Self::Display { line, error } => {
                write!(f, "the display failed at line {line}: {error:?}; draw again from there")
            }
        }
    }
}

impl<E: fmt::Debug> core::error::Error for DrawError<E> {}
