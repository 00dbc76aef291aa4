//! One scene, drawn by the accelerated program and by the one without acceleration.

use core::fmt::{self, Debug};
use core::mem::MaybeUninit;

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Point, Size};
use embedded_graphics::pixelcolor::{PixelColor, raw::RawU24};
use embedded_graphics::primitives::Rectangle;
use rayline::shape::Shape;
use rayline::{
    AreaLights, Contours, DisplayColor, Frame, Gooch, Integrator, Light16, LinearRgb, Look, PixelSum,
    PreparedScene, Quantizer, RayCounts, Real, Realtime, RealtimeBuffer, Renderer, Sample, Scene, Settings,
    Tones,
};

use crate::case::Portions;

/// The light of a pixel, with 16 bits a channel: a difference that a display does not show is one too.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Light(pub [u32; 3]);

impl Light {
    /// No pixel was drawn.
    pub const NONE: Self = Self([u32::MAX; 3]);
}

impl Debug for Light {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::NONE { f.write_str("not drawn") } else { self.0.fmt(f) }
    }
}

impl PixelColor for Light {
    type Raw = RawU24;
}

impl rayline_plain::DisplayColor for Light {
    fn from_light(light: rayline_plain::Light16, _: &rayline_plain::Quantizer) -> Self {
        Self([light.r, light.g, light.b])
    }
}

impl DisplayColor for Light {
    fn from_light(light: Light16, _: &Quantizer) -> Self {
        Self([light.r, light.g, light.b])
    }
}

/// Memory that executions use one after the other.
#[derive(Debug, Default)]
pub(crate) struct Room {
    memory: Vec<MaybeUninit<u8>>,
    lists: Vec<MaybeUninit<u8>>,
    samples: Vec<Sample>,
    colors: Vec<Light>,
}

/// At least so many bytes of `memory`.
fn lend(memory: &mut Vec<MaybeUninit<u8>>, bytes: usize) -> &mut [MaybeUninit<u8>] {
    if memory.len() < bytes {
        memory.resize(bytes, MaybeUninit::uninit());
    }
    memory
}

/// The reason why a program did not draw.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Stop {
    /// The scene is refused, with this message.
    Refused(String),
    /// The program broke a promise.
    Broken(String),
}

/// A display that notices pixels that are drawn twice or not at all.
struct Canvas<'p> {
    width: u32,
    pixels: &'p mut [Light],
    is_twice: bool,
}

impl OriginDimensions for Canvas<'_> {
    fn size(&self) -> Size {
        Size::new(self.width, (self.pixels.len() as u32).checked_div(self.width).unwrap_or(0))
    }
}

impl DrawTarget for Canvas<'_> {
    type Color = Light;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Light>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        for Pixel(Point { x, y }, light) in pixels {
            let at = y as usize * self.width as usize + x as usize;
            match self.pixels.get_mut(at) {
                Some(pixel) if *pixel == Light::NONE && (x as u32) < self.width => *pixel = light,
                _ => self.is_twice = true,
            }
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = Light>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Self::Error> {
        let width = area.size.width.max(1);
        let points = (0..).map(|i: u32| area.top_left + Point::new((i % width) as i32, (i / width) as i32));
        self.draw_iter(points.zip(colors).map(|(point, color)| Pixel(point, color)))
    }
}

/// Prepares a scene in memory of just the size that it asks for.
fn prepare<'m, R: Real>(
    scene: &Scene<'m>,
    memory: &'m mut Vec<MaybeUninit<u8>>,
) -> Result<PreparedScene<'m, R>, Stop> {
    let memory = lend(memory, scene.bytes::<R>());
    PreparedScene::new(scene, memory).map_err(|error| match error.part {
        rayline::Part::Memory => Stop::Broken(format!("memory that `bytes` asks for is too little: {error}")),
        _ => Stop::Refused(error.to_string()),
    })
}

fn broken(error: impl fmt::Display) -> Stop {
    Stop::Broken(error.to_string())
}

/// Draws the exact picture with all acceleration.
///
/// # Errors
/// The scene is refused.
pub(crate) fn accelerated<R: Real>(
    scene: &Scene<'_>,
    settings: Settings,
    portions: Portions,
    room: &mut Room,
    picture: &mut Vec<Light>,
) -> Result<(), Stop> {
    let prepared = prepare::<R>(scene, &mut room.memory)?;
    let renderer = Renderer::new(&prepared, settings).map_err(broken)?;
    draw(&renderer, portions, &mut room.colors, picture)
}

/// Draws the exact picture without candidates and hierarchy of objects, but with those inside of meshes
/// and instances: tells one kind of difference from the other.
///
/// # Errors
/// The scene is refused.
pub(crate) fn half_accelerated<R: Real>(
    scene: &Scene<'_>,
    settings: Settings,
    room: &mut Room,
    picture: &mut Vec<Light>,
) -> Result<(), Stop> {
    let prepared = prepare::<R>(scene, &mut room.memory)?.without_acceleration();
    let renderer = Renderer::new(&prepared, settings).map_err(broken)?;
    draw(&renderer, Portions::All, &mut room.colors, picture)
}

fn draw<R: Real>(
    renderer: &Renderer<'_, '_, R>,
    portions: Portions,
    buffer: &mut Vec<Light>,
    picture: &mut Vec<Light>,
) -> Result<(), Stop> {
    let (width, height) = (renderer.width(), renderer.height());
    let pixels = width as usize * height as usize;
    picture.clear();
    picture.resize(pixels, Light::NONE);
    match portions {
        _ if pixels == 0 => {}
        Portions::All => renderer.lines(0, picture, &mut ()).map_err(broken)?,
        Portions::Lines => {
            for (y, line) in (0..).zip(picture.chunks_mut(width as usize)) {
                renderer.lines(y, line, &mut ()).map_err(broken)?;
            }
        }
        Portions::Passes => {
            let mut sums = vec![PixelSum::EMPTY; pixels];
            while !sums.iter().all(PixelSum::is_complete) {
                for (index, (pixel, sum)) in picture.iter_mut().zip(&mut sums).enumerate() {
                    let (x, y) = (index as u32 % width, index as u32 / width);
                    *pixel = renderer.refine(x as u16, y as u16, sum, &mut ());
                }
            }
        }
        Portions::Steps { rays, lines } => {
            buffer.clear();
            buffer.resize(width as usize * lines.max(1) as usize, Light::NONE);
            let mut canvas = Canvas { width, pixels: picture, is_twice: false };
            let mut frame = renderer.frame(0..height, &mut buffer[..]).map_err(broken)?;
            while !frame.step(&mut canvas, rays).map_err(broken)?.is_done() {}
            if canvas.is_twice {
                return Err(Stop::Broken("a pixel was sent twice".to_owned()));
            }
        }
    }
    Ok(())
}

/// Draws the picture in realtime quality, at once and, where the budget of the frame has no bound, once
/// more in bands and steps.
///
/// # Errors
/// A pixel was left out or drawn twice, steps or bands change the picture, or a budget was exceeded.
pub(crate) fn realtime<R: Real>(
    scene: &Scene<'_>,
    settings: Settings,
    quality: Realtime,
    room: &mut Room,
    pictures: &mut [Vec<Light>; 2],
) -> Result<(), Stop> {
    let Room { memory, samples, colors, .. } = room;
    let prepared = prepare::<R>(scene, memory)?;
    let renderer = Renderer::new(&prepared, settings).map_err(broken)?;
    let (width, height) = (renderer.width(), renderer.height());
    for picture in pictures.iter_mut() {
        picture.clear();
        picture.resize(width as usize * height as usize, Light::NONE);
    }
    colors.clear();
    colors.resize(quality.colors(width as u16), Light::NONE);
    samples.clear();
    samples.resize(quality.samples(width as u16), Sample::BLANK);
    let mut frame = renderer.frame(0..height, quality.lend(colors, samples)).map_err(broken)?;
    let mut counts = RayCounts::default();
    let [at_once, in_steps] = pictures;
    let mut canvas = Canvas { width, pixels: at_once, is_twice: false };
    while !frame.step_watched(&mut canvas, u32::MAX, &mut counts).map_err(broken)?.is_done() {}
    let mut is_twice = canvas.is_twice;
    let rays = counts.total();
    let most = u64::from(quality.budget_rays) + u64::from(settings.rays_per_pixel);
    if rays > most {
        return Err(Stop::Broken(format!(
            "a frame of realtime quality took {rays} rays, and {most} are allowed"
        )));
    }
    if quality.budget_rays == u32::MAX {
        let mut canvas = Canvas { width, pixels: in_steps, is_twice: false };
        let side = quality.grid.pixels() as u32;
        // Pixels of a cell and its sides, twice, and once more with smooth edges.
        let beyond = (side + 1).pow(2).saturating_mul(3).saturating_mul(settings.rays_per_pixel);
        // Contours take up to 3 rays a pixel and sample, and a few for each square.
        let ink = (side + 1).pow(2).saturating_mul(4).saturating_mul(settings.sampling.samples.into());
        let beyond = if settings.look.contours.is_some() { beyond.saturating_add(ink) } else { beyond };
        draw_bands(&mut frame, height, beyond, &mut canvas)?;
        is_twice |= canvas.is_twice;
        if let Some(at) = differing(at_once, in_steps) {
            let (x, y) = (at as u32 % width, at as u32 / width);
            return Err(Stop::Broken(format!("bands and steps change pixel {x},{y} in realtime quality")));
        }
    }
    if is_twice || at_once.contains(&Light::NONE) {
        return Err(Stop::Broken("realtime quality drew a pixel twice or not at all".to_owned()));
    }
    Ok(())
}

/// Draws a picture in realtime quality in bands that do not begin where cells do, the lowest first, and in
/// steps, each of which may take `beyond` rays more than its budget.
fn draw_bands<R: Real>(
    frame: &mut Frame<'_, '_, R, Shape<'_>, RealtimeBuffer<'_, Light>>,
    height: u32,
    beyond: u32,
    canvas: &mut Canvas<'_>,
) -> Result<(), Stop> {
    let bands = (0..height).rev().filter(|top| top % 3 == 0).map(|top| top..(top + 3).min(height));
    for (lines, budget) in bands.zip([0, 5, 100].into_iter().cycle()) {
        frame.set_lines(lines).map_err(broken)?;
        loop {
            let progress = frame.step_watched(canvas, budget, &mut RayCounts::default()).map_err(broken)?;
            let rays = progress.rays;
            if rays >= budget.max(1).saturating_add(beyond) {
                let reason = format!("a step of {budget} rays took {rays} in realtime quality");
                return Err(Stop::Broken(reason));
            }
            if progress.is_done() {
                break;
            }
        }
    }
    Ok(())
}

/// The first pixel that differs.
pub(crate) fn differing(one: &[Light], other: &[Light]) -> Option<usize> {
    one.iter().zip(other).position(|(one, other)| one != other)
}

/// Draws the exact picture by the program without acceleration, pixel by pixel, and checks each before it
/// is cut to what a display can show.
///
/// # Errors
/// The scene is refused; a pixel that is not finite or took too many rays.
pub(crate) fn plain<R: rayline_plain::Real>(
    bytes: &[u8],
    settings: Settings,
    room: &mut Room,
    picture: &mut Vec<Light>,
) -> Result<(), Stop> {
    // Lists take a few times as much memory as their bytes.
    let lists = lend(&mut room.lists, bytes.len().saturating_mul(40).saturating_add(4096));
    let scene = rayline_plain::Scene::from_bytes(bytes, lists).map_err(broken)?;
    let memory = lend(&mut room.memory, scene.bytes::<R>());
    let prepared = rayline_plain::PreparedScene::<R>::new(&scene, memory);
    let prepared = prepared.map_err(|error| Stop::Refused(error.to_string()))?;
    let Settings { width, height, bounces, rays_per_pixel, cutoff, sampling, .. } = settings;
    let Settings { integrator, area_lights, look, .. } = settings;
    let settings = rayline_plain::Settings::new(width, height);
    let settings = rayline_plain::Settings { bounces, rays_per_pixel, cutoff, ..settings };
    let sampling = rayline_plain::Sampling::new(sampling.samples);
    let integrator = match integrator {
        Integrator::PathTracing => rayline_plain::Integrator::PathTracing,
        _ => rayline_plain::Integrator::Whitted,
    };
    let area_lights = match area_lights {
        AreaLights::ClosedForm => rayline_plain::AreaLights::ClosedForm,
        _ => rayline_plain::AreaLights::Sampled,
    };
    let look = plain_look(look);
    let settings = rayline_plain::Settings { sampling, integrator, area_lights, look, ..settings };
    let renderer = rayline_plain::Renderer::new(&prepared, settings).map_err(broken)?;
    picture.clear();
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let (light, rays) = renderer.pixel(x as u16, y as u16, &mut ());
        let seen = light.to_f32();
        if !seen.channels().iter().all(|channel| channel.is_finite() && *channel >= 0.0) {
            return Err(Stop::Broken(format!("the light of pixel {x},{y} is {:?}", seen.channels())));
        }
        if rays > rays_per_pixel {
            return Err(Stop::Broken(format!("pixel {x},{y} took {rays} rays of {rays_per_pixel}")));
        }
        picture.push(Light([light.r, light.g, light.b].map(R::to_q16)));
    }
    if settings.look.contours.is_some() {
        renderer.lines(0, picture, &mut ()).map_err(broken)?;
    }
    Ok(())
}

/// The look for the program without acceleration.
fn plain_look(look: Look) -> rayline_plain::Look {
    let tones = match look.tones {
        Tones::Toon { steps } => rayline_plain::Tones::Toon { steps },
        Tones::Gooch(Gooch { blue, yellow, cool, warm }) => {
            rayline_plain::Tones::Gooch(rayline_plain::Gooch { blue, yellow, cool, warm })
        }
        _ => rayline_plain::Tones::Light,
    };
    let contours = look.contours.map(|Contours { crease, depth, ink: LinearRgb { r, g, b } }| {
        rayline_plain::Contours { crease, depth, ink: rayline_plain::LinearRgb { r, g, b } }
    });
    rayline_plain::Look { tones, contours }
}
