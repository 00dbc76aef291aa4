//! The share of light that is left on its way.

use core::ops::Mul;

use crate::color::LinearRgb;
use crate::math::Real;

#[cfg(not(feature = "optics"))]
type Channels<R> = R;
#[cfg(feature = "optics")]
type Channels<R> = LinearRgb<R>;

/// The share of light that is left on its way, 0 to 1. It has a color only with the feature `optics`: without, nothing gives it one, and
/// it is one number. Channels are multiplied alike, so that gray light has the same bytes with and without.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share<R>(Channels<R>);

impl<R: Real> Share<R> {
    /// The same in all channels.
    #[inline(always)]
    pub(crate) fn even(share: R) -> Self {
        #[cfg(not(feature = "optics"))]
        return Self(share);
        #[cfg(feature = "optics")]
        Self(LinearRgb::even(share))
    }

    /// A share of its own in each channel. To be had only with the feature.
    #[inline(always)]
    pub(crate) fn colored(color: LinearRgb<R>) -> Self {
        #[cfg(not(feature = "optics"))]
        return Self(color.r);
        #[cfg(feature = "optics")]
        Self(color)
    }

    /// The channels.
    pub(crate) fn color(self) -> LinearRgb<R> {
        #[cfg(not(feature = "optics"))]
        return LinearRgb::even(self.0);
        #[cfg(feature = "optics")]
        self.0
    }

    /// The largest of the channels.
    #[inline(always)]
    pub(crate) fn largest(self) -> R {
        #[cfg(not(feature = "optics"))]
        return self.0;
        #[cfg(feature = "optics")]
        self.0.r.larger(self.0.g).larger(self.0.b)
    }

    /// This share of light.
    #[inline(always)]
    pub(crate) fn of(self, light: LinearRgb<R>) -> LinearRgb<R> {
        light * self.0
    }

    /// The same of light that may well be gray.
    #[inline(always)]
    pub(crate) fn of_gray(self, light: LinearRgb<R>) -> LinearRgb<R> {
        if R::IS_FIXED_POINT && !cfg!(feature = "optics") && light.g == light.r && light.b == light.r {
            return LinearRgb::even((light * self.0).r);
        }
        self.of(light)
    }
}

impl<R: Real> Mul<R> for Share<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, share: R) -> Self {
        #[cfg(not(feature = "optics"))]
        return Self(self.0.attenuated(share));
        #[cfg(feature = "optics")]
        Self(self.0 * share)
    }
}

impl<R: Real> Mul for Share<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, share: Self) -> Self {
        #[cfg(not(feature = "optics"))]
        return Self(self.0.attenuated(share.0));
        #[cfg(feature = "optics")]
        Self(self.0 * share.0)
    }
}
