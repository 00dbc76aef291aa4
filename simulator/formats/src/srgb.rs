//! The codes of sRGB (IEC 61966-2-1) and linear light.

use rayline::Encoding;

/// The linear light of a code.
pub fn light(code: u8) -> f32 {
    light_of_share(f32::from(code) / 255.0)
}

/// The linear light of a code that is given as a share of the largest.
pub(crate) fn light_of_share(share: f32) -> f32 {
    if share <= 0.040_45 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
}

/// The code of linear light.
pub fn code(light: f32) -> u8 {
    byte(if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 })
}

/// A share from 0 to 1 as a byte.
pub(crate) fn byte(share: f32) -> u8 {
    // The cast saturates.
    (share * 255.0).round() as u8
}

/// A table from codes to the codes of their light multiplied by a factor.
pub(crate) struct Codes(Vec<u8>);

impl Codes {
    /// The table of sRGB for a factor from 0 to 1.
    pub(crate) fn new(factor: f32) -> Self {
        if factor < 1.0 { Self::encoded(Encoding::Srgb, factor) } else { Self((0..=u8::MAX).collect()) }
    }

    /// The table of an encoding for any factor. What becomes brighter than white is white.
    pub(crate) fn encoded(encoding: Encoding, factor: f32) -> Self {
        let multiplied = |code| match encoding {
            Encoding::Srgb => self::code(light(code) * factor),
            Encoding::Linear => byte(f32::from(code) / 255.0 * factor),
        };
        Self((0..=u8::MAX).map(multiplied).collect())
    }

    /// The code of the light of this code, multiplied.
    pub(crate) fn of(&self, code: u8) -> u8 {
        self.0.get(usize::from(code)).copied().unwrap_or(code)
    }
}
