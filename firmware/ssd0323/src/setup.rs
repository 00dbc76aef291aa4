//! How a panel is connected to its controller.

/// How a panel is connected to its controller, and its first brightness.
///
/// ```
/// use rayline_ssd0323::Setup;
///
/// // A panel whose even rows are connected at one side of the controller, and odd rows at the other.
/// let setup = Setup { splits_rows: true, ..Setup::PLAIN };
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setup {
    /// Whether pairs of columns go from right to left.
    pub mirrors_columns: bool,
    /// Whether the pixels of a pair are the other way round.
    pub swaps_pairs: bool,
    /// Whether rows go from bottom to top.
    pub mirrors_rows: bool,
    /// Whether even rows are connected at one side of the controller, and odd rows at the other.
    pub splits_rows: bool,
    /// Row of the memory that is shown at the top: 0 to 79. The driver draws in rows 0 to 63.
    pub first_row: u8,
    /// Output of the controller, 0 to 79, at which the panel's rows begin.
    pub offset: u8,
    /// Brightness, from 0 to 127; more is taken for 127.
    pub contrast: u8,
}

impl Setup {
    /// Everything in the order of the controller's outputs, at half of the contrast.
    pub const PLAIN: Self = Self {
        mirrors_columns: false,
        swaps_pairs: false,
        mirrors_rows: false,
        splits_rows: false,
        first_row: 0,
        offset: 0,
        contrast: 0x40,
    };

    /// The setup with the picture turned by 180°.
    #[must_use]
    pub const fn turned(self) -> Self {
        Self {
            mirrors_columns: !self.mirrors_columns,
            swaps_pairs: !self.swaps_pairs,
            mirrors_rows: !self.mirrors_rows,
            ..self
        }
    }

    /// The argument of the command that maps the memory to outputs. Data always fills a window along lines.
    pub(crate) const fn map(self) -> u8 {
        self.mirrors_columns as u8
            | (self.swaps_pairs as u8) << 1
            | (self.mirrors_rows as u8) << 4
            | (self.splits_rows as u8) << 6
    }
}

impl Default for Setup {
    /// [`Setup::PLAIN`].
    fn default() -> Self {
        Self::PLAIN
    }
}
