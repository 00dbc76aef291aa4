//! The finish of surfaces: metals, roughness and coats, of a whole material or by texel (glTF 2.0
//! Specification, section 3.9 and appendix B). The table in [`gltf`](super) describes how they are converted.

use rayline::{LinearRgb, Map, Onto, Placed, Texture};

use super::error::Wrong;
use super::json::{Clearcoat, Material as Described, SpecularGlossiness, TextureInfo};
use super::materials::{Materials, rgb, share};
use super::textures::Picture;
use crate::notes::Notes;
use crate::srgb::byte;

/// The largest exponent of a highlight: smaller spots fall between the pixels of small displays.
const SMOOTHEST: f32 = 2000.0;

/// The smallest visible strength of a highlight: one of 256 levels.
const FAINTEST: f32 = 1.0 / 256.0;

/// The share of light that plastic mirrors at normal incidence.
const PLASTIC: f32 = 0.04;

/// The largest share of light at normal incidence for which a surface counts as coated, and not as a metal.
const MOST_OF_COATS: f32 = 0.2;

/// The largest difference between texels of which the mean is used.
const EVEN: f32 = 0.1;

/// The finish of a whole surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Finish {
    /// Whether it mirrors like a metal.
    pub(super) is_metal: bool,
    /// The color in which it mirrors; `None` for the base color of a metal, and white of a coat.
    pub(super) mirror: Option<LinearRgb>,
    /// The index of refraction of its coat, or of glass.
    pub(super) ior: f32,
    /// The share of mirrored light that is sharp.
    pub(super) sharpness: f32,
    /// The strength and the exponent of the highlight.
    pub(super) highlight: (f32, f32),
}

/// The finish of a surface by texel: factors for the coefficients of a material, and their maps.
#[derive(Clone, Debug)]
pub(super) struct Texels<'a> {
    /// Whether any texel is a metal.
    pub(super) has_metal: bool,
    pub(super) reflectance: f32,
    pub(super) highlight: (f32, f32),
    pub(super) maps: Vec<Map<'a>>,
}

/// Reflections are sharp in Rayline: from a roughness of 0.5 on there are none.
fn sharpness(roughness: f32) -> f32 {
    (1.0 - 2.0 * roughness).max(0.0)
}

/// The strength and the exponent of the highlight of a roughness, for a surface that mirrors this share of
/// light at normal incidence.
fn highlight(roughness: f32, straight: f32) -> (f32, f32) {
    let shininess = (2.0 / roughness.powi(4) - 2.0).min(SMOOTHEST);
    let strength = (straight * shininess / 8.0).min(1.0) * (1.0 - roughness);
    // Drop a highlight that no display shows: it would only take time.
    if strength < FAINTEST { (0.0, 0.0) } else { (strength, shininess) }
}

/// The share of light that a surface of this index of refraction mirrors at normal incidence.
fn straight(ior: f32) -> f32 {
    ((ior - 1.0) / (ior + 1.0)).powi(2)
}

impl<'a> Materials<'a, '_> {
    /// The finish of a whole surface; of textures, the mean.
    pub(super) fn finish(
        &mut self,
        described: &Described,
        name: &str,
        notes: &mut Notes,
    ) -> Result<Finish, Wrong> {
        let extensions = &described.extensions;
        if let Some(gloss) = &extensions.specular_glossiness {
            let finish = self.of_gloss(gloss, name, notes)?;
            return self.coated(finish, extensions.clearcoat.as_ref(), name, notes);
        }
        let ior = extensions.ior.as_ref().map_or(1.5, |ior| ior.ior);
        // The range of fixed point. In glTF, 0 stands for a perfect mirror, which a large index approximates.
        let ior = ior.clamp(0.14, 7.0);
        let (metallic, roughness) = self.metallic_roughness(described, notes)?;
        let is_metal = metallic >= 0.5;
        let highlight = highlight(roughness, if is_metal { 1.0 } else { straight(ior) });
        let mut finish = Finish { is_metal, mirror: None, ior, sharpness: sharpness(roughness), highlight };
        if let Some(specular) = extensions.specular.as_ref().filter(|_| !is_metal) {
            let strength = share(specular.specular_factor);
            finish.sharpness *= strength;
            finish.highlight.0 *= strength;
            finish.mirror = Some(rgb(specular.specular_color_factor));
            if specular.specular_texture.is_some() || specular.specular_color_texture.is_some() {
                notes.add(name, "the textures of `KHR_materials_specular` are left out");
            }
        }
        self.coated(finish, extensions.clearcoat.as_ref(), name, notes)
    }

    /// The finish by specular color and glossiness.
    fn of_gloss(
        &mut self,
        gloss: &SpecularGlossiness,
        name: &str,
        notes: &mut Notes,
    ) -> Result<Finish, Wrong> {
        let texture = gloss.specular_glossiness_texture.as_ref();
        let mut specular = match (gloss.specular_factor, texture) {
            (Some(factor), _) => factor.map(share),
            (None, Some(_)) => [1.0; 3],
            (None, None) => {
                notes.add(name, "it has no specular color: that of plastic is used, and not a white mirror");
                [PLASTIC; 3]
            }
        };
        let mut glossiness = share(gloss.glossiness_factor);
        if let Some(info) = texture
            && let Some(picture) = self.textures.picture(info.index, notes)?
        {
            let [r, g, b] = picture.light();
            specular = [specular[0] * r, specular[1] * g, specular[2] * b];
            glossiness *= picture.numbers()[3];
            notes.add(name, "the mean of the specular-glossiness texture is used");
        }
        let roughness = 1.0 - glossiness;
        let most = specular.into_iter().fold(0.0, f32::max);
        let is_metal = most > MOST_OF_COATS;
        let root = most.min(MOST_OF_COATS).sqrt();
        Ok(Finish {
            is_metal,
            mirror: is_metal.then(|| rgb(specular)),
            ior: (1.0 + root) / (1.0 - root),
            sharpness: if most > 0.0 { sharpness(roughness) } else { 0.0 },
            highlight: highlight(roughness, most),
        })
    }

    /// A surface under a clear coat.
    fn coated(
        &mut self,
        finish: Finish,
        coat: Option<&Clearcoat>,
        name: &str,
        notes: &mut Notes,
    ) -> Result<Finish, Wrong> {
        let Some(coat) = coat else { return Ok(finish) };
        let [factor, ..] = self.mean(coat.clearcoat_texture.as_ref(), notes)?;
        let factor = share(coat.clearcoat_factor) * factor;
        let [_, rough, ..] = self.mean(coat.clearcoat_roughness_texture.as_ref(), notes)?;
        let roughness = share(coat.clearcoat_roughness_factor) * rough;
        if factor <= 0.0 {
            return Ok(finish);
        }
        if finish.is_metal && finish.sharpness > 0.0 {
            notes.add(name, "the clear coat is left out, as the metal below it mirrors more");
            return Ok(finish);
        }
        let (strength, shininess) = highlight(roughness, PLASTIC);
        let bright = if strength * factor > finish.highlight.0 {
            (strength * factor, shininess)
        } else {
            finish.highlight
        };
        // A rough metal is diffuse in its color, and so looks like paint below the coat.
        let ior = if finish.is_metal { 1.5 } else { finish.ior };
        let sharpness = finish.sharpness.max(sharpness(roughness) * factor);
        let mirror = if finish.is_metal { None } else { finish.mirror };
        Ok(Finish { is_metal: false, mirror, ior, sharpness, highlight: bright })
    }

    /// The mean of a texture's numbers; 1 without a texture.
    fn mean(&mut self, info: Option<&TextureInfo>, notes: &mut Notes) -> Result<[f32; 4], Wrong> {
        let Some(info) = info else { return Ok([1.0; 4]) };
        Ok(self.textures.picture(info.index, notes)?.map_or([1.0; 4], |picture| picture.numbers()))
    }

    /// The metallic and roughness factors of a surface; of a texture, the mean.
    fn metallic_roughness(&mut self, described: &Described, notes: &mut Notes) -> Result<(f32, f32), Wrong> {
        let pbr = &described.pbr_metallic_roughness;
        let [_, rough, metal, _] = self.mean(pbr.metallic_roughness_texture.as_ref(), notes)?;
        Ok((share(pbr.metallic_factor) * metal, share(pbr.roughness_factor) * rough))
    }

    /// The finish by texel, where the texels differ; `None` if they do not, or if the mean is used for
    /// another reason. `halvings` is that of the mesh's texture coordinates.
    pub(super) fn texels(
        &mut self,
        described: &Described,
        name: &str,
        halvings: Option<u8>,
        notes: &mut Notes,
    ) -> Result<Option<Texels<'a>>, Wrong> {
        let pbr = &described.pbr_metallic_roughness;
        let Some(info) = &pbr.metallic_roughness_texture else { return Ok(None) };
        let extensions = &described.extensions;
        if extensions.specular_glossiness.is_some() {
            return Ok(None);
        }
        let Some(picture) = self.textures.picture(info.index, notes)? else { return Ok(None) };
        let ior = extensions.ior.as_ref().map_or(1.5, |ior| ior.ior).clamp(0.14, 7.0);
        let factors = (share(pbr.metallic_factor), share(pbr.roughness_factor));
        let Some(model) = TexelModel::new(&picture, factors, straight(ior)) else { return Ok(None) };
        let is_plain = described.alpha_mode == "OPAQUE"
            && extensions.transmission.is_none()
            && extensions.clearcoat.is_none()
            && extensions.specular.is_none();
        let is_placed = self.coordinates_of(info).are_those_of(&self.coordinates_in(described));
        let Some(halvings) = halvings.filter(|_| is_plain && is_placed) else {
            notes.add(name, "the mean of the metallic-roughness texture is used");
            return Ok(None);
        };
        let mut maps = Vec::new();
        let mut map = |ontos: &[Onto], placed: &'a Placed<'a>| {
            maps.extend(ontos.iter().map(|onto| Map { onto: *onto, texture: Texture::Placed(placed) }));
        };
        if model.has_metal {
            let [diffuse] = self.grays(&picture, |texel| model.diffuse(texel), halvings)?;
            map(&[Onto::Ambient, Onto::Diffuse], diffuse);
        }
        if model.reflectance > 0.0 {
            let level = |texel| model.reflectance(texel) / model.reflectance;
            let [reflectance] = self.grays(&picture, level, halvings)?;
            map(&[Onto::Reflectance], reflectance);
        }
        let (specular, _) = model.highlight;
        if specular > 0.0 {
            let level = |texel| model.specular(texel) / specular;
            let [placed] = self.grays(&picture, level, halvings)?;
            map(&[Onto::Specular], placed);
        }
        let TexelModel { has_metal, reflectance, highlight, .. } = model;
        Ok(Some(Texels { has_metal, reflectance, highlight, maps }))
    }

    /// An image of gray levels from 0 to 1.
    fn grays(
        &mut self,
        picture: &Picture<'a>,
        level: impl Fn([u8; 4]) -> f32,
        halvings: u8,
    ) -> Result<[&'a Placed<'a>; 1], Wrong> {
        let mut plain = [0u8; 256];
        plain.iter_mut().zip(0..=u8::MAX).for_each(|(gray, level)| *gray = level);
        self.textures.grays(picture, |texel| byte(level(texel)), [plain], halvings)
    }
}

/// The coefficients of a material as functions of the texel.
#[derive(Clone, Copy, Debug)]
struct TexelModel {
    /// The metallic and roughness factors.
    factors: (f32, f32),
    /// The share of light that texels without metal mirror at normal incidence.
    straight: f32,
    /// Whether any texel is a metal.
    has_metal: bool,
    /// The largest reflectance of all texels.
    reflectance: f32,
    /// The largest strength of all highlights, and the exponent of their mean roughness.
    highlight: (f32, f32),
}

impl TexelModel {
    /// The model of a picture; `None` if its texels hardly differ.
    fn new(picture: &Picture<'_>, factors: (f32, f32), straight: f32) -> Option<Self> {
        let none = Self { factors, straight, has_metal: false, reflectance: 0.0, highlight: (0.0, 0.0) };
        let mut has_metal = false;
        picture.each(|texel, count| has_metal |= count > 0 && none.metallic(texel) >= 0.5);
        let mut model = Self { has_metal, ..none };
        let (mut least, mut most) = ([f32::INFINITY; 2], [0.0f32; 2]);
        let (mut brightest, mut shiny, mut roughness) = (0.0f32, 0.0f64, 0.0f64);
        picture.each(|texel, count| {
            if count == 0 {
                return;
            }
            let found = [model.diffuse(texel), model.reflectance(texel)];
            for ((least, most), found) in least.iter_mut().zip(&mut most).zip(found) {
                (*least, *most) = (least.min(found), most.max(found));
            }
            let strength = model.specular(texel);
            brightest = brightest.max(strength);
            if strength > 0.0 {
                shiny += count as f64;
                roughness += count as f64 * f64::from(model.roughness(texel));
            }
        });
        if least.iter().zip(&most).all(|(least, most)| most - least <= EVEN) {
            return None;
        }
        model.reflectance = most[1];
        if brightest > 0.0 {
            let (_, shininess) = highlight((roughness / shiny) as f32, 1.0);
            model.highlight = (brightest, shininess);
        }
        Some(model)
    }

    fn metallic(&self, [_, _, blue, _]: [u8; 4]) -> f32 {
        self.factors.0 * f32::from(blue) / 255.0
    }

    fn roughness(&self, [_, green, ..]: [u8; 4]) -> f32 {
        self.factors.1 * f32::from(green) / 255.0
    }

    /// The factor of diffuse and ambient light.
    fn diffuse(&self, texel: [u8; 4]) -> f32 {
        if self.has_metal { 1.0 - self.metallic(texel) * sharpness(self.roughness(texel)) } else { 1.0 }
    }

    /// The share of mirrored light. Without metals, Fresnel's equations apply to it.
    fn reflectance(&self, texel: [u8; 4]) -> f32 {
        let metallic = self.metallic(texel);
        let of_material = if self.has_metal { metallic + (1.0 - metallic) * self.straight } else { 1.0 };
        sharpness(self.roughness(texel)) * of_material
    }

    /// The strength of the highlight.
    fn specular(&self, texel: [u8; 4]) -> f32 {
        let metallic = self.metallic(texel);
        highlight(self.roughness(texel), metallic + (1.0 - metallic) * self.straight).0
    }
}
