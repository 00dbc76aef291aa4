//! Baked light: the light of a scene is computed once, and stored in textures that a device looks up.
//!
//! 1. [`face`] finds the flat faces of rectangles, triangles, polygons and boxes. [`lattice`] covers each
//!    with texels, and meshes by their vertices; [`probe`] measures the light of lamps there by rays. Faces
//!    on which the light changes fast get finer texels, until the budget of bytes is spent ([`refine`]).
//! 2. [`photon`] follows light from lamps over mirrors and through glass, in directions that [`emission`]
//!    draws. [`photon_map`] computes the light of texels from the photons that arrive, with [`nearby`].
//!    Photons are traced before step 1, so that texels are fine where photons gather.
//! 3. [`radiosity`] lets all these surfaces scatter light onto each other.
//! 4. [`volume`] finds the light in between, for all other objects and for things that move.
//! 5. [`texture`] writes the light into images and materials.

// Positions come from the lengths of the lists that they index.
#![allow(clippy::indexing_slicing)]

mod emission;
mod face;
mod form_factor;
mod lattice;
mod nearby;
mod photon;
mod photon_map;
mod probe;
mod radiosity;
mod refine;
mod texture;
mod volume;

use core::fmt;
use core::mem::MaybeUninit;
use std::error::Error;

use bumpalo::Bump;
use rayline::shape::Shape;
use rayline::{
    Light as Lamp, LinearRgb, Map, Material, MaterialId, Object, ObjectId, Onto, Placement, PreparedScene,
    Renderer, Sampling, Scene, SceneError, Settings, SettingsError, Texture, Vec3,
};

use crate::picture::memory_for;
use face::Face;
use photon_map::PhotonMap;
use probe::LightProbe;
use radiosity::Surfaces;

type Vector = Vec3<f64>;
type Light = LinearRgb<f64>;

/// How light is baked.
#[derive(Clone, Debug, PartialEq)]
pub struct LightOptions {
    /// Whether lamps shine on the device, with sharp shadows and highlights, so that only the light that
    /// surfaces scatter is baked.
    pub keep_lamps: bool,
    /// The most bytes of all textures of light.
    pub budget: usize,
    /// The photons that follow light from lamps over mirrors and through glass to the first matte surface:
    /// caustics. With 0, glass is semitransparent to that light, and mirrors are opaque. More make them sharp
    /// and smooth.
    ///
    /// Light of lamps that stay on the device ([`keep_lamps`](Self::keep_lamps)) goes straight through glass
    /// there, so then only mirrors make caustics.
    pub photons: u32,
    /// The texels of textures.
    pub texels: LightTexels,
    /// The points of the irradiance volume along x, y and z, each 1 or more.
    pub grid: [u8; 3],
    /// The objects that will move: they throw no shadows that are baked, and take their light from the
    /// volume.
    pub moving: Vec<ObjectId>,
}

impl Default for LightOptions {
    fn default() -> Self {
        Self {
            keep_lamps: false,
            budget: 64 << 10,
            photons: 200_000,
            texels: LightTexels::Rgb888,
            grid: [4; 3],
            moving: Vec::new(),
        }
    }
}

/// The texels of textures of light. Both hold codes of sRGB, as shares of the brightest light on the object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum LightTexels {
    /// 3 bytes: neighboring codes differ by less than eyes see.
    #[default]
    Rgb888,
    /// 2 bytes: for displays of as few colors.
    Rgb565,
}

impl LightTexels {
    const fn bytes(self) -> usize {
        match self {
            Self::Rgb888 => 3,
            Self::Rgb565 => 2,
        }
    }
}

/// A scene whose light is baked.
#[derive(Clone, Debug)]
pub struct BakedLight<'a> {
    /// The scene.
    pub scene: Scene<'a>,
    /// The bytes of its light: textures, colors of vertices, and the irradiance volume.
    pub bytes: usize,
    /// The texels and vertices whose light was computed.
    pub texels: usize,
}

/// The reason why light cannot be baked.
#[derive(Debug)]
#[non_exhaustive]
pub enum LightError {
    /// The scene was refused. Correct the part that the error names.
    Scene(SceneError),
    /// A setting was refused.
    Settings(SettingsError),
    /// No object has flat faces or vertices. Add a rectangle, triangle, polygon, box or mesh.
    NoSurface,
    /// The smallest textures are larger than the budget. Raise it to this number of bytes.
    Budget(usize),
    /// There is no such object to move.
    NoObject(ObjectId),
    /// The grid of the irradiance volume has no points. Use 1 or more along each axis.
    Grid,
    /// Each object gets a material of its own, and these are too many. Remove objects.
    Materials(usize),
}

/// A part of the work, for its progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightStep {
    /// The light of lamps over mirrors and through glass.
    Photons,
    /// The light of lamps, and the sizes of textures.
    Lamps,
    /// The light that surfaces scatter onto each other.
    Surfaces,
    /// The light in between.
    Space,
}

/// Computes the light of a scene, and returns the scene with this light. `progress` is called with the step
/// at hand and the finished share of the step, from 0 to 1.
///
/// # Errors
/// The scene or an option was refused, or nothing in the scene can hold light.
pub fn bake_light<'a>(
    scene: &Scene<'a>,
    options: &LightOptions,
    arena: &'a Bump,
    progress: &dyn Fn(LightStep, f64),
) -> Result<BakedLight<'a>, LightError> {
    if options.grid.contains(&0) {
        return Err(LightError::Grid);
    }
    let resting = Resting::new(scene, options, arena)?;
    let still = &resting.scene;
    let white = probe::with_materials(still, arena, still.lights, probe::in_white);
    let photons = photons(&resting, scene, options, &|share| progress(LightStep::Photons, share))?;
    // Photons bring the light that glass lets through, unless the device shows it.
    let is_closed = options.photons > 0 && !options.keep_lamps;
    let close = |material: &Material<'a>| if is_closed { probe::closed(material) } else { *material };
    let lit = probe::with_materials(&white, arena, white.lights, close);
    let colored = probe::with_materials(still, arena, &[], |material| probe::in_color(material, arena));
    let glowing = probe::with_materials(still, arena, &[], probe::in_black);
    let [mut of_white, mut of_lit, mut of_colored, mut of_glowing] =
        [&white, &lit, &colored, &glowing].map(memory_for::<f64>);
    let (in_white, in_lit) = (prepared(&white, &mut of_white)?, prepared(&lit, &mut of_lit)?);
    let (in_color, in_black) = (prepared(&colored, &mut of_colored)?, prepared(&glowing, &mut of_glowing)?);
    let probe = LightProbe {
        scene: still,
        lit: renderer(&in_lit, probe::SAMPLES)?,
        colored: renderer(&in_color, 1)?,
        glowing: renderer(&in_black, 1)?,
        white: &in_white,
        photons: &photons,
        short: short(still),
    };
    let (mut surfaces, placements) = surfaces(still, options, &probe, progress)?;
    surfaces.solve(&probe, &|share| progress(LightStep::Surfaces, share));
    progress(LightStep::Space, 0.0);
    let mut assembly =
        Assembly { scene, options, arena, objects: scene.objects.to_vec(), materials: Vec::new() };
    let unlit = assembly.store(&resting, &surfaces, &placements)?;
    assembly.finish(unlit, (&resting, &surfaces), &lit, &probe)
}

/// The light of lamps that comes over mirrors and through glass of the scene at rest.
fn photons(
    resting: &Resting<'_>,
    scene: &Scene<'_>,
    options: &LightOptions,
    progress: &dyn Fn(f64),
) -> Result<PhotonMap, LightError> {
    let sends_on = |material: &Material<'_>| material.reflectance > 0.0 || material.transmittance > 0.0;
    if options.photons == 0 || !scene.materials.iter().any(sends_on) {
        return Ok(PhotonMap::default());
    }
    let takes_from_space = |(index, object): (usize, &Object<Shape<'_>>)| {
        let has_texels = match object.shape {
            Shape::Mesh(_) => !options.keep_lamps,
            _ => Face::of(&object.shape, index, Vector::ZERO).is_some(),
        };
        let is_matte = scene.material_of(object).is_some_and(scatters);
        is_matte && (!has_texels || !resting.positions.contains(&index))
    };
    let task = photon::Task {
        photons: options.photons as usize,
        without_glass: options.keep_lamps,
        in_space: scene.objects.iter().enumerate().any(takes_from_space),
        short: short(&resting.scene),
    };
    photon::traced(&resting.scene, task, progress)
}

/// The scene without the objects that will move.
struct Resting<'a> {
    scene: Scene<'a>,
    /// The position of each object in the whole scene.
    positions: Vec<usize>,
}

impl<'a> Resting<'a> {
    fn new(scene: &Scene<'a>, options: &LightOptions, arena: &'a Bump) -> Result<Self, LightError> {
        let is_missing = |object: &&ObjectId| usize::from(object.0) >= scene.objects.len();
        if let Some(object) = options.moving.iter().find(is_missing) {
            return Err(LightError::NoObject(*object));
        }
        let rests =
            |position: &usize| !options.moving.iter().any(|object| usize::from(object.0) == *position);
        let positions: Vec<_> = (0..scene.objects.len()).filter(rests).collect();
        let light = |light: &Lamp| match *light {
            Lamp::Object(object) => {
                let position = positions.iter().position(|position| *position == usize::from(object.0))?;
                Some(Lamp::Object(ObjectId(position as u16)))
            }
            light => Some(light),
        };
        let lights: Vec<_> = scene.lights.iter().filter_map(light).collect();
        let objects = arena.alloc_slice_fill_iter(positions.iter().map(|position| scene.objects[*position]));
        let scene = Scene { objects, lights: arena.alloc_slice_copy(&lights), motions: &[], ..*scene };
        Ok(Self { scene, positions })
    }
}

/// The texels of all surfaces with the light of lamps, and the placement of each face's texture.
fn surfaces(
    scene: &Scene<'_>,
    options: &LightOptions,
    probe: &LightProbe<'_>,
    progress: &dyn Fn(LightStep, f64),
) -> Result<(Surfaces, Vec<Placement>), LightError> {
    let eye = vector(scene.camera.eye);
    let (mut faces, mut placements, mut meshes) = (Vec::new(), Vec::new(), Vec::new());
    for (index, object) in scene.objects.iter().enumerate() {
        if !scene.material_of(object).is_some_and(scatters) {
            continue;
        }
        if let Shape::Mesh(mesh) = &object.shape {
            // Lamps that stay shine on colors of vertices, too.
            if !options.keep_lamps {
                meshes.push((index, lattice::vertices(mesh, index, probe)));
            }
        } else if let Some((of_object, placement)) = Face::of(&object.shape, index, eye) {
            placements.extend(of_object.iter().map(|_| placement));
            faces.extend(of_object);
        }
    }
    if faces.is_empty() && meshes.is_empty() {
        return Err(LightError::NoSurface);
    }
    let vertices: usize = meshes.iter().map(|(_, texels)| texels.len()).sum();
    let texels = options.budget.saturating_sub(vertices * 3) / options.texels.bytes();
    let most_texels = if vertices * 3 > options.budget { 0 } else { texels };
    let lattices = refine::lattices(faces, most_texels, probe, &|share| progress(LightStep::Lamps, share));
    let lattices =
        lattices.map_err(|needed| LightError::Budget(needed * options.texels.bytes() + vertices * 3))?;
    Ok((Surfaces { lattices, meshes }, placements))
}

/// Whether light on a material can be baked: it scatters light, and lets none through.
fn scatters(material: &Material<'_>) -> bool {
    material.diffuse > 0.0 && material.transmittance == 0.0
}

/// The scene that is made.
struct Assembly<'s, 'a> {
    scene: &'s Scene<'a>,
    options: &'s LightOptions,
    arena: &'a Bump,
    objects: Vec<Object<Shape<'a>>>,
    materials: Vec<Material<'a>>,
}

impl<'a> Assembly<'_, 'a> {
    /// Gives an object a material.
    fn set_material(&mut self, object: usize, material: Material<'a>) -> Result<(), LightError> {
        let known = self.materials.iter().position(|other| *other == material);
        let position = known.unwrap_or_else(|| {
            self.materials.push(material);
            self.materials.len() - 1
        });
        let too_many = |_| LightError::Materials(self.objects.len());
        self.objects[object].material = MaterialId(u16::try_from(position).map_err(too_many)?);
        Ok(())
    }

    fn material_of(&self, object: usize) -> Option<&Material<'a>> {
        self.scene.material_of(&self.scene.objects[object])
    }

    /// Stores the light of all surfaces. Other objects keep their materials. Returns the positions of those
    /// other objects that scatter light.
    fn store(
        &mut self,
        resting: &Resting<'a>,
        surfaces: &Surfaces,
        placements: &[Placement],
    ) -> Result<Vec<usize>, LightError> {
        let mut unlit = Vec::new();
        for object in 0..self.objects.len() {
            let Some(material) = self.material_of(object).copied() else { continue };
            let here = resting.positions.iter().position(|position| *position == object);
            let of_faces = surfaces.lattices.iter().zip(placements);
            let faces: Vec<_> = of_faces.filter(|(lattice, _)| Some(lattice.face.object) == here).collect();
            let of_mesh = surfaces.meshes.iter().find(|(object, _)| Some(*object) == here);
            if let Some((_, placement)) = faces.first() {
                let lattices: Vec<_> = faces.iter().map(|(lattice, _)| *lattice).collect();
                let map = texture::map(&lattices, **placement, self.options, self.arena);
                self.set_material(object, texture::lit(&material, map, self.options, self.arena))?;
            } else if let (Some((_, texels)), Shape::Mesh(mesh)) = (of_mesh, self.objects[object].shape) {
                let (mesh, most) = texture::lit_mesh(&mesh, texels, self.options, self.arena);
                let onto = Onto::AmbientLight { most };
                let map = Map { onto, texture: Texture::Solid(LinearRgb::WHITE) };
                self.objects[object].shape = Shape::Mesh(mesh);
                self.set_material(object, texture::lit(&material, map, self.options, self.arena))?;
            } else {
                self.set_material(object, material)?;
                unlit.extend(scatters(&material).then_some(object));
            }
        }
        Ok(unlit)
    }

    /// Finds the light of the objects that have none yet, and completes the scene.
    fn finish(
        mut self,
        unlit: Vec<usize>,
        (resting, surfaces): (&Resting<'a>, &Surfaces),
        lit: &Scene<'_>,
        probe: &LightProbe<'_>,
    ) -> Result<BakedLight<'a>, LightError> {
        let mut bytes = surfaces.lattices.iter().map(|lattice| lattice.texels.len()).sum::<usize>();
        bytes *= self.options.texels.bytes();
        let vertices: usize = surfaces.meshes.iter().map(|(_, texels)| texels.len()).sum();
        bytes += vertices * 3;
        if !unlit.is_empty() {
            let still = resting.positions.iter().map(|position| self.objects[*position]);
            let still: Vec<_> = still.collect();
            let baked = Scene { objects: &still, materials: &self.materials, ..resting.scene };
            let grid = volume::Grid::around(surfaces.points(), self.options.grid);
            let lit = (!self.options.keep_lamps).then_some(lit);
            let lit = volume::Lamps { lit, have_photons: self.options.photons > 0 };
            let map = volume::map(&grid, &baked, lit, probe, self.arena)?;
            for object in unlit {
                let Some(material) = self.material_of(object).copied() else { continue };
                self.set_material(object, texture::lit(&material, map, self.options, self.arena))?;
            }
            bytes += self.options.grid.map(usize::from).iter().product::<usize>() * 24;
        }
        Ok(self.scene_with(bytes, surfaces.points().count()))
    }

    /// The complete scene, without materials and lights that nothing needs any more.
    fn scene_with(self, bytes: usize, texels: usize) -> BakedLight<'a> {
        let Self { scene, options, arena, mut objects, mut materials } = self;
        for material in (0..materials.len()).rev() {
            let numbers = || objects.iter().map(|object| usize::from(object.material.0));
            if !numbers().any(|number| number == material) {
                materials.remove(material);
                let behind = |object: &&mut Object<_>| usize::from(object.material.0) > material;
                objects.iter_mut().filter(behind).for_each(|object| object.material.0 -= 1);
            }
        }
        let is_shiny = |object: &Object<_>| {
            materials.get(usize::from(object.material.0)).is_some_and(|material| material.specular > 0.0)
        };
        // Without highlights, nothing is left for a lamp to do.
        let keeps_lamps = options.keep_lamps || objects.iter().any(is_shiny);
        let stays = |light: &&Lamp| keeps_lamps && !matches!(light, Lamp::Ambient { .. });
        let lights: Vec<_> = scene.lights.iter().filter(stays).copied().collect();
        let scene = Scene {
            objects: arena.alloc_slice_copy(&objects),
            materials: arena.alloc_slice_copy(&materials),
            lights: arena.alloc_slice_copy(&lights),
            ..*scene
        };
        BakedLight { scene, bytes, texels }
    }
}

fn vector(vector: Vec3) -> Vector {
    vector.to()
}

/// The settings of a renderer that measures light at one place.
fn one_texel(samples: u16) -> Settings {
    let sampling = Sampling::new(samples);
    Settings { bounces: 0, sampling, rays_per_pixel: 100_000, ..Settings::new(1, 1) }
}

fn prepared<'m>(
    scene: &Scene<'m>,
    memory: &'m mut [MaybeUninit<u8>],
) -> Result<PreparedScene<'m, f64>, LightError> {
    PreparedScene::new(scene, memory).map_err(LightError::Scene)
}

fn renderer<'p, 'm>(
    scene: &'p PreparedScene<'m, f64>,
    samples: u16,
) -> Result<Renderer<'p, 'm, f64>, LightError> {
    Renderer::new(scene, one_texel(samples)).map_err(LightError::Settings)
}

/// A distance that is short in this scene, and far above the rounding of numbers.
fn short(scene: &Scene<'_>) -> f64 {
    let reach = |object: &Object<Shape<'_>>| {
        let (faces, _) = Face::of(&object.shape, 0, vector(scene.camera.eye)).unwrap_or_default();
        faces.iter().map(|face| face.whole_area().sqrt()).fold(0.0, f64::max)
    };
    let largest = scene.objects.iter().map(reach).fold(0.0, f64::max);
    if largest > 0.0 { largest * 1e-5 } else { 1e-5 }
}

impl fmt::Display for LightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Settings(error) => error.fmt(f),
            Self::NoSurface => f.write_str(
                "nothing in the scene can hold baked light: add a matte rectangle, triangle, polygon, box or \
                 mesh",
            ),
            Self::Budget(needed) => {
                write!(f, "the smallest textures of light take {needed} bytes; raise the budget")
            }
            Self::NoObject(ObjectId(object)) => write!(f, "there is no object {object} to move"),
            Self::Grid => f.write_str("a grid of light has no points along an axis; use 1 or more"),
            Self::Materials(objects) => {
                write!(f, "{objects} objects get too many materials of their own; use fewer objects")
            }
        }
    }
}

impl Error for LightError {}
