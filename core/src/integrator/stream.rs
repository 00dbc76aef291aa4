//! Neighboring pixels of a line side by side: what rays that lie together can meet is looked up once for all of them.
//!
//! A group of pixels is traced in step: all camera rays, then all shadow rays of what those meet, then all mirrored rays, and so
//! on. Rays of neighbors that leave the same surface make a [`Beam`]; so do, from neighbors on one object, the ways to a light. The
//! beam goes through the hierarchy instead of its rays, and each ray tests the few objects that the beam can meet: most often
//! none, on the way to a light. (After Reshetov, Soupikov and Hurley, "Multi-Level Ray Tracing Algorithm", SIGGRAPH 2005; the beams
//! are those of Haines and Wallace's shafts.) Where a beam meets many objects, or there is but one ray, rays go through the
//! hierarchy alone.
//!
//! What each ray meets is the same, and what each pixel adds up comes in the same order, so that not a byte differs.
//!
//! On x86-64, one thread, that takes instructions down to 0.61 (balls_s3 0.63, teapot_s2 0.61, rings_s1 0.61 at 512x512). Groups of
//! 32 take 2 to 4 % more, since fewer beams are narrow. Rejected: to let rays go on from the boxes that a beam meets, instead of from the objects in
//! them; 1.25 times the instructions, for what boxes near a ray hold it meets more often than not.
//!
//! A ray through glass waits until a mirrored one is done. Pixels that have such rays are finished alone, so that one stack is enough
//! for all. A group takes four kilobytes of stack, and is traced so only where a processor tests four boxes at once: what is built for
//! others has none of it.

use heapless::Vec;

use super::vertex::{Shading, Vertex};
use super::{Bounds, Path, RayBudget, Waiting};
use crate::color::LinearRgb;
use crate::hierarchy::{Beam, Hierarchy};
use crate::light::Source;
use crate::math::{Aabb, Ray, Real, Vec3};
use crate::prepared::candidates::Departure;
use crate::prepared::queries::HitOn;
use crate::prepared::{PreparedScene, Through};
use crate::probe::Probe;
use crate::shape::Geometry;
use crate::share::Share;

/// The most pixels in a group.
pub(crate) const WIDTH: usize = 16;
/// The most objects that are tested one by one.
const MOST: usize = 16;
/// For so many lights beams are looked up.
const LIGHTS: usize = 8;

/// What a beam can meet, from the lowest position up.
type List = Vec<u16, MOST>;

/// Traces pixels of a scene side by side.
pub(crate) struct Stream<'p, 'm, R: Real, S: Geometry + 'm> {
    scene: &'p PreparedScene<'m, R, S>,
    hierarchy: &'p Hierarchy<'m, R>,
}

/// One pixel of a group.
struct Lane<'m, R: Real> {
    path: Path<R>,
    rays: RayBudget,
    goes_on: bool,
    /// Where the ray at hand ends.
    hit: Option<HitOn<'m, R>>,
}

impl<R: Real> Lane<'_, R> {
    /// The object there.
    fn object(&self) -> Option<usize> {
        self.hit.as_ref().map(|(hit, _)| hit.object)
    }
}

impl<'p, 'm, R: Real, S: Geometry + 'm> Stream<'p, 'm, R, S> {
    /// `None` where nothing would be gained.
    pub(crate) fn new(scene: &'p PreparedScene<'m, R, S>) -> Option<Self> {
        if R::REACH.is_some() || cfg!(not(any(target_feature = "sse2", target_feature = "neon"))) {
            return None;
        }
        Some(Self { scene, hierarchy: scene.hierarchy()? })
    }

    /// Tells the light that comes along each of some camera rays, of which there are to be no more than [`WIDTH`].
    pub(crate) fn radiance(
        &self,
        rays: impl Iterator<Item = Ray<R>>,
        bounds: &Bounds<R>,
        budget: RayBudget,
        probe: &mut impl Probe<R>,
        mut show: impl FnMut(usize, LinearRgb<R>),
    ) {
        let mut lanes: Vec<Lane<'m, R>, WIDTH> = Vec::new();
        for ray in rays {
            let pushed = lanes.push(Lane { path: Path::new(ray), rays: budget, goes_on: true, hit: None });
            debug_assert!(pushed.is_ok(), "more rays than in a group");
        }
        let mut waiting = Waiting::new();
        loop {
            let mut all_end = true;
            for lane in &mut lanes {
                lane.goes_on = lane.goes_on && lane.path.goes_on(&mut lane.rays, probe);
                all_end = all_end && !lane.goes_on;
            }
            if all_end {
                break;
            }
            for run in lanes.chunk_by_mut(|a, b| a.goes_on == b.goes_on && a.path.from() == b.path.from()) {
                self.meet(run);
            }
            for run in lanes.chunk_by_mut(|a, b| a.goes_on == b.goes_on && a.object() == b.object()) {
                self.shade(run, &mut waiting, bounds, probe);
            }
        }
        for (index, lane) in lanes.iter().enumerate() {
            show(index, lane.path.light);
        }
    }

    /// Finds where rays end that leave the same surface to the same side.
    #[inline(always)]
    fn meet(&self, run: &mut [Lane<'m, R>]) {
        let Some(first) = run.first().filter(|lane| lane.goes_on) else { return };
        let mut list = None;
        if run.len() > 1
            && let Some(beam) = Beam::around(run.iter().map(|lane| &lane.path.next.ray))
        {
            let left = first.path.from().filter(|from| !self.scene.is_met_again(*from));
            list = self.list(&beam, left.map(|from| from.object));
        }
        for lane in run {
            let ray = &lane.path.next.ray;
            lane.hit = match &list {
                Some(list) => self.scene.closest_hit_in(ray, list),
                None => self.scene.closest_hit_from(ray, lane.path.from(), None),
            };
        }
    }

    /// Goes on from where rays end on the same object.
    #[inline(always)]
    fn shade(
        &self,
        run: &mut [Lane<'m, R>],
        waiting: &mut Waiting<R>,
        bounds: &Bounds<R>,
        probe: &mut impl Probe<R>,
    ) {
        if !run.first().is_some_and(|lane| lane.goes_on) {
            return;
        }
        let mut ways = Ways::new(self, run);
        for lane in run {
            let find = |_: &Ray<R>, _| lane.hit;
            lane.goes_on =
                lane.path.follow(self.scene, find, &mut ways, waiting, bounds, &mut lane.rays, probe);
            if !waiting.is_empty() {
                self.finish(&mut lane.path, waiting, bounds, &mut lane.rays, probe);
                lane.goes_on = false;
            }
        }
    }

    /// Follows the rays of one pixel to their end.
    #[inline(never)]
    fn finish(
        &self,
        path: &mut Path<R>,
        waiting: &mut Waiting<R>,
        bounds: &Bounds<R>,
        rays: &mut RayBudget,
        probe: &mut impl Probe<R>,
    ) {
        while path.goes_on(rays, probe) {
            let find = |ray: &Ray<R>, from| self.scene.closest_hit_from(ray, from, None);
            if !path.follow(self.scene, find, &mut None, waiting, bounds, rays, probe) {
                return;
            }
        }
        waiting.clear();
    }

    /// What a beam can meet but for one object, unless that is much.
    #[inline(never)]
    fn list(&self, beam: &Beam<R>, but: Option<usize>) -> Option<List> {
        let mut list = List::new();
        let is_complete = self
            .hierarchy
            .gather(beam, |object| but == Some(usize::from(object)) || insert(&mut list, object));
        is_complete.then_some(list)
    }
}

/// Inserts an object where it belongs, if there is room.
#[inline(always)]
fn insert(list: &mut List, object: u16) -> bool {
    if list.push(object).is_err() {
        return false;
    }
    let mut rest: &mut [u16] = list;
    while let [.., before, last] = rest
        && *before > *last
    {
        core::mem::swap(before, last);
        rest = rest.split_last_mut().map_or(&mut [], |(_, rest)| rest);
    }
    true
}

/// The ways from some points of an object to the lights.
struct Ways<'t, 'p, 'm, R: Real, S: Geometry + 'm> {
    stream: &'t Stream<'p, 'm, R, S>,
    /// The points, and the largest number that they were computed from; `None` where beams are not worth while.
    points: Option<(Aabb<R>, R)>,
    /// The object, where no ray that leaves it outward meets it again.
    receiver: Option<usize>,
    /// Whether one that leaves it inward does.
    is_met_inside: bool,
    lights: [InTheWay; LIGHTS],
}

/// What can stand between the points and a light.
enum InTheWay {
    NotLookedUp,
    Much,
    These(List),
}

impl<'t, 'p, 'm, R: Real, S: Geometry + 'm> Ways<'t, 'p, 'm, R, S> {
    /// From where the rays of these lanes end.
    #[inline(always)]
    fn new(stream: &'t Stream<'p, 'm, R, S>, run: &[Lane<'m, R>]) -> Self {
        let mut ways = Self {
            stream,
            points: None,
            receiver: None,
            is_met_inside: false,
            lights: [const { InTheWay::NotLookedUp }; LIGHTS],
        };
        if let [first, _, ..] = run
            && let Some(object) = first.object()
        {
            let hits = run.iter().filter_map(|lane| lane.hit.as_ref());
            let points = hits.map(|(hit, _)| (Aabb::point(hit.surface.point), hit.surface.magnitude));
            ways.points = points.reduce(|a, b| (a.0.union(b.0), a.1.larger(b.1)));
            let is_met_again = |outward| stream.scene.is_met_again(Departure { object, outward });
            ways.receiver = (!is_met_again(true)).then_some(object);
            ways.is_met_inside = ways.receiver.is_some() && is_met_again(false);
        }
        ways
    }

    /// What can be in the way to a light, if it is known.
    #[inline(always)]
    fn to(&mut self, light: usize) -> Option<&List> {
        let (points, magnitude) = self.points?;
        let in_the_way = self.lights.get_mut(light)?;
        if let InTheWay::NotLookedUp = in_the_way {
            // A shadow ray begins that far beside its point.
            let beside = R::offset(magnitude);
            let beam = match self.stream.scene.lights.get(light)?.source {
                Source::At(position) => Beam::toward_point(points, beside, position),
                Source::Toward(direction) => Beam::toward(points, beside, direction),
                Source::Far(..) => return None,
            };
            let list = self.stream.list(&beam, self.receiver);
            *in_the_way = list.map_or(InTheWay::Much, InTheWay::These);
        }
        if let InTheWay::These(list) = in_the_way { Some(list) } else { None }
    }
}

impl<R: Real, S: Geometry> Shading<R> for Ways<'_, '_, '_, R, S> {
    #[inline(always)]
    fn through<T: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, T>,
        vertex: &Vertex<'_, R>,
        light: usize,
        toward: Vec3<R>,
        distance: R,
    ) -> Through<Share<R>> {
        let from = vertex.departure(toward);
        let meets_itself = self.is_met_inside && !from.outward;
        match self.to(light).filter(|_| !meets_itself) {
            Some(list) if list.is_empty() => Through::All,
            Some(list) => scene.light_through_list(&vertex.spawn(toward, from), distance, list),
            None => scene.light_through_among(&vertex.spawn(toward, from), distance, None),
        }
    }
}
