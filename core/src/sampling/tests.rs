//! Every sampler against what its name promises.

use super::*;

const ALL: [Sampler; 6] =
    [Sampler::R2, Sampler::Grid, Sampler::Random, Sampler::Jittered, Sampler::Poisson, Sampler::Sobol];

fn sample(sampler: Sampler, samples: u16, (x, y): (u16, u16), index: u16, seed: u32) -> PixelSample {
    PixelSample { sampling: Sampling { sampler, seed, ..Sampling::new(samples) }, x, y, index }
}

#[test]
fn samples_cover_the_pixel_evenly() {
    for sampler in ALL {
        for seed in 0..20 {
            let mut quadrants = [0; 4];
            for index in 0..64 {
                let [x, y] = sample(sampler, 64, (17, 4), index, seed).pair(Dimension::PIXEL);
                quadrants[usize::from(x >> 15) * 2 + usize::from(y >> 15)] += 1;
            }
            // Independent random positions are off by up to 12.
            let (least, most) = match sampler {
                Sampler::Random => (4, 28),
                Sampler::Grid | Sampler::Jittered | Sampler::Sobol => (16, 16),
                _ => (12, 20),
            };
            assert!(
                quadrants.iter().all(|count| (least..=most).contains(count)),
                "{sampler:?} {quadrants:?}"
            );
        }
    }
}

#[test]
fn pixels_and_seeds_differ() {
    for sampler in ALL.into_iter().filter(|sampler| *sampler != Sampler::Grid) {
        let place = |pixel, seed| sample(sampler, 4, pixel, 0, seed).pair(Dimension::PIXEL);
        assert_ne!(place((0, 0), 0), place((1, 0), 0), "{sampler:?}");
        assert_ne!(place((0, 0), 0), place((0, 1), 0), "{sampler:?}");
        assert_ne!(place((0, 0), 0), place((0, 0), 1), "{sampler:?}");
    }
}

/// Without a bias: over many pixels, the samples lie everywhere alike, and so do the first few of many.
#[test]
fn places_are_uniform_over_many_pixels() {
    for sampler in ALL.into_iter().filter(|sampler| *sampler != Sampler::Grid) {
        for (samples, first) in [(1, 1), (4, 4), (5, 5), (16, 4)] {
            let mut times = [0u32; 64];
            let pixels = 64;
            for x in 0..pixels {
                for y in 0..pixels {
                    for index in 0..first {
                        let [x, y] = sample(sampler, samples, (x, y), index, 3).pair(Dimension::PIXEL);
                        times[usize::from(y >> 13) * 8 + usize::from(x >> 13)] += 1;
                    }
                }
            }
            let mean = f64::from(pixels) * f64::from(pixels) * f64::from(first) / 64.0;
            for times in times {
                let deviations = (f64::from(times) - mean) / mean.sqrt();
                assert!(deviations.abs() < 4.5, "{sampler:?}, {first} of {samples}: {deviations:.1}");
            }
        }
    }
}

#[test]
fn a_grid_of_any_number_has_different_places() {
    for samples in 1..70u16 {
        let mut places: Vec<_> = (0..samples)
            .map(|index| sample(Sampler::Grid, samples, (0, 0), index, 0).pair(Dimension::PIXEL))
            .collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), usize::from(samples));
    }
    let mut four: Vec<_> =
        (0..4).map(|index| sample(Sampler::Grid, 4, (5, 9), index, 1).pair(Dimension::PIXEL)).collect();
    four.sort_unstable();
    assert_eq!(four, [[0x4000, 0x4000], [0x4000, 0xC000], [0xC000, 0x4000], [0xC000, 0xC000]]);
}
