//! Contours: lines where neighboring pixels see different things.
//!
//! A pixel has ink if it differs from its neighbor to the right or from its neighbor below: these two
//! differences find each edge once, so lines are one pixel wide. The ink of a pixel depends on scene,
//! settings and place alone, and is the same in any order of lines. No memory is lent: the neighbors of a
//! pixel are traced again, by rays without light. From left to right, the neighbor to the right is the next
//! pixel, so that two rays a pixel are left. No ray is needed where the outlines of objects show that all
//! three pixels see the background.

use super::line_candidates::LineCandidates;
use super::look::Contours;
use super::pixel::Aim;
use super::{Light16, Renderer};
use crate::integrator::WIDTH;
use crate::math::{Kernel, Ray, Real, Vec3};
use crate::prepared::{Departure, Hit, ObjectSet, PreparedScene};
use crate::sampling::{CENTER, RayNumbers};
use crate::shape::{Form, Geometry};
use crate::surface::Surface;

/// The cosine of the least angle between neighbors on one part that is an edge of it, as of the lid of a
/// cylinder: 45°. A ball turns by less from pixel to pixel if its radius is 4 pixels or more.
const SHARP: f32 = 0.707;
/// The share of ink in a pixel that is all ink.
const ALL_INK: u32 = 32768;
/// The most samples of a pixel that are looked at for ink: 16 shares are as smooth as the eye can see.
const MOST_SAMPLES: u16 = 16;

/// Contours as rays need them.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreparedContours<R> {
    /// The cosine of the least angle of a crease.
    cosine: R,
    depth: R,
    ink: Light16,
}

impl<R: Real> PreparedContours<R> {
    /// Contours that were checked.
    pub(super) fn new(contours: &Contours) -> Self {
        // cos a = (1 - t²) / (1 + t²), for t = tan(a / 2).
        let tangent = R::Setup::from_f32(contours.crease / 2.0).tan();
        let square = tangent * tangent;
        Self {
            cosine: R::from_setup((R::Setup::ONE - square) / (R::Setup::ONE + square)),
            depth: R::from_f32(contours.depth),
            ink: Light16::new(contours.ink.to::<R>()),
        }
    }
}

/// The share of ink in a pixel, and the number of rays that were traced to find this share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Ink {
    /// 0 to 32768.
    share: u32,
    pub(super) rays: u32,
}

impl Ink {
    pub(super) const NONE: Self = Self { share: 0, rays: 0 };

    /// All ink on an edge, and none beside it.
    const fn of_edge(is_edge: bool, rays: u32) -> Self {
        Self { share: if is_edge { ALL_INK } else { 0 }, rays }
    }

    /// The share, 0 to 32768.
    pub(super) fn share(self) -> u32 {
        self.share
    }
}

/// The part of a hit that edges depend on.
#[derive(Clone, Copy, Debug)]
struct Mark<R> {
    /// Position of the object; `None` for the background.
    object: Option<usize>,
    /// The distance, and the surface of an object that may have edges in itself.
    part: Option<(R, Surface<R>)>,
}

impl<R: Real> Mark<R> {
    const NOTHING: Self = Self { object: None, part: None };

    /// Whether there is an edge between two neighbors.
    fn differs(&self, other: &Self, contours: &PreparedContours<R>) -> bool {
        if self.object != other.object {
            return true;
        }
        let (Some((t, here)), Some((u, there))) = (&self.part, &other.part) else { return false };
        let [normal, beside] = [here, there].map(|surface| surface.shading_normal);
        let turned = normal.dot(beside);
        let is_bent = here.part == there.part;
        if turned < contours.cosine && !(is_bent && turned > R::from_f32(SHARP)) {
            return true;
        }
        // A step is off the tangent planes of both points. Neighbors on one slanted plane lie on this plane,
        // and neighbors on a bent surface lie near the tangent plane of at least one of them.
        let way = there.point - here.point;
        let step = contours.depth * t.smaller(*u);
        let is_off = |normal: Vec3<R>| normal.dot(way).abs() > step;
        is_off(here.normal) && is_off(there.normal)
    }
}

/// Finds the ink of neighboring pixels, best from left to right.
#[derive(Clone, Copy, Debug)]
pub(super) struct InkWalk<R> {
    /// The place of the pixel to the right of the last one, and its mark.
    next: Option<((u16, u16), Mark<R>)>,
}

impl<R: Real> InkWalk<R> {
    pub(super) const BEGIN: Self = Self { next: None };

    /// The ink of pixel (x, y), if the picture has contours. `among` is what each of the pixels (x, y),
    /// (x + 1, y) and (x, y + 1) can see.
    pub(super) fn ink<S: Geometry>(
        &mut self,
        renderer: &Renderer<'_, '_, R, S>,
        (x, y): (u16, u16),
        mut among: impl FnMut(u16, u16) -> ObjectSet,
    ) -> Ink {
        let Some(contours) = &renderer.contours else { return Ink::NONE };
        if renderer.settings.sampling.samples > 1 {
            return renderer.ink_of_samples((x, y), contours);
        }
        let mut rays = 0;
        let mut mark = |x, y| {
            let among = among(x, y);
            // In a scene without sets of objects, an empty set does not mean that nothing is seen.
            if among.is_empty() && renderer.outlines.count().is_some() {
                return Mark::NOTHING;
            }
            rays += 1;
            renderer.mark_of_pixel((x, y), among)
        };
        let here = match self.next.take() {
            Some((place, here)) if place == (x, y) => here,
            _ => mark(x, y),
        };
        let mut is_edge = false;
        // Pixels beside the picture make no edge.
        if x.saturating_add(1) < renderer.width {
            let right = mark(x + 1, y);
            self.next = Some(((x + 1, y), right));
            is_edge = here.differs(&right, contours);
        }
        if !is_edge && y.saturating_add(1) < renderer.height {
            is_edge = here.differs(&mark(x, y + 1), contours);
        }
        Ink::of_edge(is_edge, rays)
    }
}

/// The objects that the pixels of a line and of the line below can show, for [`InkWalk`].
#[derive(Clone, Copy, Debug)]
pub(super) struct LineInk<'o, R> {
    walk: InkWalk<R>,
    y: u16,
    here: Option<LineCandidates<'o>>,
    below: Option<LineCandidates<'o>>,
}

impl<'o, R: Real> LineInk<'o, R> {
    /// For line `y`; `None` if the picture has no contours.
    pub(super) fn new<S: Geometry>(renderer: &'o Renderer<'_, '_, R, S>, y: u16) -> Option<Self> {
        renderer.contours.as_ref()?;
        let line = |y| LineCandidates::new(&renderer.outlines, y);
        Some(Self { walk: InkWalk::BEGIN, y, here: line(y), below: line(y.saturating_add(1)) })
    }

    /// The ink of pixel `x`, which must not decrease.
    pub(super) fn ink<S: Geometry>(&mut self, renderer: &Renderer<'_, '_, R, S>, x: u16) -> Ink {
        let Self { walk, y, here, below } = self;
        let top = *y;
        walk.ink(renderer, (x, top), |x, y| {
            let line = if y == top { &mut *here } else { &mut *below };
            line.as_mut().map_or_else(|| renderer.scene.all(), |line| line.seen(x))
        })
    }
}

/// A place in the pixel, in 65536ths of it. All pixels have the same ones, so that lines are even
/// (Hammersley, "Monte Carlo Methods for Solving Multivariable Problems", 1960).
fn place_of(index: u16, samples: u16) -> [i32; 2] {
    let along = (u32::from(index) * 2 + 1) << 15;
    let right = along.checked_div(samples.into()).unwrap_or(0);
    [right as i32, i32::from(index.reverse_bits()) + (1 << 11)]
}

impl<R: Real, S: Geometry> Renderer<'_, '_, R, S> {
    /// The mark of the center of a pixel.
    fn mark_of_pixel(&self, (x, y): (u16, u16), among: ObjectSet) -> Mark<R> {
        let (viewport, row) = (&self.viewport, self.row(y, Aim::Area));
        self.scene.mark(&viewport.ray(viewport.across((x, CENTER)), row, &RayNumbers::NONE), among)
    }

    /// The mark of the pixel at this distance from a corner, and one more ray; `None` beside the picture,
    /// where no pixel makes an edge.
    fn mark_in_picture(
        &self,
        (left, top): (u16, u16),
        (right, down): (u16, u16),
        among: ObjectSet,
        rays: &mut u32,
    ) -> Option<Mark<R>> {
        let (x, y) = (left.checked_add(right)?, top.checked_add(down)?);
        if x >= self.width || y >= self.height {
            return None;
        }
        *rays += 1;
        Some(self.mark_of_pixel((x, y), among))
    }

    /// Whether pixels at the corners of a square of this length see different things, and the number of rays
    /// that this test took. `false` if the picture has no contours.
    pub(super) fn has_edge_in(&self, (left, top): (u16, u16), length: u16, among: ObjectSet) -> (bool, u32) {
        let Some(contours) = &self.contours else { return (false, 0) };
        let mut rays = 0;
        let mut mark = |right, down| self.mark_in_picture((left, top), (right, down), among, &mut rays);
        let first = mark(0, 0);
        let mut differs = |right, down| {
            first.zip(mark(right, down)).is_some_and(|(first, other)| first.differs(&other, contours))
        };
        let has_edge = differs(length, 0) || differs(0, length) || differs(length, length);
        (has_edge, rays)
    }

    /// The ink of the pixels of a rectangle, row by row, which takes fewer rays than pixel by pixel; all
    /// pixels together have one sample each. Returns the rays.
    pub(super) fn ink_of_group(
        &self,
        (left, top): (u16, u16),
        (width, height): (usize, usize),
        inks: &mut [Ink; WIDTH],
    ) -> u32 {
        let Some(contours) = &self.contours else { return 0 };
        let mut rays = 0;
        let mut mark = |right: usize, down: usize| {
            let from_corner = (right as u16, down as u16);
            self.mark_in_picture((left, top), from_corner, self.scene.all(), &mut rays)
        };
        let mut row: [Option<Mark<R>>; WIDTH + 1] = [None; WIDTH + 1];
        for (right, here) in row.iter_mut().take(width + 1).enumerate() {
            *here = mark(right, 0);
        }
        for (line, inks) in (1..=height).zip(inks.chunks_mut(width.max(1))) {
            let mut rest = &mut row[..];
            let mut right = 0;
            while let [here, others @ ..] = rest
                && right <= width
            {
                let is_last = right == width;
                // The last line needs nothing of the pixel beside it.
                let below = if is_last && line == height { None } else { mark(right, line) };
                let differs = |other: &Option<Mark<R>>| {
                    here.as_ref()
                        .zip(other.as_ref())
                        .is_some_and(|(here, other)| here.differs(other, contours))
                };
                let is_edge = differs(&below) || others.first().is_some_and(differs);
                if let Some(ink) = inks.get_mut(right).filter(|_| !is_last) {
                    *ink = Ink::of_edge(is_edge, 0);
                }
                *here = below;
                rest = others;
                right += 1;
            }
        }
        rays
    }

    /// The ink of a pixel alone.
    pub(super) fn ink(&self, x: u16, y: u16) -> Ink {
        let mut walk = InkWalk::BEGIN;
        walk.ink(self, (x, y), |_, _| self.scene.all())
    }

    /// Light with ink on it.
    pub(super) fn inked(&self, light: Light16, ink: Ink) -> Light16 {
        self.color_of(ink).map_or(light, |color| light.mixed(color, ink.share()))
    }

    /// The light of ink, if a pixel has any.
    pub(super) fn color_of(&self, ink: Ink) -> Option<Light16> {
        self.contours.as_ref().filter(|_| ink.share > 0).map(|contours| contours.ink)
    }

    /// The share of a pixel's samples that lie on an edge.
    fn ink_of_samples(&self, (x, y): (u16, u16), contours: &PreparedContours<R>) -> Ink {
        let samples = self.settings.sampling.samples.min(MOST_SAMPLES);
        let mut ink = Ink::NONE;
        let mut on_edge = 0u32;
        for index in 0..samples {
            let numbers = RayNumbers::of(self.sample((x, y), index));
            let [right, down] = place_of(index, samples);
            let mut mark = |x: u16, y: u16| {
                ink.rays += 1;
                self.mark_of_sample((x, right), (y, down), &numbers)
            };
            let here = mark(x, y);
            let is_edge = x.saturating_add(1) < self.width && here.differs(&mark(x + 1, y), contours)
                || y.saturating_add(1) < self.height && here.differs(&mark(x, y + 1), contours);
            on_edge += u32::from(is_edge);
        }
        ink.share = (on_edge * ALL_INK).checked_div(samples.into()).unwrap_or(0);
        ink
    }

    /// The mark of one sample of a pixel.
    fn mark_of_sample(&self, across: (u16, i32), down: (u16, i32), numbers: &RayNumbers) -> Mark<R> {
        let (viewport, scene) = (&self.viewport, self.scene);
        let ray = viewport.ray(viewport.across(across), viewport.row(down), numbers);
        #[cfg(feature = "distributed")]
        if scene.moves() {
            let [time, _] = numbers.pair(crate::sampling::Dimension::TIME);
            let moment = scene.at(R::from_fraction(time));
            return moment.mark(&moment.moved_by_camera(ray), scene.all());
        }
        scene.mark(&ray, scene.all())
    }
}

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    /// The mark of a ray from the eye that can meet these objects.
    fn mark(&self, ray: &Ray<R>, among: ObjectSet) -> Mark<R> {
        let Some((t, object)) = self.closest_from(ray, Departure::NONE, among) else { return Mark::NOTHING };
        // Balls and planes have no edges in themselves.
        if matches!(self.form(object), Some(Form::Ball { .. } | Form::Flat { .. })) {
            return Mark { object: Some(object), part: None };
        }
        let mut hit = Hit::BLANK;
        let met = self.write_hit(ray, Some((t, object)), &mut hit);
        Mark { object: Some(object), part: met.map(|_| (t, hit.surface)) }
    }
}
