//! Models in Wavefront OBJ with materials in MTL, as modeling programs write them (Wavefront Technologies, "Advanced Visualizer
//! Manual", 1990, appendices B and C). The crate `tobj` puts the meshes together.
//!
//! What a file says becomes:
//!
//! | in the file | in the scene |
//! |---|---|
//! | `v`, `vn` | vertices; normals, where all corners of a mesh have one, make it smooth |
//! | `vt` | the first two numbers are u and v, where all corners of a mesh have them and none is beyond ±59 |
//! | `f` | triangles; of more corners, the fan around the first |
//! | `o`, `g`, `usemtl` | each stretch of one of these is a mesh; one of more than 65535 vertices or triangles, several |
//! | `mtllib` | the materials of that file |
//!
//! Smoothing groups, lines, points and free-form surfaces are left out. There is no camera in such a file and no
//! light, so they are added. [`Import::notes`] say what was added and left out.
//!
//! # Materials
//! | in the file | in the scene |
//! |---|---|
//! | `Kd` | the color, shown in full by lights |
//! | `Ks` | the strength of the highlight, the mean of the three; and the reflectance, if `illum` is 3 to 7 |
//! | `Ns` | the exponent of the highlight; without, there is none |
//! | `d`, or `Tr` = 1 - `d` | the transmittance, 1 - `d`; what is diffuse and reflected gives way to it |
//! | `Ni` | the index of refraction, where there is any transmittance |
//! | `Ke` | where it is not black, the color, seen without any light |
//!
//! A tenth of the color is ambient, as the one light that such a scene gets leaves half of it in the dark. `Ka` and textures (`map_…`)
//! are left out.

mod error;
mod materials;
mod statements;
#[cfg(test)]
mod tests;

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use bumpalo::Bump;
use rayline::limits::MAX_COUNT;
use rayline::shape::Shape;
use rayline::{Object, Part, Scene, Vec3};
use tobj::LoadOptions;

use crate::model::{FARTHEST_UV, Whole, view};
use crate::text;

pub use error::{ObjError, ObjFault};
use statements::Statements;

/// A scene that was read from a file.
#[derive(Clone, Debug)]
pub struct Import<'a> {
    /// The scene; it is checked when it is prepared.
    pub scene: Scene<'a>,
    /// Width and height of the picture that the camera frames.
    pub resolution: (u32, u32),
    /// What was added to the file's, and what was left out.
    pub notes: Vec<String>,
    /// What the file calls the mesh that each object is made of.
    names: Vec<String>,
}

impl Import<'_> {
    /// What the file calls this part of the scene, where to look when the scene is refused. `None` for what is not in the file.
    pub fn name_of(&self, part: Part) -> Option<&str> {
        match part {
            Part::Object(index) => self.names.get(index).map(String::as_str),
            _ => None,
        }
    }
}

/// Reads a scene from an OBJ file and the MTL files that it names. Its lists are kept in `arena`.
///
/// # Errors
/// The file that cannot be read, or the first line that breaks the grammar, and what was expected there. An MTL file that does not
/// exist is no error but a [note](Import::notes).
pub fn read<'a>(arena: &'a Bump, path: &Path) -> Result<Import<'a>, ObjError> {
    let error = |fault| ObjError { path: path.to_owned(), line: None, fault };
    let text = text_of(path)?;
    let statements = Statements::new(&text).map_err(|error| error.of(path))?;
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let library = materials::read(folder, &statements.libraries)?;

    let mut notes = library.notes;
    let unknown: Vec<_> =
        statements.materials.iter().filter(|(_, name)| !library.names.contains(name)).collect();
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

    let options = LoadOptions { single_index: true, triangulate: true, ..LoadOptions::default() };
    let load_materials = |_: &Path| tobj::load_mtl_buf(&mut library.text.as_bytes());
    let (models, loaded) = tobj::load_obj_buf(&mut statements.text.as_bytes(), &options, load_materials)
        .map_err(|reason| error(ObjFault::Refused(reason)))?;
    let loaded = loaded.map_err(|reason| error(ObjFault::Refused(reason)))?;

    let mut materials: Vec<_> = loaded.iter().map(materials::material).collect();
    // For what names none.
    materials.push(materials::GRAY);
    let (mut objects, mut names) = (Vec::new(), Vec::new());
    for tobj::Model { mesh, name } in &models {
        let vertices = vectors(&mesh.positions);
        let normals = vectors(&mesh.normals);
        let is_smooth = !normals.is_empty() && normals.len() == vertices.len();
        if !normals.is_empty() && !is_smooth {
            notes
                .push(format!("`{}`: not all of its corners have a normal; it is flat", name.escape_debug()));
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
        };
        for mesh_of_piece in whole.meshes(arena) {
            let material = mesh.material_id.unwrap_or(materials.len().saturating_sub(1));
            let material = u16::try_from(material)
                .map_err(|_| error(ObjFault::TooManyMaterials { given: materials.len(), most: MAX_COUNT }))?;
            objects.push(Object::new(Shape::Mesh(mesh_of_piece), material));
            names.push(name.clone());
        }
    }
    let bounds = view::bounds(&objects).ok_or_else(|| error(ObjFault::NoFaces))?;
    let (path, seen, lit) = (path.display(), view::SEEN, view::LIT);
    notes.push(format!("{path}: no camera and no light in such a file; {seen}, {lit}"));
    let scene = Scene {
        camera: view::of(bounds),
        background: view::BACKGROUND,
        objects: arena.alloc_slice_copy(&objects),
        materials: arena.alloc_slice_copy(&materials),
        lights: &view::LIGHTS,
    };
    Ok(Import { scene, resolution: view::SIZE, notes, names })
}

/// The text of a file.
fn text_of(path: &Path) -> Result<String, ObjError> {
    let error = |line, fault| ObjError { path: path.to_owned(), line, fault };
    let bytes = fs::read(path).map_err(|reason| error(None, ObjFault::Unreadable(reason.to_string())))?;
    text::of_bytes(&bytes).map(str::to_owned).map_err(|line| error(Some(line), ObjFault::NotUtf8))
}

fn vectors(numbers: &[f32]) -> Vec<Vec3> {
    let (vectors, _) = numbers.as_chunks::<3>();
    vectors.iter().map(|[x, y, z]| Vec3::new(*x, *y, *z)).collect()
}
