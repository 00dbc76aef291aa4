//! The sphereflake (Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A 1987): a ball with
//! nine balls of a third of its radius on it, each with nine smaller balls on it, and so on.

// The arrays are filled by the compiler: an index out of range would be a compile error.
#![allow(clippy::indexing_slicing)]

use crate::background::Background;
use crate::camera::Camera;
use crate::color::LinearRgb;
use crate::light::Light;
use crate::material::Material;
use crate::math::Vec3;
use crate::scene::{Object, Scene};
use crate::shape::{Polygon, Shape, Sphere};

/// The directions from a parent's center to its nine children, if the parent touches its own parent at -z:
/// three above, 120° apart, and six around the equator, 60° apart.
const DIRECTIONS: [[f32; 3]; 9] = [
    [0.408_248_3, 0.408_248_3, 0.816_496_6],
    [0.149_429_25, -0.557_677_5, 0.816_496_6],
    [-0.557_677_5, 0.149_429_25, 0.816_496_6],
    [0.965_925_8, 0.258_819_04, 0.0],
    [0.258_819_04, 0.965_925_8, 0.0],
    [-0.707_106_77, 0.707_106_77, 0.0],
    [-0.965_925_8, -0.258_819_04, 0.0],
    [-0.258_819_04, -0.965_925_8, 0.0],
    [0.707_106_77, -0.707_106_77, 0.0],
];

/// The vector `local`, turned so that +z becomes the unit vector `axis` (Duff et al., "Building an
/// Orthonormal Basis, Revisited", JCGT 2017).
const fn turned(local: [f32; 3], axis: [f32; 3]) -> [f32; 3] {
    let ([u, v, w], [x, y, z]) = (local, axis);
    let sign = if z < 0.0 { -1.0 } else { 1.0 };
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [
        u * (1.0 + sign * x * x * a) + v * b + w * x,
        u * (sign * b) + v * (sign + y * y * a) + w * y,
        u * (-sign * x) + v * (-y) + w * z,
    ]
}

const FLOOR: [Vec3; 4] = [
    Vec3::new(12.0, 12.0, -0.5),
    Vec3::new(-12.0, 12.0, -0.5),
    Vec3::new(-12.0, -12.0, -0.5),
    Vec3::new(12.0, -12.0, -0.5),
];

/// The floor, followed by `OBJECTS - 1` balls, the largest first.
const fn objects<const OBJECTS: usize>() -> [Object<Shape<'static>>; OBJECTS] {
    let mut objects = [Object::new(Shape::Polygon(Polygon::new(&FLOOR)), 0); OBJECTS];
    let mut spheres = [(Vec3::new(0.0, 0.0, 0.0), 0.5, [0.0, 0.0, 1.0]); OBJECTS];
    let count = OBJECTS - 1;
    let mut child = 1;
    let mut i = 0;
    while i < count {
        let (center, radius, axis) = spheres[i];
        objects[i + 1] = Object::new(Shape::Sphere(Sphere::new(center, radius)), 1);
        // Add children until the array is full.
        let mut k = 0;
        while k < DIRECTIONS.len() && child < count {
            let outward = turned(DIRECTIONS[k], axis);
            let distance = radius * (4.0 / 3.0);
            let [x, y, z] = outward;
            let at = Vec3::new(center.x + x * distance, center.y + y * distance, center.z + z * distance);
            spheres[child] = (at, radius / 3.0, outward);
            child += 1;
            k += 1;
        }
        i += 1;
    }
    objects
}

static TWO_SIZES: [Object<Shape<'static>>; 1 + 10] = objects();
static THREE_SIZES: [Object<Shape<'static>>; 1 + 91] = objects();
// Too large for processors that address 64 KB.
#[cfg(not(target_pointer_width = "16"))]
static FOUR_SIZES: [Object<Shape<'static>>; 1 + 820] = objects();

const fn light(x: f32, y: f32, z: f32) -> Light {
    // Three lights of intensity 1/√3 each, as in the file format NFF.
    Light::Point { position: Vec3::new(x, y, z), color: LinearRgb::gray(0.577_350_26) }
}

/// The sphereflake of 10 mirroring balls over a floor.
pub static FLAKE_10: Scene<'static> = scene(&TWO_SIZES);

/// The sphereflake of 91 mirroring balls over a floor.
pub static FLAKE: Scene<'static> = scene(&THREE_SIZES);

/// The sphereflake of 820 mirroring balls over a floor.
// Too large for processors that address 64 KB.
#[cfg(not(target_pointer_width = "16"))]
pub static FLAKE_820: Scene<'static> = scene(&FOUR_SIZES);

const fn scene(objects: &'static [Object<Shape<'static>>]) -> Scene<'static> {
    Scene {
        camera: Camera {
            eye: Vec3::new(2.1, 1.3, 1.7),
            target: Vec3::new(0.0, 0.0, 0.0),
            up: Vec3::new(0.0, 0.0, 1.0),
            vertical_fov: 45f32.to_radians(),
            lens: None,
        },
        background: Background::Solid(LinearRgb::new(0.078, 0.361, 0.753)),
        objects,
        materials: &MATERIALS,
        lights: &LIGHTS,
        motions: &[],
    }
}

static MATERIALS: [Material; 2] = [
    Material { diffuse: 0.8, ..Material::matte(LinearRgb::new(1.0, 0.75, 0.33)) },
    Material {
        diffuse: 0.5,
        specular: 0.5,
        shininess: 3.0827,
        reflectance: 0.5,
        ..Material::matte(LinearRgb::new(1.0, 0.9, 0.7))
    },
];

static LIGHTS: [Light; 3] = [light(4.0, 3.0, 2.0), light(1.0, -4.0, 4.0), light(-3.0, 1.0, 5.0)];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ball_touches_a_larger_one_and_none_overlap() {
        for (scene, count) in [(&FLAKE_10, 10), (&FLAKE, 91), (&FLAKE_820, 820)] {
            let spheres: Vec<Sphere> = scene
                .objects
                .iter()
                .filter_map(|object| match object.shape {
                    Shape::Sphere(sphere) => Some(sphere),
                    _ => None,
                })
                .collect();
            assert_eq!(spheres.len(), count);
            let gap = |a: &Sphere, b: &Sphere| (a.center - b.center).length() - a.radius - b.radius;
            for (i, small) in spheres.iter().enumerate().skip(1) {
                let parent = &spheres[(i - 1) / 9];
                assert!(gap(small, parent).abs() < 1e-5, "{i} does not touch its parent");
                for other in &spheres[..i] {
                    assert!(gap(small, other) > -1e-5, "{i} overlaps another ball");
                }
            }
        }
    }
}
