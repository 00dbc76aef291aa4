//! Scene descriptions from files, through serde: [`Read`] reads the data that `Serialize` writes.
//!
//! A description borrows its lists, but serde's own `Deserialize` can borrow only lists of bytes. So a type
//! that holds a list is read together with a [`Reader`], which lends memory for the list; serde calls such a
//! reader a seed. A type without lists is [`plain`], and is read by serde's derived code.
//!
//! Formats for people (`is_human_readable`) allow more. A field with a default may be left out. A list may be
//! written as a map, whose keys are comments for people. An item in [`Names`] may be referred to by its name.

mod fields;
mod list;
mod number;
mod variants;

pub use fields::{Fields, next_field, next_value, read_fields, read_struct, set_field};
pub use serde;
pub use variants::{Variants, held_fields, held_value, read_variants};
pub(crate) use {
    list::bytes,
    number::{read_id, read_number},
    variants::read_enum,
};

use core::fmt;
use core::marker::PhantomData;

use serde::de::{DeserializeSeed, Deserializer, Error, Unexpected, Visitor};

use crate::arena::Arena;
use crate::fault::Fault;
use crate::math::Vec3;

/// The memory and the names that a description is read with.
#[expect(missing_debug_implementations, reason = "names need not have one")]
pub struct Reader<'m> {
    memory: Arena<'m>,
    names: Option<&'m Names<'m>>,
    /// The reason why the memory could not be used. Formats keep only its text.
    failure: Option<Fault>,
}

impl<'m> Reader<'m> {
    /// A reader that stores lists in this memory.
    pub fn new(memory: &'m mut [core::mem::MaybeUninit<u8>]) -> Self {
        Self { memory: Arena::new(memory), names: None, failure: None }
    }

    /// This reader, for files that refer to items by name.
    pub fn with_names(self, names: &'m Names<'m>) -> Self {
        Self { names: Some(names), ..self }
    }

    /// The reason why the memory did not suffice, if reading failed for that.
    pub const fn failure(&self) -> Option<Fault> {
        self.failure
    }

    /// Reads the item of kind `what` that this name stands for.
    pub(crate) fn read_named<T: Read<'m>, E: Error>(
        &mut self,
        what: &'static str,
        name: &str,
    ) -> Result<T, E> {
        let bytes = self.names.and_then(|names| names(what, name));
        let bytes = bytes.ok_or_else(|| E::custom(format_args!("there is no {what} `{name}`")))?;
        T::read(&mut postcard::Deserializer::from_bytes(bytes), self).map_err(E::custom)
    }

    /// Remembers the fault and converts it to an error of the format.
    pub(crate) fn fail<E: Error>(&mut self, fault: Fault) -> E {
        self.failure = Some(fault);
        E::custom(fault)
    }
}

/// The meaning of names in a file: a function of the kind of item ([`Fields::NAME`]) and its name. It returns
/// the item as postcard's bytes, or `None` where there is no such item.
pub type Names<'m> = dyn Fn(&'static str, &str) -> Option<&'m [u8]> + 'm;

/// A type that can be read into memory that is lent for `'m`.
pub trait Read<'m>: Sized {
    /// Reads a value.
    ///
    /// # Errors
    /// The input is no value of this type, or the memory is too small ([`Reader::failure`]).
    fn read<D: Deserializer<'m>>(from: D, reader: &mut Reader<'m>) -> Result<Self, D::Error>;
}

/// A value that is still to be read, with its reader (serde's seed).
pub struct Seed<'r, 'm, T> {
    reader: &'r mut Reader<'m>,
    of: PhantomData<T>,
}

impl<'r, 'm, T> Seed<'r, 'm, T> {
    /// A seed for this reader.
    pub fn new(reader: &'r mut Reader<'m>) -> Self {
        Self { reader, of: PhantomData }
    }
}

impl<'m, T: Read<'m>> DeserializeSeed<'m> for Seed<'_, 'm, T> {
    type Value = T;

    fn deserialize<D: Deserializer<'m>>(self, from: D) -> Result<T, D::Error> {
        T::read(from, self.reader)
    }
}

/// The visitor that accepts one of several names, or the position of one.
enum OneOf {
    Fields(&'static [&'static str]),
    Variants(&'static [&'static str]),
}

impl OneOf {
    const fn names(&self) -> &'static [&'static str] {
        let (Self::Fields(names) | Self::Variants(names)) = self;
        names
    }
}

impl<'de> DeserializeSeed<'de> for OneOf {
    type Value = &'static str;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<&'static str, D::Error> {
        from.deserialize_identifier(self)
    }
}

impl Visitor<'_> for OneOf {
    type Value = &'static str;

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_str("a name")
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<&'static str, E> {
        let name = usize::try_from(number).ok().and_then(|number| self.names().get(number));
        name.copied().ok_or_else(|| E::invalid_value(Unexpected::Unsigned(number), &self))
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<&'static str, E> {
        let known = self.names().iter().find(|known| **known == name);
        known.copied().ok_or_else(|| match self {
            Self::Fields(names) => E::unknown_field(name, names),
            Self::Variants(names) => E::unknown_variant(name, names),
        })
    }
}

/// Implements [`Read`] for types without lists through their `Deserialize`.
///
/// Use it for a shape of your own, so that files can be read that contain this shape.
#[macro_export]
#[doc(hidden)]
macro_rules! __read_plain {
    ($($Type:ty),+ $(,)?) => {$(
        impl<'m> $crate::read::Read<'m> for $Type {
            fn read<D: $crate::read::serde::Deserializer<'m>>(
                from: D,
                _: &mut $crate::read::Reader<'m>,
            ) -> Result<Self, D::Error> {
                $crate::read::serde::Deserialize::deserialize(from)
            }
        }
    )+};
}
pub use __read_plain as plain;

plain!(bool, f32, u16, Vec3, [u8; 3], [u16; 3], [f32; 2], [i16; 12]);
