//! Errors of RON files, with their positions.

use core::fmt;
use std::io;
use std::path::{Path, PathBuf};

use rayline::read::Fields;
use rayline::shape::Mesh;
use rayline::{Image, Material};
use rayline_formats::nearest::{DidYouMean, nearest};
use ron::error::SpannedError;

/// A position in a file, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// The line.
    pub line: usize,
    /// The character in the line.
    pub column: usize,
}

impl From<ron::error::Position> for Position {
    fn from(position: ron::error::Position) -> Self {
        Self { line: position.line, column: position.col }
    }
}

/// The error of a RON file.
#[derive(Debug)]
pub struct RonError {
    /// The file.
    pub path: PathBuf,
    /// The position in the file, if it is known.
    pub position: Option<Position>,
    /// The fault there.
    pub fault: Box<RonFault>,
}

impl RonError {
    pub(super) fn new(path: &Path, position: Option<Position>, fault: RonFault) -> Self {
        Self { path: path.to_owned(), position, fault: Box::new(fault) }
    }
}

/// The most levels of parentheses, brackets and braces.
pub(super) const MOST_LEVELS: usize = 128;

/// The fault of a RON file.
#[derive(Debug)]
#[non_exhaustive]
pub enum RonFault {
    /// The system cannot read the file. Its text says why.
    Read(io::Error),
    /// The file is not text in UTF-8. Convert it.
    NotUtf8,
    /// The text breaks the grammar there. Correct it.
    Syntax(ron::Error),
    /// Parentheses, brackets and braces are nested too deeply there. A scene needs about a dozen levels:
    /// remove the others.
    TooDeep {
        /// The most levels.
        most: usize,
    },
    /// A name is unknown. Use a known one.
    UnknownName {
        /// The kind of the named item.
        what: String,
        /// The unknown name.
        name: String,
        /// The known name that is most similar, or all known names.
        known: Vec<String>,
    },
    /// A field without a default is missing. Add it.
    MissingField {
        /// The type that the field belongs to, if it is known.
        what: Option<String>,
        /// The field.
        field: &'static str,
    },
    /// A field is given twice. Remove one.
    SameField {
        /// The field.
        field: &'static str,
    },
    /// An object refers to a preset that is not in the file's list of materials. Add it to that list.
    PresetInObject {
        /// The name of the preset.
        name: String,
    },
    /// The item that a name stands for cannot be read. The reason says why.
    Named {
        /// The name.
        name: String,
        /// The reason.
        reason: String,
    },
    /// Two materials have the same name. Rename one.
    SameName {
        /// The name.
        name: String,
    },
}

impl RonFault {
    /// The fault of an unknown name, with the most similar known name, or all of them.
    pub(super) fn unknown(what: &str, name: &str, names: &[&str]) -> Self {
        let nearest = nearest(name, names.iter().copied());
        let known = nearest.as_ref().map_or(names, core::slice::from_ref);
        Self::UnknownName {
            what: what.to_owned(),
            name: name.to_owned(),
            known: known.iter().map(|name| (*name).to_owned()).collect(),
        }
    }

    /// Converts an error of the format, unless a more exact fault is `known`.
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
            // The format may report the outer type instead, as above; the position is enough here.
            ron::Error::DuplicateStructField { field, .. } => Self::SameField { field },
            ron::Error::ExceededRecursionLimit => Self::TooDeep { most: MOST_LEVELS },
            error => Self::Syntax(error),
        });
        (error.span.start.into(), fault)
    }
}

/// The struct with these fields, if it may be replaced by a name. Such a struct is read by `deserialize_any`,
/// so that the format reports the outer struct in place of it.
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
            Self::TooDeep { most } => write!(
                f,
                "parentheses, brackets and braces are nested more than {most} deep; remove some, a scene \
                 needs about a dozen"
            ),
            Self::UnknownName { what, name, known } => {
                write!(f, "there is no {what} `{}`", name.escape_debug())?;
                match &**known {
                    [] => Ok(()),
                    [nearest] => DidYouMean(Some(nearest)).fmt(f),
                    known => write!(f, "; the known ones are `{}`", known.join("`, `")),
                }
            }
            Self::MissingField { what: Some(what), field } => {
                write!(f, "the field `{field}` of {what} is missing; add it")
            }
            Self::MissingField { what: None, field } => write!(f, "the field `{field}` is missing; add it"),
            Self::SameField { field } => write!(f, "the field `{field}` is given twice; remove one"),
            Self::PresetInObject { name } => write!(
                f,
                "there is no material in this file `{name}`; it is a preset: add it to `materials`, as in \
                 `\"{name}\": \"{name}\"`"
            ),
            Self::Named { name, reason } => write!(f, "`{}`: {reason}", name.escape_debug()),
            Self::SameName { name } => {
                write!(f, "two materials have the name `{}`; rename one", name.escape_debug())
            }
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
