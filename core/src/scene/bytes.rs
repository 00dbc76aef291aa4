//! Scenes as bytes, for flash: a mark, a version, a hash of the set of shapes, and what postcard makes of the description.
//!
//! Postcard's format is that of a specification of its own (<https://postcard.jamesmunns.com/>): numbers of few bits take few bytes, there
//! are no names, and what a [`Sphere`](crate::shape::Sphere) holds is 16 bytes.

use core::fmt;
use core::mem::MaybeUninit;

use serde::Serialize;

use super::{Scene, SceneBuf};
use crate::fault::Fault;
use crate::read::{Read, Reader};
use crate::shape::Geometry;

/// What every scene's bytes begin with.
const MARK: [u8; 4] = *b"RAYL";

/// Goes up with every change of what the bytes mean.
const VERSION: u8 = 2;

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
    /// They were written with another set of shapes, or in another order. Read them with that; what `rayline convert` writes is for
    /// [`Shape`](crate::shape::Shape).
    OtherSet,
    /// The scene goes on after their end. Look whether all of the file was taken.
    Cut,
    /// They stand for nothing that a scene could hold. Write the scene again.
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
            Self::OtherSet => {
                "the bytes are of another set of shapes; read them with the one that wrote them"
            }
            Self::Cut => "the bytes end before the scene does",
            Self::Broken => "the bytes hold what no scene does; write the scene again",
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

impl<S: Geometry + Serialize> Scene<'_, S> {
    /// Writes the scene as bytes, and tells which of `room` they are.
    ///
    /// # Errors
    /// [`BytesError::NoRoom`]
    pub fn to_bytes<'b>(&self, room: &'b mut [u8]) -> Result<&'b mut [u8], BytesError> {
        postcard::to_slice(&(MARK, VERSION, hash::<S>(), self), room).map_err(|_| BytesError::NoRoom)
    }
}

impl<'a, S: Geometry + Read<'a>> Scene<'a, S> {
    /// The scene that these bytes are, with its lists in `memory`. Bytes of images stay where they are. What follows after the scene
    /// is not looked at.
    ///
    /// A shape is known by its place in the set: `S` is the one that the bytes were written with, or one of the same names in the same
    /// order. What `rayline convert` writes is for [`Shape`](crate::shape::Shape).
    ///
    /// Whether it can be drawn, [`PreparedScene::new`](crate::PreparedScene::new) tells.
    ///
    /// # Errors
    /// A [`BytesError`] that says why they are none.
    pub fn from_bytes(bytes: &'a [u8], memory: &'a mut [MaybeUninit<u8>]) -> Result<Self, BytesError> {
        read::<Self, S>(bytes, memory)
    }
}

impl<'a, S, const OBJECTS: usize, const MATERIALS: usize, const LIGHTS: usize>
    SceneBuf<'a, S, OBJECTS, MATERIALS, LIGHTS>
where
    S: Geometry + Read<'a>,
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
        read::<Self, S>(bytes, memory)
    }
}

/// The names of a set's shapes: two sets of the same shapes in the same order have the same. Fowler, Noll and Vo's hash, FNV-1a.
const fn hash<S: Geometry>() -> [u8; 4] {
    let mut hash = 0x811c_9dc5_u32;
    let mut names = S::NAMES;
    while let Some((name, others)) = names.split_first() {
        let mut bytes = name.as_bytes();
        while let Some((byte, rest)) = bytes.split_first() {
            hash = (hash ^ *byte as u32).wrapping_mul(0x0100_0193);
            bytes = rest;
        }
        // What ends a name is in none.
        hash = hash.wrapping_mul(0x0100_0193);
        names = others;
    }
    hash.to_le_bytes()
}

/// Reads a scene of shapes of the set `S`, or what else is written as one.
fn read<'a, T: Read<'a>, S: Geometry>(
    bytes: &'a [u8],
    memory: &'a mut [MaybeUninit<u8>],
) -> Result<T, BytesError> {
    let after_mark = bytes.strip_prefix(&MARK).ok_or(BytesError::NotAScene)?;
    let (&found, scene) = after_mark.split_first().ok_or(BytesError::Cut)?;
    if found != VERSION {
        return Err(BytesError::Version { found, known: VERSION });
    }
    let (set, scene) = scene.split_first_chunk().ok_or(BytesError::Cut)?;
    if *set != hash::<S>() {
        return Err(BytesError::OtherSet);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtin::CLASSIC;
    use crate::shape::{Plane, Shape, Sphere};

    crate::shape_set! {
        enum Few;
        enum PreparedFew {
            Sphere(Sphere),
            Plane(Plane),
        }
    }

    crate::shape_set! {
        enum Turned;
        enum PreparedTurned {
            Plane(Plane),
            Sphere(Sphere),
        }
    }

    #[test]
    fn a_scene_is_read_with_the_set_that_wrote_it() {
        let (mut room, mut memory) = ([0; 2048], [MaybeUninit::uninit(); 2048]);
        let bytes = CLASSIC.to_bytes(&mut room).unwrap();
        assert_eq!(Scene::<Few>::from_bytes(bytes, &mut memory), Err(BytesError::OtherSet));
        assert_eq!(Scene::<Sphere>::from_bytes(bytes, &mut memory), Err(BytesError::OtherSet));
        assert_eq!(Scene::<Shape<'_>>::from_bytes(bytes, &mut memory), Ok(CLASSIC));

        let ball = Sphere::new(crate::Vec3::ZERO, 1.0);
        let objects = [crate::Object::new(Few::Sphere(ball), 0)];
        let few = Scene {
            objects: &objects,
            camera: CLASSIC.camera,
            background: CLASSIC.background,
            materials: CLASSIC.materials,
            lights: CLASSIC.lights,
        };
        let bytes = few.to_bytes(&mut room).unwrap();
        assert_eq!(Scene::<Turned>::from_bytes(bytes, &mut memory), Err(BytesError::OtherSet));
        assert_eq!(Scene::<Few>::from_bytes(bytes, &mut memory), Ok(few));
    }

    #[test]
    fn what_is_in_front_is_checked_first() {
        let (mut room, mut memory) = ([0; 2048], [MaybeUninit::uninit(); 2048]);
        let bytes = CLASSIC.to_bytes(&mut room).unwrap();
        let mut read = |bytes: &[u8]| Scene::<Shape<'_>>::from_bytes(bytes, &mut memory).err();
        assert_eq!(read(b"RIFF"), Some(BytesError::NotAScene));
        assert_eq!(read(b"RAYL\x01"), Some(BytesError::Version { found: 1, known: VERSION }));
        assert_eq!(read(&bytes[..7]), Some(BytesError::Cut));
        assert_eq!(read(&bytes[..bytes.len() - 1]), Some(BytesError::Cut));
    }
}
