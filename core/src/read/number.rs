//! Reading of numbers that a file may give as a name.

use core::fmt;

use serde::de::{Deserializer, Error, Unexpected, Visitor};

use super::{Read, Reader};

/// Reads the number of an item. In a format for people its name will do.
pub(crate) fn read_number<'m, D: Deserializer<'m>>(
    what: &'static str,
    from: D,
    reader: &mut Reader<'m>,
) -> Result<u16, D::Error> {
    if from.is_human_readable() {
        from.deserialize_any(Number { what, reader })
    } else {
        u16::read(from, reader)
    }
}

struct Number<'r, 'm> {
    what: &'static str,
    reader: &'r mut Reader<'m>,
}

impl<'m> Visitor<'m> for Number<'_, 'm> {
    type Value = u16;

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(text, "{}, its name or its number from 0 to 65535", self.what)
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<u16, E> {
        u16::try_from(number).map_err(|_| E::invalid_value(Unexpected::Unsigned(number), &self))
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<u16, E> {
        self.reader.read_named(self.what, name)
    }
}

/// Implements [`Read`] for a number of an item, a tuple struct that holds a `u16`.
macro_rules! read_id {
    ($Id:ident) => {
        impl<'m> $crate::read::Read<'m> for $Id {
            fn read<D: serde::Deserializer<'m>>(
                from: D,
                reader: &mut $crate::read::Reader<'m>,
            ) -> Result<Self, D::Error> {
                $crate::read::read_number(stringify!($Id), from, reader).map(Self)
            }
        }
    };
}
pub(crate) use read_id;
