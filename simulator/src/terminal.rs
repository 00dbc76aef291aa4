//! Pictures for a terminal. A half block shows two pixels: the upper one in the color of the text, the lower
//! one in that of the background.

use core::fmt::Write;

use crate::Picture;
use crate::raster::shrunk;

/// The text that shows a picture in a terminal in 24-bit colors, as large as fits into this number of columns
/// and rows.
pub fn half_blocks(picture: &Picture, columns: u32, rows: u32) -> String {
    let mut text = String::new();
    // A character cell is about twice as high as wide, so half of it is a square.
    let (room_across, room_down) = (u64::from(columns), u64::from(rows) * 2);
    let (width, height) = (u64::from(picture.width.max(1)), u64::from(picture.height.max(1)));
    let (across, down) = if width * room_down > height * room_across {
        (room_across, (height * room_across / width).max(2))
    } else {
        ((width * room_down / height).max(1), room_down)
    };
    let (across, down) = (across.min(width) as u32, down.min(height) as u32 & !1);
    if across == 0 || down == 0 {
        return text;
    }
    let small = shrunk(&picture.rgb, (picture.width, picture.height), (across, down));
    let mut lines = small.chunks(across as usize);
    while let (Some(upper), Some(lower)) = (lines.next(), lines.next()) {
        for ([r, g, b], [below_r, below_g, below_b]) in upper.iter().zip(lower) {
            // Writing into a string cannot fail.
            let _ = write!(text, "\x1b[38;2;{r};{g};{b};48;2;{below_r};{below_g};{below_b}m▀");
        }
        text.push_str("\x1b[0m\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use rayline::RayCounts;

    use super::*;

    fn picture(width: u32, height: u32, rgb: Vec<u8>) -> Picture {
        Picture { width, height, rgb, rays: RayCounts::default(), prepared_bytes: 0 }
    }

    #[test]
    fn two_pixels_are_one_block() {
        let picture = picture(1, 2, vec![255, 0, 0, 0, 0, 255]);
        assert_eq!(half_blocks(&picture, 80, 24), "\x1b[38;2;255;0;0;48;2;0;0;255m▀\x1b[0m\n");
    }

    #[test]
    fn large_pictures_fit_and_keep_their_shape() {
        for (width, height, columns, rows) in [(640, 480, 58, 22), (640, 100, 80, 6), (100, 640, 6, 22)] {
            let text = half_blocks(&picture(width, height, vec![7; (width * height * 3) as usize]), 80, 22);
            assert_eq!(text.lines().count(), rows, "{width}x{height}");
            assert!(text.lines().all(|line| line.matches('▀').count() == columns), "{width}x{height}");
        }
    }

    #[test]
    fn empty_pictures_give_no_text() {
        assert_eq!(half_blocks(&picture(0, 0, Vec::new()), 80, 24), "");
        assert_eq!(half_blocks(&picture(1, 2, vec![0; 6]), 0, 0), "");
    }
}
