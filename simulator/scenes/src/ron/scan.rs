//! Partial reading of a file: the names of its materials, and the positions of its parts.

use core::fmt;

use rayline::Part;
use ron::error::SpannedError;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::{Position, options};

/// The names of the materials, in their order; empty if they have no names.
pub(super) fn material_names(text: &str) -> Result<Vec<String>, SpannedError> {
    names(text, "materials")
}

/// The names of the objects, if they have names.
pub(super) fn object_names(text: &str) -> Result<Vec<String>, SpannedError> {
    names(text, "objects")
}

/// The keys of a list that is written as a map.
pub(super) fn names(text: &str, name: &'static str) -> Result<Vec<String>, SpannedError> {
    let mut names = Vec::new();
    options().from_str_seed(text, Field { name, inside: &mut Keys(&mut names) })?;
    Ok(names)
}

/// The position of a part in the text.
pub(super) fn position_of(text: &str, part: Part) -> Option<Position> {
    let (name, index) = match part {
        Part::Camera => ("camera", None),
        Part::Background => ("background", None),
        Part::Object(index) => ("objects", Some(index)),
        Part::Material(index) => ("materials", Some(index)),
        Part::Light(index) => ("lights", Some(index)),
        Part::Motion(index) => ("motions", Some(index)),
        _ => return None,
    };
    let stopped = options().from_str_seed(text, Field { name, inside: &mut StopAt(index) });
    // The text was read before, so this is its only error. The span of the error begins before the white
    // space, and ends at the value.
    stopped.err().map(|error| Position::from(error.span.end))
}

/// An action on the value of a field.
trait Inside {
    fn visit<'de, D: Deserializer<'de>>(&mut self, value: D) -> Result<(), D::Error>;
}

/// Applies the action to one field of the scene, and skips the others.
struct Field<'i, I> {
    name: &'static str,
    inside: &'i mut I,
}

impl<'de, I: Inside> DeserializeSeed<'de> for Field<'_, I> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, scene: D) -> Result<(), D::Error> {
        scene.deserialize_struct("Scene", &[], self)
    }
}

impl<'de, I: Inside> Visitor<'de> for Field<'_, I> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a scene")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut fields: A) -> Result<(), A::Error> {
        while let Some(name) = fields.next_key_seed(Name)? {
            if name == self.name {
                fields.next_value_seed(Do(self.inside))?;
            } else {
                fields.next_value::<IgnoredAny>()?;
            }
        }
        Ok(())
    }
}

/// A seed that reads the name of a field.
struct Name;

impl<'de> DeserializeSeed<'de> for Name {
    type Value = String;

    fn deserialize<D: Deserializer<'de>>(self, name: D) -> Result<String, D::Error> {
        name.deserialize_identifier(self)
    }
}

impl Visitor<'_> for Name {
    type Value = String;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a name")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<String, E> {
        Ok(name.to_owned())
    }
}

/// A seed that applies the action to a value.
struct Do<'i, I>(&'i mut I);

impl<'de, I: Inside> DeserializeSeed<'de> for Do<'_, I> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, value: D) -> Result<(), D::Error> {
        self.0.visit(value)
    }
}

/// The action that collects the keys of a map; a list has none.
struct Keys<'k>(&'k mut Vec<String>);

impl Inside for Keys<'_> {
    fn visit<'de, D: Deserializer<'de>>(&mut self, list: D) -> Result<(), D::Error> {
        list.deserialize_any(Elements(|key: Option<String>| {
            self.0.extend(key);
            true
        }))
    }
}

/// The action that fails on purpose, at the value or at the element of this index: the error of the format
/// then has the position.
struct StopAt(Option<usize>);

impl Inside for StopAt {
    fn visit<'de, D: Deserializer<'de>>(&mut self, value: D) -> Result<(), D::Error> {
        let Some(index) = self.0 else { return Err(D::Error::custom("here")) };
        let mut before = 0..index;
        value.deserialize_any(Elements(|_| before.next().is_some()))
    }
}

/// A visitor for the elements of a list or a map. It calls the function with the key of each element, and
/// fails if that returns false.
struct Elements<F>(F);

impl<'de, F: FnMut(Option<String>) -> bool> Visitor<'de> for Elements<F> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list, or a map of names")
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut values: A) -> Result<(), A::Error> {
        while values.next_element_seed(Element(|| self.0(None)))?.is_some() {}
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            map.next_value_seed(Element(|| self.0(Some(key))))?;
        }
        Ok(())
    }
}

/// A seed that skips a value, or fails in front of it if the function returns false.
struct Element<F>(F);

impl<'de, F: FnOnce() -> bool> DeserializeSeed<'de> for Element<F> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, value: D) -> Result<(), D::Error> {
        if !(self.0)() {
            return Err(D::Error::custom("here"));
        }
        value.deserialize_any(IgnoredAny).map(|_| ())
    }
}
