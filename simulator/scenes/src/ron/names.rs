//! The items that names in a file stand for.

use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::path::PathBuf;

use bumpalo::Bump;
use erased_serde::Serialize;
use png::BitDepth;
use rayline::materials::{ALUMINUM, CHROMIUM, COPPER, DIAMOND, FLINT, GLASS, GOLD, ICE, IRON, SILVER, WATER};
use rayline::shape::Shape;
use rayline::{Encoding, Ends, Filter, Image, Material, Pixels};
use rayline_formats::files::Files;
use rayline_formats::raster::Indexed;
use rayline_formats::{ModelView, obj};

use super::RonFault;
use super::scan::object_names;

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
    files: &'a Files,
    /// The names of the file's own materials, with their numbers.
    materials: HashMap<String, usize>,
    /// The text of the file, where the names of its objects stand.
    text: &'a str,
    /// The names of the file's own objects, with their numbers: they are read when one is looked up.
    objects: OnceCell<HashMap<String, usize>>,
    /// A cache of the items that were found, by kind and name. Names are often used several times, and the
    /// file is read again if the memory was too small.
    found: RefCell<HashMap<(String, String), &'a [u8]>>,
    /// The fault of the last name that was not found.
    unknown: RefCell<Option<RonFault>>,
}

impl<'a> Known<'a> {
    pub(super) fn new(arena: &'a Bump, files: &'a Files, text: &'a str, materials: &[String]) -> Self {
        Self {
            arena,
            files,
            materials: numbered(materials),
            text,
            objects: OnceCell::new(),
            found: RefCell::default(),
            unknown: RefCell::default(),
        }
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
        let number = self.materials.get(name).copied();
        let number = number.ok_or_else(|| match preset(name) {
            Some(_) => RonFault::PresetInObject { name: name.to_owned() },
            None => RonFault::unknown("material in this file", name, &in_order(&self.materials)),
        })?;
        self.bytes(name, &u16::try_from(number).unwrap_or(u16::MAX))
    }

    fn own_object(&self, name: &str) -> Result<&'a [u8], RonFault> {
        let objects = match self.objects.get() {
            Some(objects) => objects,
            None => {
                let names = object_names(self.text).map_err(|error| RonFault::from_ron(error, None).1)?;
                self.objects.get_or_init(|| numbered(&names))
            }
        };
        let unknown = || RonFault::unknown("object in this file", name, &in_order(objects));
        let number = objects.get(name).ok_or_else(unknown)?;
        self.bytes(name, &u16::try_from(*number).unwrap_or(u16::MAX))
    }

    fn preset(&self, name: &str) -> Result<&'a [u8], RonFault> {
        let names = PRESETS.map(|(name, _)| name);
        let preset = preset(name).ok_or_else(|| RonFault::unknown("preset for a material", name, &names))?;
        self.bytes(name, preset)
    }

    fn mesh(&self, name: &str) -> Result<&'a [u8], RonFault> {
        let path = self.path(name)?;
        let import = obj::read_with(self.arena, &path, ModelView::default(), self.files)
            .map_err(|error| failed(name, error))?;
        if import.is_moved {
            return Err(failed(
                name,
                "it lies or reaches farther than a scene, ±1e6; move it or make it smaller",
            ));
        }
        match import.scene.objects {
            [object] => match &object.shape {
                Shape::Mesh(mesh) => self.bytes(name, mesh),
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
        let path = self.path(name)?;
        let bytes = self.files.read(&path).map_err(|error| failed(name, error))?;
        if let Some(Indexed { width, height, depth, indices, palette }) = Indexed::decode(&bytes) {
            self.files.take_pixels(width as usize * height as usize).map_err(|error| failed(name, error))?;
            let pixels = match depth {
                BitDepth::Four => Pixels::Palette4 { indices: &indices, palette: &palette },
                _ => Pixels::Palette8 { indices: &indices, palette: &palette },
            };
            return self.picture(name, (width, height), pixels);
        }
        let picture = self.files.decode(&bytes).map_err(|error| failed(name, error))?;
        self.picture(name, (picture.width, picture.height), Pixels::Rgb888(&picture.rgb()))
    }

    fn picture(
        &self,
        name: &str,
        (width, height): (u32, u32),
        pixels: Pixels<'_>,
    ) -> Result<&'a [u8], RonFault> {
        let image = Image {
            // Larger images are refused.
            width: width as u16,
            height: height as u16,
            pixels,
            encoding: Encoding::Srgb,
            filter: Filter::Bilinear,
            ends: Ends::Repeat,
        };
        self.bytes(name, &image)
    }

    /// The path of a file that the scene names.
    fn path(&self, name: &str) -> Result<PathBuf, RonFault> {
        self.files.reference(self.files.folder(), name).map_err(|error| failed(name, error))
    }

    fn bytes(&self, name: &str, value: &dyn Serialize) -> Result<&'a [u8], RonFault> {
        let bytes = postcard::to_allocvec(value).map_err(|error| failed(name, error))?;
        Ok(self.arena.alloc_slice_copy(&bytes))
    }
}

/// The names with their numbers; of names that occur several times, the first.
fn numbered(names: &[String]) -> HashMap<String, usize> {
    let mut numbers = HashMap::new();
    for (number, name) in names.iter().enumerate() {
        numbers.entry(name.clone()).or_insert(number);
    }
    numbers
}

/// The names in the order of their numbers.
fn in_order(names: &HashMap<String, usize>) -> Vec<&str> {
    let mut names: Vec<_> = names.iter().map(|(name, number)| (number, name.as_str())).collect();
    names.sort_unstable();
    names.into_iter().map(|(_, name)| name).collect()
}

/// The preset of this name.
fn preset(name: &str) -> Option<&'static Material<'static>> {
    PRESETS.iter().find(|(known, _)| *known == name).map(|(_, preset)| preset)
}

fn failed(name: &str, reason: impl ToString) -> RonFault {
    RonFault::Named { name: name.to_owned(), reason: reason.to_string() }
}
