//! A table with compound shapes and advanced materials: a die cut out of a cube, gold, colored and clear
//! glass, lacquer.

use crate::background::Background;
use crate::camera::Camera;
use crate::color::LinearRgb;
use crate::falloff::Falloff;
use crate::light::{Lamp, Light, LightCone};
use crate::material::presets::{GLASS, glossy};
use crate::material::{Fresnel, Material, Optics};
use crate::math::Vec3;
use crate::scene::{Object, Scene};
use crate::shape::{Cone, Csg, CsgStep, Cuboid, Ellipsoid, Rectangle, Shape, Solid, Sphere, Torus};
use crate::texture::Texture;

const fn at(x: f32, y: f32, z: f32) -> Vec3 {
    Vec3::new(x, y, z)
}

const WOOD: u16 = 0;
const IVORY: u16 = 1;
const GOLD: u16 = 2;
const CLEAR: u16 = 3;
const BOTTLE: u16 = 4;
const LACQUER: u16 = 5;

static MATERIALS: [Material; 6] = [
    Material {
        ambient: 0.1,
        color: Texture::checker_xz(LinearRgb::new(0.55, 0.4, 0.28), LinearRgb::new(0.25, 0.14, 0.08), 1.0),
        ..Material::matte(LinearRgb::WHITE)
    },
    Material {
        ambient: 0.1,
        specular: 0.3,
        shininess: 60.0,
        ..Material::matte(LinearRgb::new(0.85, 0.8, 0.7))
    },
    Material {
        diffuse: 0.0,
        specular: 0.8,
        shininess: 150.0,
        reflectance: 0.9,
        optics: Some(&Optics { reflection_color: LinearRgb::new(1.0, 0.782, 0.344), ..Optics::PLAIN }),
        ..Material::matte(LinearRgb::gray(0.0))
    },
    GLASS,
    Material {
        optics: Some(&Optics {
            fresnel: Fresnel::Exact,
            absorption: LinearRgb::new(1.1, 0.12, 0.8),
            ..Optics::PLAIN
        }),
        ..GLASS
    },
    glossy(LinearRgb::new(0.6, 0.04, 0.03)),
];

const DIE: Vec3 = at(0.35, 0.7, -0.9);

/// A ball that cuts out a pip, at this offset from the center of the die.
const fn pip(x: f32, y: f32, z: f32) -> CsgStep<Solid<'static>> {
    CsgStep::Solid(Solid::Sphere(Sphere::new(at(DIE.x + x, DIE.y + y, DIE.z + z), 0.16)))
}

/// A cube with round corners, and pips on the three faces in view: one, two and three.
static DIE_STEPS: [CsgStep; 15] = [
    CsgStep::Solid(Solid::Cuboid(Cuboid::oriented(
        DIE,
        [at(0.606, 0.0, -0.35), at(0.0, 0.7, 0.0), at(0.35, 0.0, 0.606)],
    ))),
    CsgStep::Solid(Solid::Sphere(Sphere::new(DIE, 0.98))),
    CsgStep::Intersection,
    pip(0.0, 0.76, 0.0),
    CsgStep::Difference,
    pip(0.2, 0.25, 0.76),
    CsgStep::Difference,
    pip(0.558, -0.25, 0.558),
    CsgStep::Difference,
    pip(-0.46, 0.32, 0.62),
    CsgStep::Difference,
    pip(-0.58, 0.0, 0.4),
    CsgStep::Difference,
    pip(-0.7, -0.32, 0.2),
    CsgStep::Difference,
];

static OBJECTS: [Object<Shape>; 7] = [
    Object::new(
        Shape::Rectangle(Rectangle::new(at(-8.0, 0.0, 8.0), at(16.0, 0.0, 0.0), at(0.0, 0.0, -16.0))),
        WOOD,
    ),
    Object::new(Shape::Csg(Csg::new(&DIE_STEPS)), IVORY),
    Object::new(
        Shape::Torus(Torus {
            center: at(1.75, 0.3, 1.2),
            axis: at(0.0, 1.0, 0.0),
            major_radius: 0.7,
            minor_radius: 0.28,
        }),
        GOLD,
    ),
    Object::new(Shape::Sphere(Sphere::new(at(-1.1, 0.75, 1.3), 0.73)), CLEAR),
    Object::new(Shape::Ellipsoid(Ellipsoid::new(at(-2.2, 1.21, -0.9), at(0.7, 1.2, 0.7))), BOTTLE),
    Object::new(Shape::Sphere(Sphere::new(at(0.45, 0.36, 2.2), 0.35)), LACQUER),
    Object::new(
        Shape::Cone(Cone {
            base: at(2.6, 0.01, -1.5),
            base_radius: 0.8,
            top: at(2.6, 1.9, -1.5),
            top_radius: 0.15,
            capped: true,
        }),
        LACQUER,
    ),
];

/// A die, gold, colored and clear glass, and lacquer on a wooden table. Made for six bounces.
pub static TABLE: Scene<'static> = Scene {
    camera: Camera {
        eye: at(0.3, 3.1, 7.4),
        target: at(0.15, 0.75, 0.0),
        up: at(0.0, 1.0, 0.0),
        vertical_fov: 36f32.to_radians(),
        lens: None,
    },
    background: Background::Solid(LinearRgb::new(0.12, 0.15, 0.2)),
    objects: &OBJECTS,
    materials: &MATERIALS,
    lights: &[
        Light::Lamp(Lamp {
            position: at(-4.0, 7.0, 5.0),
            color: LinearRgb::new(2.6, 2.4, 2.0),
            falloff: Falloff { constant: 1.0, linear: 0.0, quadratic: 0.015 },
            cone: Some(LightCone { direction: at(4.2, -6.5, -5.0), bright: 0.3, dark: 0.55 }),
        }),
        Light::Directional { direction: at(-1.0, -1.2, -0.4), color: LinearRgb::new(0.2, 0.24, 0.3) },
        Light::Ambient { color: LinearRgb::new(0.8, 0.9, 1.0) },
    ],
    motions: &[],
};
