//! How a ray meets instances: it is brought to where the model is, and its hit back.

use super::super::{Hull, Intersect, Rim, Silhouette, Spans, Tip};
use super::pose::PreparedPose;
use crate::hierarchy::Hierarchy;
use crate::math::{Aabb, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// [`Instances`](super::Instances), prepared.
#[derive(Clone, Copy, Debug)]
pub struct PreparedInstances<'m, R, P> {
    // Not lent: a set of shapes whose instances are of the same set would hold itself, which the compiler refuses. So there is no
    // recursion.
    model: P,
    group: &'m Group<'m, R>,
}

/// All places.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<'m, R> {
    pub(super) poses: &'m [PreparedPose<R>],
    pub(super) hierarchy: Hierarchy<'m, R>,
    pub(super) bounds: Option<Aabb<R>>,
    /// How large the model was prepared.
    pub(super) sized: Scale,
}

/// Of the number of a part of the surface, the lower bits are that of the model's part, the upper ones number the places.
const PART_BITS: u32 = 16;

impl<'m, R: Real, P: Intersect<R>> PreparedInstances<'m, R, P> {
    pub(super) fn new(model: P, group: &'m Group<'m, R>) -> Self {
        Self { model, group }
    }

    /// A surface where the model is, and the place that it belongs to.
    fn on_model(&self, surface: &Surface<R>) -> Option<(&'m PreparedPose<R>, Surface<R>)> {
        let pose = self.group.poses.get((surface.part >> PART_BITS) as usize)?;
        let part = surface.part & ((1 << PART_BITS) - 1);
        Some((pose, pose.inward_surface(&Surface { part, ..*surface })))
    }

    /// The only one, if it is.
    fn only(&self) -> Option<&'m PreparedPose<R>> {
        if let [pose] = self.group.poses { Some(pose) } else { None }
    }

    /// Of what the model has several of, by their numbers, and each place has again: one, and its place.
    fn of_a_pose<T>(
        &self,
        number: usize,
        of_model: impl Fn(usize) -> Option<T>,
    ) -> Option<(&'m PreparedPose<R>, T)> {
        let count = (0..).take_while(|number| of_model(*number).is_some()).count();
        let pose = self.group.poses.get(number.checked_div(count)?)?;
        Some((pose, of_model(number.checked_rem(count)?)?))
    }

    /// The instance that a ray meets at this distance: of several, the first.
    fn at(&self, ray: &Ray<R>, t: R) -> Option<(usize, &'m PreparedPose<R>)> {
        let Group { poses, hierarchy, .. } = self.group;
        let point = ray.at(t);
        let margin = R::offset(ray.origin.magnitude().larger(point.magnitude()));
        let around = Interval { min: t - margin, max: t + margin };
        let mut found: Option<(R, usize, &PreparedPose<R>)> = None;
        hierarchy.visit(point, margin, |index| {
            if let Some(pose) = poses.get(index)
                && let Some(met) = self.model.intersect(&pose.inward(ray), around)
            {
                // It is the very same distance, but where two surfaces of one model are next to each other.
                let off = (met - t).abs();
                if found.is_none_or(|(least, first, _)| off < least || off == least && index < first) {
                    found = Some((off, index, pose));
                }
            }
        });
        found.map(|(_, index, pose)| (index, pose))
    }
}

/// Of more instances than so many, none is looked at for where it tapers off.
const MOST_TAPERING: usize = 32;

impl<R: Real, P: Intersect<R>> Intersect<R> for PreparedInstances<'_, R, P> {
    // Much code, and many rays never come here.
    #[inline(never)]
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let Group { poses, hierarchy, .. } = self.group;
        let mut range = range;
        let mut nearest = None;
        hierarchy.walk(ray, range.max, |index| {
            if let Some(pose) = poses.get(index)
                && let Some(t) = self.model.intersect(&pose.inward(ray), range)
            {
                range.max = t;
                nearest = Some(t);
            }
            range.max
        });
        nearest
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        self.group.bounds
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        self.only().map_or(Spans::NONE, |pose| self.model.spans(&pose.inward(ray)))
    }

    #[inline(never)]
    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let Some((index, pose)) = self.at(ray, t) else {
            // Where `intersect` gave `t`, there is one.
            let (point, normal) = (ray.at(t), -ray.direction);
            return Surface { point, normal, shading_normal: normal, magnitude: point.magnitude(), part: 0 };
        };
        let surface = pose.outward(self.model.surface(&pose.inward(ray), t));
        let part = (index as u32) << PART_BITS | surface.part & ((1 << PART_BITS) - 1);
        Surface { part, ..surface }
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        self.on_model(surface).map_or([R::ZERO; 2], |(_, surface)| self.model.uv(&surface, self.group.sized))
    }
}

impl<R: Real, P: Silhouette<R>> Silhouette<R> for PreparedInstances<'_, R, P> {
    const HAS_RIMS: bool = P::HAS_RIMS;

    #[inline(never)]
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        if let Some(pose) = self.only() {
            return Some(pose.hull(self.model.hull(part)?));
        }
        let Some(part) = part.checked_sub(1) else { return self.group.bounds.map(Hull::aligned) };
        let (pose, hull) = self.of_a_pose(part, |part| self.model.hull(part))?;
        Some(pose.hull(hull))
    }

    #[inline(never)]
    fn tip(&self, number: usize) -> Option<Tip<R>> {
        if self.group.poses.len() > MOST_TAPERING {
            return None;
        }
        let (pose, tip) = self.of_a_pose(number, |number| self.model.tip(number))?;
        Some(pose.tip(tip))
    }

    fn each_rim(&self, mut visit: impl FnMut(Rim<R>)) {
        // Of many, it would take as long as to look for them.
        let poses = if self.group.poses.len() > MOST_TAPERING { &[] } else { self.group.poses };
        for pose in poses {
            self.model.each_rim(|rim| visit(pose.rim(rim)));
        }
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        let Some((pose, surface)) = self.on_model(surface) else { return surface.shading_normal };
        pose.turn(self.model.normal_beside(&surface, pose.turn_back(step)))
    }
}
