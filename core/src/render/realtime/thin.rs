//! Where something is seen that is so thin that it could hide between the points of the grid.

use super::super::Renderer;
use super::super::line_candidates::Span;
use super::super::outline::pixel;
use super::Grid;
use super::cell::SQUARE;
use super::places::Places;
use super::stadium::Stadium;
use crate::hierarchy::Wedge;
use crate::math::Real;
use crate::prepared::ObjectSet;
use crate::shape::{Geometry, Hull};

/// The objects of which a hull is thin where it is seen; `None` where a scene has more than a set holds.
pub(super) fn thin_objects<R: Real, S: Geometry>(
    renderer: &Renderer<'_, '_, R, S>,
    grid: Grid,
) -> Option<ObjectSet> {
    let is_thin =
        |hull: Hull<R>| Stadium::new(&renderer.viewport, &hull).is_some_and(|stadium| stadium.is_thin(grid));
    renderer.scene.objects_where(|object| renderer.scene.hulls(object).any(is_thin))
}

/// The places of a strip of lines at which something thin can be seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct ThinPlaces {
    /// A bit for a column of cells.
    places: Places,
    grid: Grid,
    /// The objects of which something may be thin. Where there is no set, all may be, and what is not narrow does not count: there would
    /// be too much of it.
    objects: Option<ObjectSet>,
}

impl ThinPlaces {
    /// None yet, in a picture of this width.
    pub(super) fn none(width: u16, grid: Grid, objects: Option<ObjectSet>) -> Self {
        Self { places: Places::none(width, grid.pixels().trailing_zeros()), grid, objects }
    }

    /// Adds what is thin on the lines from `top` to `bottom`, both included.
    #[inline(never)]
    pub(super) fn add_all<R: Real, S: Geometry>(
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

    /// Adds what is thin between two heights of an object that is seen within a span of columns, if at all; tells where it is seen there,
    /// more closely.
    #[inline(never)]
    pub(super) fn add_object<R: Real, S: Geometry>(
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
                let place = known.common(Span { start: pixel(left, -1), end: pixel(right, 2) });
                all = all.hull(place);
                let is_thin = match self.objects {
                    Some(_) => stadium.is_thin(self.grid),
                    None => stadium.is_narrow(self.grid),
                };
                if is_thin {
                    self.add(place);
                }
            }
        }
        known.common(all)
    }

    /// Adds the shadows on the lines from `top` to `bottom`, both included, that are so low that every second line may miss them.
    pub(super) fn add_shadows<R: Real, S: Geometry>(
        &mut self,
        renderer: &Renderer<'_, '_, R, S>,
        (top, bottom): (u16, u16),
    ) {
        for outline in renderer.outlines.low_shadows(SQUARE as u32) {
            self.add(outline.lines(top, bottom));
        }
    }

    /// Adds all cells that have one of these pixels, or end at it.
    fn add(&mut self, span: Span) {
        if span.start < span.end {
            self.places.add(Span { start: span.start.saturating_sub(1), ..span });
        }
    }

    /// Whether something of an object may be thin.
    pub(super) fn may_have(&self, object: usize) -> bool {
        self.objects.is_none_or(|objects| objects.contains(object))
    }

    /// Whether the cell that begins in this column can show something thin.
    pub(super) fn holds(&self, left: u32) -> bool {
        self.places.hold(left)
    }
}

/// The heights of some lines, both included, with a pixel of room for rounding.
pub(super) fn heights<R: Real>((top, bottom): (u16, u16)) -> (R::Setup, R::Setup) {
    let half = R::Setup::from_f32(0.5);
    (R::Setup::from_u16(top) - half, R::Setup::from_u16(bottom) + half + R::Setup::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first columns of the cells that hold something.
    fn held(width: u16, grid: Grid, spans: &[(u16, u16)]) -> Vec<u32> {
        let mut places = ThinPlaces::none(width, grid, None);
        spans.iter().for_each(|&(start, end)| places.add(Span { start, end }));
        (0..u32::from(width)).step_by(grid.pixels()).filter(|left| places.holds(*left)).collect()
    }

    #[test]
    fn cells_hold_what_is_in_them_or_where_they_end() {
        assert_eq!(held(64, Grid::Eight, &[(16, 17)]), [8, 16]);
        assert_eq!(held(64, Grid::Eight, &[(17, 25), (4, 4), (63, 900)]), [16, 24, 56]);
        assert_eq!(held(64, Grid::Four, &[(0, 5)]), [0, 4]);
        assert_eq!(held(2048, Grid::Eight, &[(2043, 2045)]), [2040]);
    }

    #[test]
    fn wide_pictures_have_fewer_places() {
        let all: Vec<_> = (0..65_535).step_by(2).collect();
        assert_eq!(held(65_535, Grid::Two, &[(0, u16::MAX)]), all);
        let few = held(65_535, Grid::Two, &[(1000, 1001)]);
        assert!(few.contains(&998) && few.contains(&1000) && few.len() <= 256);
    }
}
