//! The two questions that rays ask of a scene: what is hit first, and how much light comes through.

use super::{Hit, PreparedScene};
use crate::limits::MAX_SHADOW_LAYERS;
use crate::material::PreparedMaterial;
use crate::math::{Interval, Ray, Real};
use crate::shape::{Geometry, Intersect};

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    pub(crate) fn material(&self, object: usize) -> Option<&PreparedMaterial<R>> {
        self.objects.get(object).and_then(|object| self.materials.get(usize::from(object.material)))
    }

    /// The first object that a ray meets inside `range`: of several at the same distance, the lowest in
    /// [`Scene::objects`].
    pub fn closest_hit(&self, ray: &Ray<R>, range: Interval<R>) -> Option<Hit<R>> {
        let (t, index) = self.closest_object(ray, range)?;
        let object = self.objects.get(index)?;
        Some(Hit { t, object: index, surface: object.shape.surface(ray, t) })
    }

    /// Distance and position of the first object that a ray meets.
    fn closest_object(&self, ray: &Ray<R>, mut range: Interval<R>) -> Option<(R, usize)> {
        let mut closest = None;
        for (index, object) in self.objects.iter().enumerate() {
            if let Some(t) = object.shape.intersect(ray, range) {
                range.max = t;
                closest = Some((t, index));
            }
        }
        closest
    }

    /// The share of light, 0 to 1, that comes through from a light at `distance` along `ray`, and whether it
    /// was cut short because more than [`MAX_SHADOW_LAYERS`] transparent surfaces lie in between.
    ///
    /// Each surface in between scales the light by its transmittance; what lies behind the light does not.
    pub fn light_through(&self, ray: &Ray<R>, distance: R) -> (R, bool) {
        let mut range = Interval { min: R::ZERO, max: distance };
        // Most often nothing, or something opaque, is in the way: any order of the objects tells.
        let mut clear = true;
        for (index, object) in self.objects.iter().enumerate() {
            if object.shape.intersect(ray, range).is_some() {
                if !(self.transmittance(index) > R::ZERO) {
                    return (R::ZERO, false);
                }
                clear = false;
            }
        }
        if clear {
            return (R::ONE, false);
        }
        // Transparent surfaces are multiplied in the order of the ray: one order, the same rounding. A shape
        // with an inside is met twice.
        let mut through = R::ONE;
        for _ in 0..MAX_SHADOW_LAYERS {
            let Some((t, index)) = self.closest_object(ray, range) else { return (through, false) };
            through = through * self.transmittance(index);
            range.min = t;
        }
        match self.closest_object(ray, range) {
            None => (through, false),
            Some(_) => (R::ZERO, true),
        }
    }

    fn transmittance(&self, object: usize) -> R {
        self.material(object).map_or(R::ZERO, |material| material.transmittance)
    }
}
