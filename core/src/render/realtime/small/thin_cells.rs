//! The cells that can show something so thin that it may lie unseen between the points of the grid. They are
//! traced in full.

use super::super::grid::{Grid, SQUARE};
use super::column_set::ColumnSet;
use super::stadium::Stadium;
use crate::hierarchy::Wedge;
use crate::math::Real;
use crate::prepared::candidates::ObjectSet;
use crate::render::Renderer;
use crate::render::span::{Span, pixel};
use crate::shape::{Geometry, Hull};

/// The objects with a hull that is thin as it is seen; `None` if a scene has more objects than a set holds.
pub(super) fn thin_objects<R: Real, S: Geometry>(
    renderer: &Renderer<'_, '_, R, S>,
    grid: Grid,
) -> Option<ObjectSet> {
    let is_thin =
        |hull: Hull<R>| Stadium::new(&renderer.viewport, &hull).is_some_and(|stadium| stadium.is_thin(grid));
    renderer.scene.objects_where(|object| renderer.scene.hulls(object).any(is_thin))
}

/// The cells of a band that can show something thin.
#[derive(Clone, Copy, Debug)]
pub(in crate::render::realtime) struct ThinCells {
    /// A bit stands for one column of cells, or for several.
    columns: ColumnSet,
    grid: Grid,
    /// The objects that may have a thin hull. `None`: any object may, and only hulls narrower than a cell
    /// count, as scenes of many objects have too many of the others.
    objects: Option<ObjectSet>,
}

impl ThinCells {
    /// No cells, in a picture of this width.
    pub(super) fn none(width: u16, grid: Grid, objects: Option<ObjectSet>) -> Self {
        Self { columns: ColumnSet::none(width, grid.pixels().trailing_zeros()), grid, objects }
    }

    /// Adds the cells with something thin on the lines from `top` to `bottom`, both included.
    pub(in crate::render::realtime) fn add_all<R: Real, S: Geometry>(
        &mut self,
        renderer: &Renderer<'_, '_, R, S>,
        lines: (u16, u16),
    ) {
        let heights @ (upper, lower) = heights::<R>(lines);
        let wedge = Wedge { edge: renderer.viewport.eye(), normals: renderer.viewport.between(upper, lower) };
        renderer.scene.any_between(&wedge, self.objects, |object| {
            self.add_object(renderer, object, heights, Span::EVERYWHERE);
            false
        });
    }

    /// Adds the cells that show something thin of an object between two heights. It is known that the object
    /// is seen within the span `known` at most. Returns a span that is the same or shorter.
    pub(in crate::render::realtime) fn add_object<R: Real, S: Geometry>(
        &mut self,
        renderer: &Renderer<'_, '_, R, S>,
        object: usize,
        (upper, lower): (R::Setup, R::Setup),
        known: Span,
    ) -> Span {
        let mut all = Span::NOWHERE;
        for hull in renderer.scene.hulls(object) {
            let Some(stadium) = Stadium::new(&renderer.viewport, &hull) else {
                all = Span::EVERYWHERE;
                continue;
            };
            if let Some((left, right)) = stadium.extent(upper, lower) {
                let span = known.common(Span { start: pixel(left, -1), end: pixel(right, 2) });
                all = all.hull(span);
                let is_thin = match self.objects {
                    Some(_) => stadium.is_thin(self.grid),
                    None => stadium.is_narrow(self.grid),
                };
                if is_thin {
                    self.add(span);
                }
            }
        }
        known.common(all)
    }

    /// Adds the cells with shadows less than four lines high on the lines from `top` to `bottom`, both
    /// included: every second line may miss such a shadow.
    pub(in crate::render::realtime) fn add_shadows<R: Real, S: Geometry>(
        &mut self,
        renderer: &Renderer<'_, '_, R, S>,
        (top, bottom): (u16, u16),
    ) {
        for outline in renderer.outlines.low_shadows(SQUARE as u32) {
            self.add(outline.lines(top, bottom));
        }
    }

    /// Adds all cells that have one of these pixels, or whose right side is one of them.
    fn add(&mut self, span: Span) {
        if span.start < span.end {
            self.columns.add(Span { start: span.start.saturating_sub(1), ..span });
        }
    }

    /// Whether an object may have a thin hull.
    pub(in crate::render::realtime) fn may_have(&self, object: usize) -> bool {
        self.objects.is_none_or(|objects| objects.contains(object))
    }

    /// Whether the cell that begins in this column can show something thin.
    pub(in crate::render::realtime) fn holds(&self, left: u32) -> bool {
        self.columns.hold(left)
    }
}

/// The heights between which the lines from `top` to `bottom` lie, both included, with a pixel of room for
/// rounding.
pub(in crate::render::realtime) fn heights<R: Real>((top, bottom): (u16, u16)) -> (R::Setup, R::Setup) {
    let half = R::Setup::from_f32(0.5);
    (R::Setup::from_u16(top) - half, R::Setup::from_u16(bottom) + half + R::Setup::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first columns of the cells that are held, after some spans are added.
    fn held(width: u16, grid: Grid, spans: &[(u16, u16)]) -> Vec<u32> {
        let mut cells = ThinCells::none(width, grid, None);
        spans.iter().for_each(|&(start, end)| cells.add(Span { start, end }));
        (0..u32::from(width)).step_by(grid.pixels()).filter(|left| cells.holds(*left)).collect()
    }

    #[test]
    fn cells_are_held_that_have_a_pixel_or_end_at_one() {
        assert_eq!(held(64, Grid::Eight, &[(16, 17)]), [8, 16]);
        assert_eq!(held(64, Grid::Eight, &[(17, 25), (4, 4), (63, 900)]), [16, 24, 56]);
        assert_eq!(held(64, Grid::Four, &[(0, 5)]), [0, 4]);
        assert_eq!(held(2048, Grid::Eight, &[(2043, 2045)]), [2040]);
    }

    #[test]
    fn in_wide_pictures_several_columns_share_a_bit() {
        let all: Vec<_> = (0..65_535).step_by(2).collect();
        assert_eq!(held(65_535, Grid::Two, &[(0, u16::MAX)]), all);
        let few = held(65_535, Grid::Two, &[(1000, 1001)]);
        assert!(few.contains(&998) && few.contains(&1000) && few.len() <= 256);
    }
}
