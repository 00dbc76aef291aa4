//! Reading of structs that hold lists, field by field.

use core::fmt;
use core::marker::PhantomData;

use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Unexpected, Visitor};

use super::{OneOf, Read, Reader, Seed};

/// A struct that is read field by field.
pub trait Fields<'m>: Read<'m> {
    /// The name of the struct, for formats that write names.
    const NAME: &'static str;
    /// The names of its fields, in the order in which they are written.
    const FIELDS: &'static [&'static str];
    /// Whether a file may refer to such a value by a name ([`Names`](super::Names)) in place of its fields.
    const MAY_BE_NAMED: bool = false;

    /// Reads the fields from a format that writes values without names, in order.
    ///
    /// # Errors
    /// A value is missing or cannot be read.
    fn from_values<A: SeqAccess<'m>>(values: A, reader: &mut Reader<'m>) -> Result<Self, A::Error>;

    /// Reads the fields from a format that writes their names, in any order.
    ///
    /// # Errors
    /// A field is missing, given twice or unknown, or its value cannot be read.
    fn from_map<A: MapAccess<'m>>(map: A, reader: &mut Reader<'m>) -> Result<Self, A::Error>;
}

/// Reads a struct with fields.
///
/// # Errors
/// The errors of [`Read::read`].
pub fn read_fields<'m, T: Fields<'m>, D: Deserializer<'m>>(
    from: D,
    reader: &mut Reader<'m>,
) -> Result<T, D::Error> {
    let may_be_a_name = T::MAY_BE_NAMED && from.is_human_readable();
    let visitor = FieldsOf { reader, of: PhantomData };
    if may_be_a_name {
        from.deserialize_any(visitor)
    } else {
        from.deserialize_struct(T::NAME, T::FIELDS, visitor)
    }
}

/// The visitor that receives the fields from the format.
pub(super) struct FieldsOf<'r, 'm, T> {
    pub(super) reader: &'r mut Reader<'m>,
    pub(super) of: PhantomData<T>,
}

impl<'m, T: Fields<'m>> Visitor<'m> for FieldsOf<'_, 'm, T> {
    type Value = T;

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_str(T::NAME)
    }

    fn visit_seq<A: SeqAccess<'m>>(self, values: A) -> Result<T, A::Error> {
        T::from_values(values, self.reader)
    }

    fn visit_map<A: MapAccess<'m>>(self, map: A) -> Result<T, A::Error> {
        T::from_map(map, self.reader)
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<T, E> {
        if T::MAY_BE_NAMED {
            self.reader.read_named(T::NAME, name)
        } else {
            Err(E::invalid_type(Unexpected::Str(name), &self))
        }
    }
}

/// Reads the value of the next field, from a format without names.
///
/// # Errors
/// The value of the field is missing or cannot be read.
pub fn next_value<'m, T: Read<'m>, A: SeqAccess<'m>>(
    values: &mut A,
    reader: &mut Reader<'m>,
    field: &'static str,
) -> Result<T, A::Error> {
    values.next_element_seed(Seed::new(reader))?.ok_or_else(|| A::Error::missing_field(field))
}

/// Reads the name of the next field; `None` after the last.
///
/// # Errors
/// The name is none of `fields`.
pub fn next_field<'m, A: MapAccess<'m>>(
    map: &mut A,
    fields: &'static [&'static str],
) -> Result<Option<&'static str>, A::Error> {
    map.next_key_seed(OneOf::Fields(fields))
}

/// Reads the value of a field whose name was read.
///
/// # Errors
/// The field was already given, or its value cannot be read.
pub fn set_field<'m, T: Read<'m>, A: MapAccess<'m>>(
    field: &mut Option<T>,
    map: &mut A,
    reader: &mut Reader<'m>,
    name: &'static str,
) -> Result<(), A::Error> {
    if field.is_some() {
        return Err(A::Error::duplicate_field(name));
    }
    *field = Some(map.next_value_seed(Seed::new(reader))?);
    Ok(())
}

/// Implements [`Fields`] and [`Read`] for a struct. The arguments are its type parameters, its name and type,
/// its fields (with `= default` where a field may be left out), and `may be named` where a name may stand in
/// place of the fields.
#[doc(hidden)]
#[macro_export]
macro_rules! __read_struct {
    (
        [$($generics:tt)*] $Name:ident as $Type:ty {
            $($field:ident $(= $default:expr)?),+ $(,)?
        }
        $(may be $named:tt)?
    ) => {
        impl<'m, $($generics)*> $crate::read::Fields<'m> for $Type {
            const NAME: &'static str = stringify!($Name);
            const FIELDS: &'static [&'static str] = &[$(stringify!($field)),+];
            $(const MAY_BE_NAMED: bool = $crate::__read_struct!(@$named);)?

            fn from_values<A: $crate::read::serde::de::SeqAccess<'m>>(
                mut values: A,
                reader: &mut $crate::read::Reader<'m>,
            ) -> Result<Self, A::Error> {
                Ok(Self { $($field: $crate::read::next_value(&mut values, reader, stringify!($field))?),+ })
            }

            fn from_map<A: $crate::read::serde::de::MapAccess<'m>>(
                mut map: A,
                reader: &mut $crate::read::Reader<'m>,
            ) -> Result<Self, A::Error> {
                $(let mut $field = None;)+
                while let Some(name) = $crate::read::next_field(&mut map, Self::FIELDS)? {
                    match name {
                        $(_ if name == stringify!($field) => {
                            $crate::read::set_field(&mut $field, &mut map, reader, name)?;
                        })+
                        _ => {}
                    }
                }
                Ok(Self { $(
                    $field: match $field {
                        Some(value) => value,
                        None => $crate::__read_struct!(@missing $field $($default)?),
                    }
                ),+ })
            }
        }

        impl<'m, $($generics)*> $crate::read::Read<'m> for $Type {
            fn read<D: $crate::read::serde::Deserializer<'m>>(
                from: D,
                reader: &mut $crate::read::Reader<'m>,
            ) -> Result<Self, D::Error> {
                $crate::read::read_fields(from, reader)
            }
        }
    };
    (@named) => { true };
    (@missing $field:ident $default:expr) => { $default };
    (@missing $field:ident) => { return Err($crate::read::serde::de::Error::missing_field(stringify!($field))) };
}
pub use __read_struct as read_struct;
