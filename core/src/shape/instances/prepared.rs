//! Instances, prepared: a ray is transformed to the model, and its hit is transformed back.

use super::super::{Facet, Hull, Intersect, Rim, Silhouette, Spans, Tessellation, Tip};
use super::pose::PreparedPose;
use crate::color::LinearRgb;
use crate::hierarchy::Hierarchy;
use crate::math::{Aabb, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// [`Instances`](super::Instances), prepared.
#[derive(Clone, Copy, Debug)]
pub struct PreparedInstances<'m, R, P> {
    // By value, not by reference: a set of shapes whose instances are of the same set would contain itself,
    // and does not compile. This rules out recursion.
    model: P,
    places: &'m Places<'m, R>,
}

/// The places of all instances.
#[derive(Clone, Copy, Debug)]
pub(super) struct Places<'m, R> {
    pub(super) poses: &'m [PreparedPose<R>],
    pub(super) hierarchy: Hierarchy<'m, R>,
    pub(super) bounds: Option<Aabb<R>>,
    /// The scale that the model was prepared with.
    pub(super) sized: Scale,
}

/// A part of the surface is numbered by the model's part, in so many lower bits, and by the index of the
/// place, above them.
const PART_BITS: u32 = 16;

/// The number of a part of the surface.
fn part_of(index: u32, part: u32) -> u32 {
    index << PART_BITS | part & ((1 << PART_BITS) - 1)
}

impl<'m, R: Real, P: Intersect<R>> PreparedInstances<'m, R, P> {
    pub(super) fn new(model: P, places: &'m Places<'m, R>) -> Self {
        Self { model, places }
    }

    /// The place that a surface belongs to, and the surface as that of the model.
    fn on_model(&self, surface: &Surface<R>) -> Option<(&'m PreparedPose<R>, Surface<R>)> {
        let pose = self.places.poses.get((surface.part >> PART_BITS) as usize)?;
        let part = surface.part & ((1 << PART_BITS) - 1);
        Some((pose, pose.inward_surface(&Surface { part, ..*surface })))
    }

    /// The only place, if there is just one.
    fn only(&self) -> Option<&'m PreparedPose<R>> {
        if let [pose] = self.places.poses { Some(pose) } else { None }
    }

    /// An item, by its number, and its place. The model has a list of `count` items (hulls or tips), which
    /// `of_model` returns by their numbers; the instances have this list once for each place.
    fn of_a_pose<T>(
        &self,
        number: usize,
        count: usize,
        of_model: impl Fn(usize) -> Option<T>,
    ) -> Option<(&'m PreparedPose<R>, T)> {
        let pose = self.places.poses.get(number.checked_div(count)?)?;
        Some((pose, of_model(number.checked_rem(count)?)?))
    }

    /// The instance that a ray meets at this distance: of several, the first.
    fn at(&self, ray: &Ray<R>, t: R) -> Option<(usize, &'m PreparedPose<R>)> {
        let Places { poses, hierarchy, .. } = self.places;
        let point = ray.at(t);
        let margin = R::offset(ray.origin.magnitude().larger(point.magnitude()));
        let around = Interval { min: t - margin, max: t + margin };
        let mut found: Option<(R, usize, &PreparedPose<R>)> = None;
        hierarchy.visit(point, margin, |index| {
            if let Some(pose) = poses.get(index)
                && let Some(met) = self.model.intersect(&pose.inward(ray), around)
            {
                // `met` equals `t`, except where two surfaces of one model lie next to each other.
                let off = (met - t).abs();
                if found.is_none_or(|(least, first, _)| off < least || off == least && index < first) {
                    found = Some((off, index, pose));
                }
            }
        });
        found.map(|(_, index, pose)| (index, pose))
    }
}

/// The most instances for which tips and rims are listed.
const MOST_TAPERING: usize = 32;

impl<R: Real, P: Intersect<R>> Intersect<R> for PreparedInstances<'_, R, P> {
    const IS_SMOOTHED: bool = P::IS_SMOOTHED;

    // Not inlined: the list of waiting boxes takes 488 bytes of stack, which other shapes should not pay for.
    #[inline(never)]
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let Places { poses, hierarchy, .. } = self.places;
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
        self.places.bounds
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        self.only().map_or(Spans::NONE, |pose| self.model.spans(&pose.inward(ray)))
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let Some((index, pose)) = self.at(ray, t) else {
            // If `intersect` returned `t`, there is an instance.
            let (point, normal) = (ray.at(t), -ray.direction);
            return Surface { point, normal, shading_normal: normal, magnitude: point.magnitude(), part: 0 };
        };
        let surface = pose.outward(self.model.surface(&pose.inward(ray), t));
        Surface { part: part_of(index as u32, surface.part), ..surface }
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        self.on_model(surface).map_or([R::ZERO; 2], |(_, surface)| self.model.uv(&surface, self.places.sized))
    }

    fn is_lifted(&self) -> bool {
        self.model.is_lifted()
    }

    fn is_tinted(&self) -> bool {
        self.model.is_tinted()
    }

    fn tint(&self, surface: &Surface<R>) -> LinearRgb<R> {
        let white = LinearRgb::even(R::ONE);
        self.on_model(surface).map_or(white, |(_, surface)| self.model.tint(&surface))
    }
}

impl<R: Real, P: Silhouette<R>> Silhouette<R> for PreparedInstances<'_, R, P> {
    const HAS_RIMS: bool = P::HAS_RIMS;

    fn hull(&self, part: usize) -> Option<Hull<R>> {
        if let Some(pose) = self.only() {
            return Some(pose.hull(self.model.hull(part)?));
        }
        let Some(part) = part.checked_sub(1) else { return self.places.bounds.map(Hull::aligned) };
        let (pose, hull) = self.of_a_pose(part, self.model.hulls(), |part| self.model.hull(part))?;
        Some(pose.hull(hull))
    }

    fn hulls(&self) -> usize {
        let of_model = self.model.hulls();
        match self.places.poses.len() {
            1 => of_model,
            _ if self.places.bounds.is_none() => 0,
            poses => of_model.saturating_mul(poses).saturating_add(1),
        }
    }

    fn tip(&self, number: usize) -> Option<Tip<R>> {
        if self.places.poses.len() > MOST_TAPERING {
            return None;
        }
        let tips = (0..).take_while(|number| self.model.tip(*number).is_some()).count();
        let (pose, tip) = self.of_a_pose(number, tips, |number| self.model.tip(number))?;
        Some(pose.tip(tip))
    }

    fn each_rim(&self, mut visit: impl FnMut(Rim<R>)) {
        // For many instances, listing the rims would take longer than it saves.
        let poses = if self.places.poses.len() > MOST_TAPERING { &[] } else { self.places.poses };
        for pose in poses {
            self.model.each_rim(|rim| visit(pose.rim(rim)));
        }
    }

    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        for (index, pose) in (0u32..).zip(self.places.poses) {
            let Ray { origin: eye, .. } =
                pose.inward(&Ray { origin: tessellation.eye, direction: Vec3::ZERO });
            let seen = Tessellation { eye, ..*tessellation };
            self.model.each_facet(&seen, &mut |facet| {
                visit(&Facet { part: part_of(index, facet.part), ..pose.facet(facet) });
            });
        }
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        let Some((pose, surface)) = self.on_model(surface) else { return surface.shading_normal };
        pose.turn(self.model.normal_beside(&surface, pose.turn_back(step)))
    }
}
