//! A digest of pictures with several samples: all samplers and filters, lamps with a size, a lens, motion,
//! gloss and translucency, and paths.

use core::mem::MaybeUninit;

use rayline::shape::{Disc, Shape, Sphere};
use rayline::{
    Adaptive, AreaLights, Background, Camera, Digest, Integrator, Lens, Light, LinearRgb, Material, Motion,
    Object, ObjectId, Optics, PreparedScene, Real, Reconstruction, Renderer, Sampler, Sampling, Scene,
    Settings, Vec3,
};

/// The memory that is lent for the prepared scene.
const MEMORY: usize = 4096;

static SCENE: Scene<'static> = Scene {
    camera: Camera {
        eye: Vec3::new(0.0, 1.0, 5.0),
        target: Vec3::new(0.0, 0.0, 0.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.6,
        lens: Some(Lens { radius: 0.1, focus: 4.0, blades: 6 }),
    },
    background: Background::gray(0.4),
    objects: &[
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(-0.8, 0.0, 0.0), 0.7)), 0),
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.8, 0.0, 0.5), 0.7)), 1),
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.0, -20.7, 0.0), 20.0)), 2),
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(-3.0, 3.0, 1.0), 0.5)), 3),
        Object::new(Shape::Disc(Disc::new(Vec3::new(3.0, 3.0, 1.0), Vec3::new(1.0, 1.0, 0.0), 0.5)), 3),
    ],
    materials: &[
        Material {
            reflectance: 0.8,
            optics: Some(&Optics { gloss: Some(40.0), ..Optics::PLAIN }),
            ..Material::matte(LinearRgb::new(0.2, 0.1, 0.0))
        },
        Material {
            diffuse: 0.1,
            transmittance: 0.9,
            ior: 1.3,
            optics: Some(&Optics { translucency: Some(300.0), ..Optics::PLAIN }),
            ..Material::matte(LinearRgb::WHITE)
        },
        Material::matte(LinearRgb::new(0.6, 0.7, 0.3)),
        Material {
            diffuse: 0.0,
            optics: Some(&Optics { emission: LinearRgb::gray(9.0), ..Optics::PLAIN }),
            ..Material::matte(LinearRgb::WHITE)
        },
    ],
    lights: &[
        Light::Point { position: Vec3::new(4.0, 6.0, 5.0), color: LinearRgb::gray(0.5) },
        Light::Object(ObjectId(3)),
        Light::Object(ObjectId(4)),
    ],
    motions: &[
        Motion::of_object(0, Vec3::new(0.3, 0.0, 0.1)).spinning(
            Vec3::new(-0.8, 0.0, 0.0),
            Vec3::new(0.0, 1.0, 0.5),
            2.0,
        ),
        Motion::of_object(3, Vec3::new(0.0, 0.2, 0.0)),
        Motion::of_camera(Vec3::new(0.05, 0.0, 0.0)),
    ],
};

const SAMPLERS: [Sampler; 6] =
    [Sampler::R2, Sampler::Grid, Sampler::Random, Sampler::Jittered, Sampler::Poisson, Sampler::Sobol];

const FILTERS: [Reconstruction; 3] = [Reconstruction::Box, Reconstruction::Tent, Reconstruction::Gaussian];

/// Folds the light of small pictures into a digest. If the scene were refused, nothing would be folded.
#[inline(never)]
pub(super) fn update<R: Real>(digest: &mut Digest) {
    let mut memory = [MaybeUninit::uninit(); MEMORY];
    let Ok(scene) = PreparedScene::<R>::new(&SCENE, &mut memory) else { return };
    for sampler in SAMPLERS {
        for filter in FILTERS {
            let adaptive = Some(Adaptive { at_first: 3, ..Adaptive::NEW });
            let sampling = Sampling { sampler, filter, adaptive, ..Sampling::new(5) };
            let (area_lights, integrator) = match filter {
                Reconstruction::Box => (AreaLights::ClosedForm, Integrator::Whitted),
                Reconstruction::Tent => (AreaLights::Sampled, Integrator::Whitted),
                _ => (AreaLights::Sampled, Integrator::PathTracing),
            };
            let settings = Settings { sampling, area_lights, integrator, ..Settings::new(6, 4) };
            let Ok(renderer) = Renderer::new(&scene, settings) else { return };
            for (x, y) in (0..4).flat_map(|y| (0..6).map(move |x| (x, y))) {
                let (light, rays) = renderer.pixel(x, y, &mut ());
                digest.update(&rays.to_le_bytes());
                for channel in light.to_f32().channels() {
                    digest.update(&channel.to_bits().to_le_bytes());
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use rayline::math::Fixed;

    use super::*;

    /// The scene is accepted, and both number systems draw it.
    #[test]
    fn pictures_change_the_digest() {
        for update in [update::<f32>, update::<Fixed>] {
            let mut digest = Digest::new();
            update(&mut digest);
            assert_ne!(digest.value(), Digest::new().value());
        }
    }
}
