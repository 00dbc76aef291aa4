//! What can be wrong with an OBJ file or an MTL file.

use core::fmt;
use std::path::{Path, PathBuf};

use crate::nff::Excerpt;

/// An OBJ file, or an MTL file that it names, was refused: which, in which line, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjError {
    /// The file.
    pub path: PathBuf,
    /// The line, counted from 1; `None` where the file is wrong as a whole.
    pub line: Option<usize>,
    /// What is wrong there, and what to do.
    pub fault: ObjFault,
}

/// Why a file was refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ObjFault {
    /// The system cannot read the file, for this reason. Mend it.
    Unreadable(String),
    /// The file is not text. Convert it to UTF-8 or plain ASCII.
    NotUtf8,
    /// Something else, or nothing, stands where a number or a name must be. Write what is expected.
    Expected {
        /// What must stand there.
        expected: &'static str,
        /// What stands there; empty at the end of the line.
        found: String,
    },
    /// A number is NaN, infinite, or farther than a scene may reach. Replace it.
    OutOfRange {
        /// What the number stands for.
        meaning: &'static str,
        /// How it is written.
        found: String,
    },
    /// A face names a vertex, a texture coordinate or a normal that no line before it defines. Define it or name another.
    Unknown {
        /// Which of these it is.
        what: &'static str,
        /// How it is written.
        found: String,
        /// How many there are so far.
        count: usize,
    },
    /// A face has fewer than three corners. Remove it or add corners.
    FewCorners {
        /// How many it has.
        given: usize,
    },
    /// A line of an MTL file says something of a material before the first `newmtl`. Name the material first.
    NoMaterial,
    /// The file has no face that has an area. Is it an OBJ file?
    NoFaces,
    /// The files have more materials than a scene can hold. Use fewer.
    TooManyMaterials {
        /// How many there are.
        given: usize,
        /// How many a scene can hold.
        most: usize,
    },
    /// `tobj` refuses the file, for this reason. Mend what it says.
    Refused(tobj::LoadError),
}

/// What is wrong in a line of the file at hand.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LineError {
    pub(super) line: usize,
    pub(super) fault: ObjFault,
}

impl LineError {
    /// The same, of this file.
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
            Self::NotUtf8 => f.write_str("not a text file; convert it to UTF-8"),
            Self::Expected { expected, found } if found.is_empty() => {
                write!(f, "the line ends where {expected} must follow")
            }
            Self::Expected { expected, found } => {
                write!(f, "expected {expected}, found `{}`", Excerpt(found))
            }
            Self::OutOfRange { meaning, found } => {
                write!(f, "{meaning} is not a number within ±1e6: `{}`; replace it", Excerpt(found))
            }
            Self::Unknown { what, found, count } => {
                write!(
                    f,
                    "there is no {what} `{}`: there are {count} so far, counted from 1; define it or name another",
                    Excerpt(found)
                )
            }
            Self::FewCorners { given } => {
                write!(f, "a face of {given} corners; remove it or give it three or more")
            }
            Self::NoMaterial => f.write_str("there is no `newmtl` yet; name the material first"),
            Self::NoFaces => f.write_str("the file has no face that has an area; is it an OBJ file?"),
            Self::TooManyMaterials { given, most } => {
                write!(f, "{given} materials are too many; use at most {most}")
            }
            Self::Refused(reason) => write!(f, "{reason}; mend the file"),
        }
    }
}

impl core::error::Error for ObjError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.fault)
    }
}

impl core::error::Error for ObjFault {}
