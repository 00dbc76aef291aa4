//! The outline of an object or a shadow: the pixels in which it can be seen, as an ellipse or a rectangle
//! that is found once for a picture.
//!
//! An outline holds all pixels of what it stands for, and some more: it is wider by a hundredth and by a
//! pixel, which is more than all rounding. Outlines are found in floating point by [`silhouette`] and
//! [`conic`]; then each line gets its pixels in integers.

mod conic;
mod silhouette;
#[cfg(test)]
mod tests;

pub(super) use silhouette::{Projector, Vantage};

use super::span::{Span, pixel};
use crate::camera::{Rect, Viewport};
use crate::math::{Aabb, Real};

/// The pixels in which something can be seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outline {
    /// No pixels.
    Nowhere,
    /// All pixels: nothing better is known.
    Everywhere,
    /// The pixels `across` on the lines `top..bottom`.
    Rectangle { across: Span, top: u16, bottom: u16 },
    /// An ellipse.
    Ellipse {
        /// The middle, in 256ths of a pixel.
        x: i32,
        y: i32,
        /// How far the middle of a line moves to the right from each line to the next, in 65536ths of a
        /// pixel.
        slope: i32,
        /// Half the width, in pixels.
        half_width: u16,
        /// 2³¹ over half the height in pixels.
        inverse_half_height: u32,
    },
}

impl Outline {
    /// The outline of a box.
    pub(super) fn of_box<R: Real>(bounds: Aabb<R::Setup>, viewport: &Viewport<R>) -> Self {
        let Some(Rect { left, right, top, bottom }) = viewport.frame(bounds) else { return Self::Everywhere };
        let across = Span { start: pixel(left, -1), end: pixel(right, 2) };
        let (top, bottom) = (pixel(top, -1), pixel(bottom, 2));
        Self::Rectangle { across, top, bottom }
    }

    /// The number of pixels, roughly.
    pub(super) fn area(&self) -> u32 {
        match *self {
            Self::Nowhere => 0,
            Self::Everywhere => u32::MAX,
            Self::Rectangle { across, top, bottom } => {
                u32::from(across.end.saturating_sub(across.start)) * u32::from(bottom.saturating_sub(top))
            }
            // Compared only between flat objects, none of which has an ellipse.
            Self::Ellipse { half_width, .. } => u32::from(half_width),
        }
    }

    /// Whether it is an ellipse less than `lines` lines high.
    pub(super) fn is_lower_than(&self, lines: u32) -> bool {
        matches!(*self, Self::Ellipse { inverse_half_height, .. }
            if u64::from(inverse_half_height) * u64::from(lines) > 1 << 32)
    }

    /// The shortest span that holds its pixels on the lines from `top` to `bottom`, both included.
    pub(super) fn lines(&self, top: u16, bottom: u16) -> Span {
        if let Self::Ellipse { y, .. } = *self {
            // The line nearest to the middle has the most pixels: without any, no line has some.
            let middle = (y >> 8).max(i32::from(top)).min(i32::from(bottom));
            if self.span(middle as u16) == Span::NOWHERE {
                return Span::NOWHERE;
            }
        }
        (top..=bottom).map(|y| self.span(y)).fold(Span::NOWHERE, Span::hull)
    }

    /// The pixels whose upper left corners lie inside, and some more: rectangles have a pixel of room.
    #[cfg(feature = "distributed")]
    pub(super) fn of_corners(self) -> Self {
        match self {
            Self::Ellipse { x, y, slope, half_width, inverse_half_height } => {
                // Half a pixel to the right and down.
                let (x, y) = (x.saturating_add(128), y.saturating_add(128));
                Self::Ellipse { x, y, slope, half_width, inverse_half_height }
            }
            other => other,
        }
    }

    /// Its pixels on line `y`.
    pub(super) fn span(&self, y: u16) -> Span {
        match *self {
            Self::Nowhere => Span::NOWHERE,
            Self::Everywhere => Span::EVERYWHERE,
            Self::Rectangle { across, top, bottom } if (top..bottom).contains(&y) => across,
            Self::Rectangle { .. } => Span::NOWHERE,
            Self::Ellipse { x, y: middle, slope, half_width, inverse_half_height } => {
                let down = (i32::from(y) << 8 | 0x80).wrapping_sub(middle);
                // The distance from the middle as a share of half the height, in 65536ths.
                let share = (u64::from(down.unsigned_abs()) * u64::from(inverse_half_height)) >> 23;
                if share >= 1 << 16 {
                    return Span::NOWHERE;
                }
                let share = share as u32;
                let root = u32::MAX.wrapping_sub(share.wrapping_mul(share)).isqrt();
                let half = ((u32::from(half_width) * root) >> 16) as i32;
                let x = x.saturating_add(((i64::from(down) * i64::from(slope)) >> 16) as i32) >> 8;
                let place = |x: i32| u16::try_from(x.max(0)).unwrap_or(u16::MAX);
                Span {
                    start: place(x.saturating_sub(half).saturating_sub(1)),
                    end: place(x.saturating_add(half).saturating_add(2)),
                }
            }
        }
    }
}
