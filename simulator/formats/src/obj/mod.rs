//! Reading of models in Wavefront OBJ with materials in MTL (Wavefront Technologies, "Advanced Visualizer
//! Manual", 1990, appendices B and C). The crate `tobj` assembles the meshes.
//!
//! The statements of a file become:
//!
//! - `v`, `vn`: vertices; normals, if all corners of a mesh have one.
//! - `vt`: u and v, if all corners of a mesh have them and none is beyond ±59.
//! - `f`: triangles; a face with more corners becomes a fan around its first corner.
//! - `o`, `g`, `usemtl`: each begins a new mesh; one of more than 65535 vertices or triangles becomes
//!   several.
//! - `mtllib`: the materials of that file.
//!
//! Smoothing groups, lines, points and free-form surfaces are left out. OBJ files have no camera and no
//! lights, so both are added. [`Import::notes`] lists what was added and left out.
//!
//! # Materials
//! - `Kd`: the color; `diffuse` is 1.
//! - `Ks`: the mean of the three is the strength of the highlight, and the reflectance if `illum` is 3 to 7.
//! - `Ns`: the exponent of the highlight; without `Ns` there is no highlight.
//! - `d`, or `Tr` = 1 - `d`: the transmittance is 1 - `d`; ambient, diffuse and reflectance are multiplied by
//!   `d`.
//! - `Ni`: the index of refraction, if the transmittance is not 0.
//! - `Ke`: if it is not black, the color, with `ambient` 1 and `diffuse` 0.
//!
//! The ambient coefficient is 0.1, because the single added light leaves half of the model dark. `Ka` and
//! textures (`map_…`) are left out.

mod error;
mod materials;
mod statements;
#[cfg(test)]
mod tests;

use std::collections::HashSet;
use std::path::Path;

use bumpalo::Bump;
use rayline::limits::MAX_COUNT;
use rayline::shape::{Mesh, Shape};
use rayline::{Object, Part, Scene, Vec3};
use tobj::LoadOptions;

use crate::OpenOptions;
use crate::files::Files;
use crate::model::{FARTHEST_UV, ModelView, Whole, view};
use crate::text;

pub use error::{ObjError, ObjFault};
use statements::Statements;

/// A scene that was read from a file.
#[derive(Clone, Debug)]
pub struct Import<'a> {
    /// The scene; it is checked when it is prepared.
    pub scene: Scene<'a>,
    /// The width and height of the picture, in pixels.
    pub resolution: (u32, u32),
    /// Notes about everything that was added to the contents of the file, or left out.
    pub notes: Vec<String>,
    /// The name in the file of each object's mesh.
    names: Vec<String>,
}

impl Import<'_> {
    /// The name of this part of the scene in the file, for errors of the scene. `None` for a part without a
    /// name.
    pub fn name_of(&self, part: Part) -> Option<&str> {
        match part {
            Part::Object(index) => self.names.get(index).map(String::as_str),
            _ => None,
        }
    }
}

/// Reads a scene from an OBJ file and the MTL files that it refers to. Its lists are kept in `arena`.
///
/// # Errors
/// A file cannot be read, or a line breaks the grammar. A missing MTL file is not an error: it gives a
/// [note](Import::notes).
pub fn read<'a>(arena: &'a Bump, path: &Path, options: &OpenOptions) -> Result<Import<'a>, ObjError> {
    read_with(arena, path, options.view, &Files::new(path, options.allow_paths))
}

/// Reads a scene by the reader of its files. `path` may be a file that the scene refers to.
pub(crate) fn read_with<'a>(
    arena: &'a Bump,
    path: &Path,
    view: ModelView,
    files: &Files,
) -> Result<Import<'a>, ObjError> {
    let error = |fault| ObjError { path: path.to_owned(), line: None, fault };
    let text = text_of(path, files)?;
    let statements = Statements::new(&text).map_err(|error| error.of(path))?;
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let library = materials::read(folder, &statements.libraries, files)?;

    let mut notes = library.notes;
    note_left_out(&statements, &library.names, path, &mut notes);

    let load_options = LoadOptions { single_index: true, triangulate: true, ..LoadOptions::default() };
    let load_materials = |_: &Path| tobj::load_mtl_buf(&mut library.text.as_bytes());
    let (models, loaded) = tobj::load_obj_buf(&mut statements.text.as_bytes(), &load_options, load_materials)
        .map_err(|reason| error(ObjFault::Refused(reason)))?;
    let loaded = loaded.map_err(|reason| error(ObjFault::Refused(reason)))?;

    let mut materials: Vec<_> = loaded.iter().map(materials::material).collect();
    // The last material is for meshes without one.
    materials.push(materials::GRAY);
    let (mut objects, mut names) = (Vec::new(), Vec::new());
    for tobj::Model { mesh, name } in &models {
        let meshes = meshes(arena, mesh, name, &mut notes);
        for mesh_of_piece in meshes {
            let material = mesh.material_id.unwrap_or(materials.len().saturating_sub(1));
            let material = u16::try_from(material)
                .map_err(|_| error(ObjFault::TooManyMaterials { given: materials.len(), most: MAX_COUNT }))?;
            objects.push(Object::new(Shape::Mesh(mesh_of_piece), material));
            names.push(name.clone());
        }
    }
    let bounds = view::bounds(&objects).ok_or_else(|| error(ObjFault::NoFaces))?;
    let (path, seen, lit) = (path.display(), view.note(), view::LIT);
    notes.push(format!("{path}: OBJ files have no camera and no lights; {seen}, {lit}"));
    let camera = view.camera(bounds);
    let scene = Scene {
        camera,
        background: view.background(arena),
        objects: arena.alloc_slice_copy(&objects),
        materials: arena.alloc_slice_copy(&materials),
        lights: arena.alloc_slice_copy(&view::lights(&camera)),
        motions: &[],
    };
    Ok(Import { scene, resolution: view::SIZE, notes, names })
}

/// Adds notes about unknown materials and about statements that are left out.
fn note_left_out(statements: &Statements, known: &[String], path: &Path, notes: &mut Vec<String>) {
    let unknown = statements.materials.iter().filter(|(_, name)| !known.contains(name));
    let mut said = HashSet::new();
    for (line, name) in unknown {
        if said.insert(name) {
            notes.push(format!(
                "{}:{line}: there is no material `{}`; it is gray",
                path.display(),
                name.escape_debug()
            ));
        }
    }
    for (keyword, line) in &statements.left_out {
        notes.push(format!("{}:{line}: `{keyword}` is left out, here and below", path.display()));
    }
}

/// Converts a mesh of `tobj`, with notes about normals and texture coordinates that are left out.
fn meshes<'a>(arena: &'a Bump, mesh: &tobj::Mesh, name: &str, notes: &mut Vec<String>) -> Vec<Mesh<'a>> {
    let vertices = vectors(&mesh.positions);
    let normals = vectors(&mesh.normals);
    let is_smooth = !normals.is_empty() && normals.len() == vertices.len();
    if !normals.is_empty() && !is_smooth {
        notes.push(format!("`{}`: not all of its corners have a normal, so it is flat", name.escape_debug()));
    }
    let (uvs, _) = mesh.texcoords.as_chunks::<2>();
    let is_far = |uv: &[f32; 2]| uv.iter().any(|coordinate| coordinate.abs() > FARTHEST_UV);
    let flaw = if uvs.len() != vertices.len() {
        Some("not all of its corners have them")
    } else if uvs.iter().any(is_far) {
        Some("some are beyond ±59")
    } else {
        None
    };
    if let Some(flaw) = flaw
        && !uvs.is_empty()
    {
        notes.push(format!("`{}`: texture coordinates are left out: {flaw}", name.escape_debug()));
    }
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    let whole = Whole {
        vertices: &vertices,
        triangles,
        normals: is_smooth.then_some(&normals),
        uvs: flaw.is_none().then_some(uvs),
        colors: None,
    };
    whole.meshes(arena)
}

/// The text of a file.
fn text_of(path: &Path, files: &Files) -> Result<String, ObjError> {
    let error = |line, fault| ObjError { path: path.to_owned(), line, fault };
    let bytes = files.read(path).map_err(|reason| error(None, ObjFault::Unreadable(reason.to_string())))?;
    text::of_bytes(&bytes).map(str::to_owned).map_err(|line| error(Some(line), ObjFault::NotUtf8))
}

fn vectors(numbers: &[f32]) -> Vec<Vec3> {
    let (vectors, _) = numbers.as_chunks::<3>();
    vectors.iter().map(|[x, y, z]| Vec3::new(*x, *y, *z)).collect()
}
