//! Photons: light on its way from lamps over mirrors and through glass (Jensen, "Global Illumination using
//! Photon Maps", EGWR 1996).
//!
//! A photon is a ray of the core, which mirrors, refracts and absorbs it as it does all rays: a share of flux
//! goes each way, so that no chance decides. A probe sees where it arrives.
//!
//! # No light counts twice
//! Shadow rays of the core go straight through glass. While photons are traced, `bake_light` measures the
//! light of lamps with opaque glass, so that photons alone bring what is behind. If lamps stay on the device
//! ([`keep_lamps`](super::LightOptions::keep_lamps)), the device shows that light straight on, and here only
//! photons that met no glass count. Light from other surfaces than lamps is that of radiosity: it goes
//! straight through glass, and ends at mirrors.

use rayline::math::{Interval, Ray};
use rayline::{Event, Hit, Material, PreparedScene, Probe, RayKind, Renderer, Scene, Settings};
use rayon::prelude::*;

use super::emission::{self, Beam, scaled};
use super::face::has_inside;
use super::photon_map::{Flight, Photon, PhotonMap};
use super::{Light, LightError, Vector, one_texel, prepared};
use crate::picture::memory_for;

/// The share of its flux that is left when a photon ends.
const LEAST: f32 = 1e-3;
/// The most bounces of a photon.
const BOUNCES: u8 = rayline::limits::MAX_BOUNCES;
/// The most photons that are traced between two calls of `progress`.
const AT_ONCE: usize = 8192;

/// What is to be traced.
#[derive(Clone, Copy, Debug)]
pub(super) struct Task {
    /// The number of photons.
    pub(super) photons: usize,
    /// Whether photons that meet glass do not count.
    pub(super) without_glass: bool,
    /// Whether the light in space is needed.
    pub(super) in_space: bool,
    /// A distance that is short in this scene.
    pub(super) short: f64,
}

/// What is known of a photon after some bounces.
#[derive(Clone, Copy, Debug)]
struct State {
    /// What happened at each bounce: the digits of a number, 1 mirrored and 0 refracted, after a 1.
    way: u32,
    /// Whether it counts.
    counts: bool,
    /// The squared index of refraction at the lamp over the squared index of the medium at hand. Physical
    /// light in a denser medium is brighter by the inverse of this ratio, and becomes dimmer again where it
    /// leaves the medium. The core computes neither change, so the flux of photons is multiplied by this
    /// ratio.
    density: f64,
    /// The index of refraction before the surface at its end over that behind it.
    eta: f64,
    /// Whether the surface at its end is opaque.
    ends_at_opaque: bool,
}

impl State {
    const START: Self = Self { way: 1, counts: true, density: 1.0, eta: 1.0, ends_at_opaque: true };
}

/// The photons of one ray that leaves a lamp.
struct Trail<'t> {
    scene: &'t Scene<'t>,
    task: Task,
    beam: usize,
    /// The flux of the ray.
    flux: Light,
    /// The number of bounces of the ray at hand.
    bounces: usize,
    states: [State; BOUNCES as usize + 2],
    photons: Vec<Photon>,
    flights: Vec<Flight>,
}

/// Traces photons from all lamps. `progress` is called with the finished share.
///
/// # Errors
/// A scene or settings that the core refuses.
pub(super) fn traced(scene: &Scene<'_>, task: Task, progress: &dyn Fn(f64)) -> Result<PhotonMap, LightError> {
    let unlit = Scene { lights: &[], ..*scene };
    let space = Scene { objects: &[], ..unlit };
    let [mut of_unlit, mut of_space] = [&unlit, &space].map(memory_for::<f64>);
    let (objects, space) = (prepared(&unlit, &mut of_unlit)?, prepared(&space, &mut of_space)?);
    let background = super::renderer(&space, 1)?;
    let sky = |direction| background.light_along(&Ray { origin: Vector::ZERO, direction }, (0, 0), 0);
    let settings = Settings { bounces: BOUNCES, cutoff: LEAST, rays_per_pixel: 4096, ..one_texel(1) };
    let renderer = Renderer::new(&objects, settings).map_err(LightError::Settings)?;
    let may_start = |object: usize| {
        material_of(scene, object).is_some_and(|material| !task.without_glass || is_opaque(material))
    };
    let beams = emission::beams(scene, &objects, task.photons, &may_start, &sky);
    let all: usize = beams.iter().map(|beam| beam.photons).sum();
    let (mut photons, mut flights, mut done) = (Vec::new(), Vec::new(), 0);
    for (number, beam) in beams.iter().enumerate() {
        let trail = |index: usize| trail(scene, (&objects, &renderer), task, (number, beam, index), &sky);
        for first in (0..beam.photons).step_by(AT_ONCE) {
            progress(done as f64 / all as f64);
            let part = first..(first + AT_ONCE).min(beam.photons);
            done += part.len();
            let trails: Vec<_> = part.into_par_iter().filter_map(trail).collect();
            for trail in trails {
                photons.extend(trail.0);
                flights.extend(trail.1);
            }
        }
    }
    Ok(PhotonMap::new(photons, flights))
}

/// The photons of a ray that leaves a lamp; `None` if it misses its object.
fn trail(
    scene: &Scene<'_>,
    (objects, renderer): (&PreparedScene<'_, f64>, &Renderer<'_, '_, f64>),
    task: Task,
    (number, beam, index): (usize, &Beam, usize),
    sky: &dyn Fn(Vector) -> Light,
) -> Option<(Vec<Photon>, Vec<Flight>)> {
    let departure = beam.departure(index, task.short, sky)?;
    let first = objects.closest_hit(&departure.ray, Interval::AHEAD)?;
    if first.object != beam.object() {
        return None;
    }
    let mut trail = Trail {
        scene,
        task,
        beam: number,
        flux: scaled(departure.flux(first.t), 1.0 / beam.photons as f64),
        bounces: 0,
        states: [State::START; BOUNCES as usize + 2],
        photons: Vec::new(),
        flights: Vec::new(),
    };
    // Each draws numbers of its own, as pixels do.
    let place = ((index & 0xFFFF) as u16, (index >> 16) as u16);
    renderer.light_along_watched(&departure.ray, place, 0, &mut (&mut trail as &mut dyn Probe<f64>));
    Some((trail.photons, trail.flights))
}

impl Probe<f64> for Trail<'_> {
    fn record(&mut self, event: Event<f64>) {
        match event {
            Event::Ray { kind, bounces, .. } => self.begin(kind, usize::from(bounces)),
            Event::Hit { kind, ray, hit, throughput, .. } => {
                if kind != RayKind::Camera {
                    self.arrive(&ray, &hit, throughput);
                }
                self.meet(&ray, &hit);
            }
            // A ray that misses all at once did not come to its object.
            Event::Miss { ray, throughput, .. } => self.fly(&ray, f64::INFINITY, throughput),
            _ => {}
        }
    }
}

impl Trail<'_> {
    /// A ray begins. Rays come as in a tree that is searched in depth: a ray comes from the last hit with one
    /// bounce less.
    fn begin(&mut self, kind: RayKind, bounces: usize) {
        self.bounces = bounces;
        let Some(before) = bounces.checked_sub(1) else { return };
        let State { way, counts, density, eta, ends_at_opaque } = self.states[before];
        let is_mirrored = kind == RayKind::Reflected;
        self.states[bounces] = State {
            way: way << 1 | u32::from(is_mirrored),
            counts: counts && (ends_at_opaque || !self.task.without_glass),
            density: if is_mirrored { density } else { density * eta * eta },
            ..State::START
        };
    }

    /// The ray at hand meets a surface.
    fn meet(&mut self, ray: &Ray<f64>, hit: &Hit<f64>) {
        let Some(material) = material_of(self.scene, hit.object) else { return };
        let (is_thin, before) =
            material.optics.map_or((false, 1.0), |optics| (optics.thin, f64::from(optics.outside.ior)));
        let eta = if is_thin { 1.0 } else { before / f64::from(material.ior) };
        let is_entering = hit.surface.normal.dot(ray.direction) < 0.0;
        let state = &mut self.states[self.bounces];
        state.eta = if is_entering { eta } else { 1.0 / eta };
        state.ends_at_opaque = is_opaque(material);
    }

    /// The ray at hand brings a share of the flux to a surface.
    fn arrive(&mut self, ray: &Ray<f64>, hit: &Hit<f64>, throughput: Light) {
        let State { way, counts, density, .. } = self.states[self.bounces];
        let normal = hit.surface.normal;
        let height = normal.dot(ray.direction);
        let shape = self.scene.objects.get(hit.object).map(|object| &object.shape);
        // Nothing that could be lit is inside of glass.
        if !(height > 0.0 && shape.is_some_and(has_inside)) {
            self.fly(ray, hit.t, throughput);
        }
        if counts && material_of(self.scene, hit.object).is_some_and(super::scatters) {
            self.photons.push(Photon {
                object: hit.object,
                point: hit.surface.point,
                normal: if height > 0.0 { -normal } else { normal },
                flux: scaled(self.flux * throughput, density),
                way: (self.beam, way),
            });
        }
    }

    /// The ray at hand crosses free space.
    fn fly(&mut self, ray: &Ray<f64>, length: f64, throughput: Light) {
        let State { counts, density, .. } = self.states[self.bounces];
        if self.task.in_space && counts && self.bounces > 0 {
            let flux = scaled(self.flux * throughput, density);
            self.flights.push(Flight { from: ray.origin, direction: ray.direction, length, flux });
        }
    }
}

fn material_of<'s>(scene: &'s Scene<'_>, object: usize) -> Option<&'s Material<'s>> {
    scene.material_of(scene.objects.get(object)?)
}

fn is_opaque(material: &Material<'_>) -> bool {
    !(material.transmittance > 0.0)
}
