//! Errors of animations.

use core::fmt;
use std::path::PathBuf;

use rayline_formats::nearest::DidYouMean;

use crate::ron::RonError;

/// The reason why an animation cannot be read.
#[derive(Debug)]
#[non_exhaustive]
pub enum AnimationError {
    /// The file cannot be read or breaks the grammar. Correct it at the position in the error.
    Ron(RonError),
    /// A part of the animation was refused. Correct it.
    Refused {
        /// The file.
        path: PathBuf,
        /// The part of the animation.
        of: String,
        /// The reason.
        fault: AnimationFault,
    },
}

/// The reason why a part of an animation is refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum AnimationFault {
    /// The length is 0, negative, or too long. Change `seconds`.
    Seconds {
        /// The longest animation.
        most: f32,
    },
    /// There are no frames in a second, or too many. Change `frames_per_second`.
    FramesPerSecond {
        /// The most frames in a second.
        most: f32,
    },
    /// There is no frame, or there are too many. Change the length or the frames in a second.
    Frames {
        /// The number of frames.
        frames: f32,
        /// The most frames.
        most: f32,
    },
    /// The scene does not have this part. Use one that it has.
    Unknown {
        /// The name that is most similar.
        nearest: Option<String>,
        /// The number of the scene's parts of this kind.
        count: usize,
    },
    /// There is no key frame. Add one, or leave out the part.
    NoKeys,
    /// The time of a key frame is negative or not a number, or not later than that of the key frame before.
    Times {
        /// The time in seconds.
        at: f32,
    },
    /// The light does not have this field. Leave it out.
    Field(&'static str),
}

impl fmt::Display for AnimationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ron(error) => error.fmt(f),
            Self::Refused { path, of, fault } => write!(f, "{}: {of}: {fault}", path.display()),
        }
    }
}

impl fmt::Display for AnimationFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Seconds { most } => write!(f, "the length must be above 0 and at most {most} seconds"),
            Self::FramesPerSecond { most } => {
                write!(f, "the frames in a second must be above 0 and at most {most}")
            }
            Self::Frames { frames, most } => {
                write!(f, "it would have {frames} frames; between 1 and {most} are possible")
            }
            Self::Unknown { nearest: Some(nearest), .. } => {
                write!(f, "the scene has none of this name{}", DidYouMean(Some(nearest)))
            }
            Self::Unknown { nearest: None, count: 0 } => f.write_str("the scene has none"),
            Self::Unknown { nearest: None, count } => {
                write!(f, "the scene has none of this name; numbers from 0 to {} are possible", count - 1)
            }
            Self::NoKeys => f.write_str("there is no key frame; add one, or leave this part out"),
            Self::Times { at } => {
                write!(f, "the key frame at {at} is not later than the one before; times grow from 0 on")
            }
            Self::Field(field) => write!(f, "a light of this kind has no {field}; leave it out"),
        }
    }
}

impl core::error::Error for AnimationError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Ron(error) => Some(error),
            Self::Refused { fault, .. } => Some(fault),
        }
    }
}

impl core::error::Error for AnimationFault {}
