//! Facets are clipped by the sides of the picture and by the nearest depth (Sutherland and Hodgman,
//! "Reentrant Polygon Clipping", CACM 1974): before the projection, where no division can fail.

use heapless::Vec;

use super::corner::Corner;
use crate::math::Real;

/// A convex polygon: each of the five planes can add a corner to the triangle.
pub(super) type Polygon<R> = Vec<Corner<R>, 8>;

/// The part of a triangle that lies in the picture, and no nearer than this.
pub(super) fn clipped<R: Real>(corners: &[Corner<R>; 3], nearest: R) -> Polygon<R> {
    let mut polygon = Polygon::new();
    for corner in corners {
        // There is room.
        let _ = polygon.push(*corner);
    }
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
        polygon = cut(&polygon, |corner| inside(corner, plane));
    }
    polygon
}

/// The part of a polygon where `inside` is not negative.
fn cut<R: Real>(polygon: &Polygon<R>, inside: impl Fn(&Corner<R>) -> R) -> Polygon<R> {
    let mut left = Polygon::new();
    let Some(mut from) = polygon.last() else { return left };
    let mut from_inside = inside(from);
    for to in polygon {
        let to_inside = inside(to);
        if (from_inside < R::ZERO) != (to_inside < R::ZERO) {
            // From the same end in both directions, so that facets that share an edge share the cut.
            let (near, far, a, b) = if from_inside < R::ZERO {
                (from, to, from_inside, to_inside)
            } else {
                (to, from, to_inside, from_inside)
            };
            let _ = left.push(near.toward(far, a / (a - b)));
        }
        if to_inside >= R::ZERO {
            let _ = left.push(*to);
        }
        (from, from_inside) = (to, to_inside);
    }
    left
}
