//! Drawing the cells of a band, the lines between two rows of the grid.

use core::marker::PhantomData;
use core::ops::Range;

use super::budget::{Budget, Detail, Spent};
use super::cell::{Cell, Corners, Look, Way};
use super::marks::FAINT;
use super::paint::Paint;
use super::small::{RimCells, ThinCells, Tiny, TipPoints, Watch, tapering_objects, thin_objects};
use super::strip::Strip;
use super::tolerance::Tolerance;
use super::tracer::Tracer;
use super::{Realtime, RealtimeBuffer, Sample};
use crate::integrator::Bounds;
use crate::math::Real;
use crate::prepared::PreparedScene;
use crate::prepared::candidates::ObjectSet;
use crate::probe::Probe;
use crate::render::{DisplayColor, Renderer};
use crate::shape::{Geometry, Intersect};

/// Rays that would bring a smaller share than this are left out.
const CUTOFF: f32 = 1.0 / 64.0;

/// The lines between two rows of the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Band {
    pub(super) top: u32,
    /// Left column of the next cell.
    pub(super) left: u32,
    /// Whether the lent row of samples holds the upper row of the grid from there on.
    has_top: bool,
    /// Whether the left side of the next cell was looked at closely.
    rough_left: bool,
    strip: Option<Strip>,
    thin: ThinCells,
    close: Option<TipPoints>,
}

/// Draws one band after the other: what is known of the whole picture, and what one cell and one band hand to the next.
#[derive(Debug)]
pub(super) struct BandPainter<'p, 'm, R: Real, S: Geometry + 'm> {
    renderer: &'p Renderer<'p, 'm, R, S>,
    /// When rays are no longer followed.
    bounds: Bounds<R>,
    /// The scene without its lights, and when rays are no longer followed there: those that leave no mark are not. Worked out for each look, that takes
    /// `classic` up to 0.6 % longer on an M4F.
    unlit: PreparedScene<'m, R, S>,
    unlit_bounds: Bounds<R>,
    quality: Realtime,
    /// Objects that could hide between the points of the grid; `None`: any could.
    thin: Option<ObjectSet>,
    /// Objects that taper off.
    tapering: ObjectSet,
    /// Where something may be thin in parts.
    rims: Option<RimCells>,
    /// The line of the picture that the lent row of samples holds.
    row: Option<u32>,
    /// A pixel that sees nothing, where all such pixels look alike.
    nothing: Option<Sample>,
    /// Watches for what could hide where that is not known.
    watch: Option<Watch<R>>,
    cell: Cell,
    budget: Budget,
}

impl<'p, 'm, R: Real, S: Geometry + 'm> BandPainter<'p, 'm, R, S> {
    /// For a picture of which so many `lines` are to be drawn, in colors of type `C`.
    pub(super) fn new<C: DisplayColor>(
        renderer: &'p Renderer<'p, 'm, R, S>,
        quality: Realtime,
        lines: u32,
    ) -> Self {
        let cutoff = renderer.bounds.cutoff.larger(R::from_f32(CUTOFF));
        let mut unlit = *renderer.scene;
        unlit.lights = &[];
        Self {
            quality,
            thin: thin_objects(renderer, quality.grid),
            tapering: tapering_objects(renderer, quality.grid),
            rims: RimCells::new(renderer, quality.grid),
            row: None,
            nothing: Tracer::<R, S, C, ()>::nothing(renderer),
            bounds: Bounds { cutoff, ..renderer.bounds },
            unlit,
            unlit_bounds: Bounds { cutoff: cutoff.larger(R::from_f32(FAINT)), ..renderer.bounds },
            renderer,
            watch: Tiny::new(renderer, quality.grid).map(Watch::new),
            cell: Cell::BLANK,
            budget: Budget::new(quality.budget_rays, lines),
        }
    }

    /// Goes on with other `lines` of the picture, with a new budget. If a band is left half drawn, the row of samples is half that of one line and half that of
    /// another: it is not used.
    pub(super) fn restart(&mut self, lines: u32, is_within_band: bool) {
        self.budget = Budget::new(self.quality.budget_rays, lines);
        if is_within_band {
            self.row = None;
        }
    }

    /// The band that holds the first of these lines, which are those that are still to be drawn.
    pub(super) fn begin(&mut self, lines: &Range<u32>) -> Band {
        let side = self.quality.grid.pixels();
        let top = lines.start & !(side as u32 - 1);
        let bottom = (top + side as u32).min(u32::from(u16::MAX));
        self.budget.share(side as u32, lines.end.saturating_sub(lines.start));
        let rows = (top as u16, bottom as u16);
        let mut thin = ThinCells::none(self.renderer.width, self.quality.grid, self.thin);
        let strip = Strip::new(self.renderer, rows, &mut thin);
        if strip.is_none() {
            thin.add_all(self.renderer, rows);
        }
        thin.add_shadows(self.renderer, rows);
        let close = TipPoints::new(self.renderer, self.quality.grid, rows, self.tapering);
        Band { top, left: 0, has_top: self.row == Some(top), rough_left: false, strip, thin, close }
    }

    /// Draws the next cell of a band into the buffer; returns how many rays that took.
    #[inline]
    pub(super) fn draw_cell<C: DisplayColor>(
        &mut self,
        band: &mut Band,
        buffer: &mut RealtimeBuffer<'_, C>,
        probe: &mut impl Probe<R>,
    ) -> u32 {
        let spent = self.draw_next(band, buffer, probe);
        self.budget.spend(spent);
        spent.all
    }

    /// Draws the next cell of a band into the buffer; returns the rays that it took.
    fn draw_next<C: DisplayColor>(
        &mut self,
        band: &mut Band,
        buffer: &mut RealtimeBuffer<'_, C>,
        probe: &mut impl Probe<R>,
    ) -> Spent {
        let side = self.quality.grid.pixels();
        let left = band.left as usize;
        let (first, last) = (band.left as u16, (left + side) as u16);
        let shown = band.strip.as_ref().map(|strip| strip.between(first, last));
        // Candidates are not known beyond the picture's right end.
        let is_inside = band.left + (side as u32) < self.renderer.width();
        let among = shown.filter(|_| is_inside).unwrap_or_else(|| self.renderer.scene.all());
        let detail = self.budget.detail();
        let mut tracer = Tracer {
            renderer: self.renderer,
            bounds: &self.bounds,
            unlit: &self.unlit,
            unlit_bounds: &self.unlit_bounds,
            among,
            left: band.left,
            top: band.top,
            limits: Tolerance::new(self.quality.threshold, detail, side),
            allowed: self.budget.left(),
            watch: self.watch.as_mut(),
            close: band.close.as_ref(),
            color: PhantomData::<C>,
            probe,
            rays: 0,
        };
        let paint = Paint {
            settings: &self.renderer.settings,
            width: usize::from(self.renderer.width),
            left,
            top: band.top,
            side,
        };
        if let Some(nothing) = self.nothing
            && among.is_empty()
        {
            paint.blank(buffer.colors, nothing);
            let corner = |x: usize, y: usize| tracer.marked(nothing, x, y);
            let corners = Corners {
                top_left: corner(0, 0),
                top_right: corner(side, 0),
                bottom_left: corner(0, side),
                bottom_right: corner(side, side),
            };
            self.finish_smooth(band, corners, side, buffer.samples);
            return Spent::default();
        }

        // The corners: those on the left and above may be known.
        let known = if band.has_top { buffer.samples.get(left..) } else { None };
        let at = |i: usize| known.and_then(|known| known.get(i)).copied();
        let traces_row = self.budget.traces_row();
        let cell = &mut self.cell;
        if left == 0 {
            let top_left = at(0).unwrap_or_else(|| tracer.trace(0, 0));
            cell.set(0, 0, top_left);
            cell.set(0, side, tracer.trace_or(top_left, traces_row, (0, side)));
        }
        let (top_left, bottom_left) = (cell.get(0, 0), cell.get(0, side));
        let top_right = at(side).unwrap_or_else(|| tracer.trace_or(top_left, true, (side, 0)));
        let above = tracer.rays;
        let bottom_right = tracer.trace_or(top_right, traces_row, (side, side));
        let corners = Corners { top_left, top_right, bottom_left, bottom_right };
        let (grid, row) = (tracer.rays, tracer.rays - above);
        tracer.allow(self.budget.refines());
        if left == 0 {
            band.rough_left = tracer.differ(top_left, bottom_left, side);
            if band.rough_left {
                cell.look_along((0, 0), Way::Down, side, &mut tracer);
            }
        }
        let top = tracer.differ(corners.top_left, corners.top_right, side);
        let right = tracer.differ(corners.top_right, corners.bottom_right, side);
        let bottom = tracer.differ(corners.bottom_left, corners.bottom_right, side);
        let thin = detail != Detail::Grid && band.thin.holds(band.left);
        // Said once more: the compiler does not see that there are none.
        let has_rim = S::Prepared::<'m, R>::HAS_RIMS
            && detail == Detail::Full
            && self.rims.as_ref().is_some_and(|rims| rims.hold(band.left, band.top));
        if !(top || right || bottom || band.rough_left || thin) {
            if has_rim {
                cell.smooth(&corners, side);
                cell.verify(side, &mut tracer);
                paint.refined(buffer.colors, cell);
            } else {
                paint.smooth(buffer.colors, &corners);
            }
            let all = tracer.rays;
            self.finish_smooth(band, corners, side, buffer.samples);
            return Spent { all, row, refined: all - grid };
        }

        // The sides, then what is inside.
        cell.set(side, 0, corners.top_right);
        cell.set(side, side, corners.bottom_right);
        // Where every pixel is traced, sides are for the cells beside it alone; those that are traced in full too need none.
        let looks_right = right && !(thin && band.thin.holds(band.left + side as u32));
        match known {
            Some([_, known @ ..]) if top && known.first().is_some_and(|sample| sample.is_known()) => {
                cell.know_top(known, side, &tracer);
            }
            _ if thin => cell.bridge((0, 0), Way::Right, side),
            _ => cell.look_along((0, 0), Way::Right, side, &mut tracer),
        }
        if !thin {
            cell.look_along((0, side), Way::Right, side, &mut tracer);
        }
        if !thin || looks_right {
            cell.look_along((side, 0), Way::Down, side, &mut tracer);
        } else {
            cell.bridge((side, 0), Way::Down, side);
        }
        if thin {
            if !band.rough_left {
                cell.bridge((0, 0), Way::Down, side);
            }
            cell.trace_all((0, 0), side, &mut tracer);
        } else {
            if !band.rough_left {
                cell.look_along((0, 0), Way::Down, side, &mut tracer);
            }
            cell.refine(side, &mut tracer);
            if has_rim {
                cell.verify(side, &mut tracer);
            }
        }
        paint.refined(buffer.colors, cell);
        band.rough_left = looks_right;
        if thin {
            hand_corners(buffer.samples, left, &corners, side);
        } else {
            let first = if left == 0 { 0 } else { 1 };
            for (x, sample) in (first..=side).zip(buffer.samples.iter_mut().skip(left + first)) {
                *sample = cell.get(x, side);
            }
        }
        let all = tracer.rays;
        self.cell.advance(side);
        self.finish(band, side);
        Spent { all, row, refined: all - grid }
    }

    /// Hands a cell's right side to the next one, and its bottom to the band below, if they are straight.
    fn finish_smooth(&mut self, band: &mut Band, corners: Corners, side: usize, samples: &mut [Sample]) {
        self.cell.set(0, 0, corners.top_right);
        self.cell.set(0, side, corners.bottom_right);
        band.rough_left = false;
        hand_corners(samples, band.left as usize, &corners, side);
        self.finish(band, side);
    }

    fn finish(&mut self, band: &mut Band, side: usize) {
        band.left += side as u32;
        if band.left >= self.renderer.width() {
            self.row = Some(band.top + side as u32);
        }
    }
}

/// Hands a cell's lower corners to the band below, and nothing of what is between them.
fn hand_corners(samples: &mut [Sample], left: usize, corners: &Corners, side: usize) {
    if let Some(row) = samples.get_mut(left..) {
        if let (0, Some(first)) = (left, row.first_mut()) {
            *first = corners.bottom_left;
        }
        if let Some(inside) = row.get_mut(1) {
            *inside = Sample::BLANK;
        }
        if let Some(last) = row.get_mut(side) {
            *last = corners.bottom_right;
        }
    }
}
