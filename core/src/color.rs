//! Colors as amounts of linear light, not as display codes.

use core::ops::{Add, Mul};

use crate::fault::{Fault, check_held, check_number};
use crate::math::Real;

/// Linear light or reflectivity in three channels, with the primaries of sRGB.
///
/// Light has no upper bound; a reflectivity lies in 0..=1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearRgb<R = f32> {
    /// Red.
    pub r: R,
    /// Green.
    pub g: R,
    /// Blue.
    pub b: R,
}

#[cfg(feature = "serde")]
crate::math::triple!(LinearRgb { r, g, b });
#[cfg(feature = "serde")]
crate::read::plain!(LinearRgb);

impl<R> LinearRgb<R> {
    /// The color (r, g, b).
    pub const fn new(r: R, g: R, b: R) -> Self {
        Self { r, g, b }
    }
}

impl LinearRgb {
    /// White.
    pub const WHITE: Self = Self::gray(1.0);

    /// The color with `value` in all three channels.
    pub const fn gray(value: f32) -> Self {
        Self::new(value, value, value)
    }

    /// Red, green and blue.
    pub const fn channels(self) -> [f32; 3] {
        [self.r, self.g, self.b]
    }

    /// The same color in another number system.
    pub fn to<R: Real>(self) -> LinearRgb<R> {
        LinearRgb::new(R::from_f32(self.r), R::from_f32(self.g), R::from_f32(self.b))
    }
}

impl<R: Real> LinearRgb<R> {
    /// No light.
    pub const BLACK: Self = Self::new(R::ZERO, R::ZERO, R::ZERO);

    /// The color in `f32`, rounded to nearest.
    pub fn to_f32(self) -> LinearRgb {
        LinearRgb::new(self.r.to_f32(), self.g.to_f32(), self.b.to_f32())
    }

    /// The color with `value` in all three channels.
    pub(crate) fn even(value: R) -> Self {
        Self::new(value, value, value)
    }

    /// All channels multiplied by a number at full precision, for colors that are summed up afterwards.
    pub(crate) fn scaled(self, by: R) -> Self {
        Self::new(self.r * by, self.g * by, self.b * by)
    }
}

/// Refuses emitted light that is negative, not finite, or too large for the number system. It may be above 1.
pub(crate) fn check_emission<R: Real>(color: LinearRgb) -> Result<(), Fault> {
    for channel in color.channels() {
        check_channel(channel)?;
        check_held::<R>(R::Setup::from_f32(channel))?;
    }
    Ok(())
}

/// Refuses a channel that is negative, not finite, or above
/// [`MAX_COORDINATE`](crate::limits::MAX_COORDINATE).
pub(crate) fn check_channel(channel: f32) -> Result<(), Fault> {
    check_number(channel)?;
    if channel < 0.0 { Err(Fault::NegativeColor { given: channel }) } else { Ok(()) }
}

impl<R: Real> Add for LinearRgb<R> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(
            self.r.add_saturating(other.r),
            self.g.add_saturating(other.g),
            self.b.add_saturating(other.b),
        )
    }
}

/// All channels multiplied by one share, 0 to 1.
impl<R: Real> Mul<R> for LinearRgb<R> {
    type Output = Self;
    fn mul(self, share: R) -> Self {
        Self::new(self.r.attenuated(share), self.g.attenuated(share), self.b.attenuated(share))
    }
}

/// Each channel multiplied by its own share, 0 to 1: light reflected by a surface of color `shares`.
impl<R: Real> Mul for LinearRgb<R> {
    type Output = Self;
    fn mul(self, shares: Self) -> Self {
        let LinearRgb { r, g, b } = shares;
        Self::new(self.r.attenuated(r), self.g.attenuated(g), self.b.attenuated(b))
    }
}
