//! Reading of models and scenes in glTF 2.0, `.gltf` and `.glb` (The Khronos Group, "glTF 2.0 Specification",
//! 2021; ISO/IEC 12113).
//!
//! The parts of a file become:
//!
//! - `scene`: the scene to read; without it the first scene, and without scenes, or if the scene has no
//!   nodes, all nodes.
//! - nodes: transforms of their meshes, cameras and lights; a mirroring node reverses its triangles, so that
//!   their fronts stay outside.
//! - a primitive of a mesh, at a node: a mesh; one of more than 65535 vertices or triangles becomes several.
//!   A mesh of 256 vertices or more is held once for all nodes that draw it in one size, turned and moved, as
//!   instances. Of several nodes that draw a mesh in the same place, one is drawn.
//! - triangles, strips, fans: triangles; points and lines are left out, and so is a primitive without
//!   `POSITION`.
//! - skins: the mesh at rest. Each vertex is moved by its joints and their `inverseBindMatrices`; the
//!   transform of the mesh's own node does not count.
//! - morph targets: the mesh with the default weights, those of the node, else those of the mesh.
//! - `NORMAL`: smooth normals; a mesh without them is flat.
//! - `TEXCOORD_n`: u and 1 - v, since v grows downward in glTF; n is that of the base color texture, else of
//!   the metallic-roughness texture, else 0; transformed by `KHR_texture_transform`. Coordinates beyond ±59
//!   are moved by whole repetitions of the texture, and if they are still beyond, they are divided by a power
//!   of two, and the texture is as many times smaller.
//! - `COLOR_0`: colors of vertices, by which the color of the material is multiplied; their opacity is left
//!   out.
//! - the first perspective camera of the nodes: the camera; `aspectRatio` becomes width over height of the
//!   picture.
//! - `KHR_lights_punctual`: directional lights, and lamps with inverse-square falloff; see below.
//! - a scene that lies or reaches beyond ±1e6: moved to the origin and made smaller, with its cameras and
//!   lights.
//! - buffers, images: read from the file itself, from `data:` URIs, and from files in its folder or below,
//!   but from no other place. An image that is elsewhere, or cannot be read, is left out.
//! - `KHR_node_visibility`: meshes of invisible nodes are left out.
//!
//! A missing camera or light is added, and a sky. Animations, other cameras, other scenes and all
//! extensions that are not named here are left out, and so are normals and texture coordinates of another
//! number than positions. [`Import::notes`] lists what was added and left out. A file is refused if it
//! requires an unknown extension, unless the scene at rest looks the same without it, or the extension is one
//! of materials or of the format of pictures.
//!
//! Whole numbers may be written with a point, as `5126.0`, and parts that are not there as `null`.
//!
//! # Materials
//! - `baseColorFactor`: the color, in linear light.
//! - `baseColorTexture`: an image on the surface, times the factor; bilinear unless `magFilter` is `NEAREST`;
//!   wrapped by `wrapS` and `wrapT`. Materials share it, and it takes a byte a pixel for up to 256 colors,
//!   else three.
//! - `metallicFactor`: 0.5 or more: a metal, which mirrors in its color by Schlick's
//!   approximation. Below 0.5: the color is diffuse, under a clear coat that mirrors by Fresnel's equations.
//! - `roughnessFactor`: reflections are sharp in Rayline, so the reflectance is 1 - 2 roughness, and 0 from
//!   0.5 on; the rest of a metal's reflectance is diffuse.
//! - the highlight: Blinn's exponent n = 2 / roughness⁴ - 2, at most 2000; its strength (1 - roughness) f n /
//!   8, at most 1 - roughness, where f is 1 for metals, else the coat's reflectance at normal incidence; none
//!   below 1/256.
//! - `metallicRoughnessTexture`: where its texels differ, maps of the coefficients: the diffuse factor is 1 -
//!   metallic (1 - 2 roughness), and a metal mirrors as much at any angle, in the mean color. Else its mean,
//!   times the factors; the mean is also used, with a note, with transparency, glass or a clear coat, and on
//!   other texture coordinates than those of the base color.
//! - `emissiveFactor`, `emissiveTexture`, `KHR_materials_emissive_strength`: the emission, at most 100, and
//!   its map; on other texture coordinates than those of the mesh, the mean of the texture.
//! - `normalTexture`: a normal map of strength `scale`; left out on other texture coordinates.
//! - `KHR_materials_transmission`: glass: the factor is the transmittance. Each surface has the square root
//!   of the color, so that light gets the color on its way in and out. Without `KHR_materials_volume`, or
//!   with a thickness of 0, each surface is a thin sheet: it does not refract, and has the whole color.
//! - `KHR_materials_ior`: the index of refraction; 1.5 without the extension.
//! - `KHR_materials_volume`: absorption in glass, from distance and color.
//! - `KHR_materials_unlit`: the color, with `ambient` 1 and `diffuse` 0.
//! - `KHR_materials_clearcoat`: the stronger reflection and highlight of coat and surface. A rough metal
//!   below a coat is diffuse. Of textures the mean is used; on a smooth metal the coat is left out.
//! - `KHR_materials_specular`: factors of the reflection and the highlight of a surface that is no metal.
//! - `KHR_materials_pbrSpecularGlossiness`: the diffuse color and texture are the base color. A specular
//!   color up to 0.2 is a coat of that strength, a larger one a metal of that color over what is left of the
//!   diffuse color; of the specular-glossiness texture, the mean. Without a specular color, it is 0.04.
//! - `alphaMode`: `BLEND`: the surface is transparent by 1 - alpha, without refraction and reflection.
//!   `MASK`: it is opaque or fully transparent, with sharp edges between the texels of a texture.
//! - `doubleSided`: without it, an opaque mesh is seen from the front only, and throws shadows from both
//!   sides. A closed mesh with its fronts outside shows no backs, and is not marked.
//!
//! The ambient coefficient is a tenth of the diffuse one, as in [`obj`](crate::obj). Occlusion and
//! transmission textures are left out.
//!
//! # Lights
//! Files measure light in lux and candela, but do not define how bright the picture is. So all lights are
//! multiplied by one factor, which a note states. The factor comes from a coarse picture of some 3000 pixels:
//! of the pixels that the lights reach, one in 100 becomes brighter than 0.9 of white. Pixels that are
//! brighter than half of white without the lights do not count. The lights become at most four times as
//! bright as by the rule below, so that dark materials stay dark.
//!
//! Where the camera sees nothing that the lights reach, and with an [exposure](crate::OpenOptions::exposure),
//! the factor is chosen for the illuminances of a surface that faces each light in the middle of the scene (a
//! lamp counts as at least half the diagonal of the scene away): the root of the sum of their squares becomes
//! white.

mod accessor;
mod buffers;
mod cameras;
mod container;
mod error;
mod finish;
mod geometry;
mod json;
mod lights;
mod materials;
mod nodes;
mod reach;
mod skins;
mod textures;

use std::collections::{HashMap, HashSet};
use std::path::Path;

use bumpalo::Bump;
use rayline::limits::MAX_COUNT;
use rayline::shape::{Instances, Model, Pose, Shape};
use rayline::{Object, Part, Scene};

use crate::OpenOptions;
use crate::files::Files;
use crate::model::view;
use crate::notes::Notes;
use accessor::{Lists, MOST};
use buffers::Buffers;
use error::{At, Wrong, find, name};
pub use error::{GltfError, GltfFault};
use geometry::{Geometry, Posture};
use materials::Materials;
use nodes::{Place, Placed};
use skins::Skins;
use textures::Textures;

/// A scene that was read from a file.
#[derive(Clone, Debug)]
pub struct Import<'a> {
    /// The scene; it is checked when it is prepared.
    pub scene: Scene<'a>,
    /// The width and height of the picture, in pixels.
    pub resolution: (u32, u32),
    /// Notes about everything that was added to the contents of the file, or left out.
    pub notes: Vec<String>,
    names: Names,
}

/// The names of the parts of the scene in the file.
#[derive(Clone, Debug, Default)]
struct Names {
    camera: Option<String>,
    objects: Vec<String>,
    materials: Vec<String>,
    lights: Vec<String>,
}

impl Import<'_> {
    /// The name of this part of the scene in the file, for errors of the scene. `None` for a part that is not
    /// in the file.
    pub fn name_of(&self, part: Part) -> Option<&str> {
        let name = match part {
            Part::Camera => self.names.camera.as_ref(),
            Part::Object(index) => self.names.objects.get(index),
            Part::Material(index) => self.names.materials.get(index),
            Part::Light(index) => self.names.lights.get(index),
            _ => None,
        };
        name.map(String::as_str)
    }
}

/// Reads a scene from a `.gltf` or `.glb` file and the files that it refers to. Its lists are kept in
/// `arena`.
///
/// # Errors
/// A file cannot be read, or a part of it is wrong. An image that does not exist or has another format is not
/// an error: it gives a [note](Import::notes).
pub fn read<'a>(arena: &'a Bump, path: &Path, options: &OpenOptions) -> Result<Import<'a>, GltfError> {
    read_with(arena, options, &Files::new(path, options.allow_paths))
}

/// Reads a scene by the reader of its files.
pub fn read_with<'a>(arena: &'a Bump, options: &OpenOptions, files: &Files) -> Result<Import<'a>, GltfError> {
    let path = files.scene();
    let error = |Wrong { place, fault }| GltfError { path: path.to_owned(), place, fault };
    let unreadable = |reason: std::io::Error| error(GltfFault::Unreadable(reason.to_string()).into());
    let bytes = files.read(path).map_err(unreadable)?;
    let mut import = of_bytes(arena, &bytes, options, files).map_err(error)?;
    for note in &mut import.notes {
        *note = format!("{}: {note}", path.display());
    }
    Ok(import)
}

fn of_bytes<'a>(
    arena: &'a Bump,
    bytes: &[u8],
    options: &OpenOptions,
    files: &Files,
) -> Result<Import<'a>, Wrong> {
    let (root, binary) = container::open(bytes)?;
    let buffers = Buffers::read(&root, files, binary)?;
    let lists = Lists { root: &root, buffers: &buffers };
    let mut notes = Notes::default();
    for extension in container::unknown_extensions(&root.extensions_used) {
        notes.add(format!("extension `{}`", extension.escape_debug()), "left out, as it is not supported");
    }
    for (index, animation) in root.animations.iter().enumerate() {
        notes
            .add(name("animation", index, animation.name.as_ref()), "left out: animations are not supported");
    }
    let mut nodes = nodes::placed(&root, &mut notes)?;
    let moved = reach::moved(lists, &nodes);
    let mut skins = Skins::default();
    if let Some(note) = moved.note() {
        notes.add("the scene", note);
        let place = Place::of_scene(&moved);
        nodes.iter_mut().for_each(|placed| placed.place = place.after(&placed.place));
        skins.moved = Some(place);
    }
    let mut materials = Materials::new(arena, &root, Textures::new(arena, lists), moved.scale());
    let mut names = Names::default();
    let (mut objects, mut room) = (Vec::new(), MOST);
    let visible = visible(&nodes, &mut notes);
    let mut copies = copies(lists, &visible);
    for placed in visible {
        let mut meshes = Meshes {
            lists,
            materials: &mut materials,
            skins: &mut skins,
            notes: &mut notes,
            room: &mut room,
            objects: &mut objects,
            names: &mut names.objects,
        };
        meshes.add(placed, &mut copies).at(|| placed.name())?;
    }
    let bounds = view::bounds(&objects).ok_or(GltfFault::NoFaces)?;
    let camera = cameras::first(&root, &nodes, bounds, &mut notes)?;
    let lamps = lights::of(&root, &nodes, (bounds, moved.scale()), &mut notes)?;
    let (camera, resolution) = match camera {
        Some((camera, size, called)) => {
            names.camera = Some(called);
            (camera, size)
        }
        None => {
            notes.add("no camera", options.view.note());
            (options.view.camera(bounds), view::SIZE)
        }
    };
    let unlit = Scene {
        camera,
        background: options.view.background(arena),
        objects: arena.alloc_slice_copy(&objects),
        materials: arena.alloc_slice_copy(&materials.all),
        lights: &[],
        motions: &[],
    };
    let lights = match options.exposure {
        _ if lamps.is_empty() => {
            notes.add("no light", format!("it is {}", view::LIT));
            view::lights(&camera).to_vec()
        }
        None => lamps.exposed(&unlit, resolution, &mut notes)?,
        Some(_) => lamps.described(1.0)?,
    };
    let scene = Scene { lights: arena.alloc_slice_copy(&lights), ..unlit };
    (names.materials, names.lights) = (materials.names, lamps.names());
    Ok(Import { scene, resolution, notes: notes.lines(), names })
}

/// The nodes that are seen.
fn visible<'n, 'f>(nodes: &'n [Placed<'f>], notes: &mut Notes) -> Vec<&'n Placed<'f>> {
    let mut drawn = HashSet::new();
    let mut is_new = |placed: &&Placed<'_>| {
        // Equal meshes in one place would take time, and could be seen through each other in any order.
        let is_new = placed.node.mesh.is_none() || drawn.insert(placed.look());
        if !is_new {
            notes.add(placed.name(), "left out: another node draws the same mesh in the same place");
        }
        is_new
    };
    nodes.iter().filter(|placed| !placed.is_hidden && is_new(placed)).collect()
}

/// The fewest vertices of a mesh that is held once for all of its nodes. Rays reach smaller ones faster as
/// copies.
const FEWEST_SHARED: usize = 256;

/// The mesh of a node, and its size as a whole number: all copies of a mesh in one size can be instances.
type Copied = (usize, i64);

/// The poses of the nodes that draw the same large mesh in the same size. Instances are turned and moved: a
/// node that mirrors, stretches or shears its mesh, or that bends it by joints or weights of its own, is a
/// mesh of its own.
fn copies(lists: Lists<'_>, nodes: &[&Placed<'_>]) -> HashMap<Copied, Vec<Pose>> {
    let mut copies: HashMap<_, Vec<_>> = HashMap::new();
    for placed in nodes {
        if let Some((copied, _, pose)) = copied(placed) {
            copies.entry(copied).or_default().push(pose);
        }
    }
    copies.retain(|(mesh, _), poses| {
        let primitives = lists.root.meshes.get(*mesh).map(|mesh| &mesh.primitives);
        let positions = primitives.into_iter().flatten();
        let positions = positions.filter_map(|primitive| primitive.attributes.get("POSITION"));
        let counts = positions.map(|positions| lists.count(*positions).unwrap_or(0));
        (2..=MAX_COUNT).contains(&poses.len()) && counts.fold(0, usize::saturating_add) >= FEWEST_SHARED
    });
    copies
}

/// The mesh and the size of a node, and its pose; `None` if it cannot share its mesh.
fn copied(placed: &Placed<'_>) -> Option<(Copied, f64, Pose)> {
    let mesh = placed.node.mesh.filter(|_| placed.node.skin.is_none() && placed.node.weights.is_none())?;
    let (size, pose) = placed.place.rigid()?;
    Some(((mesh, (size.ln() * 1e6).round() as i64), size, pose))
}

/// The state for reading the meshes of nodes.
struct Meshes<'s, 'a, 'f> {
    lists: Lists<'f>,
    materials: &'s mut Materials<'a, 'f>,
    skins: &'s mut Skins,
    notes: &'s mut Notes,
    room: &'s mut usize,
    objects: &'s mut Vec<Object<Shape<'a>>>,
    names: &'s mut Vec<String>,
}

impl<'a> Meshes<'_, 'a, '_> {
    /// Adds the mesh of a node, if it has one, to the objects and their names. A mesh that several nodes draw
    /// is added with the first of them, and taken from `copies`.
    fn add(&mut self, placed: &Placed<'_>, copies: &mut HashMap<Copied, Vec<Pose>>) -> Result<(), Wrong> {
        let shared =
            copied(placed).and_then(|(copied, size, _)| Some((copies.get_mut(&copied)?, size, copied)));
        let Some((poses, size, copied)) = shared else { return self.add_mesh(placed, placed.place, None) };
        if poses.is_empty() {
            return Ok(());
        }
        let before = self.objects.len();
        let poses = core::mem::take(poses);
        let all = &*self.materials.arena.alloc_slice_copy(&poses);
        if self.add_mesh(placed, Place::scale(size), Some(all)).is_ok() {
            return Ok(());
        }
        // The mesh is out of range in its own coordinates, but may be in range where the nodes put it.
        self.objects.truncate(before);
        self.names.truncate(before);
        copies.remove(&copied);
        self.add_mesh(placed, placed.place, None)
    }

    /// Adds the mesh of a node as objects, or as instances in these poses.
    fn add_mesh(
        &mut self,
        placed: &Placed<'_>,
        place: Place,
        poses: Option<&'a [Pose]>,
    ) -> Result<(), Wrong> {
        let Some(index) = placed.node.mesh else { return Ok(()) };
        let mesh = find(&self.lists.root.meshes, "mesh", index)?;
        let joints = placed.node.skin.and_then(|skin| match self.skins.joints(self.lists, skin) {
            Ok(joints) => Some(joints),
            Err(Wrong { fault, .. }) => {
                self.notes.add(placed.name(), format!("its skin is left out: {fault}"));
                None
            }
        });
        let weights = skins::weights(placed.node, mesh);
        let posture = Posture { place: &place, joints: joints.as_deref(), weights };
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let called = || format!("{}, primitive {number}", name("mesh", index, mesh.name.as_ref()));
            let material = primitive.material;
            let coordinates = self.materials.coordinates(material).at(called)?;
            let geometry =
                Geometry::read(self.lists, primitive, posture, &coordinates, self.room).at(called)?;
            for note in &geometry.notes {
                self.notes.add(called(), *note);
            }
            let whole = geometry.whole();
            let meshes = whole.meshes(self.materials.arena);
            if meshes.is_empty() {
                if !geometry.is_empty() {
                    self.notes.add(called(), "left out: none of its triangles has an area");
                }
                continue;
            }
            let (shows_backs, halvings) = (whole.shows_backs(), geometry.halvings());
            let material = self.materials.id(material, shows_backs, halvings, self.notes).at(called)?;
            for mesh in meshes {
                if self.objects.len() >= MAX_COUNT {
                    return Err(GltfFault::TooMany { what: "objects", most: MAX_COUNT }.into());
                }
                let shape = match poses {
                    Some(poses) => {
                        let model = self.materials.arena.alloc(Model::Mesh(mesh));
                        Shape::Instances(Instances::new(model, poses))
                    }
                    None => Shape::Mesh(mesh),
                };
                self.objects.push(Object::new(shape, material));
                let others = match poses {
                    Some(poses) => format!(" and {} more", poses.len().saturating_sub(1)),
                    None => String::new(),
                };
                self.names.push(format!("{}{others}, {}", placed.name(), called()));
            }
        }
        Ok(())
    }
}
