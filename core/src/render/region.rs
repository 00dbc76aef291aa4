//! The region of a picture that is drawn.

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;

/// A rectangle of pixels of the picture: the columns `left..right` of the lines `top..bottom`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    pub(super) left: u32,
    pub(super) right: u32,
    pub(super) top: u32,
    pub(super) bottom: u32,
}

impl Region {
    /// A whole picture of this size.
    pub(super) fn whole(width: u16, height: u16) -> Self {
        Self { left: 0, right: width.into(), top: 0, bottom: height.into() }
    }

    /// The region of this one that lies on a display with this bounding box. The picture's upper left corner
    /// is at (0, 0).
    pub(super) fn shown_in(self, display: &Rectangle) -> Self {
        let Rectangle { top_left, size } = display;
        let (left, right) = common((self.left, self.right), top_left.x, size.width);
        let (top, bottom) = common((self.top, self.bottom), top_left.y, size.height);
        Self { left, right, top, bottom }
    }

    pub(super) fn width(&self) -> u32 {
        self.right.saturating_sub(self.left)
    }

    pub(super) fn height(&self) -> u32 {
        self.bottom.saturating_sub(self.top)
    }

    /// The pixels in the terms of embedded-graphics.
    pub(super) fn area(&self) -> Rectangle {
        let corner = Point::new(self.left as i32, self.top as i32);
        Rectangle::new(corner, Size::new(self.width(), self.height()))
    }

    /// Column and line of a pixel, which lies so many columns to the right of the upper left one, and so many
    /// lines below it.
    pub(super) fn pixel(&self, right: usize, down: usize) -> (u16, u16) {
        ((self.left as u16).wrapping_add(right as u16), (self.top as u16).wrapping_add(down as u16))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.left >= self.right || self.top >= self.bottom
    }
}

/// The places of `start..end` that are also among the `length` places from `other` on.
fn common((start, end): (u32, u32), other: i32, length: u32) -> (u32, u32) {
    let other_end = other.saturating_add_unsigned(length).max(0) as u32;
    (start.max(other.max(0) as u32), end.min(other_end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_part_shown_lies_in_picture_and_display() {
        let whole = Region::whole(40, 30);
        let shown = |x, y, width, height| {
            let region = whole.shown_in(&Rectangle::new(Point::new(x, y), Size::new(width, height)));
            (!region.is_empty()).then_some((region.left, region.right, region.top, region.bottom))
        };
        assert_eq!(shown(0, 0, 40, 30), Some((0, 40, 0, 30)));
        assert_eq!(shown(0, 0, 320, 240), Some((0, 40, 0, 30)));
        assert_eq!(shown(0, 0, 16, 240), Some((0, 16, 0, 30)));
        assert_eq!(shown(-7, -5, 16, 16), Some((0, 9, 0, 11)));
        assert_eq!(shown(7, 5, 16, 16), Some((7, 23, 5, 21)));
        assert_eq!(shown(i32::MIN, -5, u32::MAX, u32::MAX), Some((0, 40, 0, 30)));
        assert_eq!(shown(39, 29, u32::MAX, u32::MAX), Some((39, 40, 29, 30)));
        for (x, y, width, height) in
            [(0, 0, 0, 30), (0, 0, 40, 0), (40, 0, 9, 9), (0, 30, 9, 9), (-9, 0, 9, 9), (i32::MAX, 0, 9, 9)]
        {
            assert_eq!(shown(x, y, width, height), None, "{x}, {y}, {width}x{height}");
        }
    }
}
