//! Threshold patterns that look drawn by hand, for displays of few levels (Ulichney, "Digital Halftoning",
//! 1987).
//!
//! A pattern is an order in which pixels turn from black to white as light grows. Each is a function of the
//! pixel's place, and each order is spread evenly over the thresholds, so that areas keep their mean.

/// The threshold of a pixel, 0 to 65535, for dots: a low one is added late and makes ink early.
///
/// Pixels are ordered by the sequence R2, of which neighbors in the picture are far apart, as in blue noise;
/// the triangle wave joins the ends of its range (Roberts, "The Unreasonable Effectiveness of Quasirandom
/// Sequences", 2018). It takes no table.
pub(super) fn stippling(x: u16, y: u16) -> u32 {
    // 65536 / g and 65536 / g², for g³ = g + 1.
    let place = (u32::from(x) * 49472 + u32::from(y) * 37345) & 0xFFFF;
    if place < 0x8000 { 2 * place } else { 2 * (0xFFFF - place) + 1 }
}

/// The threshold of a pixel, 0 to 65535, for crossing lines.
pub(super) fn hatching(x: u16, y: u16) -> u32 {
    let place = usize::from(y & 7) << 3 | usize::from(x & 7);
    u32::from(HATCHING.get(place).copied().unwrap_or_default()) * 1024 + 512
}

/// The order in which the pixels of a square of eight by eight turn to ink: line by line, in two directions
/// in turn, each line between those before it.
static HATCHING: [u8; 64] = hatching_order();

/// The numbers 0 to 7 with their three bits reversed: each lies in the middle of a gap.
const SPREAD: [usize; 8] = [0, 4, 2, 6, 1, 5, 3, 7];

#[allow(clippy::indexing_slicing)] // evaluated by the compiler
const fn hatching_order() -> [u8; 64] {
    let mut order = [u8::MAX; 64];
    let mut next = 0;
    let mut line = 0;
    while line < 16 {
        let offset = SPREAD[line / 2];
        let mut step = 0;
        while step < 8 {
            let x = SPREAD[step];
            // Falling lines have one sum of x and y, rising ones one difference.
            let y = if line % 2 == 0 { (offset + 8 - x) % 8 } else { (offset + x) % 8 };
            if order[y * 8 + x] == u8::MAX {
                order[y * 8 + x] = next;
                next += 1;
            }
            step += 1;
        }
        line += 1;
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    const SIDE: u16 = 256;

    fn places() -> impl Iterator<Item = (u16, u16)> {
        (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)))
    }

    /// The pixels that are black where the light is 1 - `ink`.
    fn black(pattern: fn(u16, u16) -> u32, ink: f64) -> Vec<(u16, u16)> {
        let light = ((1.0 - ink) * 65536.0) as u32;
        places().filter(|(x, y)| light + pattern(*x, *y) < 65536).collect()
    }

    #[test]
    fn areas_keep_their_mean() {
        for sixteenths in 0..=16 {
            let ink = f64::from(sixteenths) / 16.0;
            for pattern in [stippling, hatching] {
                let share = black(pattern, ink).len() as f64 / f64::from(SIDE) / f64::from(SIDE);
                assert!((share - ink).abs() < 1e-3, "{share}, not {ink}");
            }
        }
    }

    /// In a light gray there are lines in one direction, then in both, then between those.
    #[test]
    fn darker_areas_have_more_lines() {
        let falls = |(x, y): &(u16, u16), of: u16| (x + y).is_multiple_of(of);
        let rises = |(x, y): &(u16, u16), of: u16| (x + SIDE - y).is_multiple_of(of);
        assert_eq!(black(hatching, 0.125).len(), 256 * 256 / 8);
        assert!(black(hatching, 0.125).iter().all(|place| falls(place, 8)));
        let crossed = black(hatching, 0.21875);
        assert!(crossed.iter().all(|place| falls(place, 8) || rises(place, 8)));
        assert!(crossed.iter().any(|place| !falls(place, 8)));
        assert!(black(hatching, 0.36).iter().all(|place| falls(place, 4) || rises(place, 4)));
    }

    /// Few dots are far apart, and squares of eight by eight pixels vary a fifth as much as with random dots.
    #[test]
    fn dots_are_spread_evenly() {
        let dots = black(stippling, 1.0 / 16.0);
        for (index, (x, y)) in dots.iter().enumerate() {
            let near = |(a, b): &&(u16, u16)| a.abs_diff(*x) <= 1 && b.abs_diff(*y) <= 1;
            assert_eq!(dots.iter().skip(index.saturating_sub(80)).take(160).filter(near).count(), 1);
        }
        for ink in [0.1, 0.3, 0.5, 0.8] {
            let mut counts = [[0u32; 32]; 32];
            for (x, y) in black(stippling, ink) {
                counts[usize::from(y / 8)][usize::from(x / 8)] += 1;
            }
            let squares = counts.iter().flatten().map(|count| (f64::from(*count) - ink * 64.0).powi(2));
            let (variance, random) = (squares.sum::<f64>() / 1024.0, ink * (1.0 - ink) * 64.0);
            assert!(variance < random / 5.0, "{ink}: {variance}, random dots have {random}");
        }
    }
}
