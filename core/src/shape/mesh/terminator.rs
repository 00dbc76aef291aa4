//! The smooth surface above the triangles, for rays that leave it (after Hanika, "Hacking the Shadow
//! Terminator", Ray Tracing Gems II, 2021, ch. 4).
//!
//! Each normal at a corner spans a plane. The surface above a point of a triangle is the mean of the three
//! planes, weighted as the normals are, and measured along the triangle's normal, so that the point keeps its
//! texture coordinates. Planes below the triangle count as the triangle itself: hollows stay where they are.
//! A shadow ray from there passes over the neighbors that are hidden behind the smooth surface.

use super::ray::Meeting;
use super::{MeshData, normal};
use crate::math::{Real, Vec3};

impl<R: Real> MeshData<'_, R> {
    /// The height of the smooth surface above a `point` of a triangle. `facing` is the triangle's unit normal
    /// on the side that counts.
    pub(super) fn lift(&self, triangle: u16, meeting: Meeting<R>, point: Vec3<R>, facing: Vec3<R>) -> R {
        let planes = || Some((self.corners(triangle)?, self.half_normals(triangle)?));
        let Some(([a, b, c], [at_a, at_b, at_c])) = planes() else { return R::ZERO };
        let above = |corner: Vec3<R>, half: Vec3<R>| {
            let slope = half.dot(facing);
            let outward = if slope < R::ZERO { -half } else { half };
            // Half of the height above the point, times half of the slope.
            (corner - point).dot(outward).larger(R::ZERO) * slope.abs()
        };
        let Meeting { b: weight_b, c: weight_c, .. } = meeting;
        let weight_a = R::ONE - weight_b - weight_c;
        let quarter = above(a, at_a) * weight_a + above(b, at_b) * weight_b + above(c, at_c) * weight_c;
        quarter * R::from_u16(4)
    }

    /// A bound of all lifts and of their rounding: no corner's plane rises higher above another corner.
    pub(super) fn highest_lift(&self) -> R {
        let mut highest = R::ZERO;
        for triangle in 0..self.triangles.len() {
            let planes = || Some((self.corners(triangle as u16)?, self.half_normals(triangle as u16)?));
            let Some((corners, half_normals)) = planes() else { continue };
            if normal(corners).is_none() {
                continue;
            }
            for (corner, half) in corners.into_iter().zip(half_normals) {
                for other in corners {
                    highest = highest.larger((corner - other).dot(half).abs());
                }
            }
        }
        let magnitude = self.bounds.magnitude();
        highest * R::from_u16(2) + R::offset(magnitude)
    }
}
