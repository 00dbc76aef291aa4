//! Reading of models in Wavefront OBJ with materials in MTL (Wavefront Technologies, "Advanced Visualizer
//! Manual", 1990, appendices B and C).
//!
//! The statements of a file become:
//!
//! - `v`, `vn`: vertices and normals. In a mesh with normals, a corner without one gets that of its smoothing
//!   group or of its face. A model that lies or reaches beyond ±1e6 is moved to the origin and made smaller.
//! - `s`: the smoothing group of corners without `vn`: the normal of a vertex is the mean of those of the
//!   group's faces there, weighted by angle. `s off` and `s 0`: flat.
//! - `vt`: u and v, if all corners of a mesh have them; reduced by whole numbers where they are beyond ±59.
//! - `f`: triangles. A convex face becomes a fan around its first corner; from others, ears are cut. Faces
//!   may come before their vertices.
//! - `o`, `g`, `usemtl`: each begins a new mesh; one of more than 65535 vertices or triangles becomes
//!   several.
//! - `mtllib`: the materials of that file, which is in the folder of the OBJ file or below. Backslashes are
//!   slashes, and letters may have another case.
//! - `v` with three or four more numbers: the last three are the color of the vertex, as codes of sRGB from 0
//!   to 255 or divided by 255, by which the color of the material is multiplied (white without a material).
//!
//! Lines that are not UTF-8 are Latin-1. Lines, points and free-form surfaces are left out, and so are lines
//! without their numbers. OBJ files have no camera and no lights, so both are added,
//! and a sky. [`Import::notes`] lists what was added and left out.
//!
//! # Materials
//! - `Kd`: the color; `diffuse` is 1.
//! - `Ks`: the mean of the three is the strength of the highlight, and the reflectance if `illum` is 3 to 7.
//! - `Ns`: the exponent of the highlight; without `Ns` there is no highlight.
//! - `d`: the transmittance is 1 - `d`; ambient, diffuse and reflectance are multiplied by `d`.
//! - `Tr`: as `d` = 1 - `Tr`, if there is no `d` and `illum` is 4, 6, 7 or 9, or is missing and `Tr` is below
//!   1; otherwise the surface is opaque, as many programs write `Tr 1` for that.
//! - `Ni`: the index of refraction, if the transmittance is not 0.
//! - `Ke`: the emission, at most 100.
//! - `map_Kd`: an image on the surface, times `Kd`.
//! - `map_Ks`: the highlight and the reflectance are multiplied by its brightness.
//! - `map_d`: the opacity is multiplied by that of the picture, or by its brightness if it is opaque; such a
//!   surface neither refracts nor mirrors.
//! - `map_Bump`, `bump`: a bump map, whose height is twice the width of a pixel for `-bm 1`.
//! - `norm`, and `map_Bump` with a picture that is bluish: a normal map.
//! - options of maps: `-s`, `-o`, `-clamp` and `-bm`. Pictures are PNG, JPEG or PPM files in the folder of
//!   the MTL file or below.
//!
//! The ambient coefficient is 0.1. `Ka`, `Tf` and other maps are left out. If all of a model would be
//! invisible, it is opaque.

mod assembly;
mod error;
mod library;
mod lines;
mod materials;
mod statements;

use std::collections::HashSet;
use std::path::Path;

use bumpalo::Bump;
use rayline::limits::MAX_COUNT;
use rayline::shape::Shape;
use rayline::{Object, Part, Scene};

use crate::OpenOptions;
use crate::files::Files;
use crate::model::{ModelView, Moved, view};
use crate::nff::Excerpt;
use crate::notes::Notes;
use assembly::{Faces, Group};
pub use error::{ObjError, ObjFault};
use library::Library;
use materials::Materials;
use statements::Contents;

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
    /// Whether the model was moved or scaled, because it lies or reaches too far.
    pub is_moved: bool,
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
/// The file cannot be read, or a line breaks the grammar in a way that would give a wrong picture. A missing
/// MTL file is not an error: it gives a [note](Import::notes).
pub fn read<'a>(arena: &'a Bump, path: &Path, options: &OpenOptions) -> Result<Import<'a>, ObjError> {
    read_with(arena, path, options.view, arena.alloc(Files::new(path, options.allow_paths)))
}

/// Reads a scene by the reader of its files. `path` may be a file that the scene refers to.
pub fn read_with<'a>(
    arena: &'a Bump,
    path: &Path,
    view: ModelView,
    files: &'a Files,
) -> Result<Import<'a>, ObjError> {
    let error = |line, fault| ObjError { path: path.to_owned(), line, fault };
    let bytes = files.read(path);
    let bytes = bytes.map_err(|reason| error(None, ObjFault::Unreadable(reason.to_string())))?;
    let (called, mut notes) = (path.display().to_string(), Notes::default());
    let contents = Contents::read(&bytes, &called, &mut notes).map_err(|error| error.of(path))?;
    drop(bytes);
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let library = Library::read(files, folder, &contents.libraries, &called, &mut notes);
    let materials = Materials::new(arena, files, library);
    let faces = Faces::new(&contents, &called, &mut notes).map_err(|error| error.of(path))?;
    let is_moved = faces.moved != Moved::NOT;
    if let Some(moved) = faces.moved.note() {
        notes.add(&*called, moved);
    }
    let mut meshes =
        Meshes { arena, materials, objects: Vec::new(), names: Vec::new(), notes, path: &called };
    meshes.add_all(&contents, &faces).map_err(|fault| error(None, fault))?;
    let Meshes { mut materials, objects, names, mut notes, .. } = meshes;
    let bounds = view::bounds(&objects).ok_or_else(|| error(None, ObjFault::NoFaces))?;
    materials.show(&mut notes, &called);
    let (seen, lit) = (view.note(), view::LIT);
    notes.add(&*called, format!("OBJ files have no camera and no lights; {seen}, {lit}"));
    let camera = view.camera(bounds);
    let scene = Scene {
        camera,
        background: view.background(arena),
        objects: arena.alloc_slice_copy(&objects),
        materials: arena.alloc_slice_copy(&materials.all),
        lights: arena.alloc_slice_copy(&view::lights(&camera)),
        motions: &[],
    };
    Ok(Import { scene, resolution: view::SIZE, notes: notes.lines(), names, is_moved })
}

/// The state for assembling the meshes of a file.
struct Meshes<'s, 'a> {
    arena: &'a Bump,
    materials: Materials<'a>,
    objects: Vec<Object<Shape<'a>>>,
    /// The name in the file of each object.
    names: Vec<String>,
    notes: Notes,
    path: &'s str,
}

impl Meshes<'_, '_> {
    fn add_all(&mut self, contents: &Contents, faces: &Faces<'_>) -> Result<(), ObjFault> {
        let mut unknown = HashSet::new();
        for group in faces.groups() {
            let name = group.material.and_then(|index| contents.materials.get(index as usize));
            let material = name.and_then(|(_, name)| self.materials.find(name));
            if let Some((line, name)) = name
                && material.is_none()
                && !name.is_empty()
                && unknown.insert(name)
            {
                let part = format!("{}:{line}: `{}`", self.path, Excerpt(name));
                self.notes.add(part, "there is no such material; it is gray");
            }
            let (has_texture, repeats) = self.materials.textures(material);
            // Only faces with texture coordinates show a texture.
            let groups = if has_texture { faces.split(group).to_vec() } else { vec![group] };
            for group in groups {
                self.add(faces, &group, material, repeats)?;
            }
        }
        Ok(())
    }

    fn add(
        &mut self,
        faces: &Faces<'_>,
        group: &Group,
        material: Option<usize>,
        repeats: bool,
    ) -> Result<(), ObjFault> {
        let assembled = faces.assemble(group, repeats, &mut self.notes);
        let meshes = assembled.whole().meshes(self.arena);
        if meshes.is_empty() {
            return Ok(());
        }
        let material =
            self.materials.id(material, assembled.is_colored(), assembled.length_of_uv(), &mut self.notes);
        let material = u16::try_from(material)
            .map_err(|_| ObjFault::TooManyMaterials { given: material.saturating_add(1), most: MAX_COUNT })?;
        for mesh in meshes {
            self.objects.push(Object::new(Shape::Mesh(mesh), material));
            self.names.push(group.name.clone());
        }
        Ok(())
    }
}
