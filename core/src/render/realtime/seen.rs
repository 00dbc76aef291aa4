//! A digest of what a pixel saw: pixels that saw the same have the same.

use super::super::Light16;
use super::Sample;
use crate::math::{Real, Vec3};
use crate::prepared::PreparedScene;
use crate::probe::{Event, Probe, RayKind};
use crate::shape::Geometry;

/// Folds what happens to one pixel into a digest, and tells another probe.
pub(super) struct Seen<'s, 'm, 'p, R: Real, S: Geometry + 'm, P> {
    scene: &'s PreparedScene<'m, R, S>,
    probe: &'p mut P,
    digest: u32,
    near_glint: bool,
    /// Whether what the current ray sees counts.
    counts: bool,
    /// Direction of the current ray, mirrored after it has hit something with a small highlight.
    direction: Vec3<R>,
    /// The object that it hit, if that has a small highlight.
    glossy: Option<usize>,
}

impl<'s, 'm, 'p, R: Real, S: Geometry + 'm, P: Probe<R>> Seen<'s, 'm, 'p, R, S, P> {
    /// Rays that bring less of their light to the pixel than this do not count: their edges are faint, and there
    /// are many of them.
    const FAINT: f32 = 1.0 / 16.0;

    pub(super) fn new(scene: &'s PreparedScene<'m, R, S>, probe: &'p mut P) -> Self {
        Self {
            scene,
            probe,
            digest: 0,
            near_glint: false,
            counts: true,
            direction: Vec3::new(R::ZERO, R::ZERO, R::ZERO),
            glossy: None,
        }
    }

    /// The pixel, whose light is known in the end.
    pub(super) fn sample(&self, light: Light16) -> Sample {
        // The upper bits depend on all that was folded.
        Sample::traced(light, (self.digest >> 16) as u16, self.near_glint)
    }

    #[inline]
    fn fold(&mut self, what: u32) {
        self.digest = (self.digest.rotate_left(5) ^ what).wrapping_mul(0x9E37_79B9);
    }
}

impl<R: Real, S: Geometry, P: Probe<R>> Probe<R> for Seen<'_, '_, '_, R, S, P> {
    #[inline(always)]
    fn record(&mut self, event: Event<R>) {
        self.probe.record(event);
        match event {
            Event::Ray { ray, throughput, .. } => {
                self.counts = throughput > R::from_f32(Self::FAINT);
                self.direction = ray.direction;
                self.glossy = None;
            }
            Event::Hit { kind, hit, .. } if self.counts => {
                let refracted = if kind == RayKind::Refracted { 1 << 16 } else { 0 };
                self.fold(hit.object as u32 | refracted);
                if let Some(material) = self.scene.material(hit.object) {
                    if let Some(cell) = material.color.cell(&hit.surface) {
                        self.fold(cell);
                    }
                    if material.specular > R::ZERO && material.shininess.is_sharp() {
                        let normal = hit.surface.shading_normal;
                        let along = normal.dot(self.direction);
                        self.direction = self.direction - normal * (along + along);
                        self.glossy = Some(hit.object);
                    }
                }
            }
            // A light that is turned away shows as little as one that only grazes: both leave no mark.
            Event::Light { light, toward, through, .. } if self.counts => {
                if !(through >= R::ONE) {
                    self.fold(1 << 24 | (light as u32) << 17 | through.to_q16());
                } else if let Some(material) = self.glossy.and_then(|object| self.scene.material(object)) {
                    self.near_glint |= material.shininess.is_visible(self.direction.dot(toward));
                }
            }
            Event::Miss if self.counts => self.fold(1 << 25),
            Event::Hit { .. } | Event::Light { .. } | Event::Miss | Event::Cut(_) => {}
        }
    }
}
