//! Color that varies over a surface.

use core::convert::Infallible;
use core::marker::PhantomData;

use crate::color::LinearRgb;
use crate::fault::{Fault, check_coordinate, check_point};
use crate::math::{Real, Scale, Vec3};
use crate::surface::Surface;

/// The color of a material at each point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Texture<'a> {
    /// The same color everywhere.
    Solid(LinearRgb),
    /// Two colors in alternating cells.
    Checker(Checker),
    /// What borrows from flash comes here: nothing yet.
    #[doc(hidden)]
    Borrowed(Infallible, PhantomData<&'a ()>),
}

/// Cells of two colors that alternate in space.
///
/// The cell of a point is counted along each axis, `floor(point · cells_per_unit)`; where the sum of the
/// three is even the cell has the color `even`. An axis with 0 cells per unit does not count, so that a
/// horizontal floor is checkered by x and z alone and cannot flicker with its height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    /// Color of the cell between the origin and (1, 1, 1) cells.
    pub even: LinearRgb,
    /// Color of its neighbors.
    pub odd: LinearRgb,
    /// Cells per unit of length along each axis.
    pub cells_per_unit: Vec3,
}

impl<'a> Texture<'a> {
    /// A checker of squares with sides of `size` units in the x-z plane.
    pub const fn checker_xz(even: LinearRgb, odd: LinearRgb, size: f32) -> Self {
        Self::Checker(Checker { even, odd, cells_per_unit: Vec3::new(1.0 / size, 0.0, 1.0 / size) })
    }

    /// Checks the texture and converts it.
    pub(crate) fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedTexture<'a, R>, Fault> {
        match self {
            Self::Solid(color) => Ok(PreparedTexture::Solid(check_reflectivity(*color)?)),
            Self::Checker(checker) => {
                check_point(checker.cells_per_unit)?;
                // A power of two: nothing is rounded.
                let per_unit = checker.cells_per_unit * (1.0 / scale.to_f32());
                Ok(PreparedTexture::Checker {
                    even: check_reflectivity(checker.even)?,
                    odd: check_reflectivity(checker.odd)?,
                    cells_per_unit: [per_unit.x, per_unit.y, per_unit.z].map(R::factor),
                })
            }
            Self::Borrowed(never, _) => match *never {},
        }
    }
}

impl From<LinearRgb> for Texture<'_> {
    fn from(color: LinearRgb) -> Self {
        Self::Solid(color)
    }
}

fn check_reflectivity<R: Real>(color: LinearRgb) -> Result<LinearRgb<R>, Fault> {
    for value in [color.r, color.g, color.b] {
        check_coordinate(value)?;
        if value < 0.0 {
            return Err(Fault::NegativeColor);
        }
        if value > 1.0 {
            return Err(Fault::OutsideUnit);
        }
    }
    Ok(color.to())
}

/// A texture that was checked and converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PreparedTexture<'m, R: Real> {
    Solid(LinearRgb<R>),
    Checker {
        even: LinearRgb<R>,
        odd: LinearRgb<R>,
        cells_per_unit: [R::Factor; 3],
    },
    #[allow(dead_code)] // nothing borrows yet
    Borrowed(Infallible, PhantomData<&'m ()>),
}

impl<R: Real> PreparedTexture<'_, R> {
    /// A number for the cell where a ray met a surface: other cells nearby have others. `None` where there are none.
    pub(crate) fn cell(&self, surface: &Surface<R>) -> Option<u32> {
        match self {
            Self::Solid(_) => None,
            Self::Checker { cells_per_unit: [x, y, z], .. } => {
                let point = surface.point;
                let [x, y, z] =
                    [point.x.cell(*x), point.y.cell(*y), point.z.cell(*z)].map(|cell| cell as u32);
                Some(x ^ y.wrapping_mul(0x9E37_79B9) ^ z.wrapping_mul(0x85EB_CA6B))
            }
            Self::Borrowed(never, _) => match *never {},
        }
    }

    /// The color where a ray met a surface.
    pub(crate) fn color(&self, surface: &Surface<R>) -> LinearRgb<R> {
        match self {
            Self::Solid(color) => *color,
            Self::Checker { even, odd, cells_per_unit } => {
                let ([x, y, z], point) = (cells_per_unit, surface.point);
                let sum = point.x.cell(*x) ^ point.y.cell(*y) ^ point.z.cell(*z);
                if sum & 1 == 0 { *even } else { *odd }
            }
            Self::Borrowed(never, _) => match *never {},
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checker_alternates_through_zero_and_ignores_height() {
        let checker = Texture::checker_xz(LinearRgb::WHITE, LinearRgb::gray(0.0), 2.0)
            .prepare::<f32>(Scale::ONE)
            .unwrap();
        let white_at = |x, y, z| {
            let point = Vec3::new(x, y, z);
            let normal = Vec3::new(0.0, 1.0, 0.0);
            checker.color(&Surface { point, normal, shading_normal: normal, magnitude: 1.0, part: 0 }).r
                == 1.0
        };
        for y in [-4.0, -4.0001, 3.0] {
            assert!(white_at(1.0, y, 1.0));
            assert!(!white_at(-1.0, y, 1.0));
            assert!(white_at(-1.0, y, -1.0));
            assert!(!white_at(3.0, y, 1.0));
        }
    }
}
