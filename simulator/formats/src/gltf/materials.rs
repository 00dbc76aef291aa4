//! Materials (glTF 2.0 Specification, section 3.9 and appendix B). The table in [`gltf`](super) describes how
//! they are converted.

use std::collections::HashMap;

use bumpalo::Bump;
use rayline::limits::MAX_COUNT;
use rayline::{Fresnel, Highlight, LinearRgb, Map, Material, Onto, Optics, Sides, Texture};

use super::error::{At, GltfFault, Wrong, find, name};
use super::finish::Finish;
use super::json::{Material as Described, MaterialExtensions, Root, TextureInfo, Volume};
use super::textures::{Coordinates, Picture, Textures};
use crate::notes::Notes;

/// The ambient coefficient as a share of the diffuse one, as in `obj`.
pub(super) const AMBIENT: f32 = 0.1;

/// The largest emission; white is 1.
const BRIGHTEST: f32 = 100.0;

/// The base color of a material.
struct Base<'a> {
    /// The image of its texture, if it has one.
    picture: Option<Picture<'a>>,
    color: Texture<'a>,
    /// The mean color.
    mean: LinearRgb,
}

/// The materials of a scene, converted when an object needs them.
#[derive(Debug)]
pub(super) struct Materials<'a, 'f> {
    pub(super) arena: &'a Bump,
    root: &'f Root,
    pub(super) textures: Textures<'a, 'f>,
    /// The length of a unit of the file in the scene.
    unit: f32,
    /// The converted materials, by their number in the file and how many times the object's texture
    /// coordinates were halved, if it has any.
    known: HashMap<(Option<usize>, bool, Option<u8>), u16>,
    pub(super) all: Vec<Material<'a>>,
    /// The names of the materials in the file.
    pub(super) names: Vec<String>,
}

impl<'a, 'f> Materials<'a, 'f> {
    pub(super) fn new(arena: &'a Bump, root: &'f Root, textures: Textures<'a, 'f>, unit: f64) -> Self {
        let unit = unit as f32;
        Self { arena, root, textures, unit, known: HashMap::new(), all: Vec::new(), names: Vec::new() }
    }

    /// The texture coordinates that a material uses.
    pub(super) fn coordinates(&self, index: Option<usize>) -> Result<Coordinates, Wrong> {
        let Some(index) = index else { return Ok(Coordinates::of(self.root, None)) };
        Ok(self.coordinates_in(find(&self.root.materials, "material", index)?))
    }

    /// The texture coordinates that a material uses: those of the base color, else of metal and roughness, of
    /// emission, or of normals.
    pub(super) fn coordinates_in(&self, described: &Described) -> Coordinates {
        let (_, base) = described.base();
        let finish = described.pbr_metallic_roughness.metallic_roughness_texture.as_ref();
        let others = described.emissive_texture.as_ref().or(described.normal_texture.as_ref());
        Coordinates::of(self.root, base.or(finish).or(others))
    }

    /// The picture of a texture, and how many times the texture coordinates of the mesh are halved; `None` if
    /// the mesh has no coordinates for it.
    fn on_mesh(
        &mut self,
        described: &Described,
        info: &TextureInfo,
        halvings: Option<u8>,
        notes: &mut Notes,
    ) -> Result<Option<(Picture<'a>, u8)>, Wrong> {
        let is_placed = self.coordinates_of(info).are_those_of(&self.coordinates_in(described));
        Ok(self.textures.picture(info.index, notes)?.zip(halvings.filter(|_| is_placed)))
    }

    /// The texture coordinates of a texture.
    pub(super) fn coordinates_of(&self, info: &TextureInfo) -> Coordinates {
        Coordinates::of(self.root, Some(info))
    }

    /// The number in the scene of a material of the file, or of glTF's default material for `None`. An object
    /// without texture coordinates gets a version without textures. If the object `shows_backs`, opaque
    /// materials that are not double-sided are seen from the front only.
    pub(super) fn id(
        &mut self,
        index: Option<usize>,
        shows_backs: bool,
        halvings: Option<u8>,
        notes: &mut Notes,
    ) -> Result<u16, Wrong> {
        let key = (index, shows_backs, halvings);
        if let Some(id) = self.known.get(&key) {
            return Ok(*id);
        }
        let too_many = |_| GltfFault::TooMany { what: "materials", most: MAX_COUNT };
        let id = u16::try_from(self.all.len()).map_err(too_many)?;
        let default = Described::default();
        let (described, name) = match index {
            Some(index) => {
                let described = find(&self.root.materials, "material", index)?;
                (described, name("material", index, described.name.as_ref()))
            }
            None => (&default, "the default material".to_owned()),
        };
        let mut material = self.material(described, &name, halvings, notes).at(|| name.clone())?;
        if shows_backs && !described.double_sided && material.transmittance <= 0.0 {
            let optics = *material.optics.unwrap_or(&Optics::PLAIN);
            material.optics = Some(self.arena.alloc(Optics { sides: Sides::Front, ..optics }));
        }
        self.known.insert(key, id);
        self.all.push(material);
        self.names.push(name);
        Ok(id)
    }

    fn material(
        &mut self,
        described: &Described,
        name: &str,
        halvings: Option<u8>,
        notes: &mut Notes,
    ) -> Result<Material<'a>, Wrong> {
        let Base { picture, color, mean } = self.base(described, name, halvings, notes)?;
        let extensions = &described.extensions;
        let plain = Material { color, ambient: AMBIENT, ..Material::matte(mean) };
        let seen_through = (picture.as_ref(), halvings.unwrap_or_default());
        if extensions.unlit.is_some() {
            let seen = Material { ambient: 1.0, diffuse: 0.0, ..plain };
            return self.faded(seen, described, seen_through);
        }
        let finish = self.finish(described, name, notes)?;
        note_textures(described, name, notes);
        let mut optics = Optics { highlight: Highlight::BlinnPhong, ..Optics::PLAIN };
        let mut maps = Vec::new();
        self.normals(described, name, halvings, (notes, &mut maps))?;
        optics.emission = self.emission(described, name, halvings, (notes, &mut maps))?;
        let mut mirror_of_texels = |optics: &mut Optics, color: LinearRgb| {
            optics.reflection_color = color;
            // A metal with a picture mirrors in the color of each texel, which includes the factor.
            if let Texture::Placed(_) = plain.color {
                optics.reflection_color = LinearRgb::WHITE;
                maps.push(Map { onto: Onto::ReflectionColor, texture: plain.color });
            }
        };
        let material = if let Some(texels) = self.texels(described, name, halvings, notes)? {
            // Schlick's approximation would mirror at the rims of rough texels, too.
            if texels.has_metal {
                mirror_of_texels(&mut optics, mean);
            } else {
                optics.fresnel = Fresnel::Exact;
            }
            let (specular, shininess) = texels.highlight;
            maps.extend(texels.maps);
            Material { specular, shininess, reflectance: texels.reflectance, ior: finish.ior, ..plain }
        } else {
            let (material, mut optical) = finished((plain, mean), optics, finish, extensions);
            optical.absorption = optical.absorption * self.unit.recip();
            optics = optical;
            if finish.is_metal && finish.mirror.is_none() && material.reflectance > 0.0 {
                mirror_of_texels(&mut optics, mean);
            }
            let is_glass = material.transmittance > 0.0;
            let material = self.faded(material, described, seen_through)?;
            if material.transmittance > 0.0 && !is_glass {
                optics.fresnel = Fresnel::Constant;
            }
            maps.extend(material.maps);
            material
        };
        let maps = self.arena.alloc_slice_copy(&maps);
        Ok(self.with_optics(Material { maps, ..material }, optics))
    }

    /// The material with optics, if it has any use for them.
    fn with_optics(&self, material: Material<'a>, optics: Optics) -> Material<'a> {
        let is_plain = material.specular <= 0.0
            && material.reflectance <= 0.0
            && material.transmittance <= 0.0
            && optics.emission == Optics::PLAIN.emission;
        match is_plain {
            true => Material { ior: 1.0, ..material },
            false => Material { optics: Some(self.arena.alloc(optics)), ..material },
        }
    }

    /// The base color of a material, as a texture if the object has texture coordinates.
    fn base(
        &mut self,
        described: &Described,
        name: &str,
        halvings: Option<u8>,
        notes: &mut Notes,
    ) -> Result<Base<'a>, Wrong> {
        let (factor, texture) = described.base();
        let [red, green, blue, _] = factor.map(share);
        let factor = [red, green, blue];
        let mut picture = None;
        if let Some(info) = texture {
            picture = self.textures.picture(info.index, notes)?;
            if halvings.is_none() && picture.take().is_some() {
                notes.add(name, "the texture is left out on meshes without texture coordinates");
            }
        }
        let (color, mean) = match &picture {
            Some(picture) => {
                let [r, g, b] = picture.light();
                let placed = self.textures.colored(picture, factor, halvings.unwrap_or_default())?;
                (Texture::Placed(placed), rgb([red * r, green * g, blue * b]))
            }
            None => (Texture::Solid(rgb(factor)), rgb(factor)),
        };
        Ok(Base { picture, color, mean })
    }

    /// The emission, and its map if there is a texture; of a texture on other coordinates than those of the
    /// mesh, the mean.
    fn emission(
        &mut self,
        described: &Described,
        name: &str,
        halvings: Option<u8>,
        (notes, maps): (&mut Notes, &mut Vec<Map<'a>>),
    ) -> Result<LinearRgb, Wrong> {
        let strength = described.extensions.emissive_strength.as_ref();
        let strength = strength.map_or(1.0, |strength| strength.emissive_strength);
        let emission = |share: [f32; 3]| {
            let factors = described.emissive_factor.map(|factor| (factor * strength).clamp(0.0, BRIGHTEST));
            let ([r, g, b], [red, green, blue]) = (factors, share);
            LinearRgb::new(r * red, g * green, b * blue)
        };
        let all = emission([1.0; 3]);
        let Some(info) = described.emissive_texture.as_ref().filter(|_| all != Optics::PLAIN.emission) else {
            return Ok(all);
        };
        if let Some((picture, halvings)) = self.on_mesh(described, info, halvings, notes)? {
            let texture = Texture::Placed(self.textures.colored(&picture, [1.0; 3], halvings)?);
            maps.push(Map { onto: Onto::Emission, texture });
            return Ok(all);
        }
        let Some(picture) = self.textures.picture(info.index, notes)? else {
            notes.add(name, "it does not shine, as its emissive texture is left out");
            return Ok(Optics::PLAIN.emission);
        };
        notes.add(name, "the mean of the emissive texture is used");
        Ok(emission(picture.light()))
    }

    /// Adds the map of a normal texture.
    fn normals(
        &mut self,
        described: &Described,
        name: &str,
        halvings: Option<u8>,
        (notes, maps): (&mut Notes, &mut Vec<Map<'a>>),
    ) -> Result<(), Wrong> {
        let Some(info) = &described.normal_texture else { return Ok(()) };
        match self.on_mesh(described, info, halvings, notes)? {
            Some((picture, halvings)) => {
                let texture = Texture::Placed(self.textures.numbers(&picture, halvings)?);
                let strength = if info.scale.is_finite() { info.scale.clamp(-8.0, 8.0) } else { 1.0 };
                maps.push(Map { onto: Onto::Normal { strength }, texture });
            }
            None => notes.add(name, "the normal texture is left out"),
        }
        Ok(())
    }

    /// The material with the transparency of the file's alpha.
    fn faded(
        &mut self,
        material: Material<'a>,
        described: &Described,
        (picture, halvings): (Option<&Picture<'a>>, u8),
    ) -> Result<Material<'a>, Wrong> {
        let ([.., alpha], _) = described.base();
        let alpha = share(alpha);
        let opacity = move |alpha: f32| match &*described.alpha_mode {
            "BLEND" => alpha,
            "MASK" if alpha < described.alpha_cutoff => 0.0,
            _ => 1.0,
        };
        // Glass is transparent already: ignore its alpha.
        if material.transmittance > 0.0 {
            return Ok(material);
        }
        let faded = |opacity: f32| Material {
            ambient: material.ambient * opacity,
            diffuse: material.diffuse * opacity,
            specular: material.specular * opacity,
            reflectance: 0.0,
            transmittance: 1.0 - opacity,
            ior: 1.0,
            ..material
        };
        // The edge of a hole is sharp: between two texels there is no half-open one.
        let cut =
            picture.map(|picture| if described.alpha_mode == "MASK" { picture.sharp() } else { *picture });
        if let Some(picture) = cut
            && let Some([opaque, clear]) =
                self.textures.alpha(&picture, |texel| opacity(texel * alpha), halvings)?
        {
            let map = |onto, placed| Map { onto, texture: Texture::Placed(placed) };
            let [ambient, diffuse, specular] =
                [Onto::Ambient, Onto::Diffuse, Onto::Specular].map(|onto| map(onto, opaque));
            let maps = [ambient, diffuse, specular, map(Onto::Transmittance, clear)];
            let maps = self.arena.alloc_slice_copy(&maps);
            return Ok(Material { transmittance: 1.0, maps, ..faded(1.0) });
        }
        let opacity = opacity(alpha);
        Ok(if opacity < 1.0 && picture.is_none() { faded(opacity) } else { material })
    }
}

/// Adds notes about textures that are left out.
fn note_textures(described: &Described, name: &str, notes: &mut Notes) {
    let transmission = described.extensions.transmission.as_ref();
    let has_transmission =
        transmission.is_some_and(|transmission| transmission.transmission_texture.is_some());
    for (left_out, what) in [
        (described.occlusion_texture.is_some(), "the occlusion texture is left out"),
        (has_transmission, "the transmission texture is left out"),
    ] {
        if left_out {
            notes.add(name, what);
        }
    }
}

/// The material and optics of a whole surface with this finish. `plain` is the surface without one, and its
/// mean color.
fn finished<'a>(
    (plain, mean): (Material<'a>, LinearRgb),
    mut optics: Optics,
    finish: Finish,
    extensions: &MaterialExtensions,
) -> (Material<'a>, Optics) {
    let Finish { is_metal, mirror, ior, sharpness, highlight: (specular, shininess) } = finish;
    let material = Material { specular, shininess, ..plain };
    let transmission = extensions.transmission.as_ref();
    let transmittance = transmission.map_or(0.0, |transmission| share(transmission.transmission_factor));
    let material = if is_metal {
        (optics.fresnel, optics.reflection_color) = (Fresnel::Schlick, mirror.unwrap_or(mean));
        let (color, diffuse) = match (mirror, material.color) {
            (None, color) => (color, 1.0 - sharpness),
            // The diffuse color, and that of blurred reflections.
            (Some(mirror), Texture::Solid(below)) => {
                let left = 1.0 - mirror.channels().into_iter().fold(0.0, f32::max);
                let [r, g, b] = below.channels().map(|channel| channel * left);
                let [red, green, blue] = mirror.channels().map(|channel| channel * (1.0 - sharpness));
                (Texture::Solid(rgb([r + red, g + green, b + blue])), 1.0)
            }
            (Some(mirror), color) => (color, 1.0 - mirror.channels().into_iter().fold(0.0, f32::max)),
        };
        Material { color, diffuse, ambient: AMBIENT * diffuse, reflectance: sharpness, ..material }
    } else if transmittance > 0.0 {
        optics.fresnel = Fresnel::Exact;
        // Without a volume, each surface is a sheet of its own.
        let volume = extensions.volume.as_ref().filter(|volume| volume.thickness_factor > 0.0);
        optics.thin = volume.is_none();
        let color = mean.channels();
        optics.transmission_color = rgb(if optics.thin { color } else { color.map(f32::sqrt) });
        optics.absorption = absorption(volume);
        let diffuse = 1.0 - transmittance;
        Material { diffuse, ambient: AMBIENT * diffuse, transmittance, ior, ..material }
    } else {
        optics.fresnel = Fresnel::Exact;
        optics.reflection_color = mirror.unwrap_or(LinearRgb::WHITE);
        Material { reflectance: sharpness, ior, ..material }
    };
    (material, optics)
}

/// The absorption of glass per unit of length: after `attenuationDistance`, the share `attenuationColor` is
/// left.
fn absorption(volume: Option<&Volume>) -> LinearRgb {
    let Some(volume) = volume else { return Optics::PLAIN.absorption };
    let per_unit = 1.0 / volume.attenuation_distance;
    let lost = |left: f32| (-share(left).max(1e-6).ln() * per_unit).clamp(0.0, 1e6);
    let [r, g, b] = volume.attenuation_color.map(lost);
    if [r, g, b].iter().all(|lost| lost.is_finite()) {
        LinearRgb::new(r, g, b)
    } else {
        Optics::PLAIN.absorption
    }
}

pub(super) fn share(number: f32) -> f32 {
    number.clamp(0.0, 1.0)
}

pub(super) fn rgb([r, g, b]: [f32; 3]) -> LinearRgb {
    LinearRgb::new(share(r), share(g), share(b))
}
