//! What is small and whose place is known before the first ray: low shadows, and where something tapers off.
//!
//! Points of the grid near it are taken for such that are near a small highlight: every second pixel between them is looked at.
//!
//! *Low shadows* are those on a floor that is seen aslant, so low in the picture that they could hide between two rows of the grid. Those on
//! the largest flat object have [outlines](super::super::outline); those of less than four lines are [thin](super::thin). Of 24 frames
//! around four balls on a floor, seen from 4°, 7° and 12° above it, the worst have 41, 35 and 37 dB instead of 31, 30 and 31, for one to
//! two fifths more traced pixels.
//!
//! *Tips* of triangles, polygons and cones end between the points of the grid, where they are [narrower than a cell](super::taper), and so
//! do their shadows. To trace what is narrower in full loses less than a pixel of each, but takes more: `shape-polygon` of the gallery takes
//! 1.64 times the rays of none so, for its tips alone, and 1.24 times with every second pixel, for their shadows as well.
//!
//! Rejected: to ask at each point of the grid how wide its cone is on the floor, next to the balls that could shade it. That finds
//! mirrored shadows too, but `classic` has none that are low and would take 10 % more instructions at 320×240, 19 % at 160×120. With
//! outlines of less than 12 lines the worst frames have 43 dB, but `classic` at 160×120 takes 11 % more rays.

use super::super::Renderer;
use super::super::line_candidates::Span;
use super::super::outline::pixel;
use super::Grid;
use super::cell::{LARGEST_SIDE, SQUARE};
use super::places::Places;
use super::taper::{Shade, Taper};
use crate::math::Real;
use crate::prepared::ObjectSet;
use crate::shape::{Geometry, Tip};

/// The points of the grid that are near something small, in the two rows that a band of lines lies between.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosePlaces {
    upper: Places,
    lower: Places,
    side: usize,
    is_empty: bool,
}

/// The objects of which a tip is sharp where it is seen, or its shadow. Among more objects than a set holds there would be too many.
pub(super) fn tapering_objects<R: Real, S: Geometry>(
    renderer: &Renderer<'_, '_, R, S>,
    grid: Grid,
) -> ObjectSet {
    // Which rows they are near does not matter here.
    let is_sharp =
        |object: usize| ClosePlaces::none(renderer.width, grid).add_tips(renderer, grid, (0, 0), object);
    renderer.scene.objects_where(is_sharp).unwrap_or(ObjectSet::NONE)
}

impl ClosePlaces {
    fn none(width: u16, grid: Grid) -> Self {
        let side = grid.pixels();
        let none = Places::none(width, side.min(SQUARE).trailing_zeros());
        Self { upper: none, lower: none, side, is_empty: true }
    }

    /// Those of the rows `top` and `bottom`, if there are some: near low shadows, and near the tips of these objects. What is said of a
    /// row depends on nothing else.
    #[inline(never)]
    pub(super) fn new<R: Real, S: Geometry>(
        renderer: &Renderer<'_, '_, R, S>,
        grid: Grid,
        rows: (u16, u16),
        tapering: ObjectSet,
    ) -> Option<Self> {
        let mut close = Self::none(renderer.width, grid);
        let half = close.half();
        for outline in renderer.outlines.low_shadows(LARGEST_SIDE as u32) {
            close.add(rows, |row| outline.lines(row.saturating_sub(half), row.saturating_add(half)));
        }
        for object in tapering {
            close.add_tips(renderer, grid, rows, object);
        }
        (!close.is_empty).then_some(close)
    }

    /// Adds the sharp tips of an object, and their shadows on the largest flat object. Tells whether it has any.
    #[inline(never)]
    fn add_tips<R: Real, S: Geometry>(
        &mut self,
        renderer: &Renderer<'_, '_, R, S>,
        grid: Grid,
        rows: (u16, u16),
        object: usize,
    ) -> bool {
        let Renderer { scene, viewport, outlines, .. } = renderer;
        let plane = scene.plane_of(outlines.receiver());
        let half = R::Setup::from_u16(self.half());
        let mut any = false;
        for tip in scene.tips(object).filter(Tip::is_sharp) {
            // First the tip, then its shadows.
            let shades =
                scene.lights.iter().filter_map(|light| Some(Some(Shade::new(&light.source, plane?)?)));
            for shade in core::iter::once(None).chain(shades) {
                let Some(taper) = Taper::new(viewport, &tip, shade.as_ref(), grid) else { continue };
                any = true;
                self.add(rows, |row| {
                    let middle = R::Setup::from_u16(row) + R::Setup::from_f32(0.5);
                    let extent = taper.extent(middle - half, middle + half);
                    extent.map_or(Span::NOWHERE, |(left, right)| Span {
                        start: pixel(left, 0),
                        end: pixel(right, 1),
                    })
                });
            }
        }
        any
    }

    /// Adds the points that are near some pixels, which `near` tells for the lines around a row.
    fn add(&mut self, (top, bottom): (u16, u16), near: impl Fn(u16) -> Span) {
        let half = self.half();
        for (row, places) in [(top, &mut self.upper), (bottom, &mut self.lower)] {
            let Span { start, end } = near(row);
            if start < end {
                places.add(Span { start: start.saturating_sub(half), end: end.saturating_add(half) });
                self.is_empty = false;
            }
        }
    }

    /// Half the distance between points.
    fn half(&self) -> u16 {
        (self.side / 2) as u16
    }

    /// Whether something is near a pixel in this column and so many lines below the upper row, if that stands for others.
    #[inline(never)]
    pub(super) fn are_near(&self, x: u32, below: usize) -> bool {
        // Sides are powers of two.
        let stands_for_others = (x as usize | below) & (self.side.min(SQUARE) - 1) == 0;
        let is_upper = below & (self.side - 1) != 0 || below == 0;
        let is_lower = below != 0;
        stands_for_others && (is_upper && self.upper.hold(x) || is_lower && self.lower.hold(x))
    }
}
