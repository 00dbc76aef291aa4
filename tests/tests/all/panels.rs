//! Pictures and displays of different sizes: exactly what both have in common is traced and sent, with the
//! bytes of the whole picture.

use std::fmt::Debug;
use std::mem::MaybeUninit;
use std::ops::Range;

use embedded_graphics::Drawable;
use embedded_graphics::draw_target::{DrawTarget, DrawTargetExt};
use embedded_graphics::geometry::{OriginDimensions, Point, Size};
use embedded_graphics::image::{Image, ImageDrawableExt};
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565, RgbColor};
use embedded_graphics::primitives::{PointsIter, Rectangle};
use rayline::builtin::{CLASSIC, FLAKE, PRISM};
use rayline::math::Fixed;
use rayline::{
    DisplayColor, Dither, DrawError, Pattern, PixelSum, PreparedScene, Progressive, Quality, Real, Realtime,
    Renderer, Sample, Sampling, Scene, Settings, Transfer,
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
        // They have nothing in common.
        (43, 0, 10, 10),
        (0, 29, 10, 10),
        (-10, 0, 10, 10),
        (0, 0, 0, 10),
        (0, 0, 10, 0),
    ];
    boxes.map(|(x, y, width, height)| Rectangle::new(Point::new(x, y), Size::new(width, height))).into()
}

/// A way to draw with a renderer: some lines of the picture, with a budget of rays for each step.
trait Draw<R: Real> {
    type Color: DisplayColor + Debug;

    /// How often each line is drawn.
    fn passes(&self) -> u32 {
        1
    }

    /// Draws some lines and returns the rays that they took.
    fn draw<D: DrawTarget<Color = Self::Color>>(
        &self,
        renderer: &Renderer<R>,
        display: &mut D,
        lines: Range<u32>,
        budget_rays: u32,
    ) -> Result<u32, DrawError<D::Error>>;
}

/// Draws lines in steps.
fn in_steps<R: Real, D: DrawTarget, Q: Quality<R, Color = D::Color>>(
    renderer: &Renderer<R>,
    display: &mut D,
    (lines, budget_rays): (Range<u32>, u32),
    quality: Q,
) -> Result<u32, DrawError<D::Error>> {
    let mut frame = renderer.frame(lines.clone(), quality)?;
    let mut rays = 0;
    loop {
        let progress = frame.step(display, budget_rays)?;
        rays += progress.rays;
        if progress.is_done() {
            assert_eq!(progress.lines_total, lines.len() as u32);
            return Ok(rays);
        }
    }
}

/// Exact quality, with this many pixels of memory.
struct Exact(usize);

impl<R: Real> Draw<R> for Exact {
    type Color = Rgb565;

    fn draw<D: DrawTarget<Color = Rgb565>>(
        &self,
        renderer: &Renderer<R>,
        display: &mut D,
        lines: Range<u32>,
        budget_rays: u32,
    ) -> Result<u32, DrawError<D::Error>> {
        in_steps(renderer, display, (lines, budget_rays), &mut vec![Rgb565::BLACK; self.0][..])
    }
}

/// Realtime quality, dithered to black and white.
struct InRealtime(Realtime);

impl<R: Real> Draw<R> for InRealtime {
    type Color = BinaryColor;

    fn draw<D: DrawTarget<Color = BinaryColor>>(
        &self,
        renderer: &Renderer<R>,
        display: &mut D,
        lines: Range<u32>,
        budget_rays: u32,
    ) -> Result<u32, DrawError<D::Error>> {
        let width = renderer.width() as u16;
        // Memory for a larger picture.
        let mut colors = vec![BinaryColor::Off; self.0.colors(width + 9)];
        let mut samples = vec![Sample::BLANK; self.0.samples(width + 9)];
        in_steps(renderer, display, (lines, budget_rays), self.0.lend(&mut colors, &mut samples))
    }
}

/// One sample of each pixel after the other: the number of samples.
struct InPasses(u16);

impl<R: Real> Draw<R> for InPasses {
    type Color = Rgb565;

    fn passes(&self) -> u32 {
        self.0.into()
    }

    fn draw<D: DrawTarget<Color = Rgb565>>(
        &self,
        renderer: &Renderer<R>,
        display: &mut D,
        lines: Range<u32>,
        budget_rays: u32,
    ) -> Result<u32, DrawError<D::Error>> {
        let (mut line, mut sums) = ([Rgb565::BLACK; 50], vec![PixelSum::EMPTY; 43 * 29]);
        let mut frame = renderer.frame(lines.clone(), Progressive::lend(&mut line, &mut sums))?;
        let mut rays = 0;
        let all = lines == (0..renderer.height());
        for _ in 0..self.0 {
            frame.set_lines(lines.clone())?;
            loop {
                let progress = frame.step(display, budget_rays)?;
                rays += progress.rays;
                if progress.is_done() {
                    break;
                }
            }
        }
        assert!(frame.is_refined() || !all);
        Ok(rays)
    }
}

/// Draws on displays of all sizes.
fn assert_common_part<R: Real, Q: Draw<R>>(scene: &Scene, settings: Settings, quality: &Q) {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R>::new(scene, &mut memory).expect("a legal scene");
    let renderer = Renderer::new(&prepared, settings).expect("legal settings");
    let mut whole = Screen::<Q::Color>::blank(PICTURE);
    let all_rays = quality.draw(&renderer, &mut whole, 0..29, u32::MAX).expect("drawn");
    let whole_area = Rectangle::new(Point::zero(), PICTURE);
    let color = |point: Point| whole.pixels[(point.y * 43 + point.x) as usize].expect("drawn");
    for area in displays() {
        for (lines, budget) in [(0..29, u32::MAX), (5..20, 11), (0..29, 1)] {
            let mut screen = Screen::<Q::Color>::over(area);
            let rays = quality.draw(&renderer, &mut screen, lines.clone(), budget).expect("drawn");
            let asked = Rectangle::new(Point::new(0, lines.start as i32), Size::new(43, lines.len() as u32));
            let common = area.intersection(&asked).intersection(&whole_area);
            for (point, drawn) in area.points().zip(&screen.pixels) {
                let expected = common.contains(point).then(|| color(point));
                assert_eq!(*drawn, expected, "{area:?}, {lines:?}, {point}");
            }
            let sent: u32 = screen.windows.iter().map(|window| window.size.width * window.size.height).sum();
            let pixels = common.size.width * common.size.height;
            assert_eq!(sent, pixels * quality.passes(), "{area:?}, {lines:?}");
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
            let mut screen = Screen::<Q::Color>::over(area);
            screen.pixels_until_failure = Some(pixels);
            let Err(error) = quality.draw(&renderer, &mut screen, 0..29, 7) else { continue };
            let DrawError::Display { line, error: Unplugged } = error else { panic!("{error}") };
            screen.pixels_until_failure = None;
            let line = if quality.passes() == 1 { line } else { 0 };
            quality.draw(&renderer, &mut screen, line..29, 7).expect("drawn");
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
        assert_common_part::<f32, _>(&CLASSIC, SETTINGS, &Exact(pixels));
    }
    assert_common_part::<Fixed, _>(&CLASSIC, DITHERED, &Exact(60));
    // Groups of pixels.
    assert_common_part::<f32, _>(&FLAKE, SETTINGS, &Exact(43));
    assert_common_part::<f32, _>(&FLAKE, DITHERED, &Exact(43 * 8));
    let samples = Settings { sampling: Sampling::new(4), ..SETTINGS };
    assert_common_part::<f32, _>(&PRISM, samples, &Exact(43));
}

#[test]
fn realtime_quality_draws_the_common_part() {
    for scene in [&CLASSIC, &FLAKE, &PRISM] {
        for quality in [Realtime::new(), Realtime::fine()] {
            assert_common_part::<f32, _>(scene, DITHERED, &InRealtime(quality));
            assert_common_part::<Fixed, _>(scene, DITHERED, &InRealtime(quality));
        }
    }
    assert_common_part::<f32, _>(&CLASSIC, DITHERED, &InRealtime(Realtime::new().smooth()));
}

#[test]
fn passes_draw_the_common_part() {
    let samples = Settings { sampling: Sampling::new(4), ..SETTINGS };
    assert_common_part::<f32, _>(&CLASSIC, samples, &InPasses(4));
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
