//! Searches for objects in a part of space: realtime quality looks there for things between the pixels that
//! it traces.

use super::{ObjectSet, PreparedScene};
use crate::hierarchy::{Hierarchy, WIDE, Wedge};
use crate::math::{Ray, Real};
use crate::shape::Geometry;

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    /// The objects for which `holds` is true; `None`, where the scene has no sets of objects.
    pub(crate) fn objects_where(&self, holds: impl Fn(usize) -> bool) -> Option<ObjectSet> {
        let all = self.candidates()?.all();
        Some(all.filter(|object| holds(*object)).fold(ObjectSet::NONE, ObjectSet::with))
    }

    /// Whether `holds` is true for any object.
    pub(crate) fn any_object(&self, holds: impl FnMut(usize) -> bool) -> bool {
        (0..self.objects.len()).any(holds)
    }

    /// Whether `holds` is true for any of the objects `among`; without a set, for any object that may reach
    /// into a wedge.
    pub(crate) fn any_between(
        &self,
        wedge: &Wedge<R>,
        among: Option<ObjectSet>,
        holds: impl FnMut(usize) -> bool,
    ) -> bool {
        self.any_of(among, holds, |hierarchy, holds| hierarchy.any_between(wedge, holds))
    }

    /// Whether `holds` is true for any of the objects `among`; without a set, for any object that may come
    /// near to a ray before its end at `max`: no farther than `reach_at` gives for the distance of the end.
    pub(crate) fn any_beside(
        &self,
        (ray, max): (&Ray<R>, R),
        reach_at: impl FnOnce(R) -> R,
        among: Option<ObjectSet>,
        holds: impl FnMut(usize) -> bool,
    ) -> bool {
        self.any_of(among, holds, |hierarchy, holds| {
            let max = max.smaller(hierarchy.farthest_from(ray.origin));
            hierarchy.any_beside(ray, max, reach_at(max), holds)
        })
    }

    /// Whether `holds` is true for any object of a set, or of those that `find` finds in the hierarchy, or of
    /// all.
    fn any_of<T: FnMut(usize) -> bool>(
        &self,
        among: Option<ObjectSet>,
        holds: T,
        find: impl FnOnce(&Hierarchy<'m, R, WIDE>, T) -> bool,
    ) -> bool {
        match (among, self.hierarchy()) {
            (Some(some), _) => some.into_iter().any(holds),
            (None, Some(hierarchy)) => find(hierarchy, holds),
            (None, None) => self.any_object(holds),
        }
    }
}
