//! The dimensions of a sample: which numbers it draws for what.
//!
//! | number | dimension |
//! |---|---|
//! | 0 | the place in the pixel |
//! | 1 | the place on the lens |
//! | 2 | the time |
//! | 4 + 4 · b | the direction of a mirrored ray after b bounces |
//! | 5 + 4 · b | the direction of a refracted ray after b bounces |
//! | 7 + 4 · b | the directions into the sky from a hit after b bounces |
//! | 128 + 2 · b | the direction of a scattered ray after b bounces |
//! | 129 + 2 · b | the way on which a path goes on after b bounces |
//! | 6 + 4 · b + 256 · l | the points of the light l for a hit after b bounces |

/// A use of two numbers that a sample draws. Two uses never share numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dimension(u32);

impl Dimension {
    /// The place in the pixel.
    pub(crate) const PIXEL: Self = Self(0);
    /// The place on the lens.
    #[cfg(feature = "distributed")]
    pub(crate) const LENS: Self = Self(1);
    /// The time: the first number of the pair.
    #[cfg(feature = "distributed")]
    pub(crate) const TIME: Self = Self(2);

    /// The direction of a mirrored ray, which leaves a surface after so many bounces.
    pub(crate) const fn mirrored(bounces: u8) -> Self {
        Self(4 + 4 * bounces as u32)
    }

    /// The direction of a refracted ray, which leaves a surface after so many bounces.
    pub(crate) const fn refracted(bounces: u8) -> Self {
        Self(5 + 4 * bounces as u32)
    }

    /// The points of a light with a size, for a hit after so many bounces.
    #[cfg(feature = "distributed")]
    pub(crate) const fn lamp(bounces: u8, light: usize) -> Self {
        Self(6 + 4 * bounces as u32 + ((light as u32) << 8))
    }

    /// The directions into the sky, from a hit after so many bounces.
    #[cfg(feature = "distributed")]
    pub(crate) const fn sky(bounces: u8) -> Self {
        Self(7 + 4 * bounces as u32)
    }

    /// The direction of a scattered ray, which leaves a surface after so many bounces.
    #[cfg(feature = "path-tracing")]
    pub(crate) const fn scattered(bounces: u8) -> Self {
        Self(128 + 2 * bounces as u32)
    }

    /// The way on which a path goes on after so many bounces.
    #[cfg(feature = "path-tracing")]
    pub(crate) const fn way(bounces: u8) -> Self {
        Self(129 + 2 * bounces as u32)
    }

    /// Its number, which hashes take.
    pub(super) const fn number(self) -> u32 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::MAX_BOUNCES;

    /// No two uses have the same number, and the numbers are those of the table.
    #[test]
    #[cfg(feature = "distributed")]
    fn each_use_has_a_number_of_its_own() {
        let text = include_str!("dimension.rs");
        let table: String = text.lines().take_while(|line| line.starts_with("//!")).collect();
        let mut numbers = vec![Dimension::PIXEL.number(), Dimension::LENS.number(), Dimension::TIME.number()];
        for number in &numbers {
            assert!(table.contains(&format!("| {number} | the ")), "{number}");
        }
        let mut add = |entry: &str, number: u32, dimension: Dimension| {
            assert!(table.contains(entry), "{entry}");
            assert_eq!(dimension.number(), number);
            numbers.push(number);
        };
        for b in 0..=MAX_BOUNCES {
            let first = 4 * u32::from(b);
            add("| 4 + 4 · b | the direction of a mirrored ray", 4 + first, Dimension::mirrored(b));
            add("| 5 + 4 · b | the direction of a refracted ray", 5 + first, Dimension::refracted(b));
            add("| 7 + 4 · b | the directions into the sky", 7 + first, Dimension::sky(b));
            #[cfg(feature = "path-tracing")]
            {
                let (scattered, way) = (Dimension::scattered(b), Dimension::way(b));
                add("| 128 + 2 · b | the direction of a scattered ray", 128 + 2 * u32::from(b), scattered);
                add("| 129 + 2 · b | the way on which a path goes on", 129 + 2 * u32::from(b), way);
            }
            for light in [0, 1, 7, 65_534] {
                let number = 6 + first + 256 * light as u32;
                add("| 6 + 4 · b + 256 · l | the points of the light l", number, Dimension::lamp(b, light));
            }
        }
        let count = numbers.len();
        numbers.sort_unstable();
        numbers.dedup();
        assert_eq!(numbers.len(), count);
    }

    #[test]
    fn directions_of_different_bounces_differ() {
        assert!((0..MAX_BOUNCES).all(|b| Dimension::mirrored(b) != Dimension::mirrored(b + 1)));
    }
}
