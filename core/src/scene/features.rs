//! The cargo features that a scene needs.

use super::Scene;
use crate::light::Light;
use crate::limits::FEW_OBJECTS;
use crate::material::Material;

/// The features that only make drawing faster: the bytes of a picture are the same without them.
pub const FASTER: [&str; 2] = ["candidates", "hierarchy"];

impl<S> Scene<'_, S> {
    /// The names of the features of this crate that the scene needs or that make it faster ([`FASTER`]). A
    /// program that draws only this scene saves flash by leaving out the others.
    pub fn features(&self) -> impl Iterator<Item = &'static str> {
        let has_optics =
            self.lights.iter().any(Light::needs_optics) || self.materials.iter().any(Material::needs_optics);
        let has_textures =
            self.background.needs_textures() || self.materials.iter().any(Material::needs_textures);
        let has_distributed = self.camera.lens.is_some()
            || self.materials.iter().any(Material::needs_distributed)
            || self.lights.iter().any(Light::needs_distributed)
            || !self.motions.is_empty();
        let has_few = self.objects.len() <= FEW_OBJECTS;
        let all = [
            ("candidates", has_few),
            ("distributed", has_distributed),
            ("hierarchy", !has_few),
            ("optics", has_optics),
            ("textures", has_textures),
        ];
        all.into_iter().filter_map(|(feature, is_needed)| is_needed.then_some(feature))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::background::{Background, Sky};
    use crate::builtin::{CLASSIC, FLAKE};
    use crate::color::LinearRgb;
    use crate::texture::{Figure, Placed, Placement, Squares, Texture};

    #[test]
    fn a_scene_tells_what_it_needs() {
        let needs = |scene: &Scene| scene.features().collect::<Vec<_>>();
        assert_eq!(needs(&CLASSIC), ["candidates"]);
        assert_eq!(needs(&FLAKE), ["hierarchy"]);
        let lights = [Light::Ambient { color: LinearRgb::WHITE }];
        assert_eq!(needs(&Scene { lights: &lights, ..CLASSIC }), ["candidates", "optics"]);
        let squares = Squares { even: LinearRgb::WHITE, odd: LinearRgb::gray(0.5) };
        let placed = Placed::new(Figure::Squares(squares), Placement::SURFACE);
        let materials = [Material { color: Texture::Placed(&placed), ..Material::matte(LinearRgb::WHITE) }];
        assert_eq!(needs(&Scene { materials: &materials, ..CLASSIC }), ["candidates", "textures"]);
        let sky = Sky::new(LinearRgb::WHITE, LinearRgb::gray(0.5));
        let background = Background::Gradient(&sky);
        assert_eq!(needs(&Scene { background, ..CLASSIC }), ["candidates", "textures"]);
    }
}
