//! How a cell is drawn, once its corners are known.

use super::cell::{Cell, Corners};
use super::pixel_source::PixelSource;
use super::sample::Sample;
use super::side::Side;

/// The upper row of a cell, from its left corner on, if the band above has drawn it.
pub(super) type Above<'c> = Option<&'c [Sample]>;

/// Small things that a cell can show, as far as they are known before the first ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct SmallInCell {
    /// Something thin can be seen: every pixel is traced.
    pub(super) is_thin: bool,
    /// Something thin can be seen in the next cell too.
    pub(super) is_next_thin: bool,
    /// The rim of a mesh can be seen: the cell is verified once it is drawn.
    pub(super) has_rim: bool,
}

/// How a cell is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    /// The size of the cell in pixels.
    size: usize,
    small: SmallInCell,
    /// Whether the ends of the top side differ.
    top_differs: bool,
    /// Whether the left side is already refined.
    is_left_refined: bool,
    /// Whether the right side is refined, not interpolated.
    refines_right: bool,
    /// Whether the ends of a side differ, so that something may lie between them.
    any_differs: bool,
}

impl Plan {
    /// Compares the corners. The left side was compared when it was drawn: only if its ends differ, it is
    /// refined.
    pub(super) fn new(
        corners: &Corners,
        is_left_refined: bool,
        small: SmallInCell,
        size: usize,
        pixels: &impl PixelSource,
    ) -> Self {
        let Corners { top_left, top_right, bottom_left, bottom_right } = *corners;
        let top = pixels.differ(top_left, top_right, size);
        let right = pixels.differ(top_right, bottom_right, size);
        let bottom = pixels.differ(bottom_left, bottom_right, size);
        Self {
            size,
            small,
            top_differs: top,
            is_left_refined,
            // Two neighbors that are both traced in full need no refined side between them.
            refines_right: right && !(small.is_thin && small.is_next_thin),
            any_differs: top || right || bottom || is_left_refined,
        }
    }

    /// Whether all points between the corners are interpolated, on the sides and inside, unless the cell is
    /// verified.
    pub(super) fn is_smooth(&self) -> bool {
        !(self.any_differs || self.small.is_thin)
    }

    /// Whether the corners are all that is drawn of the cell.
    pub(super) fn needs_corners_alone(&self) -> bool {
        self.is_smooth() && !self.small.has_rim
    }

    /// Whether every pixel is traced.
    pub(super) fn traces_all(&self) -> bool {
        self.small.is_thin
    }

    /// Whether the right side is refined, not interpolated.
    pub(super) fn refines_right(&self) -> bool {
        self.refines_right
    }

    /// Draws the points of a cell that are not corners. The cell holds its left corners.
    pub(super) fn draw(
        &self,
        cell: &mut Cell,
        corners: &Corners,
        above: Above<'_>,
        pixels: &mut impl PixelSource,
    ) {
        if self.needs_corners_alone() {
            return;
        }
        if self.is_smooth() {
            cell.fill_smooth(corners, self.size);
            cell.verify(self.size, pixels);
            return;
        }
        cell.set(self.size, 0, corners.top_right);
        cell.set(self.size, self.size, corners.bottom_right);
        if self.traces_all() {
            self.trace_in_full(cell, above, pixels);
            return;
        }
        self.refine(cell, above, pixels);
        if self.small.has_rim {
            cell.verify(self.size, pixels);
        }
    }

    /// Traces every pixel. The sides are only drawn for the cells beside this one.
    fn trace_in_full(&self, cell: &mut Cell, above: Above<'_>, pixels: &mut impl PixelSource) {
        let size = self.size;
        match self.known_top(above) {
            Some(known) => cell.take_top(known, size, pixels),
            None => cell.interpolate_side(Side::right((0, 0), size)),
        }
        if self.refines_right {
            cell.refine_side(Side::down((size, 0), size), pixels);
        } else {
            cell.interpolate_side(Side::down((size, 0), size));
        }
        if !self.is_left_refined {
            cell.interpolate_side(Side::down((0, 0), size));
        }
        cell.trace_all((0, 0), size, pixels);
        if pixels.are_corners() {
            cell.interpolate_side(Side::right((0, size), size));
            cell.trace_far_sides(size, pixels);
        }
    }

    /// Draws the sides, and then what is inside.
    fn refine(&self, cell: &mut Cell, above: Above<'_>, pixels: &mut impl PixelSource) {
        let size = self.size;
        match self.known_top(above) {
            Some(known) => cell.take_top(known, size, pixels),
            None => cell.refine_side(Side::right((0, 0), size), pixels),
        }
        cell.refine_side(Side::right((0, size), size), pixels);
        cell.refine_side(Side::down((size, 0), size), pixels);
        if !self.is_left_refined {
            cell.refine_side(Side::down((0, 0), size), pixels);
        }
        cell.refine(size, pixels);
    }

    /// The points of the top side after the left corner, if its ends differ and the band above has drawn
    /// them.
    fn known_top<'c>(&self, above: Above<'c>) -> Option<&'c [Sample]> {
        let (_, top) = above.filter(|_| self.top_differs)?.split_first()?;
        top.first().is_some_and(|sample| sample.is_known()).then_some(top)
    }
}
