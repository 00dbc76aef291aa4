//! Traces the pixels of one cell.

#[cfg(feature = "looks")]
use super::cell::Cell;
#[cfg(feature = "looks")]
use super::grid::SQUARE;
use super::grid::beyond;
use super::marks::{FAINT, MarkProbe};
use super::pixel_source::PixelSource;
use super::sample::Sample;
use super::side::POINTS;
use super::small::{TipPoints, Watch};
use super::tolerance::Tolerance;
use crate::camera::RayRow;
use crate::color::LinearRgb;
use crate::integrator::{RayLimits, Sight};
use crate::math::{Ray, Real, Vec3};
use crate::prepared::ObjectSet;
use crate::prepared::PreparedScene;
use crate::probe::{Event, Probe};
#[cfg(feature = "looks")]
use crate::render::contours::InkWalk;
use crate::render::pixel::{Aim, Pixel};
#[cfg(feature = "looks")]
use crate::render::toon::step_of;
use crate::render::{Light16, Renderer, Tone, ToneScale};
use crate::shape::Geometry;

/// Pixels up to this distance from a straight edge are traced, in 1/16 of a pixel: the places where an edge
/// crosses the sides of a square are known to half a pixel.
const BESIDE_EDGE: u32 = 5;

/// The purpose of tracing a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Purpose {
    /// Its tone alone.
    Tone,
    /// The objects that it meets: it is traced in a scene without lights.
    Objects,
    /// Everything: its tone and both digests, and small things beside its rays.
    Marks,
}

/// The scene without its lights, and when its rays end.
#[derive(Debug)]
pub(super) struct UnlitScene<'m, R: Real, S: Geometry + 'm> {
    pub(super) scene: PreparedScene<'m, R, S>,
    pub(super) limits: RayLimits<R>,
}

/// A cell, as its rays need it.
pub(super) struct CellView<'c, 'm, R: Real, S: Geometry + 'm> {
    pub(super) renderer: &'c Renderer<'c, 'm, R, S>,
    /// When rays of the scene end.
    pub(super) limits: &'c RayLimits<R>,
    pub(super) unlit: &'c UnlitScene<'m, R, S>,
    /// The objects that the cell can show.
    pub(super) among: ObjectSet,
    /// Column and line of the cell's upper left pixel.
    pub(super) left: u32,
    pub(super) top: u32,
    /// Where the rays of its pixels go.
    pub(super) aim: Aim,
    /// The camera rays of the cell's lines.
    pub(super) rows: &'c [RayRow<R>; POINTS],
    pub(super) watch: Option<&'c mut Watch<R>>,
}

/// Traces pixels of one cell. `V` is the cell's [`CellView`], `P` the probe.
pub(super) struct Tracer<'c, V, P> {
    pub(super) view: V,
    pub(super) tolerance: Tolerance,
    pub(super) tips: Option<&'c TipPoints>,
    pub(super) tones: ToneScale,
    pub(super) probe: &'c mut P,
    /// The rays that were traced, and how many may be; the last pixel may exceed that.
    pub(super) rays: u32,
    pub(super) allowed: u32,
}

/// The sample of a pixel whose ray meets no object, if all such pixels look alike.
pub(super) fn nothing_met<R: Real, S: Geometry>(
    renderer: &Renderer<'_, '_, R, S>,
    tones: ToneScale,
) -> Option<Sample> {
    let color = renderer.scene.background.solid()?;
    let mut probe = ();
    let mut marks = MarkProbe::new(renderer.scene, R::from_f32(FAINT), None, &mut probe);
    let ray = Ray { origin: Vec3::ZERO, direction: Vec3::ZERO };
    marks.record(Event::Miss { ray, color, throughput: LinearRgb::even(R::ONE) });
    let light = Light16::new(renderer.toned(color));
    #[cfg(feature = "looks")]
    marks.fold_step(step_of(renderer.settings.look.tones, light));
    Some(marks.sample(tones.tone(light, renderer.settings.transfer)))
}

impl<R: Real, S: Geometry, P: Probe<R>> Tracer<'_, CellView<'_, '_, R, S>, P> {
    /// The pixel at a point of the grid: traced if `may_trace` and rays are left, and else a copy of its
    /// neighbor.
    pub(super) fn trace_or_copy(
        &mut self,
        neighbor: Sample,
        may_trace: bool,
        (x, y): (usize, usize),
    ) -> Sample {
        if may_trace && self.rays < self.allowed { self.trace(x, y) } else { neighbor.untraced() }
    }

    /// Allows at most this many rays more. Without rays, everything else is interpolated.
    pub(super) fn allow(&mut self, rays: u32) {
        self.allowed = self.allowed.min(self.rays.saturating_add(rays));
        self.stop_if_spent();
    }

    fn stop_if_spent(&mut self) {
        if self.rays >= self.allowed {
            self.tolerance = Tolerance::NONE;
        }
    }

    /// Traces the pixel at a point, as far as its purpose needs.
    // Called from many places: one copy is enough.
    fn trace_for(&mut self, purpose: Purpose, x: usize, y: usize) -> Sample {
        let view = &mut self.view;
        let (scene, limits) = match purpose {
            Purpose::Objects => (&view.unlit.scene, &view.unlit.limits),
            Purpose::Tone | Purpose::Marks => (view.renderer.scene, view.limits),
        };
        let (faint, watch) = match purpose {
            Purpose::Tone => (R::ONE, None),
            Purpose::Objects | Purpose::Marks => {
                (R::from_f32(FAINT), view.watch.as_mut().and_then(|watch| watch.stand_for(x, y)))
            }
        };
        let mut marks = MarkProbe::new(scene, faint, watch, self.probe);
        let row = view.rows.get(y).copied().unwrap_or(RayRow::TOP);
        let pixel = Pixel { x: beyond(view.left, x), y: beyond(view.top, y), row, aim: view.aim };
        let sight = Sight::among(view.among);
        let (light, rays) = view.renderer.light_in(scene, limits, pixel, sight, &mut marks);
        let tone = if purpose == Purpose::Objects {
            Tone::new(0, 0, 0)
        } else {
            let light = Light16::new(light);
            #[cfg(feature = "looks")]
            marks.fold_step(step_of(view.renderer.settings.look.tones, light));
            self.tones.tone(light, view.renderer.settings.transfer)
        };
        let sample = marks.sample(tone);
        self.spend(rays);
        sample
    }

    /// The squares of four pixels of a cell whose corners see different things, a bit for each.
    ///
    /// Two different things have the same digest in one of 128 cases. Digests alone would then lose the whole
    /// line between these things.
    #[cfg(feature = "looks")]
    pub(super) fn squares_with_edges(&mut self, size: usize) -> u8 {
        let squares = size.div_ceil(SQUARE);
        let mut with_edges = 0;
        for square in 0..squares * squares {
            let corner = (square % squares * SQUARE, square / squares * SQUARE);
            with_edges |= u8::from(self.has_edge(corner, size.min(SQUARE))) << (square & 7);
        }
        with_edges
    }

    /// Whether pixels at the corners of a square see different things, as long as rays are left.
    #[cfg(feature = "looks")]
    pub(super) fn has_edge(&mut self, (x, y): (usize, usize), length: usize) -> bool {
        let (renderer, among) = (self.view.renderer, self.view.among);
        if renderer.contours.is_none() || self.rays >= self.allowed {
            return false;
        }
        let corner = (beyond(self.view.left, x), beyond(self.view.top, y));
        let (has_edge, rays) = renderer.has_edge_in(corner, length as u16, among);
        self.spend(rays);
        has_edge
    }

    /// Whether points around a pixel differ, so that an edge may go through it: two pixels around, because
    /// edges within a cell are known to half a pixel.
    #[cfg(feature = "looks")]
    pub(super) fn may_be_edge(&self, cell: &Cell, (x, y): (usize, usize), size: usize) -> bool {
        let (here, around) = (cell.get(x, y), |place: usize| place.saturating_sub(1)..=(place + 2).min(size));
        around(y).any(|y| around(x).any(|x| self.tolerance.differ(here, cell.get(x, y), 1)))
    }

    /// A tone with the ink of the pixel at a point, as long as rays are left.
    #[cfg(feature = "looks")]
    pub(super) fn inked(&mut self, tone: Tone, (x, y): (usize, usize), walk: &mut InkWalk<R>) -> Tone {
        let (renderer, among) = (self.view.renderer, self.view.among);
        if self.rays >= self.allowed {
            return tone;
        }
        let ink = walk.ink(renderer, (beyond(self.view.left, x), beyond(self.view.top, y)), |_, _| among);
        self.spend(ink.rays);
        let inked = |color| self.tones.mixed(tone, color, ink.share(), renderer.settings.transfer);
        renderer.color_of(ink).map_or(tone, inked)
    }

    /// Counts rays that were traced.
    pub(super) fn spend(&mut self, rays: u32) {
        self.rays = self.rays.saturating_add(rays);
        self.stop_if_spent();
    }
}

impl<R: Real, S: Geometry, P: Probe<R>> PixelSource for Tracer<'_, CellView<'_, '_, R, S>, P> {
    fn trace(&mut self, x: usize, y: usize) -> Sample {
        let sample = self.trace_for(Purpose::Marks, x, y);
        match self.tips {
            Some(tips) => tips.mark(sample, self.view.left + x as u32, y),
            None => sample,
        }
    }

    fn trace_tone(&mut self, x: usize, y: usize) -> Sample {
        self.trace_for(Purpose::Tone, x, y)
    }

    fn trace_between(&mut self, (x, y): (usize, usize), a: Sample, b: Sample, distance: usize) -> Sample {
        if distance > 2 {
            return self.trace(x, y);
        }
        if a.path() != b.path() && a.is_shaded_like(b) {
            // No other object stands before the lights between two pixels so close. So a trace without lights
            // is enough to find which of the two pixels this pixel is like.
            let path = self.trace_for(Purpose::Objects, x, y).path();
            if path == a.path() {
                return a.untraced();
            }
            if path == b.path() {
                return b.untraced();
            }
            if !self.may_trace() {
                return a.untraced();
            }
        }
        self.trace_for(Purpose::Marks, x, y)
    }

    #[inline]
    fn differ(&self, a: Sample, b: Sample, distance: usize) -> bool {
        self.tolerance.differ(a, b, distance)
    }

    fn may_trace(&self) -> bool {
        self.tolerance.may_trace()
    }

    #[inline]
    fn are_corners(&self) -> bool {
        self.view.aim == Aim::Corner
    }

    #[inline]
    fn traced_beside_edge(&self) -> u32 {
        if self.tolerance.is_full() { BESIDE_EDGE } else { 0 }
    }
}
