//! Traces pixels of one cell, and tells which are alike.

use core::marker::PhantomData;

use super::Sample;
use super::cell::Look;
use super::close::ClosePlaces;
use super::limits::Limits;
use super::seen::{FAINT, Seen};
use super::tiny::Watch;
use crate::color::LinearRgb;
use crate::integrator::{Bounds, Sight};
use crate::math::{Ray, Real, Vec3};
use crate::prepared::ObjectSet;
use crate::prepared::PreparedScene;
use crate::probe::{Event, Probe};
use crate::render::{DisplayColor, Light16, Quantizer, Renderer, Tone};
use crate::shape::Geometry;

/// What is less than this far from an edge is looked at, in 1/16 of a pixel: edges are known to half a pixel.
const NEAR: u32 = 5;

/// What is asked of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asked {
    /// Its tone alone.
    Tone,
    /// What it met, in a scene without lights.
    Path,
    /// All that it saw, and if it stands for others, what lies beside that.
    Marks,
}

/// Traces pixels among the objects that a cell can show.
pub(super) struct Tracer<'r, 'p, 'm, 'w, R: Real, S: Geometry + 'm, C, P> {
    pub(super) renderer: &'r Renderer<'p, 'm, R, S>,
    pub(super) bounds: &'r Bounds<R>,
    pub(super) unlit: &'r PreparedScene<'m, R, S>,
    pub(super) unlit_bounds: &'r Bounds<R>,
    pub(super) among: ObjectSet,
    /// The cell's upper left pixel.
    pub(super) left: u32,
    pub(super) top: u32,
    pub(super) limits: Limits,
    pub(super) watch: Option<&'w mut Watch<R>>,
    pub(super) close: Option<&'r ClosePlaces>,
    pub(super) color: PhantomData<C>,
    pub(super) probe: &'w mut P,
    pub(super) rays: u32,
    /// How many they may be: with the last pixel, they may be more.
    pub(super) allowed: u32,
}

impl<'r, 'p, 'm, R: Real, S: Geometry + 'm, C: DisplayColor> Tracer<'r, 'p, 'm, '_, R, S, C, ()> {
    /// A pixel that sees nothing, where all such pixels look alike.
    pub(super) fn nothing(renderer: &'r Renderer<'p, 'm, R, S>) -> Option<Sample> {
        let color = renderer.scene.background.solid()?;
        let mut probe = ();
        let mut seen = Seen::new(renderer.scene, R::from_f32(FAINT), None, &mut probe);
        let ray = Ray { origin: Vec3::ZERO, direction: Vec3::ZERO };
        seen.record(Event::Miss { ray, color, throughput: LinearRgb::even(R::ONE) });
        let quantizer = Quantizer::nearest(renderer.settings.transfer);
        Some(seen.sample(C::tone(Light16::new(color), &quantizer)))
    }
}

impl<R: Real, S: Geometry, C: DisplayColor, P: Probe<R>> Tracer<'_, '_, '_, '_, R, S, C, P> {
    /// A pixel of the grid; or, where it may not be traced or no rays are left, as its neighbor.
    pub(super) fn trace_or(&mut self, neighbor: Sample, may: bool, (x, y): (usize, usize)) -> Sample {
        if may && self.rays < self.allowed { self.trace(x, y) } else { neighbor.again() }
    }

    /// What a pixel saw, and whether that is near something small whose place is known.
    #[inline]
    pub(super) fn marked(&self, sample: Sample, x: usize, y: usize) -> Sample {
        match self.close {
            Some(close) if close.are_near(self.left + x as u32, y) => sample.near_glint(),
            _ => sample,
        }
    }

    /// From here on, so many rays more at most: then it looks nowhere.
    pub(super) fn allow(&mut self, rays: u32) {
        self.allowed = self.allowed.min(self.rays.saturating_add(rays));
        if self.rays >= self.allowed {
            self.limits = Limits::NONE;
        }
    }

    /// The light of a pixel, and what is asked of it, as a sample.
    // Called from many places: one copy is enough.
    #[inline(never)]
    fn look(&mut self, asked: Asked, x: usize, y: usize) -> Sample {
        // The camera sees on beyond the picture.
        let place = |first: u32, i: usize| u16::try_from(first + i as u32).unwrap_or(u16::MAX);
        let (scene, bounds) = match asked {
            Asked::Path => (self.unlit, self.unlit_bounds),
            _ => (self.renderer.scene, self.bounds),
        };
        let (faint, watch) = match asked {
            Asked::Tone => (R::ONE, None),
            _ => (R::from_f32(FAINT), self.watch.as_mut().and_then(|watch| watch.stand_for(x, y))),
        };
        let mut seen = Seen::new(scene, faint, watch, self.probe);
        let (x, y) = (place(self.left, x), place(self.top, y));
        let sight = Sight::among(self.among);
        let (light, rays) = self.renderer.light_in(scene, bounds, (x, y), sight, &mut seen);
        self.rays = self.rays.saturating_add(rays);
        if self.rays >= self.allowed {
            self.limits = Limits::NONE;
        }
        let quantizer = Quantizer::nearest(self.renderer.settings.transfer);
        let tone =
            if asked == Asked::Path { Tone::new(0, 0, 0) } else { C::tone(Light16::new(light), &quantizer) };
        seen.sample(tone)
    }
}

impl<R: Real, S: Geometry, C: DisplayColor, P: Probe<R>> Look for Tracer<'_, '_, '_, '_, R, S, C, P> {
    fn trace(&mut self, x: usize, y: usize) -> Sample {
        let sample = self.look(Asked::Marks, x, y);
        self.marked(sample, x, y)
    }

    fn tone(&mut self, x: usize, y: usize) -> Sample {
        self.look(Asked::Tone, x, y)
    }

    fn choose(&mut self, x: usize, y: usize, a: Sample, b: Sample, distance: usize) -> Sample {
        if distance <= 2 && a.path() != b.path() && a.is_shaded_like(b) {
            // Two pixels away, what stands before the lights is no other.
            let path = self.look(Asked::Path, x, y).path();
            if path == a.path() {
                return a.again();
            }
            if path == b.path() {
                return b.again();
            }
        }
        if distance > 2 { self.trace(x, y) } else { self.look(Asked::Marks, x, y) }
    }

    #[inline(always)]
    fn differ(&self, a: Sample, b: Sample, distance: usize) -> bool {
        self.limits.differ(a, b, distance)
    }

    fn may_trace(&self) -> bool {
        self.limits.may_trace()
    }

    #[inline]
    fn near(&self) -> u32 {
        if self.limits.is_full() { NEAR } else { 0 }
    }
}
