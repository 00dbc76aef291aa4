//! Tests of drawing to displays: the bytes do not depend on the order of lines, on steps or on failures.

use std::mem::MaybeUninit;
use std::ops::Range;

use embedded_graphics::draw_target::DrawTargetExt;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::mock_display::MockDisplay;
use embedded_graphics::pixelcolor::raw::RawU1;
use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Gray8, PixelColor, Rgb888, RgbColor};
use embedded_graphics::primitives::{PointsIter, Rectangle};
use rayline::builtin::{CLASSIC, FLAKE};
use rayline::limits::LINES_AT_ONCE;
use rayline::shape::{Polygon, Shape, Sphere};
use rayline::{
    Background, Camera, DisplayColor, Dither, DrawError, Event, Light, Light16, LineError, LinearRgb,
    Material, Object, PreparedScene, Probe, Progress, Quantizer, Realtime, Renderer, Sample, Sampling, Scene,
    SceneBuf, Settings, SettingsError, Texture, Transfer, Vec3, Workspace, prepared_bytes,
};
use rayline_tests::{Screen, Unplugged, Watch};

/// Calls `use_it` with a renderer of the scene.
fn with_renderer<T>(scene: &Scene, settings: Settings, use_it: impl FnOnce(&Renderer<f32>) -> T) -> T {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
    let prepared = PreparedScene::new(scene, &mut memory).expect("a legal scene");
    use_it(&Renderer::new(&prepared, settings).expect("legal settings"))
}

const SMALL: Settings = Settings { bounces: 3, ..Settings::new(37, 23) };

/// The whole picture, line by line.
fn picture(renderer: &Renderer<f32>) -> Vec<Rgb888> {
    let mut pixels = vec![Rgb888::BLACK; (renderer.width() * renderer.height()) as usize];
    for (y, line) in (0..).zip(pixels.chunks_mut(renderer.width() as usize)) {
        renderer.line(y, line).expect("a line");
    }
    pixels
}

/// A single sample lies in the center: the ray of the middle pixel is the line of sight.
#[test]
fn one_sample_is_the_center() {
    struct FirstRay(Option<Vec3>);
    impl Probe<f32> for FirstRay {
        fn record(&mut self, event: Event<f32>) {
            if let Event::Ray { ray, .. } = event {
                self.0.get_or_insert(ray.direction);
            }
        }
    }
    let (width, height) = (SMALL.width, SMALL.height);
    assert!(width % 2 == 1 && height % 2 == 1);
    with_renderer(&CLASSIC, SMALL, |renderer| {
        let mut first = FirstRay(None);
        renderer.pixel((width / 2) as u16, (height / 2) as u16, &mut Watch(&mut first));
        let direction = first.0.expect("a ray");
        assert!((direction - Vec3::new(0.0, 0.0, -1.0)).length() < 1e-6, "{direction:?}");
    });
}

#[test]
fn lines_in_any_order_are_the_same_bytes() {
    with_renderer(&CLASSIC, SMALL, |renderer| {
        let expected = picture(renderer);
        let mut shuffled = vec![Rgb888::BLACK; expected.len()];
        let height = renderer.height();
        for i in 0..height {
            // 7 and 23 have no common factor.
            let y = (i * 7 + 5) % height;
            let start = (y * 37) as usize;
            renderer.line(y, &mut shuffled[start..start + 37]).expect("a line");
        }
        assert!(shuffled == expected);
    });
}

#[test]
fn drawing_sends_each_line_in_one_window() {
    with_renderer(&CLASSIC, SMALL, |renderer| {
        let mut screen = Screen::new(renderer);
        renderer.draw(&mut screen, &mut [Rgb888::BLACK; 37]).expect("drawn");
        assert!(screen.picture() == picture(renderer));
        let lines: Vec<_> = (0..23).map(|y| Rectangle::new(Point::new(0, y), Size::new(37, 1))).collect();
        assert_eq!(screen.windows, lines);
    });
}

#[test]
fn a_larger_buffer_sends_several_lines_in_one_window() {
    with_renderer(&CLASSIC, SMALL, |renderer| {
        let mut screen = Screen::new(renderer);
        renderer.draw(&mut screen, &mut [Rgb888::BLACK; 37 * 8]).expect("drawn");
        assert!(screen.picture() == picture(renderer));
        let band = |y, height| Rectangle::new(Point::new(0, y), Size::new(37, height));
        assert_eq!(screen.windows, [band(0, 8), band(8, 8), band(16, 7)]);
    });
}

#[test]
fn a_buffer_larger_than_the_picture_is_enough() {
    with_renderer(&CLASSIC, SMALL, |renderer| {
        let mut screen = Screen::new(renderer);
        renderer.draw(&mut screen, &mut [Rgb888::BLACK; 37 * 99]).expect("drawn");
        assert!(screen.picture() == picture(renderer));
    });
}

/// Draws with many budgets and buffers; a step may exceed its budget by `most_beyond` rays.
fn assert_steps(scene: &Scene, most_beyond: u32, smallest_step: usize) {
    with_renderer(scene, SMALL, |renderer| {
        let expected = picture(renderer);
        for (budget, lines) in [(0, 1), (1, 1), (7, 1), (50, 3), (300, 8), (10_000, 1)] {
            let mut screen = Screen::new(renderer);
            let mut buffer = vec![Rgb888::BLACK; 37 * lines];
            let mut frame = renderer.frame(0..23, &mut buffer[..]).expect("a frame");
            let mut steps = 0;
            loop {
                let progress = frame.step(&mut screen, budget).expect("a step");
                steps += 1;
                assert!(progress.rays >= 1);
                assert!(progress.rays < budget.max(1) + most_beyond);
                assert_eq!(progress.lines_total, 23);
                let drawn = screen.windows.iter().map(|window| window.size.height).sum::<u32>();
                assert_eq!(progress.lines_done, drawn);
                if progress.is_done() {
                    break;
                }
            }
            assert!(screen.picture() == expected);
            assert!(
                budget > 1 || steps == 23 * 37usize.div_ceil(smallest_step),
                "as few pixels a step as can be"
            );
            let after = frame.step(&mut screen, budget).expect("nothing to do");
            assert!(after.is_done() && after.rays == 0);
        }
    });
}

#[test]
fn stepping_with_any_budget_is_bounded_and_gives_the_same_bytes() {
    assert_steps(&CLASSIC, SMALL.rays_per_pixel, 1);
}

/// In scenes of many objects, a square of pixels is traced side by side.
#[test]
fn stepping_through_groups_of_pixels_is_bounded_too() {
    let pixels = LINES_AT_ONCE * LINES_AT_ONCE;
    assert_steps(&FLAKE, pixels as u32 * SMALL.rays_per_pixel, pixels);
}

#[test]
fn several_lines_at_once_are_the_same_lines() {
    for scene in [&CLASSIC, &FLAKE] {
        with_renderer(scene, SMALL, |renderer| {
            let expected = picture(renderer);
            for height in [1, 2, 3, 4, 5, 8, 9, 23] {
                let mut lines = vec![Rgb888::BLACK; 37 * height];
                for y in [0, 3, 23 - height] {
                    let fits = y + height <= 23;
                    let drawn = renderer.lines(y as u32, &mut lines, &mut ());
                    let refused = LineError::NoSuchLine { line: (y + height - 1) as u32, height: 23 };
                    assert_eq!(drawn, if fits { Ok(()) } else { Err(refused) });
                    assert!(
                        !fits || lines == expected[y * 37..][..lines.len()],
                        "{height} lines from {y} on"
                    );
                }
            }
        });
    }
}

#[test]
fn some_lines_are_drawn_where_they_belong() {
    with_renderer(&CLASSIC, SMALL, |renderer| {
        let expected = picture(renderer);
        let mut screen = Screen::new(renderer);
        renderer.frame(5..9, &mut [Rgb888::BLACK; 37]).expect("a frame").draw(&mut screen).expect("drawn");
        for (i, pixel) in screen.pixels.iter().enumerate() {
            let inside = (5 * 37..9 * 37).contains(&i);
            assert_eq!(*pixel, inside.then(|| expected[i]));
        }
    });
}

#[test]
fn a_display_that_fails_at_any_pixel_can_be_drawn_again_from_there() {
    let settings = Settings { bounces: 3, ..Settings::new(11, 7) };
    with_renderer(&CLASSIC, settings, |renderer| {
        let expected = picture(renderer);
        for failing in 0..11 * 7 {
            let mut screen = Screen { pixels_until_failure: Some(failing), ..Screen::new(renderer) };
            let mut buffer = [Rgb888::BLACK; 11];
            let error = renderer.draw(&mut screen, &mut buffer).expect_err("the display fails");
            let line = failing as u32 / 11;
            assert_eq!(error, DrawError::Display { line, error: Unplugged });
            assert!(screen.pixels[failing].is_none());
            screen.pixels_until_failure = None;
            renderer.frame(line..7, &mut buffer).expect("a frame").draw(&mut screen).expect("drawn");
            assert!(screen.picture() == expected);
        }
    });
}

#[test]
fn a_frame_goes_on_after_the_display_failed() {
    let settings = Settings { bounces: 3, ..Settings::new(11, 7) };
    with_renderer(&CLASSIC, settings, |renderer| {
        let expected = picture(renderer);
        for failing in 0..11 * 7 {
            let mut screen = Screen { pixels_until_failure: Some(failing), ..Screen::new(renderer) };
            let mut buffer = [Rgb888::BLACK; 22];
            let mut frame = renderer.frame(0..7, &mut buffer).expect("a frame");
            let error = loop {
                if let Err(error) = frame.step(&mut screen, 5) {
                    break error;
                }
            };
            assert!(matches!(error, DrawError::Display { line, .. } if line == failing as u32 / 22 * 2));
            screen.pixels_until_failure = None;
            while !frame.step(&mut screen, 5).expect("a step").is_done() {}
            assert!(screen.picture() == expected);
        }
    });
}

#[test]
fn wrong_buffers_and_lines_are_refused_before_the_first_pixel() {
    with_renderer(&CLASSIC, SMALL, |renderer| {
        for given in [0, 1, 36] {
            let mut buffer = vec![Rgb888::BLACK; given];
            let wrong = LineError::BufferLength { given, width: 37 };
            assert_eq!(renderer.line(0, &mut buffer), Err(wrong));
            let mut screen = Screen::new(renderer);
            assert_eq!(renderer.draw(&mut screen, &mut buffer[..]), Err(DrawError::Line(wrong)));
            assert!(screen.windows.is_empty());
        }
        // Longer memory is used as far as it holds whole lines.
        let expected = picture(renderer);
        for given in [38, 73, 75] {
            let mut buffer = vec![Rgb888::WHITE; given];
            renderer.line(5, &mut buffer).expect("a line");
            assert!(buffer[..37] == expected[5 * 37..6 * 37]);
            assert!(buffer[37..].iter().all(|pixel| *pixel == Rgb888::WHITE));
            renderer.lines(5, &mut buffer, &mut ()).expect("lines");
            let whole = given / 37 * 37;
            assert!(buffer[..whole] == expected[5 * 37..][..whole]);
            assert!(buffer[whole..].iter().all(|pixel| *pixel == Rgb888::WHITE));
            let mut screen = Screen::new(renderer);
            renderer.draw(&mut screen, &mut buffer[..]).expect("drawn");
            assert!(screen.picture() == expected);
        }
        let mut buffer = [Rgb888::BLACK; 37];
        for line in [23, 65_535, 65_536, u32::MAX] {
            assert_eq!(renderer.line(line, &mut buffer), Err(LineError::NoSuchLine { line, height: 23 }));
        }
        assert_eq!(
            renderer.frame(20..24, &mut buffer).err(),
            Some(LineError::NoSuchLine { line: 23, height: 23 })
        );
    });
}

#[test]
fn a_frame_goes_on_with_other_lines() {
    with_renderer(&CLASSIC, SMALL, |renderer| {
        let (mut screen, mut buffer) = (Screen::new(renderer), [Rgb888::BLACK; 37 * 2]);
        let mut frame = renderer.frame(0..0, &mut buffer).expect("a frame");
        for lines in [9..16, 16..23, 0..2, 2..9] {
            // The lines are changed in the middle of a line.
            frame.set_lines(4..23).expect("lines");
            frame.step(&mut screen, 20).expect("a step");
            frame.set_lines(lines.clone()).expect("lines");
            // Lines that do not exist are refused and change nothing.
            let error = frame.set_lines(20..24).expect_err("refused");
            assert_eq!(error, LineError::NoSuchLine { line: 23, height: 23 });
            let mut progress = frame.step(&mut screen, 1).expect("a step");
            while !progress.is_done() {
                progress = frame.step(&mut screen, u32::MAX).expect("a step");
            }
            assert_eq!(progress.lines_total, lines.len() as u32);
        }
        assert!(screen.picture() == picture(renderer));
    });
}

/// An earlier version refused `frame(30..30)` because of line 29.
#[test]
fn no_lines_are_drawn_wherever_they_would_begin() {
    with_renderer(&CLASSIC, SMALL, |renderer| {
        let quality = Realtime::default();
        for lines in [0..0, 5..5, 23..23, 30..30, Range { start: 30, end: 25 }] {
            let mut buffer = [Rgb888::BLACK; 37];
            let mut screen = Screen::new(renderer);
            let mut frame = renderer.frame(lines.clone(), &mut buffer).expect("nothing to draw");
            let progress = frame.step(&mut screen, u32::MAX).expect("nothing to fail");
            assert_eq!(progress, Progress { lines_done: 0, lines_total: 0, rays: 0 });

            let mut colors = vec![Rgb888::BLACK; quality.colors(37)];
            let mut samples = vec![Sample::BLANK; quality.samples(37)];
            let mut frame =
                renderer.frame(lines, quality.lend(&mut colors, &mut samples)).expect("nothing to draw");
            let progress = frame.step(&mut screen, u32::MAX).expect("nothing to fail");
            assert_eq!((progress.lines_total, progress.rays), (0, 0));
            assert!(screen.windows.is_empty());
        }
        let mut buffer = [Rgb888::BLACK; 37];
        let error = renderer.frame(30..31, &mut buffer).expect_err("refused");
        assert_eq!(error, LineError::NoSuchLine { line: 30, height: 23 });
        let message = error.to_string();
        assert_eq!(message, "there is no line 30: the picture has 23, counted from 0; ask for one below 23");
    });
}

type Stage = SceneBuf<'static, Sphere, 3, 2, 1>;

/// A ball on a larger one. Its position, color and light depend on the moment, from 0 to 1.
fn stage(moment: f32) -> Stage {
    let mut scene = Stage::new(CLASSIC.camera, CLASSIC.background);
    let [ground, red] =
        [Material::matte(LinearRgb::gray(0.6)), Material::matte(LinearRgb::new(0.9, moment, 0.1))]
            .map(|material| scene.add_material(material).expect("room"));
    scene.add_object(Sphere::new(Vec3::new(0.0, -104.0, -16.0), 100.0), ground).expect("room");
    scene
        .add_object(Sphere::new(Vec3::new(0.0, moment * 4.0 - 3.0, -16.0), 1.0 + moment), red)
        .expect("room");
    scene
        .add_light(Light::Point { position: Vec3::new(20.0 * moment, 20.0, 20.0), color: LinearRgb::WHITE })
        .expect("room");
    scene
}

#[test]
fn a_scene_that_is_changed_has_the_bytes_of_one_that_is_filled_anew() {
    const BYTES: usize = prepared_bytes::<f32, Sphere>(3, 2, 1, 0);
    let drawn = |scene: &Stage, memory: &mut Workspace<BYTES>| {
        let prepared = PreparedScene::<f32, _>::new(&scene.as_scene(), memory.lend()).expect("a legal scene");
        let renderer = Renderer::new(&prepared, SMALL).expect("legal settings");
        let mut pixels = [Rgb888::BLACK; 37 * 23];
        renderer.lines(0, &mut pixels, &mut ()).expect("as many lines");
        pixels
    };
    let (mut memory, mut changed) = (Workspace::new(), stage(0.0));
    let mut before = drawn(&changed, &mut memory);
    for frame in 1..=4u8 {
        let moment = f32::from(frame) / 4.0;
        let [_, ball] = changed.objects_mut() else { panic!("two objects") };
        ball.shape.center.y = moment * 4.0 - 3.0;
        ball.shape.radius = 1.0 + moment;
        changed.materials_mut()[1].color = Texture::Solid(LinearRgb::new(0.9, moment, 0.1));
        let [Light::Point { position, .. }] = changed.lights_mut() else { panic!("one light") };
        position.x = 20.0 * moment;

        let fresh = stage(moment);
        assert_eq!(changed.as_scene(), fresh.as_scene());
        // Drawn in the memory of the previous frame, and in fresh memory.
        let pixels = drawn(&changed, &mut memory);
        assert!(pixels == drawn(&fresh, &mut Workspace::new()), "frame {frame}");
        assert!(pixels != before, "frame {frame}");
        before = pixels;
    }
    // An illegal change is refused, and can be reverted.
    changed.objects_mut()[1].shape.radius = -1.0;
    let refused = PreparedScene::<f32, _>::new(&changed.as_scene(), memory.lend()).expect_err("no radius");
    assert_eq!(refused.to_string().split(": ").next(), Some("object 1"));
    changed.objects_mut()[1].shape.radius = 2.0;
    assert!(drawn(&changed, &mut memory) == before);
}

#[test]
fn pictures_of_every_size_are_defined() {
    for (width, height) in [(1, 1), (1, 65_535), (65_535, 1), (65_535, 65_535)] {
        with_renderer(&CLASSIC, Settings::new(width, height), |renderer| {
            let mut line = vec![Rgb888::BLACK; width as usize];
            for y in [0, height / 2, height - 1] {
                renderer.line(y, &mut line).expect("a line");
            }
        });
    }
    let refused = [(0, 0), (0, 9), (9, 0), (65_536, 1), (1, 65_536), (u32::MAX, u32::MAX)];
    for (width, height) in refused {
        let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()];
        let prepared = PreparedScene::<f32, _>::new(&CLASSIC, &mut memory).expect("a legal scene");
        let refused = Renderer::new(&prepared, Settings::new(width, height)).err();
        assert!(matches!(refused, Some(SettingsError::Size { most: 65_535, .. })), "{width}x{height}");
    }
    let message = SettingsError::Size { side: 0, most: 65_535 }.to_string();
    assert_eq!(message, "a picture cannot have a side of 0 pixels; use 1 to 65535");
}

#[test]
fn bad_settings_are_refused() {
    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()];
    let prepared = PreparedScene::<f32, _>::new(&CLASSIC, &mut memory).expect("a legal scene");
    let refused = |settings: Settings| Renderer::new(&prepared, settings).err();
    assert_eq!(refused(SMALL), None);
    let bounces = SettingsError::Bounces { given: 17, most: 16 };
    assert_eq!(refused(Settings { bounces: 17, ..SMALL }), Some(bounces));
    assert_eq!(
        refused(Settings { rays_per_pixel: 0, ..SMALL }),
        Some(SettingsError::SamplesBeyondRays { samples: 1, rays: 0 })
    );
    assert_eq!(refused(Settings { sampling: Sampling::new(0), ..SMALL }), Some(SettingsError::Samples));
    for cutoff in [-0.1, 1.1, f32::NAN, f32::INFINITY] {
        assert_eq!(refused(Settings { cutoff, ..SMALL }), Some(SettingsError::Cutoff));
    }
}

#[test]
fn several_samples_smooth_and_depend_on_the_seed_alone() {
    let picture_with = |samples, seed| {
        with_renderer(
            &CLASSIC,
            Settings { sampling: Sampling { seed, ..Sampling::new(samples) }, ..SMALL },
            picture,
        )
    };
    assert!(picture_with(1, 0) == picture_with(1, 9), "one sample is the center");
    assert!(picture_with(4, 0) == picture_with(4, 0));
    assert!(picture_with(4, 0) != picture_with(4, 9));
    // With more samples, the pictures of two seeds differ less.
    let apart = |samples| {
        let (a, b) = (picture_with(samples, 1), picture_with(samples, 2));
        a.iter().zip(&b).map(|(a, b)| u64::from(a.g().abs_diff(b.g())).pow(2)).sum::<u64>()
    };
    assert!(apart(64) * 4 < apart(4), "{} against {}", apart(64), apart(4));
}

/// A white square on the left, and a ball on the right that is lit from the upper left.
fn ascii_scene<T>(use_it: impl FnOnce(&Scene) -> T) -> T {
    let corners = [(-3.0, -1.0), (-1.0, -1.0), (-1.0, 1.0), (-3.0, 1.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
    let scene = Scene {
        camera: Camera {
            eye: Vec3::new(0.0, 0.0, 20.0),
            target: Vec3::ZERO,
            up: Vec3::new(0.0, 1.0, 0.0),
            vertical_fov: 0.2,
            lens: None,
        },
        background: Background::BLACK,
        objects: &[
            Object::new(Shape::Polygon(Polygon::new(&corners)), 0),
            Object::new(Shape::Sphere(Sphere::new(Vec3::new(1.5, 0.0, 0.0), 1.5)), 1),
        ],
        materials: &[
            Material { ambient: 1.0, diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) },
            Material::matte(LinearRgb::WHITE),
        ],
        lights: &[Light::Directional { direction: Vec3::new(1.0, -1.0, -1.0), color: LinearRgb::WHITE }],
        motions: &[],
    };
    use_it(&scene)
}

#[test]
fn a_small_picture_in_black_and_white() {
    let settings = Settings { transfer: Transfer::Linear, ..Settings::new(24, 16) };
    ascii_scene(|scene| {
        with_renderer(scene, settings, |renderer| {
            // MockDisplay panics on overdraw and outside its area.
            let mut display = MockDisplay::<BinaryColor>::new();
            renderer.draw(&mut display, &mut [BinaryColor::Off; 24]).expect("drawn");
            display.assert_pattern(&[
                "........................",
                "........................",
                "................####....",
                "..............#######...",
                "########.....########...",
                "########.....########...",
                "########....########....",
                "########....########....",
                "########....#######.....",
                "########....######......",
                "########.....##.........",
                "########................",
                "........................",
                "........................",
                "........................",
                "........................",
            ]);
        });
    });
}

#[test]
fn a_small_picture_in_gray() {
    let settings = Settings { transfer: Transfer::Linear, ..Settings::new(24, 16) };
    ascii_scene(|scene| {
        with_renderer(scene, settings, |renderer| {
            let mut display = MockDisplay::<Gray4>::new();
            renderer.draw(&mut display, &mut [Gray4::new(0); 24]).expect("drawn");
            display.assert_pattern(&[
                "000000000000000000000000",
                "000000000000000000000000",
                "0000000000000000DDB90000",
                "00000000000000EFEDCA8500",
                "FFFFFFFF00000EFFEDCA8630",
                "FFFFFFFF00000EFEDCBA8630",
                "FFFFFFFF0000DEEDDCA97520",
                "FFFFFFFF0000CDDCCA986410",
                "FFFFFFFF0000BBBBA9865300",
                "FFFFFFFF00009AA998653100",
                "FFFFFFFF0000088776531000",
                "FFFFFFFF0000045554210000",
                "000000000000002221000000",
                "000000000000000000000000",
                "000000000000000000000000",
                "000000000000000000000000",
            ]);
        });
    });
}

#[test]
fn a_display_may_be_smaller_than_the_picture_or_moved() {
    with_renderer(&CLASSIC, Settings::new(16, 16), |renderer| {
        let mut whole = MockDisplay::<Gray8>::new();
        renderer.draw(&mut whole, &mut [Gray8::new(0); 16]).expect("drawn");
        let mut part = MockDisplay::<Gray8>::new();
        renderer
            .draw(
                &mut part.clipped(&Rectangle::new(Point::zero(), Size::new(5, 9))),
                &mut [Gray8::new(0); 16],
            )
            .expect("drawn");
        assert_eq!(part.affected_area(), Rectangle::new(Point::zero(), Size::new(5, 9)));
        let mut moved = MockDisplay::<Gray8>::new();
        renderer.draw(&mut moved.translated(Point::new(3, 7)), &mut [Gray8::new(0); 16]).expect("drawn");
        for point in part.affected_area().points() {
            assert_eq!(part.get_pixel(point), whole.get_pixel(point));
            assert_eq!(moved.get_pixel(point + Point::new(3, 7)), whole.get_pixel(point));
        }
    });
}

/// A color of another crate, for which nobody can implement `DisplayColor`: e-paper whose 1 is black.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Paper {
    White,
    Black,
}

impl PixelColor for Paper {
    type Raw = RawU1;
}

/// The color of the page `docs/displays.md`.
#[derive(Clone, Copy, PartialEq)]
struct Ink(bool);

impl PixelColor for Ink {
    type Raw = RawU1;
}

impl DisplayColor for Ink {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self(quantizer.level(light.luminance(), 1) == 0)
    }
}

impl From<Ink> for Paper {
    fn from(Ink(is_dark): Ink) -> Self {
        if is_dark { Self::Black } else { Self::White }
    }
}

#[test]
fn colors_of_other_crates_are_converted() {
    let count = (SMALL.width * SMALL.height) as usize;
    for dither in [Dither::None, Dither::Ordered] {
        with_renderer(&CLASSIC, Settings { dither, ..SMALL }, |renderer| {
            let mut panel = Screen::<Paper>::blank(Size::new(SMALL.width, SMALL.height));
            let mut line = [Ink(false); SMALL.width as usize];
            renderer.draw(&mut panel.color_converted::<Ink>(), &mut line).expect("drawn");
            let mut expected = vec![BinaryColor::Off; count];
            renderer.lines(0, &mut expected, &mut ()).expect("lines");
            let white = expected.iter().filter(|color| color.is_on()).count();
            assert!((count / 10..count).contains(&white), "{white} of {count}");
            for (paper, expected) in panel.picture().into_iter().zip(expected) {
                assert_eq!(paper == Paper::White, expected.is_on());
            }
        });
    }
}
