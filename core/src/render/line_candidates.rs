//! The objects that each pixel of one line can show: most pixels then test one object, or none. And the
//! shadows that each pixel of the largest flat object can lie in: most of these then test nothing on the way
//! to a light.

use super::outlines::{Outlines, SHADOW_OUTLINES};
use super::span::Span;
use crate::integrator::{Blockers, Sight};
use crate::prepared::ObjectSet;

/// The objects that each pixel of one line can show.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineCandidates<'o> {
    outlines: &'o Outlines,
    /// The number of objects.
    objects: usize,
    /// The pixels in which each object can be seen.
    spans: [Span; ObjectSet::CAPACITY],
    /// The pixels on which each shadow can fall.
    shadows: [Span; SHADOW_OUTLINES],
    /// The objects whose spans hold the pixels from the last one that was looked up to `until`.
    current: ObjectSet,
    until: u16,
    /// The objects that can shade the pixels from the last one that was looked up to `blockers_until`.
    blockers: Blockers,
    blockers_until: u16,
}

impl<'o> LineCandidates<'o> {
    /// The candidates for the pixel centers of line `y`; `None` if no outlines are known.
    pub(super) fn new(outlines: &'o Outlines, y: u16) -> Option<Self> {
        let objects = outlines.count()?;
        let mut spans = [Span::NOWHERE; ObjectSet::CAPACITY];
        for (span, outline) in spans.iter_mut().zip(&outlines.objects).take(objects) {
            *span = outline.span(y);
        }
        let mut shadows = [Span::NOWHERE; SHADOW_OUTLINES];
        for (span, shadow) in shadows.iter_mut().zip(&outlines.shadows) {
            *span = shadow.outline.span(y);
        }
        let blockers = Blockers { receiver: outlines.receiver, before: outlines.others };
        Some(Self {
            outlines,
            objects,
            spans,
            shadows,
            current: ObjectSet::NONE,
            until: 0,
            blockers,
            blockers_until: 0,
        })
    }

    /// If no object can be seen in pixel `x`, the next pixel in which one can be. `x` must not decrease.
    #[inline]
    pub(super) fn nothing_until(&mut self, x: u16) -> Option<u16> {
        if x >= self.until {
            self.look_up(x);
        }
        self.current.is_empty().then_some(self.until)
    }

    /// The candidates of the ray through pixel `x`, for which [`nothing_until`](Self::nothing_until) was
    /// called last.
    #[inline]
    pub(super) fn sight(&mut self, x: u16) -> Sight<'_> {
        if x >= self.blockers_until {
            self.look_up_shadows(x);
        }
        Sight { among: self.current, blockers: &self.blockers }
    }

    /// The objects that pixel `x` can show. `x` must not decrease.
    #[cfg(feature = "looks")]
    pub(super) fn seen(&mut self, x: u16) -> ObjectSet {
        self.nothing_until(x);
        self.current
    }

    fn look_up(&mut self, x: u16) {
        self.current = ObjectSet::NONE;
        self.until = u16::MAX;
        for (index, span) in self.spans.iter().take(self.objects).enumerate() {
            if span.change_after(x, &mut self.until) {
                self.current = self.current.with(index);
            }
        }
    }

    fn look_up_shadows(&mut self, x: u16) {
        self.blockers.before = self.outlines.others;
        self.blockers_until = u16::MAX;
        for (shadow, span) in self.outlines.shadows.iter().zip(&self.shadows) {
            if span.change_after(x, &mut self.blockers_until)
                && let Some(blockers) = self.blockers.before.get_mut(usize::from(shadow.light))
            {
                *blockers = blockers.with(usize::from(shadow.object));
            }
        }
    }
}

#[cfg(feature = "candidates")]
#[cfg(test)]
mod tests {
    use super::super::outline::Outline;
    use super::super::outlines::ShadowOutline;
    use super::*;
    use crate::integrator::OUTLINED_LIGHTS;

    #[test]
    fn every_pixel_gets_its_objects_and_their_shadows() {
        let band = |start, end| Outline::Rectangle { across: Span { start, end }, top: 2, bottom: 4 };
        let mut outlines = Outlines { count: Some(4), receiver: 1, ..Outlines::UNKNOWN };
        outlines.objects[0] = band(3, 7);
        outlines.objects[1] = Outline::Everywhere;
        outlines.objects[2] = band(5, 5);
        outlines.shadows[0] = ShadowOutline { light: 0, object: 3, outline: band(2, 9) };
        outlines.shadows[1] = ShadowOutline { light: 1, object: 0, outline: band(8, 12) };
        outlines.others = [ObjectSet::NONE.with(2); OUTLINED_LIGHTS];
        for y in 0..6 {
            let mut line = LineCandidates::new(&outlines, y).unwrap();
            for x in 0..20 {
                let here = |start, end| (2..4).contains(&y) && (start..end).contains(&x);
                assert_eq!(line.nothing_until(x), None);
                let sight = line.sight(x);
                let objects: Vec<usize> = if here(3, 7) { vec![0, 1] } else { vec![1] };
                assert_eq!(sight.among.collect::<Vec<_>>(), objects);
                let before = sight.blockers.before;
                let first: Vec<usize> = if here(2, 9) { vec![2, 3] } else { vec![2] };
                let second: Vec<usize> = if here(8, 12) { vec![0, 2] } else { vec![2] };
                assert_eq!(before[0].collect::<Vec<_>>(), first);
                assert_eq!(before[1].collect::<Vec<_>>(), second);
                assert_eq!(before[2].collect::<Vec<_>>(), [2]);
            }
        }
    }
}
