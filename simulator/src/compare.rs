//! A scene by ray tracing and by scan conversion, side by side.

use core::fmt;

use cpu_time::ThreadTime;
use rayline::math::Fixed;
use rayline::{
    Event, Light, Light16, PreparedScene, Preview, PreviewFacet, PreviewPixel, Probe, RayCounts, RayKind,
    Real, Renderer, Scene, Settings,
};

use crate::picture::{memory_for, pool};
use crate::plot::{Curve, Plot, svg};
use crate::preview::{draw_lines, facets};
use crate::table::{Table, thousands};
use crate::{Mode, Number, Picture, RenderError, RenderOptions, render};

/// The pictures of a scene by ray tracing and by scan conversion, and their costs.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The traced picture on the left, the other one on the right.
    pub picture: Picture,
    /// Whether both show the same objects.
    pub visibility: Visibility,
    /// From an eighth of the picture's width and height to all of it.
    pub by_pixels: Vec<Costs>,
    /// From an eighth of the scene's objects to all of them: the last entry is that of `by_pixels`.
    pub by_objects: Vec<Costs>,
}

/// Numbers of pixels, by the objects that ray tracing and scan conversion see in their centers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Visibility {
    /// All pixels of the picture.
    pub pixels: usize,
    /// Pixels that show an object by ray tracing.
    pub traced: usize,
    /// Pixels that show an object by scan conversion.
    pub scanned: usize,
    /// Pixels that show different objects in the two ways, or an object in one way only.
    pub differ: usize,
    /// Pixels that differ although all pixels around them show the same when they are traced: pixels away
    /// from edges.
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

/// Smaller pictures: width and height are halved so often.
const SMALLER: [u32; 3] = [3, 2, 1];

/// Numbers of objects from an eighth to a half of so many, each once.
fn parts(objects: usize) -> Vec<usize> {
    let mut parts: Vec<_> =
        [3, 2, 1].map(|shift| objects >> shift).into_iter().filter(|part| *part > 0).collect();
    parts.dedup();
    parts
}

impl Comparison {
    /// How many pictures of a scene are drawn in both ways: calls of `done`.
    pub fn steps(scene: &Scene<'_>) -> usize {
        1 + SMALLER.len() + 1 + parts(scene.objects.len()).len()
    }

    /// Draws a scene in both ways, smaller pictures of it, and scenes of its first objects. `done` is called
    /// after each.
    ///
    /// # Errors
    /// The scene or an option is refused; or there are too many facets.
    pub fn measure(scene: &Scene<'_>, options: &RenderOptions, done: &dyn Fn()) -> Result<Self, RenderError> {
        let picture = beside(
            &render(scene, &RenderOptions { mode: Mode::Exact, ..options.clone() })?,
            &render(scene, &RenderOptions { mode: Mode::Preview, ..options.clone() })?,
        );
        let visibility = Visibility::of(scene, options)?;
        done();
        let settings = options.settings;
        let costs = |scene: &Scene<'_>, settings| {
            let costs = costs(scene, &RenderOptions { settings, threads: 1, ..options.clone() });
            done();
            costs
        };
        let smaller = |shift: u32| Settings {
            width: (settings.width >> shift).max(1),
            height: (settings.height >> shift).max(1),
            ..settings
        };
        let by_pixels = SMALLER.into_iter().map(|shift| costs(scene, smaller(shift)));
        let mut by_pixels = by_pixels.collect::<Result<Vec<_>, _>>()?;
        let whole = costs(scene, settings)?;
        by_pixels.push(whole);
        // Lamps and motions name objects, which a part of them may lack.
        let lights = scene.lights.iter().filter(|light| !matches!(light, Light::Object(_)));
        let lights: Vec<_> = lights.copied().collect();
        let part = |count: usize| {
            let objects = scene.objects.get(..count).unwrap_or_default();
            costs(&Scene { objects, lights: &lights, motions: &[], ..*scene }, settings)
        };
        let by_objects = parts(scene.objects.len()).into_iter().map(part);
        let mut by_objects = by_objects.collect::<Result<Vec<_>, _>>()?;
        by_objects.push(whole);
        Ok(Self { picture, visibility, by_pixels, by_objects })
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
        for costs in
            self.by_pixels.iter().chain(self.by_objects.split_last().map_or(&[][..], |(_, parts)| parts))
        {
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
        let Visibility { pixels, differ, differ_inside, .. } = self.visibility;
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
fn costs(scene: &Scene<'_>, options: &RenderOptions) -> Result<Costs, RenderError> {
    pool(options)?.install(|| match options.number {
        Number::F32 => costs_in::<f32>(scene, options),
        Number::Fixed => costs_in::<Fixed>(scene, options),
        Number::F64 => costs_in::<f64>(scene, options),
    })
}

fn costs_in<R: Real>(scene: &Scene<'_>, options: &RenderOptions) -> Result<Costs, RenderError> {
    let mut memory = memory_for::<R>(scene);
    let prepared_bytes = memory.len();
    let prepared = PreparedScene::<R, _>::new(scene, &mut memory).map_err(RenderError::Scene)?;
    let renderer = Renderer::new(&prepared, options.settings).map_err(RenderError::Settings)?;
    let (width, height) = (renderer.width(), renderer.height());
    let mut lights = vec![Light16::BLACK; width as usize * height as usize];
    let mut facets = facets();
    let (mut traced, mut scanned, mut rays, mut seen) = (f64::MAX, f64::MAX, 0, 0);
    for _ in 0..RUNS {
        // Rays are counted as they are by `rayline render`.
        let mut counts = RayCounts::default();
        let start = ThreadTime::now();
        renderer.lines(0, &mut lights, &mut counts).map_err(RenderError::Line)?;
        traced = traced.min(start.elapsed().as_secs_f64());
        rays = counts.total();
        let start = ThreadTime::now();
        let preview = Preview::new(&renderer, options.segments, &mut facets);
        let mut preview = preview.map_err(RenderError::Preview)?;
        draw_lines(&mut preview, &renderer, 0..height, &mut lights, &|| ()).map_err(RenderError::Line)?;
        scanned = scanned.min(start.elapsed().as_secs_f64());
        seen = preview.facets();
    }
    let line = 2 * width as usize;
    let preview = seen * size_of::<PreviewFacet>() + width as usize * size_of::<PreviewPixel>();
    Ok(Costs {
        objects: scene.objects.len(),
        size: (width, height),
        rays,
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

impl Visibility {
    /// Compares what the pixels of a picture show: by one ray through the center of each.
    ///
    /// # Errors
    /// The scene or an option is refused; or there are too many facets.
    pub fn of(scene: &Scene<'_>, options: &RenderOptions) -> Result<Self, RenderError> {
        match options.number {
            Number::F32 => Self::of_scene_in::<f32>(scene, options),
            Number::Fixed => Self::of_scene_in::<Fixed>(scene, options),
            Number::F64 => Self::of_scene_in::<f64>(scene, options),
        }
    }

    fn of_scene_in<R: Real>(scene: &Scene<'_>, options: &RenderOptions) -> Result<Self, RenderError> {
        let Settings { width, height, .. } = options.settings;
        let settings = Settings { bounces: 0, ..Settings::new(width, height) };
        let mut memory = memory_for::<R>(scene);
        let prepared = PreparedScene::<R, _>::new(scene, &mut memory).map_err(RenderError::Scene)?;
        let renderer = Renderer::new(&prepared, settings).map_err(RenderError::Settings)?;
        let mut facets = facets();
        let preview = Preview::new(&renderer, options.segments, &mut facets);
        let mut preview = preview.map_err(RenderError::Preview)?;
        let (mut traced, mut scanned) = (Vec::new(), Vec::new());
        let mut pixels = vec![PreviewPixel::BLANK; width as usize];
        for y in 0..height as u16 {
            traced.extend((0..width as u16).map(|x| {
                let mut met = Met::default();
                renderer.pixel(x, y, &mut (&mut met as &mut dyn Probe<R>));
                met.0
            }));
            preview.scan(y, &mut pixels);
            scanned.extend(pixels.iter().map(|pixel| preview.object(*pixel)));
        }
        Ok(Self::between(&traced, &scanned, width as usize))
    }

    /// Compares the objects of pixels, line by line.
    fn between(traced: &[Option<usize>], scanned: &[Option<usize>], width: usize) -> Self {
        let height = traced.len() / width.max(1);
        let near = |place: usize, length: usize| place.saturating_sub(1)..(place + 2).min(length);
        let is_inside = |place: &usize| {
            near(place / width, height)
                .flat_map(|y| near(place % width, width).map(move |x| y * width + x))
                .all(|near| traced.get(near) == traced.get(*place))
        };
        let pairs = traced.iter().zip(scanned).enumerate();
        let others = pairs.filter(|(_, (traced, scanned))| traced != scanned).map(|(place, _)| place);
        let others: Vec<_> = others.collect();
        Self {
            pixels: traced.len(),
            traced: traced.iter().flatten().count(),
            scanned: scanned.iter().flatten().count(),
            differ: others.len(),
            differ_inside: others.iter().filter(|place| is_inside(place)).count(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_away_from_edges_are_those_whose_neighbors_are_alike() {
        let (a, b) = (Some(1), Some(2));
        // Object 2 fills the right half of five columns and four lines.
        let traced = [a, a, a, b, b].repeat(4);
        let mut scanned = traced.clone();
        let differences = |scanned: &[Option<usize>]| {
            let Visibility { pixels, traced, scanned, differ, differ_inside } =
                Visibility::between(&traced, scanned, 5);
            assert_eq!((pixels, traced), (20, 20));
            (scanned, differ, differ_inside)
        };
        assert_eq!(differences(&scanned), (20, 0, 0));
        // At the edge, away from it, and in a corner of the picture.
        for (place, object, expected) in [(7, b, (20, 1, 0)), (6, None, (19, 2, 1)), (19, None, (18, 3, 2))] {
            scanned[place] = object;
            assert_eq!(differences(&scanned), expected);
        }
    }

    #[test]
    fn parts_of_the_objects_are_different() {
        assert_eq!(parts(0), [0; 0]);
        assert_eq!(parts(1), [0; 0]);
        assert_eq!(parts(5), [1, 2]);
        assert_eq!(parts(16), [2, 4, 8]);
    }
}
