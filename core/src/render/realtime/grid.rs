//! The grid of pixels that are traced first.

/// The distance of the pixels that are traced first: all but those around which no object can be seen, and
/// those that a budget leaves out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Grid {
    /// Every second pixel of every second line.
    Two,
    /// Every fourth pixel of every fourth line.
    Four,
    /// Every eighth pixel of every eighth line.
    Eight,
}

impl Grid {
    /// The distance in pixels.
    pub const fn pixels(self) -> usize {
        match self {
            Self::Two => 2,
            Self::Four => 4,
            Self::Eight => 8,
        }
    }
}

/// The column or line at a distance from the first one of a cell. The grid ends beyond the picture: such
/// pixels are defined too.
pub(super) fn beyond(first: u32, distance: usize) -> u16 {
    u16::try_from(first + distance as u32).unwrap_or(u16::MAX)
}

/// The largest size of a cell: of a side, in pixels. A cell is the square between four neighbors on the grid.
pub(super) const LARGEST_SIZE: usize = 8;

/// The size of the squares that the inside of a cell is drawn in, in pixels.
pub(super) const SQUARE: usize = 4;
