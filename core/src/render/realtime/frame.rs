//! Drawing in realtime quality, in steps.

use core::marker::PhantomData;
use core::ops::Range;

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;

use super::budget::{Budget, Detail, Spent};
use super::cell::{Cell, Corners, Look, Way};
use super::close::{ClosePlaces, tapering_objects};
use super::limits::Limits;
use super::paint::Paint;
use super::rims::RimPlaces;
use super::seen::FAINT;
use super::strip::Strip;
use super::thin::{ThinPlaces, thin_objects};
use super::tiny::{Tiny, Watch};
use super::tracer::Tracer;
use super::{Realtime, RealtimeBuffer, Sample};
use crate::integrator::Bounds;
use crate::math::Real;
use crate::prepared::ObjectSet;
use crate::prepared::PreparedScene;
use crate::probe::Probe;
use crate::render::{DisplayColor, DrawError, LineError, Progress, Renderer};
use crate::shape::{Geometry, Intersect};

/// Rays that would bring a smaller share than this are left out.
const CUTOFF: f32 = 1.0 / 64.0;

/// A picture that is being drawn in realtime quality: remembers how far it is.
///
/// # Guarantees
/// [`step`](Self::step) performs a bounded amount of work, and a picture drawn in steps has the same bytes as one
/// drawn at once, in any order of lines. A pixel is traced once for one band of lines, and some once more without lights.
#[derive(Debug)]
pub struct RealtimeFrame<'p, 'm, 'b, R: Real, S: Geometry + 'm, C> {
    renderer: &'p Renderer<'p, 'm, R, S>,
    /// When rays are no longer followed.
    bounds: Bounds<R>,
    /// The scene without its lights, and when rays are no longer followed there: those that leave no mark are not. Worked out for each look, that takes
    /// `classic` up to 0.6 % longer on an M4F.
    unlit: PreparedScene<'m, R, S>,
    unlit_bounds: Bounds<R>,
    quality: Realtime,
    buffer: RealtimeBuffer<'b, C>,
    /// The lines that are not yet on the display.
    lines: Range<u32>,
    /// How many lines were to be drawn.
    total: u32,
    /// Objects that could hide between the points of the grid; `None`: any could.
    thin: Option<ObjectSet>,
    /// Objects that taper off.
    tapering: ObjectSet,
    /// Where something may be thin in parts.
    rims: Option<RimPlaces>,
    band: Option<Band>,
    /// The line of the picture that the lent row of samples holds.
    row: Option<u32>,
    /// A pixel that sees nothing, where all such pixels look alike.
    nothing: Option<Sample>,
    /// Watches for what could hide where that is not known.
    watch: Option<Watch<R>>,
    cell: Cell,
    budget: Budget,
}

/// The lines between two rows of the grid.
#[derive(Clone, Copy, Debug)]
struct Band {
    top: u32,
    /// Left column of the next cell.
    left: u32,
    /// Whether the lent row of samples holds the upper row of the grid from there on.
    has_top: bool,
    /// Whether the left side of the next cell was looked at closely.
    rough_left: bool,
    strip: Option<Strip>,
    thin: ThinPlaces,
    close: Option<ClosePlaces>,
}

impl<'p, 'm, 'b, R: Real, S: Geometry + 'm, C: DisplayColor> RealtimeFrame<'p, 'm, 'b, R, S, C> {
    pub(super) fn new(
        renderer: &'p Renderer<'p, 'm, R, S>,
        lines: Range<u32>,
        quality: Realtime,
        buffer: RealtimeBuffer<'b, C>,
    ) -> Result<Self, LineError> {
        let lines = renderer.lines_of(lines)?;
        let needed = quality.colors(renderer.width);
        if buffer.colors.len() != needed {
            return Err(LineError::BandLength { given: buffer.colors.len(), needed });
        }
        let needed = quality.samples(renderer.width);
        if buffer.samples.len() != needed {
            return Err(LineError::SampleCount { given: buffer.samples.len(), needed });
        }
        let total = lines.end.saturating_sub(lines.start);
        let cutoff = renderer.bounds.cutoff.larger(R::from_f32(CUTOFF));
        let mut unlit = *renderer.scene;
        unlit.lights = &[];
        let thin = thin_objects(renderer, quality.grid);
        let tapering = tapering_objects(renderer, quality.grid);
        Ok(Self {
            quality,
            buffer,
            total,
            lines,
            thin,
            tapering,
            rims: RimPlaces::new(renderer, quality.grid),
            band: None,
            row: None,
            nothing: Tracer::<R, S, C, ()>::nothing(renderer),
            bounds: Bounds { cutoff, ..renderer.bounds },
            unlit,
            unlit_bounds: Bounds { cutoff: cutoff.larger(R::from_f32(FAINT)), ..renderer.bounds },
            renderer,
            watch: Tiny::new(renderer, quality.grid).map(Watch::new),
            cell: Cell::BLANK,
            budget: Budget::new(quality.budget_rays, total),
        })
    }

    /// Goes on with other lines of the same picture, that may begin and end anywhere. What is known of the whole picture is not found out
    /// again, nor is what lies above them traced once more if they follow those drawn last. Lines that were not yet on the display are not
    /// drawn, and the budget is a new one.
    ///
    /// # Errors
    /// Where the picture has no such lines; then it goes on as before.
    pub fn set_lines(&mut self, lines: Range<u32>) -> Result<(), LineError> {
        self.lines = self.renderer.lines_of(lines)?;
        self.total = self.lines.end.saturating_sub(self.lines.start);
        self.budget = Budget::new(self.quality.budget_rays, self.total);
        if self.band.take().is_some() {
            // The row is half that of the one line, half that of another.
            self.row = None;
        }
        Ok(())
    }

    /// Traces cells of the grid until `budget_rays` are spent, and at least one; sends each band of lines to the
    /// display as soon as it is complete. A step spends less than `budget_rays` plus
    /// [`Settings::rays_per_pixel`](crate::Settings) for each pixel of a cell and its sides, twice: some
    /// are looked at before they are traced.
    ///
    /// # Errors
    /// The display's own error, with the first line that may not have been drawn. Nothing is lost: the next step
    /// sends that line again.
    pub fn step<D>(&mut self, display: &mut D, budget_rays: u32) -> Result<Progress, DrawError<D::Error>>
    where
        D: DrawTarget<Color = C>,
    {
        self.step_watched(display, budget_rays, &mut ())
    }

    /// As [`step`](Self::step), and tells `probe` what happens. Only pixels that are traced happen.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_watched<D>(
        &mut self,
        display: &mut D,
        budget_rays: u32,
        probe: &mut impl Probe<R>,
    ) -> Result<Progress, DrawError<D::Error>>
    where
        D: DrawTarget<Color = C>,
    {
        let mut spent: u32 = 0;
        while !self.lines.is_empty() {
            let mut band = match self.band {
                Some(band) => band,
                None => self.begin(),
            };
            while band.left < self.renderer.width() {
                let rays = self.draw_cell(&mut band, probe);
                self.budget.spend(rays);
                // A cell without rays takes time too.
                spent = spent.saturating_add(rays.all.max(1));
                if spent >= budget_rays {
                    break;
                }
            }
            self.band = Some(band);
            if band.left < self.renderer.width() {
                break;
            }
            self.send(display, band.top)?;
            if spent >= budget_rays {
                break;
            }
        }
        let left = self.lines.end.saturating_sub(self.lines.start);
        Ok(Progress { lines_done: self.total.saturating_sub(left), lines_total: self.total, rays: spent })
    }

    /// The band that holds the next line.
    fn begin(&mut self) -> Band {
        let side = self.quality.grid.pixels();
        let top = self.lines.start & !(side as u32 - 1);
        let bottom = (top + side as u32).min(u32::from(u16::MAX));
        self.budget.share(side as u32, self.lines.end.saturating_sub(self.lines.start));
        let lines = (top as u16, bottom as u16);
        let mut thin = ThinPlaces::none(self.renderer.width, self.quality.grid, self.thin);
        let strip = Strip::new(self.renderer, lines, &mut thin);
        if strip.is_none() {
            thin.add_all(self.renderer, lines);
        }
        thin.add_shadows(self.renderer, lines);
        let close = ClosePlaces::new(self.renderer, self.quality.grid, lines, self.tapering);
        Band { top, left: 0, has_top: self.row == Some(top), rough_left: false, strip, thin, close }
    }

    /// Draws the next cell of a band into the buffer; tells how many rays that took.
    fn draw_cell(&mut self, band: &mut Band, probe: &mut impl Probe<R>) -> Spent {
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
            limits: Limits::new(self.quality.threshold, detail, side),
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
            paint.blank(self.buffer.colors, nothing);
            let corner = |x: usize, y: usize| tracer.marked(nothing, x, y);
            let corners = Corners {
                top_left: corner(0, 0),
                top_right: corner(side, 0),
                bottom_left: corner(0, side),
                bottom_right: corner(side, side),
            };
            self.finish_smooth(band, corners, side);
            return Spent::default();
        }

        // The corners: those on the left and above may be known.
        let known = if band.has_top { self.buffer.samples.get(left..) } else { None };
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
                paint.refined(self.buffer.colors, cell);
            } else {
                paint.smooth(self.buffer.colors, &corners);
            }
            let all = tracer.rays;
            self.finish_smooth(band, corners, side);
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
        paint.refined(self.buffer.colors, cell);
        band.rough_left = looks_right;
        if thin {
            hand_corners(self.buffer.samples, left, &corners, side);
        } else {
            let first = if left == 0 { 0 } else { 1 };
            for (x, sample) in (first..=side).zip(self.buffer.samples.iter_mut().skip(left + first)) {
                *sample = cell.get(x, side);
            }
        }
        let all = tracer.rays;
        self.cell.advance(side);
        self.finish(band, side);
        Spent { all, row, refined: all - grid }
    }

    /// Hands a cell's right side to the next one, and its bottom to the band below, if they are straight.
    fn finish_smooth(&mut self, band: &mut Band, corners: Corners, side: usize) {
        self.cell.set(0, 0, corners.top_right);
        self.cell.set(0, side, corners.bottom_right);
        band.rough_left = false;
        hand_corners(self.buffer.samples, band.left as usize, &corners, side);
        self.finish(band, side);
    }

    fn finish(&mut self, band: &mut Band, side: usize) {
        band.left += side as u32;
        if band.left >= self.renderer.width() {
            self.row = Some(band.top + side as u32);
        }
    }

    /// Sends the lines of a complete band that are still to be drawn.
    fn send<D>(&mut self, display: &mut D, top: u32) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget<Color = C>,
    {
        let end = (top + self.quality.grid.pixels() as u32).min(self.lines.end);
        let width = usize::from(self.renderer.width);
        let size = Size::new(self.renderer.width(), end.saturating_sub(self.lines.start));
        let area = Rectangle::new(Point::new(0, self.lines.start as i32), size);
        let above = self.lines.start.saturating_sub(top) as usize * width;
        let colors = self.buffer.colors.iter().skip(above).take(size.height as usize * width).copied();
        display
            .fill_contiguous(&area, colors)
            .map_err(|error| DrawError::Display { line: self.lines.start, error })?;
        self.lines.start = end;
        self.band = None;
        Ok(())
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
