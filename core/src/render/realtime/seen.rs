//! A digest of what a pixel saw: pixels that saw the same have the same.

use super::super::Tone;
use super::Sample;
use super::sample::{Near, Path};
use super::tiny::Watch;
use crate::material::PreparedMaterial;
use crate::math::{Real, Vec3};
use crate::prepared::{Hit, PreparedScene};
use crate::probe::{Event, Probe, RayKind};
use crate::shape::Geometry;
use crate::surface::Surface;

/// Rays that bring less of their light to the pixel than this leave no mark on it: their edges are faint, and there are many of them.
pub(super) const FAINT: f32 = 1.0 / 8.0;
/// How far from its middle a small highlight shows, see [`Shininess::shows`](crate::material::Shininess).
const SHOWS: f32 = 0.25;
/// The least cosine to the middle of a highlight that is seen: those of more than 17° are not small.
const BESIDE: f32 = 0.954;

/// Folds what happens to one pixel into a digest, and tells another probe.
pub(super) struct Seen<'s, 'm, 'p, R: Real, S: Geometry + 'm, P> {
    scene: &'s PreparedScene<'m, R, S>,
    probe: &'p mut P,
    /// Digests of what was met, and of what stood before the lights.
    path: u32,
    shade: u32,
    /// Bounces before the current ray.
    bounces: u32,
    /// Whether a small highlight shows.
    near_glint: bool,
    /// Watches for what is tiny, where there is any.
    watch: Option<&'p mut Watch<R>>,
    /// Rays that bring no more of their light leave no mark.
    faint: R,
    /// Whether what the current ray sees counts.
    counts: bool,
    /// Where the current ray is mirrored to, if it has hit something with a small highlight.
    mirrored: Vec3<R>,
    /// The material that it hit.
    hit: Option<&'s PreparedMaterial<'m, R>>,
}

impl<'s, 'm, 'p, R: Real, S: Geometry + 'm, P: Probe<R>> Seen<'s, 'm, 'p, R, S, P> {
    pub(super) fn new(
        scene: &'s PreparedScene<'m, R, S>,
        faint: R,
        watch: Option<&'p mut Watch<R>>,
        probe: &'p mut P,
    ) -> Self {
        Self {
            scene,
            probe,
            path: 0,
            shade: 0,
            bounces: 0,
            near_glint: false,
            watch,
            faint,
            counts: true,
            mirrored: Vec3::ZERO,
            hit: None,
        }
    }

    /// A number for what the maps of a material show: other normals and coefficients have others, and so have other cells.
    #[inline(never)]
    fn mapped(&self, hit: &Hit<R>, material: &PreparedMaterial<'_, R>) -> u32 {
        let uv = |surface: &Surface<R>| self.scene.uv(hit.object, surface);
        let at = material.mapped(&hit.surface, uv);
        let Vec3 { x, y, z } = hit.surface.shading_normal;
        let half = R::from_fraction(1 << 15);
        let normal = [x, y, z].map(|coordinate| coordinate * half + half);
        let shares = [at.ambient, at.diffuse, at.specular, at.reflectance, at.transmittance];
        // Sixteenths: between those that differ less, a straight line will do.
        let smooth = normal.into_iter().chain(shares).map(|share| share.to_q16() >> 12);
        smooth.chain(material.maps.steps(&hit.surface, uv)).fold(0, fold)
    }

    /// The pixel, whose tone is known in the end.
    pub(super) fn sample(&self, tone: Tone) -> Sample {
        let watched = self.watch.as_ref().map_or(Near::Nothing, |watch| watch.near);
        let near = if self.near_glint { watched.max(Near::Glint) } else { watched };
        Sample::traced(tone, self.path(), self.shade, near)
    }

    /// What was met.
    pub(super) fn path(&self) -> Path {
        Path::new(self.path)
    }
}

/// A digest of one thing more.
#[inline(always)]
fn fold(digest: u32, what: u32) -> u32 {
    (digest.rotate_left(5) ^ what).wrapping_mul(0x9E37_79B9)
}

impl<R: Real, S: Geometry, P: Probe<R>> Probe<R> for Seen<'_, '_, '_, R, S, P> {
    #[inline(always)]
    fn record(&mut self, event: Event<R>) {
        self.probe.record(event);
        match event {
            Event::Ray { throughput, bounces, .. } => {
                self.bounces = u32::from(bounces);
                self.counts = throughput > self.faint;
            }
            Event::Hit { kind, ray, hit, color, mirrored, .. } if self.counts => {
                if let Some(watch) = &mut self.watch {
                    // By value: it may stay in registers for what comes.
                    watch.hit(self.scene, (ray, self.bounces == 0), hit, mirrored);
                }
                let refracted = if kind == RayKind::Refracted { 1 << 16 } else { 0 };
                let surface = &hit.surface;
                // Parts of one object have edges between them, unless its normals are those of something smooth.
                let part =
                    if surface.shading_normal == surface.normal { surface.part.rotate_left(17) } else { 0 };
                self.path = fold(self.path, hit.object as u32 ^ refracted ^ part);
                self.hit = None;
                if let Some(material) = self.scene.material(hit.object) {
                    if let Some(cell) =
                        material.color.cell(&hit.surface, color, || self.scene.uv(hit.object, &hit.surface))
                    {
                        self.path = fold(self.path, cell);
                    }
                    if !material.maps.is_empty() {
                        self.path = fold(self.path, self.mapped(&hit, material));
                    }
                    self.hit = Some(material);
                    if material.specular > R::ZERO && material.shininess.is_sharp() {
                        self.mirrored = mirrored;
                    }
                }
            }
            // A light that is turned away shows as little as one that only grazes: both leave no mark.
            Event::Light { light, toward, through, .. } if self.counts => {
                if let Some(material) = self.hit {
                    let sharp = material.shininess.is_sharp();
                    // Asked where it tells something alone: it is a product for each light.
                    let cosine = || self.mirrored.dot(toward);
                    let shows = |share| material.shininess.shows(cosine(), share);
                    if through >= R::ONE {
                        self.near_glint |= sharp && cosine() > R::from_f32(BESIDE) && shows(R::ONE);
                    } else if material.diffuse > R::ZERO || !sharp || shows(R::from_f32(SHOWS)) {
                        // A shadow that is mirrored is another than one that is seen.
                        let what = self.bounces << 25 | 1 << 24 | (light as u32) << 17 | through.to_q16();
                        self.shade = fold(self.shade, what);
                    }
                }
            }
            Event::Miss { ray, color, .. } if self.counts => {
                let mark = self.scene.background.mark(ray.direction, color);
                self.path = fold(self.path, 1 << 25 ^ mark);
                if let Some(watch) = &mut self.watch {
                    watch.miss(self.scene, (ray, self.bounces == 0));
                }
            }
            Event::Hit { .. }
            | Event::Surface { .. }
            | Event::Light { .. }
            | Event::Miss { .. }
            | Event::Cut(_) => {}
        }
    }
}
