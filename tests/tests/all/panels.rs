//! Pictures and displays of different sizes: exactly what both have in common is traced and sent, with the
//! bytes of the whole picture.

use std::fmt::Debug;
use std::mem::MaybeUninit;
use std::ops::Range;

use embedded_graphics::Drawable;
use embedded_graphics::draw_target::DrawTargetExt;
use embedded_graphics::geometry::{OriginDimensions, Point, Size};
use embedded_graphics::image::{Image, ImageDrawableExt};
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565, RgbColor};
use embedded_graphics::primitives::{PointsIter, Rectangle};
use rayline::builtin::{CLASSIC, FLAKE, PRISM};
use rayline::math::Fixed;
use rayline::shape::Shape;
use rayline::{
    DisplayColor, Dither, DrawError, Frame, Pattern, PixelSum, PreparedScene, Progressive, Quality, Real,
    Realtime, Renderer, Sample, Sampling, Scene, Settings, Transfer,
};
use rayline_tests::{Screen, Unplugged};

/// The size of the picture: no multiple of a band, a cell or a byte.
const PICTURE: Size = Size::new(43, 29);

/// The bounding boxes of displays.
fn displays() -> Vec<Rectangle> {
    let boxes = [
        (0, 0, 43, 29),
        (0, 0, 64, 48),
        (0, 0, 20, 48),
        (0, 0, 16, 8),
        (0, 0, 99, 13),
        // The displays' corners lie inside the picture, on the grid of realtime quality and beside it.
        (8, 8, 99, 99),
        (13, 11, 17, 9),
        (7, 3, 1, 1),
        (42, 28, 10, 10),
        // The picture's corner lies inside the display.
        (-5, -9, 30, 30),
        (-5, -9, 300, 300),
        // Picture and display have nothing in common.
        (43, 0, 10, 10),
        (0, 29, 10, 10),
        (-10, 0, 10, 10),
        (0, 0, 0, 10),
        (0, 0, 10, 0),
    ];
    boxes.map(|(x, y, width, height)| Rectangle::new(Point::new(x, y), Size::new(width, height))).into()
}

/// Lines of a picture, and a budget of rays for each step in which they are drawn.
#[derive(Clone, Debug)]
struct Task {
    lines: Range<u32>,
    budget_rays: u32,
}

/// The rays that a task took, or the error of the display.
type Drawn = Result<u32, DrawError<Unplugged>>;

/// Draws the lines of a frame in steps.
fn in_steps<R: Real, C, Q: Quality<R, Color = C>>(
    frame: &mut Frame<'_, '_, R, Shape<'_>, Q>,
    screen: &mut Screen<C>,
    Task { lines, budget_rays }: &Task,
) -> Drawn
where
    C: DisplayColor,
{
    let mut rays = 0;
    loop {
        let progress = frame.step(screen, *budget_rays)?;
        rays += progress.rays;
        if progress.is_done() {
            assert_eq!(progress.lines_total, lines.len() as u32);
            return Ok(rays);
        }
    }
}

/// Exact quality, with this many pixels of memory.
fn exact<R: Real>(pixels: usize) -> impl Fn(&Renderer<R>, &mut Screen<Rgb565>, &Task) -> Drawn {
    move |renderer, screen, task| {
        let mut memory = vec![Rgb565::BLACK; pixels];
        in_steps(&mut renderer.frame(task.lines.clone(), &mut memory[..])?, screen, task)
    }
}

/// Realtime quality in black and white, with memory for a larger picture.
fn realtime<R: Real>(quality: Realtime) -> impl Fn(&Renderer<R>, &mut Screen<BinaryColor>, &Task) -> Drawn {
    move |renderer, screen, task| {
        let width = renderer.width() as u16 + 9;
        let mut colors = vec![BinaryColor::Off; quality.colors(width)];
        let mut samples = vec![Sample::BLANK; quality.samples(width)];
        let memory = quality.lend(&mut colors, &mut samples);
        in_steps(&mut renderer.frame(task.lines.clone(), memory)?, screen, task)
    }
}

/// One sample of each pixel after the other.
fn progressive<R: Real>(passes: u32) -> impl Fn(&Renderer<R>, &mut Screen<Rgb565>, &Task) -> Drawn {
    move |renderer, screen, task| {
        let (mut line, mut sums) = ([Rgb565::BLACK; 50], vec![PixelSum::EMPTY; 43 * 29]);
        let mut frame = renderer.frame(task.lines.clone(), Progressive::lend(&mut line, &mut sums))?;
        let mut rays = 0;
        for _ in 0..passes {
            frame.set_lines(task.lines.clone())?;
            rays += in_steps(&mut frame, screen, task)?;
        }
        assert!(frame.is_refined() || task.lines != (0..renderer.height()));
        Ok(rays)
    }
}

/// Draws on displays of all sizes, each line in this many `passes`.
fn assert_common_part<R: Real, C: DisplayColor + Debug>(
    scene: &Scene,
    settings: Settings,
    passes: u32,
    draw: impl Fn(&Renderer<R>, &mut Screen<C>, &Task) -> Drawn,
) {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R>::new(scene, &mut memory).expect("a legal scene");
    let renderer = Renderer::new(&prepared, settings).expect("legal settings");
    let mut whole = Screen::<C>::blank(PICTURE);
    let all = Task { lines: 0..29, budget_rays: u32::MAX };
    let all_rays = draw(&renderer, &mut whole, &all).expect("drawn");
    let whole_area = Rectangle::new(Point::zero(), PICTURE);
    let color = |point: Point| whole.pixels[(point.y * 43 + point.x) as usize].expect("drawn");
    let tasks = [all, Task { lines: 5..20, budget_rays: 11 }, Task { lines: 0..29, budget_rays: 1 }];
    for area in displays() {
        for task in &tasks {
            let (mut screen, lines) = (Screen::<C>::over(area), &task.lines);
            let rays = draw(&renderer, &mut screen, task).expect("drawn");
            let asked = Rectangle::new(Point::new(0, lines.start as i32), Size::new(43, lines.len() as u32));
            let common = area.intersection(&asked).intersection(&whole_area);
            for (point, drawn) in area.points().zip(&screen.pixels) {
                let expected = common.contains(point).then(|| color(point));
                assert_eq!(*drawn, expected, "{area:?}, {lines:?}, {point}");
            }
            let sent: u32 = screen.windows.iter().map(|window| window.size.width * window.size.height).sum();
            let pixels = common.size.width * common.size.height;
            assert_eq!(sent, pixels * passes, "{area:?}, {lines:?}");
            assert!(screen.windows.iter().all(|window| window.size != Size::zero()));
            if common.is_zero_sized() {
                assert_eq!((rays, screen.windows.len()), (0, 0), "{area:?}, {lines:?}");
            }
            // Half of the columns or lines take about half of the rays.
            if area.size == Size::new(20, 48) && lines.len() == 29 {
                assert!(rays < all_rays * 3 / 4, "{rays} of {all_rays} rays");
            }
        }
        // A display that fails: drawn again from the line of the error, or all passes from the first line.
        for pixels in [0, 1, 50, 200] {
            let mut screen = Screen::<C>::over(area);
            screen.pixels_until_failure = Some(pixels);
            let task = Task { lines: 0..29, budget_rays: 7 };
            let Err(error) = draw(&renderer, &mut screen, &task) else { continue };
            let DrawError::Display { line, error: Unplugged } = error else { panic!("{error}") };
            screen.pixels_until_failure = None;
            let line = if passes == 1 { line } else { 0 };
            draw(&renderer, &mut screen, &Task { lines: line..29, ..task }).expect("drawn");
            for (point, drawn) in area.points().zip(&screen.pixels) {
                assert_eq!(*drawn, whole_area.contains(point).then(|| color(point)), "{area:?}, {point}");
            }
        }
    }
}

const SETTINGS: Settings = Settings { bounces: 3, ..Settings::new(PICTURE.width, PICTURE.height) };

const DITHERED: Settings = Settings { dither: Dither::Ordered, transfer: Transfer::Linear, ..SETTINGS };

#[test]
fn exact_quality_draws_the_common_part() {
    for pixels in [43, 43 * 3, 320] {
        assert_common_part::<f32, _>(&CLASSIC, SETTINGS, 1, exact(pixels));
    }
    assert_common_part::<Fixed, _>(&CLASSIC, DITHERED, 1, exact(60));
    // Groups of pixels.
    assert_common_part::<f32, _>(&FLAKE, SETTINGS, 1, exact(43));
    assert_common_part::<f32, _>(&FLAKE, DITHERED, 1, exact(43 * 8));
    let samples = Settings { sampling: Sampling::new(4), ..SETTINGS };
    assert_common_part::<f32, _>(&PRISM, samples, 1, exact(43));
}

#[test]
fn realtime_quality_draws_the_common_part() {
    for scene in [&CLASSIC, &FLAKE, &PRISM] {
        for quality in [Realtime::new(), Realtime::fine()] {
            assert_common_part::<f32, _>(scene, DITHERED, 1, realtime(quality));
            assert_common_part::<Fixed, _>(scene, DITHERED, 1, realtime(quality));
        }
    }
    assert_common_part::<f32, _>(&CLASSIC, DITHERED, 1, realtime(Realtime::new().smooth()));
}

#[test]
fn passes_draw_the_common_part() {
    let samples = Settings { sampling: Sampling::new(4), ..SETTINGS };
    assert_common_part::<f32, _>(&CLASSIC, samples, 4, progressive(4));
}

/// Between two steps, the display turns.
#[test]
fn a_display_may_change_its_size_between_steps() {
    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()];
    let prepared = PreparedScene::<f32>::new(&CLASSIC, &mut memory).expect("a legal scene");
    let renderer = Renderer::new(&prepared, SETTINGS).expect("legal settings");
    let mut whole = Screen::<Rgb565>::blank(PICTURE);
    renderer.draw(&mut whole, &mut [Rgb565::BLACK; 43]).expect("drawn");
    let quality = Realtime::new();
    let mut colors = vec![Rgb565::BLACK; quality.colors(43)];
    let mut samples = vec![Sample::BLANK; quality.samples(43)];
    let expected = {
        let mut screen = Screen::<Rgb565>::blank(PICTURE);
        renderer.draw(&mut screen, quality.lend(&mut colors, &mut samples)).expect("drawn");
        screen.picture()
    };
    let mut frame = renderer.frame(0..29, quality.lend(&mut colors, &mut samples)).expect("a frame");
    let (mut narrow, mut screen) = (Screen::<Rgb565>::blank(Size::new(10, 29)), Screen::blank(PICTURE));
    frame.step(&mut narrow, 1).expect("a step");
    let mut progress = frame.step(&mut screen, 1).expect("a step");
    assert_eq!(progress.lines_done, 0, "the band that was begun for the narrow display is not sent");
    while !progress.is_done() {
        progress = frame.step(&mut screen, 9).expect("a step");
    }
    assert!(screen.picture() == expected);
}

/// As the documentation of `draw` says.
#[test]
fn boxes_that_begin_elsewhere_are_translated() {
    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()];
    let prepared = PreparedScene::<f32>::new(&CLASSIC, &mut memory).expect("a legal scene");
    let renderer = Renderer::new(&prepared, SETTINGS).expect("legal settings");
    let mut whole = Screen::<Rgb565>::blank(PICTURE);
    renderer.draw(&mut whole, &mut [Rgb565::BLACK; 43]).expect("drawn");
    let mut part = Screen::<Rgb565>::over(Rectangle::new(Point::new(100, 50), PICTURE));
    let top_left = part.area.top_left;
    renderer.draw(&mut part.translated(top_left), &mut [Rgb565::BLACK; 43]).expect("drawn");
    assert_eq!(part.picture(), whole.picture());
    // A window of a larger screen.
    let mut screen = Screen::<Rgb565>::blank(Size::new(60, 40));
    let area = Rectangle::new(Point::new(10, 5), Size::new(20, 15));
    renderer.draw(&mut screen.cropped(&area), &mut [Rgb565::BLACK; 43]).expect("drawn");
    for (point, drawn) in screen.area.points().zip(&screen.pixels) {
        let inside = area.contains(point).then(|| {
            let Point { x, y } = point - area.top_left;
            whole.pixels[(y * 43 + x) as usize].expect("drawn")
        });
        assert_eq!(*drawn, inside, "{point}");
    }
}

/// An image has the bytes of `draw`, wherever it is placed, and traces only what is shown.
#[test]
fn images_are_drawn_where_they_are_placed() {
    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()];
    let prepared = PreparedScene::<f32, _>::new(&CLASSIC, &mut memory).expect("a legal scene");
    let renderer = Renderer::new(&prepared, DITHERED).expect("legal settings");
    let mut whole = Screen::<Rgb565>::blank(PICTURE);
    renderer.draw(&mut whole, &mut [Rgb565::BLACK; 43]).expect("drawn");
    let picture = renderer.image::<Rgb565>();
    assert_eq!(picture.size(), PICTURE);
    let part = Rectangle::new(Point::new(9, 4), Size::new(20, 30));
    let sub_image = picture.sub_image(&part);
    for area in displays() {
        for place in [Point::zero(), Point::new(5, 3), Point::new(-8, -2), Point::new(10_000, 0)] {
            let shown = |screen: &Screen<Rgb565>, corner: Point, of: Rectangle| {
                for (point, drawn) in area.points().zip(&screen.pixels) {
                    let x = i64::from(point.x) - i64::from(place.x) + i64::from(corner.x);
                    let y = i64::from(point.y) - i64::from(place.y) + i64::from(corner.y);
                    let inside = |value: i64, from: i32, length: u32| {
                        (i64::from(from)..i64::from(from) + i64::from(length)).contains(&value)
                    };
                    let expected = (inside(x, of.top_left.x, of.size.width)
                        && inside(y, of.top_left.y, of.size.height))
                    .then(|| whole.pixels[(y * 43 + x) as usize].expect("drawn"));
                    assert_eq!(*drawn, expected, "{area:?}, {place}, {point}");
                }
            };
            let mut screen = Screen::<Rgb565>::over(area);
            Image::new(&picture, place).draw(&mut screen).expect("drawn");
            assert!(screen.windows.len() <= 1 && screen.windows.iter().all(|area| !area.is_zero_sized()));
            shown(&screen, Point::zero(), Rectangle::new(Point::zero(), PICTURE));
            let mut screen = Screen::<Rgb565>::over(area);
            Image::new(&sub_image, place).draw(&mut screen).expect("drawn");
            shown(&screen, part.top_left, part.intersection(&Rectangle::new(Point::zero(), PICTURE)));
        }
        // Patterns draw pixels of their own.
        let mut screen = Screen::<Rgb565>::over(area);
        for frame in 0..Pattern::Square.frames() {
            renderer.draw_pattern(Pattern::Square, frame, &mut screen).expect("drawn");
        }
        let mut drawn = Screen::<Rgb565>::over(area);
        renderer.draw(&mut drawn, &mut [Rgb565::BLACK; 43]).expect("drawn");
        assert!(screen.pixels == drawn.pixels, "{area:?}");
    }
}
