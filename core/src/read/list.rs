//! Reading of lists and references, whose targets are stored in the reader's memory.

use core::fmt;
use core::marker::PhantomData;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};

use super::{Read, Reader, Seed};
#[cfg(feature = "std")]
use crate::fault::Fault;

impl<'m, T: Read<'m> + Copy + 'm> Read<'m> for &'m [T] {
    fn read<D: Deserializer<'m>>(from: D, reader: &mut Reader<'m>) -> Result<Self, D::Error> {
        let visitor = List { reader, of: PhantomData };
        if from.is_human_readable() { from.deserialize_any(visitor) } else { from.deserialize_seq(visitor) }
    }
}

impl<'m, T: Read<'m> + Copy + 'm> Read<'m> for &'m T {
    fn read<D: Deserializer<'m>>(from: D, reader: &mut Reader<'m>) -> Result<Self, D::Error> {
        let value = T::read(from, reader)?;
        reader.memory.store(value).map_err(|fault| reader.fail(fault))
    }
}

impl<'m, T: Read<'m>> Read<'m> for Option<T> {
    fn read<D: Deserializer<'m>>(from: D, reader: &mut Reader<'m>) -> Result<Self, D::Error> {
        from.deserialize_option(Optional { reader, of: PhantomData })
    }
}

impl<'m> Read<'m> for &'m [u8] {
    fn read<D: Deserializer<'m>>(from: D, reader: &mut Reader<'m>) -> Result<Self, D::Error> {
        from.deserialize_bytes(Bytes { reader })
    }
}

/// Serializes a slice of bytes as bytes rather than as a list of numbers; for `serialize_with`.
pub(crate) fn bytes<S: serde::Serializer>(bytes: &&[u8], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_bytes(bytes)
}

/// The visitor that receives the values of a list.
struct List<'r, 'm, T> {
    reader: &'r mut Reader<'m>,
    of: PhantomData<T>,
}

impl<'m, T: Read<'m> + Copy + 'm> List<'_, 'm, T> {
    /// Stores the values in the reader's memory. `count` is their number, if the format stores it.
    fn collect<E: Error>(
        self,
        count: Option<usize>,
        next: &mut dyn FnMut(&mut Reader<'m>) -> Result<Option<T>, E>,
    ) -> Result<&'m [T], E> {
        let Some(count) = count else { return self.collect_any(next) };
        let mut room = self.reader.memory.room(count).map_err(|fault| self.reader.fail(fault))?;
        while let Some(value) = next(self.reader)? {
            room.push(value)
                .map_err(|_| E::invalid_length(count, &"as many values as the format announced"))?;
        }
        Ok(room.filled())
    }

    /// Stores the values of a list whose length the format does not store: they are collected in a `Vec`
    /// first.
    #[cfg(feature = "std")]
    fn collect_any<E: Error>(
        self,
        next: &mut dyn FnMut(&mut Reader<'m>) -> Result<Option<T>, E>,
    ) -> Result<&'m [T], E> {
        let mut values = std::vec::Vec::new();
        while let Some(value) = next(self.reader)? {
            values.push(value);
        }
        stored(self.reader, &values).map_err(|fault| self.reader.fail(fault))
    }

    #[cfg(not(feature = "std"))]
    fn collect_any<E: Error>(
        self,
        next: &mut dyn FnMut(&mut Reader<'m>) -> Result<Option<T>, E>,
    ) -> Result<&'m [T], E> {
        // Read the list to its end, so that a broken list fails with the format's own error.
        while next(self.reader)?.is_some() {}
        Err(E::custom(
            "this format does not store the lengths of lists; build with the feature `std` to read it",
        ))
    }
}

impl<'m, T: Read<'m> + Copy + 'm> Visitor<'m> for List<'_, 'm, T> {
    type Value = &'m [T];

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'m>>(self, mut values: A) -> Result<&'m [T], A::Error> {
        self.collect(values.size_hint(), &mut |reader| values.next_element_seed(Seed::new(reader)))
    }

    fn visit_map<A: MapAccess<'m>>(self, mut map: A) -> Result<&'m [T], A::Error> {
        self.collect(map.size_hint(), &mut |reader| match map.next_key_seed(Key)? {
            Some(()) => map.next_value_seed(Seed::new(reader)).map(Some),
            None => Ok(None),
        })
    }
}

/// Stores values in the reader's memory.
#[cfg(feature = "std")]
fn stored<'m, T: Copy>(reader: &mut Reader<'m>, values: &[T]) -> Result<&'m [T], Fault> {
    let mut room = reader.memory.room(values.len())?;
    values.iter().try_for_each(|value| room.push(*value))?;
    Ok(room.filled())
}

/// The key of a value in a list that is written as a map. It names the value for people who read the file,
/// and is skipped.
struct Key;

impl<'de> DeserializeSeed<'de> for Key {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_str(self)
    }
}

impl Visitor<'_> for Key {
    type Value = ();

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_str("a name in quotes")
    }

    fn visit_str<E: Error>(self, _: &str) -> Result<(), E> {
        Ok(())
    }
}

/// The visitor that receives an optional value.
struct Optional<'r, 'm, T> {
    reader: &'r mut Reader<'m>,
    of: PhantomData<T>,
}

impl<'m, T: Read<'m>> Visitor<'m> for Optional<'_, 'm, T> {
    type Value = Option<T>;

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_str("a value or nothing")
    }

    fn visit_none<E: Error>(self) -> Result<Option<T>, E> {
        Ok(None)
    }

    fn visit_unit<E: Error>(self) -> Result<Option<T>, E> {
        Ok(None)
    }

    fn visit_some<D: Deserializer<'m>>(self, from: D) -> Result<Option<T>, D::Error> {
        T::read(from, self.reader).map(Some)
    }
}

/// The visitor that receives bytes. They are borrowed from the file if it lives as long as the scene, else
/// copied.
struct Bytes<'r, 'm> {
    reader: &'r mut Reader<'m>,
}

impl<'m> Visitor<'m> for Bytes<'_, 'm> {
    type Value = &'m [u8];

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_str("bytes")
    }

    fn visit_borrowed_bytes<E: Error>(self, bytes: &'m [u8]) -> Result<&'m [u8], E> {
        Ok(bytes)
    }

    fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<&'m [u8], E> {
        let mut room = self.reader.memory.room(bytes.len()).map_err(|fault| self.reader.fail(fault))?;
        bytes.iter().try_for_each(|byte| room.push(*byte)).map_err(|fault| self.reader.fail(fault))?;
        Ok(room.filled())
    }
}
