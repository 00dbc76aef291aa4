//! The ways from neighboring points on one object to the lights, each as one beam.

use super::{FEWEST_IN_BEAM, Lane, List, PixelGroup};
use crate::hierarchy::Beam;
use crate::integrator::shaded_hit::{ShadedHit, ShadowRays};
use crate::light::Source;
use crate::math::{Aabb, Real, Vec3};
use crate::prepared::Departure;
use crate::prepared::closest::NO_OBJECT;
use crate::prepared::{Among, PreparedScene, Through};
use crate::shape::Geometry;
use crate::throughput::Throughput;

/// The most lights with beams.
pub(super) const BEAM_LIGHTS: usize = 8;

/// The way from some points to a light.
enum Way {
    /// Not looked up yet.
    New,
    /// Nothing is in the way.
    Clear,
    /// Only these objects can be in the way.
    Listed(List),
    /// Many objects can be in the way.
    Crowded,
}

/// The ways from some points of one object to the lights.
pub(super) struct Ways<'t, 'p, 'm, R: Real, S: Geometry + 'm> {
    group: &'t mut PixelGroup<'p, 'm, R, S>,
    /// A box around the points, and the largest number that they were computed from; `None` if they are too
    /// few for a beam.
    points: Option<(Aabb<R>, R)>,
    /// The object, if no ray that leaves it outward meets it again.
    receiver: Option<usize>,
    /// Whether a ray that leaves the object inward meets it again.
    is_met_inside: bool,
    lights: [Way; BEAM_LIGHTS],
}

impl<'t, 'p, 'm, R: Real, S: Geometry + 'm> Ways<'t, 'p, 'm, R, S> {
    /// The ways from the hits of these lanes.
    pub(super) fn new(group: &'t mut PixelGroup<'p, 'm, R, S>, run: &[Lane<'m, R>]) -> Self {
        let scene = group.scene;
        let mut ways = Self {
            group,
            points: None,
            receiver: None,
            is_met_inside: false,
            // Written one by one: a constant would be copied whole, with all its empty lists.
            lights: core::array::from_fn(|_| Way::New),
        };
        if let Some(object) = run.first().filter(|_| run.len() >= FEWEST_IN_BEAM).and_then(Lane::object) {
            let surfaces = run.iter().map(|lane| &lane.hit.surface);
            let points = surfaces.map(|surface| (Aabb::point(surface.point), surface.magnitude));
            ways.points = points.reduce(|a, b| (a.0.joined(b.0), a.1.larger(b.1)));
            let is_met_again = |outward| scene.is_met_again(Departure { object, outward });
            ways.receiver = (!is_met_again(true)).then_some(object);
            ways.is_met_inside = ways.receiver.is_some() && is_met_again(false);
        }
        ways
    }

    /// The way to a light; `None` if the points are too few for a beam.
    fn to(&mut self, light: usize) -> Option<&Way> {
        self.points?;
        if let Way::New = self.lights.get(light)? {
            self.look_up(light);
        }
        self.lights.get(light)
    }

    fn look_up(&mut self, light: usize) {
        let list = self.beam_to(light).and_then(|beam| self.group.list(&beam, self.receiver));
        if let Some(way) = self.lights.get_mut(light) {
            *way = match list {
                Some(list) if list.is_empty() => Way::Clear,
                Some(list) => Way::Listed(list),
                None => Way::Crowded,
            };
        }
    }

    /// The beam from the points to a light.
    fn beam_to(&self, light: usize) -> Option<Beam<R>> {
        let (points, magnitude) = self.points?;
        // A shadow ray begins this far from its point.
        let offset = R::offset(magnitude);
        match self.group.scene.lights.get(light)?.source {
            Source::At(position) => Some(Beam::toward_point(points, offset, position)),
            Source::Toward(direction) => Some(Beam::toward(points, offset, direction)),
            Source::Far(..) => None,
        }
    }
}

impl<R: Real, S: Geometry> ShadowRays<R> for Ways<'_, '_, '_, R, S> {
    fn through<T: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, T>,
        hit: &ShadedHit<'_, R>,
        light: usize,
        toward: Vec3<R>,
        distance: R,
    ) -> Through<Throughput<R>> {
        // Most often nothing is in the way: then no ray is needed.
        let meets_itself = self.is_met_inside && !hit.departure(toward, false).outward;
        let mut last = self.group.blockers.get(light).copied().unwrap_or(NO_OBJECT);
        let among = match self.to(light).filter(|_| !meets_itself) {
            Some(Way::Clear) => return Through::All,
            Some(Way::Listed(list)) => Among::Listed(list),
            _ => Among::All,
        };
        let ray = hit.hit.spawn(toward, hit.departure(toward, false));
        let through = scene.light_through_after(&ray, distance, among, &mut last);
        if let Some(blocker) = self.group.blockers.get_mut(light) {
            *blocker = last;
        }
        through
    }
}
