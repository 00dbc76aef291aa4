//! Errors of NFF files.

use core::fmt;

/// The error of an NFF file, with its line.
#[derive(Clone, Debug, PartialEq)]
pub struct NffError {
    /// The line, counted from 1; the last line of the file if a part is missing.
    pub line: usize,
    /// The fault in that line.
    pub fault: NffFault,
}

/// The fault of an NFF file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NffFault {
    /// The file is not text. Convert it to UTF-8 or plain ASCII.
    NotUtf8,
    /// A word is not the expected number or keyword. Write the expected one.
    Expected {
        /// The expected number or keyword.
        expected: &'static str,
        /// The word in the file.
        found: String,
    },
    /// The file ends in the middle of a statement. Complete it.
    EndOfFile {
        /// The number or keyword that must follow.
        expected: &'static str,
    },
    /// A number is NaN, infinite or too large for an `f32`. Replace it.
    NotFinite {
        /// The meaning of the number.
        meaning: &'static str,
        /// The number as it is written in the file.
        found: String,
    },
    /// No statement begins with this word. Use a statement of the format.
    UnknownKeyword {
        /// The word.
        found: String,
    },
    /// The file has a second `v` or `b`. Keep one.
    Repeated {
        /// The keyword, `v` or `b`.
        keyword: &'static str,
    },
    /// The file has neither a `v` nor an object to look at. Add one of them.
    NoView,
    /// The file has more objects than a scene can hold. Use fewer.
    TooManyObjects {
        /// The most objects of a scene.
        most: usize,
    },
    /// The file has more materials than a scene can hold. Use the same `f` for several objects.
    TooManyMaterials {
        /// The most materials of a scene.
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
                write!(f, "unknown keyword `{}`; the keywords are v, b, l, f, s, c, p and pp", Excerpt(found))
            }
            Self::Repeated { keyword } => write!(f, "there is a second `{keyword}`; keep one"),
            Self::NoView => {
                f.write_str("the file has no view (`v`) and no object to look at; add one of them")
            }
            Self::TooManyObjects { most } => write!(f, "the file has more than {most} objects; use fewer"),
            Self::TooManyMaterials { most } => {
                write!(f, "the file has more than {most} materials; use the same `f` for several objects")
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

/// A word from the file for an error message: shortened, and with control characters escaped.
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
