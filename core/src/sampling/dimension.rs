//! The dimensions of a sample: which numbers it draws for what.
//!
//! | number | dimension |
//! |---|---|
//! | 0 | the place in the pixel |
//! | 1 | the place on the lens |
//! | 4 + 4 · b | the direction of a mirrored ray after b bounces |
//! | 5 + 4 · b | the direction of a refracted ray after b bounces |

/// A use of two numbers that a sample draws. Two uses never share numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dimension(u32);

impl Dimension {
    /// The place in the pixel.
    pub(crate) const PIXEL: Self = Self(0);
    /// The place on the lens.
    pub(crate) const LENS: Self = Self(1);

    /// The direction of a mirrored ray, which leaves a surface after so many bounces.
    pub(crate) const fn mirrored(bounces: u8) -> Self {
        Self(4 + 4 * bounces as u32)
    }

    /// The direction of a refracted ray, which leaves a surface after so many bounces.
    pub(crate) const fn refracted(bounces: u8) -> Self {
        Self(5 + 4 * bounces as u32)
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
    fn each_use_has_a_number_of_its_own() {
        let table: String =
            include_str!("dimension.rs").lines().take_while(|line| line.starts_with("//!")).collect();
        let mut numbers = vec![Dimension::PIXEL.number(), Dimension::LENS.number()];
        for number in &numbers {
            assert!(table.contains(&format!("| {number} | the place")), "{number}");
        }
        for (first, use_of) in [(4, Dimension::mirrored as fn(u8) -> Dimension), (5, Dimension::refracted)] {
            assert!(table.contains(&format!("| {first} + 4 · b | the direction")));
            for bounces in 0..=MAX_BOUNCES {
                assert_eq!(use_of(bounces).number(), first + 4 * u32::from(bounces));
                numbers.push(use_of(bounces).number());
            }
        }
        let count = numbers.len();
        numbers.sort_unstable();
        numbers.dedup();
        assert_eq!(numbers.len(), count);
    }
}
