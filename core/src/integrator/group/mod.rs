//! Neighboring pixels in step: objects that several rays can meet are looked up once.
//!
//! A group of pixels is traced in step: all camera rays, then all shadow rays of their hits, then all
//! reflected rays, and so on. Rays of neighbors that leave the same surface make a [`Beam`]. Points of
//! neighbors on one object make a beam toward each light ([`Ways`]). The beam goes through the hierarchy
//! instead of its rays, and each ray then tests the few objects that the beam can meet: most often none, on
//! the way to a light (Reshetov, Soupikov and Hurley, "Multi-Level Ray Tracing Algorithm", SIGGRAPH 2005; the
//! beams are the shafts of Haines and Wallace, 1991). A beam that can meet many objects is given up: its rays
//! go through the hierarchy one by one.
//!
//! Each ray meets the same objects as alone, and the light of each pixel is added in the same order, so no
//! byte differs.
//!
//! A refracted ray waits until the reflected one is done. A pixel with waiting rays is finished alone, so one
//! stack serves all pixels. Measurements and rejected variants: docs/experiments.md.

mod lane;
mod ways;

pub(crate) use lane::{Lane, Lanes};

use heapless::Vec;

use super::path::Waiting;
use super::shadow_rays::Blockers;
use super::{RayBudget, RayLimits, Trace};
use crate::hierarchy::{Beam, Hierarchy, WIDE};
use crate::limits::LINES_AT_ONCE;
use crate::math::{FOUR_AT_ONCE, FourRays, Interval, Real};
use crate::prepared::closest::{Closest, NO_OBJECT};
use crate::prepared::{Among, ObjectSet, PreparedScene};
use crate::probe::Probe;
use crate::sampling::RayNumbers;
use crate::shape::Geometry;
use lane::take_run;
use ways::{BEAM_LIGHTS, Ways};

/// The most pixels in a group: those of a square, and a multiple of four.
pub(crate) const WIDTH: usize = LINES_AT_ONCE * LINES_AT_ONCE;
/// The most objects that a beam lists.
const MOST_LISTED: usize = 24;
/// The fewest rays that are tested four at a time.
const FEWEST_OF_FOUR: usize = 3;
/// The fewest rays that make a beam.
const FEWEST_IN_BEAM: usize = 3;

/// The objects that a beam can meet.
type List = Vec<u16, MOST_LISTED>;

/// Traces groups of pixels of a scene with a hierarchy.
pub(crate) struct PixelGroup<'p, 'm, R: Real, S: Geometry + 'm> {
    scene: &'p PreparedScene<'m, R, S>,
    hierarchy: &'p Hierarchy<'m, R, WIDE>,
    /// The object that last blocked each light.
    blockers: [u32; BEAM_LIGHTS],
}

impl<'p, 'm, R: Real, S: Geometry + 'm> PixelGroup<'p, 'm, R, S> {
    /// `None` where groups gain nothing: in fixed point, and in scenes without a hierarchy.
    pub(crate) fn new(scene: &'p PreparedScene<'m, R, S>) -> Option<Self> {
        if !cfg!(feature = "hierarchy") || R::IS_FIXED_POINT {
            return None;
        }
        Some(Self { scene, hierarchy: scene.hierarchy()?, blockers: [NO_OBJECT; BEAM_LIGHTS] })
    }

    /// Traces the camera rays of a group, and all rays that follow.
    pub(crate) fn trace(
        &mut self,
        lanes: &mut [Lane<'m, R>],
        limits: &RayLimits<R>,
        probe: &mut impl Probe<R>,
    ) {
        let mut trace = Trace::new(self.scene, limits, RayBudget(0), RayNumbers::NONE, probe);
        let mut waiting = Waiting::new();
        loop {
            let mut all_end = true;
            for lane in &mut *lanes {
                trace.rays = lane.rays;
                lane.goes_on = lane.goes_on && lane.path.spend(&mut trace);
                lane.rays = trace.rays;
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
                self.shade(run, &mut trace, &mut waiting);
            }
        }
    }

    /// Finds the hits of rays that leave the same surface to the same side.
    fn meet(&self, run: &mut [Lane<'m, R>]) {
        let Some(first) = run.first().filter(|lane| lane.goes_on) else { return };
        let mut list = None;
        if run.len() >= FEWEST_IN_BEAM
            && let Some(beam) = Beam::around(run.iter().map(|lane| &lane.path.next.ray))
        {
            let left = first.path.next.from;
            list = self.list(&beam, (!self.scene.is_met_again(left)).then_some(left.object));
            // Of several objects at the same distance, the lowest position counts.
            if let Some(list) = &mut list {
                sort(list);
            }
        }
        match &list {
            Some(list) if FOUR_AT_ONCE && !self.scene.has_one_sided() => self.meet_by_four(run, list),
            _ => {
                for lane in run {
                    let ray = &lane.path.next.ray;
                    let closest = match &list {
                        Some(list) => self.scene.closest(ray, Interval::AHEAD, Among::Listed(list)),
                        None => self.scene.closest_from(ray, lane.path.next.from, ObjectSet::UNKNOWN),
                    };
                    lane.meet(self.scene, closest);
                }
            }
        }
    }

    /// Finds the hits of rays that can only meet listed objects, four rays at a time.
    fn meet_by_four(&self, run: &mut [Lane<'m, R>], list: &[u16]) {
        // Write the hits one after the other at the end: where four are written at once, each waits for the
        // one before.
        let mut closest: Vec<Closest<R>, WIDTH> = Vec::new();
        for lanes in run.chunks(4) {
            if lanes.len() < FEWEST_OF_FOUR {
                for lane in lanes {
                    let ray = &lane.path.next.ray;
                    let found = self.scene.closest(ray, Interval::AHEAD, Among::Listed(list));
                    let found = found.map_or((R::FARTHEST, NO_OBJECT), |(t, object)| (t, object as u32));
                    let _ = closest.push(found);
                }
                continue;
            }
            let [first, others @ ..] = lanes else { continue };
            // Of three rays, the last one stands twice.
            let ray = |place: usize| &others.get(place).or(others.last()).unwrap_or(first).path.next.ray;
            let rays = FourRays::new([&first.path.next.ray, ray(0), ray(1), ray(2)]);
            for found in self.scene.closest_of_four(&rays, list) {
                // There is room: the capacity is a multiple of four.
                let _ = closest.push(found);
            }
        }
        for (lane, &(t, object)) in run.iter_mut().zip(&closest) {
            lane.meet(self.scene, (object != NO_OBJECT).then_some((t, object as usize)));
        }
    }

    /// Shades hits on one object, and takes the next ray of each pixel.
    fn shade<P: Probe<R>>(
        &mut self,
        run: &mut [Lane<'m, R>],
        trace: &mut Trace<'_, 'm, R, S, P>,
        waiting: &mut Waiting<R>,
    ) {
        if !run.first().is_some_and(|lane| lane.goes_on) {
            return;
        }
        let mut ways = Ways::new(self, run);
        for lane in run {
            trace.rays = lane.rays;
            let met = lane.material.map(|material| (&lane.hit, material));
            lane.goes_on = lane.path.arrive(trace, met, &mut ways, waiting);
            if lane.goes_on {
                lane.path.keep_unit();
            }
            if !waiting.is_empty() {
                lane.path.finish(trace, &Blockers::UNKNOWN, waiting);
                lane.goes_on = false;
            }
            lane.rays = trace.rays;
        }
    }

    /// The objects that a beam can meet, without object `but`; `None` if there are many.
    fn list(&self, beam: &Beam<R>, but: Option<usize>) -> Option<List> {
        let mut list = List::new();
        let is_full = self
            .hierarchy
            .any_in_beam(beam, |object| but != Some(object) && list.push(object as u16).is_err());
        (!is_full).then_some(list)
    }
}

/// Sorts objects by position, in ascending order.
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
