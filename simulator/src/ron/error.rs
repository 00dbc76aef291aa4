//! What can be wrong with a file, and where.

use core::fmt;
use std::io;
use std::path::PathBuf;

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
                Self::unknown(&of("field", outer), &found, expected)
            }
            error => Self::Syntax(error),
        });
        (error.span.start.into(), fault)
    }
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
