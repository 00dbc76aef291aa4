//! Which objects the cells of a few neighboring lines can show, and which of them are so thin that they could hide
//! between the points of the grid.

use super::super::Renderer;
use super::super::line_candidates::Span;
use super::super::outline::pixel;
use super::stadium::Stadium;
use crate::math::Real;
use crate::prepared::candidates::ObjectSet;
use crate::prepared::queries::Enclosure;
use crate::shape::Geometry;

/// The objects that each place of a strip of lines can show.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    spans: [Span; ObjectSet::CAPACITY],
    objects: usize,
}

impl Strip {
    /// The candidates for the pixel centers of the lines from `top` to `bottom`, both included; `None` where they
    /// are not known.
    pub(super) fn new<R: Real, S: Geometry>(
        renderer: &Renderer<'_, '_, R, S>,
        top: u16,
        bottom: u16,
    ) -> Option<Self> {
        // A pixel of room for rounding.
        let half = R::Setup::from_f32(0.5);
        let (upper, lower) =
            (R::Setup::from_u16(top) - half, R::Setup::from_u16(bottom) + half + R::Setup::ONE);
        let mut spans = [Span::NOWHERE; ObjectSet::CAPACITY];
        let mut objects = 0;
        let known = renderer.outlines.strip(top, bottom)?;
        for ((span, known), spine) in spans.iter_mut().zip(known).zip(renderer.scene.spines()) {
            *span = known;
            if let Some(stadium) = spine.and_then(|spine| Stadium::new(&renderer.viewport, &spine)) {
                *span = match stadium.extent(upper, lower) {
                    Some((left, right)) => span.common(Span { start: pixel(left, -1), end: pixel(right, 2) }),
                    None => Span::NOWHERE,
                };
            }
            objects += 1;
        }
        Some(Self { spans, objects })
    }

    /// The objects that the pixels from `left` to `right`, both included, can show.
    pub(super) fn between(&self, left: u16, right: u16) -> ObjectSet {
        let mut set = ObjectSet::NONE;
        for (index, span) in self.spans.iter().take(self.objects).enumerate() {
            if span.start <= right && left < span.end {
                set = set.with(index);
            }
        }
        set
    }
}

/// The objects that are less than `pixels` wide or high in the picture.
pub(super) fn thin_objects<R: Real, S: Geometry>(
    renderer: &Renderer<'_, '_, R, S>,
    pixels: u16,
) -> ObjectSet {
    let mut thin = ObjectSet::NONE;
    let Some(enclosures) = renderer.scene.enclosures() else { return thin };
    let (viewport, limit) = (&renderer.viewport, R::Setup::from_u16(pixels));
    for (index, (enclosure, spine)) in enclosures.zip(renderer.scene.spines()).enumerate() {
        let is_small = match enclosure {
            Enclosure::Ball { center, radius } => {
                let distance = (center.to_setup() - viewport.eye().to_setup()).length();
                let radius = radius.to_setup();
                radius + radius < distance * viewport.pixel() * limit
            }
            Enclosure::Box(bounds) => viewport
                .frame(bounds.to_setup())
                .is_some_and(|frame| frame.right - frame.left < limit || frame.bottom - frame.top < limit),
            Enclosure::Everywhere => false,
        };
        let is_narrow = || {
            let stadium = spine.and_then(|spine| Stadium::new(viewport, &spine));
            stadium.is_some_and(|stadium| stadium.radius + stadium.radius < limit)
        };
        if is_small || is_narrow() {
            thin = thin.with(index);
        }
    }
    thin
}
