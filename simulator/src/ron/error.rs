//! What can be wrong with a file, and where.

use core::fmt;
use std::io;
use std::path::PathBuf;

use rayline::read::Fields;
use rayline::shape::Mesh;
use rayline::{Image, Material};
use ron::error::SpannedError;

use crate::nearest::{DidYouMean, nearest};

/// A place in a file, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// The line.
    pub line: usize,
    /// The character in it.
    pub column: usize,
}

impl From<ron::error::Position> for Position {
    fn from(position: ron::error::Position) -> Self {
        Self { line: position.line, column: position.col }
    }
}

/// Why a file is no scene.
#[derive(Debug)]
pub struct RonError {
    /// The file.
    pub path: PathBuf,
    /// Where in it.
    pub position: Option<Position>,
    /// What is wrong there.
    pub fault: Box<RonFault>,
}

/// What is wrong with a file.
#[derive(Debug)]
#[non_exhaustive]
pub enum RonFault {
    /// The system cannot read it. Mend what it says.
    Read(io::Error),
    /// It is no text, or one in another encoding. Convert it to UTF-8.
    NotUtf8,
    /// The text is not what was expected there. Mend it.
    Syntax(ron::Error),
    /// There is no such thing. Name one that there is.
    UnknownName {
        /// What kind of thing.
        what: String,
        /// What it was called.
        name: String,
        /// What there is: the one with a name that is alike, or all.
        known: Vec<String>,
    },
    /// A field is not there that has no usual value. Add it.
    MissingField {
        /// What it is to be in, if that is known.
        what: Option<String>,
        /// The field.
        field: &'static str,
    },
    /// A field is there twice. Leave one out.
    SameField {
        /// The field.
        field: &'static str,
    },
    /// An object names a preset, which the file's own list of materials does not have. Name it there first.
    PresetInObject {
        /// The preset.
        name: String,
    },
    /// What a name stands for cannot be read. Mend what it says.
    Named {
        /// What it was called.
        name: String,
        /// Why.
        reason: String,
    },
    /// Two have the same name. Rename one.
    SameName {
        /// The name.
        name: String,
    },
}

impl RonFault {
    /// There is no such thing, but there are these.
    pub(super) fn unknown(what: &str, name: &str, names: &[&str]) -> Self {
        let nearest = nearest(name, names.iter().copied());
        let known = nearest.as_ref().map_or(names, core::slice::from_ref);
        Self::UnknownName {
            what: what.to_owned(),
            name: name.to_owned(),
            known: known.iter().map(|name| (*name).to_owned()).collect(),
        }
    }

    /// What a format's error says, unless the reason is known better.
    pub(super) fn from_ron(error: SpannedError, known: Option<Self>) -> (Position, Self) {
        let of = |kind: &str, outer: Option<String>| match outer {
            Some(outer) => format!("{kind} of {outer}"),
            None => kind.to_owned(),
        };
        let fault = known.unwrap_or_else(|| match error.code {
            ron::Error::NoSuchEnumVariant { expected, found, outer } => {
                Self::unknown(&of("variant", outer), &found, expected)
            }
            ron::Error::NoSuchStructField { expected, found, outer } => {
                let outer = named_in_place_of(expected).map(str::to_owned).or(outer);
                Self::unknown(&of("field", outer), &found, expected)
            }
            ron::Error::MissingStructField { field, outer } => Self::MissingField { what: outer, field },
            // It may name what the struct is in, as above; here its place in the file tells enough.
            ron::Error::DuplicateStructField { field, .. } => Self::SameField { field },
            error => Self::Syntax(error),
        });
        (error.span.start.into(), fault)
    }
}

/// The struct with these fields, if it is one that a name may stand in place of: as it is read as whatever comes, its format does
/// not know what it is, and takes its fields for those of what it is in.
fn named_in_place_of(fields: &[&str]) -> Option<&'static str> {
    fn name_and_fields<T: Fields<'static>>() -> (&'static str, &'static [&'static str]) {
        (T::NAME, T::FIELDS)
    }
    let known =
        [name_and_fields::<Material<'_>>(), name_and_fields::<Mesh<'_>>(), name_and_fields::<Image<'_>>()];
    known.into_iter().find(|(_, known)| *known == fields).map(|(name, _)| name)
}

impl fmt::Display for RonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.display();
        match (&*self.fault, self.position) {
            (RonFault::Read(error), _) => write!(f, "cannot read {path}: {error}"),
            (fault, Some(Position { line, column })) => write!(f, "{path}:{line}:{column}: {fault}"),
            (fault, None) => write!(f, "{path}: {fault}"),
        }
    }
}

impl fmt::Display for RonFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => error.fmt(f),
            Self::NotUtf8 => f.write_str("not a text file; convert it to UTF-8"),
            Self::Syntax(error) => error.fmt(f),
            Self::UnknownName { what, name, known } => {
                write!(f, "there is no {what} `{}`", name.escape_debug())?;
                match &**known {
                    [] => Ok(()),
                    [nearest] => DidYouMean(Some(nearest)).fmt(f),
                    known => write!(f, "; there are `{}`", known.join("`, `")),
                }
            }
            Self::MissingField { what: Some(what), field } => {
                write!(f, "the field `{field}` of {what} is missing; add it")
            }
            Self::MissingField { what: None, field } => write!(f, "the field `{field}` is missing; add it"),
            Self::SameField { field } => write!(f, "the field `{field}` is there twice; leave one out"),
            Self::PresetInObject { name } => write!(
                f,
                "there is no material in this file `{name}`; it is a preset: name it in `materials` first, as in `\"{name}\": \"{name}\"`"
            ),
            Self::Named { name, reason } => write!(f, "`{}`: {reason}", name.escape_debug()),
            Self::SameName { name } => write!(f, "two are called `{}`; rename one", name.escape_debug()),
        }
    }
}

impl core::error::Error for RonError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match &*self.fault {
            RonFault::Read(error) => Some(error),
            RonFault::Syntax(error) => Some(error),
            _ => None,
        }
    }
}
