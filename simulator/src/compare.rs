//! The same scene by ray tracing and by scan conversion, side by side.

use core::fmt;
use cpu_time::ThreadTime;
use rayline::math::Fixed;
use rayline::{
    Event, Light16, PreparedScene, PreviewFacet, PreviewPixel, Probe, RayCounts, RayKind, Real, Renderer,
    Scene, Settings,
};

use crate::picture::{memory_for, pool};
use crate::plot::{Curve, Plot, svg};
use crate::preview::{Facets, draw_lines};
use crate::table::{Table, thousands};
use crate::{Mode, Number, Picture, RenderError, RenderOptions, render};

/// What ray tracing and scan conversion make of a scene, and what it takes them.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The traced picture on the left, the other one on the right.
    pub picture: Picture,
    /// Whether both show the same objects.
    pub visibility: Visibility,
    /// From an eighth of the picture's width and height to all of it.
    pub by_pixels: Vec<Costs>,
    /// From an eighth of the scene's objects to all of them.
    pub by_objects: Vec<Costs>,
}

/// The pixels in whose centers ray tracing and scan conversion see the same object, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Visibility {
    /// The pixels of the picture.
    pub pixels: usize,
    /// Those that show different objects.
    pub differ: usize,
    /// Those that show different objects, and whose eight neighbors show the same one when they are traced.
    pub differ_inside: usize,
}

/// One picture in both ways, on one thread.
#[derive(Clone, Copy, Debug)]
pub struct Costs {
    /// The objects of the scene.
    pub objects: usize,
    /// The width and height of the picture.
    pub size: (u32, u32),
    /// The rays that are traced.
    pub rays: u64,
    /// The facets that are seen.
    pub facets: usize,
    /// Of ray tracing.
    pub traced: Cost,
    /// Of scan conversion, with the time to make facets.
    pub scanned: Cost,
}

/// The cost of one picture.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// The shortest processor time of some, without that of preparing the scene.
    pub seconds: f64,
    /// Memory of the prepared scene, of facets, and of one line in 16-bit colors.
    pub bytes: usize,
}

/// The times that each picture is drawn.
const RUNS: usize = 3;

impl Comparison {
    /// How many pictures are drawn in both ways: calls of `done`.
    pub const STEPS: u64 = 9;

    /// Draws a scene in both ways, smaller pictures of it, and scenes of its first objects. `done` is called
    /// after each.
    ///
    /// # Errors
    /// The scene or an option is refused; or there are too many facets.
    pub fn measure(scene: &Scene<'_>, options: &RenderOptions, done: &dyn Fn()) -> Result<Self, RenderError> {
        match options.number {
            Number::F32 => Self::measure_in::<f32>(scene, options, done),
            Number::Fixed => Self::measure_in::<Fixed>(scene, options, done),
            Number::F64 => Self::measure_in::<f64>(scene, options, done),
        }
    }

    fn measure_in<R: Real>(
        scene: &Scene<'_>,
        options: &RenderOptions,
        done: &dyn Fn(),
    ) -> Result<Self, RenderError> {
        let picture = beside(
            &render(scene, &RenderOptions { mode: Mode::Exact, ..options.clone() })?,
            &render(scene, &RenderOptions { mode: Mode::Preview, ..options.clone() })?,
        );
        let settings = options.settings;
        let visibility = seen::<R>(scene, settings, options.segments)?;
        done();
        let costs = |scene: &Scene<'_>, settings: Settings| {
            let one = RenderOptions { threads: 1, ..options.clone() };
            // On one thread, also what the renderer of the desktop would share.
            let costs = pool(&one)?.install(|| costs::<R>(scene, settings, options.segments));
            done();
            costs
        };
        let smaller = |shift: u32| Settings {
            width: (settings.width >> shift).max(1),
            height: (settings.height >> shift).max(1),
            ..settings
        };
        let by_pixels = [3, 2, 1, 0].map(|shift| costs(scene, smaller(shift)));
        let parts = [3, 2, 1, 0].map(|shift| {
            let objects = scene.objects.get(..scene.objects.len() >> shift).unwrap_or_default();
            let shown = |light: &&rayline::Light| !matches!(light, rayline::Light::Object { .. });
            let lights: Vec<_> = scene.lights.iter().filter(shown).copied().collect();
            let part = Scene { objects, motions: &[], ..*scene };
            // Lamps and motions name objects, which a part of them may lack.
            let part = if shift == 0 { *scene } else { Scene { lights: &lights, ..part } };
            costs(&part, settings)
        });
        let collect =
            |costs: [Result<Costs, RenderError>; 4]| costs.into_iter().collect::<Result<Vec<_>, _>>();
        let mut by_objects = collect(parts)?;
        by_objects.dedup_by_key(|costs| costs.objects);
        by_objects.retain(|costs| costs.objects > 0);
        Ok(Self { picture, visibility, by_pixels: collect(by_pixels)?, by_objects })
    }

    /// The times as two plots beside each other with logarithmic axes, in the format SVG.
    pub fn plot(&self) -> String {
        let plot = |across, costs: &[Costs], number: fn(&Costs) -> f64| {
            let ticks = costs.iter().map(|costs| (number(costs), thousands(number(costs) as u64))).collect();
            let curve = |name, color, cost: fn(&Costs) -> Cost| Curve {
                name,
                color,
                values: costs.iter().map(|costs| cost(costs).seconds * 1e3).collect(),
            };
            let curves = vec![
                curve("tracing", "#1f77b4", |costs| costs.traced),
                curve("scanning", "#d62728", |costs| costs.scanned),
            ];
            Plot { across, ticks, power: &|power| format!("{} ms", 10f64.powi(power)), curves }
        };
        let pixels = |costs: &Costs| f64::from(costs.size.0) * f64::from(costs.size.1);
        svg(&[
            plot("pixels", &self.by_pixels, pixels),
            plot("objects", &self.by_objects, |costs| costs.objects as f64),
        ])
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let heads = [
            "size",
            "objects",
            "rays",
            "facets",
            "tracing",
            "scanning",
            "ratio",
            "RAM, tracing",
            "RAM, scanning",
        ];
        let mut table = Table::new(1, heads);
        for costs in self.by_pixels.iter().chain(self.by_objects.iter().rev().skip(1).rev()) {
            let Costs { objects, size: (width, height), rays, facets, traced, scanned } = *costs;
            let milliseconds = |cost: Cost| format!("{:.2} ms", cost.seconds * 1e3);
            let bytes = |cost: Cost| format!("{} B", thousands(cost.bytes as u64));
            table.push([
                format!("{width}x{height}"),
                thousands(objects as u64),
                thousands(rays),
                thousands(facets as u64),
                milliseconds(traced),
                milliseconds(scanned),
                format!("{:.2}", traced.seconds / scanned.seconds),
                bytes(traced),
                bytes(scanned),
            ]);
        }
        let Visibility { pixels, differ, differ_inside } = self.visibility;
        let percent = |count: usize| 100.0 * count as f64 / pixels.max(1) as f64;
        writeln!(f, "{table}")?;
        writeln!(
            f,
            "{:.2} % of the pixels show another object by scan conversion; {:.2} % do so away from edges.",
            percent(differ),
            percent(differ_inside)
        )
    }
}

/// Two pictures of the same size beside each other.
fn beside(left: &Picture, right: &Picture) -> Picture {
    let line = (left.width as usize * 3).max(1);
    let lines = left.rgb.chunks(line).zip(right.rgb.chunks(line));
    let rgb = lines.flat_map(|(left, right)| [left, right].concat()).collect();
    Picture { width: left.width * 2, rgb, ..left.clone() }
}

/// The costs of one picture in both ways.
fn costs<R: Real>(scene: &Scene<'_>, settings: Settings, segments: u16) -> Result<Costs, RenderError> {
    let mut memory = memory_for::<R>(scene);
    let prepared_bytes = memory.len();
    let prepared = PreparedScene::<R, _>::new(scene, &mut memory).map_err(RenderError::Scene)?;
    let renderer = Renderer::new(&prepared, settings).map_err(RenderError::Settings)?;
    let (width, height) = (renderer.width(), renderer.height());
    let mut lights = vec![Light16::BLACK; width as usize * height as usize];
    let (mut rays, mut facets) = (RayCounts::default(), Facets::new());
    let (mut traced, mut scanned, mut seen) = (f64::MAX, f64::MAX, 0);
    for _ in 0..RUNS {
        rays = RayCounts::default();
        let start = ThreadTime::now();
        renderer.lines(0, &mut lights, &mut ()).map_err(RenderError::Line)?;
        traced = traced.min(start.elapsed().as_secs_f64());
        // Grows its memory before the time begins.
        seen = facets.preview(&renderer, segments).map_err(RenderError::Preview)?.facets();
        let start = ThreadTime::now();
        let mut preview = facets.preview(&renderer, segments).map_err(RenderError::Preview)?;
        draw_lines(&mut preview, &renderer, 0..height, &mut lights, &|| ()).map_err(RenderError::Line)?;
        scanned = scanned.min(start.elapsed().as_secs_f64());
    }
    // Counting takes time, too.
    renderer.lines(0, &mut lights, &mut rays).map_err(RenderError::Line)?;
    let line = 2 * width as usize;
    let preview = seen * size_of::<PreviewFacet>() + width as usize * size_of::<PreviewPixel>();
    Ok(Costs {
        objects: scene.objects.len(),
        size: (width, height),
        rays: rays.total(),
        facets: seen,
        traced: Cost { seconds: traced, bytes: prepared_bytes + line },
        scanned: Cost { seconds: scanned, bytes: prepared_bytes + line + preview },
    })
}

/// The object that a camera ray meets.
#[derive(Default)]
struct Met(Option<usize>);

impl<R> Probe<R> for Met {
    fn record(&mut self, event: Event<R>) {
        if let Event::Hit { kind: RayKind::Camera, hit, .. } = event {
            self.0 = Some(hit.object);
        }
    }
}

/// The objects that both ways see.
fn seen<R: Real>(scene: &Scene<'_>, settings: Settings, segments: u16) -> Result<Visibility, RenderError> {
    // One ray through the center of each pixel, without bounces.
    let settings = Settings { bounces: 0, ..Settings::new(settings.width, settings.height) };
    let mut memory = memory_for::<R>(scene);
    let prepared = PreparedScene::<R, _>::new(scene, &mut memory).map_err(RenderError::Scene)?;
    let renderer = Renderer::new(&prepared, settings).map_err(RenderError::Settings)?;
    let mut facets = Facets::new();
    let mut preview = facets.preview(&renderer, segments).map_err(RenderError::Preview)?;
    let (width, height) = (renderer.width() as usize, renderer.height() as usize);
    let (mut traced, mut scanned) = (Vec::new(), Vec::new());
    let mut pixels = vec![PreviewPixel::BLANK; width];
    for y in 0..height {
        traced.extend((0..width).map(|x| {
            let mut met = Met::default();
            renderer.pixel(x as u16, y as u16, &mut met);
            met.0
        }));
        preview.scan(y as u16, &mut pixels);
        scanned.extend(pixels.iter().map(|pixel| preview.object(*pixel)));
    }
    let near = |place: usize, length: usize| place.saturating_sub(1)..(place + 2).min(length);
    let is_inside = |x: usize, y: usize| {
        near(y, height)
            .flat_map(|v| near(x, width).map(move |u| v * width + u))
            .all(|near| traced.get(near) == traced.get(y * width + x))
    };
    let others = || {
        let pairs = traced.iter().zip(&scanned).enumerate();
        pairs.filter(|(_, (traced, scanned))| traced != scanned).map(|(place, _)| place)
    };
    let differ_inside = others().filter(|place| is_inside(place % width, place / width)).count();
    Ok(Visibility { pixels: width * height, differ: others().count(), differ_inside })
}
