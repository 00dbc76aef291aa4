//! A coordinate on the lattice of whole numbers: the number of its cell, and the place within the cell.

use super::Real;

/// A coordinate on the lattice of whole numbers: the number of its cell, and the place within the cell. The
/// place keeps all its digits, however far out the cell is. Textures are functions of such coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatticeCoordinate<R> {
    /// The largest whole number not above the coordinate. Beyond the range of `i32` it wraps or saturates.
    pub index: i32,
    /// The distance from there to the coordinate: at least 0, less than 1.
    pub within: R,
}

impl<R: Real> LatticeCoordinate<R> {
    /// The coordinate moved by a number of a few units.
    pub fn plus(self, offset: R) -> Self {
        let moved = (self.within + offset).split();
        Self { index: self.index.wrapping_add(moved.index), ..moved }
    }

    /// Twice the coordinate.
    pub fn doubled(self) -> Self {
        let doubled = (self.within + self.within).split();
        Self { index: self.index.wrapping_mul(2).wrapping_add(doubled.index), ..doubled }
    }

    /// The coordinate as a number, clamped to ±60.
    pub fn number(self) -> R {
        if self.index < -60 {
            -R::from_u16(60)
        } else if self.index >= 60 {
            R::from_u16(60)
        } else {
            let whole = R::from_u16(self.index.unsigned_abs() as u16);
            (if self.index < 0 { -whole } else { whole }) + self.within
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Fixed, Linear, Vec3};

    fn assert_coordinates<R: Real>() {
        let coordinate = R::from_f32(-2.75).split();
        assert_eq!((coordinate.index, coordinate.within.to_f32()), (-3, 0.25));
        assert_eq!(coordinate.number().to_f32(), -2.75);
        let moved = coordinate.plus(R::from_f32(1.875));
        assert_eq!((moved.index, moved.within.to_f32()), (-1, 0.125));
        let doubled = R::from_f32(-2.25).split().doubled();
        assert_eq!((doubled.index, doubled.within.to_f32()), (-5, 0.5));
        assert_eq!(LatticeCoordinate { index: 1 << 30, within: R::ZERO }.number().to_f32(), 60.0);
        assert_eq!(LatticeCoordinate { index: -1 << 30, within: R::ZERO }.number().to_f32(), -60.0);
        // Far beyond what fixed point holds: 1000 cells in each unit.
        let (x, half) = (R::Setup::from_f32(1000.0), R::Setup::from_f32(0.5));
        let (zero, steep) = (R::Setup::ZERO, Vec3::new(x, R::Setup::ZERO, R::Setup::ZERO));
        let far = R::Linear::new(steep, Vec3::new(half, zero, zero));
        let at = far.split_at(Vec3::new(R::from_f32(2.125), R::ZERO, R::ZERO));
        assert_eq!((at.index, at.within.to_f32()), (1625, 0.0));
    }

    #[test]
    fn coordinates_keep_their_digits() {
        assert_coordinates::<f32>();
        assert_coordinates::<f64>();
        assert_coordinates::<Fixed>();
    }

    #[test]
    fn a_coordinate_without_digits_is_at_the_beginning_of_its_cell() {
        for value in [1e30f32, -1e30, f32::INFINITY, f32::NAN, -1e-10] {
            let within = value.split().within;
            assert!((0.0..1.0).contains(&within), "{value}: {within}");
        }
    }
}
