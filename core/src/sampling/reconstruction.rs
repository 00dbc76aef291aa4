//! Reconstruction filters: the weight of the light around the center of a pixel.

use super::CENTER;

/// The weight of the light around the center of a pixel, by which the samples become one color. All but
/// [`Box`](Self::Box) need the feature `distributed`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Reconstruction {
    /// The mean of the pixel's area: one weight in the whole pixel, and none outside.
    #[default]
    Box,
    /// A weight that falls evenly from the center to the centers of the neighboring pixels.
    Tent,
    /// A Gaussian with a standard deviation of half a pixel, cut off at one and a half pixels.
    Gaussian,
}

/// Distances from the center, in 65536ths of a pixel, inside of which 0/64, 1/64 … 64/64 of the Gaussian's
/// weight lies.
#[rustfmt::skip]
const GAUSSIAN: [u32; 65] = [
    0, 640, 1280, 1921, 2562, 3205, 3849, 4494, 5141, 5790, 6441, 7095, 7751, 8411, 9074, 9741, 10412,
    11087, 11767, 12453, 13143, 13840, 14543, 15253, 15969, 16694, 17427, 18169, 18920, 19681, 20453, 21236,
    22032, 22841, 23664, 24503, 25358, 26230, 27121, 28033, 28967, 29926, 30910, 31924, 32969, 34048, 35166,
    36326, 37534, 38795, 40116, 41506, 42975, 44535, 46204, 48002, 49958, 52109, 54512, 57250, 60458, 64379,
    69523, 77327, 98304,
];

impl Reconstruction {
    /// The distance from the left or upper side of the pixel, in 65536ths of a pixel, up to which this share
    /// of the filter's weight lies. The share is in 65536ths.
    pub(super) fn place(self, share: u16) -> i32 {
        // The filters are symmetric: twice the share that lies on the way from the center, in 32768ths.
        let beyond = if share >= 0x8000 { u32::from(share) - 0x8000 } else { 0x8000 - u32::from(share) };
        let distance = match self {
            Self::Box => return i32::from(share),
            // The share inside of a distance d is 1 - (1 - d)².
            Self::Tent => 0x1_0000 - ((0x8000 - beyond).min(0x7FFF) << 17).isqrt() as i32,
            Self::Gaussian => {
                let quantile = |index: u32| GAUSSIAN.get(index as usize).copied().unwrap_or(98304);
                let (index, rest) = (beyond >> 9, beyond & 0x1FF);
                let (near, far) = (quantile(index), quantile(index + 1));
                (near + (((far - near) * rest) >> 9)) as i32
            }
        };
        if share >= 0x8000 { CENTER + distance } else { CENTER - distance }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean and variance of a filter's places in pixels, and the largest distance from the center.
    fn moments(filter: Reconstruction) -> (f64, f64, f64) {
        let places = || (0..=u16::MAX).map(|share| f64::from(filter.place(share)) / 65536.0 - 0.5);
        let mean = places().sum::<f64>() / 65536.0;
        let variance = places().map(|place| place * place).sum::<f64>() / 65536.0;
        (mean, variance, places().map(f64::abs).fold(0.0, f64::max))
    }

    #[test]
    fn filters_have_their_width() {
        // The variances of the box (1/12), the tent (1/6) and the Gaussian cut off at three deviations.
        let gaussian = 0.25 * (1.0 - 2.0 * 3.0 * (-4.5f64).exp() / (core::f64::consts::TAU.sqrt() * 0.9973));
        for (filter, variance, reach) in [
            (Reconstruction::Box, 1.0 / 12.0, 0.5),
            (Reconstruction::Tent, 1.0 / 6.0, 1.0),
            (Reconstruction::Gaussian, gaussian, 1.5),
        ] {
            let (mean, found, farthest) = moments(filter);
            assert!(mean.abs() < 1e-4, "{filter:?}: {mean}");
            assert!((found - variance).abs() < 0.02 * variance, "{filter:?}: {found}, not {variance}");
            assert!(farthest <= reach && farthest > reach - 0.05, "{filter:?}: {farthest}");
        }
    }

    #[test]
    fn places_ascend_with_the_share() {
        for filter in [Reconstruction::Box, Reconstruction::Tent, Reconstruction::Gaussian] {
            let places: Vec<_> = (0..=u16::MAX).map(|share| filter.place(share)).collect();
            assert!(places.windows(2).all(|pair| pair[0] <= pair[1]), "{filter:?}");
        }
    }
}
