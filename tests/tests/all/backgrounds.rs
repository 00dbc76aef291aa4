//! Tests of backgrounds that depend on the direction, with rays of every kind, in every number system and
//! quality.

use std::mem::MaybeUninit;
use std::path::Path;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayline::builtin::{PRISM, WHITTED};
use rayline::math::Fixed;
use rayline::{
    Background, Encoding, Ends, Event, Fault, Filter, Image, LinearRgb, Object, Panorama, Part, Pixels,
    PreparedScene, Probe, RayKind, Real, Realtime, Renderer, Sample, Scene, Settings, Sky, Transfer, Vec3,
};
use rayline_tests::textbook::background_in;
use rayline_tests::{
    Picture, PovrayPicture, Screen, Watch, assert_alike, core_picture, settings, textbook::Textbook,
};

static EVENING: Sky = Sky {
    up: Vec3::new(0.1, 1.0, -0.2),
    zenith: LinearRgb::new(0.02, 0.05, 0.3),
    horizon: LinearRgb::new(1.0, 0.5, 0.2),
    nadir: LinearRgb::new(0.1, 0.08, 0.05),
};

/// An image of 64 by 32 pixels: a meadow below, a sky above, a white sun on the right and red upright bars on
/// the left.
static MEADOW: [u8; 64 * 32 * 3] = {
    let mut bytes = [0; 64 * 32 * 3];
    let mut i = 0;
    while i < 64 * 32 {
        let (x, y) = (i % 64, i / 64);
        let is_sun = (x - 44) * (x - 44) + (y - 9) * (y - 9) < 9;
        let is_bar = x >= 8 && x < 24 && x % 4 < 2 && y > 10 && y < 20;
        let color = if is_sun {
            [255, 255, 240]
        } else if is_bar {
            [200, 30, 20]
        } else if y < 16 {
            [(y * 9) as u8, (90 + y * 8) as u8, 235]
        } else {
            [60, (150 - (y - 16) * 5) as u8, 40]
        };
        (bytes[i as usize * 3], bytes[i as usize * 3 + 1], bytes[i as usize * 3 + 2]) =
            (color[0], color[1], color[2]);
        i += 1;
    }
    bytes
};
const SMOOTH: Image = Image {
    width: 64,
    height: 32,
    pixels: Pixels::Rgb888(&MEADOW),
    encoding: Encoding::Srgb,
    filter: Filter::Bilinear,
    ends: Ends::Mirror,
};
const SHARP: Image = Image { encoding: Encoding::Linear, filter: Filter::Nearest, ..SMOOTH };
static TURNED: Panorama = Panorama { image: SHARP, rotation: Vec3::new(0.2, 2.5, -0.1) };

static DAY: Sky = Sky::new(LinearRgb::gray(0.9), LinearRgb::new(0.1, 0.3, 0.9));
static AHEAD: Panorama = Panorama::new(SMOOTH);

/// A background of each kind, with its name.
pub(super) const ALL: [(&str, Background<'static>); 4] = [
    ("gradient", Background::Gradient(&DAY)),
    ("evening", Background::Gradient(&EVENING)),
    ("smooth", Background::Image(&AHEAD)),
    ("sharp", Background::Image(&TURNED)),
];

fn with_renderer<R: Real, T>(scene: &Scene, settings: Settings, look: impl FnOnce(&Renderer<R>) -> T) -> T {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::new(scene, &mut memory).expect("a legal scene");
    look(&Renderer::new(&prepared, settings).expect("legal settings"))
}

/// A probe that compares the color of each ray that hits nothing with the background in its direction.
struct Seen<'a> {
    background: Background<'a>,
    kind: RayKind,
    direction: Vec3,
    /// The number of rays of each kind.
    counts: [u32; 3],
    /// The number of rays that were off by more than 2 of 255.
    off: u32,
}

impl<R: Real> Probe<R> for Seen<'_> {
    fn record(&mut self, event: Event<R>) {
        match event {
            Event::Ray { kind, ray, .. } => (self.kind, self.direction) = (kind, ray.direction.to_f32()),
            Event::Miss { color, .. } => {
                let kind = [RayKind::Camera, RayKind::Reflected, RayKind::Refracted];
                self.counts[kind.iter().position(|kind| *kind == self.kind).expect("a kind")] += 1;
                let expected = background_in(&self.background, self.direction);
                let got = color.to_f32();
                let apart = [(got.r, expected.r), (got.g, expected.g), (got.b, expected.b)]
                    .map(|(got, expected)| (got - expected).abs());
                self.off += u32::from(apart.iter().any(|apart| *apart > 2.0 / 255.0));
            }
            _ => {}
        }
    }
}

fn assert_seen<R: Real>() {
    for (name, background) in ALL {
        let mut seen =
            Seen { background, kind: RayKind::Camera, direction: Vec3::ZERO, counts: [0; 3], off: 0 };
        let scene = Scene { background, ..PRISM };
        with_renderer::<R, _>(&scene, Settings { bounces: 5, ..Settings::new(80, 60) }, |renderer| {
            for (x, y) in (0..60).flat_map(|y| (0..80).map(move |x| (x, y))) {
                renderer.pixel(x, y, &mut Watch(&mut seen));
            }
        });
        let Seen { counts, off, .. } = seen;
        assert!(counts.iter().all(|count| *count > 50), "{counts:?}");
        // Some directions are rounded to another pixel of the image.
        let most = if name == "sharp" { counts.iter().sum::<u32>() / 500 } else { 0 };
        assert!(off <= most, "{name}: {off} of {counts:?} are off");
    }
}

#[test]
fn rays_of_every_kind_see_the_background_in_their_direction() {
    assert_seen::<f32>();
    assert_seen::<f64>();
    assert_seen::<Fixed>();
}

#[test]
fn pictures_are_those_of_the_textbook() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
    for (name, background) in ALL {
        for (scene, bounces) in [(&PRISM, 5), (&WHITTED, 6)] {
            let scene = &Scene { background, ..*scene };
            let settings = settings(bounces);
            let textbook = Textbook::new(scene, settings).picture();
            let (single, double) =
                (core_picture::<f32>(scene, settings), core_picture::<f64>(scene, settings));
            assert_alike(directory, name, ("f32", &single), ("textbook", &textbook));
            assert_alike(directory, name, ("f64", &double), ("textbook", &textbook));
        }
    }
}

/// The peak signal-to-noise ratio in decibels.
fn psnr(a: &Picture, b: &Picture) -> f64 {
    let square = |(a, b): (&u8, &u8)| f64::from(a.abs_diff(*b)).powi(2);
    let sum: f64 = a.pixels.iter().flatten().zip(b.pixels.iter().flatten()).map(square).sum();
    10.0 * (255.0 * 255.0 * 3.0 * a.pixels.len() as f64 / sum).log10()
}

#[test]
fn fixed_point_is_near() {
    for (name, background) in ALL {
        let scene = Scene { background, ..PRISM };
        let settings = Settings { bounces: 5, transfer: Transfer::Linear, ..Settings::new(320, 240) };
        let near = psnr(&core_picture::<f64>(&scene, settings), &core_picture::<Fixed>(&scene, settings));
        println!("{name}: {near:.1} dB");
        assert!(near >= 40.0, "{name} has {near} dB");
    }
}

#[test]
fn povray_has_the_same_sky() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("povray");
    for (name, background) in &ALL {
        let scene = &Scene { background: *background, ..WHITTED };
        let settings = settings(6);
        let Some(povray) = PovrayPicture::render(scene, settings, &directory, name) else { return };
        assert_alike(
            &directory,
            name,
            ("f32", &core_picture::<f32>(scene, settings)),
            ("povray", &povray.picture),
        );
    }
}

fn exact(renderer: &Renderer<f32>) -> Picture {
    let mut line = vec![Rgb888::BLACK; renderer.width() as usize];
    let mut pixels = Vec::new();
    for y in 0..renderer.height() {
        renderer.line(y, &mut line).expect("a line");
        pixels.extend(line.iter().map(|color| [color.r(), color.g(), color.b()]));
    }
    Picture { width: renderer.width(), pixels }
}

fn realtime(renderer: &Renderer<f32>, quality: Realtime) -> Picture {
    let mut screen = Screen::new(renderer);
    let width = renderer.width() as u16;
    let mut colors = vec![Rgb888::BLACK; quality.colors(width)];
    let mut samples = vec![Sample::BLANK; quality.samples(width)];
    renderer.draw(&mut screen, quality.lend(&mut colors, &mut samples)).expect("a picture");
    let pixels = screen.picture().iter().map(|color| [color.r(), color.g(), color.b()]).collect();
    Picture { width: renderer.width(), pixels }
}

#[test]
fn realtime_quality_is_near() {
    for (name, background) in ALL {
        for (what, scene, bounces) in [
            ("prism", Scene { background, ..PRISM }, 5),
            ("whitted", Scene { background, ..WHITTED }, 6),
            ("nothing", Scene { background, objects: &[], ..WHITTED }, 0),
        ] {
            let settings = Settings { bounces, ..Settings::new(320, 240) };
            with_renderer::<f32, _>(&scene, settings, |renderer| {
                for quality in [Realtime::new(), Realtime::fine()] {
                    let near = psnr(&exact(renderer), &realtime(renderer, quality));
                    println!("{name}, {what}: {near:.1} dB");
                    assert!(near >= 36.0, "{name}, {what}, {quality:?}: {near} dB");
                }
            });
        }
    }
}

#[test]
fn acceleration_changes_no_byte() {
    for (name, background) in ALL {
        let scene = Scene { background, ..PRISM };
        let settings = Settings { bounces: 5, ..Settings::new(96, 72) };
        let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
        let prepared = PreparedScene::<f32>::new(&scene, &mut memory).expect("a legal scene");
        let slow = prepared.without_acceleration();
        let picture = |scene| exact(&Renderer::new(scene, settings).expect("legal settings"));
        assert!(picture(&prepared) == picture(&slow), "{name}");
    }
}

#[test]
fn lines_of_sky_stay_while_the_camera_does() {
    let settings = Settings::new(48, 36);
    // The objects have moved.
    let objects: Vec<Object<_>> = WHITTED.objects.iter().rev().copied().collect();
    let moved = rayline::Camera { vertical_fov: WHITTED.camera.vertical_fov * 0.99, ..WHITTED.camera };
    let is_unchanged = |before: &Scene, now: &Scene| {
        with_renderer::<f32, _>(before, settings, |before| {
            with_renderer::<f32, _>(now, settings, |now| now.is_unchanged(before, 0))
        })
    };
    let solid = ("solid", Background::gray(0.5));
    for (name, background) in ALL.into_iter().chain([solid]) {
        let before = Scene { background, ..WHITTED };
        assert!(is_unchanged(&before, &Scene { objects: &objects, ..before }), "{name}");
        // With another line of sight the background changes.
        let camera_moved = is_unchanged(&before, &Scene { camera: moved, ..before });
        assert_eq!(camera_moved, name == "solid", "{name}");
        for (other, background) in ALL.into_iter().chain([solid]) {
            assert_eq!(
                is_unchanged(&before, &Scene { background, ..before }),
                name == other,
                "{name}, {other}"
            );
        }
    }
}

#[test]
fn a_bad_picture_is_refused() {
    let panorama = Panorama::new(Image { width: 63, ..SMOOTH });
    let scene = Scene { background: Background::Image(&panorama), ..WHITTED };
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
    let error = PreparedScene::<f32>::new(&scene, &mut memory).expect_err("too many pixels");
    assert_eq!(error.part, Part::Background);
    assert_eq!(error.fault, Fault::PixelCount { needed: 63 * 32 * 3, given: 64 * 32 * 3 });
}
