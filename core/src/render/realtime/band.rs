//! Draws bands, cell after cell. A band is the lines between two neighboring rows of the grid.

use core::array::from_fn;

use super::budget::{Budget, Detail, Spent};
use super::buffer::RealtimeBuffer;
use super::cell::{Cell, Corners};
#[cfg(feature = "looks")]
use super::grid::SQUARE;
use super::grid::beyond;
use super::marks::FAINT;
use super::paint::Paint;
use super::pixel_source::PixelSource;
use super::plan::{Above, Plan, SmallInCell};
use super::quality::Realtime;
use super::sample::Sample;
use super::side::{POINTS, Side};
use super::small::{SmallThings, ThinCells, TipPoints};
#[cfg(feature = "distributed")]
use super::smooth::OutlinesNear;
use super::strip::Strip;
use super::tolerance::Tolerance;
use super::tracer::{CellView, Tracer, UnlitScene, nothing_met};
use crate::camera::RayRow;
use crate::integrator::RayLimits;
use crate::math::Real;
use crate::prepared::ObjectSet;
use crate::probe::Probe;
#[cfg(feature = "looks")]
use crate::render::contours::InkWalk;
use crate::render::region::Region;
use crate::render::{DisplayColor, Renderer};
use crate::shape::{Geometry, Silhouette};

/// Rays that would bring a smaller share of their light than this to the pixel are left out.
const CUTOFF: f32 = 1.0 / 64.0;

/// The lines between two neighboring rows of the grid, drawn up to one of its cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Band<R> {
    /// The first line.
    pub(super) top: u32,
    /// The left column of the next cell.
    pub(super) left: u32,
    /// The left column of the first cell.
    pub(super) first: u32,
    /// The column after the band.
    end: u32,
    /// The camera rays of each line, and of the first line below.
    rows: [RayRow<R>; POINTS],
    /// Whether the lent row of samples holds the upper row of the grid, from `left` on.
    has_top: bool,
    /// Whether the left side of the next cell is refined, and not interpolated.
    is_left_refined: bool,
    /// The objects that each cell can show, if that is known.
    strip: Option<Strip>,
    /// The cells that can show something thin.
    thin: ThinCells,
    /// The points of the grid near tips and low shadows, if there are any.
    tips: Option<TipPoints>,
}

impl<R> Band<R> {
    /// Pixels of a line.
    pub(super) fn width(&self) -> usize {
        self.end.saturating_sub(self.first) as usize
    }

    /// Pixels of a line to the left of the next cell.
    fn drawn(&self) -> usize {
        self.left.saturating_sub(self.first) as usize
    }

    /// Whether all cells are drawn.
    pub(super) fn is_complete(&self) -> bool {
        self.left >= self.end
    }

    /// The corners of the next cell, in which no ray meets an object.
    fn empty_corners(&self, nothing: Sample, size: usize) -> Corners {
        let corner = |x: usize, y: usize| match &self.tips {
            Some(tips) => tips.mark(nothing, self.left + x as u32, y),
            None => nothing,
        };
        Corners {
            top_left: corner(0, 0),
            top_right: corner(size, 0),
            bottom_left: corner(0, size),
            bottom_right: corner(size, size),
        }
    }
}

/// A row of the grid, from column `first` up to column `end`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct GridRow {
    line: u32,
    first: u32,
    end: u32,
}

/// Draws bands. Holds the data of the whole picture, and the data that one cell or band passes to the next.
#[derive(Debug)]
pub(super) struct BandPainter<'m, R: Real, S: Geometry + 'm> {
    /// When rays end.
    limits: RayLimits<R>,
    /// The scene without its lights. Its rays end earlier: a ray that does not count in the digests is not
    /// traced.
    unlit: UnlitScene<'m, R, S>,
    quality: Realtime,
    small: SmallThings<R>,
    /// The row of the grid that the lent samples hold.
    row: Option<GridRow>,
    /// The sample of a pixel whose ray meets no object, if all such pixels look alike.
    nothing: Option<Sample>,
    /// The current cell. Its left side is known from the cell before.
    cell: Cell,
    budget: Budget,
}

impl<'m, R: Real, S: Geometry + 'm> BandPainter<'m, R, S> {
    /// For a picture in colors of type `C`, of which no lines are to be drawn yet.
    #[inline]
    pub(super) fn new<C: DisplayColor>(renderer: &Renderer<'_, 'm, R, S>, quality: Realtime) -> Self {
        let cutoff = renderer.limits.cutoff.larger(R::from_f32(CUTOFF));
        let unlit = renderer.scene.without_lights();
        let unlit_limits = RayLimits { cutoff: cutoff.larger(R::from_f32(FAINT)), ..renderer.limits };
        Self {
            limits: RayLimits { cutoff, ..renderer.limits },
            unlit: UnlitScene { scene: unlit, limits: unlit_limits },
            quality,
            small: SmallThings::new(renderer, quality.grid),
            row: None,
            nothing: nothing_met(renderer, C::TONES),
            cell: Cell::BLANK,
            budget: Budget::new(quality.budget_rays, 0),
        }
    }

    /// Goes on with other lines of the picture, of which there are `lines`, and a new budget. The row of
    /// samples is not used again if a band `is_unfinished`: one half of it belongs to one line, the other to
    /// another.
    pub(super) fn restart(&mut self, lines: u32, is_unfinished: bool) {
        self.budget = Budget::new(self.quality.budget_rays, lines);
        if is_unfinished {
            self.row = None;
        }
    }

    /// Begins the band that holds the first line of the `region` that is still to be drawn.
    // Kept out of line: else its stack stays in use while cells are traced (400 bytes on an M4F, 2,200 on an
    // M0).
    #[inline(never)]
    pub(super) fn begin(&mut self, renderer: &Renderer<'_, 'm, R, S>, region: &Region) -> Band<R> {
        let size = self.quality.grid.pixels();
        let first_of = |place: u32| place & !(size as u32 - 1);
        let (top, first, end) = (first_of(region.top), first_of(region.left), region.right);
        let bottom = (top + size as u32).min(u32::from(u16::MAX));
        self.budget.share(size as u32, region.height());
        let rows = (top as u16, bottom as u16);
        let mut thin = self.small.thin_cells(renderer.width, self.quality.grid);
        let strip = Strip::new(renderer, rows, self.quality.aim(), &mut thin);
        if strip.is_none() {
            thin.add_all(renderer, rows);
        }
        thin.add_shadows(renderer, rows);
        let tips = self.small.tip_points(renderer, self.quality.grid, rows);
        Band {
            top,
            left: first,
            first,
            end,
            rows: from_fn(|y| renderer.row(beyond(top, y), self.quality.aim())),
            has_top: self.row == Some(GridRow { line: top, first, end }),
            is_left_refined: false,
            strip,
            thin,
            tips,
        }
    }

    /// Draws the next cell of a band into the buffer; returns the number of rays that it took.
    #[inline]
    pub(super) fn draw_cell<C: DisplayColor>(
        &mut self,
        renderer: &Renderer<'_, 'm, R, S>,
        band: &mut Band<R>,
        buffer: &mut RealtimeBuffer<'_, C>,
        probe: &mut impl Probe<R>,
    ) -> u32 {
        let spent = self.draw_next(renderer, band, buffer, probe);
        self.budget.spend(spent);
        spent.all
    }

    /// Draws the next cell of a band into the buffer; returns the rays that it took.
    fn draw_next<C: DisplayColor>(
        &mut self,
        renderer: &Renderer<'_, 'm, R, S>,
        band: &mut Band<R>,
        buffer: &mut RealtimeBuffer<'_, C>,
        probe: &mut impl Probe<R>,
    ) -> Spent {
        let (size, drawn) = (self.quality.grid.pixels(), band.drawn());
        let paint = Paint {
            settings: &renderer.settings,
            width: band.width(),
            drawn,
            left: band.left,
            top: band.top,
            size,
            is_smooth: self.quality.is_smooth(),
        };
        let among = objects_shown(renderer, band, size);
        if let Some(nothing) = self.nothing
            && among.is_empty()
        {
            paint.blank(buffer.colors, nothing);
            self.hand_on_corners(band, &band.empty_corners(nothing, size), buffer.samples);
            return Spent::default();
        }
        let detail = self.budget.detail();
        let small = self.small_in_cell(band, detail);
        let view = CellView {
            renderer,
            limits: &self.limits,
            unlit: &self.unlit,
            among,
            left: band.left,
            top: band.top,
            aim: self.quality.aim(),
            rows: &band.rows,
            watch: self.small.watch.as_mut(),
        };
        let mut tracer = Tracer {
            view,
            tolerance: Tolerance::new(self.quality.threshold, detail, size),
            tips: band.tips.as_ref(),
            tones: C::TONES,
            probe,
            rays: 0,
            allowed: self.budget.left(),
        };
        let above: Above<'_> = if band.has_top { buffer.samples.get(drawn..) } else { None };
        let (corners, row) =
            trace_corners(&mut self.cell, above, (drawn == 0, self.budget.traces_row()), size, &mut tracer);
        let grid = tracer.rays;
        tracer.allow(self.budget.refines());
        if drawn == 0 {
            band.is_left_refined = refine_first_side(&mut self.cell, size, &mut tracer);
        }
        let plan = Plan::new(&corners, band.is_left_refined, small, size, &tracer);
        plan.draw(&mut self.cell, &corners, above, &mut tracer);
        if plan.needs_corners_alone() {
            paint.smooth(buffer.colors, &corners);
        } else {
            paint_points(&self.cell, plan.traces_all(), paint, buffer.colors, &mut tracer);
        }
        #[cfg(feature = "looks")]
        ink_smooth_cell(&mut self.cell, (&plan, &corners), paint, buffer.colors, &mut tracer);
        let all = tracer.rays;
        self.hand_on(band, &plan, &corners, buffer.samples);
        Spent { all, row, refined: all - grid }
    }

    /// The small things that can be seen in the next cell, as far as it is drawn closely enough to show them.
    fn small_in_cell(&self, band: &Band<R>, detail: Detail) -> SmallInCell {
        let is_thin = detail != Detail::Grid && band.thin.holds(band.left);
        let next = band.left + self.quality.grid.pixels() as u32;
        SmallInCell {
            is_thin,
            is_next_thin: is_thin && band.thin.holds(next),
            // The constant says whether any shape has rims. If none has, the compiler leaves out what
            // follows.
            has_rim: S::Prepared::<'m, R>::HAS_RIMS
                && detail == Detail::Full
                && self.small.has_rim(band.left, band.top),
        }
    }

    /// Hands a cell that is drawn to the cell to the right and to the band below.
    fn hand_on(&mut self, band: &mut Band<R>, plan: &Plan, corners: &Corners, samples: &mut [Sample]) {
        if plan.is_smooth() {
            return self.hand_on_corners(band, corners, samples);
        }
        let (drawn, size) = (band.drawn(), self.quality.grid.pixels());
        if plan.traces_all() {
            hand_down_corners(samples, drawn, corners, size);
        } else {
            hand_down_row(samples, drawn, &self.cell, size);
        }
        self.cell.advance(size);
        self.advance(band, plan.refines_right());
    }

    /// Hands a cell of which only the corners are known to the cell to the right and to the band below.
    fn hand_on_corners(&mut self, band: &mut Band<R>, corners: &Corners, samples: &mut [Sample]) {
        let size = self.quality.grid.pixels();
        self.cell.set(0, 0, corners.top_right);
        self.cell.set(0, size, corners.bottom_right);
        hand_down_corners(samples, band.drawn(), corners, size);
        self.advance(band, false);
    }

    /// Goes on to the next cell of a band.
    fn advance(&mut self, band: &mut Band<R>, is_left_refined: bool) {
        let size = self.quality.grid.pixels() as u32;
        band.is_left_refined = is_left_refined;
        band.left += size;
        // Each cell sets it; the value of the band's last cell counts.
        self.row = Some(GridRow { line: band.top + size, first: band.first, end: band.end });
    }
}

/// The objects that the next cell can show; all, if that is not known.
fn objects_shown<R: Real, S: Geometry>(
    renderer: &Renderer<'_, '_, R, S>,
    band: &Band<R>,
    size: usize,
) -> ObjectSet {
    let (first, last) = (band.left as u16, (band.left as usize + size) as u16);
    let shown = band.strip.as_ref().map(|strip| strip.between(first, last));
    // Beyond the right end of the picture it is not known.
    let is_inside = band.left + (size as u32) < renderer.width();
    shown.filter(|_| is_inside).unwrap_or_else(|| renderer.scene.all())
}

/// Paints a cell from its points. With smooth edges or contours, this may take rays.
fn paint_points<R: Real, S: Geometry, C: DisplayColor, P: Probe<R>>(
    cell: &Cell,
    is_all_traced: bool,
    paint: Paint<'_>,
    colors: &mut [C],
    tracer: &mut Tracer<'_, CellView<'_, '_, R, S>, P>,
) {
    #[cfg(feature = "looks")]
    if tracer.view.renderer.contours.is_some() {
        return paint_inked(cell, is_all_traced, paint, colors, tracer);
    }
    #[cfg(feature = "distributed")]
    if paint.is_smooth {
        let mut near = OutlinesNear::in_cell(paint.size);
        return paint.tones(colors, |x, y| tracer.smooth_tone(cell, (x, y), &mut near, is_all_traced));
    }
    let _ = (is_all_traced, tracer);
    paint.refined(colors, cell);
}

/// Paints a cell of which only the corners are known once more, if a contour goes through it.
#[cfg(feature = "looks")]
fn ink_smooth_cell<R: Real, S: Geometry, C: DisplayColor, P: Probe<R>>(
    cell: &mut Cell,
    (plan, corners): (&Plan, &Corners),
    paint: Paint<'_>,
    colors: &mut [C],
    tracer: &mut Tracer<'_, CellView<'_, '_, R, S>, P>,
) {
    if plan.needs_corners_alone() && tracer.has_edge((0, 0), paint.size) {
        cell.fill_smooth(corners, paint.size);
        paint_inked(cell, false, paint, colors, tracer);
    }
}

/// Paints a cell with its contours.
#[cfg(feature = "looks")]
fn paint_inked<R: Real, S: Geometry, C: DisplayColor, P: Probe<R>>(
    cell: &Cell,
    is_all_traced: bool,
    paint: Paint<'_>,
    colors: &mut [C],
    tracer: &mut Tracer<'_, CellView<'_, '_, R, S>, P>,
) {
    let mut walk = InkWalk::BEGIN;
    // If all points of a cell are traced for their tones alone, no digests can be compared.
    let squares = if is_all_traced { u8::MAX } else { tracer.squares_with_edges(paint.size) };
    #[cfg(feature = "distributed")]
    let mut near = OutlinesNear::in_cell(paint.size);
    paint.tones(colors, |x, y| {
        let tone = cell.get(x, y).tone();
        #[cfg(feature = "distributed")]
        let tone =
            if paint.is_smooth { tracer.smooth_tone(cell, (x, y), &mut near, is_all_traced) } else { tone };
        let square = y / SQUARE * paint.size.div_ceil(SQUARE) + x / SQUARE;
        let may_be_edge = squares >> (square & 7) & 1 != 0 || tracer.may_be_edge(cell, (x, y), paint.size);
        if may_be_edge { tracer.inked(tone, (x, y), &mut walk) } else { tone }
    });
}

/// The corners of a cell, and the rays that the lower right one took. The left corners are known from the
/// cell before unless the cell is the first of its band, the upper ones may be known from `above`. A row of
/// the grid that is not traced is a copy of the row above.
fn trace_corners<R: Real, S: Geometry, P: Probe<R>>(
    cell: &mut Cell,
    above: Above<'_>,
    (is_first, traces_row): (bool, bool),
    size: usize,
    tracer: &mut Tracer<'_, CellView<'_, '_, R, S>, P>,
) -> (Corners, u32) {
    let known = |x: usize| above.and_then(|above| above.get(x)).copied();
    if is_first {
        let top_left = known(0).unwrap_or_else(|| tracer.trace(0, 0));
        cell.set(0, 0, top_left);
        cell.set(0, size, tracer.trace_or_copy(top_left, traces_row, (0, size)));
    }
    let (top_left, bottom_left) = (cell.get(0, 0), cell.get(0, size));
    let top_right = known(size).unwrap_or_else(|| tracer.trace_or_copy(top_left, true, (size, 0)));
    let before = tracer.rays;
    let bottom_right = tracer.trace_or_copy(top_right, traces_row, (size, size));
    (Corners { top_left, top_right, bottom_left, bottom_right }, tracer.rays - before)
}

/// Refines the left side of a band's first cell if the two ends of the side differ; returns whether they do.
/// If not, the side is left as it is: the cell's [`Plan`] interpolates it, if its points are needed.
fn refine_first_side(cell: &mut Cell, size: usize, pixels: &mut impl PixelSource) -> bool {
    let differ = pixels.differ(cell.get(0, 0), cell.get(0, size), size);
    if differ {
        cell.refine_side(Side::down((0, 0), size), pixels);
    }
    differ
}

/// Hands the bottom row of a cell to the band below, without its left end: the cell before has handed that
/// down as its own right end. Only a band's first cell hands down both ends.
fn hand_down_row(samples: &mut [Sample], drawn: usize, cell: &Cell, size: usize) {
    let first = if drawn == 0 { 0 } else { 1 };
    for (x, sample) in (first..=size).zip(samples.iter_mut().skip(drawn + first)) {
        *sample = cell.get(x, size);
    }
}

/// Hands the lower corners of a cell to the band below, and marks the points between them as unknown.
fn hand_down_corners(samples: &mut [Sample], drawn: usize, corners: &Corners, size: usize) {
    if let Some(row) = samples.get_mut(drawn..) {
        if let (0, Some(first)) = (drawn, row.first_mut()) {
            *first = corners.bottom_left;
        }
        if let Some(inside) = row.get_mut(1) {
            *inside = Sample::BLANK;
        }
        if let Some(last) = row.get_mut(size) {
            *last = corners.bottom_right;
        }
    }
}
