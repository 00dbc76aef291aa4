//! Tests of fixed point: agreement with `f64`, independence of the scene's units, absence of overflow, and
//! exact digests that boards must reproduce.

use std::mem::MaybeUninit;
use std::path::Path;

use bumpalo::Bump;
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use proptest::prelude::*;
use rayline::builtin::{self, CLASSIC, PRISM};
use rayline::math::Fixed;
use rayline::shape::{Blob, Cone, Ellipsoid, Metaballs, Plane, Polygon, Shape, Sphere};
use rayline::{
    Background, Camera, Checker, Digest, Falloff, Fault, Lamp, Light, LinearRgb, Material, Object, Part,
    PreparedScene, Real, Renderer, Sampling, Scene, SceneError, Settings, Texture, Transfer, Vec3,
};
use rayline_simulator::LoadedScene;
use rayline_tests::{Picture, backgrounds, core_picture, lights, numbers, optics, shapes, vectors};

/// The smallest allowed PSNR of pictures in fixed point, in decibels.
const BAR_DB: f64 = 40.0;

/// The peak signal-to-noise ratio in decibels: 10 log₁₀(255² / mean square error).
fn psnr(a: &Picture, b: &Picture) -> f64 {
    let squares =
        |a: &[u8; 3], b: &[u8; 3]| (0..3).map(|i| f64::from(a[i].abs_diff(b[i])).powi(2)).sum::<f64>();
    let sum: f64 = a.pixels.iter().zip(&b.pixels).map(|(a, b)| squares(a, b)).sum();
    10.0 * (255.0 * 255.0 * 3.0 * a.pixels.len() as f64 / sum).log10()
}

fn linear(bounces: u8) -> Settings {
    Settings { bounces, transfer: Transfer::Linear, ..Settings::new(320, 240) }
}

/// Asserts that the picture in fixed point agrees with that in `f64`. Both are written to files for
/// inspection.
#[track_caller]
fn assert_near_f64(name: &str, scene: &Scene<'_>, bounces: u8) {
    let exact = core_picture::<f64>(scene, linear(bounces));
    let fixed = core_picture::<Fixed>(scene, linear(bounces));
    for (kind, picture) in [("f64", &exact), ("fixed", &fixed)] {
        picture.write(&Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{kind}.png")));
    }
    let single = psnr(&exact, &core_picture::<f32>(scene, linear(bounces)));
    let fixed = psnr(&exact, &fixed);
    println!("{name:18} fixed {fixed:5.1} dB, f32 {single:5.1} dB");
    assert!(fixed >= BAR_DB, "{name} has {fixed:.1} dB");
}

#[test]
fn pictures_are_near_those_of_f64() {
    for scene in &builtin::ALL {
        assert_near_f64(scene.name, scene.scene, scene.bounces);
    }
}

#[test]
fn lamps_fade_from_any_distance() {
    let ball = [Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), 0)];
    let white = [Material::matte(LinearRgb::WHITE)];
    let camera = Camera {
        eye: Vec3::new(0.0, 1.5, 5.0),
        target: Vec3::ZERO,
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.8,
        lens: None,
    };
    for distance in [12.0, 17.0, 50.0, 1000.0, 1e5] {
        for falloff in [
            Falloff::inverse_square(distance / 2.0),
            Falloff { constant: 0.0, linear: 2.0 / distance, quadratic: 0.0 },
            Falloff { constant: 0.01, linear: 0.0, quadratic: 2.0 / (distance * distance) },
        ] {
            let position = Vec3::new(0.0, 0.8 * distance, 0.6 * distance);
            let lights = [Light::Lamp(Lamp { position, color: LinearRgb::WHITE, falloff, cone: None })];
            let background = Background::Solid(LinearRgb::BLACK);
            let scene = Scene {
                camera,
                background,
                objects: &ball,
                materials: &white,
                lights: &lights,
                motions: &[],
            };
            let settings = Settings { transfer: Transfer::Linear, ..Settings::new(64, 48) };
            let close =
                psnr(&core_picture::<f64>(&scene, settings), &core_picture::<Fixed>(&scene, settings));
            assert!(close > 55.0, "{close:.1} dB for {falloff:?} from {distance}");
        }
    }
}

/// When directions to lights were wrong in length by 2⁻¹⁷, this picture had 42 dB.
#[test]
fn tips_do_not_shade_themselves() {
    let arena = Bump::new();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/gallery/light-spot.ron");
    let LoadedScene { scene, .. } =
        LoadedScene::open(&file, &arena).unwrap_or_else(|error| panic!("{error}"));
    let close = psnr(&core_picture::<f64>(&scene, linear(6)), &core_picture::<Fixed>(&scene, linear(6)));
    assert!(close > 50.0, "{close:.1} dB");
}

#[test]
fn digests_are_golden() {
    // The pictures were inspected before these digests were stored. Boards must reproduce them.
    let mut actual = Vec::new();
    for scene in &builtin::ALL {
        let mut memory = vec![MaybeUninit::uninit(); scene.scene.bytes::<Fixed>()];
        let prepared = PreparedScene::<Fixed>::new(scene.scene, &mut memory).unwrap();
        let settings = Settings { bounces: scene.bounces, ..Settings::new(96, 72) };
        let renderer = Renderer::new(&prepared, settings).unwrap();
        let mut digest = Digest::new();
        let mut line = [Rgb888::BLACK; 96];
        for y in 0..72 {
            renderer.line(y, &mut line).unwrap();
            line.iter().for_each(|color| digest.update(&color.to_le_bytes()));
        }
        actual.push((scene.name, format!("{:#018x}", digest.value())));
    }
    assert_eq!(actual, GOLDEN.map(|(name, digest)| (name, digest.to_owned())));
}

const GOLDEN: [(&str, &str); 5] = [
    ("classic", "0xe9ef75b827c1420d"),
    ("whitted", "0x204188fc546c9413"),
    ("flake", "0xc7bf4d2168603055"),
    ("prism", "0x392fc82aaa429ac5"),
    ("table", "0x61432c16077f4056"),
];

#[test]
fn acceleration_changes_no_byte() {
    for scene in &builtin::ALL {
        let picture = |accelerated: bool| {
            let mut memory = vec![MaybeUninit::uninit(); scene.scene.bytes::<Fixed>()];
            let prepared = PreparedScene::<Fixed>::new(scene.scene, &mut memory).unwrap();
            let prepared = if accelerated { prepared } else { prepared.without_acceleration() };
            let renderer = Renderer::new(&prepared, linear(scene.bounces)).unwrap();
            let mut lines = vec![Rgb888::BLACK; 320 * 240];
            (0..).zip(lines.chunks_mut(320)).for_each(|(y, line)| renderer.line(y, line).unwrap());
            lines
        };
        let (fast, slow) = (picture(true), picture(false));
        let different = fast.iter().zip(&slow).filter(|(a, b)| a != b).count();
        assert_eq!(different, 0, "{}", scene.name);
    }
}

/// The parts of the classic scene, to be modified.
struct Parts {
    camera: Camera,
    objects: Vec<Object<Shape<'static>>>,
    materials: Vec<Material<'static>>,
    lights: Vec<Light>,
}

impl Parts {
    fn classic() -> Self {
        Self {
            camera: CLASSIC.camera,
            objects: CLASSIC.objects.to_vec(),
            materials: CLASSIC.materials.to_vec(),
            lights: CLASSIC.lights.to_vec(),
        }
    }

    /// The classic scene in other units.
    fn scaled(by: f32) -> Self {
        let mut parts = Self::classic();
        parts.camera.eye = parts.camera.eye * by;
        parts.camera.target = parts.camera.target * by;
        for object in &mut parts.objects {
            object.shape = match object.shape {
                Shape::Sphere(sphere) => Shape::Sphere(Sphere::new(sphere.center * by, sphere.radius * by)),
                Shape::Polygon(polygon) => {
                    let vertices: Vec<_> = polygon.vertices.iter().map(|vertex| *vertex * by).collect();
                    Shape::Polygon(Polygon::new(vertices.leak()))
                }
                other => other,
            };
        }
        for material in &mut parts.materials {
            if let Texture::Checker(Checker { cells_per_unit, .. }) = &mut material.color {
                *cells_per_unit = *cells_per_unit * (1.0 / by);
            }
        }
        for light in &mut parts.lights {
            if let Light::Point { position, .. } = light {
                *position = *position * by;
            }
        }
        parts
    }

    fn scene(&self) -> Scene<'_> {
        Scene {
            camera: self.camera,
            background: CLASSIC.background,
            objects: &self.objects,
            materials: &self.materials,
            lights: &self.lights,
            motions: &[],
        }
    }
}

#[test]
fn units_do_not_matter() {
    let picture = |scene: &Scene<'_>| core_picture::<Fixed>(scene, linear(3));
    let original = picture(&CLASSIC);
    for power_of_two in [8192.0, 1.0 / 8192.0] {
        assert_eq!(original, picture(&Parts::scaled(power_of_two).scene()), "scaled by {power_of_two}");
    }
    for other in [1e4, 1e-4, 3.0] {
        let near = psnr(&original, &picture(&Parts::scaled(other).scene()));
        println!("scaled by {other}: {near:.1} dB");
        assert!(near >= BAR_DB, "scaled by {other} is another picture: {near:.1} dB");
    }
}

#[test]
fn the_scale_is_that_of_the_extent() {
    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<Fixed>()];
    let prepared = PreparedScene::<Fixed>::new(&CLASSIC, &mut memory).unwrap();
    // The spheres extend to 22 units from the origin, and the floor to 30.
    assert_eq!(prepared.scale(), 1.0 / 64.0);
    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()];
    assert_eq!(PreparedScene::<f32>::new(&CLASSIC, &mut memory).unwrap().scale(), 1.0);
}

#[test]
fn lights_may_be_very_far_away() {
    let mut parts = Parts::classic();
    for light in &mut parts.lights {
        if let Light::Point { position, .. } = light {
            *position = *position * 1e4;
        }
    }
    assert_near_f64("far-lights", &parts.scene(), 3);
}

#[test]
fn floors_may_be_very_large() {
    let mut parts = Parts::classic();
    let vertices: &[Vec3] = &[
        Vec3::new(-9e3, -4.0, 9e3),
        Vec3::new(9e3, -4.0, 9e3),
        Vec3::new(9e3, -4.0, -9e3),
        Vec3::new(-9e3, -4.0, -9e3),
    ];
    parts.objects[4].shape = Shape::Polygon(Polygon::new(vertices.to_vec().leak()));
    parts.materials[4].color = LinearRgb::gray(0.4).into();
    assert_near_f64("large-floor", &parts.scene(), 3);
}

#[test]
fn small_objects_in_large_scenes_are_visible() {
    // The documentation of `Fixed` states these figures.
    for (ratio, bar) in [(32.0, 44.0), (256.0, 36.0), (1024.0, 30.0)] {
        for (name, extent) in [("whitted", 3.1), ("flake", 1.0), ("table", 3.4)] {
            let scene = builtin::ALL.iter().find(|scene| scene.name == name).unwrap();
            // A ball behind the camera makes the scene larger.
            let Camera { eye, target, .. } = scene.scene.camera;
            let behind = (eye - target) * (0.9 / (eye - target).magnitude());
            let (center, radius) = (behind * (ratio * extent), 0.1 * ratio * extent);
            let mut objects = scene.scene.objects.to_vec();
            objects.push(Object::new(Shape::Sphere(Sphere::new(center, radius)), 0));
            let scene = Scene { objects: &objects, ..*scene.scene };
            let settings = Settings { bounces: 5, transfer: Transfer::Linear, ..Settings::new(160, 120) };
            let close =
                psnr(&core_picture::<f64>(&scene, settings), &core_picture::<Fixed>(&scene, settings));
            println!("{name:18} in {ratio} times as much {close:5.1} dB");
            assert!(close >= bar, "{name} has {close:.1} dB in a scene {ratio} times as large");
        }
    }
}

#[test]
fn the_camera_may_be_far_away() {
    let mut parts = Parts::classic();
    // A hundred times as far away, with a correspondingly small field of view.
    parts.camera = Camera {
        eye: Vec3::new(0.0, 0.0, 1984.0),
        target: Vec3::new(0.0, 0.0, -16.0),
        vertical_fov: 0.0092,
        ..parts.camera
    };
    assert_near_f64("telescope", &parts.scene(), 3);
}

/// A scene with a red floor in front of a black background, and other objects.
fn above<'a>(
    camera: Camera,
    objects: &'a [Object<Shape<'static>>],
    materials: &'a [Material<'static>; 3],
) -> Scene<'a> {
    Scene {
        camera,
        background: Background::Solid(LinearRgb::BLACK),
        objects,
        materials,
        lights: &[],
        motions: &[],
    }
}

const FLOOR_AND_OTHERS: [Material; 3] = [
    Material { ambient: 1.0, ..Material::matte(LinearRgb::new(1.0, 0.0, 0.0)) },
    Material { ambient: 1.0, ..Material::matte(LinearRgb::new(0.0, 0.0, 1.0)) },
    Material { reflectance: 1.0, diffuse: 0.0, ..Material::matte(LinearRgb::BLACK) },
];

/// The number of pixels that show the floor in one picture and not in the other, although they are not at the
/// edge of the floor.
fn lost_pixels(scene: &Scene<'_>) -> usize {
    let settings = Settings { transfer: Transfer::Linear, ..Settings::new(160, 120) };
    let (double, fixed) = (core_picture::<f64>(scene, settings), core_picture::<Fixed>(scene, settings));
    let is_floor = |picture: &Picture, x: usize, y: usize| picture.pixels[y * 160 + x][0] > 127;
    let mut lost = 0;
    for (x, y) in (0..120).flat_map(|y| (0..160).map(move |x| (x, y))) {
        let here = is_floor(&double, x, y);
        let mut around = (y.max(1) - 1..(y + 2).min(120))
            .flat_map(|y| (x.max(1) - 1..(x + 2).min(160)).map(move |x| (x, y)));
        let is_edge = around.any(|(x, y)| is_floor(&double, x, y) != here);
        lost += usize::from(is_floor(&fixed, x, y) != here && !is_edge);
    }
    lost
}

#[test]
fn planes_are_seen_to_the_horizon() {
    let floor = |up: Vec3, below: f32| Object::new(Shape::Plane(Plane::new(up * -below, up)), 0);
    let ball = |center: Vec3, radius: f32, material| {
        Object::new(Shape::Sphere(Sphere::new(center, radius)), material)
    };
    let (y, z) = (Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0));
    let slanted = Vec3::new(0.6, 0.64, -0.48);
    let ahead =
        Camera { eye: Vec3::ZERO, target: Vec3::new(0.0, -0.15, -1.0), up: y, vertical_fov: 0.8, lens: None };
    let mut floors = 0;
    let mut check = |name: &str, camera: Camera, objects: &[Object<Shape<'static>>]| {
        let lost = lost_pixels(&above(camera, objects, &FLOOR_AND_OTHERS));
        assert_eq!(lost, 0, "{name}: pixels of floor or background");
        floors += 1;
    };
    for below in [0.01, 1.0, 7.0, 300.0, 900.0] {
        check("the eye at the origin", ahead, &[floor(y, below)]);
        check("beside a wall", Camera { up: slanted, ..ahead }, &[floor(slanted, below)]);
        check("under a ceiling", Camera { target: Vec3::new(0.0, 0.1, -1.0), ..ahead }, &[floor(-y, below)]);
        let away = Vec3::new(3.0, 4.0, 1000.0) * below;
        let camera = Camera { eye: away, target: away + Vec3::new(-0.3, -0.15, -1.0) * below, ..ahead };
        check("the eye far away along the plane", camera, &[floor(y, below)]);
        let [blue, mirror] = [(-1.0, 1), (1.0, 2)]
            .map(|(x, material)| ball(Vec3::new(x, 0.3, -3.0) * (below / 8.0), below / 9.0, material));
        check("below balls", ahead, &[floor(y, below), blue, mirror]);
        check(
            "on end",
            Camera { target: Vec3::new(-1.0, 0.3, 0.2), up: z, ..ahead },
            &[floor(z, below), blue],
        );
    }
    for size in [1.0, 0.1, 0.01] {
        let [blue, mirror] =
            [(-1.0, 1), (1.0, 2)].map(|(x, material)| ball(Vec3::new(x, 0.3, -3.0) * size, size, material));
        check("far below small balls", ahead, &[floor(y, 40.0), blue, mirror]);
    }
    assert_eq!(floors, 33);
}

#[test]
fn a_moved_eye_sees_planes_to_the_horizon_or_is_refused() {
    let floor = [Object::new(Shape::Plane(Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0))), 0)];
    let at = |x, y, z| Camera {
        eye: Vec3::new(x, y, z),
        target: Vec3::new(x - 0.4, y - 0.2, z - 1.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.8,
        lens: None,
    };
    // The floor's scene must fit in 1/4, so the scale is 1/32.
    let scene = above(at(0.0, 2.0, 8.0), &floor, &FLOOR_AND_OTHERS);
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<Fixed>()];
    let mut prepared = PreparedScene::<Fixed>::new(&scene, &mut memory).unwrap();
    assert_eq!(prepared.scale(), 1.0 / 32.0);
    let refused = Err(SceneError { part: Part::Camera, fault: Fault::BeyondReach });
    for (camera, answer) in [
        (at(0.0, 2.0, 8.0), Ok(())),
        (at(0.0, 8.0, -2.0), Ok(())),
        (at(200.0, 16.0, -250.0), Ok(())),
        (at(200.0, -16.0, 250.0), Ok(())),
        (at(0.0, 16.1, 0.0), refused),
        (at(0.0, -16.1, 0.0), refused),
        (at(0.0, 2.0, 257.0), refused),
    ] {
        assert_eq!(prepared.set_camera(&camera), answer, "{:?}", camera.eye);
    }
    // The eye that the scene was prepared with is accepted, and so are others as near to the origin.
    for distance in [Some(0.0), Some(1.0), Some(3.1), Some(9.9), Some(1000.0), None] {
        let up = Vec3::new(0.36, -0.48, 0.8);
        let plane = distance.map(|distance| Object::new(Shape::Plane(Plane::new(up * -distance, up)), 0));
        let plane = plane.as_slice();
        for place in [up, Vec3::new(5.77, -5.77, 5.77), Vec3::new(0.0, 0.0, -10.0)] {
            let eye = place * (10.0 / place.length());
            let camera = Camera { eye, ..at(0.0, 0.0, 0.0) };
            let scene = above(camera, plane, &FLOOR_AND_OTHERS);
            let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<Fixed>()];
            let mut prepared = PreparedScene::<Fixed>::new(&scene, &mut memory).unwrap();
            for eye in [eye, -eye, up * 9.999, up * -9.999, Vec3::new(9.999, 0.0, 0.0)] {
                assert_eq!(prepared.set_camera(&Camera { eye, ..camera }), Ok(()), "{eye:?}, {distance:?}");
            }
        }
    }
}

fn refused(parts: &Parts) -> SceneError {
    let mut memory = vec![MaybeUninit::uninit(); parts.scene().bytes::<Fixed>()];
    PreparedScene::<Fixed>::new(&parts.scene(), &mut memory).map(|_| ()).expect_err("refused")
}

#[test]
fn parts_out_of_range_are_refused_with_a_remedy() {
    let error = |part, fault: Fault| {
        assert!(fault.to_string().contains(';'), "no remedy: {fault}");
        SceneError { part, fault }
    };
    let mut parts = Parts::classic();
    parts.objects[2].shape = Shape::Sphere(Sphere::new(Vec3::ZERO, 1e-5));
    assert_eq!(refused(&parts), error(Part::Object(2), Fault::TooSmall));
    let mut parts = Parts::classic();
    parts.materials[1].ior = 8.0;
    assert_eq!(refused(&parts), error(Part::Material(1), Fault::OutOfRange));
    parts.materials[1].ior = 0.1;
    assert_eq!(refused(&parts), error(Part::Material(1), Fault::OutOfRange));
    let mut parts = Parts::classic();
    parts.lights[0] = Light::Point { position: Vec3::ZERO, color: LinearRgb::gray(60.0) };
    assert_eq!(refused(&parts), error(Part::Light(0), Fault::OutOfRange));
    let mut parts = Parts::classic();
    parts.objects[0].shape = Shape::Cone(Cone {
        base: Vec3::ZERO,
        base_radius: 1.0,
        top: Vec3::new(0.0, 0.1, 0.0),
        top_radius: 0.0,
        capped: true,
    });
    assert_eq!(refused(&parts), error(Part::Object(0), Fault::OutOfRange));

    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<Fixed>()];
    let mut prepared = PreparedScene::<Fixed>::new(&CLASSIC, &mut memory).unwrap();
    let away = |z| Camera { eye: Vec3::new(0.0, 0.0, z), ..CLASSIC.camera };
    assert_eq!(prepared.set_camera(&away(500.0)), Ok(()));
    assert_eq!(prepared.set_camera(&away(600.0)), Err(error(Part::Camera, Fault::BeyondReach)));
}

/// The fault for which a scene of one shape and one light is refused, if it is.
fn refusal(shape: Shape<'static>, material: Material<'static>, light: f32) -> Option<Fault> {
    let (objects, materials) = ([Object::new(shape, 0)], [material]);
    let lights = [Light::Directional { direction: Vec3::new(0.0, -1.0, 0.0), color: LinearRgb::gray(light) }];
    let scene = Scene { objects: &objects, materials: &materials, lights: &lights, ..CLASSIC };
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<Fixed>()];
    PreparedScene::<Fixed>::new(&scene, &mut memory).err().map(|error| error.fault)
}

#[test]
fn the_documented_limits_of_fixed_hold() {
    let white = Material::matte(LinearRgb::WHITE);
    let ball = |radius| Shape::Sphere(Sphere::new(Vec3::ZERO, radius));
    assert_eq!(refusal(ball(1.0), white, 59.0), None);
    assert_eq!(refusal(ball(1.0), white, 59.1), Some(Fault::OutOfRange));
    for (ior, answer) in
        [(0.14, None), (7.6, None), (0.13, Some(Fault::OutOfRange)), (7.7, Some(Fault::OutOfRange))]
    {
        assert_eq!(refusal(ball(1.0), Material { ior, ..white }, 1.0), answer, "{ior}");
    }
    let top = Vec3::new(0.0, 1.0, 0.0);
    let cone =
        |base_radius| Shape::Cone(Cone { base: Vec3::ZERO, base_radius, top, top_radius: 1.0, capped: true });
    assert_eq!(refusal(cone(8.6), white, 1.0), None);
    assert_eq!(refusal(cone(8.7), white, 1.0), Some(Fault::OutOfRange));
    let long = |times| Shape::Ellipsoid(Ellipsoid::new(Vec3::ZERO, Vec3::new(1.0, times, 1.0)));
    assert_eq!(refusal(long(58.9), white, 1.0), None);
    assert_eq!(refusal(long(59.1), white, 1.0), Some(Fault::OutOfRange));
    let blobs = |strength: f32| {
        let blob = |x, strength| Blob { strength, ..Blob::new(Vec3::new(x, 0.0, 0.0), 1.0) };
        Shape::Metaballs(Metaballs::new(vec![blob(0.0, strength), blob(0.5, -1.0)].leak()))
    };
    assert_eq!(refusal(blobs(58.0), white, 1.0), None);
    assert_eq!(refusal(blobs(58.1), white, 1.0), Some(Fault::OutOfRange));

    // The smallest radii for extents just above a power of two, which is the worst case of scaling to 1/2 or
    // 1/4.
    let up = Vec3::new(0.0, 1.0, 0.0);
    let camera = Camera { eye: Vec3::ZERO, ..CLASSIC.camera };
    let far = |x: f32| Object::new(Shape::Sphere(Sphere::new(Vec3::new(x - 0.01, 0.0, 0.0), 0.01)), 0);
    let floor = |below: f32| Object::new(Shape::Plane(Plane::new(up * -below, up)), 0);
    let mesh = |x: f32| {
        let corners = [Vec3::ZERO, up, Vec3::new(x, 0.0, 0.0)];
        Object::new(Shape::Polygon(Polygon::new(corners.to_vec().leak())), 0)
    };
    let extent = 1.001;
    for (others, share) in [
        (vec![far(extent)], 65_536.0),
        (vec![mesh(16.016)], 65_536.0),
        (vec![floor(extent)], 32_768.0),
        (vec![far(extent), floor(0.2)], 32_768.0),
        (vec![mesh(32.032), floor(0.2)], 32_768.0),
    ] {
        for (factor, answer) in [(1.01, true), (0.99, false)] {
            let mut objects = others.clone();
            objects.push(Object::new(ball(factor * extent / share), 0));
            let materials = [white];
            let scene = Scene { camera, objects: &objects, materials: &materials, ..CLASSIC };
            let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<Fixed>()];
            let prepared = PreparedScene::<Fixed>::new(&scene, &mut memory).map(|_| ());
            assert_eq!(prepared.is_ok(), answer, "{factor} of a {share}th beside {others:?}");
        }
    }
}

#[test]
fn many_samples_keep_their_mean() {
    let white = Scene { background: Background::gray(0.75), objects: &[], ..CLASSIC };
    let mut memory = vec![MaybeUninit::uninit(); white.bytes::<Fixed>()];
    let prepared = PreparedScene::<Fixed>::new(&white, &mut memory).unwrap();
    let settings = Settings { sampling: Sampling::new(1000), rays_per_pixel: 1000, ..Settings::new(4, 4) };
    let (light, _) = Renderer::new(&prepared, settings).unwrap().pixel(1, 1, &mut ());
    assert!((light.g.to_f32() - 0.75).abs() < 1e-3, "{light:?}");
}

fn color() -> BoxedStrategy<LinearRgb> {
    [0.0f32..1.0, 0.0f32..1.0, 0.0f32..1.0].prop_map(|[r, g, b]| LinearRgb::new(r, g, b)).boxed()
}

fn material() -> BoxedStrategy<Material<'static>> {
    let shares = (0.0f32..1.0, 0.0f32..1.0, 0.0f32..1.0, 0.0f32..0.6, 0.0f32..0.6);
    let ior = prop_oneof![4 => 0.14f32..7.6, 1 => Just(1.0f32)];
    let shininess = prop_oneof![4 => 0.0f32..300.0, 1 => 0.0f32..1e6];
    (
        color(),
        shares,
        shininess,
        ior,
        proptest::option::of((color(), vectors(&numbers()))),
        optics(&(0.0f32..1.0).boxed()),
    )
        .prop_map(
            |(
                even,
                (ambient, diffuse, specular, reflectance, transmittance),
                shininess,
                ior,
                odd,
                optics,
            )| {
                Material {
                    color: match odd {
                        None => even.into(),
                        Some((odd, cells_per_unit)) => {
                            Texture::Checker(Checker { even, odd, cells_per_unit })
                        }
                    },
                    ambient,
                    diffuse,
                    specular,
                    shininess,
                    reflectance,
                    transmittance,
                    ior,
                    optics,
                    maps: &[],
                }
            },
        )
        .boxed()
}

fn light() -> BoxedStrategy<Light> {
    let color = (color(), 0.0f32..59.0).prop_map(|(color, strength)| color * strength).boxed();
    lights(&numbers(), &color)
}

/// The light of some pixels of a scene, or the error.
fn pixels(scene: &Scene<'_>) -> Result<Vec<LinearRgb<Fixed>>, SceneError> {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<Fixed>()];
    let prepared = PreparedScene::<Fixed>::new(scene, &mut memory)?;
    let settings = Settings { bounces: 8, rays_per_pixel: 300, ..Settings::new(5, 5) };
    let renderer = Renderer::new(&prepared, settings).expect("legal settings");
    // Draw lines as well, because they use the candidates.
    let mut line = [Rgb888::BLACK; 5];
    (0..5).for_each(|y| renderer.line(y, &mut line).expect("a line"));
    Ok((0..25).map(|i| renderer.pixel(i % 5, i / 5, &mut ()).0).collect())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 10_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// Overflow checks are on in the profile of tests.
    #[test]
    fn any_scene_is_refused_or_renders_light(
        eye_and_target in (vectors(&numbers()), vectors(&numbers())),
        fov in 0.001f32..3.1,
        background in backgrounds(&numbers(), &color()),
        shapes in proptest::collection::vec((shapes(&numbers()), 0..2u16), 0..5),
        materials in proptest::collection::vec(material(), 2),
        lights in proptest::collection::vec(light(), 0..3),
    ) {
        let (eye, target) = eye_and_target;
        let mut camera = Camera { eye, target, up: Vec3::new(0.1, 1.0, 0.3), vertical_fov: fov, lens: None };
        let mut objects: Vec<_> =
            shapes.into_iter().map(|(shape, material)| Object::new(shape, material)).collect();
        let (mut materials, mut background) = (materials, background);
        // Leave out the refused parts, so that most cases render a picture.
        loop {
            let scene = Scene {
                camera,
                background,
                objects: &objects,
                materials: &materials,
                lights: &lights,
motions: &[],
            };
            match pixels(&scene) {
                Ok(pixels) => {
                    for light in pixels {
                        for value in [light.r, light.g, light.b] {
                            prop_assert!(value >= Fixed::ZERO, "{light:?}");
                        }
                    }
                    break;
                }
                Err(SceneError {
                    part: Part::Object(index) | Part::Solid { object: index, .. } | Part::Model(index),
                    ..
                }) => {
                    objects.remove(index);
                }
                Err(SceneError { part: Part::Material(index), .. }) => materials[index] = PRISM.materials[0],
                Err(SceneError { part: Part::Camera, .. }) => camera = CLASSIC.camera,
                Err(SceneError { part: Part::Background, .. }) => background = Background::gray(0.5),
                Err(error) => {
                    let zero_length = error.fault == Fault::ZeroLength;
                    prop_assert!(zero_length, "{error}");
                    break;
                }
            }
        }
    }
}
