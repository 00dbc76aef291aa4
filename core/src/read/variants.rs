//! Reading of enums that hold lists.

use core::fmt;
use core::marker::PhantomData;

use serde::de::{Deserializer, EnumAccess, VariantAccess, Visitor};

use super::fields::{Fields, FieldsOf};
use super::{OneOf, Read, Reader, Seed};

/// An enum that is read as one of several variants.
pub trait Variants<'m>: Sized {
    /// The name of the enum, for formats that write names.
    const NAME: &'static str;
    /// The names of its variants, in the order of their numbers.
    const VARIANTS: &'static [&'static str];

    /// Reads the contents of the variant `name`, which is one of [`VARIANTS`](Self::VARIANTS).
    ///
    /// # Errors
    /// The contents of the variant cannot be read.
    fn from_variant<A: VariantAccess<'m>>(
        name: &'static str,
        held: A,
        reader: &mut Reader<'m>,
    ) -> Result<Self, A::Error>;
}

/// Reads an enum.
///
/// # Errors
/// The errors of [`Read::read`].
pub fn read_variants<'m, T: Variants<'m>, D: Deserializer<'m>>(
    from: D,
    reader: &mut Reader<'m>,
) -> Result<T, D::Error> {
    from.deserialize_enum(T::NAME, T::VARIANTS, VariantsOf { reader, of: PhantomData })
}

/// The visitor that receives the variant from the format.
struct VariantsOf<'r, 'm, T> {
    reader: &'r mut Reader<'m>,
    of: PhantomData<T>,
}

impl<'m, T: Variants<'m>> Visitor<'m> for VariantsOf<'_, 'm, T> {
    type Value = T;

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_str(T::NAME)
    }

    fn visit_enum<A: EnumAccess<'m>>(self, variant: A) -> Result<T, A::Error> {
        let (name, held) = variant.variant_seed(OneOf::Variants(T::VARIANTS))?;
        T::from_variant(name, held, self.reader)
    }
}

/// Reads the contents of a variant with one value.
///
/// # Errors
/// The value cannot be read.
pub fn held_value<'m, T: Read<'m>, A: VariantAccess<'m>>(
    held: A,
    reader: &mut Reader<'m>,
) -> Result<T, A::Error> {
    held.newtype_variant_seed(Seed::new(reader))
}

/// Reads the contents of a variant with several fields.
///
/// # Errors
/// A field cannot be read.
pub fn held_fields<'m, T: Fields<'m>, A: VariantAccess<'m>>(
    held: A,
    reader: &mut Reader<'m>,
) -> Result<T, A::Error> {
    held.struct_variant(T::FIELDS, FieldsOf { reader, of: PhantomData })
}

/// Implements [`Variants`] and [`Read`] for an enum. The arguments are its type parameters, its name and
/// type, and its variants, each of which holds nothing, one value, or the fields of a struct. `for` names the
/// lifetime of the memory in which lists are stored.
#[doc(hidden)]
#[macro_export]
macro_rules! __read_enum {
    (
        for $m:lifetime [$($generics:tt)*] $Name:ident as $Type:ty $(where [$($bounds:tt)*])? {
            $($Variant:ident $(($held:ty))? $({ $Fields:ty: $($field:ident),+ })?),+ $(,)?
        }
    ) => {
        impl<$m, $($generics)*> $crate::read::Variants<$m> for $Type $(where $($bounds)*)? {
            const NAME: &'static str = stringify!($Name);
            const VARIANTS: &'static [&'static str] = &[$(stringify!($Variant)),+];

            fn from_variant<A: $crate::read::serde::de::VariantAccess<$m>>(
                name: &'static str,
                held: A,
                reader: &mut $crate::read::Reader<$m>,
            ) -> Result<Self, A::Error> {
                match name {
                    $(_ if name == stringify!($Variant) => {
                        $crate::__read_enum!(
                            @held $Variant $(($held))? $({ $Fields: $($field),+ })?, held, reader
                        )
                    })+
                    _ => Err($crate::read::serde::de::Error::unknown_variant(name, Self::VARIANTS)),
                }
            }
        }

        impl<$m, $($generics)*> $crate::read::Read<$m> for $Type $(where $($bounds)*)? {
            fn read<D: $crate::read::serde::Deserializer<$m>>(
                from: D,
                reader: &mut $crate::read::Reader<$m>,
            ) -> Result<Self, D::Error> {
                $crate::read::read_variants(from, reader)
            }
        }
    };
    ([$($generics:tt)*] $($enum:tt)*) => {
        $crate::__read_enum! { for 'm [$($generics)*] $($enum)* }
    };
    (@held $Variant:ident ($held:ty), $from:ident, $reader:ident) => {
        $crate::read::held_value($from, $reader).map(Self::$Variant)
    };
    (@held $Variant:ident { $Fields:ty: $($field:ident),+ }, $from:ident, $reader:ident) => {{
        let fields: $Fields = $crate::read::held_fields($from, $reader)?;
        Ok(Self::$Variant { $($field: fields.$field),+ })
    }};
    (@held $Variant:ident, $from:ident, $reader:ident) => {{
        let _ = $reader;
        $crate::read::serde::de::VariantAccess::unit_variant($from).map(|()| Self::$Variant)
    }};
}
pub(crate) use __read_enum as read_enum;
