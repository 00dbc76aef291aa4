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

/// The threshold of a pixel, 0 to 65535, by a mask of 64 by 64 pixels: any share of the pixels is spread
/// evenly and without a pattern (Ulichney, "The Void-and-Cluster Method for Dither Array Generation", SPIE
/// 1993).
///
/// Formulas take no table. But of a third of the pixels, the power at low frequencies and the largest peak,
/// both in parts of the mean power of white noise, are 0.07 and 10 for this mask, 0.06 and 455 for R2 above,
/// and 0.14 and 782 for interleaved gradient noise (Jimenez, "Next Generation Post Processing in Call of
/// Duty: Advanced Warfare", 2014): peaks are seen as stripes. A test prints the figures.
pub(super) fn blue_noise(x: u16, y: u16) -> u32 {
    let place = usize::from(y & 63) << 6 | usize::from(x & 63);
    u32::from(BLUE_NOISE.get(place).copied().unwrap_or_default()) * 256 + 128
}

/// The ranks of the mask's pixels in 256ths, row by row: 4 KB. The test
/// `blue_noise_is_made_by_void_and_cluster` makes them.
static BLUE_NOISE: [u8; 64 * 64] = *include_bytes!("blue_noise.bin");

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
            for pattern in [stippling, hatching, blue_noise] {
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

    /// Ulichney's method, with Gaussians of σ = 1.5 pixels on a torus: the rank of each pixel.
    fn void_and_cluster() -> Vec<usize> {
        const SIDE: usize = 64;
        let far = |way: usize| way.min(SIDE - way) as f64;
        let bell: Vec<f64> = (0..SIDE * SIDE)
            .map(|at| (-(far(at % SIDE).powi(2) + far(at / SIDE).powi(2)) / (2.0 * 1.5 * 1.5)).exp())
            .collect();
        let add = |energy: &mut [f64], pixel: usize, sign: f64| {
            for (at, energy) in energy.iter_mut().enumerate() {
                let across = (at % SIDE + SIDE - pixel % SIDE) % SIDE;
                let down = (at / SIDE + SIDE - pixel / SIDE) % SIDE;
                *energy += sign * bell[down * SIDE + across];
            }
        };
        let extreme = |energy: &[f64], on: &[bool], tightest: bool| {
            let sign = if tightest { -1.0 } else { 1.0 };
            let pixels = (0..SIDE * SIDE).filter(|pixel| on[*pixel] == tightest);
            pixels.min_by(|a, b| (sign * energy[*a]).total_cmp(&(sign * energy[*b]))).unwrap()
        };
        let (mut on, mut energy) = (vec![false; SIDE * SIDE], vec![0.0; SIDE * SIDE]);
        let mut seed = 1u32;
        while on.iter().filter(|on| **on).count() < SIDE * SIDE / 10 {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let pixel = (seed >> 20) as usize;
            if !on[pixel] {
                on[pixel] = true;
                add(&mut energy, pixel, 1.0);
            }
        }
        // From the tightest cluster to the largest void, until both are one place.
        loop {
            let cluster = extreme(&energy, &on, true);
            on[cluster] = false;
            add(&mut energy, cluster, -1.0);
            let void = extreme(&energy, &on, false);
            on[void] = true;
            add(&mut energy, void, 1.0);
            if void == cluster {
                break;
            }
        }
        let mut ranks = vec![0; SIDE * SIDE];
        let (mut left, mut rest) = (on.clone(), energy.clone());
        for rank in (0..SIDE * SIDE / 10).rev() {
            let cluster = extreme(&rest, &left, true);
            left[cluster] = false;
            add(&mut rest, cluster, -1.0);
            ranks[cluster] = rank;
        }
        // The largest void among the pixels that are on is also the tightest cluster of those that are off:
        // all Gaussians together are flat.
        for rank in SIDE * SIDE / 10..SIDE * SIDE {
            let void = extreme(&energy, &on, false);
            on[void] = true;
            add(&mut energy, void, 1.0);
            ranks[void] = rank;
        }
        ranks
    }

    #[test]
    fn blue_noise_is_made_by_void_and_cluster() {
        let mask: Vec<u8> = void_and_cluster().into_iter().map(|rank| (rank / 16) as u8).collect();
        if std::env::var_os("RAYLINE_BLESS").is_some() {
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/render/blue_noise.bin");
            std::fs::write(path, &mask).unwrap();
        }
        assert!(mask == BLUE_NOISE, "RAYLINE_BLESS=1 cargo test -p rayline --features looks blue_noise");
    }

    /// Interleaved gradient noise, for comparison.
    fn gradient_noise(x: u16, y: u16) -> u32 {
        let fract = |number: f64| number - number.floor();
        let noise = fract(52.982_918_9 * fract(0.067_110_56 * f64::from(x) + 0.005_837_15 * f64::from(y)));
        (noise * 65536.0) as u32
    }

    fn white_noise(x: u16, y: u16) -> u32 {
        let mut hash = u32::from(y) << 16 | u32::from(x);
        for _ in 0..3 {
            hash = (hash ^ hash >> 15).wrapping_mul(0x2C1B_3C6D);
        }
        hash >> 16
    }

    /// The power of a picture of 64 x 64 black and white pixels at low frequencies, and its largest peak,
    /// both in parts of the mean power of white noise.
    fn spectrum(pattern: fn(u16, u16) -> u32, ink: f64) -> (f64, f64) {
        const SIDE: usize = 64;
        let light = ((1.0 - ink) * 65536.0) as u32;
        let value = |x: usize, y: usize| {
            let is_white = light + pattern(x as u16, y as u16) >= 65536;
            f64::from(u8::from(is_white)) - (1.0 - ink)
        };
        let turn = core::f64::consts::TAU / SIDE as f64;
        let wave: Vec<(f64, f64)> = (0..SIDE).map(|i| (turn * i as f64).sin_cos()).collect();
        // Rows, then columns.
        let mut rows = vec![(0.0, 0.0); SIDE * SIDE];
        for (y, u) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |u| (y, u))) {
            let sum = (0..SIDE).map(|x| (value(x, y), wave[x * u % SIDE]));
            rows[y * SIDE + u] = sum.fold((0.0, 0.0), |(re, im), (v, (s, c))| (re + v * c, im - v * s));
        }
        let (mut low, mut count, mut peak) = (0.0, 0, 0.0f64);
        // The frequency of dots that are spread evenly. From a quarter on they touch, and it stays (Lau,
        // Ulichney and Arce, "Blue- and Green-Noise Halftoning Models", 2003).
        let lattice = ink.min(1.0 - ink).min(0.25).sqrt() * SIDE as f64;
        for (u, v) in (0..SIDE).flat_map(|u| (0..SIDE).map(move |v| (u, v))).skip(1) {
            let column = (0..SIDE).map(|y| (rows[y * SIDE + u], wave[y * v % SIDE]));
            let (re, im) = column
                .fold((0.0, 0.0), |(re, im), ((a, b), (s, c))| (re + a * c + b * s, im + b * c - a * s));
            let power = (re * re + im * im) / (ink * (1.0 - ink) * (SIDE * SIDE) as f64);
            let frequency = (u.min(SIDE - u) as f64).hypot(v.min(SIDE - v) as f64);
            if frequency < lattice / 2.0 {
                (low, count) = (low + power, count + 1);
            }
            peak = peak.max(power);
        }
        (low / f64::from(count), peak)
    }

    /// The mask has next to nothing of low frequencies, where the eye is sensitive, and no peaks, which are
    /// seen as stripes.
    #[test]
    fn blue_noise_has_neither_clumps_nor_stripes() {
        for ink in [0.1, 1.0 / 3.0, 0.5] {
            let [mask, dots, gradient, white] =
                [blue_noise, stippling, gradient_noise, white_noise].map(|pattern| spectrum(pattern, ink));
            std::println!("{ink:.2}: mask {mask:.3?}, R2 {dots:.3?}, IGN {gradient:.3?}, white {white:.3?}");
            assert!(white.0 > 0.7 && mask.0 < 0.1, "{ink}: {mask:?}");
            assert!(mask.1 < 20.0 && mask.1 < dots.1 / 3.0 && mask.1 < gradient.1 / 3.0, "{ink}: {mask:?}");
        }
    }
}
