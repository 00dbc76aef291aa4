//! Serialization of three numbers that belong together: as a tuple.

/// Writes three fields as a tuple of three, and reads them.
macro_rules! triple {
    ($Type:ident { $($field:ident),+ }) => {
        impl<R: serde::Serialize> serde::Serialize for $Type<R> {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                use serde::ser::SerializeTupleStruct;
                let mut numbers = serializer.serialize_tuple_struct(stringify!($Type), 3)?;
                $(numbers.serialize_field(&self.$field)?;)+
                numbers.end()
            }
        }

        impl<'de, R: serde::Deserialize<'de>> serde::Deserialize<'de> for $Type<R> {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let [$($field),+] = <[R; 3]>::deserialize(deserializer)?;
                Ok(Self { $($field),+ })
            }
        }
    };
}
pub(crate) use triple;
