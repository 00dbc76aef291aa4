//! The objects that the cells of a few neighboring lines can show.

use super::super::Renderer;
use super::small::{ThinCells, heights};
use crate::math::Real;
use crate::prepared::ObjectSet;
use crate::render::pixel::Aim;
use crate::render::span::Span;
use crate::shape::Geometry;

/// The columns in which each object can be seen on a strip of lines.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    spans: [Span; ObjectSet::CAPACITY],
    objects: usize,
}

impl Strip {
    /// The objects that pixels on the lines from `top` to `bottom`, both included, can show to rays with this
    /// aim; `None` if they are not known. Objects that may be thin are placed by their hulls, which are
    /// closer than outlines; their places are added to `thin`.
    pub(super) fn new<R: Real, S: Geometry>(
        renderer: &Renderer<'_, '_, R, S>,
        lines: (u16, u16),
        aim: Aim,
        thin: &mut ThinCells,
    ) -> Option<Self> {
        let known = renderer.outlines.strip(lines, aim)?;
        let heights = heights::<R>(lines);
        let mut strip = Self { spans: [Span::NOWHERE; ObjectSet::CAPACITY], objects: 0 };
        for (index, (span, known)) in strip.spans.iter_mut().zip(known).enumerate() {
            *span = known;
            if thin.may_have(index) {
                *span = thin.add_object(renderer, index, heights, known);
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
}
