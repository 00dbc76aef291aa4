//! Tests of realtime quality: pictures close to the exact ones with few rays, the same bytes in any order of
//! lines, and no lost thin objects.

use std::collections::HashMap;
use std::mem::MaybeUninit;
use std::ops::Range;
use std::path::Path;

use bumpalo::Bump;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayline::builtin::{CLASSIC, FLAKE, PRISM, WHITTED};
use rayline::math::Fixed;
use rayline::shape::{
    Cone, Csg, CsgStep, Cuboid, Cylinder, Disc, Ellipsoid, Instances, Mesh, Model, Plane, Polygon, Pose,
    Rectangle, Shape, Solid, Sphere, Torus, Triangle,
};
use rayline::{
    Background, Camera, DrawError, Encoding, Ends, Event, Figure, Filter, Grid, Image, Interleave, Light,
    LineError, LinearRgb, Map, Material, Object, Onto, Pattern, Pixels, Placed, Placement, PreparedScene,
    Probe, RayCounts, RayKind, Real, Realtime, RealtimeBuffer, Renderer, Sample, Sampling, Scene, Settings,
    Texture, Vec3,
};
use rayline_simulator::{LoadedScene, Orbit};
use rayline_tests::{Picture, Screen, Unplugged, Watch, with_scene};

/// Calls `use_it` with a renderer of the scene.
pub(super) fn with_renderer<R: Real, T>(
    scene: &Scene,
    settings: Settings,
    use_it: impl FnOnce(&Renderer<R>) -> T,
) -> T {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::new(scene, &mut memory).expect("a legal scene");
    use_it(&Renderer::new(&prepared, settings).expect("legal settings"))
}

/// The picture on a screen.
fn picture_on(screen: &Screen) -> Picture {
    let pixels = screen.picture().iter().map(|color| [color.r(), color.g(), color.b()]).collect();
    Picture { width: screen.area.size.width, pixels }
}

/// The buffers for one frame.
struct Memory {
    colors: Vec<Rgb888>,
    samples: Vec<Sample>,
}

impl Memory {
    fn new<R: Real>(renderer: &Renderer<R>, quality: Realtime) -> Self {
        let width = renderer.width() as u16;
        Self {
            colors: vec![Rgb888::BLACK; quality.colors(width)],
            samples: vec![Sample::BLANK; quality.samples(width)],
        }
    }

    fn lend(&mut self, quality: Realtime) -> RealtimeBuffer<'_, Rgb888> {
        quality.lend(&mut self.colors, &mut self.samples)
    }
}

/// The picture in realtime quality, and its ray counts.
pub(super) fn realtime<R: Real>(
    renderer: &Renderer<R>,
    quality: Realtime,
    probe: &mut dyn Probe<R>,
) -> Picture {
    let mut screen = Screen::new(renderer);
    let mut memory = Memory::new(renderer, quality);
    let mut frame = renderer.frame(0..renderer.height(), memory.lend(quality)).expect("a frame");
    while !frame.step_watched(&mut screen, u32::MAX, &mut Watch(probe)).expect("a step").is_done() {}
    picture_on(&screen)
}

pub(super) fn exact<R: Real>(renderer: &Renderer<R>, probe: &mut dyn Probe<R>) -> Picture {
    let mut line = vec![Rgb888::BLACK; renderer.width() as usize];
    let mut pixels = Vec::new();
    for y in 0..renderer.height() {
        renderer.lines(y, &mut line, &mut Watch(probe)).expect("a line");
        pixels.extend(line.iter().map(|color| [color.r(), color.g(), color.b()]));
    }
    Picture { width: renderer.width(), pixels }
}

/// The peak signal-to-noise ratio in decibels.
pub(super) fn psnr(a: &Picture, b: &Picture) -> f64 {
    assert_eq!((a.width, a.pixels.len()), (b.width, b.pixels.len()));
    let square = |(a, b): (&u8, &u8)| f64::from(a.abs_diff(*b)).powi(2);
    let sum: f64 = a.pixels.iter().flatten().zip(b.pixels.iter().flatten()).map(square).sum();
    10.0 * (255.0 * 255.0 * 3.0 * a.pixels.len() as f64 / sum).log10()
}

/// The table in the documentation of the module.
#[test]
fn close_to_exact_for_few_rays() {
    println!("scene    | PSNR dB | traced | rays, exact | rays");
    for (quality, bars) in [
        (
            Realtime::new(),
            [("classic", 43.0, 0.11), ("whitted", 43.0, 0.15), ("flake", 35.5, 0.20), ("prism", 40.0, 0.355)],
        ),
        (
            Realtime::fine(),
            [("classic", 45.0, 0.125), ("whitted", 44.0, 0.17), ("flake", 36.5, 0.24), ("prism", 39.5, 0.37)],
        ),
    ] {
        for (name, least, most) in bars {
            with_scene(name, |scene, bounces| {
                let settings = Settings { bounces, ..Settings::new(320, 240) };
                with_renderer::<f32, _>(scene, settings, |renderer| {
                    let (mut exact_rays, mut rays) = (RayCounts::default(), RayCounts::default());
                    let (a, b) = (exact(renderer, &mut exact_rays), realtime(renderer, quality, &mut rays));
                    let pixels = a.pixels.len() as f64;
                    let (close, traced) = (psnr(&a, &b), rays.camera as f64 / pixels);
                    println!(
                        "{name:8} | {close:.1} | {traced:.3} | {:.2} | {:.2}",
                        exact_rays.total() as f64 / pixels,
                        rays.total() as f64 / pixels
                    );
                    assert!(close >= least, "{name}: {close} dB");
                    assert!(traced <= most, "{name}: {traced} traced");
                });
            });
        }
    }
}

/// A scene of the gallery.
pub(super) fn gallery<'a>(name: &str, arena: &'a Bump) -> LoadedScene<'a> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../docs/gallery/{name}.ron"));
    LoadedScene::open(&file, arena).unwrap_or_else(|error| panic!("{error}"))
}

/// The PSNR of a picture of 320×240 against the exact one, in decibels, and the share of its pixels that are
/// traced.
fn close_and_traced(scene: &Scene, quality: Realtime) -> (f64, f64) {
    with_renderer::<f32, _>(scene, Settings { bounces: 6, ..Settings::new(320, 240) }, |renderer| {
        let mut rays = RayCounts::default();
        let (a, b) = (exact(renderer, &mut ()), realtime(renderer, quality, &mut rays));
        (psnr(&a, &b), rays.camera as f64 / a.pixels.len() as f64)
    })
}

/// Between two alike points of the grid there may be another texel, a joint or a hole.
#[test]
fn texels_bricks_and_stripes_between_points_of_the_grid_are_seen() {
    for (quality, bars) in [
        (
            Realtime::new(),
            [("texture-bump", 43.0, 0.36), ("texture-image", 44.0, 0.19), ("texture-maps", 37.5, 0.19)],
        ),
        (
            Realtime::fine(),
            [("texture-bump", 43.5, 0.375), ("texture-image", 44.5, 0.21), ("texture-maps", 39.5, 0.205)],
        ),
    ] {
        for (name, least, most) in bars {
            let arena = Bump::new();
            let (close, traced) = close_and_traced(&gallery(name, &arena).scene, quality);
            assert!(close >= least, "{name}: {close} dB");
            assert!(traced <= most, "{name}: {traced} traced");
        }
    }
}

/// A photograph with a texel for each pixel must not make every pixel an edge.
#[test]
fn smooth_images_are_interpolated() {
    let level = |wave: f32| (128.0 + 60.0 * wave.sin()) as u8;
    let texel = |x: f32, y: f32| [level((x + y) / 40.0), level((x - y) / 60.0), level(y / 50.0)];
    let texels: Vec<u8> =
        (0..240u16).flat_map(|y| (0..320u16).flat_map(move |x| texel(x.into(), y.into()))).collect();
    let image = Image {
        width: 320,
        height: 240,
        pixels: Pixels::Rgb888(&texels),
        encoding: Encoding::Srgb,
        filter: Filter::Nearest,
        ends: Ends::Repeat,
    };
    let photograph = Placed::new(Figure::Image(image), Placement::SURFACE);
    let photograph = Texture::Placed(&photograph);
    let bump = [Map { onto: Onto::Bump { height: 0.01, step: 0.02 }, texture: photograph }];
    let share = [Map { onto: Onto::Diffuse, texture: photograph }];
    let plain = Material::matte(LinearRgb::gray(0.8));
    let colored = Material { color: photograph, ..plain };
    let (shared, bumped) = (Material { maps: &share, ..plain }, Material { maps: &bump, ..plain });
    for (material, most) in [(colored, 0.45), (shared, 0.3), (bumped, 0.3)] {
        let wall = Rectangle {
            corner: Vec3::new(-1.4, -1.05, -5.0),
            right: Vec3::new(2.8, 0.0, 0.0),
            up: Vec3::new(0.0, 2.1, 0.0),
        };
        let scene = Scene {
            objects: &[Object::new(Shape::Rectangle(wall), 0)],
            materials: &[material],
            lights: &[Light::Point { position: Vec3::new(2.0, 3.0, 0.0), color: LinearRgb::WHITE }],
            ..CLASSIC
        };
        let (close, traced) = close_and_traced(&scene, Realtime::new());
        assert!(close >= 40.0 && traced <= most, "{close} dB, {traced} traced");
    }
}

/// The results of a function for each of 24 frames around a scene, from the exact and the realtime picture.
fn of_rotation<T>(
    scene: &Scene,
    distance: f32,
    settings: Settings,
    quality: Realtime,
    tell: impl Fn(&Picture, &Picture) -> T,
) -> impl Iterator<Item = T> {
    let mut orbit = Orbit::new(scene.camera, distance).expect("an orbit");
    (0..24).map(move |_| {
        orbit.turn(core::f64::consts::TAU / 24.0, 0.0);
        let scene = Scene { camera: orbit.camera(), ..*scene };
        with_renderer::<f32, _>(&scene, settings, |renderer| {
            tell(&exact(renderer, &mut ()), &realtime(renderer, quality, &mut ()))
        })
    })
}

/// The worst PSNR of 24 frames around a scene, in decibels.
fn worst_of_rotation(scene: &Scene, distance: f32, settings: Settings, quality: Realtime) -> f64 {
    of_rotation(scene, distance, settings, quality, psnr).fold(f64::INFINITY, f64::min)
}

/// The materials of the stage, of mirrors and of objects, for tests of shadows.
const STAGE: [Material; 3] = [
    Material::matte(LinearRgb::gray(0.8)),
    Material { diffuse: 0.1, specular: 0.0, reflectance: 0.8, ..Material::matte(LinearRgb::WHITE) },
    Material::matte(LinearRgb::new(0.9, 0.1, 0.1)),
];
const SUN: [Light; 1] =
    [Light::Directional { direction: Vec3::new(0.8, -1.0, -0.5), color: LinearRgb::gray(0.9) }];
const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);
const FLOOR: Shape = Shape::Plane(Plane::new(Vec3::ZERO, UP));

/// A scene with these objects under the sun, in front of a sky.
fn staged<'s>(objects: &'s [Object<Shape<'s>>], eye: Vec3, target: Vec3, vertical_fov: f32) -> Scene<'s> {
    Scene {
        camera: Camera { eye, target, up: UP, vertical_fov, lens: None },
        background: LinearRgb::new(0.3, 0.4, 0.6).into(),
        objects,
        materials: &STAGE,
        lights: &SUN,
        motions: &[],
    }
}

/// Four balls on a floor, seen from this height.
fn with_low_shadows(floor: Shape, height: f32, use_it: impl FnOnce(&Scene)) {
    let ball = |x: f32, z: f32, radius: f32| {
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(x, radius, z), radius)), 2)
    };
    let objects = [
        Object::new(floor, 0),
        ball(-2.0, 1.0, 0.5),
        ball(0.3, -1.0, 0.4),
        ball(1.5, 1.5, 0.3),
        ball(-0.6, 2.0, 0.2),
    ];
    use_it(&staged(&objects, Vec3::new(2.0, height, 9.0), UP * 0.6, 0.7));
}

/// Shadows on a floor that is seen at a flat angle are lower than the cells of the grid.
#[test]
fn low_shadows_do_not_flicker() {
    for (height, bars) in [(0.6, [40.5, 40.5]), (1.2, [34.0, 36.5]), (2.0, [36.0, 39.0])] {
        with_low_shadows(FLOOR, height, |scene| {
            for (quality, least) in QUALITIES.into_iter().zip(bars) {
                let worst = worst_of_rotation(scene, 9.2, Settings::new(320, 240), quality);
                assert!(worst >= least, "from {height}, {:?}: {worst} dB", quality.grid);
            }
        });
    }
}

/// How unevenly pixels change over three frames, in levels of green: the mean second difference in time.
fn unevenness(frames: &[Picture]) -> f64 {
    let of_three = |three: &[Picture]| -> f64 {
        let green = |frame: usize, pixel: usize| f64::from(three[frame].pixels[pixel][1]);
        let second = |pixel| (green(0, pixel) + green(2, pixel) - 2.0 * green(1, pixel)).abs();
        (0..three[0].pixels.len()).map(second).sum::<f64>() / three[0].pixels.len() as f64
    };
    frames.windows(3).map(of_three).sum::<f64>() / (frames.len() - 2) as f64
}

/// How often a pixel changes by more than 32 levels from one frame to the next, and back in the frame after.
fn pops(frames: &[Picture]) -> usize {
    let much = |a: u8, b: u8| (i32::from(b) - i32::from(a)) / 33;
    let of_three = |three: &[Picture]| {
        let pops = |pixel: &usize| {
            let [a, b, c] = [0, 1, 2].map(|frame| three[frame].pixels[*pixel]);
            (0..3).any(|channel| much(a[channel], b[channel]) * much(b[channel], c[channel]) < 0)
        };
        (0..three[0].pixels.len()).filter(pops).count()
    };
    frames.windows(3).map(of_three).sum()
}

/// From one frame to the next, a slow rotation changes realtime pictures hardly more unevenly than exact
/// ones. With smooth edges they change more evenly, and fewer pixels go there and back.
#[test]
fn a_slow_rotation_does_not_flicker() {
    for (name, scene, distance) in [
        ("classic", &CLASSIC, 16.0),
        ("prism", &PRISM, 9.8),
        ("whitted", &WHITTED, 7.0),
        ("flake", &FLAKE, 4.0),
    ] {
        let settings = Settings { bounces: 3, ..Settings::new(160, 120) };
        let mut orbit = Orbit::new(scene.camera, distance).expect("an orbit");
        let mut frames: [Vec<Picture>; 3] = Default::default();
        for _ in 0..16 {
            orbit.turn(0.5f64.to_radians(), 0.0);
            let scene = Scene { camera: orbit.camera(), ..*scene };
            with_renderer::<f32, _>(&scene, settings, |renderer| {
                frames[0].push(exact(renderer, &mut ()));
                frames[1].push(realtime(renderer, Realtime::fine(), &mut ()));
                frames[2].push(realtime(renderer, Realtime::fine().smooth(), &mut ()));
            });
        }
        let pops = [0, 1, 2].map(|quality| pops(&frames[quality]));
        let [exact, stepped, smooth] = frames.map(|frames| unevenness(&frames));
        println!("{name}: exact {exact:.2}, stepped {stepped:.2}, smooth {smooth:.2} levels; pops {pops:?}");
        assert!(stepped < exact * 1.05 && smooth < exact * 0.8, "{name}");
        assert!(pops[2] < pops[0], "{name}: {pops:?}");
    }
}

#[test]
fn a_rotation_does_not_flicker() {
    for (name, scene, distance, least) in
        [("classic", &CLASSIC, 16.0, [38.0, 37.0]), ("prism", &PRISM, 9.8, [36.5, 36.0])]
    {
        let sizes = [(320, 240, Realtime::new()), (160, 120, Realtime::fine())];
        for ((width, height, quality), least) in sizes.into_iter().zip(least) {
            let settings = Settings { bounces: 3, ..Settings::new(width, height) };
            let worst = worst_of_rotation(scene, distance, settings, quality);
            println!("{name}, {width}×{height}: {worst:.1} dB at least");
            assert!(worst >= least, "{name}, {width}×{height}: {worst} dB");
        }
    }
}

/// A scene with white ambient light, in front of a black background.
fn bright<'s>(objects: &'s [Object<Shape<'s>>], materials: &'s [Material<'s>]) -> Scene<'s> {
    Scene {
        camera: Camera {
            eye: Vec3::new(0.0, 0.0, 10.0),
            target: Vec3::new(0.0, 0.0, 0.0),
            up: Vec3::new(0.0, 1.0, 0.0),
            vertical_fov: 1.0,
            lens: None,
        },
        background: Background::BLACK,
        objects,
        materials,
        lights: &[],
        motions: &[],
    }
}

const QUALITIES: [Realtime; 2] = [Realtime::new(), Realtime::fine()];

const GLOWING: Material = Material { ambient: 1.0, diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) };

/// Asserts that every pixel of the objects is as in the exact picture, and that few other pixels are traced.
/// Returns the number of pixels that show them.
fn assert_shown_whole(objects: &[Object<Shape>], what: &str) -> usize {
    let scene = bright(objects, &[GLOWING]);
    with_renderer::<f32, _>(&scene, Settings::new(160, 120), |renderer| {
        let exact = exact(renderer, &mut ());
        for quality in QUALITIES {
            let mut rays = RayCounts::default();
            let close = realtime(renderer, quality, &mut rays);
            let lost = exact.pixels.iter().zip(&close.pixels).filter(|(exact, close)| exact != close).count();
            assert!(lost == 0, "{what}: {lost} pixels are wrong");
            assert!(rays.camera < 160 * 120 / 3, "{what}: {} of 19200 pixels", rays.camera);
        }
        exact.pixels.iter().filter(|pixel| pixel[0] > 0).count()
    })
}

#[test]
fn thin_objects_are_shown_whole() {
    // At 160×120, a pixel is 0.091 wide at the objects. Thinner objects may lie between two lines.
    let mut shown = 0;
    for step in 0..24 {
        let angle = step as f32 * core::f32::consts::PI / 24.0 + 0.01;
        let along = Vec3::new(4.0 * angle.cos(), 4.0 * angle.sin(), 0.0);
        let beside = Vec3::new(0.013, 0.029, 0.0);
        for radius in [0.03f32, 0.045, 0.09] {
            let needle = Cylinder { base: beside - along, top: beside + along, radius, capped: true };
            let bead = Sphere::new(Vec3::new(angle.sin() * 5.0, angle.cos() * 4.0, 0.0), radius);
            let objects = [Object::new(Shape::Cylinder(needle), 0), Object::new(Shape::Sphere(bead), 0)];
            let needle = assert_shown_whole(&objects, &format!("a needle of {radius} at {angle}"));
            assert!(needle > 0);
            shown += needle;
            for (name, shape) in thin_shapes(beside, along, radius) {
                shown +=
                    assert_shown_whole(&[Object::new(shape, 0)], &format!("{name} of {radius} at {angle}"));
            }
            let across = Vec3::new(-along.y, along.x, 0.0) * (radius / 4.0);
            let kite = [beside - along, beside + across, beside + along, beside - across];
            let kite = Shape::Polygon(Polygon::new(&kite));
            shown += assert_shown_whole(&[Object::new(kite, 0)], &format!("a kite of {radius} at {angle}"));
            let strut = |way: Vec3| {
                Solid::Cylinder(Cylinder { base: beside - way, top: beside + way, radius, capped: true })
            };
            let cross = [
                CsgStep::Solid(strut(along)),
                CsgStep::Solid(strut(across * (2.0 / radius))),
                CsgStep::Union,
            ];
            let cross = Shape::Csg(Csg::new(&cross));
            shown += assert_shown_whole(&[Object::new(cross, 0)], &format!("a cross of {radius} at {angle}"));
        }
    }
    assert!(shown > 24 * 3 * 10 * 50, "{shown} pixels");
}

/// Long or flat shapes, of length twice `along` and thickness twice `radius`.
fn thin_shapes(center: Vec3, along: Vec3, radius: f32) -> [(&'static str, Shape<'static>); 7] {
    let across = Vec3::new(-along.y, along.x, 0.0) * (radius / 4.0);
    // Toward the camera and slightly aside, so that flat shapes are seen from their edge.
    let toward = Vec3::new(0.0, 0.0, 1.0);
    let corner = center - along - across;
    let plate = [along, across, toward * 2.0];
    [
        ("a box", Shape::Cuboid(Cuboid::oriented(center, [along, across, toward * radius]))),
        ("a plate", Shape::Cuboid(Cuboid::oriented(center, plate))),
        ("a rectangle", Shape::Rectangle(Rectangle::new(corner, along * 2.0, across * 2.0))),
        ("a sliver", Shape::Triangle(Triangle::flat(corner, corner + across * 2.0, corner + along * 2.0))),
        (
            "a hoop",
            Shape::Torus(Torus {
                center,
                axis: along + toward * 2.0,
                major_radius: 2.0,
                minor_radius: radius,
            }),
        ),
        ("a ring", Shape::Disc(Disc::ring(center, toward + along * 0.1, 2.0, 2.0 + 2.0 * radius))),
        (
            "a coin",
            Shape::Cylinder(Cylinder {
                base: center - across,
                top: center + across,
                radius: 2.0,
                capped: true,
            }),
        ),
    ]
}

#[test]
fn glints_are_shown_in_every_frame() {
    // A mirror at the distance of that in `classic`, and smaller ones, with a moving highlight of a few
    // pixels.
    for (radius, shininess, least) in [(3.0, 1425.0, 501), (1.1, 800.0, 0), (1.5, 1425.0, 0), (0.8, 800.0, 0)]
    {
        let glossy = Material { diffuse: 0.0, specular: 1.0, shininess, ..Material::matte(LinearRgb::WHITE) };
        let ball = [Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.0, 0.0, 0.0), radius)), 0)];
        let mut sum = 0;
        for frame in 0..60 {
            let angle = frame as f32 * 0.011;
            let position = Vec3::new(30.0 * angle.sin(), 7.0, 30.0 * angle.cos());
            let lights = [Light::Point { position, color: LinearRgb::WHITE }];
            let scene = Scene { lights: &lights, ..bright(&ball, core::slice::from_ref(&glossy)) };
            with_renderer::<f32, _>(&scene, Settings::new(160, 120), |renderer| {
                let exact = light_of(&exact(renderer, &mut ()));
                sum += exact;
                // On a grid of eight pixels, pixels at the edge of a highlight may be interpolated.
                for (quality, part) in QUALITIES.into_iter().zip([6, 12]) {
                    let close = light_of(&realtime(renderer, quality, &mut ()));
                    let off = exact.abs_diff(close);
                    assert!(
                        exact >= least && off * part < exact.max(1),
                        "{close} of {exact} in frame {frame}, {shininess}, {quality:?}"
                    );
                }
            });
        }
        // The smallest highlights are often smaller than a pixel.
        assert!(sum > 60 * 20, "{sum} of {shininess}");
    }
}

/// The sum of the light of a picture.
fn light_of(picture: &Picture) -> u32 {
    picture.pixels.iter().map(|pixel| u32::from(pixel[0])).sum()
}

#[test]
fn highlights_are_shown_on_what_is_curved() {
    let rod = |radius| {
        let (base, top) = (Vec3::new(-3.0, -1.0, 0.0), Vec3::new(3.0, 1.0, 0.5));
        Shape::Cylinder(Cylinder { base, top, radius, capped: true })
    };
    let ball = |radius| Shape::Sphere(Sphere::new(Vec3::ZERO, radius));
    let axis = Vec3::new(0.1, 1.0, 0.5);
    let torus = Shape::Torus(Torus { center: Vec3::ZERO, axis, major_radius: 3.0, minor_radius: 1.0 });
    // Highlights from broad ones to those of a few pixels. A unit is 11 pixels.
    let (broad, all) = ([20.0, 40.0, 100.0].as_slice(), [20.0, 40.0, 100.0, 300.0].as_slice());
    for (name, shape, shininesses) in [
        ("a ball of 33 pixels", ball(3.0), all),
        ("a ball of 22 pixels", ball(2.0), all),
        ("a ball of 12 pixels", ball(1.1), broad),
        ("a rod of 9 pixels", rod(0.8), broad),
        ("a rod of 11 pixels", rod(1.0), all),
        ("a rod of 22 pixels", rod(2.0), all),
        ("a torus of 11 pixels", torus, all),
    ] {
        for &shininess in shininesses {
            let glossy =
                Material { diffuse: 0.0, specular: 1.0, shininess, ..Material::matte(LinearRgb::WHITE) };
            let objects = [Object::new(shape, 0)];
            let (mut total, mut most, mut worst) = (0, 0, f64::INFINITY);
            for frame in 0..40 {
                // The light moves from in front of the eye to far aside and above.
                let (sine, cosine) = (frame as f32 * 0.03).sin_cos();
                let position = Vec3::new(30.0 * sine, 7.0 + frame as f32 * 0.3, 30.0 * cosine);
                let lights = [Light::Point { position, color: LinearRgb::WHITE }];
                let scene = Scene { lights: &lights, ..bright(&objects, core::slice::from_ref(&glossy)) };
                with_renderer::<f32, _>(&scene, Settings::new(160, 120), |renderer| {
                    let expected = exact(renderer, &mut ());
                    total += light_of(&expected);
                    for quality in QUALITIES {
                        let close = realtime(renderer, quality, &mut ());
                        most = most.max(light_of(&expected).abs_diff(light_of(&close)));
                        worst = worst.min(psnr(&expected, &close));
                    }
                });
            }
            // In each frame the light is off by at most a quarter of the highlight's mean light.
            let share = f64::from(most) / (f64::from(total) / 40.0);
            assert!(
                share < 0.25 && worst > 42.0,
                "{name}, {shininess}: {share:.2} of the light, {worst:.1} dB"
            );
        }
    }
}

const SMALL: Settings = Settings { bounces: 3, ..Settings::new(61, 43) };

/// Draws some lines in a frame of their own.
fn draw_part(renderer: &Renderer<f32>, quality: Realtime, lines: Range<u32>, screen: &mut Screen) {
    let mut memory = Memory::new(renderer, quality);
    let mut frame = renderer.frame(lines, memory.lend(quality)).expect("a frame");
    while !frame.step(screen, u32::MAX).expect("a step").is_done() {}
}

const GRIDS: [Grid; 3] = [Grid::Two, Grid::Four, Grid::Eight];

#[test]
fn lines_in_any_order_are_the_same_bytes() {
    check_order(&PRISM, SMALL);
    check_order(&CLASSIC, Settings { sampling: Sampling::new(4), ..SMALL });
    // The thin parts of a mesh are searched separately.
    let arena = Bump::new();
    check_order(&gallery("show-teapot", &arena).scene, Settings::new(57, 43));
    // The shadows fall beyond the edge of a table, where they are not visible.
    let (corner, right) = (Vec3::new(-2.5, 0.0, -1.2), Vec3::new(5.0, 0.0, 0.0));
    let table = Shape::Rectangle(Rectangle::new(corner, right, Vec3::new(0.0, 0.0, 5.0)));
    for height in [0.6, 0.9, 1.2, 2.0] {
        with_low_shadows(table, height, |scene| {
            check_order(scene, SMALL);
            check_order(scene, Settings::new(120, 43));
        });
    }
}

/// Checks that pictures of 43 lines have the same bytes in any order.
fn check_order(scene: &Scene, settings: Settings) {
    let stepped = GRIDS.map(|grid| Realtime { grid, ..Realtime::new() });
    for quality in stepped.into_iter().chain(stepped.map(Realtime::smooth)) {
        let grid = quality.grid;
        with_renderer::<f32, _>(scene, settings, |renderer| {
            let expected = realtime(renderer, quality, &mut ());
            let mut screen = Screen::new(renderer);
            // 7 and 43 have no common factor.
            for i in 0..43 {
                let y = (i * 7 + 5) % 43;
                draw_part(renderer, quality, y..y + 1, &mut screen);
            }
            assert!(picture_on(&screen) == expected);
            // One frame continues with other lines. Some follow the last line, and some are left before they
            // are drawn.
            let (mut screen, mut memory) = (Screen::new(renderer), Memory::new(renderer, quality));
            let mut frame = renderer.frame(0..43, memory.lend(quality)).expect("a frame");
            for lines in [16..24, 24..40, 3..9, 40..43, 9..16, 0..3] {
                frame.set_lines(lines).expect("lines");
                while !frame.step(&mut screen, u32::MAX).expect("a step").is_done() {}
                frame.set_lines(0..19).expect("lines");
                frame.step(&mut screen, 20).expect("a step");
            }
            assert!(frame.set_lines(40..44).is_err());
            assert!(picture_on(&screen) == expected);
            for every in [2, 4] {
                let mut screen = Screen::new(renderer);
                let order = Interleave { lines: grid.pixels() as u32, every };
                for bands in (0..every).map(|frame| order.bands(43, frame)) {
                    bands.for_each(|band| draw_part(renderer, quality, band, &mut screen));
                }
                assert!(picture_on(&screen) == expected);
            }
        });
    }
}

/// A triangle with a corner at the eye was met by rays of cells that were not known to show it.
#[test]
fn lines_are_the_same_bytes_where_a_corner_is_at_the_eye() {
    fn check<R: Real>(scene: &Scene) {
        let quality = Realtime { grid: Grid::Two, threshold: 65_535, ..Realtime::new() };
        with_renderer::<R, _>(scene, Settings::new(20, 15), |renderer| {
            let expected = realtime(renderer, quality, &mut ());
            let mut screen = Screen::new(renderer);
            for top in [12, 9, 6, 3, 0] {
                let mut memory = Memory::new(renderer, quality);
                let mut frame = renderer.frame(top..top + 3, memory.lend(quality)).expect("a frame");
                while !frame.step(&mut screen, u32::MAX).expect("a step").is_done() {}
            }
            assert!(picture_on(&screen) == expected);
        });
    }
    let eye = Vec3::new(-4.0, -2.0, -4.0);
    let vertices = [eye, Vec3::new(-4.0, -1.916465, -4.0), Vec3::new(-3.5440392, -2.0, -4.2051826)];
    let objects = [Object::new(Shape::Triangle(Triangle { vertices, normals: None }), 0)];
    let mut scene = staged(&objects, eye, Vec3::new(-3.5140393, -1.96, -4.2051826), 1.4552734);
    scene.camera.up = Vec3::new(0.3, 0.5, 0.8);
    check::<f32>(&scene);
    check::<f64>(&scene);
    check::<Fixed>(&scene);
}

#[test]
fn stepping_with_any_budget_is_bounded_and_gives_the_same_bytes() {
    let quality = Realtime::new();
    with_renderer::<f32, _>(&CLASSIC, SMALL, |renderer| {
        let expected = realtime(renderer, quality, &mut ());
        for budget in [0, 1, 7, 50, 10_000] {
            let (mut screen, mut memory) = (Screen::new(renderer), Memory::new(renderer, quality));
            let mut frame = renderer.frame(0..43, memory.lend(quality)).expect("a frame");
            let mut lines = 0;
            loop {
                let progress = frame.step(&mut screen, budget).expect("a step");
                // No pixel of `classic` takes more than 40 rays.
                assert!(progress.rays < budget + 81 * 40 && progress.lines_done >= lines, "{progress:?}");
                lines = progress.lines_done;
                if progress.is_done() {
                    break;
                }
            }
            assert_eq!(lines, 43);
            assert!(picture_on(&screen) == expected);
        }
    });
}

#[test]
fn drawing_goes_on_after_a_failing_display() {
    let quality = Realtime::new();
    with_renderer::<f32, _>(&CLASSIC, SMALL, |renderer| {
        let expected = realtime(renderer, quality, &mut ());
        for failure in [0, 1, 60, 61 * 8, 61 * 9 + 3, 61 * 43 - 1] {
            // Continue in the same frame, and draw the rest of the lines in another one.
            let (mut screen, mut memory) = (Screen::new(renderer), Memory::new(renderer, quality));
            screen.pixels_until_failure = Some(failure);
            let mut frame = renderer.frame(0..43, memory.lend(quality)).expect("a frame");
            let error = loop {
                if let Err(error) = frame.step(&mut screen, 100) {
                    break error;
                }
            };
            let DrawError::Display { line, error: Unplugged } = error else { panic!("{error}") };
            assert_eq!(line, failure as u32 / 61 / 8 * 8);
            screen.pixels_until_failure = None;
            let mut other = screen.clone();
            other.pixels_until_failure = None;
            while !frame.step(&mut screen, 100).expect("a step").is_done() {}
            assert!(picture_on(&screen) == expected);
            draw_part(renderer, quality, line..43, &mut other);
            assert!(picture_on(&other) == expected);
        }
    });
}

/// A probe that counts how many times each camera ray is traced.
#[derive(Default)]
struct Directions(HashMap<[u32; 3], u32>);

impl Probe<f32> for Directions {
    fn record(&mut self, event: Event<f32>) {
        if let Event::Ray { kind: RayKind::Camera, ray, .. } = event {
            let bits = [ray.direction.x, ray.direction.y, ray.direction.z].map(f32::to_bits);
            *self.0.entry(bits).or_default() += 1;
        }
    }
}

#[test]
fn no_pixel_is_traced_more_than_twice() {
    for grid in GRIDS {
        for (width, height) in [(61, 43), (64, 48), (1, 1), (2, 9), (9, 2), (5, 8), (8, 5), (33, 1), (1, 33)]
        {
            for scene in [&CLASSIC, &PRISM] {
                // No pixels are alike, so every pixel is needed.
                for threshold in [0, 2048] {
                    let quality = Realtime { grid, threshold, ..Realtime::new() };
                    let settings = Settings { bounces: 3, ..Settings::new(width, height) };
                    with_renderer::<f32, _>(scene, settings, |renderer| {
                        let mut traced = Directions::default();
                        realtime(renderer, quality, &mut traced);
                        // A pixel is traced once to compare it with two neighbors, and once more if it is
                        // like neither.
                        let most = traced.0.values().max();
                        assert!(most <= Some(&2), "{width}×{height}, {grid:?}, {threshold}: {most:?} times");
                        // The last points of the grid may lie beyond the picture.
                        let side = grid.pixels() as u32;
                        let points = (width.next_multiple_of(side) + 1) * (height.next_multiple_of(side) + 1);
                        assert!(traced.0.len() <= points as usize);
                    });
                }
            }
        }
    }
}

#[test]
fn traced_pixels_are_those_of_the_exact_picture() {
    // If highlights may be everywhere, every pixel is traced.
    let glowing = [Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.0, 0.0, 0.0), 0.1)), 0)];
    let scene = bright(&glowing, &[GLOWING]);
    for (width, height) in [(1, 1), (1, 7), (7, 1), (13, 11), (8, 8)] {
        for grid in GRIDS {
            with_renderer::<f32, _>(&scene, Settings::new(width, height), |renderer| {
                let close = realtime(renderer, Realtime { grid, ..Realtime::new() }, &mut ());
                assert!(close == exact(renderer, &mut ()), "{width}×{height}, {grid:?}");
            });
        }
    }
}

#[test]
fn every_size_is_drawn() {
    let quality = Realtime::new();
    for (width, height) in [(1, 1), (3, 2), (65_535, 1), (65_535, 5), (1, 65_535)] {
        with_renderer::<f32, _>(
            &CLASSIC,
            Settings { bounces: 0, ..Settings::new(width, height) },
            |renderer| {
                let picture = realtime(renderer, quality, &mut ());
                assert_eq!(picture.pixels.len(), (width * height) as usize);
            },
        );
    }
}

#[test]
fn memory_that_is_too_short_and_lines_that_are_not_there_are_refused() {
    let quality = Realtime::new();
    with_renderer::<f32, _>(&CLASSIC, SMALL, |renderer| {
        let (colors, samples) = (quality.colors(61), quality.samples(61));
        assert_eq!((colors, samples), (61 * 8, 65));
        for (given, fewer) in
            [((colors - 1, samples), true), ((colors, samples - 1), false), ((colors, 0), false)]
        {
            let mut memory =
                Memory { colors: vec![Rgb888::BLACK; given.0], samples: vec![Sample::BLANK; given.1] };
            let error = renderer.frame(0..43, memory.lend(quality)).unwrap_err();
            let expected = if fewer {
                LineError::BandLength { given: given.0, needed: colors }
            } else {
                LineError::SampleCount { given: given.1, needed: samples }
            };
            assert_eq!(error, expected);
        }
        let mut memory = Memory::new(renderer, quality);
        let error = renderer.frame(40..44, memory.lend(quality)).unwrap_err();
        assert_eq!(error, LineError::NoSuchLine { line: 43, height: 43 });
    });
}

#[test]
fn several_samples_per_pixel_and_other_numbers_are_interpolated_too() {
    let settings = Settings { sampling: Sampling::new(4), bounces: 2, ..Settings::new(80, 60) };
    with_renderer::<f64, _>(&CLASSIC, settings, |renderer| {
        let mut rays = RayCounts::default();
        let close = psnr(&exact(renderer, &mut ()), &realtime(renderer, Realtime::fine(), &mut rays));
        assert!(close > 33.0 && rays.camera < 80 * 60 * 4 / 2, "{close} dB, {} rays", rays.camera);
    });
    with_renderer::<Fixed, _>(&CLASSIC, Settings { bounces: 3, ..Settings::new(320, 240) }, |renderer| {
        let mut rays = RayCounts::default();
        let close = psnr(&exact(renderer, &mut ()), &realtime(renderer, Realtime::new(), &mut rays));
        println!("classic in fixed point: {close:.1} dB, {:.3} traced", rays.camera as f64 / 76_800.0);
        assert!(close > 42.0, "{close} dB");
    });
}

#[test]
fn a_budget_of_rays_is_kept_and_quality_falls_with_it() {
    with_renderer::<f32, _>(&CLASSIC, Settings { bounces: 3, ..Settings::new(320, 240) }, |renderer| {
        let exact = exact(renderer, &mut ());
        let (mut last, mut most) = (f64::INFINITY, RayCounts::default());
        realtime(renderer, Realtime::new(), &mut most);
        for budget_rays in [u32::MAX, 60_000, 45_000, 38_000, 34_000, 25_000, 18_000] {
            let mut counts = RayCounts::default();
            let picture = realtime(renderer, Realtime { budget_rays, ..Realtime::new() }, &mut counts);
            let (rays, close) = (counts.total(), psnr(&exact, &picture));
            println!("{budget_rays} rays allowed, {rays} traced: {close:.1} dB");
            assert!(rays <= u64::from(budget_rays), "{rays} of {budget_rays}");
            // In the relevant part nearly all rays are used.
            let wanted = most.total();
            assert!(rays == wanted || rays * 10 >= u64::from(budget_rays) * 9, "{rays} of {budget_rays}");
            assert!(close <= last && close > 20.0, "{close} dB with {budget_rays} rays");
            last = close;
        }
    });
}

#[test]
fn a_budget_of_a_tenth_more_than_a_frame_wants_costs_nothing() {
    for name in ["classic", "whitted", "flake", "prism"] {
        with_scene(name, |scene, bounces| {
            for (width, height, quality) in [(320, 240, Realtime::new()), (160, 120, Realtime::fine())] {
                with_renderer::<f32, _>(
                    scene,
                    Settings { bounces, ..Settings::new(width, height) },
                    |renderer| {
                        let mut wanted = RayCounts::default();
                        let whole = realtime(renderer, quality, &mut wanted);
                        let budget_rays = (wanted.total() * 11 / 10) as u32;
                        let picture = realtime(renderer, Realtime { budget_rays, ..quality }, &mut ());
                        assert!(whole == picture, "{name}, {width}x{height}");
                    },
                );
            }
        });
    }
}

/// An earlier version used colors four pixels away beside an edge, so that a horizon became a dashed line.
#[test]
fn a_level_horizon_is_even() {
    let materials = [Material::matte(LinearRgb::gray(0.7))];
    let scene = Scene {
        camera: Camera {
            eye: Vec3::new(0.3, 4.0, 9.0),
            target: Vec3::new(0.0, 1.0, 0.0),
            up: Vec3::new(0.0, 1.0, 0.0),
            vertical_fov: 0.7,
            lens: None,
        },
        background: Background::Solid(LinearRgb::new(0.2, 0.3, 0.5)),
        objects: &[Object::new(Shape::Plane(Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0))), 0)],
        materials: &materials,
        lights: &[Light::Point { position: Vec3::new(4.0, 8.0, 5.0), color: LinearRgb::WHITE }],
        motions: &[],
    };
    with_renderer::<f32, _>(&scene, Settings::new(320, 240), |renderer| {
        let (exact, close) = (exact(renderer, &mut ()), realtime(renderer, Realtime::new(), &mut ()));
        // From the sky to the part of the floor that is not black.
        for (exact, close) in exact.pixels.chunks(320).zip(close.pixels.chunks(320)).take(40) {
            for (pair, close) in exact.windows(2).zip(close.windows(2)) {
                if pair[0] == pair[1] {
                    assert!(close[0][0].abs_diff(close[1][0]) <= 2, "{close:?} where all is {pair:?}");
                }
            }
        }
    });
}

/// Instances side by side are one object, and bricks of one color one texture. An earlier version lost the
/// edges between them.
#[test]
fn parts_of_objects_and_of_textures_are_told_apart() {
    for (name, least) in [("shape-instances", 39.0), ("texture-brick", 42.0), ("show-die", 42.0)] {
        let arena = Bump::new();
        with_renderer::<f32, _>(&gallery(name, &arena).scene, Settings::new(320, 240), |renderer| {
            let close = psnr(&exact(renderer, &mut ()), &realtime(renderer, Realtime::new(), &mut ()));
            println!("{name}: {close:.1} dB");
            assert!(close > least, "{name}: {close} dB");
        });
    }
}

/// A probe that counts the rays of a frame, and the most rays of a pixel.
#[derive(Default)]
struct Most {
    all: RayCounts,
    /// The rays before the current pixel. `most` is the largest number of rays of a pixel.
    before: u64,
    most: u64,
}

impl<R: Real> Probe<R> for Most {
    fn record(&mut self, event: Event<R>) {
        if let Event::Ray { kind: RayKind::Camera, .. } = event {
            self.before = self.all.total();
        }
        self.all.record(event);
        self.most = self.most.max(self.all.total() - self.before);
    }
}

#[test]
fn no_frame_takes_more_rays_than_it_may_but_for_one_pixel() {
    for (name, least) in [("classic", [22.0; 3]), ("flake", [22.0; 3]), ("prism", [22.0, 24.0, 24.0])] {
        with_scene(name, |scene, bounces| {
            with_renderer::<f32, _>(scene, Settings { bounces, ..Settings::new(160, 120) }, |renderer| {
                let exact = exact(renderer, &mut ());
                for (grid, least) in GRIDS.into_iter().zip(least) {
                    let quality = Realtime { grid, ..Realtime::fine() };
                    let mut wanted = RayCounts::default();
                    realtime(renderer, quality, &mut wanted);
                    let wanted = wanted.total();
                    for percent in [0, 1, 3, 10, 25, 50, 70, 85, 95, 100] {
                        let budget_rays = (wanted * percent / 100) as u32;
                        let mut probe = Most::default();
                        let picture = realtime(renderer, Realtime { budget_rays, ..quality }, &mut probe);
                        let (rays, most) = (probe.all.total(), probe.most);
                        let close = psnr(&exact, &picture);
                        println!(
                            "{name}, {grid:?}: {budget_rays} rays allowed, {rays} traced: {close:.1} dB"
                        );
                        assert!(
                            rays <= u64::from(budget_rays) + most,
                            "{rays} of {budget_rays}, {most} for one"
                        );

                        assert!(percent < 50 || close > least, "{close} dB");
                    }
                }
            });
        });
    }
}

#[test]
fn patterns_draw_every_pixel_once() {
    for pattern in [Pattern::Checkerboard, Pattern::Square] {
        with_renderer::<f32, _>(&CLASSIC, SMALL, |renderer| {
            let mut screen = Screen::new(renderer);
            for frame in 0..pattern.frames() {
                // The screen accepts a pixel that is drawn twice, so count the pixels.
                let drawn = (0..43u16)
                    .flat_map(|y| (0..61u16).map(move |x| (x, y)))
                    .filter(|(x, y)| pattern.draws(*x, *y, frame))
                    .count();
                assert!(drawn.abs_diff(61 * 43 / pattern.frames() as usize) <= 61, "{drawn} pixels");
                renderer.draw_pattern(pattern, frame, &mut screen).expect("a frame");
            }
            assert!(picture_on(&screen) == exact(renderer, &mut ()), "{pattern:?}");
        });
    }
}

#[test]
fn lines_that_are_told_unchanged_are() {
    // Seen from a moving camera, and from above, where the horizon is outside of the picture.
    let mut skipped = 0;
    for (from, to) in [((0.0, 0.0), (0.5, 0.0)), ((0.0, 0.0), (0.0, 0.4)), ((0.0, 9.0), (0.0, 9.2))] {
        let scene = |(x, y): (f32, f32)| {
            let eye = Vec3::new(x, y, 0.0);
            Scene { camera: Camera { eye, ..CLASSIC.camera }, ..CLASSIC }
        };
        let settings = Settings { bounces: 2, ..Settings::new(160, 120) };
        with_renderer::<f32, _>(&scene(from), settings, |before| {
            let first = exact(before, &mut ());
            assert!((0..120).all(|y| before.is_unchanged(before, y)) && !before.is_unchanged(before, 120));
            with_renderer::<f32, _>(&scene(to), settings, |now| {
                let second = exact(now, &mut ());
                for y in (0..120).filter(|y| now.is_unchanged(before, *y)) {
                    let line = y as usize * 160..(y as usize + 1) * 160;
                    assert!(first.pixels[line.clone()] == second.pixels[line], "line {y}");
                    skipped += 1;
                }
            });
            let other = Settings { transfer: rayline::Transfer::Linear, ..settings };
            with_renderer::<f32, _>(&scene(from), other, |now| {
                assert!((0..120).all(|y| !now.is_unchanged(before, y)));
            });
        });
    }
    assert!(skipped > 60, "{skipped} lines");
}

/// The largest difference of two pixels in a channel.
fn off(a: &[u8; 3], b: &[u8; 3]) -> u8 {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap()
}

/// Compares a scene with a second one without some objects. Returns the number of pixels that these objects
/// change, how many of them are off by more than half of that change, and the share of pixels that are
/// traced.
fn lost<R: Real>(
    with: &Scene,
    without: &Scene,
    settings: Settings,
    quality: Realtime,
) -> (usize, usize, f64) {
    let draw = |scene: &Scene| with_renderer::<R, _>(scene, settings, |renderer| exact(renderer, &mut ()));
    let (there, plain) = (draw(with), draw(without));
    let mut rays = RayCounts::default();
    let close = with_renderer::<R, _>(with, settings, |renderer| realtime(renderer, quality, &mut rays));
    let (mut all, mut lost) = (0, 0);
    for ((there, plain), close) in there.pixels.iter().zip(&plain.pixels).zip(&close.pixels) {
        if off(there, plain) > 24 {
            all += 1;
            lost += usize::from(off(there, close) > off(there, plain) / 2);
        }
    }
    (all, lost, rays.camera as f64 / there.pixels.len() as f64)
}

/// The results of `lost` for a frame; every third frame is drawn in fixed point.
fn lost_in(
    frame: usize,
    with: &Scene,
    without: &Scene,
    settings: Settings,
    quality: Realtime,
) -> (usize, usize, f64) {
    if frame.is_multiple_of(3) {
        lost::<Fixed>(with, without, settings, quality)
    } else {
        lost::<f32>(with, without, settings, quality)
    }
}

#[test]
fn shadows_and_mirrored_pictures_of_what_is_thin_are_shown() {
    let pole = |x: f32, z: f32, radius: f32| {
        let (base, top) = (Vec3::new(x, 0.0, z), Vec3::new(x, 3.0, z));
        Object::new(Shape::Cylinder(Cylinder { base, top, radius, capped: true }), 2)
    };
    let floor = Object::new(FLOOR, 0);
    let wall = Object::new(
        Shape::Rectangle(Rectangle::new(Vec3::new(-3.0, 0.0, -3.0), Vec3::new(6.0, 0.0, 0.0), UP * 4.0)),
        1,
    );
    let middle = UP * 1.5;
    let ball = Object::new(Shape::Sphere(Sphere::new(middle, 1.5)), 0);
    let mirror = Object::new(Shape::Sphere(Sphere::new(middle, 1.5)), 1);
    let egg = Object::new(Shape::Ellipsoid(Ellipsoid::new(middle, Vec3::new(1.8, 1.2, 1.0))), 1);
    let column = Cylinder { base: Vec3::ZERO, top: UP * 3.0, radius: 1.2, capped: true };
    let column = Object::new(Shape::Cylinder(column), 1);
    let axis = Vec3::new(0.1, 0.3, 1.0);
    let ring =
        Object::new(Shape::Torus(Torus { center: middle, axis, major_radius: 1.2, minor_radius: 0.5 }), 1);
    let tower = Cone { base: Vec3::ZERO, base_radius: 1.6, top: UP * 3.0, top_radius: 0.6, capped: true };
    let tower = Object::new(Shape::Cone(tower), 1);
    for (name, objects) in [
        ("floor", vec![floor]),
        ("wall", vec![floor, wall]),
        ("ball", vec![floor, ball]),
        ("mirror", vec![floor, mirror]),
        ("egg", vec![floor, egg]),
        ("column", vec![floor, column]),
        ("ring", vec![floor, ring]),
        ("tower", vec![floor, tower]),
    ] {
        for radius in [0.02, 0.04, 0.08] {
            let poles = [pole(-1.7, 1.2, radius), pole(2.1, 1.0, radius), pole(-0.6, 2.4, radius)];
            let all = [&objects[..], &poles].concat();
            for quality in QUALITIES {
                let (mut sum, mut gone, mut most, mut traced) = (0, 0, 0, 0.0);
                for frame in 0..12 {
                    let angle = frame as f32 * 0.1 - 0.6;
                    let eye = Vec3::new(10.0 * angle.sin(), 4.0, 10.0 * angle.cos());
                    let plain = staged(&objects, eye, UP, 0.7);
                    let settings = Settings { bounces: 2, ..Settings::new(160, 120) };
                    let with = Scene { objects: &all, ..plain };
                    let (there, lost, share) = lost_in(frame, &with, &plain, settings, quality);
                    (sum, gone, most, traced) =
                        (sum + there, gone + lost, most.max(lost), traced + share / 12.0);
                }
                let what =
                    format!("{name}, {radius}, {:?}: {gone} of {sum} lost, {traced} traced", quality.grid);
                assert!(sum > 1900 && gone <= 2 && most <= 1, "{what}");
                assert!(traced < 0.33, "{what}");
            }
        }
    }
}

/// Tips of shapes that are wide elsewhere. Corners of 53° and more still lose pixels, so they are below the
/// floor.
#[test]
fn tips_and_their_shadows_are_shown_in_every_frame() {
    for half_angle in [10f32, 18.0, 25.0] {
        let slope = half_angle.to_radians().tan();
        let (base, top) = (Vec3::new(-1.9, 0.0, 0.8), Vec3::new(-1.9, 1.6, 0.8));
        let cone = Cone { base, base_radius: 1.6 * slope, top, top_radius: 0.0, capped: true };
        let below = |aside: f32| Vec3::new(2.0 + aside * 2.0 * slope, -0.5, -0.4);
        let triangle = Triangle::flat(Vec3::new(2.0, 1.5, -0.4), below(-1.0), below(1.0));
        // The vertices alternate between the outer and the inner radius.
        let eighteen = core::f32::consts::PI / 10.0;
        let inner = slope / ((2.0 * eighteen).sin() + slope * (2.0 * eighteen).cos());
        let star: [Vec3; 10] = core::array::from_fn(|i| {
            let (sine, cosine) = (eighteen * (2.0 * i as f32 + 0.3)).sin_cos();
            let radius = if i % 2 == 0 { 1.1 } else { 1.1 * inner };
            Vec3::new(radius * sine, 1.3 + radius * cosine, 0.2 * radius * sine)
        });
        let floor = Object::new(FLOOR, 0);
        let shapes = [Shape::Cone(cone), Shape::Triangle(triangle), Shape::Polygon(Polygon::new(&star))];
        let all = [&[floor], &shapes.map(|shape| Object::new(shape, 2))[..]].concat();
        for (width, quality) in [(320, QUALITIES[0]), (160, QUALITIES[0]), (160, QUALITIES[1])] {
            let (mut sum, mut gone, mut most, mut traced) = (0, 0, 0, 0.0);
            for frame in 0..24 {
                let angle = frame as f32 * 0.05 - 0.6;
                let eye = Vec3::new(8.0 * angle.sin(), 4.0, 8.0 * angle.cos());
                let with = staged(&all, eye, UP * 0.7, 0.6);
                let plain = Scene { objects: &all[..1], ..with };
                let settings = Settings::new(width, width * 3 / 4);
                let (there, lost, share) = lost_in(frame, &with, &plain, settings, quality);
                (sum, gone, most) = (sum + there, gone + lost, most.max(lost));
                traced += share / 24.0;
            }
            // There are seven tips and seven shadows; of each, three pixels are no wider than one.
            let what =
                format!("{half_angle}°, {width}, {:?}: {gone} of {sum} lost, {most} at most", quality.grid);
            assert!(sum > 20_000 && gone <= 24 * 42 && most <= 90, "{what}");
            assert!(traced < 0.13, "{what}, {traced} traced");
        }
    }
}

/// Adds a box to a mesh: its corners, and two triangles for each side.
fn slab(from: Vec3, to: Vec3, vertices: &mut Vec<Vec3>, triangles: &mut Vec<[u16; 3]>) {
    let first = vertices.len() as u16;
    let either = |bit: u16, low: f32, high: f32| if bit == 0 { low } else { high };
    vertices.extend((0..8).map(|corner| {
        Vec3::new(
            either(corner & 1, from.x, to.x),
            either(corner & 2, from.y, to.y),
            either(corner & 4, from.z, to.z),
        )
    }));
    for [a, b, c, d] in [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]] {
        triangles.extend([[a, b, c], [a, c, d]].map(|corners| corners.map(|corner| first + corner)));
    }
}

/// Thin parts of a large mesh: a fence of flat triangles, and two instances of it.
#[test]
fn thin_parts_of_meshes_are_shown() {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    let (left, right) = (Vec3::new(-1.5, 0.0, 0.0), Vec3::new(1.5, 0.3, 0.3));
    slab(left, right, &mut vertices, &mut triangles);
    let foot = (vertices.len(), triangles.len());
    for i in 0..5u8 {
        let slat = left + Vec3::new(0.3 + 0.6 * f32::from(i), 0.3, 0.1);
        slab(slat, slat + Vec3::new(0.06, 1.5, 0.06), &mut vertices, &mut triangles);
    }
    let whole = Mesh::new(&vertices, &triangles);
    let plain = Mesh { vertices: &vertices[..foot.0], triangles: &triangles[..foot.1], ..whole };
    let poses = [-0.8f32, 0.9].map(|z| Pose::at(Vec3::new(0.0, 0.0, z)));
    for is_model in [false, true] {
        for quality in QUALITIES {
            let (mut sum, mut gone, mut most, mut traced) = (0, 0, 0, 0.0);
            for frame in 0..12 {
                let angle = frame as f32 * 0.1 - 0.6;
                let eye = Vec3::new(9.0 * angle.sin(), 4.0, 9.0 * angle.cos());
                let models = [whole, plain].map(Model::Mesh);
                let objects = [0, 1].map(|i| {
                    let shape = if is_model {
                        Shape::Instances(Instances::new(&models[i], &poses))
                    } else {
                        Shape::Mesh([whole, plain][i])
                    };
                    [Object::new(FLOOR, 0), Object::new(shape, 2)]
                });
                let [with, plain] = [0, 1].map(|i| staged(&objects[i], eye, UP * 0.8, 0.6));
                let (there, lost, share) = lost_in(frame, &with, &plain, Settings::new(160, 120), quality);
                (sum, gone, most, traced) = (sum + there, gone + lost, most.max(lost), traced + share / 12.0);
            }
            let what = format!(
                "{is_model}, {:?}: {gone} of {sum} lost, {most} at most, {traced} traced",
                quality.grid
            );
            // The slats are a pixel wide, and their shadows half as wide.
            let (few, one) = if quality.grid == Grid::Eight { (9, 85) } else { (20, 40) };
            assert!(sum > 3000 && gone * few < sum && most <= one && traced < 0.17, "{what}");
        }
    }
}

/// The teapot's handle and its spout are thinner than a cell, and so are their shadows.
#[test]
fn a_teapot_is_shown_whole_in_every_frame() {
    let arena = Bump::new();
    let teapot = gallery("show-teapot", &arena).scene;
    for (quality, most, few) in [(QUALITIES[0], 22, 260), (QUALITIES[1], 12, 140)] {
        let pixels_off = |there: &Picture, close: &Picture| {
            there.pixels.iter().zip(&close.pixels).filter(|(a, b)| off(a, b) > 48).count()
        };
        let frames = of_rotation(&teapot, 8.0, Settings::new(160, 120), quality, pixels_off);
        let (sum, worst) = frames.fold((0, 0), |(sum, worst), off| (sum + off, worst.max(off)));
        let what = format!("{:?}: {sum} pixels are off, {worst} at most", quality.grid);
        assert!(worst <= most && sum <= few, "{what}");
    }
}

/// In scenes of more than 32 objects, the hierarchy finds these beside sticks.
#[test]
fn shadows_and_mirrored_pictures_of_a_fence_are_shown() {
    let floor = Object::new(FLOOR, 0);
    let wall = Rectangle::new(Vec3::new(-4.0, 0.0, -3.0), Vec3::new(8.0, 0.0, 0.0), UP * 3.5);
    let wall = Object::new(Shape::Rectangle(wall), 1);
    let poles = (0..40).map(|i| {
        let base = Vec3::new(i as f32 * 0.15 - 3.0, 0.0, 1.2 + 0.8 * (i as f32).sin());
        let pole = Cylinder { base, top: base + UP * 1.5, radius: 0.03, capped: true };
        Object::new(Shape::Cylinder(pole), 2)
    });
    let objects: Vec<_> = [floor, wall].into_iter().chain(poles).collect();
    for quality in QUALITIES {
        let (mut sum, mut gone) = (0, 0);
        for frame in 0..6 {
            let angle = frame as f32 * 0.2 - 0.6;
            let eye = Vec3::new(9.0 * angle.sin(), 4.0, 9.0 * angle.cos());
            let with = staged(&objects, eye, UP * 0.6, 0.7);
            let plain = Scene { objects: &objects[..2], ..with };
            let settings = Settings { bounces: 2, ..Settings::new(160, 120) };
            let (there, lost, traced) = lost_in(frame, &with, &plain, settings, quality);
            (sum, gone) = (sum + there, gone + lost);
            assert!(traced < 0.6, "{traced} traced");
        }
        assert!(sum > 10_000 && gone <= 2, "{:?}: {gone} of {sum} lost", quality.grid);
    }
}

#[test]
fn thin_objects_are_shown_whole_with_several_samples() {
    let settings = Settings { sampling: Sampling::new(4), ..Settings::new(160, 120) };
    let bead = Object::new(Shape::Sphere(Sphere::new(Vec3::new(-4.0, 3.0, 0.0), 0.1)), 0);
    for angle in [0.1f32, 0.8, 1.4, 2.3] {
        let along = Vec3::new(3.5 * angle.cos(), 3.5 * angle.sin(), 0.0);
        let needle = Cylinder { base: -along, top: along, radius: 0.06, capped: true };
        let objects = [Object::new(Shape::Cylinder(needle), 0), bead];
        let scene = bright(&objects, &[GLOWING]);
        let plain = bright(&[], &[GLOWING]);
        for quality in QUALITIES {
            let (there, lost, traced) = lost::<f32>(&scene, &plain, settings, quality);
            // Every sample is counted.
            assert!(there > 100 && lost == 0 && traced < 4.0 * 0.4, "{lost} of {there}, {traced} traced");
        }
    }
}

/// A scene of more than 32 objects has no sets. Narrow objects are found by the hierarchy, or one after the
/// other.
#[test]
fn narrow_objects_among_many_are_shown_whole() {
    fn check<R: Real>(scene: &Scene) {
        let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
        let prepared = PreparedScene::<R>::new(scene, &mut memory).expect("a legal scene");
        for prepared in [prepared.without_acceleration(), prepared] {
            let renderer = Renderer::new(&prepared, Settings::new(160, 120)).expect("legal settings");
            let exact = exact(&renderer, &mut ());
            for quality in QUALITIES {
                let mut rays = RayCounts::default();
                assert!(realtime(&renderer, quality, &mut rays) == exact, "{quality:?}");
                assert!(rays.camera < 160 * 120 / 2, "{} pixels", rays.camera);
            }
        }
    }
    for angle in [0.0f32, 0.3, 0.7, 1.2, 1.5] {
        // Slanted bars, and beads on a line beside them.
        let (along, across) =
            (Vec3::new(angle.cos(), angle.sin(), 0.1), Vec3::new(-angle.sin(), angle.cos(), 0.0));
        let objects: Vec<_> = (0..40)
            .map(|i| {
                let place = across * ((i % 20) as f32 * 0.1 - 1.0);
                Object::new(
                    if i < 20 {
                        let (base, top) = (place - along * 3.0, place + along);
                        Shape::Cylinder(Cylinder { base, top, radius: 0.02, capped: true })
                    } else {
                        Shape::Sphere(Sphere::new(place + along * 2.0, 0.02))
                    },
                    0,
                )
            })
            .collect();
        let scene = bright(&objects, &[GLOWING]);
        check::<f32>(&scene);
        check::<Fixed>(&scene);
    }
}
