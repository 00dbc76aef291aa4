//! One pixel: its samples, and their mean.

use super::pixel_sum::PixelSum;
#[cfg(feature = "looks")]
use super::toon::toned;
use super::{Renderer, Settings};
use crate::camera::RayRow;
use crate::color::LinearRgb;
use crate::integrator::{RayBudget, RayLimits, SampleRays, Seen, Sight, radiance};
use crate::math::{Ray, Real};
use crate::prepared::PreparedScene;
use crate::probe::Probe;
#[cfg(feature = "distributed")]
use crate::sampling::Dimension;
use crate::sampling::{Adaptive, CENTER, PixelSample, RayNumbers, Sampling};
use crate::shape::Geometry;

/// A pixel, with the row of rays that its aim needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel<R> {
    pub(super) x: u16,
    pub(super) y: u16,
    pub(super) row: RayRow<R>,
    pub(super) aim: Aim,
}

/// The place in a pixel to which its rays go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Aim {
    /// A single ray to the center, or several all over the pixel.
    Area,
    /// All rays to the upper left corner: one, or several if they draw other numbers. Needs the feature
    /// `distributed`.
    Corner,
}

impl Aim {
    /// Whether rays go to the corner. Without the feature `distributed`, this is a constant `false`.
    const fn is_corner(self) -> bool {
        cfg!(feature = "distributed") && matches!(self, Self::Corner)
    }

    /// The place of a single ray, in 65536ths of a pixel from the left and the upper side.
    pub(super) const fn place(self) -> i32 {
        if self.is_corner() { 0 } else { CENTER }
    }
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
    /// The share of each of the first samples, if no other ones follow.
    weight: R,
    least: LinearRgb<R>,
    most: LinearRgb<R>,
    /// The digest of the first sample.
    seen: Seen,
    /// Whether another sample has another digest.
    saw_other: bool,
}

/// The contrast of red and blue light at which samples differ, over that of green light (Mitchell, 1987).
const CONTRAST_OF_RED: f32 = 4.0 / 3.0;
const CONTRAST_OF_BLUE: f32 = 2.0;
/// Light that differs by less than this is the same on all displays.
const INVISIBLE: f32 = 1.0 / 2048.0;

impl<R: Real> Spread<R> {
    /// Of the first of `count` samples.
    fn new(count: u16, light: LinearRgb<R>, seen: Seen) -> Self {
        let weight = R::from_setup(R::Setup::from_u16(count).recip());
        Self { weight, least: light, most: light, seen, saw_other: false }
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
        Pixel { x, y, row: self.row(y, Aim::Area), aim: Aim::Area }
    }

    /// The rays of a line's pixels.
    pub(super) fn row(&self, y: u16, aim: Aim) -> RayRow<R> {
        self.viewport.row((y, aim.place()))
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
    // Forced: without it, `classic` takes an M4F 1.02 times the instructions.
    #[inline(always)]
    pub(super) fn light_in(
        &self,
        scene: &PreparedScene<'m, R, S>,
        limits: &RayLimits<R>,
        Pixel { x, y, row, aim }: Pixel<R>,
        sight: Sight<'_>,
        probe: &mut impl Probe<R>,
    ) -> (LinearRgb<R>, u32) {
        let has_one = self.settings.sampling.samples <= 1 || (aim.is_corner() && !self.is_distributed);
        let rays_per_pixel = self.settings.rays_per_pixel;
        let mut numbers = RayNumbers::of(self.sample((x, y), 0));
        let (left, seen) = (RayBudget(rays_per_pixel), Seen::NOTHING);
        let mut rays = SampleRays { left, seen };
        let mut samples = Samples { light: LinearRgb::BLACK, taken: 0, spread: None };
        let (mut across, mut row) = (self.viewport.across((x, aim.place())), row);
        if !(has_one || aim.is_corner()) {
            (across, row) = self.sample_place((x, y), 0);
        }
        loop {
            let shown = self.trace_sample((scene, limits), (across, row, numbers), sight, &mut rays, probe);
            if has_one {
                return (shown, rays_per_pixel.saturating_sub(rays.left.0));
            }
            if !self.add_sample(&mut samples, shown, rays.seen) {
                return (samples.light, rays_per_pixel.saturating_sub(rays.left.0));
            }
            numbers = RayNumbers::of(self.sample((x, y), samples.taken));
            if !aim.is_corner() {
                (across, row) = self.sample_place((x, y), samples.taken);
            }
        }
    }

    /// The light of one sample: of the ray through a place in the picture, with these numbers.
    #[inline]
    fn trace_sample(
        &self,
        (scene, limits): (&PreparedScene<'m, R, S>, &RayLimits<R>),
        (across, row, numbers): (R, RayRow<R>, RayNumbers),
        sight: Sight<'_>,
        rays: &mut SampleRays,
        probe: &mut impl Probe<R>,
    ) -> LinearRgb<R> {
        let ray = self.viewport.ray(across, row, &numbers);
        #[cfg(feature = "distributed")]
        let moment;
        #[cfg(feature = "distributed")]
        let (scene, ray) = if scene.moves() {
            let [time, _] = numbers.pair(Dimension::TIME);
            moment = scene.at(R::from_fraction(time));
            (&moment, moment.moved_by_camera(ray))
        } else {
            (scene, ray)
        };
        self.toned(radiance(scene, (ray, numbers), sight, limits, rays, probe))
    }

    /// The light of one sample in the tones of the picture's look.
    #[inline]
    pub(super) fn toned(&self, light: LinearRgb<R>) -> LinearRgb<R> {
        #[cfg(feature = "looks")]
        let light = toned(self.settings.look.tones, light);
        light
    }

    /// The light that comes to the origin of any ray, with the numbers of one sample of pixel (x, y). The
    /// direction is a unit vector; a unit of the scene is [`PreparedScene::scale`] units of the ray. Things
    /// that move are where they are when the shutter opens.
    pub fn light_along(&self, ray: &Ray<R>, place: (u16, u16), sample: u16) -> LinearRgb<R> {
        self.light_along_watched(ray, place, sample, &mut ())
    }

    /// [`light_along`](Self::light_along), with a probe that records the events on the way. The rays serve
    /// for light in either direction: they are also the rays of a photon that leaves the origin, and their
    /// throughput is the share of the photon's flux.
    pub fn light_along_watched(
        &self,
        ray: &Ray<R>,
        place: (u16, u16),
        sample: u16,
        probe: &mut impl Probe<R>,
    ) -> LinearRgb<R> {
        let (left, seen) = (RayBudget(self.settings.rays_per_pixel), Seen::NOTHING);
        let numbers = RayNumbers::of(self.sample(place, sample));
        let (sight, mut rays) = (Sight::among(self.scene.all()), SampleRays { left, seen });
        radiance(self.scene, (*ray, numbers), sight, &self.limits, &mut rays, probe)
    }

    /// Adds one sample to a pixel's sum, and at the beginning the first samples of adaptive sampling. Returns
    /// the mean of the samples.
    pub(super) fn refined(
        &self,
        pixel: Pixel<R>,
        sum: &mut PixelSum<R>,
        probe: &mut impl Probe<R>,
    ) -> LinearRgb<R> {
        let Settings { sampling: Sampling { samples: most, adaptive, .. }, rays_per_pixel, .. } =
            self.settings;
        let (sight, place) = (Sight::among(self.scene.all()), (pixel.x, pixel.y));
        if most <= 1 && !sum.is_complete {
            (sum.light, sum.rays) = self.light_at(pixel, sight, probe);
            (sum.taken, sum.is_complete) = (1, true);
        }
        let left = RayBudget(rays_per_pixel.saturating_sub(sum.rays));
        let mut rays = SampleRays { left, seen: Seen::NOTHING };
        let mut samples = Samples { light: sum.light, taken: sum.taken, spread: None };
        while !sum.is_complete {
            let numbers = RayNumbers::of(self.sample(place, samples.taken));
            let (across, row) = self.sample_place(place, samples.taken);
            let sample = (across, row, numbers);
            let shown = self.trace_sample((self.scene, &self.limits), sample, sight, &mut rays, probe);
            sum.is_complete = !self.add_sample(&mut samples, shown, rays.seen);
            sum.rays = rays_per_pixel.saturating_sub(rays.left.0);
            if adaptive.is_none_or(|Adaptive { at_first, .. }| samples.taken >= at_first) {
                break;
            }
        }
        (sum.light, sum.taken) = (samples.light, samples.taken);
        if sum.is_complete {
            return sum.light;
        }
        // Where samples are weighed at once, the sum lacks those that are still to come.
        let whole = if R::IS_FIXED_POINT { R::Setup::from_u16(most) } else { R::Setup::ONE };
        let share = whole / R::Setup::from_u16(sum.taken.max(1));
        let LinearRgb { r, g, b } = sum.light;
        let [r, g, b] = [r, g, b].map(|channel| R::from_setup(channel.to_setup() * share));
        LinearRgb::new(r, g, b)
    }

    /// The place of one of several samples of a pixel: its distance from the picture's left side, and its
    /// row.
    #[inline(never)]
    fn sample_place(&self, (x, y): (u16, u16), index: u16) -> (R, RayRow<R>) {
        let [right, down] = self.sample((x, y), index).place();
        (self.viewport.across((x, right)), self.viewport.row((y, down)))
    }

    pub(super) fn sample(&self, (x, y): (u16, u16), index: u16) -> PixelSample {
        PixelSample { sampling: self.settings.sampling, x, y, index }
    }

    /// Adds the light of one of several samples. Returns whether the pixel needs another one; if not, the sum
    /// becomes the mean.
    #[inline(never)]
    fn add_sample(&self, samples: &mut Samples<R>, light: LinearRgb<R>, seen: Seen) -> bool {
        let Sampling { samples: most, adaptive, .. } = self.settings.sampling;
        let mut weight = self.sample_weight;
        let first =
            adaptive.filter(|adaptive| cfg!(feature = "distributed") && samples.taken < adaptive.at_first);
        if let Some(Adaptive { at_first, .. }) = first {
            let spread = samples.spread.get_or_insert_with(|| Spread::new(at_first, light, seen));
            spread.add(light, seen);
            weight = spread.weight;
        }
        // In fixed point, the sum of many samples may overflow where their mean does not.
        let weighs_first = R::IS_FIXED_POINT;
        samples.light = samples.light + if weighs_first { light.scaled(weight) } else { light };
        samples.taken = samples.taken.saturating_add(1);
        let mut ends = samples.taken >= most;
        if let Some(Adaptive { at_first, contrast }) = first
            && samples.taken == at_first
            && !ends
        {
            ends = !samples.spread.is_some_and(|spread| spread.needs_more(contrast));
            if weighs_first && !ends {
                let share = R::Setup::from_u16(at_first) / R::Setup::from_u16(most);
                samples.light = samples.light.scaled(R::from_setup(share));
            }
        }
        if ends && !weighs_first {
            samples.light = samples.light.scaled(weight);
        }
        !ends
    }
}
