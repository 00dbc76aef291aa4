//! Light from all around, at the points of a grid in space: an irradiance volume (Greger, Shirley, Hubbard
//! and Greenberg, "The Irradiance Volume", 1998).

use super::blend;
use super::placement::{Placement, Space};
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::math::{LatticeCoordinate, Real, Vec3};

/// Light that arrives from all around, at the points of a grid in space and in any direction: for things that
/// move in light that was computed before.
///
/// Its [`Placement`] is in the scene and not turned: its origin is the first point of the grid, and its size
/// is the distance of neighboring points. Between points, light is interpolated; beyond the grid, it is that
/// of the nearest point on its border.
///
/// At each point, the light on a surface with the unit normal n is `mean + n.x · x + n.y · y + n.z · z`:
/// spherical harmonics of the first order, multiplied by those of the cosine (Ramamoorthi and Hanrahan, "An
/// Efficient Representation for Irradiance Environment Maps", 2001).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IrradianceVolume<'a> {
    /// The number of points along x, y and z: 1 or more.
    pub counts: [u8; 3],
    /// Red, green and blue of `mean`, then of `x`, `y` and `z`, each as its share of 32767: for all points,
    /// along x first, then along y.
    pub light: &'a [[i16; 12]],
}

#[cfg(feature = "serde")]
crate::read::read_struct!([] IrradianceVolume as IrradianceVolume<'m> { counts, light });

impl IrradianceVolume<'_> {
    /// Refuses a wrong number of points, and a placement on a surface or turned.
    pub(super) fn check(&self, placement: &Placement) -> Result<(), Fault> {
        let [x, y, z] = self.counts.map(usize::from);
        let (needed, given) = (x.saturating_mul(y).saturating_mul(z), self.light.len());
        if given != needed || given == 0 {
            return Err(Fault::PointCount { needed, given });
        }
        if placement.space != Space::Scene || placement.rotation != Vec3::ZERO {
            return Err(Fault::TurnedVolume);
        }
        Ok(())
    }

    /// The light on a surface with this unit normal, at a place in units of the grid.
    pub(super) fn color<R: Real>(&self, at: [LatticeCoordinate<R>; 3], normal: Vec3<R>) -> LinearRgb<R> {
        let [(x, across), (y, up), (z, along)] = [0, 1, 2].map(|axis| self.between(at, axis));
        let row = |y, z| {
            let [first, second] = x.map(|x| self.point([x, y, z], normal));
            blend(first, second, across)
        };
        let plane = |z| {
            let [lower, upper] = y.map(|y| row(y, z));
            blend(lower, upper, up)
        };
        let [near, far] = z.map(plane);
        let LinearRgb { r, g, b } = blend(near, far, along);
        // Where light comes from one side alone, the other side is darker than black.
        LinearRgb::new(r.larger(R::ZERO), g.larger(R::ZERO), b.larger(R::ZERO))
    }

    /// The points before and behind a coordinate, and the share of the one behind.
    fn between<R: Real>(&self, at: [LatticeCoordinate<R>; 3], axis: usize) -> ([usize; 2], R) {
        let count = self.counts.get(axis).copied().unwrap_or(1);
        let last = usize::from(count.saturating_sub(1));
        let Some(LatticeCoordinate { index, within }) = at.get(axis).copied() else {
            return ([0; 2], R::ZERO);
        };
        match usize::try_from(index) {
            Err(_) => ([0; 2], R::ZERO),
            Ok(index) if index >= last => ([last; 2], R::ZERO),
            Ok(index) => ([index, index.wrapping_add(1)], within),
        }
    }

    /// The light at a point of the grid; black where the list ends before it.
    fn point<R: Real>(&self, [x, y, z]: [usize; 3], normal: Vec3<R>) -> LinearRgb<R> {
        let [columns, rows, _] = self.counts.map(usize::from);
        let index = z.wrapping_mul(rows).wrapping_add(y).wrapping_mul(columns).wrapping_add(x);
        let Some(light) = self.light.get(index) else { return LinearRgb::BLACK };
        let share = |value: i16| {
            let share = R::from_fraction(value.unsigned_abs().wrapping_mul(2));
            if value < 0 { -share } else { share }
        };
        let [r, g, b, rx, gx, bx, ry, gy, by, rz, gz, bz] = light.map(share);
        LinearRgb::new(
            r + normal.dot(Vec3::new(rx, ry, rz)),
            g + normal.dot(Vec3::new(gx, gy, gz)),
            b + normal.dot(Vec3::new(bx, by, bz)),
        )
    }
}
