//! Drawings of a turning object: contours and patterns stay where they are, and do not flicker.
//!
//! A box turns by a degree from frame to frame beside a ball that stands still. A point of the box moves by
//! less than a pixel, so that lines need no compensation for motion. Three measures:
//!
//! - *Lasting lines*: the share of pixels with ink that have ink within one pixel in the next frame.
//! - *Flips*: the pixels of a dithered picture that turn from black to white or back, over the smallest
//!   number by which the mean of areas can follow the light: the sum of its changes.
//! - *Still pixels*: those of the ball and the sky around it must not change at all.
//!
//! Each measure is also taken of a drawing that does flicker, with dots in random places in each frame.

use std::mem::MaybeUninit;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayline::shape::{Cuboid, Plane, Shape, Sphere};
use rayline::{
    Background, Camera, Contours, Dither, Gooch, Light, Light16, LinearRgb, Look, Material, Object,
    PreparedScene, Quantizer, Realtime, Renderer, Sample, Scene, Settings, Tones, Transfer, Vec3,
};
use rayline_tests::Screen;

const WIDTH: usize = 160;
const HEIGHT: usize = 120;
const FRAMES: usize = 24;
const SETTINGS: Settings =
    Settings { transfer: Transfer::Linear, ..Settings::new(WIDTH as u32, HEIGHT as u32) };
const INK: LinearRgb = LinearRgb::new(1.0, 0.0, 1.0);
const LINES: Option<Contours> = Some(Contours { ink: INK, ..Contours::NEW });
/// Columns of the ball and around it, where neither box nor shadow is ever seen.
const STILL: usize = 48;

/// Calls `draw` with a renderer of each frame.
fn turn<T>(settings: Settings, draw: impl Fn(&Renderer<f32>) -> T) -> Vec<T> {
    let frame = |frame: usize| {
        let (sine, cosine) = (frame as f32).to_radians().sin_cos();
        let axes = [
            Vec3::new(cosine * 0.8, 0.0, -sine * 0.8),
            Vec3::new(0.0, 0.8, 0.0),
            Vec3::new(sine * 0.8, 0.0, cosine * 0.8),
        ];
        let objects = [
            Object::new(Shape::Plane(Plane::new(Vec3::new(0.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0))), 0),
            Object::new(Shape::Cuboid(Cuboid::oriented(Vec3::new(0.9, -0.2, 0.0), axes)), 0),
            Object::new(Shape::Sphere(Sphere::new(Vec3::new(-1.7, -0.3, 0.0), 0.7)), 0),
        ];
        let scene = Scene {
            camera: Camera {
                eye: Vec3::new(0.0, 1.2, 6.0),
                target: Vec3::ZERO,
                up: Vec3::new(0.0, 1.0, 0.0),
                vertical_fov: 0.6,
                lens: None,
            },
            background: Background::Solid(LinearRgb::gray(0.7)),
            objects: &objects,
            materials: &[Material { ambient: 0.15, ..Material::matte(LinearRgb::gray(0.8)) }],
            lights: &[Light::Point { position: Vec3::new(-4.0, 6.0, 5.0), color: LinearRgb::WHITE }],
            motions: &[],
        };
        let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
        let prepared = PreparedScene::new(&scene, &mut memory).expect("a legal scene");
        draw(&Renderer::new(&prepared, settings).expect("legal settings"))
    };
    (0..FRAMES).map(frame).collect()
}

fn exact(renderer: &Renderer<f32>) -> Vec<Rgb888> {
    let mut pixels = vec![Rgb888::BLACK; WIDTH * HEIGHT];
    renderer.lines(0, &mut pixels, &mut ()).expect("lines");
    pixels
}

fn realtime(renderer: &Renderer<f32>) -> Vec<Rgb888> {
    const QUALITY: Realtime = Realtime::fine();
    let mut screen = Screen::new(renderer);
    let mut colors = vec![Rgb888::BLACK; QUALITY.colors(WIDTH as u16)];
    let mut samples = vec![Sample::BLANK; QUALITY.samples(WIDTH as u16)];
    renderer.draw(&mut screen, QUALITY.lend(&mut colors, &mut samples)).expect("drawn");
    screen.picture()
}

fn hash(frame: usize, at: usize) -> u32 {
    let mut hash = (frame * WIDTH * HEIGHT + at) as u32;
    for _ in 0..3 {
        hash = (hash ^ hash >> 15).wrapping_mul(0x2C1B_3C6D);
    }
    hash
}

/// The share of pixels with ink that have ink within one pixel in the next frame.
fn lasting(frames: &[Vec<bool>]) -> f64 {
    let (mut lasting, mut all) = (0, 0);
    for pair in frames.windows(2) {
        for at in (0..WIDTH * HEIGHT).filter(|at| pair[0][*at]) {
            let (x, y) = (at % WIDTH, at / WIDTH);
            let mut near = (y.saturating_sub(1)..=(y + 1).min(HEIGHT - 1))
                .flat_map(|y| (x.saturating_sub(1)..=(x + 1).min(WIDTH - 1)).map(move |x| y * WIDTH + x));
            lasting += usize::from(near.any(|at| pair[1][at]));
            all += 1;
        }
    }
    f64::from(lasting as u32) / f64::from(all as u32)
}

#[test]
fn contours_last() {
    let look = Look { tones: Tones::Light, contours: LINES };
    let is_ink = |color: &Rgb888| (color.r(), color.g(), color.b()) == (255, 0, 255);
    for (name, draw) in [("exact", exact as fn(&Renderer<f32>) -> Vec<Rgb888>), ("realtime", realtime)] {
        let frames = turn(Settings { look, ..SETTINGS }, draw);
        let inked: Vec<Vec<bool>> = frames.iter().map(|frame| frame.iter().map(is_ink).collect()).collect();
        let share =
            inked.iter().flatten().filter(|ink| **ink).count() as f64 / (WIDTH * HEIGHT * FRAMES) as f64;
        let lasts = lasting(&inked);
        // As much ink, in random places.
        let least = (share * 4_294_967_296.0) as u32;
        let random = |frame| (0..WIDTH * HEIGHT).map(|at| hash(frame, at) < least).collect();
        let random: Vec<Vec<bool>> = (0..FRAMES).map(random).collect();
        let by_chance = lasting(&random);
        println!("{name}: of {share:.4} ink, {lasts:.4} lasts, of random dots {by_chance:.4}");
        assert!(share > 0.02, "{name}: {share}");
        assert!(lasts > 0.995, "{name}: {lasts}");
        assert!(by_chance < 0.5, "{name}: {by_chance}");
    }
}

/// Nothing changes where nothing moves, in any look.
#[test]
fn still_pixels_stay() {
    for tones in [Tones::Light, Tones::Toon { steps: 4 }, Tones::Gooch(Gooch::NEW)] {
        let settings = Settings { look: Look { tones, contours: LINES }, ..SETTINGS };
        for draw in [exact as fn(&Renderer<f32>) -> Vec<Rgb888>, realtime] {
            let frames = turn(settings, draw);
            let still = |frame: &[Rgb888]| {
                frame.chunks(WIDTH).flat_map(|line| line[..STILL].to_vec()).collect::<Vec<_>>()
            };
            assert!(frames.iter().all(|frame| still(frame) == still(&frames[0])), "{tones:?}");
            assert!(frames.windows(2).all(|pair| pair[0] != pair[1]), "the box turns");
        }
    }
}

/// The pixels that turn from black to white or back, over the sum of the changes of light.
fn flips(lights: &[Vec<Light16>], white: impl Fn(usize, usize, Light16) -> bool) -> f64 {
    let (mut flips, mut least) = (0u32, 0.0);
    for (frame, pair) in lights.windows(2).enumerate() {
        for (at, (before, after)) in pair[0].iter().zip(&pair[1]).enumerate() {
            flips += u32::from(white(frame, at, *before) != white(frame + 1, at, *after));
            least += f64::from(before.luminance().abs_diff(after.luminance())) / 65536.0;
        }
    }
    f64::from(flips) / least
}

#[test]
fn patterns_do_not_swim() {
    let lights = turn(SETTINGS, |renderer| {
        let mut pixels = vec![Light16::BLACK; WIDTH * HEIGHT];
        renderer.lines(0, &mut pixels, &mut ()).expect("lines");
        pixels
    });
    for dither in [Dither::Ordered, Dither::Stippling, Dither::Hatching, Dither::BlueNoise] {
        let settings = Settings { dither, ..SETTINGS };
        let flips = flips(&lights, |_, at, light| {
            let quantizer = Quantizer::new(&settings, (at % WIDTH) as u16, (at / WIDTH) as u16);
            quantizer.level(light.luminance(), 1) == 1
        });
        println!("{dither:?}: {flips:.2} times the fewest flips");
        assert!((0.8..1.2).contains(&flips), "{dither:?}: {flips}");
    }
    // Other random thresholds in each frame.
    let random = flips(&lights, |frame, at, light| light.luminance() > hash(frame, at) >> 16);
    println!("random: {random:.2} times the fewest flips");
    assert!(random > 10.0, "{random}");
}
