//! The picture of the first paper on recursive ray tracing (Whitted, "An Improved Illumination Model for
//! Shaded Display", CACM 1980): a hollow glass ball in front of a mirrored one, over a checkered floor.

use crate::background::Background;
use crate::camera::Camera;
use crate::color::LinearRgb;
use crate::light::Light;
use crate::material::Material;
use crate::math::Vec3;
use crate::scene::{Object, Scene};
use crate::shape::{Polygon, Shape, Sphere};
use crate::texture::Texture;

const GLASS: Material = Material {
    diffuse: 0.0,
    specular: 0.6,
    shininess: 200.0,
    // The sum is 1, so that no light is lost under total internal reflection.
    reflectance: 0.07,
    transmittance: 0.93,
    ior: 1.5,
    ..Material::matte(LinearRgb::WHITE)
};
/// The inner surface of the hollow ball: air lies behind it, so the index is the inverse of that of glass.
const AIR: Material =
    Material { specular: 0.0, reflectance: 0.04, transmittance: 0.96, ior: 1.0 / 1.5, ..GLASS };
const MIRROR: Material = Material {
    diffuse: 0.15,
    specular: 0.7,
    shininess: 60.0,
    reflectance: 0.7,
    ..Material::matte(LinearRgb::new(0.7, 0.75, 0.8))
};
const FLOOR: Material = Material {
    color: Texture::checker_xz(LinearRgb::new(0.85, 0.75, 0.1), LinearRgb::new(0.8, 0.08, 0.05), 1.0),
    ambient: 0.15,
    diffuse: 0.85,
    ..Material::matte(LinearRgb::WHITE)
};

/// A hollow glass ball in front of a mirrored one, over a checkered floor. Made for six bounces.
pub static WHITTED: Scene<'static> = Scene {
    camera: Camera {
        eye: Vec3::new(0.0, 2.1, 6.0),
        target: Vec3::new(0.3, 1.45, 0.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 46f32.to_radians(),
        lens: None,
    },
    background: Background::Solid(LinearRgb::new(0.15, 0.4, 0.75)),
    objects: &[
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(-0.35, 2.0, 1.0), 1.1)), 0),
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(-0.35, 2.0, 1.0), 1.0)), 3),
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(1.55, 1.25, -1.2), 1.15)), 1),
        Object::new(
            Shape::Polygon(Polygon::new(&[
                Vec3::new(-5.0, 0.0, 5.0),
                Vec3::new(5.0, 0.0, 5.0),
                Vec3::new(5.0, 0.0, -15.0),
                Vec3::new(-5.0, 0.0, -15.0),
            ])),
            2,
        ),
    ],
    materials: &[GLASS, MIRROR, FLOOR, AIR],
    lights: &[
        Light::Point { position: Vec3::new(-3.0, 9.0, 5.0), color: LinearRgb::gray(0.9) },
        Light::Directional { direction: Vec3::new(-0.5, -1.0, 0.3), color: LinearRgb::gray(0.25) },
    ],
    motions: &[],
};
