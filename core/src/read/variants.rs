//! Enums that hold lists.

use core::fmt;
use core::marker::PhantomData;

use serde::de::{Deserializer, EnumAccess, VariantAccess, Visitor};

use super::fields::{Fields, FieldsOf};
use super::{OneOf, Read, Reader, Seed};

/// What is read as one of several variants.
pub trait Variants<'m>: Sized {
    /// What a file may call it.
    const NAME: &'static str;
    /// Its variants, in the order in which they are numbered.
    const VARIANTS: &'static [&'static str];

    /// The variant of this name, which is one of them.
    ///
    /// # Errors
    /// What it holds cannot be read.
    fn from_variant<A: VariantAccess<'m>>(
        name: &'static str,
        held: A,
        reader: &mut Reader<'m>,
    ) -> Result<Self, A::Error>;
}

/// Reads what has variants.
///
/// # Errors
/// As [`Read::read`].
pub fn read_variants<'m, T: Variants<'m>, D: Deserializer<'m>>(
    from: D,
    reader: &mut Reader<'m>,
) -> Result<T, D::Error> {
    from.deserialize_enum(T::NAME, T::VARIANTS, VariantsOf { reader, of: PhantomData })
}

/// Takes the variant that a format has found.
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

/// What a variant of one value holds.
///
/// # Errors
/// It cannot be read.
pub fn held_value<'m, T: Read<'m>, A: VariantAccess<'m>>(
    held: A,
    reader: &mut Reader<'m>,
) -> Result<T, A::Error> {
    held.newtype_variant_seed(Seed::new(reader))
}

/// What a variant of several fields holds.
///
/// # Errors
/// They cannot be read.
pub fn held_fields<'m, T: Fields<'m>, A: VariantAccess<'m>>(
    held: A,
    reader: &mut Reader<'m>,
) -> Result<T, A::Error> {
    held.struct_variant(T::FIELDS, FieldsOf { reader, of: PhantomData })
}

/// Makes [`Variants`] and [`Read`] for an enum: its type parameters, name and type, and its variants, of which each
/// holds nothing, one value, or the fields of a struct. `for` names the lifetime of the memory where lists are put.
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
                        $crate::__read_enum!(@held $Variant $(($held))? $({ $Fields: $($field),+ })?, held, reader)
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
