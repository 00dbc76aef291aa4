//! The four-sphere scene on which small ray tracers are compared (Sokolov, "tinyraytracer", 2019).

use crate::background::Background;
use crate::camera::Camera;
use crate::color::LinearRgb;
use crate::light::Light;
use crate::material::Material;
use crate::math::Vec3;
use crate::scene::{Object, Scene};
use crate::shape::{Polygon, Shape, Sphere};
use crate::texture::Texture;

const IVORY: Material = Material {
    diffuse: 0.6,
    specular: 0.3,
    shininess: 50.0,
    reflectance: 0.1,
    ..Material::matte(LinearRgb::new(0.4, 0.4, 0.3))
};
const GLASS: Material = Material {
    diffuse: 0.0,
    specular: 0.5,
    shininess: 125.0,
    reflectance: 0.1,
    transmittance: 0.8,
    ior: 1.5,
    ..Material::matte(LinearRgb::new(0.6, 0.7, 0.8))
};
const RUBBER: Material = Material {
    diffuse: 0.9,
    specular: 0.1,
    shininess: 10.0,
    ..Material::matte(LinearRgb::new(0.3, 0.1, 0.1))
};
const MIRROR: Material = Material {
    diffuse: 0.0,
    specular: 1.0,
    shininess: 1425.0,
    reflectance: 0.8,
    ..Material::matte(LinearRgb::WHITE)
};
const FLOOR: Material = Material {
    color: Texture::checker_xz(LinearRgb::gray(0.3), LinearRgb::new(0.3, 0.2, 0.1), 2.0),
    ..Material::matte(LinearRgb::WHITE)
};

const fn sphere(x: f32, y: f32, z: f32, radius: f32, material: u16) -> Object<Shape<'static>> {
    Object::new(Shape::Sphere(Sphere::new(Vec3::new(x, y, z), radius)), material)
}

const fn light(x: f32, y: f32, z: f32, intensity: f32) -> Light {
    Light::Point { position: Vec3::new(x, y, z), color: LinearRgb::gray(intensity) }
}

/// Four spheres of ivory, glass, rubber and mirror on a checkered floor, under three lights. Made for three
/// bounces.
pub static CLASSIC: Scene<'static> = Scene {
    camera: Camera {
        eye: Vec3::new(0.0, 0.0, 0.0),
        target: Vec3::new(0.0, 0.0, -1.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 60f32.to_radians(),
        lens: None,
    },
    background: Background::Solid(LinearRgb::new(0.2, 0.7, 0.8)),
    objects: &[
        sphere(-3.0, 0.0, -16.0, 2.0, 0),
        sphere(-1.0, -1.5, -12.0, 2.0, 1),
        sphere(1.5, -0.5, -18.0, 3.0, 2),
        sphere(7.0, 5.0, -18.0, 4.0, 3),
        Object::new(
            Shape::Polygon(Polygon::new(&[
                Vec3::new(-10.0, -4.0, -10.0),
                Vec3::new(10.0, -4.0, -10.0),
                Vec3::new(10.0, -4.0, -30.0),
                Vec3::new(-10.0, -4.0, -30.0),
            ])),
            4,
        ),
    ],
    materials: &[IVORY, GLASS, RUBBER, MIRROR, FLOOR],
    lights: &[light(-20.0, 20.0, 20.0, 1.5), light(30.0, 50.0, -25.0, 1.8), light(30.0, 20.0, 30.0, 1.7)],
    motions: &[],
};
