//! The first object that a ray meets.

use super::candidates::Candidates;
use super::objects::PreparedObject;
use super::{Among, Departure, Hit, ObjectSet, PreparedScene};
use crate::hierarchy::{Hierarchy, WIDE};
use crate::material::PreparedMaterial;
use crate::math::{FourRays, Interval, Ray, Real, choose};
use crate::shape::{Form, Geometry, Intersect};

/// Distance to the object that a ray meets first, and the object's position. [`NO_OBJECT`]: the ray meets
/// none. Half the size of an `Option`, because four of them are computed at once.
pub(crate) type Closest<R> = (R, u32);

/// In place of an object's position.
pub(crate) const NO_OBJECT: u32 = u32::MAX;

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    /// The first object that a ray meets inside `range`: of several at the same distance, the lowest in
    /// [`Scene::objects`](crate::Scene::objects).
    pub fn closest_hit(&self, ray: &Ray<R>, range: Interval<R>) -> Option<Hit<R>> {
        let mut hit = Hit::BLANK;
        self.write_hit(ray, self.closest(ray, range, Among::All), &mut hit)?;
        Some(hit)
    }

    /// Distance and position of the first object that a ray meets inside `range`.
    #[inline]
    pub(crate) fn closest(&self, ray: &Ray<R>, range: Interval<R>, among: Among<'_>) -> Option<(R, usize)> {
        match among {
            _ if self.has_one_sided() => self.closest_of_all(ray, range),
            Among::Few(set) => self.closest_of(ray, range, set),
            Among::Listed(list) => self.closest_of(ray, range, list.iter().map(|index| usize::from(*index))),
            Among::All => self.closest_of_all(ray, range),
        }
    }

    /// Distance and position of the first object ahead of a ray: a camera ray that can only meet `among`, or
    /// a ray that leaves a surface and was given the set of [`leaving`](Self::leaving).
    // Forced, as in the rest of this file: without it, `classic` takes an M4F 1.05 times the instructions.
    #[inline(always)]
    pub(crate) fn closest_from(&self, ray: &Ray<R>, from: Departure, among: ObjectSet) -> Option<(R, usize)> {
        if self.candidates().is_none() || self.has_one_sided() {
            // A copy, so that the ray itself can stay in registers: 0.95 times the instructions on an M4F.
            return self.closest_of_all(&{ *ray }, Interval::AHEAD);
        }
        // A ray that leaves a surface misses most balls around it.
        let misses = |object: &PreparedObject<'m, R, S::Prepared<'m, R>>| {
            let form = object.form();
            from.outward
                && matches!(form, Form::Ball { center, radius } if R::misses_ball(ray, center, radius))
        };
        let closest = self.closest_unless(ray, Interval::AHEAD, among, misses);
        if closest.is_none() && self.comes_out_again(from) {
            // A ray inside a ball always comes out of it. If rounding loses that hit, test every object.
            return self.closest_of_all(&{ *ray }, Interval::AHEAD);
        }
        closest
    }

    /// Distances and positions of the first objects that four rays meet among listed ones, for processors
    /// that compute four numbers at once. Nothing moves in such a scene.
    #[inline(always)]
    pub(crate) fn closest_of_four(&self, rays: &FourRays<R>, list: &[u16]) -> [Closest<R>; 4] {
        let (mut distances, mut closest) = ([R::FARTHEST; 4], [NO_OBJECT; 4]);
        for index in list {
            let Some(object) = self.objects.get(usize::from(*index)) else { continue };
            let (met, t) = object.shape.intersect_four(rays, &distances);
            if met != 0 {
                distances = choose(met, t, distances);
                closest = choose(met, [u32::from(*index); 4], closest);
            }
        }
        let [a, b, c, d] = distances;
        let [e, f, g, h] = closest;
        [(a, e), (b, f), (c, g), (d, h)]
    }

    /// Writes the hit at a known distance on a known object into `hit`, and returns the material there. In
    /// place: an `Option` of a hit would be copied.
    #[inline(always)]
    pub(crate) fn write_hit(
        &self,
        ray: &Ray<R>,
        closest: Option<(R, usize)>,
        hit: &mut Hit<R>,
    ) -> Option<&'m PreparedMaterial<'m, R>> {
        let (t, index) = closest?;
        let object = self.objects.get(index)?;
        (hit.t, hit.object) = (t, index);
        hit.surface = self.surface(object, ray, t);
        Some(object.material)
    }

    /// The objects that a camera ray can meet: all of the scene, or unknown ones where it has no sets.
    pub(crate) fn all(&self) -> ObjectSet {
        self.candidates().map_or(ObjectSet::UNKNOWN, Candidates::all)
    }

    /// The objects that a ray can meet which leaves a surface; unknown ones where the scene has no sets.
    pub(crate) fn leaving(&self, from: Departure) -> ObjectSet {
        self.candidates().map_or(ObjectSet::UNKNOWN, |candidates| candidates.leaving(from))
    }

    /// Whether a ray that leaves an object may meet it again.
    pub(crate) fn is_met_again(&self, from: Departure) -> bool {
        self.objects.get(from.object).is_none_or(|object| object.form().is_met_again(from.outward))
    }

    fn comes_out_again(&self, from: Departure) -> bool {
        self.candidates().is_some_and(|candidates| candidates.comes_out_again(from))
    }

    /// [`closest`](Self::closest) among all objects: through the hierarchy, if the scene has one.
    #[inline(never)]
    fn closest_of_all(&self, ray: &Ray<R>, range: Interval<R>) -> Option<(R, usize)> {
        match self.hierarchy() {
            Some(hierarchy) => self.closest_in_hierarchy(hierarchy, ray, range),
            None if self.has_one_sided() => self.closest_seen(ray, range),
            None => self.closest_of(ray, range, 0..self.objects.len()),
        }
    }

    /// [`closest`](Self::closest) among all objects of a scene with one-sided surfaces. Apart from the loop
    /// for other scenes: the test of each hit took `table` on an M3 1.02 times the instructions.
    #[cold]
    fn closest_seen(&self, ray: &Ray<R>, mut range: Interval<R>) -> Option<(R, usize)> {
        let mut closest = None;
        for (index, object) in self.objects.iter().enumerate() {
            if let Some(t) = self.sees(object, ray, range) {
                range.max = t;
                closest = Some((t, index));
            }
        }
        closest
    }

    /// [`closest`](Self::closest) among the objects at these positions, which ascend.
    #[inline(always)]
    fn closest_of(
        &self,
        ray: &Ray<R>,
        range: Interval<R>,
        among: impl IntoIterator<Item = usize>,
    ) -> Option<(R, usize)> {
        self.closest_unless(ray, range, among, |_| false)
    }

    /// [`closest_of`](Self::closest_of) the objects that `misses` does not rule out.
    #[inline(always)]
    fn closest_unless(
        &self,
        ray: &Ray<R>,
        mut range: Interval<R>,
        among: impl IntoIterator<Item = usize>,
        misses: impl Fn(&PreparedObject<'m, R, S::Prepared<'m, R>>) -> bool,
    ) -> Option<(R, usize)> {
        let mut closest = None;
        for index in among {
            let Some(object) = self.objects.get(index) else { continue };
            if !misses(object)
                && let Some(t) = self.intersect(object, ray, range)
            {
                range.max = t;
                closest = Some((t, index));
            }
        }
        closest
    }

    /// [`closest`](Self::closest) among all objects, which come in the order in which the ray meets their
    /// boxes.
    #[inline(never)]
    fn closest_in_hierarchy(
        &self,
        hierarchy: &Hierarchy<'m, R, WIDE>,
        ray: &Ray<R>,
        range: Interval<R>,
    ) -> Option<(R, usize)> {
        let mut closest: Option<(R, usize)> = None;
        hierarchy.walk(ray, range.max, |index| {
            // Of two objects at the same distance, the lower position wins: test that one up to `range.max`.
            let max = match closest {
                Some((t, other)) if other < index => t,
                _ => range.max,
            };
            if let Some(object) = self.objects.get(index)
                && let Some(t) = self.sees(object, ray, Interval { max, ..range })
                && closest.is_none_or(|(nearest, _)| t <= nearest)
            {
                closest = Some((t, index));
            }
            closest.map_or(range.max, |(t, _)| t)
        });
        closest
    }
}
