//! Measures the light on a surface by rays of the core, in scenes whose materials show one quantity alone.

use bumpalo::Bump;
use rayline::math::{Interval, Ray};
use rayline::{Light as Lamp, Map, Material, Onto, PreparedScene, Renderer, Scene, Texture, Through};

use super::face::has_inside;
use super::photon_map::PhotonMap;
use super::{Light, Vector};

/// The places where a lamp with a size, or the sky, is sampled for one texel.
pub(super) const SAMPLES: u16 = 64;

/// Measures light.
pub(super) struct LightProbe<'p> {
    pub(super) scene: &'p Scene<'p>,
    /// The scene in white, lit by its lamps.
    pub(super) white: &'p PreparedScene<'p, f64>,
    pub(super) lit: Renderer<'p, 'p, f64>,
    /// The scene in its own colors, lit evenly and from everywhere.
    pub(super) colored: Renderer<'p, 'p, f64>,
    /// The scene in black, which shows what it emits.
    pub(super) glowing: Renderer<'p, 'p, f64>,
    /// The light of lamps that comes over mirrors and through glass.
    pub(super) photons: &'p PhotonMap,
    /// A distance that is short in this scene.
    pub(super) short: f64,
}

impl LightProbe<'_> {
    /// Whether a place is hidden: inside of a body, or closer than `reach` below another surface.
    pub(super) fn is_hidden(&self, (point, normal): (Vector, Vector), reach: f64) -> bool {
        let ray = Ray { origin: point + normal * self.short, direction: normal };
        self.white.closest_hit(&ray, Interval::AHEAD).is_some_and(|hit| {
            let Some(object) = self.scene.objects.get(hit.object) else { return false };
            let material = self.scene.material_of(object);
            // A place behind a transparent surface is visible, such as a place in water.
            if material.is_some_and(|material| material.transmittance > 0.0) {
                return false;
            }
            let is_body = has_inside(&object.shape);
            hit.t < reach || (is_body && hit.surface.normal.dot(normal) > 0.0)
        })
    }

    /// The share of light that gets from one place to another.
    pub(super) fn through(&self, from: Vector, to: Vector) -> Light {
        let (direction, distance) = (to - from).unit_and_length();
        match self.white.light_through(&Ray { origin: from, direction }, distance - self.short) {
            Through::All => Light::new(1.0, 1.0, 1.0),
            Through::Some(share) => share,
            _ => Light::BLACK,
        }
    }

    /// The share of light that a surface scatters.
    pub(super) fn reflectance(&self, place: (Vector, Vector)) -> Light {
        self.colored.light_along(&self.toward(place), (0, 0), 0)
    }

    /// The light that a surface emits.
    pub(super) fn emission(&self, place: (Vector, Vector)) -> Light {
        self.glowing.light_along(&self.toward(place), (0, 0), 0)
    }

    /// The light of a texel in white under the lamps, with the light that it emits. The light is measured at
    /// `places` of the texel.
    pub(super) fn shown(&self, places: &[(Vector, Vector)], texel: usize) -> Light {
        if places.is_empty() {
            return Light::BLACK;
        }
        let has_size = |lamp: &Lamp| matches!(lamp, Lamp::Object(_) | Lamp::Sky);
        let samples = if self.scene.lights.iter().any(has_size) { SAMPLES } else { 1 };
        let each = usize::from(samples).div_ceil(places.len());
        let mut sum = Light::BLACK;
        for (index, place) in places.iter().enumerate() {
            for sample in 0..each {
                // Texels draw other numbers than their neighbors, as pixels do.
                let drawn = ((texel & 0xFFFF) as u16, (texel >> 16) as u16);
                let sample = (index * each + sample) as u16;
                sum = sum + self.lit.light_along(&self.toward(*place), drawn, sample);
            }
        }
        sum * (1.0 / (each * places.len()) as f64)
    }

    /// The ray that meets a place of a surface from straight above.
    fn toward(&self, (point, normal): (Vector, Vector)) -> Ray<f64> {
        Ray { origin: point + normal * self.short, direction: -normal }
    }
}

/// The scene with other materials.
pub(super) fn with_materials<'a>(
    scene: &Scene<'a>,
    arena: &'a Bump,
    lights: &'a [Lamp],
    change: impl Fn(&Material<'a>) -> Material<'a>,
) -> Scene<'a> {
    let materials = scene.materials.iter().map(change);
    Scene { materials: arena.alloc_slice_fill_iter(materials), lights, motions: &[], ..*scene }
}

/// A matte material in white, which lets through as much light as before.
pub(super) fn in_white<'a>(material: &Material<'a>) -> Material<'a> {
    Material {
        color: Texture::Solid(rayline::LinearRgb::WHITE),
        ambient: 0.0,
        diffuse: 1.0,
        specular: 0.0,
        reflectance: 0.0,
        ..*material
    }
}

/// The material without light that it lets through.
pub(super) fn closed<'a>(material: &Material<'a>) -> Material<'a> {
    Material { transmittance: 0.0, ..*material }
}

/// A material that shows the light which it would scatter in even light of 1.
pub(super) fn in_color<'a>(material: &Material<'a>, arena: &'a Bump) -> Material<'a> {
    let maps = material.maps.iter().filter(|map| map.onto == Onto::Diffuse);
    let maps: Vec<_> = maps.map(|map| Map { onto: Onto::Ambient, ..*map }).collect();
    Material {
        ambient: material.diffuse,
        diffuse: 0.0,
        specular: 0.0,
        reflectance: 0.0,
        transmittance: 0.0,
        optics: None,
        maps: arena.alloc_slice_copy(&maps),
        ..*material
    }
}

/// A material that shows only the light which it emits.
pub(super) fn in_black<'a>(material: &Material<'a>) -> Material<'a> {
    Material { ambient: 0.0, diffuse: 0.0, specular: 0.0, reflectance: 0.0, transmittance: 0.0, ..*material }
}
