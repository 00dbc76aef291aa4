//! How much of each light gets through to a hit.

use super::shaded_hit::{ShadedHit, ShadowRays};
use crate::math::{Real, Vec3};
use crate::prepared::{Among, ObjectSet, PreparedScene, Through};
use crate::shape::Geometry;
use crate::throughput::Throughput;

/// The objects that can shade one place of one object, for each light of a scene of up to
/// [`OUTLINED_LIGHTS`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blockers {
    /// Position of the object that is shaded.
    pub(crate) receiver: usize,
    /// The objects that can stand before each light.
    pub(crate) before: [ObjectSet; OUTLINED_LIGHTS],
}

/// The most lights of a scene whose shadows have outlines.
pub(crate) const OUTLINED_LIGHTS: usize = 4;

impl Blockers {
    /// Any object can shade this place, which lies on no object.
    pub(crate) const UNKNOWN: Self =
        Self { receiver: usize::MAX, before: [ObjectSet::UNKNOWN; OUTLINED_LIGHTS] };

    /// The objects that can stand before a light.
    #[inline]
    fn before(&self, light: usize) -> ObjectSet {
        // In scenes of more lights, all sets are equal.
        self.before.get(light % OUTLINED_LIGHTS).copied().unwrap_or(ObjectSet::UNKNOWN)
    }
}

impl<R: Real> ShadowRays<R> for &Blockers {
    fn begin_at(&mut self, object: usize) {
        if self.receiver != object {
            *self = &Blockers::UNKNOWN;
        }
    }

    fn through<S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        hit: &ShadedHit<'_, R>,
        light: usize,
        toward: Vec3<R>,
        distance: R,
    ) -> Through<Throughput<R>> {
        let from = hit.departure(toward, false);
        let magnitude = hit.hit.surface.magnitude;
        let among = scene.between((from, magnitude), light, toward, self.before(light));
        if let Among::Few(ObjectSet::NONE) = among {
            return Through::All;
        }
        scene.light_through_among(&hit.hit.spawn(toward, from), distance, among)
    }
}
