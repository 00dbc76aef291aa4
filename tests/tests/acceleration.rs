//! Acceleration never changes a byte: pictures with and without it, of scenes that are given and of random ones.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)]

use std::mem::MaybeUninit;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use proptest::prelude::*;
use rayline::shape::{Cone, Geometry, Plane, Polygon, Shape, Sphere, Triangle};
use rayline::{
    Camera, Light, LinearRgb, Material, Object, PreparedScene, Real, Renderer, Scene, Settings, Vec3,
};
use rayline_tests::{each_scene, with_scene};

fn lines<R: Real, S: Geometry>(scene: &PreparedScene<'_, R, S>, settings: Settings) -> Vec<Rgb888> {
    let renderer = Renderer::new(scene, settings).unwrap();
    let mut pixels = Vec::new();
    for y in 0..settings.height {
        let mut line = vec![Rgb888::BLACK; settings.width as usize];
        renderer.line(y, &mut line).unwrap();
        pixels.extend(line);
    }
    pixels
}

/// The number of pixels that differ.
fn differences<R: Real>(scene: &Scene, settings: Settings) -> usize {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R, _>::new(scene, &mut memory).unwrap();
    let fast = lines(&prepared, settings);
    let slow = lines(&prepared.without_acceleration(), settings);
    fast.iter().zip(&slow).filter(|(fast, slow)| fast != slow).count()
}

fn check(name: &str) {
    with_scene(name, |scene, bounces| {
        for (width, height) in [(160, 120), (97, 31)] {
            let settings = Settings { bounces, ..Settings::new(width, height) };
            assert_eq!(differences::<f32>(scene, settings), 0);
            assert_eq!(differences::<f64>(scene, settings), 0);
        }
        // From close by: objects around and behind the camera.
        let Camera { eye, target, .. } = scene.camera;
        for share in [0.3, 0.8, 0.95] {
            let camera = Camera { eye: eye + (target - eye) * share, ..scene.camera };
            let settings = Settings { bounces, ..Settings::new(64, 48) };
            assert_eq!(differences::<f32>(&Scene { camera, ..*scene }, settings), 0);
        }
    });
}

each_scene!(check);

fn coordinate() -> BoxedStrategy<f32> {
    prop_oneof![4 => -4.0f32..4.0, 1 => (-8i8..8).prop_map(|x| f32::from(x) * 0.5)].boxed()
}

fn vector() -> BoxedStrategy<Vec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(|[x, y, z]| Vec3::new(x, y, z)).boxed()
}

fn shape() -> BoxedStrategy<Shape<'static>> {
    prop_oneof![
        5 => (vector(), 0.01f32..3.0).prop_map(|(center, radius)| Shape::Sphere(Sphere::new(center, radius))),
        1 => (vector(), vector()).prop_map(|(point, normal)| Shape::Plane(Plane::new(point, normal))),
        2 => [vector(), vector(), vector()].prop_map(|[a, b, c]| Shape::Triangle(Triangle::flat(a, b, c))),
        2 => [vector(), vector(), vector()].prop_map(|[a, b, c]| {
            // A parallelogram.
            Shape::Polygon(Polygon::new(Box::leak(Box::new([a, b, c, a + c - b]))))
        }),
        1 => (vector(), vector(), 0.0f32..2.0, 0.0f32..2.0, any::<bool>()).prop_map(
            |(base, top, base_radius, top_radius, capped)| {
                Shape::Cone(Cone { base, base_radius, top, top_radius, capped })
            }
        ),
    ]
    .boxed()
}

fn material() -> BoxedStrategy<Material> {
    let shares = (0.0f32..1.0, 0.0f32..0.6, prop_oneof![Just(0.0f32), 0.1f32..0.4], 0.6f32..2.0);
    (shares, [0.0f32..1.0, 0.0f32..1.0, 0.0f32..1.0])
        .prop_map(|((specular, reflectance, transmittance, ior), [r, g, b])| Material {
            specular,
            shininess: 10.0,
            reflectance,
            transmittance,
            ior,
            ..Material::matte(LinearRgb::new(r, g, b))
        })
        .boxed()
}

fn light() -> BoxedStrategy<Light> {
    let color = LinearRgb::gray(0.7);
    prop_oneof![
        vector().prop_map(move |v| Light::Point { position: v * 3.0, color }),
        vector().prop_map(move |direction| Light::Directional { direction, color }),
    ]
    .boxed()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_scenes(
        eye in vector(),
        shapes in proptest::collection::vec((shape(), 0..4u16), 1..12),
        materials in proptest::collection::vec(material(), 4),
        lights in proptest::collection::vec(light(), 1..4),
    ) {
        let camera = Camera {
            eye: eye * 2.0 + Vec3::new(0.1, 0.2, 0.3),
            target: Vec3::ZERO,
            up: Vec3::new(0.1, 1.0, 0.05),
            vertical_fov: 1.0,
        };
        let background = LinearRgb::new(0.2, 0.4, 0.6);
        // What is refused is left out.
        let accepted = |scene: &Scene| {
            let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
            PreparedScene::<f32, _>::new(scene, &mut memory).is_ok()
        };
        let empty = Scene { camera, background, objects: &[], materials: &materials, lights: &[] };
        prop_assume!(accepted(&empty));
        let objects: Vec<_> = shapes
            .into_iter()
            .map(|(shape, material)| Object::new(shape, material))
            .filter(|object| accepted(&Scene { objects: &[*object], ..empty }))
            .collect();
        let lights: Vec<_> =
            lights.into_iter().filter(|light| accepted(&Scene { lights: &[*light], ..empty })).collect();
        let scene = Scene { objects: &objects, lights: &lights, ..empty };
        prop_assert_eq!(differences::<f32>(&scene, Settings::new(24, 18)), 0);
    }
}
