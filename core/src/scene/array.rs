//! Reading of lists into arrays of fixed capacity.

use core::fmt;
use core::marker::PhantomData;

use heapless::Vec;
use serde::de::{Deserializer, SeqAccess, Visitor};

use crate::fault::Fault;
use crate::read::{Read, Reader, Seed};

impl<'m, T: Read<'m>, const N: usize> Read<'m> for Vec<T, N> {
    fn read<D: Deserializer<'m>>(from: D, reader: &mut Reader<'m>) -> Result<Self, D::Error> {
        from.deserialize_seq(Array { reader, of: PhantomData })
    }
}

/// The visitor that receives the values of a list of at most `N`.
struct Array<'r, 'm, T, const N: usize> {
    reader: &'r mut Reader<'m>,
    of: PhantomData<T>,
}

impl<'m, T: Read<'m>, const N: usize> Visitor<'m> for Array<'_, 'm, T, N> {
    type Value = Vec<T, N>;

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(text, "a list of at most {N}")
    }

    fn visit_seq<A: SeqAccess<'m>>(self, mut values: A) -> Result<Self::Value, A::Error> {
        let mut list = Vec::new();
        while let Some(value) = values.next_element_seed(Seed::new(self.reader))? {
            list.push(value).map_err(|_| self.reader.fail(Fault::Full { room: N }))?;
        }
        Ok(list)
    }
}
