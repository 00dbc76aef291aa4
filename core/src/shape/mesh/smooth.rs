//! Normals at vertices, in half of the memory of a vector.

use crate::fault::{Fault, check_numbers, unit};
use crate::math::{Real, Vec3};

/// A unit vector, rounded to 16 bits for each coordinate: its error is a thousandth of a degree. Zero if the
/// normal was zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SmallNormal(pub [i16; 3]);

/// The coordinates are in units of one over this.
const UNITS: f32 = 32767.0;

impl SmallNormal {
    /// The direction of a vector of any length.
    pub(super) fn new<F: Real<Setup = F>>(normal: Vec3) -> Result<Self, Fault> {
        check_numbers(normal)?;
        let Vec3 { x, y, z } = unit::<F>(normal).unwrap_or(Vec3::ZERO);
        let half = F::from_f32(0.5);
        Ok(Self([x, y, z].map(|share| (share * F::from_f32(UNITS) + half).floor_to_i32() as i16)))
    }

    /// Half of the unit vector: exact in fixed point.
    pub(super) fn half<R: Real>(self) -> Vec3<R> {
        let [x, y, z] = self.0.map(|units| {
            let size = R::from_fraction(units.unsigned_abs());
            if units < 0 { -size } else { size }
        });
        Vec3::new(x, y, z)
    }
}
