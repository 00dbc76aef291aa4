//! A serde serializer that writes descriptions as Rust expressions. All fields are public, so that a literal
//! is possible.

use core::fmt::{self, Display};
use std::format;
use std::string::{String, ToString};

use serde::ser::{
    Error, Impossible, Serialize, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, Serializer,
};

use super::BakeError;

/// The types that descriptions hold by reference, written with `&`.
const BORROWED: [&str; 5] = ["Model", "Optics", "Panorama", "Placed", "Sky"];

/// The depth of nesting down to which each part has a line of its own.
const LINES: usize = 5;

/// The Rust expression that is being written.
pub(super) struct Literal {
    text: String,
    depth: usize,
}

impl Literal {
    /// Writes the expression for a value.
    ///
    /// # Errors
    /// The value is of a kind that descriptions do not have.
    pub(super) fn of(value: &impl Serialize) -> Result<String, BakeError> {
        let mut literal = Self { text: String::new(), depth: 1 };
        value.serialize(&mut literal)?;
        Ok(literal.text)
    }

    fn write(&mut self, text: impl Display) -> Result<(), BakeError> {
        fmt::Write::write_fmt(&mut self.text, format_args!("{text}")).map_err(BakeError::custom)
    }

    /// Writes the name of a type.
    fn name(&mut self, name: &'static str) -> Result<(), BakeError> {
        let borrow = if BORROWED.contains(&name) { "&" } else { "" };
        self.write(format_args!("{borrow}{name}"))
    }

    /// Begins a value with parts. Each part has a line of its own if `lines` is true and the nesting is not
    /// too deep.
    fn parts(&mut self, begin: &str, end: &'static str, lines: bool) -> Parts<'_> {
        self.text.push_str(begin);
        self.depth += 1;
        Parts { lines: lines && self.depth <= LINES, literal: self, is_empty: true, end }
    }

    fn new_line(&mut self) {
        self.text.push('\n');
        (0..self.depth).for_each(|_| self.text.push_str("    "));
    }
}

/// The parts of the value that is being written.
pub(super) struct Parts<'l> {
    literal: &'l mut Literal,
    is_empty: bool,
    lines: bool,
    end: &'static str,
}

impl Parts<'_> {
    fn part<T: Serialize + ?Sized>(&mut self, name: &str, value: &T) -> Result<(), BakeError> {
        let is_first = core::mem::replace(&mut self.is_empty, false);
        if self.lines {
            self.literal.new_line();
        } else {
            self.literal.text.push_str(if is_first { self.pad() } else { ", " });
        }
        self.literal.text.push_str(name);
        value.serialize(&mut *self.literal)?;
        if self.lines {
            self.literal.text.push(',');
        }
        Ok(())
    }

    /// The space inside of the brackets of a value on one line.
    fn pad(&self) -> &'static str {
        if self.end == "}" { " " } else { "" }
    }

    fn finish(self) -> Result<(), BakeError> {
        self.literal.depth -= 1;
        if self.lines && !self.is_empty {
            self.literal.new_line();
        } else {
            self.literal.text.push_str(self.pad());
        }
        self.literal.write(self.end)
    }
}

macro_rules! parts {
    ($($Trait:ident $part:ident),+) => {$(
        impl $Trait for Parts<'_> {
            type Ok = ();
            type Error = BakeError;

            fn $part<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), BakeError> {
                self.part("", value)
            }

            fn end(self) -> Result<(), BakeError> {
                self.finish()
            }
        }
    )+};
}
parts!(
    SerializeSeq serialize_element,
    SerializeTuple serialize_element,
    SerializeTupleStruct serialize_field
);

macro_rules! fields {
    ($($Trait:ident),+) => {$(
        impl $Trait for Parts<'_> {
            type Ok = ();
            type Error = BakeError;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                name: &'static str,
                value: &T,
            ) -> Result<(), BakeError> {
                self.part(&[name, ": "].concat(), value)
            }

            fn end(self) -> Result<(), BakeError> {
                self.finish()
            }
        }
    )+};
}
fields!(SerializeStruct, SerializeStructVariant);

macro_rules! numbers {
    ($($method:ident $Type:ty),+) => {
        $(fn $method(self, value: $Type) -> Result<(), BakeError> {
            self.write(value)
        })+
    };
}

macro_rules! unforeseen {
    ($($method:ident($($argument:ty),*) -> $Ok:ty),+ $(,)?) => {
        $(fn $method(self, $(_: $argument),*) -> Result<$Ok, BakeError> {
            Err(unforeseen(stringify!($method)))
        })+
    };
}

impl<'l> Serializer for &'l mut Literal {
    type Ok = ();
    type Error = BakeError;
    type SerializeSeq = Parts<'l>;
    type SerializeTuple = Parts<'l>;
    type SerializeTupleStruct = Parts<'l>;
    type SerializeTupleVariant = Impossible<(), BakeError>;
    type SerializeMap = Impossible<(), BakeError>;
    type SerializeStruct = Parts<'l>;
    type SerializeStructVariant = Parts<'l>;

    numbers!(
        serialize_bool bool, serialize_i8 i8, serialize_i16 i16, serialize_i32 i32, serialize_i64 i64,
        serialize_u8 u8, serialize_u16 u16, serialize_u32 u32, serialize_u64 u64
    );

    fn serialize_f32(self, value: f32) -> Result<(), BakeError> {
        if value.is_nan() {
            self.write("f32::NAN")
        } else if value.is_infinite() {
            self.write(if value > 0.0 { "f32::INFINITY" } else { "f32::NEG_INFINITY" })
        } else {
            self.write(format_args!("{value:?}"))
        }
    }

    fn serialize_bytes(self, bytes: &[u8]) -> Result<(), BakeError> {
        self.write(format_args!("b\"{}\"", bytes.escape_ascii()))
    }

    fn serialize_none(self) -> Result<(), BakeError> {
        self.write("None")
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), BakeError> {
        self.write("Some(")?;
        value.serialize(&mut *self)?;
        self.write(")")
    }

    fn serialize_unit_variant(
        self,
        name: &'static str,
        _: u32,
        variant: &'static str,
    ) -> Result<(), BakeError> {
        self.name(name)?;
        self.write(format_args!("::{variant}"))
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        name: &'static str,
        value: &T,
    ) -> Result<(), BakeError> {
        self.name(name)?;
        self.write("(")?;
        value.serialize(&mut *self)?;
        self.write(")")
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        name: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<(), BakeError> {
        self.name(name)?;
        self.write(format_args!("::{variant}("))?;
        value.serialize(&mut *self)?;
        self.write(")")
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Parts<'l>, BakeError> {
        Ok(self.parts("&[", "]", true))
    }

    fn serialize_tuple(self, _: usize) -> Result<Parts<'l>, BakeError> {
        Ok(self.parts("[", "]", false))
    }

    fn serialize_tuple_struct(self, name: &'static str, _: usize) -> Result<Parts<'l>, BakeError> {
        self.name(name)?;
        Ok(self.parts("::new(", ")", false))
    }

    fn serialize_struct(self, name: &'static str, _: usize) -> Result<Parts<'l>, BakeError> {
        self.name(name)?;
        Ok(self.parts(" {", "}", true))
    }

    fn serialize_struct_variant(
        self,
        name: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Parts<'l>, BakeError> {
        self.name(name)?;
        self.write(format_args!("::{variant}"))?;
        Ok(self.parts(" {", "}", true))
    }

    fn collect_str<T: Display + ?Sized>(self, _: &T) -> Result<(), BakeError> {
        Err(unforeseen("collect_str"))
    }

    unforeseen!(
        serialize_f64(f64) -> (),
        serialize_char(char) -> (),
        serialize_str(&str) -> (),
        serialize_unit() -> (),
        serialize_unit_struct(&'static str) -> (),
        serialize_tuple_variant(&'static str, u32, &'static str, usize) -> Self::SerializeTupleVariant,
        serialize_map(Option<usize>) -> Self::SerializeMap,
    );
}

/// The error for a value of a kind that descriptions do not have.
fn unforeseen(kind: &str) -> BakeError {
    BakeError(format!("a scene cannot hold a value of this kind: {kind}"))
}

impl Error for BakeError {
    fn custom<T: Display>(reason: T) -> Self {
        Self(reason.to_string())
    }
}
