//! Random permutations without memory.

use super::hash::hash;

/// The position of `index` in a permutation of the numbers below `count` that the key chooses; 0 if `index`
/// is not below `count`.
///
/// The numbers below the next power of two are permuted by products, sums and shifts, each of which can be
/// undone. A result beyond `count` is permuted again, until one is below it (cycle walking: Black and
/// Rogaway, "Ciphers with Arbitrary Finite Domains", 2002). That takes fewer than two rounds on average.
pub(super) fn permute(index: u32, count: u32, key: u32) -> u32 {
    if index >= count {
        return 0;
    }
    let mask = count.next_power_of_two().wrapping_sub(1);
    let half = (mask.count_ones() / 2).max(1);
    let mut position = index;
    loop {
        let mut round_key = key;
        for _ in 0..3 {
            round_key = hash(round_key, key);
            position = position.wrapping_mul(round_key >> 15 | 1).wrapping_add(round_key) & mask;
            position ^= position >> half;
        }
        if position < count {
            return position;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_number_comes_once() {
        for count in (1..70).chain([100, 255, 256, 1000, 4096]) {
            for key in 0..5 {
                let mut seen = vec![false; count as usize];
                (0..count).for_each(|index| seen[permute(index, count, key) as usize] = true);
                assert!(seen.iter().all(|seen| *seen), "{count}");
            }
        }
        assert_eq!(permute(3, 3, 1), 0);
        assert_eq!(permute(0, 0, 1), 0);
    }

    #[test]
    fn every_number_comes_to_every_place() {
        for count in [4u32, 9, 16] {
            let mut times = vec![0u32; (count * count) as usize];
            let keys = 2000;
            for key in 0..keys {
                (0..count).for_each(|i| times[(i * count + permute(i, count, key)) as usize] += 1);
            }
            let mean = f64::from(keys) / f64::from(count);
            for times in times {
                assert!((f64::from(times) - mean).abs() < 6.0 * mean.sqrt(), "{times} of {mean}");
            }
        }
    }
}
