//! Neighboring pixels side by side: what rays that lie together can meet is looked up once for all of them.
//!
//! A group of pixels is traced in step: all camera rays, then all shadow rays of what those meet, then all mirrored rays, and so
//! on. Rays of neighbors that leave the same surface make a [`Beam`]; so do, from neighbors on one object, the ways to a light. The
//! beam goes through the hierarchy instead of its rays, and each ray tests the few objects that the beam can meet: most often
//! none, on the way to a light. (After Reshetov, Soupikov and Hurley, "Multi-Level Ray Tracing Algorithm", SIGGRAPH 2005; the beams
//! are those of Haines and Wallace's shafts.) Where a beam meets many objects, or there is but one ray, rays go through the
//! hierarchy alone, but not before what was last in the way to that light (balls_s3 takes 0.98 of the time, teapot_s2 and rings_s1 0.99).
//!
//! What each ray meets is the same, and what each pixel adds up comes in the same order, so that not a byte differs.
//!
//! On an M4F `flake` with 91 balls takes 0.40 of the instructions that it took pixel by pixel, with 820 balls 0.47. On x86-64 groups of
//! one line took instructions down to 0.63 (balls_s3) and 0.61 (teapot_s2, rings_s1, all at 512x512). Groups of 32 pixels take 2 % less for 91
//! balls and 3 % more for 820; lists of 16 or 32 objects instead of 24 take up to 5 % more. On x86-64 squares of 64 pixels take 0.96
//! (balls_s3), 0.94 (teapot_s2) and 0.97 (rings_s1) times the time of squares of 16; 128 pixels take as long, and so do lists of 40
//! objects, and pixels along Hilbert's curve instead of to and fro. Where the processor computes four numbers
//! at once, four rays test the objects of a list together ([`FourRays`]): 1.00 (balls_s3), 0.93 (teapot_s2) and 0.95 (rings_s1) times the
//! time. Rejected:
//! - lists with the nearest first, of which a ray tests no more once something nearer was met: 1.00 to 1.03 times the time on x86-64,
//!   as what is in a list lies at much the same distance;
//! - to leave out of a list what is long and thin and lies beside the cone around the beam: 0.96 times for rings_s1 before four rays
//!   were tested together, 1.00 since; balls and triangles, in the same way, 1.00 to 1.04 times;
//! - shadow rays four at a time: 1.00 to 1.07 times, as what blocked the ray before is asked first and mostly blocks the next;
//! - halves of a beam that meets many objects, and halves of those: 1.01 to 1.08 times;
//! - to let rays go on from the boxes that a beam meets, instead of from the objects in them: 1.25 times the instructions, for what
//!   boxes near a ray hold it meets more often than not;
//! - beams to a light from all pixels of a group, instead of from those on one object: 1.2 times, as they meet what all those lie on;
//! - to bring pixels together that are on one object but not side by side: 1.03 times.
//!
//! A ray through glass waits until a mirrored one is done. Pixels that have such rays are finished alone, so that one stack is enough
//! for all. A group of 16 takes 3 KB of stack in `f32`, and the code 15 KB of flash: the feature `hierarchy`.

use heapless::Vec;

use super::vertex::{Shading, Vertex};
use super::{Bounds, Path, PendingRay, RayBudget, Shades, Waiting};
use crate::color::LinearRgb;
use crate::hierarchy::{Beam, Hierarchy, WIDE};
use crate::light::Source;
use crate::limits::LINES_AT_ONCE;
use crate::material::PreparedMaterial;
use crate::math::{Aabb, FOUR_AT_ONCE, FourRays, Ray, Real, Vec3};
use crate::prepared::candidates::{Departure, ObjectSet};
use crate::prepared::queries::{Closest, NOTHING};
use crate::prepared::{Hit, PreparedScene, Through};
use crate::probe::Probe;
use crate::shape::Geometry;
use crate::share::Share;

/// The most pixels in a group: a square's, which is a multiple of four.
pub(crate) const WIDTH: usize = LINES_AT_ONCE * LINES_AT_ONCE;
/// The most objects that are tested one by one.
const MOST: usize = 24;
/// So many rays are tested four at a time, at least.
const FEWEST: usize = 3;
/// For so many rays a beam is worth while, at least: for two of them an M4F takes 1.01 times the instructions of going without for 91
/// balls, 1.04 for 820, and x86-64 1.015 times the time for balls_s3.
const BEAM: usize = 3;
/// For so many lights beams are looked up.
const LIGHTS: usize = 8;

/// What a beam can meet.
type List = Vec<u16, MOST>;

/// Traces pixels of a scene side by side.
pub(crate) struct Stream<'p, 'm, R: Real, S: Geometry + 'm> {
    scene: &'p PreparedScene<'m, R, S>,
    hierarchy: &'p Hierarchy<'m, R, WIDE>,
    /// What was last in the way to each light, for rays that go alone.
    blockers: [u32; LIGHTS],
}

/// One pixel of a group.
#[repr(C)] // As `PendingRay`.
pub(crate) struct Lane<'m, R: Real> {
    path: Path<R>,
    rays: RayBudget,
    goes_on: bool,
    /// Where the ray at hand ends, if it does.
    hit: Hit<R>,
    /// The material there; `None` where it meets nothing.
    material: Option<&'m PreparedMaterial<'m, R>>,
}

/// The pixels of a group.
pub(crate) type Lanes<'m, R> = Vec<Lane<'m, R>, WIDTH>;

impl<'m, R: Real> Lane<'m, R> {
    /// One without a ray.
    pub(crate) fn new() -> Self {
        let nowhere = Ray { origin: Vec3::ZERO, direction: Vec3::ZERO };
        Self {
            path: Path::new(nowhere, ObjectSet::ALL),
            rays: RayBudget(0),
            goes_on: false,
            hit: Hit::BLANK,
            material: None,
        }
    }

    /// Begins with a camera ray, and the rays that it may spend. In place: a copy would wait for what was just written to reach memory.
    #[inline(always)]
    pub(crate) fn begin(&mut self, ray: Ray<R>, rays: RayBudget) {
        self.path = Path::new(ray, ObjectSet::ALL);
        self.rays = rays;
        self.goes_on = true;
    }

    /// The light that came along the camera ray.
    pub(crate) fn light(&self) -> LinearRgb<R> {
        self.path.light
    }

    /// The rays that it may still spend.
    pub(crate) fn left(&self) -> RayBudget {
        self.rays
    }

    /// The object there.
    fn object(&self) -> Option<usize> {
        self.material.map(|_| self.hit.object)
    }

    /// Where the ray at hand ends: at this distance, on the object of this position.
    #[inline(always)]
    fn meet<S: Geometry>(&mut self, scene: &PreparedScene<'m, R, S>, closest: Option<(R, usize)>) {
        self.material = scene.meet_at(&self.path.next.ray, closest, &mut self.hit);
    }
}

/// Takes the first lanes that have the same key.
#[inline(always)]
fn take_run<'l, 'm, R: Real, K: PartialEq>(
    rest: &mut &'l mut [Lane<'m, R>],
    key: impl Fn(&Lane<'m, R>) -> K,
) -> Option<&'l mut [Lane<'m, R>]> {
    let first = key(rest.first()?);
    let count = rest.iter().take_while(|lane| key(lane) == first).count();
    let (run, others) = core::mem::take(rest).split_at_mut_checked(count)?;
    *rest = others;
    Some(run)
}

impl<'p, 'm, R: Real, S: Geometry + 'm> Stream<'p, 'm, R, S> {
    /// `None` where nothing would be gained.
    pub(crate) fn new(scene: &'p PreparedScene<'m, R, S>) -> Option<Self> {
        if !cfg!(feature = "hierarchy") || R::IS_FIXED_POINT {
            return None;
        }
        Some(Self { scene, hierarchy: scene.hierarchy()?, blockers: [NOTHING; LIGHTS] })
    }

    /// Traces the camera rays of a group, and all that follow.
    pub(crate) fn trace(&mut self, lanes: &mut [Lane<'m, R>], bounds: &Bounds<R>, probe: &mut impl Probe<R>) {
        let mut waiting = Waiting::new();
        loop {
            let mut all_end = true;
            for lane in &mut *lanes {
                lane.goes_on = lane.goes_on && lane.path.goes_on(&mut lane.rays, probe);
                all_end = all_end && !lane.goes_on;
            }
            if all_end {
                break;
            }
            let mut rest = &mut *lanes;
            while let Some(run) = take_run(&mut rest, |lane| (lane.goes_on, lane.path.next.from)) {
                self.meet(run);
            }
            let mut rest = &mut *lanes;
            while let Some(run) = take_run(&mut rest, |lane| (lane.goes_on, lane.object())) {
                self.shade(run, &mut waiting, bounds, probe);
            }
        }
    }

    /// Finds where rays end that leave the same surface to the same side.
    #[inline(always)]
    fn meet(&self, run: &mut [Lane<'m, R>]) {
        let Some(first) = run.first().filter(|lane| lane.goes_on) else { return };
        let mut list = None;
        if run.len() >= BEAM
            && let Some(beam) = Beam::around(run.iter().map(|lane| &lane.path.next.ray))
        {
            let left = first.path.next.from;
            list = self.list(&beam, (!self.scene.is_met_again(left)).then_some(left.object));
            // Of several objects at the same distance the first counts.
            if let Some(list) = &mut list {
                sort(list);
            }
        }
        match &list {
            Some(list) if FOUR_AT_ONCE => self.meet_by_four(run, list),
            _ => {
                for lane in run {
                    let ray = &lane.path.next.ray;
                    let closest = match &list {
                        Some(list) => self.scene.closest_in(ray, list),
                        None => self.scene.closest_from(ray, lane.path.next.from, ObjectSet::ALL),
                    };
                    lane.meet(self.scene, closest);
                }
            }
        }
    }

    /// Finds where rays end that can meet none but these objects, four rays at a time.
    #[inline(always)]
    fn meet_by_four(&self, run: &mut [Lane<'m, R>], list: &[u16]) {
        // Hits are written one after the other in the end: where four are written at once, each waits for the one before.
        let mut closest: Vec<Closest<R>, WIDTH> = Vec::new();
        for lanes in run.chunks(4) {
            if lanes.len() < FEWEST {
                for lane in lanes {
                    let _ = closest.push(self.scene.closest_of_one(&lane.path.next.ray, list));
                }
                continue;
            }
            let [first, others @ ..] = lanes else { continue };
            // The last again where there are three.
            let ray = |place: usize| &others.get(place).or(others.last()).unwrap_or(first).path.next.ray;
            let rays = FourRays::new([&first.path.next.ray, ray(0), ray(1), ray(2)]);
            for found in self.scene.closest_of_four(&rays, list) {
                // No more are found than fit, as their number is a multiple of four.
                let _ = closest.push(found);
            }
        }
        for (lane, &(t, object)) in run.iter_mut().zip(&closest) {
            lane.meet(self.scene, (object != NOTHING).then_some((t, object as usize)));
        }
    }

    /// Goes on from where rays end on the same object.
    #[inline(always)]
    fn shade(
        &mut self,
        run: &mut [Lane<'m, R>],
        waiting: &mut Waiting<R>,
        bounds: &Bounds<R>,
        probe: &mut impl Probe<R>,
    ) {
        if !run.first().is_some_and(|lane| lane.goes_on) {
            return;
        }
        let scene = self.scene;
        let mut ways = Ways::new(self, run);
        for lane in run {
            let Lane { path, rays, hit, material, .. } = lane;
            let find = |_: &PendingRay<R>| material.map(|material| (&*hit, material));
            lane.goes_on = path.follow(scene, find, &mut ways, waiting, bounds, rays, probe);
            if !waiting.is_empty() {
                lane.path.end(scene, &Shades::UNKNOWN, waiting, bounds, &mut lane.rays, probe);
                lane.goes_on = false;
            }
        }
    }

    /// What can stand between some points and a light but for one object, unless that is much.
    #[inline(always)]
    fn way(&self, (points, magnitude): (Aabb<R>, R), light: usize, but: Option<usize>) -> Option<List> {
        // A shadow ray begins that far beside its point.
        let beside = R::offset(magnitude);
        let beam = match self.scene.lights.get(light)?.source {
            Source::At(position) => Beam::toward_point(points, beside, position),
            Source::Toward(direction) => Beam::toward(points, beside, direction),
            Source::Far(..) => return None,
        };
        self.list(&beam, but)
    }

    /// What a beam can meet but for one object, unless that is much.
    #[inline(never)]
    fn list(&self, beam: &Beam<R>, but: Option<usize>) -> Option<List> {
        let mut list = List::new();
        let is_much = self
            .hierarchy
            .any_in_beam(beam, |object| but != Some(object) && list.push(object as u16).is_err());
        (!is_much).then_some(list)
    }
}

/// Brings objects in order: the lowest position first.
fn sort(objects: &mut [u16]) {
    for sorted in 2..=objects.len() {
        let mut rest = objects.get_mut(..sorted).unwrap_or_default();
        while let [.., before, last] = rest
            && *before > *last
        {
            core::mem::swap(before, last);
            rest = rest.split_last_mut().map_or(&mut [], |(_, rest)| rest);
        }
    }
}

/// The ways from some points to a light.
enum Way {
    /// Not looked up.
    New,
    /// Nothing is in it.
    Clear,
    /// No more than these can be in it.
    Among(List),
    /// Much can be in it.
    Unknown,
}

/// The ways from some points of an object to the lights.
struct Ways<'t, 'p, 'm, R: Real, S: Geometry + 'm> {
    stream: &'t mut Stream<'p, 'm, R, S>,
    /// The points, and the largest number that they were computed from; `None` where beams are not worth while.
    points: Option<(Aabb<R>, R)>,
    /// The object, where no ray that leaves it outward meets it again.
    receiver: Option<usize>,
    /// Whether one that leaves it inward does.
    is_met_inside: bool,
    lights: [Way; LIGHTS],
}

impl<'t, 'p, 'm, R: Real, S: Geometry + 'm> Ways<'t, 'p, 'm, R, S> {
    /// From where the rays of these lanes end.
    #[inline(always)]
    fn new(stream: &'t mut Stream<'p, 'm, R, S>, run: &[Lane<'m, R>]) -> Self {
        let scene = stream.scene;
        let mut ways = Self {
            stream,
            points: None,
            receiver: None,
            is_met_inside: false,
            // Written one by one: a constant would be copied, with all that is not there yet.
            lights: core::array::from_fn(|_| Way::New),
        };
        if let Some(object) = run.first().filter(|_| run.len() >= BEAM).and_then(Lane::object) {
            let surfaces = run.iter().map(|lane| &lane.hit.surface);
            let points = surfaces.map(|surface| (Aabb::point(surface.point), surface.magnitude));
            ways.points = points.reduce(|a, b| (a.0.joined(b.0), a.1.larger(b.1)));
            let is_met_again = |outward| scene.is_met_again(Departure { object, outward });
            ways.receiver = (!is_met_again(true)).then_some(object);
            ways.is_met_inside = ways.receiver.is_some() && is_met_again(false);
        }
        ways
    }

    /// The way to a light; `None` where beams are not worth while.
    #[inline(always)]
    fn to(&mut self, light: usize) -> Option<&mut Way> {
        self.points?;
        if let Way::New = self.lights.get(light)? {
            self.look_up(light);
        }
        self.lights.get_mut(light)
    }

    #[inline(never)]
    fn look_up(&mut self, light: usize) {
        if let (Some(points), Some(way)) = (self.points, self.lights.get_mut(light)) {
            *way = match self.stream.way(points, light, self.receiver) {
                Some(list) if list.is_empty() => Way::Clear,
                Some(list) => Way::Among(list),
                None => Way::Unknown,
            };
        }
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
        // Most often nothing is in the way: neither is then computed.
        let from = || vertex.departure(toward, false);
        let ray = || vertex.spawn(toward, from());
        let meets_itself = self.is_met_inside && !from().outward;
        match self.to(light).filter(|_| !meets_itself) {
            Some(Way::Clear) => Through::All,
            Some(Way::Among(list)) => {
                let through = scene.light_through_list(&ray(), distance, list);
                if let Through::Nothing = through
                    && let Some(first) = list.first().copied()
                    && let Some(last) = self.stream.blockers.get_mut(light)
                {
                    *last = u32::from(first);
                }
                through
            }
            _ => {
                let Stream { scene, hierarchy, blockers } = &mut *self.stream;
                let mut nothing = NOTHING;
                let last = blockers.get_mut(light).unwrap_or(&mut nothing);
                scene.light_through_hierarchy(hierarchy, &ray(), distance, last)
            }
        }
    }
}
