//! Shapes of each kind around a glass prism.

use crate::background::Background;
use crate::camera::Camera;
use crate::color::LinearRgb;
use crate::light::Light;
use crate::material::Material;
use crate::math::Vec3;
use crate::scene::{Object, Scene};
use crate::shape::{Cone, Cylinder, Plane, Polygon, Shape, Sphere, Triangle};
use crate::texture::{Checker, Texture};

const fn at(x: f32, y: f32, z: f32) -> Vec3 {
    Vec3::new(x, y, z)
}

const fn polygon(vertices: &'static [Vec3], material: u16) -> Object<Shape<'static>> {
    Object::new(Shape::Polygon(Polygon::new(vertices)), material)
}

const fn glossy(r: f32, g: f32, b: f32) -> Material<'static> {
    Material {
        ambient: 0.1,
        diffuse: 0.8,
        specular: 0.3,
        shininess: 40.0,
        ..Material::matte(LinearRgb::new(r, g, b))
    }
}

// The corners of the prism: its triangular front (z = 2.6) and back (z = 0.6). All faces turn outward.
const FRONT: [Vec3; 3] = [at(-1.1, 0.02, 2.6), at(1.1, 0.02, 2.6), at(0.0, 1.7, 2.6)];
const BACK: [Vec3; 3] = [at(-1.1, 0.02, 0.6), at(1.1, 0.02, 0.6), at(0.0, 1.7, 0.6)];

const GLASS: u16 = 0;
const FLOOR: u16 = 1;
const MIRROR: u16 = 2;
const RED: u16 = 3;
const GREEN: u16 = 4;
const BLUE: u16 = 5;
const GOLD: u16 = 6;
const CHECKERED: u16 = 7;

/// A glass prism among a sphere, a star, a leaf, a pipe, a cylinder and two cones, on an infinite plane.
pub static PRISM: Scene<'static> = Scene {
    camera: Camera {
        eye: at(0.6, 3.4, 9.6),
        target: at(0.1, 1.3, 0.0),
        up: at(0.0, 1.0, 0.0),
        vertical_fov: 38f32.to_radians(),
        lens: None,
    },
    background: Background::Solid(LinearRgb::new(0.35, 0.5, 0.7)),
    objects: &[
        Object::new(Shape::Plane(Plane::new(at(0.0, 0.0, 0.0), at(0.0, 1.0, 0.0))), FLOOR),
        // The prism: two triangles and three rectangles.
        Object::new(Shape::Triangle(Triangle::flat(FRONT[0], FRONT[1], FRONT[2])), GLASS),
        Object::new(Shape::Triangle(Triangle::flat(BACK[1], BACK[0], BACK[2])), GLASS),
        polygon(&[FRONT[0], BACK[0], BACK[1], FRONT[1]], GLASS),
        polygon(&[FRONT[1], BACK[1], BACK[2], FRONT[2]], GLASS),
        polygon(&[FRONT[2], BACK[2], BACK[0], FRONT[0]], GLASS),
        Object::new(Shape::Sphere(Sphere::new(at(2.3, 1.0, -0.4), 1.0)), MIRROR),
        // A star: concave, and seen through the prism.
        polygon(
            &[
                at(0.0, 3.8, -2.2),
                at(-0.4, 2.6, -2.2),
                at(-1.6, 2.5, -2.2),
                at(-0.65, 1.75, -2.2),
                at(-1.0, 0.55, -2.2),
                at(0.0, 1.25, -2.2),
                at(1.0, 0.55, -2.2),
                at(0.65, 1.75, -2.2),
                at(1.6, 2.5, -2.2),
                at(0.4, 2.6, -2.2),
            ],
            GOLD,
        ),
        // A leaf: one triangle, shaded as if it were bent.
        Object::new(
            Shape::Triangle(Triangle {
                vertices: [at(-2.7, 0.05, 2.6), at(-1.5, 0.05, 3.1), at(-2.2, 1.2, 2.6)],
                normals: Some([at(-1.0, 0.2, 0.6), at(0.9, 0.3, 1.0), at(0.0, 1.0, 0.4)]),
            }),
            GREEN,
        ),
        // A pipe without lids, tilted so that one can look into it.
        Object::new(
            Shape::Cylinder(Cylinder {
                base: at(1.8, 0.5, 3.2),
                top: at(3.0, 0.9, 2.2),
                radius: 0.45,
                capped: false,
            }),
            BLUE,
        ),
        Object::new(
            Shape::Cylinder(Cylinder {
                base: at(-3.0, 0.0, 0.4),
                top: at(-3.0, 1.4, 0.4),
                radius: 0.75,
                capped: true,
            }),
            CHECKERED,
        ),
        // A cone with its lid on the floor, and an open frustum as a lampshade above the cylinder.
        Object::new(
            Shape::Cone(Cone {
                base: at(3.9, 0.0, -2.4),
                base_radius: 1.0,
                top: at(3.9, 2.6, -2.4),
                top_radius: 0.0,
                capped: true,
            }),
            RED,
        ),
        Object::new(
            Shape::Cone(Cone {
                base: at(-3.0, 2.1, 0.4),
                base_radius: 0.9,
                top: at(-3.0, 2.9, 0.4),
                top_radius: 0.4,
                capped: false,
            }),
            BLUE,
        ),
    ],
    materials: &[
        Material {
            diffuse: 0.02,
            specular: 0.5,
            shininess: 150.0,
            // The sum is 1, so that no light is lost under total internal reflection.
            reflectance: 0.15,
            transmittance: 0.85,
            ior: 1.5,
            ..Material::matte(LinearRgb::WHITE)
        },
        Material {
            color: Texture::checker_xz(LinearRgb::gray(0.75), LinearRgb::gray(0.55), 1.0),
            ambient: 0.1,
            diffuse: 0.8,
            reflectance: 0.1,
            ..Material::matte(LinearRgb::WHITE)
        },
        Material {
            diffuse: 0.1,
            specular: 0.8,
            shininess: 300.0,
            reflectance: 0.8,
            ..Material::matte(LinearRgb::WHITE)
        },
        glossy(0.8, 0.15, 0.1),
        glossy(0.2, 0.65, 0.2),
        glossy(0.15, 0.3, 0.8),
        glossy(0.9, 0.65, 0.15),
        Material {
            color: Texture::Checker(Checker {
                even: LinearRgb::new(0.85, 0.8, 0.7),
                odd: LinearRgb::new(0.5, 0.2, 0.1),
                cells_per_unit: at(2.0, 2.0, 2.0),
            }),
            ..glossy(1.0, 1.0, 1.0)
        },
    ],
    lights: &[
        Light::Point { position: at(-5.0, 7.0, 7.0), color: LinearRgb::gray(0.7) },
        Light::Directional { direction: at(-1.0, -1.6, -0.8), color: LinearRgb::new(0.45, 0.42, 0.35) },
    ],
    motions: &[],
};
