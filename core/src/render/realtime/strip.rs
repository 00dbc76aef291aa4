//! What the cells of a few neighboring lines can show, and where something is so thin that it could hide between the points
//! of the grid.

use super::super::Renderer;
use super::super::line_candidates::Span;
use super::super::outline::pixel;
use super::Grid;
use super::stadium::Stadium;
use crate::math::Real;
use crate::prepared::candidates::ObjectSet;
use crate::shape::{Geometry, Hull};

/// What each place of a strip of lines can show.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    spans: [Span; ObjectSet::CAPACITY],
    objects: usize,
    thin: Places,
}

impl Strip {
    /// The candidates for the pixel centers of the lines from `top` to `bottom`, both included; `None` where they
    /// are not known. Some of the hulls of `thin` objects are thin.
    pub(super) fn new<R: Real, S: Geometry>(
        renderer: &Renderer<'_, '_, R, S>,
        top: u16,
        bottom: u16,
        thin: ObjectSet,
        grid: Grid,
    ) -> Option<Self> {
        let known = renderer.outlines.strip(top, bottom)?;
        let mut strip = Self { spans: [Span::NOWHERE; ObjectSet::CAPACITY], objects: 0, thin: Places::NONE };
        // A pixel of room for rounding.
        let half = R::Setup::from_f32(0.5);
        let (upper, lower) =
            (R::Setup::from_u16(top) - half, R::Setup::from_u16(bottom) + half + R::Setup::ONE);
        for (index, (span, known)) in strip.spans.iter_mut().zip(known).enumerate() {
            *span = known;
            if thin.contains(index) {
                let mut all = Span::NOWHERE;
                for hull in renderer.scene.hulls(index) {
                    let Some(stadium) = Stadium::new(&renderer.viewport, &hull) else {
                        all = Span::EVERYWHERE;
                        continue;
                    };
                    if let Some((left, right)) = stadium.extent(upper, lower) {
                        let place = known.common(Span { start: pixel(left, -1), end: pixel(right, 2) });
                        all = all.hull(place);
                        if stadium.is_thin(grid) {
                            strip.thin.add(place);
                        }
                    }
                }
                *span = known.common(all);
            }
            strip.objects += 1;
        }
        Some(strip)
    }

    /// The objects that the pixels from `left` to `right`, both included, can show.
    pub(super) fn between(&self, left: u16, right: u16) -> ObjectSet {
        let mut set = ObjectSet::NONE;
        for (index, span) in self.spans.iter().take(self.objects).enumerate() {
            if span.reaches(left, right) {
                set = set.with(index);
            }
        }
        set
    }

    /// Whether one of these pixels can show something thin.
    pub(super) fn is_thin(&self, left: u16, right: u16) -> bool {
        self.thin.reach(left, right)
    }
}

/// The objects of which a hull is thin where it is seen.
pub(super) fn thin_objects<R: Real, S: Geometry>(renderer: &Renderer<'_, '_, R, S>, grid: Grid) -> ObjectSet {
    let is_thin =
        |hull: Hull<R>| Stadium::new(&renderer.viewport, &hull).is_some_and(|stadium| stadium.is_thin(grid));
    renderer.scene.objects_where(|object| renderer.scene.hulls(object).any(is_thin))
}

/// How many places of a strip are known apart from each other.
const PLACES: usize = 12;

/// Some places of a strip.
#[derive(Clone, Copy, Debug)]
struct Places {
    spans: [Span; PLACES],
    count: usize,
}

impl Places {
    const NONE: Self = Self { spans: [Span::NOWHERE; PLACES], count: 0 };

    /// Adds one; of too many, the last become one.
    fn add(&mut self, place: Span) {
        if place.start >= place.end {
            return;
        }
        let spans = self.spans.get_mut(..self.count).unwrap_or_default();
        // Next to one that is known, it makes that longer.
        if let Some(near) = spans.iter_mut().find(|span| span.reaches(place.start, place.end)) {
            *near = near.hull(place);
        } else if let Some(free) = self.spans.get_mut(self.count) {
            *free = place;
            self.count += 1;
        } else if let Some(last) = self.spans.last_mut() {
            *last = last.hull(place);
        }
    }

    fn reach(&self, left: u16, right: u16) -> bool {
        self.spans.iter().take(self.count).any(|span| span.reaches(left, right))
    }
}
