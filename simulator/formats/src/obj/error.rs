//! Errors of OBJ and MTL files.

use core::fmt;
use std::path::{Path, PathBuf};

use crate::nff::Excerpt;

/// The error of an OBJ file or of an MTL file that it refers to, with the file and the line.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjError {
    /// The file.
    pub path: PathBuf,
    /// The line, counted from 1; `None` for an error of the whole file.
    pub line: Option<usize>,
    /// The fault there.
    pub fault: ObjFault,
}

/// The fault of a file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ObjFault {
    /// The system cannot read the file, for this reason.
    Unreadable(String),
    /// A word is not the expected number or name, or is missing. Write the expected one.
    Expected {
        /// The expected number or name.
        expected: &'static str,
        /// The word in the file; empty at the end of the line.
        found: String,
    },
    /// A number is beyond ±1e30. Replace it.
    OutOfRange {
        /// The meaning of the number.
        meaning: &'static str,
        /// The text in the file.
        found: String,
    },
    /// A face refers to a vertex that the file does not define. Define it or correct the number.
    Unknown {
        /// The number in the file: from 1, or a negative one that counts back.
        found: String,
        /// The number of vertices in the file; for a negative number, up to this line.
        count: usize,
    },
    /// The file has no face with an area. Check that it is an OBJ file.
    NoFaces,
    /// The files have more materials than a scene can hold. Use fewer.
    TooManyMaterials {
        /// The number of materials in the files.
        given: usize,
        /// The most materials of a scene.
        most: usize,
    },
}

/// A fault with its line. The caller adds the path of the file.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LineError {
    pub(super) line: usize,
    pub(super) fault: ObjFault,
}

impl LineError {
    /// The error with the path of the file.
    pub(super) fn of(self, path: &Path) -> ObjError {
        ObjError { path: path.to_owned(), line: Some(self.line), fault: self.fault }
    }
}

impl fmt::Display for ObjError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let ObjFault::Unreadable(reason) = &self.fault {
            return write!(f, "cannot read {}: {reason}", self.path.display());
        }
        write!(f, "{}:", self.path.display())?;
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        write!(f, " {}", self.fault)
    }
}

impl fmt::Display for ObjFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(reason) => f.write_str(reason),
            Self::Expected { expected, found } if found.is_empty() => {
                write!(f, "the line ends where {expected} must follow")
            }
            Self::Expected { expected, found } => {
                write!(f, "expected {expected}, found `{}`", Excerpt(found))
            }
            Self::OutOfRange { meaning, found } => {
                write!(f, "{meaning} is beyond ±1e30: `{}`; replace it", Excerpt(found))
            }
            Self::Unknown { found, count } => {
                write!(
                    f,
                    "there is no vertex `{}`: there are {count}, counted from 1; define it or correct the \
                     number",
                    Excerpt(found)
                )
            }
            Self::NoFaces => f.write_str("the file has no face with an area; check that it is an OBJ file"),
            Self::TooManyMaterials { given, most } => {
                write!(f, "the files have {given} materials; use at most {most}")
            }
        }
    }
}

impl core::error::Error for ObjError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.fault)
    }
}

impl core::error::Error for ObjFault {}
