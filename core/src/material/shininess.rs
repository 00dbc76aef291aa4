//! The exponent of a highlight, and powers with that exponent.

use crate::math::{Real, Vec3, power};

/// The exponent of a highlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shininess<R: Real> {
    /// The cosine whose power is [`Self::INVISIBLE`]: highlights at smaller cosines are invisible.
    least: R,
    exponent: R::Factor,
}

impl<R: Real> Shininess<R> {
    /// 2⁻²⁴: a highlight that is far below the finest level of any display. It counts as none, so that no
    /// shadow ray is traced for it.
    const INVISIBLE: f32 = 1.0 / 16_777_216.0;

    /// Prepares an exponent, 0 or more.
    pub(crate) fn new(shininess: f32) -> Self {
        // For exponents below 1/5 the power would leave the range of f32, and no cosine is invisible.
        let least = if shininess > 0.2 { power::powf(Self::INVISIBLE, 1.0 / shininess) } else { 0.0 };
        Self { least: R::from_f32(least), exponent: R::factor(shininess) }
    }

    /// Whether the highlight is a small spot that few pixels show.
    pub(crate) fn is_sharp(&self) -> bool {
        self.least > R::from_f32(0.85)
    }

    /// The cosine below which a highlight is invisible.
    pub(crate) fn least(&self) -> R {
        self.least
    }

    /// Whether a highlight can be seen at this cosine.
    #[inline]
    pub(crate) fn is_visible(&self, cosine: R) -> bool {
        cosine > self.least
    }

    /// Whether a highlight may be visible between these unit vectors. The test is against a bound of their
    /// cosine, and may be true for an invisible highlight.
    #[inline]
    pub(crate) fn may_be_visible(&self, mirrored: Vec3<R>, toward: Vec3<R>) -> bool {
        let (_, most) = mirrored.dot_bounds(toward);
        self.is_visible(most)
    }

    /// Whether a cosine lies within this share of a small highlight's visible range of cosines. At a share of
    /// 1 the highlight has 2⁻²⁴ of its strength, at 1/4 about the fourth root of that, 2⁻⁶.
    pub(crate) fn shows(&self, cosine: R, share: R) -> bool {
        // Near 1, the logarithm of a cosine is nearly proportional to 1 - cosine.
        R::ONE - cosine < (R::ONE - self.least) * share
    }

    /// The power of a cosine; 0 where the highlight is invisible.
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
