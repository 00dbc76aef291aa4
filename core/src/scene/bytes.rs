//! Scenes as bytes, for flash: a mark, a version, and what postcard makes of the description.
//!
//! Postcard's format is that of a specification of its own (<https://postcard.jamesmunns.com/>): numbers of few bits take few bytes, there
//! are no names, and what a [`Sphere`](crate::shape::Sphere) holds is 16 bytes.

use core::fmt;
use core::mem::MaybeUninit;

use serde::Serialize;

use super::{Scene, SceneBuf};
use crate::fault::Fault;
use crate::read::{Read, Reader};

/// What every scene's bytes begin with.
const MARK: [u8; 4] = *b"RAYL";

/// Goes up with every change of what the bytes mean.
const VERSION: u8 = 1;

/// Why bytes are no scene, or a scene could not be made bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BytesError {
    /// They do not begin as the bytes of a scene do. Look whether they are those of the right file.
    NotAScene,
    /// They were written by another version of this crate. Write the scene again.
    Version {
        /// That of the bytes.
        found: u8,
        /// The one that this version reads.
        known: u8,
    },
    /// The scene goes on after their end. Look whether all of the file was taken.
    Cut,
    /// They stand for nothing that a scene could hold. Write the scene again, and read it with the set that it was written with.
    Broken,
    /// The memory for lists is too small. Lend more.
    Memory {
        /// Bytes that the first part of the scene needs for which there is no room.
        needed: usize,
        /// Bytes that were lent.
        lent: usize,
    },
    /// A [`SceneBuf`] is full. Raise the number of its objects, materials or lights.
    Full {
        /// There is room for so many.
        room: usize,
    },
    /// The scene takes more bytes than there is room for. Lend more.
    NoRoom,
}

impl fmt::Display for BytesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotAScene => "these are not the bytes of a scene",
            Self::Version { found, known } => {
                return write!(
                    f,
                    "these bytes have version {found}, and {known} is known; write the scene again"
                );
            }
            Self::Cut => "the bytes end before the scene does",
            Self::Broken => "the bytes hold what no scene does; read them with the set that wrote them",
            Self::Memory { needed, lent } => {
                return write!(
                    f,
                    "lists need {needed} bytes of memory or more, and {lent} were lent; lend more"
                );
            }
            Self::Full { room } => {
                return write!(f, "the scene has more than {room} of a kind; raise the capacity");
            }
            Self::NoRoom => "the scene takes more bytes than there is room for",
        })
    }
}

impl core::error::Error for BytesError {}

impl<S: Serialize> Scene<'_, S> {
    /// Writes the scene as bytes, and tells which of `room` they are.
    ///
    /// # Errors
    /// [`BytesError::NoRoom`]
    pub fn to_bytes<'b>(&self, room: &'b mut [u8]) -> Result<&'b mut [u8], BytesError> {
        postcard::to_slice(&(MARK, VERSION, self), room).map_err(|_| BytesError::NoRoom)
    }
}

impl<'a, S: Read<'a> + Copy> Scene<'a, S> {
    /// The scene that these bytes are, with its lists in `memory`. Bytes of images stay where they are. What follows after the scene
    /// is not looked at.
    ///
    /// A shape is known by its place in the set: `S` is the one that the bytes were written with, or one of the same shapes in the same
    /// places. What `rayline convert` writes is for [`Shape`](crate::shape::Shape).
    ///
    /// Whether it can be drawn, [`PreparedScene::new`](crate::PreparedScene::new) tells.
    ///
    /// # Errors
    /// A [`BytesError`] that says why they are none.
    pub fn from_bytes(bytes: &'a [u8], memory: &'a mut [MaybeUninit<u8>]) -> Result<Self, BytesError> {
        read(bytes, memory)
    }
}

impl<'a, S, const OBJECTS: usize, const MATERIALS: usize, const LIGHTS: usize>
    SceneBuf<'a, S, OBJECTS, MATERIALS, LIGHTS>
where
    S: Read<'a>,
{
    /// The scene that these bytes are, to be changed: what objects and materials refer to is in `memory`. Otherwise as
    /// [`Scene::from_bytes`].
    ///
    /// ```
    /// use rayline::{SceneBuf, Workspace, builtin, shape::Shape};
    /// let mut room = [0; 2048];
    /// let bytes = builtin::CLASSIC.to_bytes(&mut room)?; // on the desktop: `rayline convert classic classic.rayline`
    ///
    /// let mut memory = Workspace::<1024>::new();
    /// let scene = SceneBuf::<Shape, 8, 8, 4>::from_bytes(bytes, memory.lend())?;
    /// assert_eq!(scene.as_scene(), builtin::CLASSIC);
    /// # Ok::<(), rayline::BytesError>(())
    /// ```
    ///
    /// # Errors
    /// A [`BytesError`] that says why they are none.
    pub fn from_bytes(bytes: &'a [u8], memory: &'a mut [MaybeUninit<u8>]) -> Result<Self, BytesError> {
        let () = Self::NUMBERED_BY_U16;
        read(bytes, memory)
    }
}

/// Reads a scene, or what else is written as one.
fn read<'a, T: Read<'a>>(bytes: &'a [u8], memory: &'a mut [MaybeUninit<u8>]) -> Result<T, BytesError> {
    let after_mark = bytes.strip_prefix(&MARK).ok_or(BytesError::NotAScene)?;
    let (&found, scene) = after_mark.split_first().ok_or(BytesError::Cut)?;
    if found != VERSION {
        return Err(BytesError::Version { found, known: VERSION });
    }
    let mut reader = Reader::new(memory);
    T::read(&mut postcard::Deserializer::from_bytes(scene), &mut reader).map_err(|error| {
        match (reader.failure(), error) {
            (Some(Fault::Memory { needed, lent }), _) => BytesError::Memory { needed, lent },
            (Some(Fault::Full { room }), _) => BytesError::Full { room },
            (_, postcard::Error::DeserializeUnexpectedEnd) => BytesError::Cut,
            _ => BytesError::Broken,
        }
    })
}
