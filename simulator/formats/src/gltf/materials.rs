//! Materials (glTF 2.0 Specification, section 3.9 and appendix B). The table in [`gltf`](super) describes how
//! they are converted.

use std::collections::HashMap;

use bumpalo::Bump;
use rayline::limits::MAX_COUNT;
use rayline::{Fresnel, Highlight, LinearRgb, Map, Material, Onto, Optics, Texture};

use super::error::{At, GltfFault, Wrong, find, name};
use super::json::{Material as Described, Root, Volume};
use super::textures::{Coordinates, Picture, Textures};
use crate::notes::Notes;

/// The ambient coefficient as a share of the diffuse one, as in `obj`.
const AMBIENT: f32 = 0.1;

/// The largest exponent of a highlight: smaller spots fall between the pixels of small displays.
const SMOOTHEST: f32 = 2000.0;

/// The smallest visible strength of a highlight: one of 256 levels.
const FAINTEST: f32 = 1.0 / 256.0;

/// The largest emission; white is 1.
const BRIGHTEST: f32 = 100.0;

/// The base color of a material.
struct Base<'a> {
    /// The image of its texture, if it has one.
    picture: Option<Picture>,
    color: Texture<'a>,
    /// The mean color.
    mean: LinearRgb,
}

/// The materials of a scene, converted when an object needs them.
#[derive(Debug)]
pub(super) struct Materials<'a, 'f> {
    arena: &'a Bump,
    root: &'f Root,
    textures: Textures<'a, 'f>,
    /// The converted materials, by their number in the file and whether the object has texture coordinates.
    known: HashMap<(Option<usize>, bool), u16>,
    pub(super) all: Vec<Material<'a>>,
    /// The names of the materials in the file.
    pub(super) names: Vec<String>,
}

impl<'a, 'f> Materials<'a, 'f> {
    pub(super) fn new(arena: &'a Bump, root: &'f Root, textures: Textures<'a, 'f>) -> Self {
        Self { arena, root, textures, known: HashMap::new(), all: Vec::new(), names: Vec::new() }
    }

    /// The texture coordinates that a material uses.
    pub(super) fn coordinates(&self, index: Option<usize>) -> Result<Coordinates, Wrong> {
        let Some(index) = index else { return Ok(Coordinates::of(None)) };
        let material = find(&self.root.materials, "material", index)?;
        Ok(Coordinates::of(material.pbr_metallic_roughness.base_color_texture.as_ref()))
    }

    /// The number in the scene of a material of the file, or of glTF's default material for `None`. An object
    /// without texture coordinates gets a version without textures.
    pub(super) fn id(
        &mut self,
        index: Option<usize>,
        has_uvs: bool,
        notes: &mut Notes,
    ) -> Result<u16, Wrong> {
        if let Some(id) = self.known.get(&(index, has_uvs)) {
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
        let material = self.material(described, &name, has_uvs, notes).at(|| name.clone())?;
        self.known.insert((index, has_uvs), id);
        self.all.push(material);
        self.names.push(name);
        Ok(id)
    }

    fn material(
        &mut self,
        described: &Described,
        name: &str,
        has_uvs: bool,
        notes: &mut Notes,
    ) -> Result<Material<'a>, Wrong> {
        let [.., alpha] = described.pbr_metallic_roughness.base_color_factor.map(share);
        let Base { picture, color, mean } = self.base(described, name, has_uvs, notes)?;
        let extensions = &described.extensions;
        let plain = Material { color, ambient: AMBIENT, ..Material::matte(mean) };
        if extensions.unlit.is_some() {
            let seen = Material { ambient: 1.0, diffuse: 0.0, ..plain };
            return self.faded(seen, described, picture.as_ref(), alpha);
        }
        let (metallic, roughness) = self.metallic_roughness(described, notes)?;
        note_textures(described, name, notes);
        let transmission = extensions.transmission.as_ref();
        let transmittance = transmission.map_or(0.0, |transmission| share(transmission.transmission_factor));
        let is_metal = metallic >= 0.5;
        let is_glass = transmittance > 0.0 && !is_metal;
        let ior = extensions.ior.as_ref().map_or(1.5, |ior| ior.ior);
        // The range of fixed point. In glTF, 0 stands for a perfect mirror, which a large index approximates.
        let ior = ior.clamp(0.14, 7.0);

        // Reflections are sharp in Rayline: from a roughness of 0.5 on there are none.
        let sharpness = (1.0 - 2.0 * roughness).max(0.0);
        let material = with_highlight(plain, roughness, if is_metal { None } else { Some(ior) });
        let mut optics = Optics { highlight: Highlight::BlinnPhong, ..Optics::PLAIN };
        let material = if is_metal {
            (optics.fresnel, optics.reflection_color) = (Fresnel::Schlick, mean);
            let diffuse = 1.0 - sharpness;
            Material { diffuse, ambient: AMBIENT * diffuse, reflectance: sharpness, ..material }
        } else if is_glass {
            optics.fresnel = Fresnel::Exact;
            optics.transmission_color = rgb(mean.channels().map(f32::sqrt));
            optics.absorption = absorption(extensions.volume.as_ref());
            let diffuse = 1.0 - transmittance;
            Material { diffuse, ambient: AMBIENT * diffuse, transmittance, ior, ..material }
        } else {
            optics.fresnel = Fresnel::Exact;
            Material { reflectance: sharpness, ior, ..material }
        };
        optics.emission = self.emission(described, name, notes);
        let material = self.faded(material, described, picture.as_ref(), alpha)?;
        if material.transmittance > 0.0 && !is_glass {
            optics.fresnel = Fresnel::Constant;
        }
        let is_plain = material.specular <= 0.0
            && material.reflectance <= 0.0
            && material.transmittance <= 0.0
            && optics.emission == Optics::PLAIN.emission;
        Ok(match is_plain {
            true => Material { ior: 1.0, ..material },
            false => Material { optics: Some(self.arena.alloc(optics)), ..material },
        })
    }

    /// The base color of a material, as a texture if the object has texture coordinates.
    fn base(
        &mut self,
        described: &Described,
        name: &str,
        has_uvs: bool,
        notes: &mut Notes,
    ) -> Result<Base<'a>, Wrong> {
        let pbr = &described.pbr_metallic_roughness;
        let [red, green, blue, _] = pbr.base_color_factor.map(share);
        let factor = [red, green, blue];
        let mut picture = None;
        if let Some(info) = &pbr.base_color_texture {
            picture = self.textures.picture(info.index, notes)?;
            if !has_uvs && picture.take().is_some() {
                notes.add(name, "the texture is left out on meshes without texture coordinates");
            }
        }
        let (color, mean) = match &picture {
            Some(picture) => {
                let [r, g, b] = picture.light();
                let placed = self.textures.colored(picture, factor)?;
                (Texture::Placed(placed), rgb([red * r, green * g, blue * b]))
            }
            None => (Texture::Solid(rgb(factor)), rgb(factor)),
        };
        Ok(Base { picture, color, mean })
    }

    /// The metallic and roughness factors of a surface; of a texture, the mean.
    fn metallic_roughness(&mut self, described: &Described, notes: &mut Notes) -> Result<(f32, f32), Wrong> {
        let pbr = &described.pbr_metallic_roughness;
        let (mut metallic, mut roughness) = (share(pbr.metallic_factor), share(pbr.roughness_factor));
        if let Some(info) = &pbr.metallic_roughness_texture
            && let Some(picture) = self.textures.picture(info.index, notes)?
        {
            let [_, rough, metal] = picture.numbers();
            (metallic, roughness) = (metallic * metal, roughness * rough);
        }
        Ok((metallic, roughness))
    }

    fn emission(&self, described: &Described, name: &str, notes: &mut Notes) -> LinearRgb {
        if described.emissive_texture.is_some() {
            notes.add(name, "the emissive texture is left out, and with it all emission");
            return Optics::PLAIN.emission;
        }
        let strength = described.extensions.emissive_strength.as_ref();
        let strength = strength.map_or(1.0, |strength| strength.emissive_strength);
        let [r, g, b] = described.emissive_factor.map(|factor| (factor * strength).clamp(0.0, BRIGHTEST));
        LinearRgb::new(r, g, b)
    }

    /// The material with the transparency of the file's alpha.
    fn faded(
        &mut self,
        material: Material<'a>,
        described: &Described,
        picture: Option<&Picture>,
        alpha: f32,
    ) -> Result<Material<'a>, Wrong> {
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
        if let Some(picture) = picture
            && let Some([opaque, clear]) = self.textures.alpha(picture, |texel| opacity(texel * alpha))?
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
        (described.normal_texture.is_some(), "the normal texture is left out"),
        (described.occlusion_texture.is_some(), "the occlusion texture is left out"),
        (has_transmission, "the transmission texture is left out"),
    ] {
        if left_out {
            notes.add(name, what);
        }
    }
}

/// The material with the highlight of this roughness. `ior` is the index of refraction of a clear coat or of
/// glass; `None` for a metal.
fn with_highlight(plain: Material<'_>, roughness: f32, ior: Option<f32>) -> Material<'_> {
    let squared = roughness.powi(4);
    let shininess = (2.0 / squared - 2.0).min(SMOOTHEST);
    let straight = ior.map_or(1.0, |ior| ((ior - 1.0) / (ior + 1.0)).powi(2));
    let strength = (straight * shininess / 8.0).min(1.0) * (1.0 - roughness);
    // Drop a highlight that no display shows: it would only take time.
    let specular = if strength < FAINTEST { 0.0 } else { strength };
    Material { specular, shininess: if specular > 0.0 { shininess } else { 0.0 }, ..plain }
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

fn share(number: f32) -> f32 {
    number.clamp(0.0, 1.0)
}

fn rgb([r, g, b]: [f32; 3]) -> LinearRgb {
    LinearRgb::new(share(r), share(g), share(b))
}
