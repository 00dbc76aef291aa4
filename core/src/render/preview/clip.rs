//! Facets are clipped by the sides of the picture and by the nearest depth: before the projection, where no
//! division can fail.

use heapless::Vec;

use super::corner::Corner;
use crate::math::Real;
use crate::shape::{cut, list};

/// A convex polygon: each of the five planes can add a corner to the triangle.
pub(super) type Polygon<R> = Vec<Corner<R>, 8>;

/// The part of a triangle that lies in the picture, and no nearer than this.
pub(super) fn clipped<R: Real>(corners: &[Corner<R>; 3], nearest: R) -> Polygon<R> {
    let mut polygon: Polygon<R> = list(corners.iter().copied());
    let inside = |corner: &Corner<R>, plane: u32| match plane {
        0 => corner.depth - nearest,
        1 => corner.across[0] + corner.edge[0],
        2 => corner.edge[0] - corner.across[0],
        3 => corner.across[1] + corner.edge[1],
        _ => corner.edge[1] - corner.across[1],
    };
    for plane in 0..5 {
        if polygon.iter().all(|corner| inside(corner, plane) >= R::ZERO) {
            continue;
        }
        polygon = cut(&polygon, |corner| -inside(corner, plane), Corner::toward);
    }
    polygon
}
