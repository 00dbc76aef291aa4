//! Gooch's tones: cool on the side turned away from the light, warm on the side turned to it.
//!
//! The tones cannot be computed from the light of a pixel. On the side turned away, a pixel has ambient light
//! alone, but the form shows only by the angle between normal and lamp. So the tones replace ambient and
//! diffuse light at a hit. As in drawings, there are no shadows, and no shadow rays are traced.

use super::Trace;
use super::shaded_hit::{FacingLight, LampLight, ShadedHit, ShadowRays};
use crate::color::LinearRgb;
use crate::light::PreparedLight;
use crate::math::{Real, Vec3};
use crate::probe::{Cut, Event, Probe};
use crate::shape::Geometry;
use crate::throughput::Throughput;

/// Tones from cool to warm, as in technical drawings (Gooch, Gooch, Shirley and Cohen, "A Non-Photorealistic
/// Lighting Model for Automatic Technical Illustration", SIGGRAPH 1998).
///
/// With the cosine c between normal and lamp, from -1 behind the surface to 1, and the color k of the
/// surface, the tone is `w · (yellow + warm · k) + (1 - w) · (blue + cool · k)`, where w = (1 + c) / 2: eq. 2
/// of the paper, in linear light. It takes the place of ambient and diffuse light, by the sum of their
/// coefficients. Of several lamps, c is the mean, weighed by their brightest channel without falloff and
/// cones; where a scene has none but [`Light::Ambient`](crate::Light::Ambient) and
/// [`Light::Sky`](crate::Light::Sky), the lamp is in the eye. There are no shadows. Highlights, mirrors,
/// glass and emitted light are as ever.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Gooch {
    /// Blue light of the cool tone, 0 to 1.
    pub blue: f32,
    /// Red and green light of the warm tone, 0 to 1.
    pub yellow: f32,
    /// The share of the surface's color in the cool tone, 0 to 1.
    pub cool: f32,
    /// The share of the surface's color in the warm tone, 0 to 1.
    pub warm: f32,
}

impl Gooch {
    /// As the paper's pictures. Its 0.4 of blue and yellow is a code of displays: 0.13 of light.
    pub const NEW: Self = Self { blue: 0.25, yellow: 0.13, cool: 0.1, warm: 0.7 };

    /// Whether all numbers are in range.
    pub(crate) fn is_valid(&self) -> bool {
        let Self { blue, yellow, cool, warm } = *self;
        [blue, yellow, cool, warm].iter().all(|share| (0.0..=1.0).contains(share))
    }
}

/// [`Gooch::NEW`].
impl Default for Gooch {
    fn default() -> Self {
        Self::NEW
    }
}

/// The sum of the cosines of lamps, each times the weight of the lamp, and the sum of the weights.
struct Facing<R> {
    cosines: R,
    weights: R,
}

impl<R: Real> ShadedHit<'_, R> {
    /// The light of lamps without a size and ambient light; or the tone that takes the place of all light.
    #[inline]
    pub(super) fn light_or_tone<S: Geometry, P: Probe<R>>(
        &self,
        trace: &mut Trace<'_, '_, R, S, P>,
        shadow_rays: &mut impl ShadowRays<R>,
    ) -> LinearRgb<R> {
        match trace.limits.gooch {
            Some(gooch) => self.gooch_light(&gooch, trace),
            None => self.local_light(trace, shadow_rays),
        }
    }

    /// The tone of the hit, highlights and emitted light.
    fn gooch_light<S: Geometry, P: Probe<R>>(
        &self,
        gooch: &Gooch,
        trace: &mut Trace<'_, '_, R, S, P>,
    ) -> LinearRgb<R> {
        let share = (self.material.ambient + self.material.diffuse).smaller(R::ONE);
        let mut sum = Facing { cosines: R::ZERO, weights: R::ZERO };
        let mut lamps = LampLight::NONE;
        for (index, light) in trace.scene.lights.iter().enumerate() {
            if light.comes_from_all_around() {
                continue;
            }
            let around = self.lamp_around(light);
            sum.add(around.map_or(R::ZERO, |(_, _, cosine)| cosine), light.color);
            if let Some(around) = around {
                self.add_highlight((index, light.color), around, &mut lamps, trace);
            }
        }
        #[cfg(feature = "distributed")]
        for area in trace.scene.areas() {
            if area.object != self.hit.object
                && let Some(toward) = (area.center() - self.hit.surface.point).normalized()
            {
                sum.add(self.normal.dot(toward), area.radiance);
            }
        }
        let cosine =
            if sum.weights > R::ZERO { sum.cosines / sum.weights } else { -self.normal.dot(self.incoming) };
        let tone = self.tone(gooch, cosine) * share + self.emission();
        trace.probe.record(Event::Surface { shown: tone });
        self.reflected_light(tone, lamps)
    }

    /// The unit vector to a lamp in front of the surface or behind it, its distance, and the cosine with the
    /// normal, which is negative behind; `None` for one at the horizon.
    fn lamp_around(&self, light: &PreparedLight<'_, R>) -> Option<(Vec3<R>, R, R)> {
        let point = self.hit.surface.point;
        let behind = || {
            let (toward, distance, cosine) = light.seen_from(point, -self.normal)?;
            Some((toward, distance, -cosine))
        };
        light.seen_from(point, self.normal).or_else(behind)
    }

    /// Adds the highlight of a lamp, with the event that realtime quality finds small highlights by.
    fn add_highlight<S: Geometry, P: Probe<R>>(
        &self,
        (index, color): (usize, LinearRgb<R>),
        (toward, distance, cosine): (Vec3<R>, R, R),
        lamps: &mut LampLight<R>,
        trace: &mut Trace<'_, '_, R, S, P>,
    ) {
        if !(cosine > R::ZERO && self.material.specular > R::ZERO) {
            return;
        }
        // The event reports a shadow ray, and each reported ray is one of the budget.
        if !trace.rays.spend() {
            trace.probe.record(Event::Cut(Cut::Rays));
            return;
        }
        let highlight_cosine = self.highlight_cosine(toward);
        // The tone has the diffuse light.
        let facing = FacingLight { toward, distance, cosine: R::ZERO, highlight_cosine, share: None };
        let highlight = lamps.add(&facing, self.material, color, Throughput::even(R::ONE));
        let shown = self.lit(color, R::ZERO, highlight);
        trace.probe.record(Event::Light { light: index, toward, through: R::ONE, shown });
    }

    /// The tone at a cosine from -1 to 1.
    fn tone(&self, gooch: &Gooch, cosine: R) -> LinearRgb<R> {
        let (color, number) = (self.color, R::from_f32);
        let half = R::from_fraction(1 << 15);
        let warmth = (cosine * half + half).larger(R::ZERO).smaller(R::ONE);
        let LinearRgb { r, g, b } = color * number(gooch.warm);
        let warm = LinearRgb::new(r + number(gooch.yellow), g + number(gooch.yellow), b);
        let LinearRgb { r, g, b } = color * number(gooch.cool);
        let cool = LinearRgb::new(r, g, b + number(gooch.blue));
        warm * warmth + cool * (R::ONE - warmth)
    }
}

impl<R: Real> Facing<R> {
    fn add(&mut self, cosine: R, LinearRgb { r, g, b }: LinearRgb<R>) {
        // Only the ratio of two lamps counts: small weights keep the sums of 2048 lamps in the range of fixed
        // point.
        let weight = r.larger(g).larger(b).smaller(R::from_f32(4.0)) * R::from_f32(1.0 / 64.0);
        self.cosines = self.cosines + cosine * weight;
        self.weights = self.weights + weight;
    }
}
