//! The items that names in a file stand for.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::Path;

use bumpalo::Bump;
use rayline::materials::{ALUMINUM, CHROMIUM, COPPER, DIAMOND, FLINT, GLASS, GOLD, ICE, IRON, SILVER, WATER};
use rayline::shape::{Mesh, Shape};
use rayline::{Encoding, Ends, Filter, Image, Material, Pixels};
use serde::Serialize;

use super::RonFault;
use super::scan::object_names;
use crate::raster::Raster;
use crate::{OpenOptions, obj};

/// The materials that a file may refer to by name in place of a description.
pub const PRESETS: [(&str, Material<'static>); 11] = [
    ("gold", GOLD),
    ("silver", SILVER),
    ("copper", COPPER),
    ("aluminum", ALUMINUM),
    ("iron", IRON),
    ("chromium", CHROMIUM),
    ("glass", GLASS),
    ("flint", FLINT),
    ("diamond", DIAMOND),
    ("ice", ICE),
    ("water", WATER),
];

/// The items that one file can refer to by name.
pub(super) struct Known<'a> {
    arena: &'a Bump,
    /// The directory that names of files are relative to.
    directory: &'a Path,
    /// The names of the file's own materials.
    materials: &'a [&'a str],
    /// The text of the file, where the names of its objects stand.
    text: &'a str,
    /// A cache of the items that were found, by kind and name. Names are often used several times, and the
    /// file is read again if the memory was too small.
    found: RefCell<HashMap<(String, String), &'a [u8]>>,
    /// The fault of the last name that was not found.
    unknown: RefCell<Option<RonFault>>,
}

impl<'a> Known<'a> {
    pub(super) fn new(arena: &'a Bump, directory: &'a Path, text: &'a str, materials: &[String]) -> Self {
        let materials = arena.alloc_slice_fill_iter(materials.iter().map(|name| &*arena.alloc_str(name)));
        Self { arena, directory, materials, text, found: RefCell::default(), unknown: RefCell::default() }
    }

    /// The fault of the last name that was not found, if there was one.
    pub(super) fn unknown(&self) -> Option<RonFault> {
        self.unknown.take()
    }

    /// The bytes of the item of this kind and name, see [`rayline::read::Names`].
    pub(super) fn find(&self, what: &str, name: &str) -> Option<&'a [u8]> {
        let key = (what.to_owned(), name.to_owned());
        if let Some(bytes) = self.found.borrow().get(&key) {
            return Some(*bytes);
        }
        let found = match what {
            "MaterialId" => self.own_material(name),
            "ObjectId" => self.own_object(name),
            "Material" => self.preset(name),
            "Mesh" => self.mesh(name),
            "Image" => self.image(name),
            _ => Err(RonFault::unknown(what, name, &[])),
        };
        match found {
            Ok(bytes) => {
                self.found.borrow_mut().insert(key, bytes);
                Some(bytes)
            }
            Err(fault) => {
                self.unknown.replace(Some(fault));
                None
            }
        }
    }

    fn own_material(&self, name: &str) -> Result<&'a [u8], RonFault> {
        let number = self.materials.iter().position(|known| *known == name);
        let number = number.ok_or_else(|| match preset(name) {
            Some(_) => RonFault::PresetInObject { name: name.to_owned() },
            None => RonFault::unknown("material in this file", name, self.materials),
        })?;
        self.bytes(name, &u16::try_from(number).unwrap_or(u16::MAX))
    }

    fn own_object(&self, name: &str) -> Result<&'a [u8], RonFault> {
        let objects = object_names(self.text).map_err(|error| RonFault::from_ron(error, None).1)?;
        let number = objects.iter().position(|known| known == name).ok_or_else(|| {
            let names: Vec<&str> = objects.iter().map(String::as_str).collect();
            RonFault::unknown("object in this file", name, &names)
        })?;
        self.bytes(name, &u16::try_from(number).unwrap_or(u16::MAX))
    }

    fn preset(&self, name: &str) -> Result<&'a [u8], RonFault> {
        let names = PRESETS.map(|(name, _)| name);
        let preset = preset(name).ok_or_else(|| RonFault::unknown("preset for a material", name, &names))?;
        self.bytes(name, preset)
    }

    fn mesh(&self, name: &str) -> Result<&'a [u8], RonFault> {
        let import = obj::read(self.arena, &self.directory.join(name), &OpenOptions::default())
            .map_err(|error| failed(name, error))?;
        if import.is_moved {
            return Err(failed(
                name,
                "it lies or reaches farther than a scene, ±1e6; move it or make it smaller",
            ));
        }
        match import.scene.objects {
            [object] => match &object.shape {
                Shape::Mesh(mesh) => self.bytes::<Mesh<'_>>(name, mesh),
                _ => Err(failed(name, "its object is not a mesh")),
            },
            objects => Err(failed(
                name,
                format!(
                    "it has {} meshes, but must have one: give all faces one material and one group",
                    objects.len()
                ),
            )),
        }
    }

    fn image(&self, name: &str) -> Result<&'a [u8], RonFault> {
        let bytes = std::fs::read(self.directory.join(name)).map_err(|error| failed(name, error))?;
        let picture = Raster::decode(&bytes).map_err(|error| failed(name, error))?;
        let image = Image {
            // Larger images are refused.
            width: picture.width as u16,
            height: picture.height as u16,
            pixels: Pixels::Rgb888(&picture.rgb()),
            encoding: Encoding::Srgb,
            filter: Filter::Bilinear,
            ends: Ends::Repeat,
        };
        self.bytes(name, &image)
    }

    fn bytes<T: Serialize>(&self, name: &str, value: &T) -> Result<&'a [u8], RonFault> {
        let bytes = postcard::to_allocvec(value).map_err(|error| failed(name, error))?;
        Ok(self.arena.alloc_slice_copy(&bytes))
    }
}

/// The preset of this name.
fn preset(name: &str) -> Option<&'static Material<'static>> {
    PRESETS.iter().find(|(known, _)| *known == name).map(|(_, preset)| preset)
}

fn failed(name: &str, reason: impl ToString) -> RonFault {
    RonFault::Named { name: name.to_owned(), reason: reason.to_string() }
}
