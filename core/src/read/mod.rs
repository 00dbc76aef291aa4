//! Descriptions from files, through serde: what is written by `Serialize` is read by [`Read`].
//!
//! A description borrows its lists, and serde's own `Deserialize` can make a borrowed list of nothing but bytes. So whatever
//! holds a list is read together with a [`Reader`], which has the memory where lists are put; serde calls that a
//! seed. What holds none is [`plain`], and read as serde derives it. Rejected: descriptions that own their lists, which could not
//! be in flash, and a second set of types for files, which would be every type twice.
//!
//! Formats for people (`is_human_readable`) allow more: fields that have a usual value may be left out, a list may be written
//! as a map, whose keys are names for the reader's benefit, and what [`Names`] knows may be called by its name.

mod fields;
mod list;
mod number;
mod variants;

pub use fields::{Fields, next_field, next_value, read_fields, set_field};
pub use serde;
pub use variants::{Variants, held_fields, held_value, read_variants};
pub(crate) use {fields::read_struct, list::bytes, number::read_number, variants::read_enum};

use core::fmt;
use core::marker::PhantomData;

use serde::de::{DeserializeSeed, Deserializer, Error, Unexpected, Visitor};

use crate::arena::Arena;
use crate::fault::Fault;
use crate::math::Vec3;

/// What descriptions are read with: memory for their lists, and what names stand for.
#[expect(missing_debug_implementations, reason = "names need not have one")]
pub struct Reader<'m> {
    memory: Arena<'m>,
    names: Option<&'m Names<'m>>,
    /// Why the memory could not be used: formats keep no more than the text of it.
    failure: Option<Fault>,
}

impl<'m> Reader<'m> {
    /// A reader that puts lists into this memory.
    pub fn new(memory: &'m mut [core::mem::MaybeUninit<u8>]) -> Self {
        Self { memory: Arena::new(memory), names: None, failure: None }
    }

    /// The same, for files in which things have names.
    pub fn with_names(self, names: &'m Names<'m>) -> Self {
        Self { names: Some(names), ..self }
    }

    /// Why the memory did not do, if that is what reading ended with.
    pub const fn failure(&self) -> Option<Fault> {
        self.failure
    }

    /// Reads what is called by a name.
    pub(crate) fn read_named<T: Read<'m>, E: Error>(
        &mut self,
        what: &'static str,
        name: &str,
    ) -> Result<T, E> {
        let bytes = self.names.and_then(|names| names(what, name));
        let bytes = bytes.ok_or_else(|| E::custom(format_args!("there is no {what} `{name}`")))?;
        T::read(&mut postcard::Deserializer::from_bytes(bytes), self).map_err(E::custom)
    }

    /// Remembers the fault and makes a format's error of it.
    pub(crate) fn fail<E: Error>(&mut self, fault: Fault) -> E {
        self.failure = Some(fault);
        E::custom(fault)
    }
}

/// What names in a file stand for: told what is to be read ([`Fields::NAME`]) and what it is called, the bytes that
/// postcard makes of it, if there is such a thing.
pub type Names<'m> = dyn Fn(&'static str, &str) -> Option<&'m [u8]> + 'm;

/// What can be read into memory that is lent for `'m`.
pub trait Read<'m>: Sized {
    /// Reads a value.
    ///
    /// # Errors
    /// What was read is no such value, or there is too little memory ([`Reader::failure`]).
    fn read<D: Deserializer<'m>>(from: D, reader: &mut Reader<'m>) -> Result<Self, D::Error>;
}

/// A value that is still to be read, and the reader for it.
pub struct Seed<'r, 'm, T> {
    reader: &'r mut Reader<'m>,
    of: PhantomData<T>,
}

impl<'r, 'm, T> Seed<'r, 'm, T> {
    /// A value to be read with this reader.
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

/// A name that is one of several, or its number.
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

/// Makes [`Read`] for types that hold no list, and so are read as serde derives it.
///
/// Do it for a shape of your own, so that a set that it is in can be read from files.
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

plain!(bool, f32, u16, Vec3, [u8; 3], [u16; 3], [f32; 2]);
