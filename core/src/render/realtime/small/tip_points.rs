//! The points of the grid near a sharp tip, the shadow of one, or a low shadow.
//!
//! These points are marked as if they were near a small highlight: every second pixel between them is traced.
//!
//! *Tips* of triangles, polygons and cones end between the points of the grid, where their picture is a
//! narrow [`taper`](super::taper), and so do their shadows on the largest flat object.
//!
//! *Low shadows* lie on a floor that is seen at a grazing angle, and are so low in the picture that they
//! could lie between two rows of the grid. The [outlines](crate::render::outline) of shadows on the largest
//! flat object are known. Shadows of less than four lines are traced in full by
//! [`thin_cells`](super::thin_cells).

use super::super::grid::{Grid, LARGEST_SIZE, SQUARE};
use super::super::sample::Sample;
use super::column_set::ColumnSet;
use super::shadow_projection::ShadowProjection;
use super::taper::Taper;
use crate::math::Real;
use crate::prepared::ObjectSet;
use crate::render::Renderer;
use crate::render::span::{Span, pixel};
use crate::shape::{Geometry, Tip};

/// The points near tips and low shadows, in the two rows of the grid that a band lies between.
#[derive(Clone, Copy, Debug)]
pub(in crate::render::realtime) struct TipPoints {
    upper: ColumnSet,
    lower: ColumnSet,
    /// The size of a cell: the distance of the grid's points.
    size: usize,
    is_empty: bool,
}

/// The objects with a tip that is sharp in the picture, or with a tip whose shadow is sharp there. Empty in a
/// scene of more objects than a set holds, which would have too many tips.
pub(super) fn tapering_objects<R: Real, S: Geometry>(
    renderer: &Renderer<'_, '_, R, S>,
    grid: Grid,
) -> ObjectSet {
    // Any rows will do: only the returned value is used.
    let is_sharp =
        |object: usize| TipPoints::none(renderer.width, grid).add_tips(renderer, grid, (0, 0), object);
    renderer.scene.objects_where(is_sharp).unwrap_or(ObjectSet::NONE)
}

impl TipPoints {
    fn none(width: u16, grid: Grid) -> Self {
        let size = grid.pixels();
        let none = ColumnSet::none(width, size.min(SQUARE).trailing_zeros());
        Self { upper: none, lower: none, size, is_empty: true }
    }

    /// The points of the rows `top` and `bottom` near low shadows and near the tips of these objects, if
    /// there are any. The points of a row depend on nothing but the row.
    pub(super) fn new<R: Real, S: Geometry>(
        renderer: &Renderer<'_, '_, R, S>,
        grid: Grid,
        rows: (u16, u16),
        tapering: ObjectSet,
    ) -> Option<Self> {
        let mut points = Self::none(renderer.width, grid);
        let half = points.half();
        for outline in renderer.outlines.low_shadows(LARGEST_SIZE as u32) {
            points.add(rows, |row| outline.lines(row.saturating_sub(half), row.saturating_add(half)));
        }
        for object in tapering {
            points.add_tips(renderer, grid, rows, object);
        }
        (!points.is_empty).then_some(points)
    }

    /// Adds the points near the sharp tips of an object, and near their shadows on the largest flat object.
    /// Returns whether a tip or a shadow is sharp as it is seen.
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
            let projections = scene
                .lights
                .iter()
                .filter_map(|light| Some(Some(ShadowProjection::new(&light.source, plane?)?)));
            // The tip itself, without a shadow, and then each shadow of it.
            for projection in core::iter::once(None).chain(projections) {
                let Some(taper) = Taper::new(viewport, &tip, projection.as_ref(), grid) else { continue };
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

    /// Adds the points near some pixels: `pixels` returns those on the lines around a row.
    fn add(&mut self, (top, bottom): (u16, u16), pixels: impl Fn(u16) -> Span) {
        let half = self.half();
        for (row, columns) in [(top, &mut self.upper), (bottom, &mut self.lower)] {
            let Span { start, end } = pixels(row);
            if start < end {
                columns.add(Span { start: start.saturating_sub(half), end: end.saturating_add(half) });
                self.is_empty = false;
            }
        }
    }

    /// Half the distance of the grid's points.
    fn half(&self) -> u16 {
        (self.size / 2) as u16
    }

    /// Marks the sample of the pixel in column `x`, `below` lines under the upper row, if something is near.
    pub(in crate::render::realtime) fn mark(&self, sample: Sample, x: u32, below: usize) -> Sample {
        if self.are_near(x, below) { sample.marked_near_glint() } else { sample }
    }

    /// Whether something is near the pixel in column `x`, `below` lines under the upper row. Only pixels of
    /// the grid, and of a grid half as wide in cells of eight pixels, are ever near something.
    fn are_near(&self, x: u32, below: usize) -> bool {
        // Sides are powers of two.
        let is_point = (x as usize | below) & (self.size.min(SQUARE) - 1) == 0;
        let is_upper = below & (self.size - 1) != 0 || below == 0;
        let is_lower = below != 0;
        is_point && (is_upper && self.upper.hold(x) || is_lower && self.lower.hold(x))
    }
}
