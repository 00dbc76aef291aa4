//! Tests of path tracing: by closed forms, and against itself without shadow rays.

use rayline::math::Fixed;
use rayline::shape::{Disc, Plane, Rectangle, Shape, Sphere};
use rayline::{
    Background, Camera, Fresnel, Integrator, Light, LinearRgb, Material, Object, ObjectId, Optics, RayCounts,
    Real, Sampling, Scene, Settings, Sides, Vec3,
};

use super::distributed::{lights, samples};

const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);
const DOWN: Vec3 = Vec3::new(0.0, -1.0, 0.0);

/// The settings of a path-traced picture with so many samples.
fn paths(width: u32, height: u32, count: u16) -> Settings {
    Settings { integrator: Integrator::PathTracing, ..samples(width, height, count) }
}

/// A camera at `eye` that looks at a point.
fn camera(eye: Vec3, target: Vec3) -> Camera {
    let along = target - eye;
    let up = if along.x == 0.0 && along.z == 0.0 { Vec3::new(0.0, 0.0, 1.0) } else { UP };
    Camera { eye, target, up, vertical_fov: 0.2, lens: None }
}

/// The mean green light of a picture.
fn mean<R: Real>(scene: &Scene<'_>, settings: Settings) -> f64 {
    let picture = lights::<R>(scene, settings, true);
    picture.iter().map(|light| f64::from(light.g)).sum::<f64>() / picture.len() as f64
}

/// The means of the three number systems.
fn means(scene: &Scene<'_>, settings: Settings) -> [(&'static str, f64); 3] {
    [
        ("f32", mean::<f32>(scene, settings)),
        ("f64", mean::<f64>(scene, settings)),
        ("fixed", mean::<Fixed>(scene, settings)),
    ]
}

/// In a closed room whose walls emit e and send on the share ρ, light has been sent on 0, 1, … n times:
/// e · (1 + ρ + … + ρⁿ). Up to three bounces, no path ends by chance, and all paths find the same.
#[test]
fn a_closed_room_adds_up_its_light() {
    let emission = 0.2;
    let plain = Material { ambient: 0.0, diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) };
    for (name, material, optics) in [
        ("matte", Material { diffuse: 0.7, ..plain }, Optics::PLAIN),
        ("mirror", Material { reflectance: 0.7, ..plain }, Optics::PLAIN),
        ("gloss", Material { reflectance: 0.7, ..plain }, Optics { gloss: Some(20.0), ..Optics::PLAIN }),
        ("both", Material { diffuse: 0.3, reflectance: 0.4, ..plain }, Optics::PLAIN),
    ] {
        let optics = Optics { emission: LinearRgb::gray(emission), ..optics };
        let room = Sphere::new(Vec3::ZERO, 3.0);
        let scene = Scene {
            camera: camera(Vec3::new(0.5, 0.4, 1.0), Vec3::new(0.0, 0.0, -1.0)),
            background: Background::BLACK,
            objects: &[Object::new(Shape::Sphere(room), 0)],
            materials: &[Material { optics: Some(&optics), ..material }],
            lights: &[Light::Ambient { color: LinearRgb::WHITE }],
            motions: &[],
        };
        for bounces in 0..=3u8 {
            let expected: f64 = (0..=i32::from(bounces)).map(|n| f64::from(emission) * 0.7f64.powi(n)).sum();
            for (number, found) in means(&scene, Settings { bounces, ..paths(8, 8, 4) }) {
                assert!(
                    (found / expected - 1.0).abs() < 2e-3,
                    "{name}, {bounces}, {number}: {found}, {expected}"
                );
            }
        }
        // Paths that end by chance bring the same mean.
        let expected: f64 = (0..=16).map(|n| f64::from(emission) * 0.7f64.powi(n)).sum();
        for (number, found) in means(&scene, Settings { bounces: 16, ..paths(16, 16, 256) }) {
            assert!(
                (found / expected - 1.0).abs() < 6e-3,
                "{name}, by chance, {number}: {found}, {expected}"
            );
        }
    }
}

/// A furnace: where all is of light 1, so is everything that neither adds nor takes light.
#[test]
fn a_furnace_stays_even() {
    let plain = Material { ambient: 0.0, diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) };
    let glass = Material { transmittance: 1.0, ior: 1.5, ..plain };
    let exact = Optics { fresnel: Fresnel::Exact, ..Optics::PLAIN };
    for (name, material, optics) in [
        ("white", Material { diffuse: 1.0, ..plain }, Optics::PLAIN),
        ("glass", glass, exact),
        ("mirror", Material { reflectance: 1.0, ..plain }, Optics::PLAIN),
        ("gloss", Material { reflectance: 1.0, ..plain }, Optics { gloss: Some(5.0), ..Optics::PLAIN }),
        ("white under half a mirror", Material { diffuse: 0.5, reflectance: 0.5, ..plain }, Optics::PLAIN),
    ] {
        let scene = Scene {
            camera: camera(Vec3::new(0.0, 0.0, 8.0), Vec3::ZERO),
            background: Background::gray(1.0),
            objects: &[
                Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 0.7)), 0),
                Object::new(Shape::Sphere(Sphere::new(Vec3::new(1.2, 0.0, 0.0), 0.5)), 0),
            ],
            materials: &[Material { optics: Some(&optics), ..material }],
            lights: &[Light::Sky],
            motions: &[],
        };
        for (number, found) in means(&scene, Settings { bounces: 16, ..paths(16, 12, 16) }) {
            assert!((found - 1.0).abs() < 2e-3, "{name}, {number}: {found}");
        }
    }
}

/// A disc lamp of radius r at a height h above a white floor brings r² / (r² + h²) of its light, from far to
/// so close that scattered rays find it more often than shadow rays do; and a ball lamp (r / h)².
#[test]
fn lamps_far_and_close_are_as_bright_as_closed_forms_say() {
    let optics = Optics { emission: LinearRgb::gray(2.0), emission_sides: Sides::Front, ..Optics::PLAIN };
    let lamp = Material { diffuse: 0.0, optics: Some(&optics), ..Material::matte(LinearRgb::WHITE) };
    let floor = Material { ambient: 0.0, diffuse: 1.0, ..Material::matte(LinearRgb::WHITE) };
    let plane = Plane { point: Vec3::ZERO, normal: UP };
    let disc = |height: f32, radius| Shape::Disc(Disc::new(UP * height, DOWN, radius));
    let ball = |height: f32, radius| Shape::Sphere(Sphere::new(UP * height, radius));
    for (shape, share) in [
        (disc(8.0, 1.0), 1.0 / 65.0),
        (disc(2.0, 1.0), 0.2),
        (disc(0.5, 2.0), 4.0 / 4.25),
        (disc(0.25, 2.0), 4.0 / 4.0625),
        (ball(4.0, 1.0), 1.0 / 16.0),
        (ball(1.25, 1.0), 0.64),
    ] {
        let scene = Scene {
            // The spot below the lamp, seen from the side.
            camera: Camera { vertical_fov: 0.002, ..camera(Vec3::new(1.0, 0.2, 0.0), Vec3::ZERO) },
            background: Background::BLACK,
            objects: &[Object::new(Shape::Plane(plane), 0), Object::new(shape, 1)],
            materials: &[floor, lamp],
            lights: &[Light::Object(ObjectId(1))],
            motions: &[],
        };
        for bounces in [0, 1] {
            for (number, found) in means(&scene, Settings { bounces, ..paths(4, 4, 1024) }) {
                // In fixed point, lamps closer than an eighth of their radius are too dark for shadow rays.
                let allowed = if share > 0.97 { 0.02 } else { 0.01 };
                let found = found / 2.0;
                assert!(
                    (found / share - 1.0).abs() < allowed,
                    "{shape:?}, {bounces}, {number}: {found}, {share}"
                );
            }
        }
    }
}

/// A box with a lamp, matte, glossy and mirroring surfaces.
fn room<'a>(
    materials: &'a [Material<'a>],
    objects: &'a [Object<Shape<'a>>],
    lights: &'a [Light],
) -> Scene<'a> {
    Scene {
        camera: Camera { vertical_fov: 0.8, ..camera(Vec3::new(0.0, 1.0, 3.5), Vec3::new(0.0, 0.9, 0.0)) },
        background: Background::gray(0.05),
        objects,
        materials,
        lights,
        motions: &[],
    }
}

/// Shadow rays to a lamp change the noise, but not the mean: with the lamp as a light of the scene, and as a
/// surface that only scattered and glossy rays find.
#[test]
fn shadow_rays_change_no_mean() {
    let rectangle = |corner, right, up| Shape::Rectangle(Rectangle { corner, right, up });
    let at = Vec3::new;
    let objects = [
        Object::new(rectangle(at(-1.0, 0.0, 1.0), at(2.0, 0.0, 0.0), at(0.0, 0.0, -2.0)), 0),
        Object::new(rectangle(at(-1.0, 0.0, -1.0), at(2.0, 0.0, 0.0), at(0.0, 2.0, 0.0)), 1),
        Object::new(Shape::Sphere(Sphere::new(at(-0.4, 0.4, 0.1), 0.4)), 2),
        Object::new(Shape::Sphere(Sphere::new(at(0.5, 0.3, 0.3), 0.3)), 3),
        Object::new(Shape::Sphere(Sphere::new(at(0.3, 1.4, 0.0), 0.35)), 4),
        Object::new(rectangle(at(-0.9, 1.8, 0.3), at(0.8, 0.0, 0.0), at(0.0, 0.0, 0.8)), 5),
    ];
    let plain = Material { ambient: 0.0, diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) };
    let gloss = |exponent| Optics { gloss: Some(exponent), ..Optics::PLAIN };
    let (wide, narrow) = (gloss(8.0), gloss(120.0));
    let exact = Optics { fresnel: Fresnel::Exact, ..Optics::PLAIN };
    let glow = |light| Optics { emission: LinearRgb::gray(light), ..Optics::PLAIN };
    let (ball, tube) = (glow(3.0), Optics { emission_sides: Sides::Front, ..glow(5.0) });
    let materials = [
        Material { diffuse: 0.4, reflectance: 0.5, optics: Some(&wide), ..plain },
        Material { diffuse: 0.8, ..plain },
        Material { diffuse: 0.1, reflectance: 0.8, optics: Some(&narrow), ..plain },
        Material { transmittance: 1.0, ior: 1.5, optics: Some(&exact), ..plain },
        Material { optics: Some(&ball), ..plain },
        Material { optics: Some(&tube), ..plain },
    ];
    let lamps = [Light::Object(ObjectId(4)), Light::Object(ObjectId(5))];
    let settings = Settings { bounces: 4, ..paths(16, 12, 1024) };
    let (with, without) = (room(&materials, &objects, &lamps), room(&materials, &objects, &[]));
    let all_rays = mean::<f64>(
        &without,
        Settings { sampling: Sampling { samples: 8192, ..settings.sampling }, ..settings },
    );
    for (number, found) in means(&with, settings) {
        println!("{number}: {found:.5}, by scattered rays alone {all_rays:.5}");
        assert!((found / all_rays - 1.0).abs() < 4e-3, "{number}: {found}, {all_rays}");
    }
}

/// Acceleration changes no byte, and neither does a bound on rays that is not reached. A bound that is
/// reached holds.
#[test]
fn paths_are_exact_and_bounded() {
    let at = Vec3::new;
    let objects = [
        Object::new(Shape::Plane(Plane { point: Vec3::ZERO, normal: UP }), 0),
        Object::new(Shape::Sphere(Sphere::new(at(-0.5, 0.5, 0.0), 0.5)), 1),
        Object::new(Shape::Sphere(Sphere::new(at(0.6, 0.4, 0.4), 0.4)), 0),
        Object::new(Shape::Sphere(Sphere::new(at(0.3, 1.8, 0.0), 0.3)), 2),
    ];
    let exact = Optics { fresnel: Fresnel::Exact, ..Optics::PLAIN };
    let glow = Optics { emission: LinearRgb::gray(6.0), ..Optics::PLAIN };
    let plain = Material::matte(LinearRgb::new(0.8, 0.6, 0.4));
    let materials = [
        Material { ambient: 0.0, diffuse: 0.9, ..plain },
        Material { diffuse: 0.0, transmittance: 1.0, ior: 1.5, optics: Some(&exact), ..plain },
        Material { diffuse: 0.0, optics: Some(&glow), ..plain },
    ];
    let lights_of_scene = [
        Light::Object(ObjectId(3)),
        Light::Point { position: at(2.0, 3.0, 2.0), color: LinearRgb::gray(0.3) },
    ];
    let scene = room(&materials, &objects, &lights_of_scene);
    fn assert_alike<R: Real>(scene: &Scene<'_>) {
        let settings = Settings { bounces: 6, ..paths(24, 16, 8) };
        let picture = lights::<R>(scene, settings, true);
        assert_eq!(picture, lights::<R>(scene, settings, false));
        assert_eq!(picture, lights::<R>(scene, Settings { rays_per_pixel: 8 * 7 * 3, ..settings }, true));
    }
    assert_alike::<f32>(&scene);
    assert_alike::<f64>(&scene);
    assert_alike::<Fixed>(&scene);
    let count = |rays_per_pixel| -> RayCounts {
        rayline_tests::ray_counts(&scene, Settings { bounces: 6, rays_per_pixel, ..paths(24, 16, 8) })
    };
    let (all, few) = (count(8 * 7 * 3), count(20));
    assert!(all.scattered > all.camera_hits && all.cut_rays == 0, "{all:?}");
    assert!(few.total() <= 24 * 16 * 20 && few.cut_rays > 0, "{few:?}");
}
