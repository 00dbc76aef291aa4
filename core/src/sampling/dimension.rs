//! The dimensions of a sample: which numbers it draws for what.
//!
//! | number | dimension |
//! |---|---|
//! | 0 | the place in the pixel |

/// A use of two numbers that a sample draws. Two uses never share numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dimension(u32);

impl Dimension {
    /// The place in the pixel.
    pub(crate) const PIXEL: Self = Self(0);

    /// Its number, which hashes take.
    pub(super) const fn number(self) -> u32 {
        self.0
    }
}
