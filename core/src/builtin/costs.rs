//! Scenes with one kind of shape each, to measure its cost.

use crate::background::Background;
use crate::camera::Camera;
use crate::color::LinearRgb;
use crate::light::Light;
use crate::material::Material;
use crate::math::Vec3;
use crate::scene::{Object, Scene};
use crate::shape::{Csg, CsgStep, Cuboid, Mesh, Plane, Shape, Solid, Sphere, Torus};
use crate::texture::Texture;

const MATERIALS: [Material; 2] = [
    Material {
        color: Texture::checker_xz(LinearRgb::gray(0.7), LinearRgb::gray(0.3), 1.0),
        ..Material::matte(LinearRgb::WHITE)
    },
    Material {
        ambient: 0.1,
        diffuse: 0.7,
        specular: 0.4,
        shininess: 60.0,
        reflectance: 0.2,
        ..Material::matte(LinearRgb::new(0.7, 0.3, 0.1))
    },
];

const LIGHTS: [Light; 1] =
    [Light::Point { position: Vec3::new(-4.0, 6.0, 5.0), color: LinearRgb::gray(0.9) }];

const FLOOR: Object<Shape<'static>> =
    Object::new(Shape::Plane(Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0))), 0);

/// A scene with these objects.
const fn of(objects: &'static [Object<Shape<'static>>]) -> Scene<'static> {
    Scene {
        camera: Camera {
            eye: Vec3::new(0.0, 2.6, 4.6),
            target: Vec3::new(0.0, 0.8, 0.0),
            up: Vec3::new(0.0, 1.0, 0.0),
            vertical_fov: 0.7,
            lens: None,
        },
        background: Background::Solid(LinearRgb::new(0.3, 0.4, 0.6)),
        objects,
        materials: &MATERIALS,
        lights: &LIGHTS,
        motions: &[],
    }
}

const fn ball(x: f32, radius: f32) -> Object<Shape<'static>> {
    Object::new(Shape::Sphere(Sphere::new(Vec3::new(x, radius, 0.0), radius)), 1)
}

/// Three balls on a plane.
pub static SPHERES: Scene<'static> = of(&[FLOOR, ball(-1.4, 0.6), ball(0.0, 0.8), ball(1.4, 0.6)]);

/// A torus on a plane.
pub static TORUS: Scene<'static> = of(&[
    FLOOR,
    Object::new(
        Shape::Torus(Torus {
            center: Vec3::new(0.0, 0.9, 0.0),
            axis: Vec3::new(0.3, 1.0, 0.8),
            major_radius: 1.0,
            minor_radius: 0.35,
        }),
        1,
    ),
]);

const MIDDLE: Vec3 = Vec3::new(0.0, 0.9, 0.0);

/// A cube with rounded corners and a round dent, on a plane.
pub static CSG: Scene<'static> = of(&[
    FLOOR,
    Object::new(
        Shape::Csg(Csg::new(&[
            CsgStep::Solid(Solid::Cuboid(Cuboid::aligned(
                Vec3::new(-0.9, 0.0, -0.9),
                Vec3::new(0.9, 1.8, 0.9),
            ))),
            CsgStep::Solid(Solid::Sphere(Sphere::new(MIDDLE, 1.25))),
            CsgStep::Intersection,
            CsgStep::Solid(Solid::Sphere(Sphere::new(Vec3::new(0.4, 1.4, 1.0), 0.8))),
            CsgStep::Difference,
        ])),
        1,
    ),
]);

/// A ball of 80 smooth triangles on a plane.
pub static MESH: Scene<'static> = of(&[
    FLOOR,
    Object::new(Shape::Mesh(Mesh { normals: Some(&VERTICES), ..Mesh::new(&RAISED, &TRIANGLES) }), 1),
]);

/// The vertices, raised so that the ball stands on the floor.
const RAISED: [Vec3; 42] = {
    let mut raised = VERTICES;
    let mut i = 0;
    #[allow(clippy::indexing_slicing)]
    while i < raised.len() {
        raised[i].y += 1.0;
        i += 1;
    }
    raised
};

/// An icosahedron whose faces were split into four, with vertices on the unit sphere.
#[rustfmt::skip]
const VERTICES: [Vec3; 42] = [
    Vec3::new(-0.5257, 0.8507, 0.0),
    Vec3::new(0.5257, 0.8507, 0.0),
    Vec3::new(-0.5257, -0.8507, 0.0),
    Vec3::new(0.5257, -0.8507, 0.0),
    Vec3::new(0.0, -0.5257, 0.8507),
    Vec3::new(0.0, 0.5257, 0.8507),
    Vec3::new(0.0, -0.5257, -0.8507),
    Vec3::new(0.0, 0.5257, -0.8507),
    Vec3::new(0.8507, 0.0, -0.5257),
    Vec3::new(0.8507, 0.0, 0.5257),
    Vec3::new(-0.8507, 0.0, -0.5257),
    Vec3::new(-0.8507, 0.0, 0.5257),
    Vec3::new(-0.809, 0.5, 0.309),
    Vec3::new(-0.5, 0.309, 0.809),
    Vec3::new(-0.309, 0.809, 0.5),
    Vec3::new(0.309, 0.809, 0.5),
    Vec3::new(0.0, 1.0, 0.0),
    Vec3::new(0.309, 0.809, -0.5),
    Vec3::new(-0.309, 0.809, -0.5),
    Vec3::new(-0.5, 0.309, -0.809),
    Vec3::new(-0.809, 0.5, -0.309),
    Vec3::new(-1.0, 0.0, 0.0),
    Vec3::new(0.5, 0.309, 0.809),
    Vec3::new(0.809, 0.5, 0.309),
    Vec3::new(-0.5, -0.309, 0.809),
    Vec3::new(0.0, 0.0, 1.0),
    Vec3::new(-0.809, -0.5, -0.309),
    Vec3::new(-0.809, -0.5, 0.309),
    Vec3::new(0.0, 0.0, -1.0),
    Vec3::new(-0.5, -0.309, -0.809),
    Vec3::new(0.809, 0.5, -0.309),
    Vec3::new(0.5, 0.309, -0.809),
    Vec3::new(0.809, -0.5, 0.309),
    Vec3::new(0.5, -0.309, 0.809),
    Vec3::new(0.309, -0.809, 0.5),
    Vec3::new(-0.309, -0.809, 0.5),
    Vec3::new(0.0, -1.0, 0.0),
    Vec3::new(-0.309, -0.809, -0.5),
    Vec3::new(0.309, -0.809, -0.5),
    Vec3::new(0.5, -0.309, -0.809),
    Vec3::new(0.809, -0.5, -0.309),
    Vec3::new(1.0, 0.0, 0.0),
];

#[rustfmt::skip]
const TRIANGLES: [[u16; 3]; 80] = [
    [0, 12, 14], [11, 13, 12], [5, 14, 13], [12, 13, 14], [0, 14, 16], [5, 15, 14],
    [1, 16, 15], [14, 15, 16], [0, 16, 18], [1, 17, 16], [7, 18, 17], [16, 17, 18],
    [0, 18, 20], [7, 19, 18], [10, 20, 19], [18, 19, 20], [0, 20, 12], [10, 21, 20],
    [11, 12, 21], [20, 21, 12], [1, 15, 23], [5, 22, 15], [9, 23, 22], [15, 22, 23],
    [5, 13, 25], [11, 24, 13], [4, 25, 24], [13, 24, 25], [11, 21, 27], [10, 26, 21],
    [2, 27, 26], [21, 26, 27], [10, 19, 29], [7, 28, 19], [6, 29, 28], [19, 28, 29],
    [7, 17, 31], [1, 30, 17], [8, 31, 30], [17, 30, 31], [3, 32, 34], [9, 33, 32],
    [4, 34, 33], [32, 33, 34], [3, 34, 36], [4, 35, 34], [2, 36, 35], [34, 35, 36],
    [3, 36, 38], [2, 37, 36], [6, 38, 37], [36, 37, 38], [3, 38, 40], [6, 39, 38],
    [8, 40, 39], [38, 39, 40], [3, 40, 32], [8, 41, 40], [9, 32, 41], [40, 41, 32],
    [4, 33, 25], [9, 22, 33], [5, 25, 22], [33, 22, 25], [2, 35, 27], [4, 24, 35],
    [11, 27, 24], [35, 24, 27], [6, 37, 29], [2, 26, 37], [10, 29, 26], [37, 26, 29],
    [8, 39, 31], [6, 28, 39], [7, 31, 28], [39, 28, 31], [9, 41, 23], [8, 30, 41],
    [1, 23, 30], [41, 30, 23],
];
