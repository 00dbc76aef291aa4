//! The comparison of two pictures, and the agreement that tests demand.

use std::path::Path;

use crate::Picture;

/// The largest difference of a channel, of 255, in a pixel that counts as alike.
const TOLERANCE: u8 = 2;
/// The share of pixels that must be alike. The others may lie on edges, which rounding moves across the
/// centers of pixels.
const BAR: f64 = 0.995;

/// The differences of two pictures.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The share of pixels, 0 to 1, whose channels all differ by at most 2 of 255.
    pub alike: f64,
    /// All other pixels: x, y and the largest difference of a channel.
    pub off: Vec<(u32, u32, u8)>,
    /// The difference of each channel of each pixel.
    pub difference: Picture,
}

impl Comparison {
    /// Compares two pictures of the same size.
    pub fn new(a: &Picture, b: &Picture) -> Self {
        assert_eq!((a.width, a.pixels.len()), (b.width, b.pixels.len()), "pictures differ in size");
        let pixels: Vec<[u8; 3]> = a
            .pixels
            .iter()
            .zip(&b.pixels)
            .map(|(a, b)| [0, 1, 2].map(|channel: usize| a[channel].abs_diff(b[channel])))
            .collect();
        let off: Vec<_> = (0u32..)
            .zip(&pixels)
            .map(|(i, [r, g, b])| (i % a.width, i / a.width, *r.max(g).max(b)))
            .filter(|(.., most)| *most > TOLERANCE)
            .collect();
        Self {
            alike: 1.0 - off.len() as f64 / pixels.len() as f64,
            off,
            difference: Picture { width: a.width, pixels },
        }
    }
}

/// Panics if fewer than 99.5 % of the pixels differ by at most 2 of 255 in every channel, and then writes
/// both pictures and their difference (times 16) to `directory`. The files are named by the scene and the two
/// renderers.
pub fn assert_alike(
    directory: &Path,
    scene: &str,
    (a_name, a): (&str, &Picture),
    (b_name, b): (&str, &Picture),
) {
    let comparison = Comparison::new(a, b);
    println!("{scene:12} {a_name} / {b_name}: {:.3} % of pixels alike", comparison.alike * 100.0);
    if comparison.alike >= BAR {
        return;
    }
    let write = |name: &str, picture: &Picture| {
        let path = directory.join(format!("{scene}-{name}.png"));
        picture.write(&path);
        println!("wrote {}", path.display());
    };
    let mut difference = comparison.difference.clone();
    difference.pixels.iter_mut().flatten().for_each(|channel| *channel = channel.saturating_mul(16));
    write(a_name, a);
    write(b_name, b);
    write(&format!("{a_name}-{b_name}"), &difference);
    for (x, y, most) in comparison.off.iter().step_by(comparison.off.len().div_ceil(20)) {
        println!("pixel {x},{y} is off by {most}");
    }
    panic!("{scene}: {a_name} and {b_name} agree on {:.3} % of pixels only", comparison.alike * 100.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gray(values: &[u8]) -> Picture {
        Picture { width: 100, pixels: values.iter().map(|value| [*value; 3]).collect() }
    }

    #[test]
    fn two_is_alike_and_three_is_not() {
        let black = gray(&[0; 1000]);
        let mut other = [2; 1000];
        assert_eq!(Comparison::new(&black, &gray(&other)).alike, 1.0);
        other[101] = 3;
        let comparison = Comparison::new(&gray(&other), &black);
        assert_eq!(comparison.off, [(1, 1, 3)]);
        assert!((comparison.alike - 0.999).abs() < 1e-12);
    }

    #[test]
    #[should_panic(expected = "agree on 99.400 % of pixels only")]
    fn less_than_the_bar_is_refused() {
        let mut other = [0; 1000];
        other[..6].fill(3);
        assert_alike(&std::env::temp_dir(), "bar", ("a", &gray(&[0; 1000])), ("b", &gray(&other)));
    }
}
