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
        let Some([a, b, c]) = self.planes(triangle) else { return R::ZERO };
        let above = |(corner, half): (Vec3<R>, Vec3<R>)| {
            let slope = half.dot(facing);
            let outward = if slope < R::ZERO { -half } else { half };
            // Half of the height above the point, times half of the slope.
            (corner - point).dot(outward).larger(R::ZERO) * slope.abs()
        };
        let Meeting { b: weight_b, c: weight_c, .. } = meeting;
        let weight_a = R::ONE - weight_b - weight_c;
        let quarter = above(a) * weight_a + above(b) * weight_b + above(c) * weight_c;
        quarter * R::from_u16(4)
    }

    /// A bound of all lifts and of their rounding: no corner's plane rises higher above another corner.
    pub(super) fn highest_lift(&self) -> R {
        let mut highest = R::ZERO;
        for triangle in 0..self.triangles.len() {
            let Some(planes) = self.planes(triangle as u16) else { continue };
            if normal(planes.map(|(corner, _)| corner)).is_none() {
                continue;
            }
            for (corner, half) in planes {
                for (other, _) in planes {
                    highest = highest.larger((corner - other).dot(half).abs());
                }
            }
        }
        highest * R::from_u16(2) + R::offset(self.bounds.magnitude())
    }

    /// The planes at the corners of a triangle: each corner, and half of its unit normal.
    fn planes(&self, triangle: u16) -> Option<[(Vec3<R>, Vec3<R>); 3]> {
        let ([a, b, c], [at_a, at_b, at_c]) = (self.corners(triangle)?, self.half_normals(triangle)?);
        Some([(a, at_a), (b, at_b), (c, at_c)])
    }
}
