//! Tests of looks: contours, toon tones, Gooch's tones.

use std::collections::BTreeSet;
use std::mem::MaybeUninit;

use bumpalo::Bump;
use embedded_graphics::Drawable;
use embedded_graphics::geometry::Point;
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayline::builtin::{CLASSIC, FLAKE, PRISM, WHITTED};
use rayline::math::Fixed;
use rayline::shape::{Cuboid, Mesh, Plane, Shape, Sphere};
use rayline::{
    Background, Camera, Contours, Event, Gooch, Integrator, Light, LinearRgb, Look, Material, Object, Optics,
    Pattern, PixelSum, PreparedScene, Probe, Real, Realtime, Renderer, Sample, Sampling, Scene, Settings,
    SettingsError, Texture, Tones, Transfer, Vec3,
};
use rayline_simulator::{LoadedScene, Number, SceneFile};
use rayline_tests::Screen;

use super::realtime::with_renderer;

const WIDTH: usize = 61;
const HEIGHT: usize = 43;

/// A color that no scene has.
const INK: LinearRgb = LinearRgb::new(1.0, 0.0, 1.0);
const CONTOURS: Contours = Contours { ink: INK, ..Contours::NEW };
const LINES: Look = Look { tones: Tones::Light, contours: Some(CONTOURS) };
const TOON: Look = Look { tones: Tones::Toon { steps: 4 }, contours: None };
const GOOCH: Look = Look { tones: Tones::Gooch(Gooch::NEW), contours: None };
const ALL: [Look; 5] = [
    LINES,
    TOON,
    GOOCH,
    Look { contours: Some(CONTOURS), ..TOON },
    Look { contours: Some(CONTOURS), ..GOOCH },
];

fn settings(look: Look) -> Settings {
    Settings { bounces: 3, look, ..Settings::new(WIDTH as u32, HEIGHT as u32) }
}

/// The whole picture, in groups of this many lines.
fn lines<R: Real>(renderer: &Renderer<R>, at_once: usize) -> Vec<Rgb888> {
    let mut pixels = vec![Rgb888::BLACK; (renderer.width() * renderer.height()) as usize];
    let width = renderer.width() as usize;
    for (y, lines) in pixels.chunks_mut(width * at_once).enumerate() {
        renderer.lines((y * at_once) as u32, lines, &mut ()).expect("lines");
    }
    pixels
}

fn picture<R: Real>(scene: &Scene, settings: Settings) -> Vec<Rgb888> {
    with_renderer::<R, _>(scene, settings, |renderer| lines(renderer, 1))
}

fn realtime<R: Real>(renderer: &Renderer<R>, quality: Realtime, parts: &[u32]) -> Vec<Rgb888> {
    let mut screen = Screen::new(renderer);
    let width = renderer.width() as u16;
    let mut colors = vec![Rgb888::BLACK; quality.colors(width)];
    let mut samples = vec![Sample::BLANK; quality.samples(width)];
    for part in parts.windows(2).rev() {
        let lent = quality.lend(&mut colors, &mut samples);
        renderer.frame(part[0]..part[1], lent).expect("lines").draw(&mut screen).expect("drawn");
    }
    screen.picture()
}

fn is_ink(color: &Rgb888) -> bool {
    (color.r(), color.g(), color.b()) == (255, 0, 255)
}

/// The places of a picture's ink.
fn ink(picture: &[Rgb888], width: usize) -> BTreeSet<(usize, usize)> {
    (0..picture.len()).filter(|at| is_ink(&picture[*at])).map(|at| (at % width, at / width)).collect()
}

/// Lines in any order, alone or several at once, single pixels, passes and images have the same bytes.
fn assert_same_bytes<R: Real>(scene: &Scene, settings: Settings) {
    with_renderer::<R, _>(scene, settings, |renderer| {
        let expected = lines(renderer, 1);
        for at_once in [2, 4, 7, HEIGHT] {
            assert!(lines(renderer, at_once) == expected, "{at_once} lines, {settings:?}");
        }
        let mut screen = Screen::new(renderer);
        Image::new(&renderer.image(), Point::zero()).draw(&mut screen).expect("drawn");
        assert!(screen.picture() == expected, "an image, {settings:?}");
        let mut screen = Screen::new(renderer);
        for frame in 0..4 {
            renderer.draw_pattern(Pattern::Square, frame, &mut screen).expect("drawn");
        }
        assert!(screen.picture() == expected, "a pattern, {settings:?}");
        for (at, expected) in expected.iter().enumerate().step_by(5) {
            let mut sum = PixelSum::EMPTY;
            let (x, y) = ((at % WIDTH) as u16, (at / WIDTH) as u16);
            let mut color = Rgb888::BLACK;
            while !sum.is_complete() {
                color = renderer.refine(x, y, &mut sum, &mut ());
            }
            assert_eq!(color, *expected, "pixel {x},{y}, {settings:?}");
        }
    });
}

#[test]
fn looks_have_the_same_bytes_in_any_order() {
    for look in ALL {
        assert_same_bytes::<f32>(&CLASSIC, settings(look));
        assert_same_bytes::<Fixed>(&CLASSIC, settings(look));
        // Groups of pixels, and a mesh of glass.
        assert_same_bytes::<f32>(&FLAKE, settings(look));
        assert_same_bytes::<Fixed>(&PRISM, settings(look));
        let samples = Settings { sampling: Sampling::new(3), ..settings(look) };
        assert_same_bytes::<f32>(&PRISM, samples);
        assert_same_bytes::<f32>(&FLAKE, samples);
    }
}

#[test]
fn realtime_quality_has_the_same_bytes_in_any_order() {
    for look in ALL {
        for scene in [&CLASSIC, &FLAKE] {
            with_renderer::<f32, _>(scene, settings(look), |renderer| {
                for quality in [Realtime::new(), Realtime::fine(), Realtime::new().smooth()] {
                    let expected = realtime(renderer, quality, &[0, 43]);
                    assert!(realtime(renderer, quality, &[0, 3, 16, 29, 43]) == expected, "{look:?}");
                }
            });
        }
    }
}

/// Realtime quality loses few of the lines of exact quality. In `WHITTED`, the large ball and the sky had the
/// same digest of 7 bits, and the ball no line.
#[test]
fn realtime_quality_keeps_contours() {
    for (name, scene) in [("classic", &CLASSIC), ("flake", &FLAKE), ("prism", &PRISM), ("whitted", &WHITTED)]
    {
        let settings = Settings { bounces: 3, look: LINES, ..Settings::new(160, 120) };
        with_renderer::<f32, _>(scene, settings, |renderer| {
            let exact = ink(&lines(renderer, 4), 160);
            let drawn = ink(&realtime(renderer, Realtime::fine(), &[0, 120]), 160);
            let (lost, new) = (exact.difference(&drawn).count(), drawn.difference(&exact).count());
            println!("{name}: {} pixels of ink, {lost} lost", exact.len());
            assert!(exact.len() > 200, "{name}: {} pixels of ink", exact.len());
            assert!(lost * 50 <= exact.len(), "{name}: {lost} of {} pixels of ink are lost", exact.len());
            assert_eq!(new, 0, "{name}");
        });
    }
}

/// A camera at (0, 0, 5) that sees two units up and down at the origin.
fn camera() -> Camera {
    let fov = 2.0 * (2.0f32 / 5.0).atan();
    Camera {
        eye: Vec3::new(0.0, 0.0, 5.0),
        target: Vec3::ZERO,
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: fov,
        lens: None,
    }
}

fn scene<'a>(
    objects: &'a [Object<Shape<'a>>],
    materials: &'a [Material<'a>],
    lights: &'a [Light],
) -> Scene<'a> {
    Scene { camera: camera(), background: Background::BLACK, objects, materials, lights, motions: &[] }
}

const WHITE: [Material; 1] = [Material::matte(LinearRgb::WHITE)];

/// The outline of a ball is a circle of known radius; its line is one pixel wide and has no gap.
#[test]
fn the_contour_of_a_ball_is_a_circle() {
    fn check<R: Real>() {
        let objects = [Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), 0)];
        let side = 101usize;
        let settings = Settings { look: LINES, ..Settings::new(side as u32, side as u32) };
        let ink = ink(&picture::<R>(&scene(&objects, &WHITE, &[]), settings), side);
        // The tangent of the ball's angular radius over that of half the picture.
        let radius = (1.0 / 24.0f64.sqrt()) / 0.4 * side as f64 / 2.0;
        let middle = side as f64 / 2.0;
        for (x, y) in &ink {
            let distance = (*x as f64 + 0.5 - middle).hypot(*y as f64 + 0.5 - middle);
            assert!(
                (distance - radius).abs() <= 1.0,
                "({x}, {y}) is {distance} from the middle, not {radius}"
            );
        }
        for degree in 0..360 {
            let (sine, cosine) = f64::from(degree).to_radians().sin_cos();
            let (x, y) = (middle + radius * cosine, middle + radius * sine);
            let near = |(a, b): &&(usize, usize)| (*a as f64 + 0.5 - x).hypot(*b as f64 + 0.5 - y) <= 1.5;
            assert!(ink.iter().any(|place| near(&place)), "no ink at {degree} degrees");
        }
        // A circle takes 4 √2 r pixels if pixels touch at corners, and 8 r if they touch at sides.
        assert!((ink.len() as f64) < 8.0 * radius + 8.0, "{} pixels", ink.len());
    }
    check::<f32>();
    check::<f64>();
    check::<Fixed>();
}

/// The number of pixels with ink that have ink or end at the border of the object on no side: lines inside.
fn ink_of<R: Real>(object: Shape, eye: Vec3, contours: Contours) -> BTreeSet<(usize, usize)> {
    let objects = [Object::new(object, 0)];
    let mut scene = scene(&objects, &WHITE, &[]);
    scene.camera.eye = eye;
    let look = Look { tones: Tones::Light, contours: Some(contours) };
    ink(&picture::<R>(&scene, Settings { look, ..Settings::new(120, 120) }), 120)
}

/// The edges of a box have lines, which a larger angle of creases removes; a slanted face has none inside.
#[test]
fn edges_of_a_box_are_creases() {
    fn check<R: Real>() {
        let block = || Shape::Cuboid(Cuboid::aligned(Vec3::new(-0.9, -0.9, -0.9), Vec3::new(0.9, 0.9, 0.9)));
        let eye = Vec3::new(3.0, 2.5, 3.5);
        let all = ink_of::<R>(block(), eye, CONTOURS);
        let outline =
            ink_of::<R>(block(), eye, Contours { crease: core::f32::consts::PI, depth: 1.0, ..CONTOURS });
        // From a corner, three edges inside: more than twice the length of a side of about 30 pixels.
        let inside = all.difference(&outline).count();
        assert!(outline.is_subset(&all) && inside > 60 && inside < 200, "{inside} of {}", all.len());
        // A wide plate, seen at an angle of three degrees: its face is no step.
        let plate = Shape::Cuboid(Cuboid::aligned(Vec3::new(-3.0, -0.2, -3.0), Vec3::new(3.0, 0.0, 3.0)));
        let ink = ink_of::<R>(plate, Vec3::new(0.0, 0.25, 5.0), CONTOURS);
        let rows: BTreeSet<usize> = ink.iter().filter(|(x, _)| *x == 60).map(|(_, y)| *y).collect();
        // The far edge, the near edge above the front, and below it.
        assert!((2..=4).contains(&rows.len()), "{rows:?}");
    }
    check::<f32>();
    check::<Fixed>();
}

/// Two sheets of one mesh, one behind the other: a step in depth. Triangles of one sheet have no line between
/// them.
#[test]
fn steps_within_a_mesh_have_lines() {
    let sheet = |left: f32, right: f32, depth: f32| {
        [(left, -1.0), (right, -1.0), (right, 1.0), (left, 1.0)].map(|(x, y)| Vec3::new(x, y, depth))
    };
    let vertices = [sheet(-1.5, 0.0, 0.0), sheet(0.0, 1.5, -0.5)].concat();
    let triangles = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
    let mesh = || Shape::Mesh(Mesh::new(&vertices, &triangles));
    let eye = Vec3::new(0.0, 0.0, 5.0);
    let inside = |contours| {
        let ink = ink_of::<f32>(mesh(), eye, contours);
        ink.into_iter().filter(|(x, y)| (35..85).contains(x) && (45..75).contains(y)).collect::<Vec<_>>()
    };
    let step = inside(CONTOURS);
    assert_eq!(step.len(), 30, "{step:?}");
    assert!(step.iter().all(|(x, _)| *x == step[0].0 && x.abs_diff(60) <= 1), "{step:?}");
    // A step of a tenth of the distance.
    assert_eq!(inside(Contours { depth: 0.2, ..CONTOURS }), []);
}

/// Checkers, shadows and mirror images have no lines.
#[test]
fn only_what_the_eye_sees_has_contours() {
    let floor = Shape::Plane(Plane::new(Vec3::new(0.0, -0.5, 0.0), Vec3::new(0.0, 1.0, 0.0)));
    let above = Shape::Sphere(Sphere::new(Vec3::new(0.0, 9.0, 0.0), 2.0));
    let checker = Texture::Checker(rayline::Checker {
        even: LinearRgb::WHITE,
        odd: LinearRgb::gray(0.2),
        cells_per_unit: Vec3::new(1.0, 0.0, 1.0),
    });
    let material = Material { color: checker, reflectance: 0.4, ..WHITE[0] };
    let objects = [Object::new(floor, 0), Object::new(above, 0)];
    let materials = [material];
    let lights = [Light::Point { position: Vec3::new(0.0, 20.0, 0.0), color: LinearRgb::WHITE }];
    let mut scene = scene(&objects, &materials, &lights);
    scene.camera.target = Vec3::new(0.0, -2.0, 0.0);
    assert_eq!(ink(&picture::<f32>(&scene, settings(LINES)), WIDTH).len(), 0);
}

#[test]
fn toon_pictures_have_few_tones() {
    for steps in [2, 3, 6] {
        let look = Look { tones: Tones::Toon { steps }, contours: None };
        let objects = [Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.5)), 0)];
        let lights = [Light::Point { position: Vec3::new(3.0, 4.0, 5.0), color: LinearRgb::WHITE }];
        let scene = scene(&objects, &WHITE, &lights);
        let settings = Settings { look, transfer: Transfer::Linear, ..settings(look) };
        let tones: BTreeSet<u8> = picture::<f32>(&scene, settings).iter().map(RgbColor::r).collect();
        let last = f32::from(steps - 1);
        let expected = (0..steps).map(|step| ((f32::from(step) / last).powi(2) * 255.0).round() as u8);
        assert!(tones == expected.collect(), "{tones:?}");
    }
}

/// The tones of a ball toward its lamp, beside it and behind: by the formula. There are no shadows.
#[test]
fn goochs_tones_are_those_of_the_formula() {
    fn check<R: Real>(bound: f32) {
        let color = LinearRgb::new(0.5, 0.25, 1.0);
        let gooch = Gooch { blue: 0.3, yellow: 0.2, cool: 0.1, warm: 0.6 };
        let look = Look { tones: Tones::Gooch(gooch), contours: None };
        let materials = [Material { ambient: 0.25, diffuse: 0.5, ..Material::matte(color) }];
        let ball = |center, radius| Object::new(Shape::Sphere(Sphere::new(center, radius)), 0);
        // The second ball stands before the lamp.
        let objects = [ball(Vec3::ZERO, 1.0), ball(Vec3::new(0.0, 0.0, 30.0), 1.0)];
        let toward = [(0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0), (0.6, 0.0, 0.8)];
        for (x, y, z) in toward {
            let direction = -Vec3::new(x, y, z);
            let lights = [Light::Directional { direction, color: LinearRgb::WHITE }];
            let scene = scene(&objects, &materials, &lights);
            let settings = Settings { look, ..Settings::new(101, 101) };
            let seen = with_renderer::<R, _>(&scene, settings, |renderer| {
                let (light, rays) = renderer.pixel(50, 50, &mut ());
                assert_eq!(rays, 1, "no shadow rays");
                light.to_f32()
            });
            // The middle of the ball has the normal (0, 0, 1).
            let warmth = (1.0 + z) / 2.0;
            let [r, g, b] = color.channels();
            let tone = |cool: f32, warm: f32| 0.75 * (warmth * warm + (1.0 - warmth) * cool);
            let expected =
                [tone(0.1 * r, 0.2 + 0.6 * r), tone(0.1 * g, 0.2 + 0.6 * g), tone(0.3 + 0.1 * b, 0.6 * b)];
            for (seen, expected) in seen.channels().into_iter().zip(expected) {
                assert!((seen - expected).abs() < bound, "{z}: {seen}, not {expected}");
            }
        }
    }
    check::<f32>(1e-3);
    check::<Fixed>(2e-3);
}

/// The event of a highlight on colored metal reports the light that the pixel gets, with the metal's color.
#[test]
fn events_of_goochs_highlights_have_the_color_of_metal() {
    struct Shown(LinearRgb);

    impl Probe<f32> for Shown {
        fn record(&mut self, event: Event<f32>) {
            if let Event::Surface { shown } | Event::Light { shown, .. } = event {
                self.0 = self.0 + shown;
            }
        }
    }

    let optics = Optics { reflection_color: LinearRgb::new(1.0, 0.5, 0.25), ..Optics::PLAIN };
    let metal = Material { specular: 0.5, shininess: 20.0, optics: Some(&optics), ..WHITE[0] };
    let objects = [Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), 0)];
    let direction = Vec3::new(0.0, 0.0, -1.0);
    let lights = [Light::Directional { direction, color: LinearRgb::WHITE }];
    let materials = [metal];
    let scene = scene(&objects, &materials, &lights);
    with_renderer::<f32, _>(&scene, Settings { look: GOOCH, ..Settings::new(101, 101) }, |renderer| {
        let mut shown = Shown(LinearRgb::BLACK);
        let (light, _) = renderer.pixel(50, 50, &mut shown);
        for (light, shown) in light.channels().into_iter().zip(shown.0.channels()) {
            assert!((light - shown).abs() < 1e-5, "{light}, but the events have {shown}");
        }
    });
}

/// Looks that make no sense are refused, with an error that says what to do.
#[test]
fn silly_looks_are_refused() {
    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()];
    let prepared = PreparedScene::<f32>::new(&CLASSIC, &mut memory).expect("a legal scene");
    let refused = |settings| Renderer::new(&prepared, settings).err();
    let tones = |tones| refused(settings(Look { tones, contours: None }));
    for steps in [0, 1, 17, 255] {
        let error = tones(Tones::Toon { steps });
        assert_eq!(error, Some(SettingsError::ToonSteps { given: steps, most: 16 }));
        assert!(error.unwrap().to_string().ends_with("use 2 to 16, 4 are usual"));
    }
    for bad in [-0.1, 1.1, f32::NAN, f32::INFINITY] {
        assert_eq!(tones(Tones::Gooch(Gooch { blue: bad, ..Gooch::NEW })), Some(SettingsError::Gooch));
        assert_eq!(tones(Tones::Gooch(Gooch { warm: bad, ..Gooch::NEW })), Some(SettingsError::Gooch));
        let contours = |contours| refused(settings(Look { contours: Some(contours), ..TOON }));
        assert_eq!(contours(Contours { depth: bad, ..CONTOURS }), Some(SettingsError::Contours));
        let ink = LinearRgb::new(0.0, 0.0, bad);
        assert_eq!(contours(Contours { ink, ..CONTOURS }), Some(SettingsError::Contours));
        let crease = bad * 4.0;
        assert_eq!(contours(Contours { crease, ..CONTOURS }), Some(SettingsError::Contours));
    }
    let paths = |look| refused(Settings { integrator: Integrator::PathTracing, ..settings(look) });
    assert_eq!(paths(TOON), Some(SettingsError::TonesOfPaths));
    assert_eq!(paths(GOOCH), Some(SettingsError::TonesOfPaths));
    assert_eq!(paths(LINES), None);
}

/// A scene's file says its look, and keeps it when it is written again.
#[test]
fn scenes_say_their_look() {
    let directory = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (one, two) = (directory.join("look.ron"), directory.join("look-again.ron"));
    for (text, look) in [
        ("(tones: Toon(steps: 3))", Look { tones: Tones::Toon { steps: 3 }, contours: None }),
        ("(contours: ())", Look { tones: Tones::Light, contours: Some(Contours::NEW) }),
        (
            "(tones: Gooch(blue: 0.5), contours: (crease: 1, ink: (0, 0, 0.5)))",
            Look {
                tones: Tones::Gooch(Gooch { blue: 0.5, ..Gooch::NEW }),
                contours: Some(Contours { crease: 1.0, ink: LinearRgb::new(0.0, 0.0, 0.5), ..Contours::NEW }),
            },
        ),
    ] {
        let camera = "camera: (eye: (0, 0, 5), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 0.7)";
        let file = format!("Scene({camera}, objects: [], materials: [], settings: (look: {text}))");
        std::fs::write(&one, file).unwrap();
        let arena = Bump::new();
        let scene = LoadedScene::open(&one, &arena).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.settings.look, look);
        let file = SceneFile::new(&two, Number::F32).unwrap();
        file.contents(&scene.scene, &scene.settings, &arena).unwrap().write().unwrap();
        let again = LoadedScene::open(&two, &arena).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(again.settings.look, look);
    }
}

/// The rays that contours take on top of those of a photograph, per pixel.
#[test]
fn contours_take_few_rays() {
    let rays = |scene: &Scene, look, quality: Option<Realtime>| {
        let settings = Settings { look, ..Settings::new(320, 240) };
        let rays = with_renderer::<f32, _>(scene, settings, |renderer| {
            let mut screen = Screen::new(renderer);
            let mut colors = vec![Rgb888::BLACK; 320 * 8];
            let mut samples = vec![Sample::BLANK; 321];
            match quality {
                None => {
                    let mut frame = renderer.frame(0..240, &mut colors[..]).expect("lines");
                    frame.step(&mut screen, u32::MAX).expect("drawn").rays
                }
                Some(quality) => {
                    let lent = quality.lend(&mut colors, &mut samples);
                    let mut frame = renderer.frame(0..240, lent).expect("lines");
                    frame.step(&mut screen, u32::MAX).expect("drawn").rays
                }
            }
        });
        f64::from(rays) / (320.0 * 240.0)
    };
    // Outlines tell where there is only sky; groups of 4 by 4 pixels take 24 rays.
    for (name, scene, most_exact, most_realtime) in
        [("classic", &CLASSIC, 1.0, 0.6), ("flake", &FLAKE, 1.51, 1.0)]
    {
        let [exact, realtime] =
            [(None, most_exact), (Some(Realtime::new()), most_realtime)].map(|(quality, most)| {
                let (photo, drawn) = (rays(scene, Look::PHOTO, quality), rays(scene, LINES, quality));
                println!("{name}: {photo:.2} rays a pixel, with contours {drawn:.2}");
                assert!(drawn > photo && drawn - photo < most, "{name}: {photo}, with contours {drawn}");
                drawn - photo
            });
        assert!(realtime < exact, "{name}");
    }
}
