//! The light in the space between the surfaces, as an irradiance volume.

use bumpalo::Bump;
use rayline::math::{Interval, Ray};
use rayline::shape::{Shape, Sphere};
use rayline::{
    Event, Figure, IrradianceVolume, Light as Lamp, LinearRgb, Map, Material, MaterialId, Object, ObjectId,
    Onto, Placed, Placement, PreparedScene, Probe, RayKind, Renderer, Scene, Settings, Texture,
};
use rayon::prelude::*;

use super::emission::scaled;
use super::photon_map::Flight;
use super::probe::LightProbe;
use super::{Light, LightError, Vector, prepared};
use crate::picture::memory_for;

/// The directions in which the light at a point is sampled.
const DIRECTIONS: usize = 512;
/// The places on a small ball where the light of lamps is measured.
const PLACES: usize = 128;

/// The light at a point: red, green and blue of the mean, and of its change along x, y and z.
type Harmonics = [f64; 12];

/// The points of a grid between the corners of a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    pub(super) counts: [u8; 3],
    first: Vector,
    step: Vector,
}

impl Grid {
    /// The middles of so many cells of the box around all points.
    pub(super) fn around(points: impl Iterator<Item = Vector>, counts: [u8; 3]) -> Self {
        let far = Vector::new(f64::MAX, f64::MAX, f64::MAX);
        let (low, high) = points.fold((far, -far), |(low, high), p| {
            let low = Vector::new(low.x.min(p.x), low.y.min(p.y), low.z.min(p.z));
            (low, Vector::new(high.x.max(p.x), high.y.max(p.y), high.z.max(p.z)))
        });
        let size = high - low;
        let least = size.magnitude() * 1e-3;
        let step = |size: f64, count: u8| (size / f64::from(count)).max(least);
        let [x, y, z] = counts;
        let step = Vector::new(step(size.x, x), step(size.y, y), step(size.z, z));
        Self { counts, first: low + step * 0.5, step }
    }

    /// All points, along x first.
    fn points(&self) -> Vec<Vector> {
        let [x, y, z] = self.counts.map(usize::from);
        let point = |index: usize| {
            let [i, j, k] = [index % x, index / x % y, index / (x * y)].map(|count| count as f64);
            self.first + Vector::new(self.step.x * i, self.step.y * j, self.step.z * k)
        };
        (0..x * y * z).map(point).collect()
    }

    /// Calls a function with the position of each point whose cell a photon crosses, and with the length of
    /// the way in the cell over the cell's volume.
    fn cross(&self, flight: &Flight, found: &mut impl FnMut(usize, f64)) {
        let low = self.first - self.step * 0.5;
        let axes = |Vector { x, y, z }: Vector| [x, y, z];
        let (step, from, toward) = (axes(self.step), axes(flight.from - low), axes(flight.direction));
        let mut ends = [0.0, flight.length];
        let mut cuts = Vec::new();
        for axis in 0..3 {
            let count = f64::from(self.counts[axis]);
            let at = |plane: f64| (plane * step[axis] - from[axis]) / toward[axis];
            if toward[axis] == 0.0 {
                if from[axis] < 0.0 || from[axis] > count * step[axis] {
                    return;
                }
                continue;
            }
            let (near, far) = (at(0.0).min(at(count)), at(0.0).max(at(count)));
            ends = [ends[0].max(near), ends[1].min(far)];
            cuts.extend((1..self.counts[axis]).map(|plane| at(f64::from(plane))));
        }
        cuts.retain(|cut| *cut > ends[0] && *cut < ends[1]);
        cuts.extend(ends);
        cuts.sort_by(f64::total_cmp);
        let volume = step.iter().product::<f64>();
        for part in cuts.windows(2).filter(|part| ends[0] < ends[1] && part[1] > part[0]) {
            let middle = 0.5 * (part[0] + part[1]);
            let cell = |axis: usize| {
                let place = (from[axis] + toward[axis] * middle) / step[axis];
                (place as usize).min(usize::from(self.counts[axis]) - 1)
            };
            let [wide, deep, _] = self.counts.map(usize::from);
            found(cell(0) + wide * (cell(1) + deep * cell(2)), (part[1] - part[0]) / volume);
        }
    }
}

/// The light of lamps in space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamps<'l, 's> {
    /// The scene in white, if lamps shine here and not on the device.
    pub(super) lit: Option<&'l Scene<'s>>,
    /// Whether photons bring their light over mirrors and through glass.
    pub(super) have_photons: bool,
}

/// A map of the light in space for a scene with baked surfaces.
pub(super) fn map<'a>(
    grid: &Grid,
    baked: &Scene<'_>,
    lamps: Lamps<'_, '_>,
    probe: &LightProbe<'_>,
    arena: &'a Bump,
) -> Result<Map<'a>, LightError> {
    let mut room = memory_for::<f64>(baked);
    let surfaces = prepared(baked, &mut room)?;
    let settings = Settings { bounces: 4, rays_per_pixel: 1000, ..Settings::new(1, 1) };
    let renderer = Renderer::new(&surfaces, settings).map_err(LightError::Settings)?;
    let points = grid.points();
    let light = |point: &Vector| -> Result<Option<Harmonics>, LightError> {
        let axes = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)].map(|(x, y, z)| Vector::new(x, y, z));
        if axes
            .iter()
            .all(|axis| probe.is_hidden((*point, *axis), 0.0) && probe.is_hidden((*point, -*axis), 0.0))
        {
            return Ok(None);
        }
        let mut sum = of_surfaces(*point, (baked, lamps.have_photons), &surfaces, &renderer);
        if let Some(lit) = lamps.lit {
            let lamps = of_lamps(*point, lit, probe)?;
            sum.iter_mut().zip(lamps).for_each(|(sum, lamps)| *sum += lamps);
        }
        Ok(Some(sum))
    };
    let mut light: Vec<_> = points.par_iter().map(light).collect::<Result<_, _>>()?;
    for flight in &probe.photons.flights {
        grid.cross(flight, &mut |cell, part| {
            if let Some(sum) = &mut light[cell] {
                // The mean light from all directions is a quarter of the flux on a small ball.
                add(sum, scaled(flight.flux, 0.25 * part), -flight.direction, 2.0);
            }
        });
    }
    let light = filled(light, &points);
    let most = light.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
    let share = |value: f64| if most > 0.0 { (value / most * 32767.0).round() as i16 } else { 0 };
    let light = arena.alloc_slice_fill_iter(light.iter().map(|point| point.map(share)));
    let placement = Placement::in_scene(1.0).stretched(grid.step.to_f32()).at(grid.first.to_f32());
    let figure = Figure::IrradianceVolume(IrradianceVolume { counts: grid.counts, light });
    let texture = Texture::Placed(arena.alloc(Placed::new(figure, placement)));
    // Shares are of 32768 in the core.
    Ok(Map { onto: Onto::AmbientLight { most: (most * 32768.0 / 32767.0) as f32 }, texture })
}

/// The light that surfaces send to a point, without that of lamps and of the sky.
fn of_surfaces(
    point: Vector,
    (scene, have_photons): (&Scene<'_>, bool),
    prepared: &PreparedScene<'_, f64>,
    renderer: &Renderer<'_, '_, f64>,
) -> Harmonics {
    let mut sum = [0.0; 12];
    for direction in directions(DIRECTIONS) {
        let ray = Ray { origin: point, direction };
        let Some(hit) = prepared.closest_hit(&ray, Interval::AHEAD) else { continue };
        let is_lamp = |lamp: &Lamp| *lamp == Lamp::Object(ObjectId(hit.object as u16));
        if scene.lights.iter().any(is_lamp) {
            continue;
        }
        let mut images = Images { lights: scene.lights, throughput: None, light: Light::BLACK };
        let mut light =
            renderer.light_along_watched(&ray, (0, 0), 0, &mut (&mut images as &mut dyn Probe<f64>));
        if have_photons {
            light = light + images.light * -1.0;
        }
        // The mean, and twice the mean of light times direction: see `IrradianceVolume`.
        add(&mut sum, light, direction, 2.0);
    }
    sum.map(|sum| sum / DIRECTIONS as f64)
}

/// The light of lamps and of the sky that a ray sees in mirrors and through glass.
struct Images<'l> {
    lights: &'l [Lamp],
    /// The throughput of a ray that met a lamp, until the light of the lamp is added.
    throughput: Option<Light>,
    light: Light,
}

impl Probe<f64> for Images<'_> {
    fn record(&mut self, event: Event<f64>) {
        match event {
            Event::Hit { kind, hit, throughput, .. } => {
                let lamp = Lamp::Object(ObjectId(hit.object as u16));
                let is_image = kind != RayKind::Camera && self.lights.contains(&lamp);
                self.throughput = is_image.then_some(throughput);
            }
            Event::Surface { shown } => {
                if let Some(throughput) = self.throughput.take() {
                    self.light = self.light + shown * throughput;
                }
            }
            Event::Miss { color, throughput, .. } if self.lights.contains(&Lamp::Sky) => {
                self.light = self.light + color * throughput;
            }
            _ => {}
        }
    }
}

/// The light of lamps at a point, as a small white ball shows it.
fn of_lamps(point: Vector, lit: &Scene<'_>, probe: &LightProbe<'_>) -> Result<Harmonics, LightError> {
    let radius = probe.short * 64.0;
    let ball = Object {
        shape: Shape::Sphere(Sphere::new(point.to_f32(), radius as f32)),
        material: MaterialId(lit.materials.len() as u16),
    };
    let objects: Vec<_> = lit.objects.iter().copied().chain([ball]).collect();
    let white = Material::matte(LinearRgb::WHITE);
    let materials: Vec<_> = lit.materials.iter().copied().chain([white]).collect();
    let scene = Scene { objects: &objects, materials: &materials, ..*lit };
    let mut room = memory_for::<f64>(&scene);
    let prepared = prepared(&scene, &mut room)?;
    let renderer = Renderer::new(&prepared, super::one_texel(4)).map_err(LightError::Settings)?;
    let center = point.to_f32().to::<f64>();
    let mut sum = [0.0; 12];
    for (index, normal) in directions(PLACES).enumerate() {
        let ray = Ray { origin: center + normal * (radius * 1.5), direction: -normal };
        let light = (0..4).map(|sample| renderer.light_along(&ray, (index as u16, 0), sample));
        let light = light.fold(Light::BLACK, |sum, light| sum + light) * 0.25;
        // The mean, and three times the mean of light times normal: the first harmonics of a function.
        add(&mut sum, light, normal, 3.0);
    }
    Ok(sum.map(|sum| sum / PLACES as f64))
}

fn add(sum: &mut Harmonics, Light { r, g, b }: Light, direction: Vector, factor: f64) {
    let Vector { x, y, z } = direction * factor;
    let shares = [1.0, x, y, z].into_iter().flat_map(|along| [r * along, g * along, b * along]);
    sum.iter_mut().zip(shares).for_each(|(sum, share)| *sum += share);
}

/// Unit vectors that are spread evenly: a spiral (Swinbank and Purser, "Fibonacci Grids", 2006).
fn directions(count: usize) -> impl Iterator<Item = Vector> {
    let golden = core::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count).map(move |index| {
        let y = 1.0 - (2 * index + 1) as f64 / count as f64;
        let (across, angle) = ((1.0 - y * y).sqrt(), golden * index as f64);
        Vector::new(across * angle.cos(), y, across * angle.sin())
    })
}

/// The light of all points. A point inside of a body gets the light of the nearest point outside.
fn filled(light: Vec<Option<Harmonics>>, points: &[Vector]) -> Vec<Harmonics> {
    let nearest = |point: &Vector| {
        let seen = light.iter().zip(points).filter_map(|(light, other)| Some((light.as_ref()?, other)));
        let distance = |other: &Vector| (*other - *point).length_squared();
        seen.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b))).map(|(light, _)| *light)
    };
    let each = light.iter().zip(points);
    each.map(|(light, point)| light.or_else(|| nearest(point)).unwrap_or_default()).collect()
}
