//! Tests of distributed ray tracing: lenses, motion, gloss and translucency, by closed forms, by `f64` with
//! many samples, and by POV-Ray.

use std::mem::MaybeUninit;
use std::path::Path;

use bumpalo::Bump;
use rayline::math::Fixed;
use rayline::shape::{Disc, Plane, Rectangle, Shape, Sphere};
use rayline::{
    AreaLights, Background, Camera, Fault, Fresnel, Lens, Light, LinearRgb, Material, Motion, Object,
    ObjectId, Optics, Part, PreparedScene, RayCounts, Real, Renderer, Sampler, Sampling, Scene, Settings,
    Sides, Transfer, Vec3,
};
use rayline_simulator::{LoadedScene, Number, RenderOptions, render};
use rayline_tests::{PovrayPicture, Watch, core_picture};

use super::realtime::with_renderer;

/// The scenes of the gallery that draw numbers.
const SCENES: [&str; 7] = [
    "camera-lens",
    "camera-motion",
    "light-area",
    "light-closed-form",
    "light-sky",
    "material-gloss",
    "material-translucent",
];

const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);
const GLOWING: Material = Material {
    diffuse: 0.0,
    optics: Some(&Optics { emission: LinearRgb::WHITE, ..Optics::PLAIN }),
    ..Material::matte(LinearRgb::WHITE)
};

fn gallery<'a>(name: &str, arena: &'a Bump) -> LoadedScene<'a> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../docs/gallery/{name}.ron"));
    LoadedScene::open(&file, arena).unwrap_or_else(|error| panic!("{error}"))
}

/// The settings of a picture with so many samples, all of which are traced.
pub(super) fn samples(width: u32, height: u32, samples: u16) -> Settings {
    let sampling = Sampling { sampler: Sampler::Sobol, ..Sampling::new(samples) };
    Settings { sampling, rays_per_pixel: 1 << 20, ..Settings::new(width, height) }
}

/// The light of each pixel, line by line.
pub(super) fn lights<R: Real>(scene: &Scene, settings: Settings, is_accelerated: bool) -> Vec<LinearRgb> {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R>::new(scene, &mut memory).expect("a legal scene");
    let prepared = if is_accelerated { prepared } else { prepared.without_acceleration() };
    let renderer = Renderer::new(&prepared, settings).expect("legal settings");
    let pixels = (0..renderer.height()).flat_map(|y| (0..renderer.width()).map(move |x| (x, y)));
    pixels.map(|(x, y)| renderer.pixel(x as u16, y as u16, &mut ()).0.to_f32()).collect()
}

/// A camera that looks along -z, with a lens.
fn camera(lens: Option<Lens>) -> Camera {
    Camera { eye: Vec3::ZERO, target: Vec3::new(0.0, 0.0, -1.0), up: UP, vertical_fov: 0.2, lens }
}

/// Half the height of the picture at distance 1.
fn half_height() -> f64 {
    (f64::from(camera(None).vertical_fov) / 2.0).tan()
}

/// A point at distance d is spread over a circle: on the plane in focus, at distance f, its diameter is
/// 2·radius·|d - f| / d. The light of an even disc has a variance of diameter² / 16 along each axis; a
/// hexagon has 5/24 of its squared radius.
fn assert_circle_of_confusion<R: Real>() {
    let (side, radius, focus) = (48u32, 0.2, 10.0);
    for (distance, blades) in [(5.0f32, 0u8), (30.0, 0), (30.0, 6)] {
        let size = 0.01 * distance;
        let place = Vec3::new(0.0, 0.0, -distance);
        let objects = [Object::new(Shape::Disc(Disc::new(place, Vec3::new(0.0, 0.0, 1.0), size)), 0)];
        let lens = Lens { blades, ..Lens::round(radius, focus) };
        let scene = Scene {
            camera: camera(Some(lens)),
            background: Background::BLACK,
            objects: &objects,
            materials: &[GLOWING],
            lights: &[],
            motions: &[],
        };
        let picture = lights::<R>(&scene, samples(side, side, 1024), true);
        let pixel = 2.0 * half_height() / f64::from(side);
        let (mut sum, mut squares) = (0.0, 0.0);
        for (index, light) in picture.iter().enumerate() {
            let x = ((index as u32 % side) as f64 + 0.5) * pixel - half_height();
            sum += f64::from(light.g);
            squares += f64::from(light.g) * x * x;
        }
        let found = squares / sum;
        let (focus, distance, size) = (f64::from(focus), f64::from(distance), f64::from(size));
        // All in units of the picture at distance 1: the blur, the disc itself, and the width of a pixel.
        let blur = f64::from(radius) * (distance - focus).abs() / distance / focus;
        let shape = if blades == 0 { 0.25 } else { 5.0 / 24.0 };
        let expected = blur * blur * shape + (size / distance).powi(2) / 4.0 + pixel * pixel / 12.0;
        println!("distance {distance}, {blades} blades: variance {found:.3e}, expected {expected:.3e}");
        assert!((found / expected - 1.0).abs() < 0.02, "{distance}: {found}, not {expected}");
    }
}

#[test]
fn circles_of_confusion_have_their_diameter() {
    assert_circle_of_confusion::<f32>();
    assert_circle_of_confusion::<f64>();
    assert_circle_of_confusion::<Fixed>();
}

/// A surface in the plane of focus is as sharp as through a pinhole.
#[test]
fn what_is_in_focus_is_sharp() {
    let corner = Vec3::new(-0.6, -0.55, -10.0);
    let board = Rectangle::new(corner, Vec3::new(1.1, 0.0, 0.0), Vec3::new(0.0, 0.9, 0.0));
    let scene = |lens| Scene {
        camera: camera(lens),
        background: Background::BLACK,
        objects: &[],
        materials: &[GLOWING],
        lights: &[],
        motions: &[],
    };
    let objects = [Object::new(Shape::Rectangle(board), 0)];
    let of = |lens| lights::<f32>(&Scene { objects: &objects, ..scene(lens) }, samples(40, 40, 64), true);
    let (pinhole, lens) = (of(None), of(Some(Lens::round(0.5, 10.0))));
    // A sample may fall on the other side of an edge by rounding.
    let most = pinhole.iter().zip(&lens).map(|(a, b)| (a.g - b.g).abs()).fold(0.0, f32::max);
    assert!(most <= 2.0 / 64.0, "{most}");
    // Out of focus, the same edges are blurred over several pixels.
    let blurred = of(Some(Lens::round(0.5, 5.0)));
    let partial =
        |picture: &[LinearRgb]| picture.iter().filter(|light| (0.02..0.98).contains(&light.g)).count();
    assert!(partial(&blurred) > 4 * partial(&lens), "{} {}", partial(&blurred), partial(&lens));
}

/// A lens whose circles of confusion are smaller than half a pixel gives the picture of a pinhole, with one
/// sample.
fn assert_small_lens_is_a_pinhole<R: Real>() {
    let ball = Sphere::new(Vec3::new(0.0, 0.0, -500.0), 350.0 * half_height() as f32);
    let floor = Plane::new(Vec3::new(0.0, -8.0, 0.0), UP);
    let objects = [Object::new(Shape::Sphere(ball), 0), Object::new(Shape::Plane(floor), 0)];
    let shaded = Material { ambient: 0.2, diffuse: 0.6, ..Material::matte(LinearRgb::WHITE) };
    let scene = |lens| Scene {
        camera: camera(lens),
        background: Background::BLACK,
        objects: &objects,
        materials: core::slice::from_ref(&shaded),
        lights: &[],
        motions: &[],
    };
    let side = 48u32;
    let of = |lens, side| lights::<R>(&scene(lens), samples(side, side, 1), true);
    // The largest circle is that of the sky: 2·radius / focus, seen from the eye.
    let radius = |circle: f64, side: u32| circle * 2.0 * half_height() / f64::from(side) * 10.0 / 2.0;
    let [small, large] = [0.49, 0.51].map(|circle| Some(Lens::round(radius(circle, side) as f32, 10.0)));
    assert!(of(small, side) == of(None, side));
    assert!(of(large, side) != of(None, side));
    // In a picture of more pixels, the same circle is larger.
    assert!(of(small, side * 2) != of(None, side * 2));
    // A circle near the eye is larger than that of the sky.
    let near = [objects[0], Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.0, 0.0, -3.5), 0.05)), 0)];
    let near = |lens| lights::<R>(&Scene { objects: &near, ..scene(lens) }, samples(side, side, 1), true);
    assert!(near(small) != near(None));
}

#[test]
fn lenses_too_small_to_see_are_pinholes() {
    assert_small_lens_is_a_pinhole::<f32>();
    assert_small_lens_is_a_pinhole::<f64>();
    assert_small_lens_is_a_pinhole::<Fixed>();
}

/// A mirror with the lobe cosⁿ shows a round lamp around the mirrored direction with the share of the lobe
/// that lies within the lamp's angle α: 1 - cosⁿ⁺¹ α.
fn assert_lobe_meets_lamp<R: Real>() {
    let (distance, lamp) =
        (4.0f32, Disc::ring(Vec3::new(0.0, 0.0, 0.1), Vec3::new(0.0, 0.0, -1.0), 0.0, 1.5));
    let mirror = Plane::new(Vec3::new(0.0, 0.0, -distance), Vec3::new(0.0, 0.0, 1.0));
    let objects = [Object::new(Shape::Plane(mirror), 0), Object::new(Shape::Disc(lamp), 1)];
    for n in [1.0f32, 10.0, 100.0] {
        let optics = Optics { gloss: Some(n), ..Optics::PLAIN };
        let mirror = Material {
            diffuse: 0.0,
            reflectance: 1.0,
            optics: Some(&optics),
            ..Material::matte(LinearRgb::WHITE)
        };
        let scene = Scene {
            camera: Camera { vertical_fov: 0.001, ..camera(None) },
            background: Background::BLACK,
            objects: &objects,
            materials: &[mirror, GLOWING],
            lights: &[],
            motions: &[],
        };
        let found = f64::from(lights::<R>(&scene, samples(1, 1, 4096), true)[0].g);
        let cosine = (f64::from(distance) + 0.1) / (f64::from(distance) + 0.1).hypot(1.5);
        let expected = 1.0 - cosine.powf(f64::from(n) + 1.0);
        println!("exponent {n}: {found:.4}, expected {expected:.4}");
        assert!((found - expected).abs() < 0.003, "{n}: {found}, not {expected}");
    }
}

#[test]
fn lobes_show_lamps_as_large_as_they_should() {
    assert_lobe_meets_lamp::<f32>();
    assert_lobe_meets_lamp::<f64>();
    assert_lobe_meets_lamp::<Fixed>();
}

/// In a furnace, where everything has the light 1, surfaces that lose nothing are invisible. What is lost is
/// caught inside of glass for more bounces than are followed.
#[test]
fn a_furnace_stays_a_furnace() {
    let plain = Material { diffuse: 0.0, ambient: 0.0, ..Material::matte(LinearRgb::WHITE) };
    let mirror = Material { reflectance: 1.0, ..plain };
    let glass = Material { transmittance: 1.0, ior: 1.5, ..plain };
    let white = Material { diffuse: 1.0, ..plain };
    let lobes = |gloss, translucency| Optics { gloss, translucency, ..Optics::PLAIN };
    let fresnel = |fresnel| Optics { fresnel, ..Optics::PLAIN };
    let (exact, schlick) = (fresnel(Fresnel::Exact), fresnel(Fresnel::Schlick));
    let gloss = [0.0, 3.0, 50.0, 1e4].map(|exponent| lobes(Some(exponent), None));
    let (satin, both) = (lobes(None, Some(3.0)), lobes(Some(0.0), Some(0.0)));
    let frosted = Optics { translucency: Some(50.0), ..exact };
    for (name, material, optics, lost) in [
        ("mirror", mirror, Optics::PLAIN, 0.0),
        ("white metal", mirror, schlick, 0.0),
        ("gloss 0", mirror, gloss[0], 0.0),
        ("gloss 3", mirror, gloss[1], 0.0),
        ("gloss 50", mirror, gloss[2], 0.0),
        ("gloss 10,000", mirror, gloss[3], 0.0),
        // Without a change of the index, no light is caught inside.
        ("satin", Material { transmittance: 1.0, ..plain }, satin, 0.0),
        ("both lobes", Material { reflectance: 0.5, transmittance: 0.5, ..plain }, both, 0.0),
        (
            "constant glass",
            Material { reflectance: 0.2, transmittance: 0.8, ior: 1.5, ..plain },
            Optics::PLAIN,
            0.0,
        ),
        ("glass", glass, exact, 1e-3),
        ("Schlick's glass", glass, schlick, 1e-3),
        // Light that is spread inside may be totally reflected for ever.
        ("frosted glass", glass, frosted, 0.08),
        ("white", white, Optics::PLAIN, 0.0),
        (
            "white under half a mirror",
            Material { diffuse: 0.5, reflectance: 0.5, ..plain },
            Optics::PLAIN,
            0.0,
        ),
    ] {
        for area_lights in [AreaLights::Sampled, AreaLights::ClosedForm] {
            let materials = [Material { optics: Some(&optics), ..material }];
            let ball = Sphere::new(Vec3::new(0.0, 0.0, -5.0), 0.45);
            let scene = Scene {
                camera: camera(Some(Lens::round(0.1, 5.0))),
                background: Background::gray(1.0),
                objects: &[Object::new(Shape::Sphere(ball), 0)],
                materials: &materials,
                lights: &[Light::Sky],
                motions: &[],
            };
            let settings = Settings { bounces: 16, cutoff: 0.0, area_lights, ..samples(16, 16, 16) };
            for (number, picture) in [
                ("f32", lights::<f32>(&scene, settings, true)),
                ("f64", lights::<f64>(&scene, settings, true)),
                ("fixed", lights::<Fixed>(&scene, settings, true)),
            ] {
                let sum: f64 = picture.iter().map(|light| f64::from(light.g)).sum();
                let mean = sum / picture.len() as f64;
                assert!(mean > 1.0 - lost - 1e-3 && mean < 1.001, "{name}, {number}: {mean}");
                assert!(picture.iter().all(|light| light.g < 1.002), "{name}, {number}");
            }
        }
    }
}

/// The mean of pictures with few samples is that of `f64` with many: there is no bias. Each pixel is compared
/// in units of the deviation that its samples have (a z-test).
#[test]
fn few_samples_have_the_mean_of_many() {
    let (width, height) = (16, 12);
    let assert_unbiased =
        |name: &str, render: &dyn Fn(Settings) -> Vec<LinearRgb>, reference: &[LinearRgb]| {
            let seeds = 24;
            let mut sums = vec![(0.0, 0.0); reference.len()];
            for seed in 0..seeds {
                let settings = samples(width, height, 16);
                let sampling = Sampling { sampler: Sampler::Random, seed, ..settings.sampling };
                let picture = render(Settings { sampling, ..settings });
                for (sum, light) in sums.iter_mut().zip(&picture) {
                    *sum = (sum.0 + f64::from(light.g), sum.1 + f64::from(light.g).powi(2));
                }
            }
            let (mut squares, mut count) = (0.0, 0.0);
            for ((sum, square), reference) in sums.iter().zip(reference) {
                let seeds = f64::from(seeds);
                let mean = sum / seeds;
                let variance = (square / seeds - mean * mean) / (seeds - 1.0);
                if variance > 1e-8 {
                    squares += (mean - f64::from(reference.g)).powi(2) / variance;
                    count += 1.0;
                }
            }
            // Student's t with 23 degrees of freedom has a variance of 23/21.
            let ratio: f64 = squares / count / (23.0 / 21.0);
            println!("{name}: mean square of z {ratio:.3} in {count} pixels");
            assert!(
                count > 50.0 && (ratio - 1.0).abs() < 5.0 * (2.0f64 / count).sqrt() + 0.05,
                "{name}: {ratio}"
            );
        };
    for name in SCENES {
        let arena = Bump::new();
        let scene = gallery(name, &arena).scene;
        let reference = lights::<f64>(&scene, samples(width, height, 4096), true);
        assert_unbiased(name, &|settings| lights::<f32>(&scene, settings, true), &reference);
        assert_unbiased(name, &|settings| lights::<Fixed>(&scene, settings, true), &reference);
    }
}

/// The bytes depend neither on threads nor on the parts that are drawn, nor on acceleration.
#[test]
fn pictures_do_not_depend_on_order_or_acceleration() {
    for name in SCENES {
        let arena = Bump::new();
        let loaded = gallery(name, &arena);
        let settings = Settings { width: 48, height: 36, ..loaded.settings };
        let sampling = Sampling { samples: 8, adaptive: None, ..settings.sampling };
        let settings = Settings { sampling, ..settings };
        for number in [Number::F32, Number::Fixed] {
            let options = RenderOptions { number, threads: 1, ..RenderOptions::new(settings) };
            let whole = render(&loaded.scene, &options).unwrap();
            for threads in [2, 5] {
                let again = render(&loaded.scene, &RenderOptions { threads, ..options.clone() }).unwrap();
                assert!(again.rgb == whole.rgb, "{name}, {threads} threads");
            }
            let part = render(&loaded.scene, &RenderOptions { lines: Some(7..23), ..options }).unwrap();
            assert!(part.rgb == whole.rgb[7 * 144..23 * 144], "{name}");
        }
        fn assert_same<R: Real>(scene: &Scene, settings: Settings) {
            assert!(lights::<R>(scene, settings, true) == lights::<R>(scene, settings, false));
        }
        assert_same::<f32>(&loaded.scene, settings);
        assert_same::<Fixed>(&loaded.scene, settings);
    }
}

/// A scene of more than 32 objects goes through the hierarchy, and in floating point not in groups.
#[test]
fn many_objects_have_the_same_bytes_with_a_hierarchy() {
    let optics = Optics { gloss: Some(50.0), ..Optics::PLAIN };
    let glossy = Material {
        diffuse: 0.4,
        reflectance: 0.6,
        optics: Some(&optics),
        ..Material::matte(LinearRgb::WHITE)
    };
    let objects: Vec<Object<Shape>> = (0..60)
        .map(|index: u16| {
            let (x, y) = (f32::from(index % 10) * 0.2 - 0.9, f32::from(index / 10) * 0.2 - 0.5);
            Object::new(Shape::Sphere(Sphere::new(Vec3::new(x, y, -9.0), 0.12)), index % 2)
        })
        .collect();
    let scene = Scene {
        camera: camera(Some(Lens::round(0.2, 8.5))),
        background: Background::gray(0.3),
        objects: &objects,
        materials: &[glossy, GLOWING],
        lights: &[],
        motions: &[],
    };
    for count in [1, 3] {
        let settings = samples(24, 24, count);
        assert!(lights::<f32>(&scene, settings, true) == lights::<f32>(&scene, settings, false));
        assert!(lights::<Fixed>(&scene, settings, true) == lights::<Fixed>(&scene, settings, false));
    }
}

/// POV-Ray's lens blurs alike.
#[test]
fn a_lens_blurs_as_in_povray() {
    let arena = Bump::new();
    let loaded = gallery("camera-lens", &arena);
    let lens = loaded.scene.camera.lens.map(|lens| Lens { blades: 0, ..lens });
    let scene = Scene { camera: Camera { lens, ..loaded.scene.camera }, ..loaded.scene };
    let settings = Settings { transfer: Transfer::Linear, bounces: 2, ..samples(96, 72, 256) };
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("povray-lens");
    let Some(povray) = PovrayPicture::render(&scene, settings, &directory, "lens") else { return };
    let ours = core_picture::<f32>(&scene, settings);
    let apart = |other: &[[u8; 3]]| {
        let pairs = other.iter().flatten().zip(povray.picture.pixels.iter().flatten());
        let sum: f64 = pairs.map(|(a, b)| f64::from(a.abs_diff(*b)) / 255.0).sum();
        sum / (other.len() * 3) as f64
    };
    let sharp = Scene { camera: Camera { lens: None, ..scene.camera }, ..scene };
    let pinhole = core_picture::<f32>(&sharp, settings);
    let (error, before) = (apart(&ours.pixels), apart(&pinhole.pixels));
    println!("mean difference from POV-Ray: {:.2} %; of a pinhole {:.2} %", error * 100.0, before * 100.0);
    assert!(error < 0.005 && error < 0.4 * before, "{error}");
}

/// A floor below a lamp, and what stands between, seen from a camera that looks straight down.
fn below_lamp<'a>(objects: &'a [Object<Shape<'a>>], materials: &'a [Material<'a>], width: f32) -> Scene<'a> {
    Scene {
        camera: Camera {
            eye: Vec3::new(0.0, 1.0, 0.0),
            target: Vec3::ZERO,
            up: Vec3::new(0.0, 0.0, -1.0),
            vertical_fov: 2.0 * (width / 2.0).atan(),
            lens: None,
        },
        background: Background::BLACK,
        objects,
        materials,
        lights: &[Light::Object(ObjectId(0))],
        motions: &[],
    }
}

/// Behind an edge, the penumbra of a lamp is as wide as the lamp, times the distance of floor and edge over
/// that of edge and lamp.
fn assert_penumbra_has_its_width<R: Real>() {
    let (lamp_height, edge_height, radius) = (8.0f32, 4.0f32, 0.2f32);
    let lamp = Disc::new(Vec3::new(0.0, lamp_height, 0.0), UP, radius);
    // An opaque half plane on the right, above the camera.
    let edge =
        Rectangle::new(Vec3::new(0.0, edge_height, -3.0), Vec3::new(3.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 6.0));
    let floor = Plane::new(Vec3::ZERO, UP);
    let objects = [
        Object::new(Shape::Disc(lamp), 0),
        Object::new(Shape::Rectangle(edge), 1),
        Object::new(Shape::Plane(floor), 1),
    ];
    let bright = Optics { emission: LinearRgb::gray(50.0), ..Optics::PLAIN };
    let bright = Material { optics: Some(&bright), ..GLOWING };
    let materials = [bright, Material::matte(LinearRgb::WHITE)];
    let columns = 64;
    let scene = below_lamp(&objects, &materials, 1.0);
    let picture = lights::<R>(&scene, samples(columns, columns, 64), true);
    // The middle line. The penumbra is from -half to half of its width.
    let middle = &picture[(columns * columns / 2) as usize..][..columns as usize];
    let width = f64::from(2.0 * radius * edge_height / (lamp_height - edge_height));
    let full = f64::from(middle[2].g);
    for (column, light) in middle.iter().enumerate() {
        let x = (column as f64 + 0.5) / f64::from(columns) - 0.5;
        // The share of the lamp's disc on one side of the edge, which is seen at this place.
        let u = (x / (width / 2.0)).clamp(-1.0, 1.0);
        let hidden = 0.5 + (u * (1.0 - u * u).sqrt() + u.asin()) / core::f64::consts::PI;
        let found = f64::from(light.g) / full;
        assert!((found - (1.0 - hidden)).abs() < 0.02, "{x:.3}: {found:.3}, not {:.3}", 1.0 - hidden);
    }
    // With one sample, umbra and full light take 4 rays, and the penumbra up to 16.
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R>::new(&scene, &mut memory).unwrap();
    let renderer = Renderer::new(&prepared, Settings::new(columns, columns)).unwrap();
    let shadow_rays = |x| {
        let mut rays = RayCounts::default();
        renderer.pixel(x, columns as u16 / 2, &mut Watch(&mut rays));
        rays.shadow
    };
    assert_eq!([0, 4, 59, 63].map(shadow_rays), [4; 4]);
    assert!((28..36).map(shadow_rays).all(|rays| rays == 4 || rays == 16));
    assert!((28..36).map(shadow_rays).any(|rays| rays == 16));
}

/// Sobol's samples give neighboring pixels different errors, so that noise is fine. Blurred over 8×8 pixels,
/// white noise keeps 1/64 of its variance, and noise of Sobol's samples 0.68 times as much with one sample
/// (which takes more rays in the penumbra), 0.33 with 4, and 0.36 with 16.
#[test]
fn errors_of_neighbors_differ() {
    // The middle of a penumbra, so small that all pixels should have the same light.
    let lamp = Disc::new(Vec3::new(0.0, 8.0, 0.0), UP, 0.2);
    // The edge is askew and hides a third of the lamp. An edge through the middle, along an axis of the lamp,
    // would part Sobol's points evenly.
    let edge = Rectangle::new(Vec3::new(0.03, 4.0, -3.0), Vec3::new(3.0, 0.0, 0.0), Vec3::new(0.2, 0.0, 6.0));
    let objects = [
        Object::new(Shape::Disc(lamp), 0),
        Object::new(Shape::Rectangle(edge), 1),
        Object::new(Shape::Plane(Plane::new(Vec3::ZERO, UP)), 1),
    ];
    let bright = Optics { emission: LinearRgb::gray(50.0), ..Optics::PLAIN };
    let bright = Material { optics: Some(&bright), ..GLOWING };
    let materials = [bright, Material::matte(LinearRgb::WHITE)];
    let scene = below_lamp(&objects, &materials, 1e-5);
    let side = 64usize;
    let kept = |sampler, count| {
        let sampling = Sampling { sampler, ..Sampling::new(count) };
        let settings = Settings { sampling, ..Settings::new(side as u32, side as u32) };
        let light: Vec<f64> = lights::<f32>(&scene, settings, true).iter().map(|l| f64::from(l.g)).collect();
        let mean = light.iter().sum::<f64>() / light.len() as f64;
        let variance = |values: &[f64]| {
            values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len() as f64
        };
        let blurred: Vec<f64> = (0..(side / 8 - 1) * (side / 8 - 1))
            .map(|block| {
                // Beside the blocks of the sampler, each of which is a whole part of a sequence.
                let (left, top) = (block % (side / 8 - 1) * 8 + 3, block / (side / 8 - 1) * 8 + 5);
                let pixels = (0..64).map(|i| light[(top + i / 8) * side + left + i % 8]);
                pixels.sum::<f64>() / 64.0
            })
            .collect();
        variance(&blurred) / variance(&light) * 64.0
    };
    let mut kept_low = Vec::new();
    for count in [1, 4, 16] {
        let (sobol, random) = (kept(Sampler::Sobol, count), kept(Sampler::Random, count));
        println!(
            "{count} samples: of white noise's low frequencies, sobol keeps {sobol:.3}, random {random:.2}"
        );
        kept_low.push((sobol, random));
    }
    assert!(kept_low.iter().all(|(_, random)| (0.6..1.5).contains(random)), "{kept_low:?}");
    assert!(kept_low.iter().all(|(sobol, _)| *sobol < 0.8), "{kept_low:?}");
    assert!(kept_low.iter().skip(1).all(|(sobol, _)| *sobol < 0.45), "{kept_low:?}");
}

#[test]
fn penumbras_have_their_width() {
    assert_penumbra_has_its_width::<f32>();
    assert_penumbra_has_its_width::<f64>();
    assert_penumbra_has_its_width::<Fixed>();
}

/// The light of a disc on its axis is L · sin² α on a white surface, and it falls off aside with the closed
/// form of two parallel discs.
#[test]
fn lamps_light_as_closed_forms_say() {
    let (height, radius) = (3.0f32, 1.5f32);
    let emission = LinearRgb::new(1.0, 2.0, 0.5);
    let optics = Optics { emission, ..Optics::PLAIN };
    let materials = [Material { optics: Some(&optics), ..GLOWING }, Material::matte(LinearRgb::WHITE)];
    let floor = Object::new(Shape::Plane(Plane::new(Vec3::ZERO, UP)), 1);
    let center = Vec3::new(0.0, height, 0.0);
    let (h, r) = (f64::from(height), f64::from(radius));
    for (lamp, expected) in [
        (Shape::Disc(Disc::new(center, UP, radius)), r * r / (r * r + h * h)),
        (Shape::Sphere(Sphere::new(center, radius)), (r / h).powi(2)),
    ] {
        let objects = [Object::new(lamp, 0), floor];
        let scene = below_lamp(&objects, &materials, 0.001);
        for light in [
            lights::<f32>(&scene, samples(1, 1, 1024), true)[0],
            lights::<Fixed>(&scene, samples(1, 1, 1024), true)[0],
        ] {
            for (found, emitted) in light.channels().into_iter().zip(emission.channels()) {
                let (found, expected) = (f64::from(found), expected * f64::from(emitted));
                assert!((found / expected - 1.0).abs() < 5e-3, "{lamp:?}: {found}, not {expected}");
            }
        }
    }
}

/// A lamp that shines on one side lights what is before it as one that shines on both, and nothing behind
/// it; and it is black from behind.
fn assert_one_side_shines<R: Real>() {
    // The camera above looks down. Lamps hang above the floor, and the camera sees them beside the middle.
    let look = |shape: Shape<'_>, emission_sides, area_lights, eye: Vec3| {
        let optics = Optics { emission: LinearRgb::gray(3.0), emission_sides, ..Optics::PLAIN };
        let materials = [Material { optics: Some(&optics), ..GLOWING }, Material::matte(LinearRgb::WHITE)];
        let floor = Object::new(Shape::Plane(Plane::new(Vec3::ZERO, UP)), 1);
        let objects = [Object::new(shape, 0), floor];
        let mut scene = below_lamp(&objects, &materials, 0.001);
        (scene.camera.eye, scene.camera.up) = (eye, Vec3::new(0.1, 0.2, 1.0));
        lights::<R>(&scene, Settings { area_lights, ..samples(1, 1, 64) }, true)[0].g
    };
    let center = Vec3::new(0.5, 2.0, 0.25);
    let corner = center - Vec3::new(0.5, 0.0, 0.25);
    let (along, across) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.5));
    let above = Vec3::new(0.0, 1.0, 0.0);
    for area_lights in [AreaLights::Sampled, AreaLights::ClosedForm] {
        for (downward, upward) in [
            (Shape::Disc(Disc::new(center, -UP, 0.5)), Shape::Disc(Disc::new(center, UP, 0.5))),
            (
                // The normal is that of the cross product of both sides.
                Shape::Rectangle(Rectangle::new(corner, along, across)),
                Shape::Rectangle(Rectangle::new(corner, across, along)),
            ),
        ] {
            let floor = |shape, sides| look(shape, sides, area_lights, above);
            let both = floor(downward, Sides::Both);
            assert!(both > 0.05, "{both}");
            assert_eq!(floor(downward, Sides::Front), both);
            assert_eq!(floor(upward, Sides::Front), 0.0);
            // From above, along the line through the lamp's center to the middle of the floor.
            let lamp = |shape, sides| look(shape, sides, area_lights, center * 2.0);
            assert_eq!(lamp(upward, Sides::Both), 3.0);
            assert_eq!(lamp(upward, Sides::Front), 3.0);
            assert_eq!(lamp(downward, Sides::Both), 3.0);
            assert_eq!(lamp(downward, Sides::Front), 0.0);
        }
        let ball = Shape::Sphere(Sphere::new(center, 0.5));
        assert_eq!(look(ball, Sides::Front, area_lights, above), look(ball, Sides::Both, area_lights, above));
    }
}

#[test]
fn lamps_may_shine_on_one_side() {
    assert_one_side_shines::<f32>();
    assert_one_side_shines::<f64>();
    assert_one_side_shines::<Fixed>();
}

#[test]
fn bad_lamps_are_refused() {
    let lamp = Shape::Sphere(Sphere::new(UP, 1.0));
    let refused = |shape, material, named| {
        let objects = [Object::new(shape, material)];
        let lights = [Light::Object(ObjectId(named))];
        let materials = [GLOWING, Material::matte(LinearRgb::WHITE)];
        let scene = Scene { lights: &lights, ..below_lamp(&objects, &materials, 1.0) };
        let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
        PreparedScene::<f32>::new(&scene, &mut memory).map(|_| ()).map_err(|error| (error.part, error.fault))
    };
    assert_eq!(refused(lamp, 0, 0), Ok(()));
    let error = |fault| Err((Part::Light(0), fault));
    assert_eq!(refused(lamp, 0, 1), error(Fault::UnknownObject { named: 1, objects: 1 }));
    assert_eq!(refused(lamp, 1, 0), error(Fault::NoEmission));
    let ring = Shape::Disc(Disc::ring(UP, UP, 0.5, 1.0));
    assert_eq!(refused(ring, 0, 0), error(Fault::NoLuminaire));
    assert_eq!(refused(Shape::Plane(Plane::new(Vec3::ZERO, UP)), 0, 0), error(Fault::NoLuminaire));
}

/// The light of a glowing rectangle, from x = -0.3 to 0.1 and 4 high, in a picture of one line: 2 wide, at
/// the distance 1 of a camera that looks at x = 0.
fn line_of<R: Real>(motions: &[Motion], settings: Settings, is_accelerated: bool) -> Vec<f64> {
    let eye = Vec3::new(0.0, 0.0, 1.0);
    let strip = Rectangle::new(Vec3::new(-0.3, -2.0, 0.0), Vec3::new(0.4, 0.0, 0.0), UP * 4.0);
    let scene = Scene {
        camera: Camera { eye, target: Vec3::ZERO, vertical_fov: 0.01, ..camera(None) },
        background: Background::BLACK,
        objects: &[Object::new(Shape::Rectangle(strip), 0)],
        materials: &[GLOWING],
        lights: &[],
        motions,
    };
    lights::<R>(&scene, settings, is_accelerated).iter().map(|light| f64::from(light.g)).collect()
}

/// A strip of width w that moves by m leaves a blur of length w + m; each place shows the share of the time
/// in which the strip is there.
fn assert_blur_has_its_length<R: Real>() {
    let half = (0.005f64).tan();
    let (width, settings) = (200u32, samples(200, 1, 256));
    let pixel = 2.0 * half;
    for (way, by_camera) in [(0.5f32, false), (0.2, false), (0.5, true)] {
        let by = Vec3::new(way, 0.0, 0.0);
        // A camera sees the strip move the other way.
        let motion = if by_camera { Motion::of_camera(-by) } else { Motion::of_object(0, by) };
        let line = line_of::<R>(&[motion], settings, true);
        assert!(line == line_of::<R>(&[motion], settings, false));
        let (mut length, mut worst) = (0.0, 0.0f64);
        for (x, found) in line.iter().enumerate() {
            let place = (x as f64 + 0.5 - f64::from(width) / 2.0) * pixel;
            // The strip is here while its motion lies between these two.
            let (from, to) = (place - 0.1, place + 0.3);
            let way = f64::from(way);
            let expected = (to.clamp(0.0, way) - from.clamp(0.0, way)) / way;
            worst = worst.max((found - expected).abs());
            if *found > 0.0 {
                length += pixel;
            }
        }
        println!("way {way}: blur of {length:.3}, worst error {worst:.4}");
        assert!((length - (0.4 + f64::from(way))).abs() < 1.5 * pixel, "{length}");
        // A pixel is as wide as a fiftieth of the way or less.
        assert!(worst < 0.06, "{worst}");
    }
}

#[test]
fn a_moving_strip_leaves_a_blur_of_its_length() {
    assert_blur_has_its_length::<f32>();
    assert_blur_has_its_length::<f64>();
    assert_blur_has_its_length::<Fixed>();
}

/// A disc with a hole beside its axis of spin: at a distance d from the axis, the hole of radius r, whose
/// center is at distance a, is seen for the share acos((d² + a² - r²) / 2da) / π of a whole turn.
fn assert_spin_shows_all_angles<R: Real>() {
    let toward = Vec3::new(0.0, 0.0, 1.0);
    let (a, r) = (0.5f32, 0.2f32);
    let black = Material::matte(LinearRgb::BLACK);
    let hub = Disc::new(Vec3::ZERO, toward, 1.0);
    let spot = Disc::new(Vec3::new(a, 0.0, 0.01), toward, r);
    let turn = Motion::of_object(1, Vec3::ZERO).spinning(Vec3::ZERO, toward * 3.0, core::f32::consts::TAU);
    let scene = Scene {
        camera: Camera {
            eye: toward * 10.0,
            target: Vec3::ZERO,
            vertical_fov: 2.0 * 0.1f32.atan(),
            ..camera(None)
        },
        background: Background::BLACK,
        objects: &[Object::new(Shape::Disc(hub), 0), Object::new(Shape::Disc(spot), 1)],
        materials: &[black, GLOWING],
        lights: &[],
        motions: &[turn],
    };
    let side = 41u32;
    let picture = lights::<R>(&scene, samples(side, side, 1024), true);
    let mut worst = 0.0f64;
    for (index, light) in picture.iter().enumerate() {
        let place = |pixel: u32| (f64::from(pixel) + 0.5) / f64::from(side) * 2.0 - 1.0;
        let (x, y) = (place(index as u32 % side), place(index as u32 / side));
        let (a, r, d) = (f64::from(a), f64::from(r), x.hypot(y));
        // The mean over a pixel differs where the share is bent: at the inner and the outer edge.
        if (d - a).abs() > r - 0.05 && (d - a).abs() < r + 0.05 || d < 0.05 {
            continue;
        }
        let expected =
            ((d * d + a * a - r * r) / (2.0 * d * a)).clamp(-1.0, 1.0).acos() / core::f64::consts::PI;
        worst = worst.max((f64::from(light.g) - expected).abs());
    }
    println!("worst error of a spin: {worst:.4}");
    assert!(worst < 0.01, "{worst}");
}

#[test]
fn what_spins_is_seen_at_all_angles() {
    assert_spin_shows_all_angles::<f32>();
    assert_spin_shows_all_angles::<f64>();
    assert_spin_shows_all_angles::<Fixed>();
}

/// If everything moves and spins with the camera, nothing is blurred: the picture is that of the scene at
/// rest. Only lights do not come along, so there are none. Bumps and textures turn with their objects.
#[test]
fn what_moves_with_the_camera_is_sharp() {
    let arena = Bump::new();
    let loaded = gallery("texture-bump", &arena);
    let materials: Vec<Material> = loaded
        .scene
        .materials
        .iter()
        .map(|material| Material { ambient: 1.0, diffuse: 0.0, ..*material })
        .collect();
    let still =
        Scene { materials: &materials, lights: &[], background: Background::gray(0.3), ..loaded.scene };
    let (by, center) = (Vec3::new(0.4, -0.2, 0.3), Vec3::new(0.2, 0.5, 0.1));
    let along = |motion: Motion| Motion { by, ..motion }.spinning(center, Vec3::new(0.2, 1.0, 0.3), 0.8);
    let motions: Vec<Motion> = (0..still.objects.len())
        .map(|object| along(Motion::of_object(object as u16, by)))
        .chain([along(Motion::of_camera(by))])
        .collect();
    let settings = Settings { bounces: 2, ..samples(48, 36, 4) };
    let moving = lights::<f64>(&Scene { motions: &motions, ..still }, settings, true);
    let sharp = lights::<f64>(&still, settings, true);
    let differ = moving.iter().zip(&sharp).filter(|(a, b)| (a.g - b.g).abs() > 1e-3).count();
    assert!(differ <= moving.len() / 200, "{differ} pixels differ");
}

/// A shadow and a mirror image have the time of the ray that sees them: a ball that moves along with a lamp
/// shades what it shades at rest.
#[test]
fn all_rays_of_a_sample_have_one_time() {
    let materials = [GLOWING, Material::matte(LinearRgb::WHITE)];
    let lamp = Disc::new(Vec3::new(0.0, 4.0, 0.0), UP, 2.0);
    let objects = [
        Object::new(Shape::Disc(Disc::new(Vec3::ZERO, UP, 4.0)), 1),
        Object::new(Shape::Disc(lamp), 0),
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.0, 1.0, 0.0), 0.4)), 1),
    ];
    let by = Vec3::new(1.5, 0.0, 0.0);
    let all = [0, 1, 2].map(|object| Motion::of_object(object, by));
    let scene = |motions| Scene {
        camera: Camera {
            eye: Vec3::new(0.0, 3.0, 6.0),
            target: Vec3::ZERO,
            vertical_fov: 0.7,
            ..camera(None)
        },
        background: Background::BLACK,
        objects: &objects,
        materials: &materials,
        lights: &[Light::Object(ObjectId(1))],
        motions,
    };
    let with_camera: Vec<Motion> = all.iter().copied().chain([Motion::of_camera(by)]).collect();
    let settings = samples(32, 24, 16);
    let (moving, still) =
        (lights::<f64>(&scene(&with_camera), settings, true), lights::<f64>(&scene(&[]), settings, true));
    let differ = moving.iter().zip(&still).filter(|(a, b)| (a.g - b.g).abs() > 0.01).count();
    assert!(differ <= moving.len() / 100, "{differ} pixels differ");
    // Without the camera's motion everything is blurred.
    let blurred = lights::<f64>(&scene(&all), settings, true);
    let differ = blurred.iter().zip(&still).filter(|(a, b)| (a.g - b.g).abs() > 0.01).count();
    assert!(differ > moving.len() / 4, "{differ} pixels differ");
}

/// Lamps in closed form against rays: the error of the formulas, in a scene of balls.
#[test]
fn closed_forms_agree_with_rays() {
    assert_closed_form_agrees("light-closed-form", 0.002, 0.03);
    // Where two balls hide the same part of the sky, it is missing twice.
    assert_closed_form_agrees("light-sky", 0.006, 0.08);
}

fn assert_closed_form_agrees(name: &str, most_mean: f64, most: f64) {
    let arena = Bump::new();
    let loaded = gallery(name, &arena);
    assert_eq!(loaded.settings.area_lights, AreaLights::ClosedForm);
    let sampled = Settings { bounces: 2, ..samples(64, 48, 256) };
    let closed = Settings { area_lights: AreaLights::ClosedForm, ..sampled };
    let matte: Vec<Material> =
        loaded.scene.materials.iter().map(|material| Material { specular: 0.0, ..*material }).collect();
    let scene = Scene { materials: &matte, ..loaded.scene };
    fn errors<R: Real>(name: &str, scene: &Scene, closed: Settings, reference: &[LinearRgb]) -> [f64; 2] {
        let picture = lights::<R>(scene, closed, true);
        assert!(picture == lights::<R>(scene, closed, false));
        let errors: Vec<f64> =
            picture.iter().zip(reference).map(|(a, b)| f64::from((a.g - b.g).abs())).collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let worst = errors.iter().copied().fold(0.0, f64::max);
        println!("{name}, closed form against rays: mean error {mean:.4}, worst {worst:.4}");
        [mean, worst]
    }
    let reference = lights::<f64>(&scene, sampled, true);
    for [mean, worst] in
        [errors::<f32>(name, &scene, closed, &reference), errors::<Fixed>(name, &scene, closed, &reference)]
    {
        assert!(mean < most_mean && worst < most, "{mean} {worst}");
    }
}

/// A ball at the zenith hides sin² of its angular radius of an even sky.
fn assert_ball_hides_its_share<R: Real>() {
    for radius in [0.3f32, 0.8, 1.9] {
        let ball = Sphere::new(Vec3::new(0.0, 2.0, 0.0), radius);
        let objects = [
            Object::new(Shape::Disc(Disc::new(Vec3::ZERO, UP, 0.1)), 0),
            Object::new(Shape::Sphere(ball), 0),
        ];
        let scene = Scene {
            camera: Camera {
                eye: Vec3::new(0.0, 0.05, 1.0),
                target: Vec3::ZERO,
                vertical_fov: 0.01,
                ..camera(None)
            },
            background: Background::gray(0.5),
            objects: &objects,
            materials: &[Material::matte(LinearRgb::WHITE)],
            lights: &[Light::Sky],
            motions: &[],
        };
        let expected = 0.5 * (1.0 - f64::from(radius / 2.0).powi(2));
        let settings = samples(3, 3, 1024);
        for (area_lights, allowed) in [(AreaLights::Sampled, 0.003), (AreaLights::ClosedForm, 0.001)] {
            let picture = lights::<R>(&scene, Settings { area_lights, ..settings }, true);
            let found = f64::from(picture[4].g);
            assert!((found - expected).abs() < allowed, "{radius}, {area_lights:?}: {found}, not {expected}");
        }
    }
}

#[test]
fn a_ball_hides_its_share_of_the_sky() {
    assert_ball_hides_its_share::<f32>();
    assert_ball_hides_its_share::<f64>();
    assert_ball_hides_its_share::<Fixed>();
}

/// A place on the floor in the middle of glass balls, one inside of the other.
#[test]
fn the_sky_behind_too_many_layers_is_counted() {
    let clear = Material { transmittance: 0.9, ..Material::matte(LinearRgb::BLACK) };
    let cuts = |layers: u8| {
        let floor = Shape::Disc(Disc::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0), 2.0));
        let shell = |number| Shape::Sphere(Sphere::new(Vec3::ZERO, 10.0 + f32::from(number)));
        let mut objects = vec![Object::new(floor, 0)];
        objects.extend((0..layers).map(|number| Object::new(shell(number), 1)));
        let scene = Scene {
            camera: Camera {
                eye: Vec3::new(0.0, 3.0, 0.0),
                target: Vec3::ZERO,
                up: Vec3::new(1.0, 0.0, 0.0),
                vertical_fov: 0.1,
                lens: None,
            },
            background: Background::Solid(LinearRgb::WHITE),
            objects: &objects,
            materials: &[Material::matte(LinearRgb::WHITE), clear],
            lights: &[Light::Sky],
            motions: &[],
        };
        let settings = Settings { area_lights: AreaLights::Sampled, ..Settings::new(1, 1) };
        let mut counts = RayCounts::default();
        with_renderer::<f32, _>(&scene, settings, |renderer| renderer.pixel(0, 0, &mut counts));
        assert!(counts.shadow > 0, "rays to the sky");
        (counts.cut_shadow_layers, counts.shadow)
    };
    assert_eq!(cuts(8).0, 0);
    let (cut, rays) = cuts(9);
    assert_eq!(cut, rays, "every ray to the sky meets nine layers");
}

#[test]
fn a_scene_has_one_sky() {
    let arena = Bump::new();
    let scene = Scene { lights: &[Light::Sky, Light::Sky], ..gallery("light-sky", &arena).scene };
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
    let error = PreparedScene::<f32>::new(&scene, &mut memory).expect_err("two skies");
    assert_eq!((error.part, error.fault), (Part::Light(1), Fault::TwoSkies));
}

/// One ray a lamp, no numbers: pixels draw nothing, and a picture of one sample has no noise.
#[test]
fn closed_forms_take_one_ray_for_each_lamp() {
    let arena = Bump::new();
    let loaded = gallery("light-closed-form", &arena);
    let settings = Settings { bounces: 0, ..Settings::new(40, 30) };
    let rays = |area_lights| {
        let options = RenderOptions::new(Settings { area_lights, ..settings });
        let rays = render(&loaded.scene, &options).unwrap().rays;
        (rays.camera, rays.shadow)
    };
    let (camera, shadow) = rays(AreaLights::ClosedForm);
    assert!(camera == 1200 && shadow <= 2 * camera, "{shadow}");
    assert!(rays(AreaLights::Sampled).1 > 4 * shadow);
    let with = |seed| {
        let sampling = Sampling { seed, ..Sampling::CENTER };
        lights::<f32>(
            &loaded.scene,
            Settings { sampling, area_lights: AreaLights::ClosedForm, ..settings },
            true,
        )
    };
    assert!(with(1) == with(2));
}

#[test]
fn bad_motions_are_refused() {
    fn refused(motions: &[Motion]) -> (Part, Fault) {
        let arena = Bump::new();
        let scene = Scene { motions, ..gallery("camera-lens", &arena).scene };
        let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
        let error = PreparedScene::<f32>::new(&scene, &mut memory).expect_err("a bad motion");
        (error.part, error.fault)
    }
    let by = Vec3::new(1.0, 0.0, 0.0);
    let first = Motion::of_object(0, by);
    let (part, fault) = refused(&[first, Motion::of_object(999, by)]);
    assert!(part == Part::Motion(1) && matches!(fault, Fault::UnknownObject { named: 999, .. }), "{fault}");
    assert_eq!(refused(&[first, Motion::of_camera(by), first]), (Part::Motion(2), Fault::MovesTwice));
    assert_eq!(refused(&[Motion::of_camera(by * f32::NAN)]), (Part::Motion(0), Fault::NotFinite));
    assert_eq!(refused(&[Motion::of_object(1, by * 999_999.0)]), (Part::Motion(0), Fault::TooFar));
}
