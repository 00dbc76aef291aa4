//! The exponent of a highlight, and its powers.

use crate::math::{Real, Vec3, power};

/// The exponent of a highlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shininess<R: Real> {
    /// A cosine below this has a power below [`Self::INVISIBLE`].
    least: R,
    exponent: R::Factor,
}

impl<R: Real> Shininess<R> {
    /// 2⁻²⁴: a highlight so weak is far below the finest level of any display. It counts as none, so that no
    /// shadow ray is spent on it.
    const INVISIBLE: f32 = 1.0 / 16_777_216.0;

    /// The exponent 0 or more.
    pub(crate) fn new(shininess: f32) -> Self {
        // Of exponents below 1/5, not even this power leaves the range of f32.
        let least = if shininess > 0.2 { power::powf(Self::INVISIBLE, 1.0 / shininess) } else { 0.0 };
        Self { least: R::from_f32(least), exponent: R::factor(shininess) }
    }

    /// The cosine at which a highlight fades out.
    pub(crate) fn least(&self) -> R {
        self.least
    }

    /// Whether a highlight is so small that few pixels show it.
    pub(crate) fn is_sharp(&self) -> bool {
        self.least > R::from_f32(0.85)
    }

    /// Whether a highlight can be seen at this cosine.
    #[inline]
    pub(crate) fn is_visible(&self, cosine: R) -> bool {
        cosine > self.least
    }

    /// `false` if a highlight is surely invisible between these unit vectors: a bound of their cosine may be
    /// faster than the cosine.
    #[inline(always)]
    pub(crate) fn may_be_visible(&self, mirrored: Vec3<R>, toward: Vec3<R>) -> bool {
        let (_, most) = mirrored.dot_bounds(toward);
        self.is_visible(most)
    }

    /// Whether a cosine is within this share of what shows of a small highlight: at 1 it has 2^-24 of its
    /// strength, at 1/4 about the fourth root of that, 2^-6.
    pub(crate) fn shows(&self, cosine: R, share: R) -> bool {
        // Near 1, the logarithm of a cosine is as good as proportional to its distance from there.
        R::ONE - cosine < (R::ONE - self.least) * share
    }

    /// The sine of the angle at which that share [shows](Self::shows).
    pub(crate) fn sine_shown(&self, share: f32) -> R {
        ((R::ONE - self.least) * R::from_f32(2.0 * share)).sqrt()
    }

    /// The power of a cosine; 0 where it is invisible.
    #[inline]
    pub(crate) fn power_of(&self, cosine: R) -> R {
        if !self.is_visible(cosine) {
            return R::ZERO;
        }
        if cosine >= R::ONE {
            return R::ONE;
        }
        cosine.powf(self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn highlights_are_powers_while_they_are_visible() {
        for shininess in [0.0f32, 1.0, 2.0, 3.0827, 10.0, 50.0, 125.0, 1425.0, 100_000.0] {
            let power = Shininess::<f32>::new(shininess);
            for step in 1..=1000u16 {
                let cosine = f32::from(step) / 1000.0;
                let exact = f64::from(cosine).powf(f64::from(shininess));
                let error = (f64::from(power.power_of(cosine)) - exact).abs();
                assert!(error < 2e-7, "{cosine} to the power {shininess} is off by {error:e}");
            }
            for none in [0.0, -0.5, f32::NAN] {
                assert_eq!(power.power_of(none), 0.0);
            }
        }
    }
}
