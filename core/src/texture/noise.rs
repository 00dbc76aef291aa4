//! Gradient noise (Perlin, "Improving Noise", SIGGRAPH 2002), with an integer hash in place of a table of
//! permutations. The hash takes no flash, gives the same bits on every processor, and repeats only after 2³²
//! cells.

use super::{blend, check_reflectivity};
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::math::{LatticeCoordinate, Real};

/// The most octaves of noise. The eighth is a 128th as strong as the first, about one level of a display.
pub const MAX_OCTAVES: u8 = 8;

/// Clouds: noise with one cell in each unit, plus finer noise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Noise<R = f32> {
    /// The color where the noise is lowest.
    pub low: LinearRgb<R>,
    /// The color where the noise is highest.
    pub high: LinearRgb<R>,
    /// The number of noises that are added up, each with cells half as large and half as strong as the one
    /// before: 1 to [`MAX_OCTAVES`].
    pub octaves: u8,
}

impl Noise {
    pub(super) fn prepare<R: Real>(&self) -> Result<Noise<R>, Fault> {
        Ok(Noise {
            low: check_reflectivity(self.low)?,
            high: check_reflectivity(self.high)?,
            octaves: check_octaves(self.octaves)?,
        })
    }
}

impl<R: Real> Noise<R> {
    pub(super) fn color(&self, at: [LatticeCoordinate<R>; 3]) -> LinearRgb<R> {
        let share = (octaves(at, self.octaves) + R::ONE) * R::from_fraction(1 << 15);
        let share = if share < R::ZERO { R::ZERO } else { share };
        blend(self.low, self.high, if share > R::ONE { R::ONE } else { share })
    }
}

/// Refuses a number of octaves outside 1 to [`MAX_OCTAVES`].
pub(super) fn check_octaves(octaves: u8) -> Result<u8, Fault> {
    if (1..=MAX_OCTAVES).contains(&octaves) { Ok(octaves) } else { Err(Fault::Octaves) }
}

/// The sum of several octaves of noise: between -2.1 and 2.1, and most often between -0.7 and 0.7.
pub(super) fn octaves<R: Real>(mut at: [LatticeCoordinate<R>; 3], octaves: u8) -> R {
    let (mut sum, mut strength) = (R::ZERO, R::ONE);
    for octave in 0..octaves {
        sum = sum + noise(at, octave.into()) * strength;
        strength = strength * R::from_fraction(1 << 15);
        at = at.map(LatticeCoordinate::doubled);
    }
    sum
}

/// Gradient noise between -1.04 and 1.04: 0 at each corner of the lattice of cells, with a slope that is a
/// hash of the corner.
pub(super) fn noise<R: Real>([x, y, z]: [LatticeCoordinate<R>; 3], seed: u32) -> R {
    let corner = |dx: i32, dy: i32, dz: i32| {
        let hash = hash([x.index.wrapping_add(dx), y.index.wrapping_add(dy), z.index.wrapping_add(dz)], seed);
        let from = |at: LatticeCoordinate<R>, d: i32| if d == 0 { at.within } else { at.within - R::ONE };
        slope(hash, from(x, dx), from(y, dy), from(z, dz))
    };
    let (u, v, w) = (fade(x.within), fade(y.within), fade(z.within));
    let between = |a: R, b: R, share: R| a + (b - a) * share;
    let edge = |dy: i32, dz: i32| between(corner(0, dy, dz), corner(1, dy, dz), u);
    between(between(edge(0, 0), edge(1, 0), v), between(edge(0, 1), edge(1, 1), v), w)
}

/// The polynomial 6 t⁵ - 15 t⁴ + 10 t³ from 0 to 1, whose first and second derivatives are 0 at both ends.
fn fade<R: Real>(t: R) -> R {
    t * t * t * (t * (t * R::from_u16(6) - R::from_u16(15)) + R::from_u16(10))
}

/// The dot product of (x, y, z) with one of twelve vectors: those from the center of a cube to the middles of
/// its edges.
fn slope<R: Real>(hash: u32, x: R, y: R, z: R) -> R {
    let (first, second) = match hash >> 28 {
        0..=3 => (x, y),
        4..=7 => (x, z),
        8..=11 => (y, z),
        // 16 hash values for 12 vectors: four vectors occur twice, chosen so that the set stays symmetric.
        12 | 14 => (y, x),
        _ => (y, z),
    };
    let signed = |value: R, bit: u32| if hash & bit == 0 { value } else { -value };
    signed(first, 1 << 26) + signed(second, 1 << 27)
}

/// Combines the three numbers of a cell by primes (Teschner et al., "Optimized Spatial Hashing", VMV 2003),
/// and mixes the bits by two products (Wellons, "Prospecting for Hash Functions", 2018).
fn hash([x, y, z]: [i32; 3], seed: u32) -> u32 {
    let mut hash = (x as u32).wrapping_mul(73_856_093)
        ^ (y as u32).wrapping_mul(19_349_663)
        ^ (z as u32).wrapping_mul(83_492_791)
        ^ seed.wrapping_mul(0x9E37_79B9);
    hash = (hash ^ hash >> 16).wrapping_mul(0x7FEB_352D);
    hash = (hash ^ hash >> 15).wrapping_mul(0x846C_A68B);
    hash ^ hash >> 16
}

/// A smooth wave of length 1, 0 at integers and 1 halfway between them: within 0.011 of (1 - cos 2πt) / 2.
pub(super) fn wave<R: Real>(at: LatticeCoordinate<R>) -> R {
    let doubled = at.within + at.within;
    let t = if doubled > R::ONE { R::ONE + R::ONE - doubled } else { doubled };
    t * t * (R::from_u16(3) - t - t)
}

/// Refuses a turbulence outside 0 to 16, with which coordinates could leave the range of the number system.
pub(super) fn check_turbulence<R: Real>(turbulence: f32) -> Result<R, Fault> {
    if (0.0..=16.0).contains(&turbulence) { Ok(R::from_f32(turbulence)) } else { Err(Fault::Turbulence) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    fn at<R: Real>(x: f32, y: f32, z: f32) -> [LatticeCoordinate<R>; 3] {
        [x, y, z].map(|value| R::from_f32(value).split())
    }

    #[test]
    fn noise_is_zero_at_corners_and_continuous_between() {
        for corner in [(0.0, 0.0, 0.0), (-3.0, 5.0, 100.0)] {
            assert_eq!(noise(at::<f32>(corner.0, corner.1, corner.2), 0), 0.0);
        }
        let (mut previous, mut least, mut most) = (0.0, 0f32, 0f32);
        for step in -5000..5000 {
            let x = step as f32 / 100.0;
            let value = noise(at::<f32>(x, 0.37 * x, 1.7), 0);
            assert!(step == -5000 || (value - previous).abs() < 0.05, "a jump at {x}");
            (least, most) = (least.min(value), most.max(value));
            previous = value;
        }
        assert!(-1.04 < least && least < -0.5 && 0.5 < most && most < 1.04, "{least} to {most}");
    }

    #[test]
    fn its_mean_is_zero() {
        let mut sum = 0.0;
        for step in 0..40_000 {
            let x = step as f32 * 0.377;
            sum += noise(at::<f32>(x % 50.0, x / 97.0, x * 0.013), 1);
        }
        assert!((sum / 40_000.0).abs() < 0.02, "{sum}");
    }

    #[test]
    fn number_systems_agree() {
        for step in 0..5000 {
            let x = step as f32 * 0.0137 - 30.0;
            let exact = octaves(at::<f64>(x, 0.3 - x, 0.1 * x), 4);
            let single = octaves(at::<f32>(x, 0.3 - x, 0.1 * x), 4);
            let fixed = octaves(at::<Fixed>(x, 0.3 - x, 0.1 * x), 4);
            assert!((f64::from(single) - exact).abs() < 1e-4, "{x}: {single}, not {exact}");
            assert!((f64::from(fixed.to_f32()) - exact).abs() < 1e-4, "{x}: {fixed:?}, not {exact}");
        }
    }

    #[test]
    fn waves_are_almost_cosines() {
        for step in 0..1000 {
            let t = step as f32 / 1000.0;
            let cosine = (1.0 - (t * core::f32::consts::TAU).cos()) / 2.0;
            assert!((wave(t.split()) - cosine).abs() < 0.0101);
        }
    }

    #[test]
    fn octaves_and_turbulence_have_bounds() {
        assert_eq!((check_octaves(0), check_octaves(9)), (Err(Fault::Octaves), Err(Fault::Octaves)));
        for bad in [-0.1, 17.0, f32::NAN] {
            assert_eq!(check_turbulence::<f32>(bad), Err(Fault::Turbulence));
        }
    }
}
