//! Tests of pictures that are drawn in passes.

use std::mem::MaybeUninit;
use std::path::Path;

use bumpalo::Bump;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayline::builtin::CLASSIC;
use rayline::math::Fixed;
use rayline::{
    Adaptive, DrawError, LineError, PixelSum, PreparedScene, Progressive, Real, Renderer, Sampler, Sampling,
    Scene, Settings,
};
use rayline_simulator::LoadedScene;
use rayline_tests::{Screen, Unplugged};

const WIDTH: usize = 24;
const HEIGHT: usize = 18;

fn with_renderer<R: Real>(scene: &Scene, sampling: Sampling, then: impl FnOnce(&Renderer<R>)) {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::new(scene, &mut memory).expect("a legal scene");
    let settings = Settings { bounces: 2, sampling, ..Settings::new(WIDTH as u32, HEIGHT as u32) };
    then(&Renderer::new(&prepared, settings).expect("legal settings"));
}

fn at_once<R: Real>(renderer: &Renderer<R>) -> Vec<Rgb888> {
    let mut screen = Screen::new(renderer);
    renderer.draw(&mut screen, &mut [Rgb888::BLACK; WIDTH]).expect("drawn");
    screen.picture()
}

/// The picture after each pass, drawn in steps of so many rays, with a buffer of some lines.
fn passes<R: Real>(renderer: &Renderer<R>, budget_rays: u32, lines: usize) -> Vec<Vec<Rgb888>> {
    let mut screen = Screen::new(renderer);
    let mut buffer = vec![Rgb888::BLACK; WIDTH * lines];
    let mut sums = [PixelSum::EMPTY; WIDTH * HEIGHT];
    let mut frame =
        renderer.frame(0..HEIGHT as u32, Progressive::lend(&mut buffer, &mut sums)).expect("a frame");
    let (mut pictures, mut refined) = (Vec::new(), 0);
    loop {
        while !frame.step(&mut screen, budget_rays).expect("a step").is_done() {}
        pictures.push(screen.picture());
        assert!(frame.pixels_refined() >= refined);
        refined = frame.pixels_refined();
        if frame.is_refined() {
            return pictures;
        }
        frame.set_lines(0..HEIGHT as u32).expect("the same lines");
    }
}

fn apart(a: &[Rgb888], b: &[Rgb888]) -> u32 {
    let channels = |color: &Rgb888| [color.r(), color.g(), color.b()];
    a.iter().flat_map(channels).zip(b.iter().flat_map(channels)).map(|(a, b)| u32::from(a.abs_diff(b))).sum()
}

/// The last pass leaves the bytes of the picture that is drawn at once; every pass shows a picture that is
/// nearly as near to it as the one before, or nearer.
fn assert_ends_as_at_once<R: Real>(scene: &Scene) {
    let sobol = |samples| Sampling { sampler: Sampler::Sobol, ..Sampling::new(samples) };
    for (sampling, expected) in [(Sampling::new(1), 1), (sobol(3), 3), (sobol(16), 16)] {
        with_renderer::<R>(scene, sampling, |renderer| {
            let picture = at_once(renderer);
            let pictures = passes(renderer, u32::MAX, 1);
            assert_eq!(pictures.len(), expected);
            assert!(pictures.last() == Some(&picture));
            let errors: Vec<u32> = pictures.iter().map(|pass| apart(pass, &picture)).collect();
            assert!(errors.windows(2).all(|pair| pair[1] <= pair[0] + pair[0] / 4 + 300), "{errors:?}");
            assert!(expected == 1 || errors[expected - 2] * 3 < errors[0].max(1) * 2, "{errors:?}");
            // Neither steps nor the number of lines of the buffer change a pass.
            assert!(passes(renderer, 1, 5) == pictures);
            assert!(passes(renderer, 37, HEIGHT) == pictures);
        });
    }
    // The first pass takes all first samples, and pixels in which they agree are complete.
    let adaptive = Some(Adaptive { at_first: 4, ..Adaptive::NEW });
    with_renderer::<R>(scene, Sampling { adaptive, ..sobol(12) }, |renderer| {
        let pictures = passes(renderer, u32::MAX, 1);
        assert_eq!(pictures.len(), 9);
        assert!(pictures.last() == Some(&at_once(renderer)));
        assert!(passes(renderer, 1, 5) == pictures);
        let mut sums = [PixelSum::EMPTY; WIDTH * HEIGHT];
        let mut line = [Rgb888::BLACK; WIDTH];
        let quality = Progressive::lend(&mut line, &mut sums);
        let mut frame = renderer.frame(0..HEIGHT as u32, quality).expect("a frame");
        frame.draw(&mut Screen::new(renderer)).expect("drawn");
        assert!((1..WIDTH * HEIGHT).contains(&frame.pixels_refined()), "{}", frame.pixels_refined());
    });
}

#[test]
fn passes_end_in_the_picture_that_is_drawn_at_once() {
    assert_ends_as_at_once::<f32>(&CLASSIC);
    assert_ends_as_at_once::<f64>(&CLASSIC);
    assert_ends_as_at_once::<Fixed>(&CLASSIC);
    for name in ["camera-motion", "light-area", "material-gloss"] {
        let arena = Bump::new();
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../docs/gallery/{name}.ron"));
        let scene = LoadedScene::open(&file, &arena).expect("a scene").scene;
        assert_ends_as_at_once::<f32>(&scene);
        assert_ends_as_at_once::<Fixed>(&scene);
    }
}

/// Rays that are left out are left out in passes, too.
#[test]
fn passes_share_the_rays_of_a_pixel() {
    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()];
    let prepared = PreparedScene::<f32>::new(&CLASSIC, &mut memory).expect("a legal scene");
    let settings = Settings {
        rays_per_pixel: 40,
        sampling: Sampling::new(8),
        ..Settings::new(WIDTH as u32, HEIGHT as u32)
    };
    let renderer = Renderer::new(&prepared, settings).expect("legal settings");
    assert!(passes(&renderer, u32::MAX, 1).last() == Some(&at_once(&renderer)));
}

#[test]
fn a_display_that_fails_loses_no_pass() {
    with_renderer::<f32>(&CLASSIC, Sampling::new(4), |renderer| {
        let mut screen = Screen::new(renderer);
        let mut line = [Rgb888::BLACK; WIDTH];
        let mut sums = [PixelSum::EMPTY; WIDTH * HEIGHT];
        let quality = Progressive::lend(&mut line, &mut sums);
        let mut frame = renderer.frame(0..HEIGHT as u32, quality).expect("a frame");
        for pass in 0..4 {
            screen.pixels_until_failure = Some((3 + pass) * WIDTH + 5);
            let failed = frame.draw(&mut screen).expect_err("unplugged");
            assert_eq!(failed, DrawError::Display { line: 3 + pass as u32, error: Unplugged });
            screen.pixels_until_failure = None;
            frame.draw(&mut screen).expect("plugged in again");
            assert_eq!(frame.is_refined(), pass == 3);
            frame.set_lines(0..HEIGHT as u32).expect("the same lines");
        }
        assert!(screen.picture() == at_once(renderer));
    });
}

#[test]
fn memory_of_the_wrong_size_is_refused() {
    with_renderer::<f32>(&CLASSIC, Sampling::new(4), |renderer| {
        let mut line = [Rgb888::BLACK; WIDTH];
        let mut sums = [PixelSum::EMPTY; WIDTH * HEIGHT];
        let (given, needed) = (WIDTH * HEIGHT - 1, WIDTH * HEIGHT);
        let fewer = Progressive::lend(&mut line, &mut sums[1..]);
        assert_eq!(renderer.frame(0..9, fewer).err(), Some(LineError::SumCount { given, needed }));
        let shorter = Progressive::lend(&mut line[1..], &mut sums);
        let (given, width) = (WIDTH - 1, WIDTH as u32);
        assert_eq!(renderer.frame(0..9, shorter).err(), Some(LineError::BufferLength { given, width }));
    });
}
