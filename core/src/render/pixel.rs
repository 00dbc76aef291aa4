//! One pixel: its samples, and their mean.

use super::Renderer;
use crate::camera::RayRow;
use crate::color::LinearRgb;
use crate::integrator::{RayBudget, RayLimits, SampleRays, Seen, Sight, radiance};
use crate::lens::PreparedLens;
use crate::math::{Ray, Real};
use crate::prepared::PreparedScene;
use crate::probe::Probe;
use crate::sampling::{Adaptive, CENTER, Dimension, PixelSample, Sampling};
use crate::shape::Geometry;

/// A pixel, with the rays through the centers of its line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel<R> {
    pub(super) x: u16,
    pub(super) y: u16,
    pub(super) row: RayRow<R>,
}

/// The light of the samples that a pixel took so far.
struct Samples<R> {
    /// The sum of their light; in fixed point, where it may overflow, times the share of each sample.
    light: LinearRgb<R>,
    taken: u16,
    /// How they differ, while that is of use.
    spread: Option<Spread<R>>,
}

/// How the first samples of a pixel differ.
#[derive(Clone, Copy, Debug)]
struct Spread<R> {
    least: LinearRgb<R>,
    most: LinearRgb<R>,
    /// What the first sample met.
    seen: Seen,
    /// Whether another sample met something else.
    saw_other: bool,
}

/// The contrast of red and blue light at which samples differ, over that of green light (Mitchell, 1987).
const CONTRAST_OF_RED: f32 = 4.0 / 3.0;
const CONTRAST_OF_BLUE: f32 = 2.0;
/// Light that differs by less than this is the same on all displays.
const INVISIBLE: f32 = 1.0 / 2048.0;

impl<R: Real> Spread<R> {
    fn new(light: LinearRgb<R>, seen: Seen) -> Self {
        Self { least: light, most: light, seen, saw_other: false }
    }

    fn add(&mut self, light: LinearRgb<R>, seen: Seen) {
        let least = |a: R, b: R| if b < a { b } else { a };
        let LinearRgb { r, g, b } = light;
        self.least = LinearRgb::new(least(self.least.r, r), least(self.least.g, g), least(self.least.b, b));
        self.most = LinearRgb::new(self.most.r.larger(r), self.most.g.larger(g), self.most.b.larger(b));
        self.saw_other |= seen != self.seen;
    }

    /// Whether the samples differ so much that more of them are needed.
    fn needs_more(&self, contrast: f32) -> bool {
        let differs = |least: R, most: R, sensitivity: f32| {
            let apart = most - least;
            let allowed = R::from_f32((contrast * sensitivity).min(1.0));
            apart > R::from_f32(INVISIBLE) && apart > most.add_saturating(least) * allowed
        };
        self.saw_other
            || differs(self.least.g, self.most.g, 1.0)
            || differs(self.least.r, self.most.r, CONTRAST_OF_RED)
            || differs(self.least.b, self.most.b, CONTRAST_OF_BLUE)
    }
}

impl<'m, R: Real, S: Geometry + 'm> Renderer<'_, 'm, R, S> {
    /// The pixel in this column and line.
    pub(super) fn pixel_at(&self, x: u16, y: u16) -> Pixel<R> {
        Pixel { x, y, row: self.centers(y) }
    }

    /// The rays through the centers of a line's pixels.
    pub(super) fn centers(&self, y: u16) -> RayRow<R> {
        self.viewport.row((y, CENTER))
    }

    /// The light that a pixel receives, and the rays that it took. `sight` is what is known of its camera
    /// rays.
    pub(super) fn light_at(
        &self,
        pixel: Pixel<R>,
        sight: Sight<'_>,
        probe: &mut impl Probe<R>,
    ) -> (LinearRgb<R>, u32) {
        self.light_in(self.scene, &self.limits, pixel, sight, probe)
    }

    /// As [`light_at`](Self::light_at), in another scene and with other limits.
    // For `classic` on an M4F, 610 instructions a pixel; without it, 625.
    #[inline(always)]
    pub(super) fn light_in(
        &self,
        scene: &PreparedScene<'m, R, S>,
        limits: &RayLimits<R>,
        Pixel { x, y, row }: Pixel<R>,
        sight: Sight<'_>,
        probe: &mut impl Probe<R>,
    ) -> (LinearRgb<R>, u32) {
        let has_one = self.settings.sampling.samples <= 1;
        let rays_per_pixel = self.settings.rays_per_pixel;
        let sample = PixelSample { sampling: self.settings.sampling, x, y, index: 0 };
        let mut rays = SampleRays { left: RayBudget(rays_per_pixel), seen: Seen::NOTHING, sample };
        let mut samples = Samples { light: LinearRgb::BLACK, taken: 0, spread: None };
        let (mut across, mut row) = (self.viewport.across((x, CENTER)), row);
        if !has_one {
            (across, row) = self.sample_place(&rays.sample);
        }
        loop {
            let ray = match scene.lens() {
                Some(lens) => self.ray_from_lens(across, row, lens, &rays.sample),
                None => self.viewport.ray(across, row),
            };
            let shown = radiance(scene, ray, sight, limits, &mut rays, probe);
            if has_one {
                return (shown, rays_per_pixel.saturating_sub(rays.left.0));
            }
            if !self.add_sample(&mut samples, shown, rays.seen) {
                return (samples.light, rays_per_pixel.saturating_sub(rays.left.0));
            }
            rays.sample.index = samples.taken;
            (across, row) = self.sample_place(&rays.sample);
        }
    }

    /// The place of one of several samples of a pixel: its distance from the picture's left side, and its
    /// row.
    #[inline(never)]
    fn sample_place(&self, sample: &PixelSample) -> (R, RayRow<R>) {
        let [right, down] = sample.place();
        (self.viewport.across((sample.x, right)), self.viewport.row((sample.y, down)))
    }

    /// The ray of a sample that begins at its place on the lens.
    fn ray_from_lens(
        &self,
        across: R,
        row: RayRow<R>,
        lens: &PreparedLens<R>,
        sample: &PixelSample,
    ) -> Ray<R> {
        let place = lens.place(sample.pair(Dimension::LENS));
        self.viewport.ray_from_lens(across, row, lens, place)
    }

    /// Adds the light of one of several samples. Returns whether the pixel needs another one; if not, the sum
    /// becomes the mean.
    #[inline(never)]
    fn add_sample(&self, samples: &mut Samples<R>, light: LinearRgb<R>, seen: Seen) -> bool {
        let Sampling { samples: most, adaptive, .. } = self.settings.sampling;
        let first = adaptive.filter(|_| cfg!(feature = "distributed"));
        let Adaptive { at_first, contrast } = first.unwrap_or(Adaptive { at_first: most, contrast: 0.0 });
        let [first_weight, weight] = self.sample_weights;
        // In fixed point, the sum of many samples may overflow where their mean does not.
        let weighs_first = R::IS_FIXED_POINT;
        let at_hand = if samples.taken < at_first { first_weight } else { weight };
        samples.light = samples.light + if weighs_first { light.scaled(at_hand) } else { light };
        samples.taken = samples.taken.saturating_add(1);
        if first.is_some() && samples.taken <= at_first {
            match &mut samples.spread {
                Some(spread) => spread.add(light, seen),
                none => *none = Some(Spread::new(light, seen)),
            }
        }
        let mut ends = samples.taken >= most;
        if !ends && samples.taken == at_first {
            ends = !samples.spread.is_some_and(|spread| spread.needs_more(contrast));
            if weighs_first && !ends {
                samples.light = samples.light.scaled(self.first_share);
            }
        }
        if ends && !weighs_first {
            samples.light = samples.light.scaled(at_hand);
        }
        !ends
    }
}
