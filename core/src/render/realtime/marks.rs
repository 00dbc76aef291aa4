//! Digests of what the rays of a pixel met, so that two pixels can be compared.
//!
//! Pixels whose rays met the same things have the same digests. Pixels whose rays met different things have
//! different ones, but for one in 128: a [`Sample`] keeps 7 bits of each digest.

use super::sample::{Near, PathDigest, Sample};
use super::small::Watch;
use crate::color::LinearRgb;
use crate::integrator::fold;
use crate::material::{MapRoom, PreparedMaterial};
use crate::math::{Real, Vec3};
use crate::prepared::{Hit, PreparedScene};
use crate::probe::{Event, Probe, RayKind};
use crate::render::Tone;
use crate::shape::Geometry;
use crate::surface::Surface;
use crate::texture::level_mark;

/// A ray is left out of the digests if its throughput is this or less: the edges that it meets are faint in
/// the picture, and such rays are many.
pub(super) const FAINT: f32 = 1.0 / 8.0;
/// The share of a small highlight's extent within which a shadow there counts, see
/// [`Shininess::shows`](crate::material::Shininess::shows).
const SHOWS: f32 = 0.25;
/// The least cosine between a light and the mirrored ray at which a pixel is near a small highlight: 17°.
const NEAR_GLINT: f32 = 0.954;

/// Folds what happens to one pixel into digests, and passes every event on to another probe.
pub(super) struct MarkProbe<'c, 'm, R: Real, S: Geometry + 'm, P> {
    scene: &'c PreparedScene<'m, R, S>,
    probe: &'c mut P,
    /// Digest of the objects, parts and texture cells that were met.
    path: u32,
    /// Digest of what stood between the hits and the lights.
    shade: u32,
    /// Bounces before the current ray.
    bounces: u32,
    /// Whether a small highlight shows.
    near_glint: bool,
    /// Finds small things beside the rays, if the scene can have any.
    watch: Option<&'c mut Watch<R>>,
    /// Rays of this throughput or less are left out of the digests: [`FAINT`], or 1 to leave out all rays.
    faint: R,
    /// Whether the current ray counts: its throughput is more than `faint`.
    counts: bool,
    /// The direction of the mirrored ray at the last hit on a material with a small highlight.
    mirrored: Vec3<R>,
    /// The material of the current ray's hit.
    material: Option<&'c PreparedMaterial<'m, R>>,
}

impl<'c, 'm, R: Real, S: Geometry + 'm, P: Probe<R>> MarkProbe<'c, 'm, R, S, P> {
    pub(super) fn new(
        scene: &'c PreparedScene<'m, R, S>,
        faint: R,
        watch: Option<&'c mut Watch<R>>,
        probe: &'c mut P,
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
            material: None,
        }
    }

    /// Folds the step of toon tones into the digest of the shadows: between two steps there is an edge.
    #[cfg(feature = "looks")]
    pub(super) fn fold_step(&mut self, step: u32) {
        if step > 0 {
            self.shade = fold(self.shade, step);
        }
    }

    /// The pixel's sample, once its tone is known.
    pub(super) fn sample(&self, tone: Tone) -> Sample {
        let watched = self.watch.as_ref().map_or(Near::Nothing, |watch| watch.near);
        let near = if self.near_glint { watched.max(Near::Glint) } else { watched };
        Sample::traced(tone, PathDigest::new(self.path), self.shade, near)
    }

    /// Folds a hit into the digest of the path.
    #[inline]
    fn fold_hit(&mut self, kind: RayKind, hit: &Hit<R>, color: LinearRgb<R>, mirrored: Vec3<R>) {
        let refracted = if kind == RayKind::Refracted { 1 << 16 } else { 0 };
        let surface = &hit.surface;
        self.path = fold(self.path, hit.object as u32 ^ refracted ^ surface.facet().rotate_left(17));
        self.material = self.scene.material(hit.object);
        let Some(material) = self.material else { return };
        if let Some(mark) = material.color.mark(surface, color, || self.scene.uv(hit.object, surface)) {
            self.path = fold(self.path, mark);
        } else if self.scene.is_tinted(hit.object) {
            self.path = fold(self.path, level_mark(color));
        }
        if !material.maps.is_empty() {
            self.path = fold(self.path, self.digest_of_maps(hit, material, color));
        }
        if material.specular > R::ZERO && material.shininess.is_sharp() {
            self.mirrored = mirrored;
        }
    }

    /// A digest of what the maps of a material say at a hit: the normal, the coefficients and the maps'
    /// cells.
    fn digest_of_maps(&self, hit: &Hit<R>, material: &PreparedMaterial<'_, R>, color: LinearRgb<R>) -> u32 {
        let uv = |surface: &Surface<R>| self.scene.uv(hit.object, surface);
        let mut room = MapRoom::EMPTY;
        let at = material.mapped(&hit.surface, uv, &mut room);
        let Vec3 { x, y, z } = hit.surface.shading_normal;
        let half = R::from_fraction(1 << 15);
        let normal = [x, y, z].map(|coordinate| coordinate * half + half);
        let shares = [at.ambient, at.diffuse, at.specular, at.reflectance, at.transmittance];
        // Cut to sixteenths: what differs less is interpolated.
        let smooth = normal.into_iter().chain(shares).map(|share| share.to_q16() >> 12);
        let colors = at.optics().map(|optics| [optics.reflection_color, optics.emission()].map(level_mark));
        let smooth = smooth.chain(colors.into_iter().flatten());
        // Baked light as the surface shows it.
        let shown = at.ambient_light().map(|light| light * (color * at.ambient));
        let smooth = smooth.chain(shown.map(level_mark));
        smooth.chain(material.maps.steps(&hit.surface, uv)).fold(0, fold)
    }

    /// Folds a shadow at the current hit into the digest of the shadows: a light that is blocked, in full or
    /// in part, on a surface that would show it. A light that is not blocked leaves the digest as it is, and
    /// may make the pixel one near a small highlight. A light behind the surface has no event, and leaves the
    /// digest as it is, too. No edge is lost between the two: a light at a grazing angle adds almost nothing.
    #[inline]
    fn fold_light(&mut self, light: usize, toward: Vec3<R>, through: R) {
        let Some(material) = self.material else { return };
        let sharp = material.shininess.is_sharp();
        // Worked out only where its value matters: it costs a dot product for each light.
        let cosine = || self.mirrored.dot(toward);
        let shows = |share| material.shininess.shows(cosine(), share);
        if through >= R::ONE {
            self.near_glint |= sharp && cosine() > R::from_f32(NEAR_GLINT) && shows(R::ONE);
        } else if material.diffuse > R::ZERO || !sharp || shows(R::from_f32(SHOWS)) {
            // The number of bounces distinguishes a mirrored shadow from a shadow that is seen directly.
            let what = self.bounces << 25 | 1 << 24 | (light as u32) << 17 | through.to_q16();
            self.shade = fold(self.shade, what);
        }
    }
}

impl<R: Real, S: Geometry, P: Probe<R>> Probe<R> for MarkProbe<'_, '_, R, S, P> {
    // Forced, as in the probe `()`: without it, `classic` takes an M4F 1.18 times the instructions in
    // realtime quality.
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
                    // By value, so that the hit may stay in registers.
                    watch.hit(self.scene, (ray, self.bounces == 0), hit, mirrored);
                }
                self.fold_hit(kind, &hit, color, mirrored);
            }
            Event::Light { light, toward, through, .. } if self.counts => {
                self.fold_light(light, toward, through);
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
