//! Sobol's sequence in two dimensions, scrambled by hashes and spread over the picture.

use super::hash::hash;

/// The point of a sample, of so many in each pixel. The seed stands for the dimension, too.
///
/// All pixels of a square of 256 share one sequence. A part of it that begins and ends at a multiple of a
/// power of two is as evenly spread as the whole, so the samples of a pixel follow each other, and so do
/// those of four pixels in a square, of four such squares, and so on (Morton's order). Neighbors then make up
/// for each other's errors. In each square, a hash chooses the order of the four, so that no pattern shows.
pub(super) fn point((x, y): (u16, u16), (index, samples): (u32, u32), seed: u32) -> [u16; 2] {
    let square = u32::from(y >> 8) << 8 | u32::from(x >> 8);
    let seed = hash(square, seed);
    // Up to 16 bits of pixels and 16 of samples.
    let sample_bits = (32 - samples.saturating_sub(1).leading_zeros()).min(16);
    let pixels = spread(x) | spread(y) << 1;
    let ordered = reorder(pixels << sample_bits | index, 16 + sample_bits, seed);
    let (first, second) = (hash(seed, 1), hash(seed, 2));
    [scrambled(ordered, first), scrambled(second_dimension(ordered), second)]
}

/// The eight lower bits of a number, each two places apart.
fn spread(coordinate: u16) -> u32 {
    let mut bits = u32::from(coordinate) & 0xFF;
    bits = (bits | bits << 4) & 0x0F0F;
    bits = (bits | bits << 2) & 0x3333;
    (bits | bits << 1) & 0x5555
}

/// The number of so many bits with each pair of bits exchanged for another. A hash of the bits above the pair
/// chooses one of the 24 orders of its four values.
fn reorder(number: u32, bits: u32, seed: u32) -> u32 {
    let mut shift = bits;
    let mut above = 0;
    while shift >= 2 {
        shift -= 2;
        let order = ((hash(above, seed ^ shift) >> 16) * 24) >> 16;
        let order = ORDERS.get(order as usize).copied().unwrap_or(0b11_10_01_00);
        let pair = number >> shift & 3;
        above = above << 2 | u32::from(order) >> (pair * 2) & 3;
    }
    if shift == 1 {
        above = above << 1 | (number ^ hash(above, seed ^ 32)) & 1;
    }
    above
}

/// The orders of four values: two bits for each value, the value 0 in the lowest.
#[rustfmt::skip]
static ORDERS: [u8; 24] = [
    0b00_01_10_11, 0b00_01_11_10, 0b00_10_01_11, 0b00_10_11_01, 0b00_11_01_10, 0b00_11_10_01,
    0b01_00_10_11, 0b01_00_11_10, 0b01_10_00_11, 0b01_10_11_00, 0b01_11_00_10, 0b01_11_10_00,
    0b10_00_01_11, 0b10_00_11_01, 0b10_01_00_11, 0b10_01_11_00, 0b10_11_00_01, 0b10_11_01_00,
    0b11_00_01_10, 0b11_00_10_01, 0b11_01_00_10, 0b11_01_10_00, 0b11_10_00_01, 0b11_10_01_00,
];

/// Sobol's second dimension for a number, with its bits in reverse order. The bit j is the sum modulo 2 of
/// the bits k of the number whose binomial (k over j) is odd, which is so if j has no bit that k has not.
fn second_dimension(number: u32) -> u32 {
    let mut bits = number;
    bits ^= bits >> 1 & 0x5555_5555;
    bits ^= bits >> 2 & 0x3333_3333;
    bits ^= bits >> 4 & 0x0F0F_0F0F;
    bits ^= bits >> 8 & 0x00FF_00FF;
    bits ^ bits >> 16 & 0x0000_FFFF
}

/// The value in 65536ths whose bits are given in reverse order, scrambled: each bit is inverted or not by a
/// hash of the bits above it (Laine and Karras, "Stratified Sampling for Stochastic Transparency", 2011, with
/// the constants of Vegdahl, "Building a Better LK Hash", 2021).
fn scrambled(reversed: u32, seed: u32) -> u16 {
    let mut bits = reversed;
    bits ^= bits.wrapping_mul(0x3D20_ADEA);
    bits = bits.wrapping_add(seed);
    bits = bits.wrapping_mul(seed >> 16 | 1);
    bits ^= bits.wrapping_mul(0x0552_6C56);
    bits ^= bits.wrapping_mul(0x53A2_2864);
    (bits.reverse_bits() >> 16) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sobol's second dimension by its direction numbers.
    #[test]
    fn the_second_dimension_is_that_of_sobol() {
        for number in (0..300).chain([0xDEAD_BEEF, u32::MAX]) {
            let (mut direction, mut value) = (1u32 << 31, 0);
            for bit in 0..32 {
                if number >> bit & 1 == 1 {
                    value ^= direction;
                }
                direction ^= direction >> 1;
            }
            assert_eq!(second_dimension(number).reverse_bits(), value);
        }
    }

    /// The samples of a pixel, of a square of pixels, and so on are nets: each box of their size has one.
    #[test]
    fn aligned_parts_are_nets() {
        for (samples, square) in [(1, 4), (4, 1), (4, 4), (8, 1), (8, 2), (16, 1), (16, 8), (64, 1)] {
            let count = samples * square * square;
            let places: Vec<_> = (0..count)
                .map(|number| {
                    let (pixel, index) = (number / samples, number % samples);
                    let pixel = (48 + (pixel % square) as u16, 16 + (pixel / square) as u16);
                    point(pixel, (index, samples), 77)
                })
                .collect();
            let bits = count.trailing_zeros();
            for columns in 0..=bits {
                let boxes = |[x, y]: [u16; 2]| {
                    let column = (u32::from(x) << columns) >> 16;
                    let row = (u32::from(y) << (bits - columns)) >> 16;
                    (row << columns | column) as usize
                };
                let mut seen = vec![0; count as usize];
                places.iter().for_each(|place| seen[boxes(*place)] += 1);
                assert!(seen.iter().all(|times| *times == 1), "{samples} samples, {square}: {seen:?}");
            }
        }
    }

    #[test]
    fn every_order_of_four_values_is_there_once() {
        let mut orders = ORDERS.to_vec();
        orders.sort_unstable();
        orders.dedup();
        assert_eq!(orders.len(), 24);
        for order in orders {
            assert_eq!((0..4).fold(0, |seen, value| seen | 1 << (order >> (2 * value) & 3)), 0b1111);
        }
    }

    #[test]
    fn seeds_and_squares_of_pixels_differ() {
        assert_ne!(point((0, 0), (0, 4), 1), point((0, 0), (0, 4), 2));
        assert_ne!(point((0, 0), (0, 4), 1), point((256, 0), (0, 4), 1));
    }
}
