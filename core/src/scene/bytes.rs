//! Scenes as bytes, for flash: a mark, a version, a hash of the set of shapes, and the description in
//! postcard's format.
//!
//! Postcard's format has a public specification (<https://postcard.jamesmunns.com/>): small integers take few
//! bytes, names are not stored, and a [`Sphere`](crate::shape::Sphere) takes 16 bytes.

use core::fmt;
use core::mem::MaybeUninit;

use serde::Serialize;

use super::{Scene, SceneBuf};
use crate::fault::Fault;
use crate::read::{Read, Reader};
use crate::shape::Geometry;

/// The first bytes of every scene.
const MARK: [u8; 4] = *b"RAYL";

/// The version of the format, raised with every change of it.
const VERSION: u8 = 6;

/// The reason why bytes are no scene, or why a scene could not be written as bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum BytesError {
    /// The bytes do not begin with the mark of a scene. Check that they come from the right file.
    NotAScene,
    /// The bytes were written in another version of the format. Write the scene again.
    Version {
        /// The version of the bytes.
        found: u8,
        /// The version that this crate reads.
        known: u8,
    },
    /// The bytes were written with another set of shapes, or with its shapes in another order. Read them with
    /// the same set; `rayline convert` writes them with [`Shape`](crate::shape::Shape).
    OtherSet,
    /// The bytes end before the scene does. Check that the file is complete.
    Cut,
    /// The bytes hold a value that no scene has. Write the scene again.
    Broken,
    /// The memory for lists is too small. Lend more.
    Memory {
        /// A lower bound on the bytes needed: up to the first list that did not fit.
        needed: usize,
        /// Bytes that were lent.
        lent: usize,
    },
    /// A [`SceneBuf`] is full. Raise the number of its objects, materials or lights.
    Full {
        /// The capacity of the array, in elements.
        room: usize,
    },
    /// The scene takes more bytes than the buffer holds. Lend a larger one.
    NoRoom,
}

impl fmt::Display for BytesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotAScene => {
                "the bytes do not begin with the mark of a scene; check that they come from the right file"
            }
            Self::Version { found, known } => {
                return write!(
                    f,
                    "the bytes have version {found}, but this version of rayline reads {known}; write the \
                     scene again"
                );
            }
            Self::OtherSet => "the bytes were written with another set of shapes; read them with that set",
            Self::Cut => "the bytes end before the scene does; check that the file is complete",
            Self::Broken => "the bytes hold a value that no scene has; write the scene again",
            Self::Memory { needed, lent } => {
                return write!(
                    f,
                    "the scene needs at least {needed} bytes of memory for its lists, but {lent} were lent; \
                     lend more"
                );
            }
            Self::Full { room } => {
                return write!(
                    f,
                    "the scene has more objects, materials or lights than the array holds ({room}); raise \
                     its capacity"
                );
            }
            Self::NoRoom => "the scene takes more bytes than the buffer holds; lend a larger one",
        })
    }
}

impl core::error::Error for BytesError {}

impl<S: Geometry + Serialize> Scene<'_, S> {
    /// Writes the scene as bytes to the front of `room`, and returns the part of it that was written.
    ///
    /// # Errors
    /// [`BytesError::NoRoom`]: `room` is too small.
    pub fn to_bytes<'b>(&self, room: &'b mut [u8]) -> Result<&'b mut [u8], BytesError> {
        postcard::to_slice(&(MARK, VERSION, hash::<S>(), self), room).map_err(|_| BytesError::NoRoom)
    }
}

impl<'a, S: Geometry + Read<'a>> Scene<'a, S> {
    /// Reads a scene from bytes and stores its lists in `memory`. Images of bytes stay where they are, in
    /// `bytes`. Bytes after the end of the scene are ignored.
    ///
    /// Shapes are stored by their position in the set. So `S` must be the set that the bytes were written
    /// with, or one with the same names in the same order. `rayline convert` writes the bytes with
    /// [`Shape`](crate::shape::Shape).
    ///
    /// The numbers of the scene are checked later, by [`PreparedScene::new`](crate::PreparedScene::new).
    ///
    /// # Errors
    /// A [`BytesError`]: the bytes are no scene of this set, or the memory is too small.
    pub fn from_bytes(bytes: &'a [u8], memory: &'a mut [MaybeUninit<u8>]) -> Result<Self, BytesError> {
        read::<Self, S>(bytes, memory)
    }
}

impl<'a, S, const OBJECTS: usize, const MATERIALS: usize, const LIGHTS: usize>
    SceneBuf<'a, S, OBJECTS, MATERIALS, LIGHTS>
where
    S: Geometry + Read<'a>,
{
    /// Reads a scene that can be changed from bytes, like [`Scene::from_bytes`]. Lists inside of objects and
    /// materials are stored in `memory`.
    ///
    /// ```
    /// use rayline::{SceneBuf, Workspace, builtin, shape::Shape};
    /// let mut room = [0; 2048];
    /// // On the desktop: `rayline convert classic classic.rayline`.
    /// let bytes = builtin::CLASSIC.to_bytes(&mut room)?;
    ///
    /// let mut memory = Workspace::<1024>::new();
    /// let scene = SceneBuf::<Shape, 8, 8, 4>::from_bytes(bytes, memory.lend())?;
    /// assert_eq!(scene.as_scene(), builtin::CLASSIC);
    /// # Ok::<(), rayline::BytesError>(())
    /// ```
    ///
    /// # Errors
    /// A [`BytesError`]: the bytes are no scene of this set, or the memory is too small.
    pub fn from_bytes(bytes: &'a [u8], memory: &'a mut [MaybeUninit<u8>]) -> Result<Self, BytesError> {
        let () = Self::NUMBERED_BY_U16;
        read::<Self, S>(bytes, memory)
    }
}

/// A hash of the names of a set's shapes, in their order: the hash FNV-1a of Fowler, Noll and Vo.
const fn hash<S: Geometry>() -> [u8; 4] {
    let mut hash = 0x811c_9dc5_u32;
    let mut names = S::NAMES;
    while let Some((name, others)) = names.split_first() {
        let mut bytes = name.as_bytes();
        while let Some((byte, rest)) = bytes.split_first() {
            hash = (hash ^ *byte as u32).wrapping_mul(0x0100_0193);
            bytes = rest;
        }
        // The product with the prime also marks the end of a name, as a byte of 0 would.
        hash = hash.wrapping_mul(0x0100_0193);
        names = others;
    }
    hash.to_le_bytes()
}

/// Reads a [`Scene`] or a [`SceneBuf`] of shapes of the set `S`.
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
            motions: &[],
        };
        let bytes = few.to_bytes(&mut room).unwrap();
        assert_eq!(Scene::<Turned>::from_bytes(bytes, &mut memory), Err(BytesError::OtherSet));
        assert_eq!(Scene::<Few>::from_bytes(bytes, &mut memory), Ok(few));
    }

    #[test]
    fn mark_and_version_are_checked_first() {
        let (mut room, mut memory) = ([0; 2048], [MaybeUninit::uninit(); 2048]);
        let bytes = CLASSIC.to_bytes(&mut room).unwrap();
        let mut read = |bytes: &[u8]| Scene::<Shape<'_>>::from_bytes(bytes, &mut memory).err();
        assert_eq!(read(b"RIFF"), Some(BytesError::NotAScene));
        assert_eq!(read(b"RAYL\x01"), Some(BytesError::Version { found: 1, known: VERSION }));
        assert_eq!(read(&bytes[..7]), Some(BytesError::Cut));
        assert_eq!(read(&bytes[..bytes.len() - 1]), Some(BytesError::Cut));
    }
}
