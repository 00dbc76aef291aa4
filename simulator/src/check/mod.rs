//! Checks whether a scene can be drawn and whether it fits a board.
//!
//! The memory and the rays of a scene are computed. Flash and time are estimated from the counts of `cargo
//! boards --bench` on emulated boards (`firmware/boards.json`). `cargo boards --scene` measures a scene
//! exactly.
//!
//! The rays of a large picture are those of some of its pixels, evenly spread over it: [`MOST_PIXELS`].
//!
//! The time is a product of three factors: the instructions of a ray on an M4F, for the shapes and the number
//! of objects of the scene; the ratio of instructions on an M3 or M0, in fixed point, to those on an M4F, for
//! a ray of `classic`; and the cycles of an instruction on a Pico. Only the cycles of a Pico are counted.
//! Other boards may take more, most of all where they wait for flash.

mod boards;
mod counted;
mod rays;

use core::fmt;
use core::sync::atomic::{AtomicUsize, Ordering};

use rayline::math::Fixed;
use rayline::shape::Shape;
use rayline::{Object, RayCounts, Real, Renderer, Scene, SceneError, Settings};

use rayon::prelude::*;

pub use boards::{BOARDS, Board};
use counted::Counted;
pub use rays::most_rays;

use crate::distinct::distinct;
use crate::picture::{memory_for, prepared, seen};
use crate::table::{Table, thousands};
use crate::{Number, RenderError};

/// Checks whether a scene can be drawn.
///
/// # Errors
/// The fault of the scene.
pub fn check(scene: &Scene<'_>) -> Result<(), SceneError> {
    let kept = distinct(scene);
    let seen = seen(scene, kept.as_deref());
    match prepared::<f32>(scene, &seen, &mut memory_for::<f32>(&seen)) {
        Err(RenderError::Scene(error)) => Err(error),
        _ => Ok(()),
    }
}

/// The resources of a board that a scene takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// The board.
    pub board: &'static Board,
    /// A lower bound on flash, in bytes: the code, with those kinds of the scene's shapes that were measured,
    /// and the scene.
    pub flash: u64,
    /// An estimate of RAM without the stack, in bytes: the prepared scene with the pointers of this machine,
    /// and a line of 16-bit colors. Meshes are baked into flash.
    pub ram: u64,
    /// An estimate of the stack, in bytes.
    pub stack: u64,
    /// The distance of the columns and of the lines whose pixels were traced: 1 for all pixels.
    pub step: u32,
    /// The mean number of rays of a pixel.
    pub mean_rays: f64,
    /// The rays of the traced pixel that takes most.
    pub worst_rays: u32,
    /// A bound on the rays of a pixel, wherever the camera is.
    pub most_rays: u64,
    /// An estimate of the time for a picture, in seconds.
    pub seconds: f64,
}

impl Demand {
    fn new(
        scene: &Scene<'_>,
        description_bytes: u64,
        board: &'static Board,
        settings: Settings,
        traced: &Traced,
    ) -> Self {
        let counted = Counted::new(board.core);
        let pixels = f64::from(settings.width) * f64::from(settings.height);
        Self {
            board,
            flash: counted.code(scene) + description_bytes + traced.baked_bytes,
            ram: traced.prepared_bytes + u64::from(settings.width) * 2,
            stack: counted.stack(scene),
            step: traced.step,
            mean_rays: traced.mean_rays,
            worst_rays: traced.worst_rays,
            most_rays: most_rays(scene, settings),
            seconds: counted.cycles_per_ray(scene) * traced.mean_rays * pixels / (board.megahertz * 1e6),
        }
    }

    /// Whether the board has enough flash and RAM.
    pub fn fits(&self) -> bool {
        self.flash <= self.board.flash && self.ram + self.stack <= self.board.ram
    }
}

/// The memory and rays of a picture in one number system, found by tracing it.
struct Traced {
    prepared_bytes: u64,
    baked_bytes: u64,
    step: u32,
    worst_rays: u32,
    mean_rays: f64,
}

/// The most pixels of a picture that are traced for an estimate.
const MOST_PIXELS: u64 = 1 << 19;

/// The smallest distance of columns and lines that leaves at most [`MOST_PIXELS`] pixels of a picture.
fn step(width: u32, height: u32) -> u32 {
    let left = |step: u32| u64::from(width.div_ceil(step)) * u64::from(height.div_ceil(step));
    (1..=u32::from(u16::MAX)).find(|step| left(*step) <= MOST_PIXELS).unwrap_or(1)
}

impl Traced {
    /// Traces in several threads, and calls `progress` with the part of the picture that is done.
    fn new<R: Real>(
        scene: &Scene<'_>,
        settings: Settings,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Self, RenderError> {
        let of_mesh = |object: &Object<Shape<'_>>| match &object.shape {
            Shape::Mesh(mesh) => mesh.const_bytes::<R>() as u64,
            _ => 0,
        };
        let baked_bytes: u64 = scene.objects.iter().map(of_mesh).sum();
        let prepared_bytes = scene.bytes::<R>() as u64 - baked_bytes;
        // A board has all objects of the scene, but the rays are the same without the repeated ones.
        let kept = distinct(scene);
        let seen = seen(scene, kept.as_deref());
        let mut memory = memory_for::<R>(&seen);
        let prepared = prepared::<R>(scene, &seen, &mut memory)?;
        let renderer = Renderer::new(&prepared, settings).map_err(RenderError::Settings)?;
        let step = step(settings.width, settings.height);
        let every = |side: u32| (0..side as u16).step_by(step as usize);
        let lines: Vec<u16> = every(settings.height).collect();
        let done = AtomicUsize::new(0);
        let counts = lines.par_iter().map(|y| {
            let rays = every(settings.width).map(|x| {
                // The probe of pictures: with another one the tracer would be compiled once more.
                let (_, rays) = renderer.pixel(x, *y, &mut RayCounts::default());
                (rays, u64::from(rays), 1)
            });
            let counts = rays.fold((0, 0, 0), both);
            progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / lines.len() as f64);
            counts
        });
        let (worst_rays, rays, pixels) = counts.reduce(|| (0, 0, 0), both);
        let mean_rays = rays as f64 / pixels.max(1) as f64;
        Ok(Self { prepared_bytes, baked_bytes, step, worst_rays, mean_rays })
    }
}

/// Joins two groups of pixels: the most rays of one, the rays of all, and their number.
fn both(a: (u32, u64, u64), b: (u32, u64, u64)) -> (u32, u64, u64) {
    (a.0.max(b.0), a.1 + b.1, a.2 + b.2)
}

/// An estimate of the flash that the description takes, in bytes: the size of its `.rayline` file, where most
/// numbers take as many bytes as in memory.
fn description_bytes(scene: &Scene<'_>) -> u64 {
    rayline_scenes::to_bytes(scene).map_or(0, |bytes| bytes.len() as u64)
}

/// The resources that a scene takes of several boards; displayed as a table.
#[derive(Clone, Debug)]
pub struct Demands(pub Vec<Demand>);

impl Demands {
    /// Estimates the resources for a picture with these settings. The picture is traced once for each number
    /// system.
    ///
    /// # Errors
    /// The scene cannot be drawn in a board's number system, or not with these settings.
    pub fn new(
        scene: &Scene<'_>,
        boards: impl IntoIterator<Item = &'static Board>,
        settings: Settings,
    ) -> Result<Self, RenderError> {
        Self::watched(scene, boards, settings, &|_, _| ())
    }

    /// Estimates like [`new`](Self::new), and calls `progress` with the number system that is traced and the
    /// part of its picture that is done.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn watched(
        scene: &Scene<'_>,
        boards: impl IntoIterator<Item = &'static Board>,
        settings: Settings,
        progress: &(dyn Fn(Number, f64) + Sync),
    ) -> Result<Self, RenderError> {
        let boards: Vec<_> = boards.into_iter().collect();
        Self::of(scene, &boards, settings, progress)
    }

    /// Is not generic, so that the tracer is compiled with this library.
    fn of(
        scene: &Scene<'_>,
        boards: &[&'static Board],
        settings: Settings,
        progress: &(dyn Fn(Number, f64) + Sync),
    ) -> Result<Self, RenderError> {
        let description_bytes = description_bytes(scene);
        let (mut float, mut fixed) = (None, None);
        let demand = |board: &'static Board| {
            let (known, trace, number): (_, fn(_, _, _) -> _, _) = match board.core.has_fpu() {
                true => (&mut float, Traced::new::<f32>, Number::F32),
                false => (&mut fixed, Traced::new::<Fixed>, Number::Fixed),
            };
            let traced = match known {
                Some(traced) => traced,
                None => known.insert(trace(scene, settings, &|part| progress(number, part))?),
            };
            Ok(Demand::new(scene, description_bytes, board, settings, traced))
        };
        boards.iter().copied().map(demand).collect::<Result<_, _>>().map(Self)
    }
}

impl fmt::Display for Demands {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let heads = [
            "board",
            "chip",
            "number",
            "flash, at least",
            "of",
            "RAM, about",
            "stack, about",
            "of",
            "s a frame",
            "fits",
        ];
        let mut table = Table::new(3, heads);
        for demand in &self.0 {
            let Demand { board, flash, ram, stack, seconds, .. } = demand;
            let kilobytes = |bytes: u64| format!("{} KB", thousands(bytes.div_ceil(1024)));
            table.push([
                board.name.to_owned(),
                board.chip.to_owned(),
                if board.core.has_fpu() { "f32" } else { "fixed" }.to_owned(),
                kilobytes(*flash),
                kilobytes(board.flash),
                kilobytes(*ram),
                kilobytes(*stack),
                kilobytes(board.ram),
                if *seconds < 10.0 { format!("{seconds:.2}") } else { format!("{seconds:.0}") },
                if demand.fits() { "yes" } else { "no" }.to_owned(),
            ]);
        }
        table.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An earlier version traced each of four thousand million pixels.
    #[test]
    fn some_pixels_of_large_pictures_are_traced() {
        assert_eq!([step(640, 480), step(1280, 720), step(65535, 65535), step(65535, 1)], [1, 2, 91, 1]);
    }
}
