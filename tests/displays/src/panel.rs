//! The pixels that a panel shows.

use embedded_graphics::geometry::{Point, Size};

/// The pixels of a panel, as somebody sees them who looks at the unturned glass, and how they got there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Panel {
    /// Width and height of the glass.
    pub size: Size,
    /// The codes of the pixels, line by line; none where nothing was ever written.
    pub codes: Vec<Option<u32>>,
    /// The number of windows, pages or messages in which the codes arrived.
    pub windows: usize,
}

impl Panel {
    /// A panel to which nothing was written.
    pub fn blank(size: Size) -> Self {
        Self { size, codes: vec![None; (size.width * size.height) as usize], windows: 0 }
    }

    /// The pixel's place in `codes`.
    fn index(&self, at: Point) -> usize {
        let Size { width, height } = self.size;
        assert!((0..width as i32).contains(&at.x) && (0..height as i32).contains(&at.y), "{at} is no pixel");
        at.y as usize * width as usize + at.x as usize
    }

    /// The code of a pixel.
    pub fn code(&self, at: Point) -> Option<u32> {
        self.codes[self.index(at)]
    }

    /// Writes the code of a pixel.
    pub fn write(&mut self, at: Point, code: u32) {
        let index = self.index(at);
        self.codes[index] = Some(code);
    }
}

/// How a driver turns pictures on the glass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Turn {
    /// Quarter turns, clockwise.
    pub quarters: u8,
    /// Whether left and right of the glass are then swapped.
    pub is_mirrored: bool,
}

impl Turn {
    /// Not turned.
    pub const NONE: Self = Self::by(0);

    /// All eight turns.
    pub fn all() -> impl Iterator<Item = Self> {
        let by_quarters = |is_mirrored| (0..4).map(move |quarters| Self { quarters, is_mirrored });
        [false, true].into_iter().flat_map(by_quarters)
    }

    /// Turned by this many quarters, clockwise.
    pub const fn by(quarters: u8) -> Self {
        Self { quarters, is_mirrored: false }
    }

    /// The size, after the turn, of a display with this glass.
    pub fn size(self, glass: Size) -> Size {
        if self.quarters.is_multiple_of(2) { glass } else { Size::new(glass.height, glass.width) }
    }

    /// The place on the glass at which a pixel of the display is seen.
    pub fn place(self, pixel: Point, glass: Size) -> Point {
        let (right, bottom) = (glass.width as i32 - 1, glass.height as i32 - 1);
        let Point { x, y } = pixel;
        let place = match self.quarters {
            0 => pixel,
            1 => Point::new(right - y, x),
            2 => Point::new(right - x, bottom - y),
            _ => Point::new(y, bottom - x),
        };
        if self.is_mirrored { Point::new(right - place.x, place.y) } else { place }
    }
}
