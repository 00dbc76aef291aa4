//! Checkers: cells of two colors that alternate.

use super::check_reflectivity;
use crate::color::LinearRgb;
use crate::fault::{Fault, check_finite};
use crate::math::{LatticeCoordinate, Real, Scale, Vec3};

/// A checker in space: cells of two colors that alternate.
///
/// A point lies in cell number `floor(coordinate · cells_per_unit)` along each axis. Cells with an even sum
/// of the three numbers have the color `even`. An axis with 0 cells per unit is ignored, so that a horizontal
/// floor, checkered along x and z alone, does not flicker with the rounding of its height.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Checker {
    /// The color of the cell from the origin to (1, 1, 1) cells.
    pub even: LinearRgb,
    /// The color of its neighbors.
    pub odd: LinearRgb,
    /// Cells per unit of length along each axis; at most 1e6, and 0 where the axis is ignored.
    pub cells_per_unit: Vec3,
}

/// The most cells per unit of length.
const MAX_CELLS: f32 = 1e6;

impl Checker {
    /// Squares with sides of `size` units in the x-z plane.
    pub const fn xz(even: LinearRgb, odd: LinearRgb, size: f32) -> Self {
        Self { even, odd, cells_per_unit: Vec3::new(1.0 / size, 0.0, 1.0 / size) }
    }

    pub(super) fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedChecker<R>, Fault> {
        let Vec3 { x, y, z } = self.cells_per_unit;
        for cells in [x, y, z] {
            // Pixels show only noise of smaller cells. An infinite number of cells, of size 0, is refused
            // here as well.
            if cells.abs() > MAX_CELLS {
                return Err(Fault::PatternSize);
            }
            check_finite(cells)?;
        }
        // The scale is a power of two: nothing is rounded.
        let per_unit = self.cells_per_unit * (1.0 / scale.to_f32());
        Ok(PreparedChecker {
            even: check_reflectivity(self.even)?,
            odd: check_reflectivity(self.odd)?,
            cells_per_unit: [per_unit.x, per_unit.y, per_unit.z].map(R::factor),
        })
    }
}

/// A [`Checker`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedChecker<R: Real> {
    even: LinearRgb<R>,
    odd: LinearRgb<R>,
    cells_per_unit: [R::Factor; 3],
}

impl<R: Real> PreparedChecker<R> {
    #[inline]
    fn cells(&self, point: Vec3<R>) -> [i32; 3] {
        let [x, y, z] = self.cells_per_unit;
        [point.x.cell(x), point.y.cell(y), point.z.cell(z)]
    }

    #[inline]
    pub(super) fn color(&self, point: Vec3<R>) -> LinearRgb<R> {
        let [x, y, z] = self.cells(point);
        if (x ^ y ^ z) & 1 == 0 { self.even } else { self.odd }
    }

    pub(super) fn cell(&self, point: Vec3<R>) -> u32 {
        mark(self.cells(point))
    }
}

/// A number for a cell that differs from the numbers of its neighbors.
pub(super) fn mark(cells: [i32; 3]) -> u32 {
    let [x, y, z] = cells.map(|cell| cell as u32);
    x ^ y.wrapping_mul(0x9E37_79B9) ^ z.wrapping_mul(0x85EB_CA6B)
}

/// Cells of two colors that alternate along all axes of a pattern: squares over u and v.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Squares<R = f32> {
    /// The color of the cell from the pattern's origin to (1, 1, 1).
    pub even: LinearRgb<R>,
    /// The color of its neighbors.
    pub odd: LinearRgb<R>,
}

impl Squares {
    pub(super) fn prepare<R: Real>(&self) -> Result<Squares<R>, Fault> {
        Ok(Squares { even: check_reflectivity(self.even)?, odd: check_reflectivity(self.odd)? })
    }
}

impl<R: Real> Squares<R> {
    pub(super) fn color(&self, [x, y, z]: [LatticeCoordinate<R>; 3]) -> LinearRgb<R> {
        if (x.index ^ y.index ^ z.index) & 1 == 0 { self.even } else { self.odd }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checker_alternates_through_zero_and_ignores_height() {
        let checker =
            Checker::xz(LinearRgb::WHITE, LinearRgb::gray(0.0), 2.0).prepare::<f32>(Scale::ONE).unwrap();
        let white_at = |x, y, z| checker.color(Vec3::new(x, y, z)).r == 1.0;
        for y in [-4.0, -4.0001, 3.0] {
            assert!(white_at(1.0, y, 1.0));
            assert!(!white_at(-1.0, y, 1.0));
            assert!(white_at(-1.0, y, -1.0));
            assert!(!white_at(3.0, y, 1.0));
        }
    }
}
