//! Materials of MTL files. The table in [`obj`](super) describes how they are converted.

use std::collections::HashMap;
use std::rc::Rc;

use bumpalo::Bump;
use rayline::{Ends, LinearRgb, Map, Material, Onto, Optics, Placed, Placement, Texture, Vec3};

use super::library::{Described, Library, Map as Mapped, OUTSIDE};
use crate::files::Files;
use crate::model::{Beside, Pictures, Wrapping, beside, mean_of_codes};
use crate::nff::Excerpt;
use crate::notes::Notes;
use crate::raster::Raster;
use crate::srgb::light_of_share;

/// The color of surfaces without one.
const GRAY: LinearRgb = LinearRgb::gray(0.7);

const AMBIENT: f32 = 0.1;

/// The largest emission; white is 1.
const BRIGHTEST: f32 = 100.0;

/// The largest factor of a bump map.
const STEEPEST: f32 = 8.0;

/// The height of a white bump map of factor 1, as a multiple of the width of its pixels on the surface.
const BUMP: f32 = 2.0;

/// The materials of a scene, converted when a mesh needs them.
#[derive(Debug)]
pub(super) struct Materials<'a> {
    arena: &'a Bump,
    files: &'a Files,
    library: Library,
    pictures: Pictures<'a>,
    /// The converted materials, by their position in the library, and whether the mesh has texture
    /// coordinates and colors.
    known: HashMap<(Option<usize>, bool, bool), usize>,
    pub(super) all: Vec<Material<'a>>,
}

impl<'a> Materials<'a> {
    pub(super) fn new(arena: &'a Bump, files: &'a Files, library: Library) -> Self {
        Self {
            arena,
            files,
            library,
            pictures: Pictures::new(arena, files),
            known: HashMap::new(),
            all: Vec::new(),
        }
    }

    /// The position of the material of a name in the library.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.library.find(name)
    }

    /// Whether a material of the library has a texture, and whether all of its textures repeat.
    pub(super) fn textures(&self, index: Option<usize>) -> (bool, bool) {
        let described = index.and_then(|index| self.library.materials.get(index));
        let maps = || described.into_iter().flat_map(Described::maps);
        (maps().next().is_some(), maps().all(|(_, map)| !map.clamps))
    }

    /// The number in the scene of a material of the library. For `None` it is gray, and white on vertices
    /// with colors. `length_of_uv` is the length of a unit of texture coordinates on the mesh, if it has
    /// them.
    pub(super) fn id(
        &mut self,
        index: Option<usize>,
        is_colored: bool,
        length_of_uv: Option<f64>,
        notes: &mut Notes,
    ) -> usize {
        let key = (index, is_colored, length_of_uv.is_some());
        if let Some(id) = self.known.get(&key) {
            return *id;
        }
        let described = index.and_then(|index| self.library.materials.get(index)).cloned();
        let mut described = described.unwrap_or_default();
        if is_colored {
            described.diffuse = described.diffuse.or(Some([1.0; 3]));
        }
        let material = self.material(&described, length_of_uv, notes);
        self.known.insert(key, self.all.len());
        self.all.push(material);
        self.all.len() - 1
    }

    fn material(
        &mut self,
        described: &Described,
        length_of_uv: Option<f64>,
        notes: &mut Notes,
    ) -> Material<'a> {
        let opacity = described.opacity(notes);
        let specular = described.specular.map(|color| color.map(share));
        let specular = specular.or(described.map_specular.is_some().then_some([1.0; 3])).unwrap_or_default();
        let [red, green, blue] = specular;
        let specular = (red + green + blue) / 3.0;
        let shininess = described.exponent.unwrap_or(0.0).clamp(0.0, 1e6);
        let mirrors = matches!(described.model, Some(3..=7));
        let transmittance = 1.0 - opacity;
        // The range of fixed point.
        let ior = if transmittance > 0.0 { described.ior.unwrap_or(1.0).clamp(0.14, 7.0) } else { 1.0 };
        let mut material = Material {
            ambient: AMBIENT * opacity,
            diffuse: opacity,
            specular: if shininess > 0.0 { specular } else { 0.0 },
            shininess,
            reflectance: if mirrors { specular * opacity } else { 0.0 },
            transmittance,
            ior,
            ..Material::matte(described.diffuse.map_or(GRAY, rgb))
        };
        let emission = described.emission.map(|color| color.map(|light| light.clamp(0.0, BRIGHTEST)));
        if let Some([red, green, blue]) = emission
            && red + green + blue > 0.0
        {
            let emission = LinearRgb::new(red, green, blue);
            material.optics = Some(self.arena.alloc(Optics { emission, ..Optics::PLAIN }));
        }
        match length_of_uv {
            Some(length) => self.textured(material, described, length, notes),
            None => {
                if described.maps().next().is_some() {
                    notes.add(
                        &*described.place,
                        "the textures are left out on meshes without texture coordinates",
                    );
                }
                material
            }
        }
    }

    /// The material with its textures.
    fn textured(
        &mut self,
        material: Material<'a>,
        described: &Described,
        length_of_uv: f64,
        notes: &mut Notes,
    ) -> Material<'a> {
        let mut material = material;
        let mut maps = Vec::new();
        if let Some(map) = &described.map_color {
            material.color = match self.colored(map, described, notes) {
                Some(placed) => Texture::Placed(placed),
                // A black base is meant to be covered by the picture.
                None if described.diffuse.is_some_and(is_black) => Texture::Solid(GRAY),
                None => material.color,
            };
        }
        let is_shiny = material.specular > 0.0 || material.reflectance > 0.0;
        if is_shiny
            && let Some(map) = &described.map_specular
            && let Some(placed) = self.level(map, described, false, notes)
        {
            let texture = Texture::Placed(placed);
            maps.extend([Onto::Specular, Onto::Reflectance].map(|onto| Map { onto, texture }));
        }
        if let Some(map) = &described.map_opacity {
            self.fade(&mut material, &mut maps, map, described, notes);
        }
        if let Some(map) = &described.map_bump
            && let Some(bump) = self.bump(map, described, length_of_uv, notes)
        {
            maps.push(bump);
        }
        if let Some(map) = &described.map_normal
            && let Some(normals) = self.normals(map, described, notes)
        {
            maps.push(normals);
        }
        Material { maps: self.arena.alloc_slice_copy(&maps), ..material }
    }

    /// The picture of a map; `None` with a note if it cannot be read.
    fn picture(
        &mut self,
        (at, map): &(String, Mapped),
        described: &Described,
        notes: &mut Notes,
    ) -> Option<Rc<Raster>> {
        let at = format!("{at}: `{}`", Excerpt(&map.name));
        let file = match beside(&described.folder, &map.name, self.files) {
            Beside::Found(file) => file,
            Beside::Instead(file) => {
                notes.add(&*at, format!("{OUTSIDE}: the file of that name here is used"));
                file
            }
            Beside::Missing => {
                notes.add(at, "left out: there is no such picture");
                return None;
            }
            Beside::Outside => {
                notes.add(at, format!("left out: {OUTSIDE}; move it there"));
                return None;
            }
        };
        let picture = self.pictures.open(&file);
        picture.map_err(|reason| notes.add(at, format!("left out: {reason}"))).ok()
    }

    fn colored(
        &mut self,
        map: &(String, Mapped),
        described: &Described,
        notes: &mut Notes,
    ) -> Option<&'a Placed<'a>> {
        let picture = self.picture(map, described, notes)?;
        let factor = match described.diffuse {
            Some(color) if is_black(color) => {
                notes.add(&*map.0, "`Kd` is black and would hide the picture; taken for white");
                [1.0; 3]
            }
            color => color.unwrap_or([1.0; 3]).map(share),
        };
        let wrapping = map.1.wrapping(&map.0, notes);
        let placed = self.pictures.color(&picture, factor, wrapping);
        placed.map_err(|reason| notes.add(&*map.0, format!("left out: {reason}"))).ok()
    }

    /// The brightness of a picture's light, or its numbers.
    fn level(
        &mut self,
        map: &(String, Mapped),
        described: &Described,
        is_linear: bool,
        notes: &mut Notes,
    ) -> Option<&'a Placed<'a>> {
        let picture = self.picture(map, described, notes)?;
        let light = move |code| if is_linear { code } else { light_of_share(code) };
        let wrapping = map.1.wrapping(&map.0, notes);
        let placed = self.pictures.levels(&picture, false, wrapping, light);
        placed.map_err(|reason| notes.add(&*map.0, format!("left out: {reason}"))).ok()
    }

    /// Makes a material transparent by a map: by its opacity, or by the brightness of a picture without one.
    fn fade(
        &mut self,
        material: &mut Material<'a>,
        maps: &mut Vec<Map<'a>>,
        map: &(String, Mapped),
        described: &Described,
        notes: &mut Notes,
    ) {
        let Some(picture) = self.picture(map, described, notes) else { return };
        let is_alpha = picture.pixels.iter().any(|[.., alpha]| *alpha < u8::MAX);
        let wrapping = map.1.wrapping(&map.0, notes);
        let opacity = 1.0 - material.transmittance;
        let opaque = self.pictures.levels(&picture, is_alpha, wrapping, |level| level);
        let clear = self.pictures.levels(&picture, is_alpha, wrapping, |level| 1.0 - level * opacity);
        let (opaque, clear) = match (opaque, clear) {
            (Ok(opaque), Ok(clear)) => (opaque, clear),
            (Err(reason), _) | (_, Err(reason)) => return notes.add(&*map.0, format!("left out: {reason}")),
        };
        let onto = |onto, placed| Map { onto, texture: Texture::Placed(placed) };
        maps.extend([Onto::Ambient, Onto::Diffuse, Onto::Specular].map(|part| onto(part, opaque)));
        maps.push(onto(Onto::Transmittance, clear));
        *material = Material { reflectance: 0.0, transmittance: 1.0, ior: 1.0, ..*material };
    }

    fn bump(
        &mut self,
        map: &(String, Mapped),
        described: &Described,
        length_of_uv: f64,
        notes: &mut Notes,
    ) -> Option<Map<'a>> {
        let picture = self.picture(map, described, notes)?;
        let [red, green, blue] = mean_of_codes(&picture);
        if blue > 0.75 && (0.4..0.6).contains(&red) && (0.4..0.6).contains(&green) {
            return self.normals(map, described, notes);
        }
        let placed = self.level(map, described, true, notes)?;
        let [across, up] = map.1.scale.map(|scale| f64::from(scale.abs()).max(1e-6));
        let pixels = f64::from(picture.width.max(picture.height).max(1));
        let step = (length_of_uv / (across * up).sqrt() / pixels) as f32;
        if !(1e-6..=1e5).contains(&step) {
            notes.add(
                &*map.0,
                "left out: the pixels of the bump map are too small or too large on the surface",
            );
            return None;
        }
        let height = BUMP * step * map.1.bump.clamp(-STEEPEST, STEEPEST);
        Some(Map { onto: Onto::Bump { height, step }, texture: Texture::Placed(placed) })
    }

    fn normals(
        &mut self,
        map: &(String, Mapped),
        described: &Described,
        notes: &mut Notes,
    ) -> Option<Map<'a>> {
        let picture = self.picture(map, described, notes)?;
        let wrapping = map.1.wrapping(&map.0, notes);
        let placed = self.pictures.numbers(&picture, wrapping);
        let placed = placed.map_err(|reason| notes.add(&*map.0, format!("left out: {reason}"))).ok()?;
        Some(Map { onto: Onto::Normal { strength: 1.0 }, texture: Texture::Placed(placed) })
    }

    /// Makes all materials opaque if none of them would be seen.
    pub(super) fn show(&mut self, notes: &mut Notes, path: &str) {
        let is_hidden = |material: &Material<'_>| {
            material.transmittance >= 0.999
                && (material.ior - 1.0).abs() < 0.01
                && material.specular <= 0.0
                && material.maps.is_empty()
                && material.optics.is_none()
        };
        if !self.all.iter().all(is_hidden) {
            return;
        }
        notes.add(path, "all of the model would be invisible, so it is opaque");
        for material in &mut self.all {
            *material = Material { ambient: AMBIENT, diffuse: 1.0, transmittance: 0.0, ..*material };
        }
    }
}

impl Described {
    /// The opacity: `d`, or else 1 - `Tr` where `illum` asks for transparency or is missing. Many programs
    /// write `Tr 1` for opaque.
    fn opacity(&self, notes: &mut Notes) -> f32 {
        match (self.opacity, self.transparency.map(share), self.model) {
            (Some(opacity), ..) => share(opacity),
            (None, Some(clear), Some(4 | 6 | 7 | 9)) => 1.0 - clear,
            (None, Some(clear), None) if clear < 1.0 => 1.0 - clear,
            (None, Some(clear), model) if clear > 0.0 => {
                let why = if model.is_some() {
                    "`illum` asks for no transparency"
                } else {
                    "it would be invisible"
                };
                notes.add(&*self.place, format!("opaque in spite of `Tr`, as {why}"));
                1.0
            }
            _ => 1.0,
        }
    }

    /// Its maps, with their places in the file.
    fn maps(&self) -> impl Iterator<Item = &(String, Mapped)> {
        let Self { map_color, map_specular, map_opacity, map_bump, map_normal, .. } = self;
        [map_color, map_specular, map_opacity, map_bump, map_normal].into_iter().flatten()
    }
}

impl Mapped {
    /// The place of the picture on the surface.
    fn wrapping(&self, at: &str, notes: &mut Notes) -> Wrapping {
        let ends = if self.clamps { Ends::Extend } else { Ends::Repeat };
        let is_sound = |scale: &f32| (1e-5..=1e5).contains(&scale.abs());
        let moved = self.offset.map(|offset| if self.clamps { offset } else { offset.rem_euclid(1.0) });
        let (scale, moved) =
            if self.scale.iter().all(is_sound) && moved.iter().all(|offset| offset.abs() < 50.0) {
                (self.scale, moved)
            } else {
                notes.add(at, "`-s` and `-o` are left out: they are 0, or too small or large");
                ([1.0; 2], [0.0; 2])
            };
        let [x, y] = scale.map(|scale| 1.0 / scale);
        // A texture coordinate t becomes t · scale + offset.
        let (origin, size) = (Vec3::new(-moved[0] * x, -moved[1] * y, 0.0), Vec3::new(x, y, 1.0));
        Wrapping { placement: Placement { size, origin, ..Placement::SURFACE }, ends }
    }
}

fn share(value: f32) -> f32 {
    value.clamp(0.0, 1.0)
}

fn rgb(color: [f32; 3]) -> LinearRgb {
    let [red, green, blue] = color.map(share);
    LinearRgb::new(red, green, blue)
}

fn is_black(color: [f32; 3]) -> bool {
    color.iter().all(|channel| *channel <= 0.0)
}
