//! Pictures in passes: every pass adds a sample to each pixel.

use std::io;

use rayline::math::Fixed;
use rayline::{Light16, PixelSum, RayCounts, Real, Renderer, Scene};
use rayon::prelude::*;

use crate::distinct::distinct;
use crate::picture::{Lights, blank, many, memory_for, pool, prepared, seen};
use crate::{Number, Picture, RenderError, RenderOptions};

/// A pass that is complete.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// Its number, from 1 on.
    pub number: u32,
    /// The passes that there are at most.
    pub most: u32,
    /// The pixels that have all samples that they need.
    pub pixels_refined: u64,
}

/// The reason why rendering in passes ended.
#[derive(Debug)]
pub enum PassError {
    /// The scene or an option was refused.
    Render(RenderError),
    /// A pass could not be shown.
    Show(io::Error),
}

impl From<RenderError> for PassError {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}

/// Renders a whole picture in passes, and calls `pass_done` with the picture after each. The last picture has
/// the bytes of [`render`](crate::render). Nothing here is generic, so that the tracer is compiled with this
/// library, and not once more in each program.
///
/// # Errors
/// The errors of [`render`](crate::render), and those of `pass_done`.
pub fn render_in_passes(
    scene: &Scene<'_>,
    options: &RenderOptions,
    pass_done: &mut dyn FnMut(&Picture, Pass) -> io::Result<()>,
) -> Result<Picture, PassError> {
    match options.number {
        Number::F32 => passes_in::<f32>(scene, options, pass_done),
        Number::Fixed => passes_in::<Fixed>(scene, options, pass_done),
        Number::F64 => passes_in::<f64>(scene, options, pass_done),
    }
}

fn passes_in<R: Real>(
    scene: &Scene<'_>,
    options: &RenderOptions,
    pass_done: &mut dyn FnMut(&Picture, Pass) -> io::Result<()>,
) -> Result<Picture, PassError> {
    let kept = distinct(scene);
    let seen = seen(scene, kept.as_deref());
    let mut memory = memory_for::<R>(&seen);
    let prepared_bytes = memory.len();
    let prepared = prepared::<R>(scene, &seen, &mut memory)?;
    let renderer = Renderer::new(&prepared, options.settings).map_err(RenderError::Settings)?;
    let (width, height, pool) = (renderer.width(), renderer.height(), pool(options)?);
    let rgb = blank(width, height)?;
    let mut picture = Picture { width, height, rgb, rays: RayCounts::default(), prepared_bytes };
    let mut sums = many(u64::from(width) * u64::from(height), PixelSum::<R>::EMPTY)?;
    for number in 1.. {
        pool.install(|| draw(&renderer, options, &mut sums, &mut picture));
        let pixels_refined = sums.iter().filter(|sum| sum.is_complete()).count() as u64;
        let most = u32::from(options.settings.sampling.samples);
        pass_done(&picture, Pass { number, most, pixels_refined }).map_err(PassError::Show)?;
        if pixels_refined == sums.len() as u64 {
            break;
        }
    }
    Ok(picture)
}

/// Draws one pass.
fn draw<R: Real>(
    renderer: &Renderer<'_, '_, R>,
    options: &RenderOptions,
    sums: &mut [PixelSum<R>],
    picture: &mut Picture,
) {
    let width = picture.width as usize;
    let lines = sums.par_chunks_mut(width).zip(picture.rgb.par_chunks_mut(width * 3)).enumerate();
    let rays = lines.map(|(y, (sums, rgb))| {
        let mut rays = RayCounts::default();
        let pixels = sums.iter_mut().enumerate();
        let lights: Vec<Light16> =
            pixels.map(|(x, sum)| renderer.refine(x as u16, y as u16, sum, &mut rays)).collect();
        let RenderOptions { display, settings, .. } = options;
        display.color(Lights { lights: &lights, settings, first: y as u32, rgb });
        rays
    });
    picture.rays += rays.reduce(RayCounts::default, |mut a, b| {
        a += b;
        a
    });
}
