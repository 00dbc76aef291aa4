//! Errors of glTF files.

use core::fmt;
use std::path::PathBuf;

use crate::nff::Excerpt;

/// The error of a glTF file, with the part that is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct GltfError {
    /// The file.
    pub path: PathBuf,
    /// The part, from the outside inward, as in ``mesh 3 `Door`, primitive 0``; empty for an error of the
    /// whole file.
    pub place: String,
    /// The fault of that part.
    pub fault: GltfFault,
}

/// The fault of a glTF file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum GltfFault {
    /// The system cannot read a file, for this reason.
    Unreadable(String),
    /// The JSON is broken, or is not that of a glTF file. Correct it at the position in the reason.
    Json(String),
    /// The version of the file is not 2. Export it again as glTF 2.0.
    Version(String),
    /// The file is shorter than its own length fields. Copy it again.
    Truncated {
        /// The bytes by the length field.
        needed: u64,
        /// The bytes in the file.
        given: u64,
    },
    /// A binary file does not begin with its JSON. Export it again.
    NoJson,
    /// The file requires this extension, which is not supported. Export it without the extension.
    Extension(String),
    /// The file refers to a part that it does not have. Correct the number.
    Unknown {
        /// The kind of the part.
        what: &'static str,
        /// The number of the part.
        named: usize,
        /// How many parts of this kind there are, counted from 0.
        count: usize,
    },
    /// The file refers to a file that is not in its own folder or below. Move that file there.
    Outside(String),
    /// The bytes of a `data:` URI are not in base64. Export the file again.
    NotBase64(String),
    /// A buffer has no bytes: it has no URI, and is not the first buffer of a binary file. Add its bytes.
    NoBytes,
    /// A part takes more bytes than there are. Export the file again, or correct the numbers.
    Short {
        /// The bytes that the part takes.
        needed: u64,
        /// The bytes that there are.
        given: u64,
    },
    /// A part has the wrong kind. Export the file again.
    Kind {
        /// The expected kind.
        expected: &'static str,
        /// The kind in the file.
        found: String,
    },
    /// A number is NaN, infinite, or out of its range. Replace it.
    Number {
        /// The meaning of the number.
        meaning: &'static str,
        /// The number.
        found: f64,
    },
    /// A node is in the scene twice: as a child of two nodes, or of itself. Make two nodes of it.
    Repeated,
    /// The file has more parts of a kind than the importer reads. Use fewer.
    TooMany {
        /// The kind of the parts.
        what: &'static str,
        /// The most parts that are read.
        most: usize,
    },
    /// The scene has no triangle with an area. Check that it is the right file.
    NoFaces,
}

/// A fault with the part that is wrong. The caller adds the path of the file.
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

/// Adds the part of the file to an error.
pub(super) trait At<T> {
    /// The error, inside of this part.
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

/// The name of a part of the file in messages.
pub(super) fn name(kind: &str, index: usize, name: Option<&String>) -> String {
    match name {
        Some(name) if !name.is_empty() => format!("{kind} {index} `{}`", Excerpt(name)),
        _ => format!("{kind} {index}"),
    }
}

/// The part of this number, or [`GltfFault::Unknown`].
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
            Self::Json(reason) => write!(f, "{reason}; correct the file"),
            Self::Version(version) => {
                write!(f, "its version is `{}`; export it again as glTF 2.0", Excerpt(version))
            }
            Self::Truncated { needed, given } => {
                write!(f, "it should have {needed} bytes, but has {given}; copy the file again")
            }
            Self::NoJson => f.write_str("it does not begin with its JSON; export the file again"),
            Self::Extension(name) => {
                write!(
                    f,
                    "it needs the extension `{}`, which is not supported; export it without",
                    Excerpt(name)
                )
            }
            Self::Unknown { what, named, count } => {
                write!(f, "there is no {what} {named}: there are {count}, counted from 0; correct the number")
            }
            Self::Outside(uri) => {
                write!(
                    f,
                    "`{}` is not in the folder of the file or below it; move it there, or use \
                     --allow-paths",
                    Excerpt(uri)
                )
            }
            Self::NotBase64(reason) => {
                write!(f, "its bytes are not in base64: {reason}; export the file again")
            }
            Self::NoBytes => {
                f.write_str("it has no bytes: there is no `uri` and no binary chunk for it; add one")
            }
            Self::Short { needed, given } => {
                write!(f, "it takes {needed} bytes, but there are {given}; export the file again")
            }
            Self::Kind { expected, found } => write!(f, "expected {expected}, found {found}"),
            Self::Number { meaning, found } => write!(f, "{meaning} must not be {found}; replace it"),
            Self::Repeated => f.write_str(
                "it is in the scene twice: as a child of two nodes, or of itself; make two nodes of it",
            ),
            Self::TooMany { what, most } => write!(f, "more than {most} {what}; use fewer"),
            Self::NoFaces => {
                f.write_str("the scene has no triangle with an area; check that it is the right file")
            }
        }
    }
}

impl core::error::Error for GltfError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.fault)
    }
}

impl core::error::Error for GltfFault {}
