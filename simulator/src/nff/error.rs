//! What can be wrong with the text of an NFF file.

use core::fmt;

/// An NFF file was refused: in which line, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct NffError {
    /// The line, counted from 1. Where something is missing, the last line of the file.
    pub line: usize,
    /// What is wrong there, and what to do.
    pub fault: NffFault,
}

/// Why an NFF file was refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NffFault {
    /// The file is not text. Convert it to UTF-8 or plain ASCII.
    NotUtf8,
    /// Something else stands where a number or a word must be. Write what is expected.
    Expected {
        /// What must stand there.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// The file ends in the middle of a statement. Complete it.
    EndOfFile {
        /// What must follow.
        expected: &'static str,
    },
    /// A number is NaN, infinite or too large for an `f32`. Replace it.
    NotFinite {
        /// What the number stands for.
        meaning: &'static str,
        /// How it is written.
        found: String,
    },
    /// No statement begins so. Use one of those that the format has.
    UnknownKeyword {
        /// The word.
        found: String,
    },
    /// `v` or `b` stands in the file for a second time. Keep one.
    Repeated {
        /// Which of the two.
        keyword: &'static str,
    },
    /// The file has no `v`. Say where the camera is.
    NoView,
    /// An object stands before the first material. Put an `f` in front of it.
    NoMaterial,
    /// The file has more materials than a scene can hold. Use the same `f` for several objects.
    TooManyMaterials {
        /// How many a scene can hold.
        most: usize,
    },
}

impl fmt::Display for NffError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.fault)
    }
}

impl fmt::Display for NffFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotUtf8 => f.write_str("not a text file; convert it to UTF-8"),
            Self::Expected { expected, found } => {
                write!(f, "expected {expected}, found `{}`", Excerpt(found))
            }
            Self::EndOfFile { expected } => write!(f, "the file ends where {expected} must follow"),
            Self::NotFinite { meaning, found } => {
                write!(f, "{meaning} is not a finite number: `{}`", Excerpt(found))
            }
            Self::UnknownKeyword { found } => {
                write!(f, "unknown keyword `{}`; there are v, b, l, f, s, c, p and pp", Excerpt(found))
            }
            Self::Repeated { keyword } => write!(f, "a second `{keyword}`; keep one"),
            Self::NoView => f.write_str("the file has no `v`; say where the camera is"),
            Self::NoMaterial => f.write_str("an object before the first material; put an `f` in front of it"),
            Self::TooManyMaterials { most } => {
                write!(f, "more than {most} materials; use the same `f` for several objects")
            }
        }
    }
}

impl core::error::Error for NffError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.fault)
    }
}

impl core::error::Error for NffFault {}

/// A word from the file, so that it fits in a line of a terminal and does nothing to it.
pub(crate) struct Excerpt<'a>(pub(crate) &'a str);

impl fmt::Display for Excerpt<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const LONGEST: usize = 32;
        let mut characters = self.0.chars();
        for character in characters.by_ref().take(LONGEST) {
            write!(f, "{}", character.escape_debug())?;
        }
        if characters.next().is_some() { f.write_str("…") } else { Ok(()) }
    }
}
