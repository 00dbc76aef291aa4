//! Tests with small files, valid and broken, that are written here.

mod broken;
mod geometry;
mod materials;
mod properties;
mod seen;

use std::fs;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use bumpalo::Bump;
use rayline::Part;
use rayline::shape::{Mesh, Shape};
use rayline_formats::OpenOptions;
use rayline_formats::gltf::{Import, read};
use serde_json::{Value, json};

use crate::check;

/// The corners of a cube from -1/2 to 1/2. Bit 0 of a corner's index selects x, bit 1 y, bit 2 z.
pub(super) fn corners() -> Vec<[f32; 3]> {
    (0..8u8).map(|corner| [0, 1, 2].map(|axis| f32::from(corner >> axis & 1) - 0.5)).collect()
}

/// The triangles of the cube, with their fronts outside.
const CUBE: [[u16; 3]; 12] = [
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
];

/// A buffer that is built of lists, each with a view and an accessor of the same index.
#[derive(Default)]
pub(super) struct Lists {
    pub(super) bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Lists {
    pub(super) fn floats<const N: usize>(self, list: &[[f32; N]]) -> Self {
        let bytes: Vec<u8> = list.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect();
        self.list(&bytes, json!({ "componentType": 5126, "count": list.len(), "type": format!("VEC{N}") }))
    }

    pub(super) fn corners(self, list: &[u16]) -> Self {
        let bytes: Vec<u8> = list.iter().flat_map(|number| number.to_le_bytes()).collect();
        self.list(&bytes, json!({ "componentType": 5123, "count": list.len(), "type": "SCALAR" }))
    }

    pub(super) fn list(mut self, bytes: &[u8], accessor: Value) -> Self {
        while !self.bytes.len().is_multiple_of(4) {
            self.bytes.push(0);
        }
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend_from_slice(bytes);
        self.accessors.push(accessor);
        let last = self.accessors.len() - 1;
        self.accessors[last]["bufferView"] = json!(last);
        self
    }

    /// A file of one node with one mesh of one primitive.
    pub(super) fn file(&self, primitive: Value) -> Value {
        json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "name": "Box", "mesh": 0 }],
            "meshes": [{ "name": "Cube", "primitives": [primitive] }],
            "buffers": [{ "uri": uri(&self.bytes), "byteLength": self.bytes.len() }],
            "bufferViews": self.views,
            "accessors": self.accessors,
        })
    }
}

pub(super) fn uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", BASE64_STANDARD.encode(bytes))
}

pub(super) fn cube_lists() -> Lists {
    Lists::default().floats(&corners()).corners(CUBE.as_flattened())
}

/// A file with a red cube.
pub(super) fn cube() -> Value {
    let mut file = cube_lists().file(json!({ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }));
    file["materials"] = json!([{
        "name": "Red",
        "pbrMetallicRoughness": { "baseColorFactor": [0.8, 0.1, 0.1, 1.0], "metallicFactor": 0 },
    }]);
    file
}

/// Writes a file of this name and these bytes to a temporary folder, and reads it.
pub(super) fn with_bytes<T>(
    name: &str,
    bytes: &[u8],
    look: impl FnOnce(Result<Import<'_>, String>) -> T,
) -> T {
    with_options(name, bytes, &OpenOptions::default(), look)
}

pub(super) fn with_options<T>(
    name: &str,
    bytes: &[u8],
    options: &OpenOptions,
    look: impl FnOnce(Result<Import<'_>, String>) -> T,
) -> T {
    let arena = Bump::new();
    look(import(&arena, name, bytes, options))
}

fn import<'a>(
    arena: &'a Bump,
    name: &str,
    bytes: &[u8],
    options: &OpenOptions,
) -> Result<Import<'a>, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    let clean = |text: &str| text.replace(&format!("{}/", folder.path().display()), "");
    let mut import = read(arena, &path, options).map_err(|error| clean(&error.to_string()))?;
    import.notes.iter_mut().for_each(|note| *note = clean(note));
    Ok(import)
}

pub(super) fn with_file<T>(file: &Value, look: impl FnOnce(Import<'_>) -> T) -> T {
    with_bytes("model.gltf", file.to_string().as_bytes(), |import| look(import.unwrap()))
}

pub(super) fn refusal(file: &Value) -> String {
    with_bytes("model.gltf", file.to_string().as_bytes(), |import| import.map(|_| ()).unwrap_err())
}

/// The notes, without those about camera and light.
pub(super) fn notes(file: &Value) -> Vec<String> {
    with_file(file, |import| {
        let is_said = |note: &String| !note.contains(": no camera: ") && !note.contains(": no light: ");
        import.notes.into_iter().filter(is_said).collect()
    })
}

pub(super) fn mesh<'a>(import: &Import<'a>, index: usize) -> Mesh<'a> {
    let Shape::Mesh(mesh) = import.scene.objects[index].shape else { unreachable!("only meshes are read") };
    mesh
}

/// A binary file of these chunks.
pub(super) fn binary(chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut content = Vec::new();
    for (kind, bytes) in chunks {
        let padding = bytes.len().next_multiple_of(4) - bytes.len();
        content.extend(((bytes.len() + padding) as u32).to_le_bytes());
        content.extend(*kind);
        content.extend(*bytes);
        content.extend(core::iter::repeat_n(if *kind == b"JSON" { b' ' } else { 0 }, padding));
    }
    let header = [u32::from_le_bytes(*b"glTF"), 2, content.len() as u32 + 12];
    let mut file: Vec<u8> = header.iter().flat_map(|word| word.to_le_bytes()).collect();
    file.append(&mut content);
    file
}

/// The cube as a binary file.
pub(super) fn binary_cube() -> Vec<u8> {
    let mut file = cube();
    file["buffers"][0].as_object_mut().unwrap().remove("uri");
    binary(&[(b"JSON", file.to_string().as_bytes()), (b"BIN\0", &cube_lists().bytes)])
}
