//! What can be wrong with a glTF file.

use core::fmt;
use std::path::PathBuf;

use crate::nff::Excerpt;

/// A glTF file was refused: which part of it, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct GltfError {
    /// The file.
    pub path: PathBuf,
    /// The part, from the outside inward, as in ``mesh 3 `Door`, primitive 0``; empty where the file is wrong as a whole.
    pub place: String,
    /// What is wrong there, and what to do.
    pub fault: GltfFault,
}

/// Why a file was refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum GltfFault {
    /// The system cannot read a file, for this reason. Mend it.
    Unreadable(String),
    /// The JSON is broken, or says what glTF does not know. Mend it where the reason says.
    Json(String),
    /// The file is of another version than 2. Export it again as glTF 2.0.
    Version(String),
    /// A part of the file says to be longer than what is there. Copy the file again.
    Truncated {
        /// How many bytes it says.
        needed: u64,
        /// How many are there.
        given: u64,
    },
    /// A binary file does not begin with its JSON. Export it again.
    NoJson,
    /// The file cannot be read without this extension. Export it without.
    Extension(String),
    /// There is no part of this number. Name one that there is.
    Unknown {
        /// What kind of part.
        what: &'static str,
        /// What was named.
        named: usize,
        /// How many there are, counted from 0.
        count: usize,
    },
    /// A file that is named lies elsewhere than in the folder of this one or below. Put it there.
    Outside(String),
    /// Bytes inside of the file are not in base64. Export it again.
    NotBase64(String),
    /// A buffer has no bytes: it names no file, and is not the first of a binary file. Give it some.
    NoBytes,
    /// There are fewer bytes than a part takes. Export the file again, or correct the numbers.
    Short {
        /// How many it takes.
        needed: u64,
        /// How many there are.
        given: u64,
    },
    /// Something of another kind must stand here. Export the file again.
    Kind {
        /// What must.
        expected: &'static str,
        /// What does.
        found: String,
    },
    /// A number is NaN, infinite, or out of the range that it may be in. Replace it.
    Number {
        /// What the number stands for.
        meaning: &'static str,
        /// The number.
        found: f64,
    },
    /// A node is in the scene twice: as a child of two nodes, or of itself. Make it two.
    Repeated,
    /// There are more of these than are read. Use fewer.
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many are read.
        most: usize,
    },
    /// The scene has no triangle that has an area. Is it the right file?
    NoFaces,
}

/// What is wrong in a part of the file at hand.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wrong {
    pub(super) place: String,
    pub(super) fault: GltfFault,
}

impl From<GltfFault> for Wrong {
    fn from(fault: GltfFault) -> Self {
        Self { place: String::new(), fault }
    }
}

/// Says where in the file something is wrong.
pub(super) trait At<T> {
    /// The same, inside of this part.
    fn at(self, place: impl FnOnce() -> String) -> Result<T, Wrong>;
}

impl<T, E: Into<Wrong>> At<T> for Result<T, E> {
    fn at(self, place: impl FnOnce() -> String) -> Result<T, Wrong> {
        self.map_err(|error| {
            let Wrong { place: inner, fault } = error.into();
            let outer = place();
            Wrong { place: if inner.is_empty() { outer } else { format!("{outer}, {inner}") }, fault }
        })
    }
}

/// What to call a part of the file.
pub(super) fn name(kind: &str, index: usize, name: Option<&String>) -> String {
    match name {
        Some(name) if !name.is_empty() => format!("{kind} {index} `{}`", Excerpt(name)),
        _ => format!("{kind} {index}"),
    }
}

/// The part of this number, of which there are so many.
pub(super) fn find<'f, T>(parts: &'f [T], what: &'static str, named: usize) -> Result<&'f T, GltfFault> {
    parts.get(named).ok_or(GltfFault::Unknown { what, named, count: parts.len() })
}

impl fmt::Display for GltfError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.fault, &*self.place) {
            (GltfFault::Unreadable(reason), "") => {
                write!(f, "cannot read {}: {reason}", self.path.display())
            }
            (fault, "") => write!(f, "{}: {fault}", self.path.display()),
            (fault, place) => write!(f, "{}: {place}: {fault}", self.path.display()),
        }
    }
}

impl fmt::Display for GltfFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(reason) => f.write_str(reason),
            Self::Json(reason) => write!(f, "{reason}; mend the file"),
            Self::Version(version) => {
                write!(f, "it is of version `{}`; export it again as glTF 2.0", Excerpt(version))
            }
            Self::Truncated { needed, given } => {
                write!(f, "it should have {needed} bytes, and {given} are there; copy the file again")
            }
            Self::NoJson => f.write_str("it does not begin with its JSON; export the file again"),
            Self::Extension(name) => {
                write!(
                    f,
                    "it needs the extension `{}`, which is not known here; export it without",
                    Excerpt(name)
                )
            }
            Self::Unknown { what, named, count } => {
                write!(f, "there is no {what} {named}: there are {count}, counted from 0; name another")
            }
            Self::Outside(uri) => write!(
                f,
                "`{}` is not in the folder of the file or below it, and nothing is read from elsewhere; put it there",
                Excerpt(uri)
            ),
            Self::NotBase64(reason) => {
                write!(f, "its bytes are not in base64: {reason}; export the file again")
            }
            Self::NoBytes => {
                f.write_str("it has no bytes: there is no `uri`, and no binary part of the file for it")
            }
            Self::Short { needed, given } => {
                write!(f, "it takes {needed} bytes, and there are {given}; export the file again")
            }
            Self::Kind { expected, found } => write!(f, "expected {expected}, found {found}"),
            Self::Number { meaning, found } => write!(f, "{meaning} must not be {found}; replace it"),
            Self::Repeated => {
                f.write_str("it is there twice: as a child of two nodes, or of itself; make two nodes of it")
            }
            Self::TooMany { what, most } => write!(f, "more than {most} {what}; use fewer"),
            Self::NoFaces => f.write_str("the scene has no triangle that has an area; is it the right file?"),
        }
    }
}

impl core::error::Error for GltfError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.fault)
    }
}

impl core::error::Error for GltfFault {}
