//! Convex polygons, cut by planes (Sutherland and Hodgman, "Reentrant Polygon Clipping", Communications of
//! the ACM, 1974).

use heapless::Vec;

use crate::limits::MAX_FACES;
use crate::math::{Real, Vec3};

/// The part of a polygon where `outside` is not positive. Where an edge crosses the plane, `between` returns
/// a corner on the way from its first argument to its second, at a share of 0 to 1.
///
/// There must be room for one more corner. Polygons that share an edge share the cut, too: the way leads from
/// the outer end of the edge to the inner one, for both.
pub(crate) fn cut<C: Copy, R: Real, const N: usize>(
    polygon: &Vec<C, N>,
    outside: impl Fn(&C) -> R,
    between: impl Fn(&C, &C, R) -> C,
) -> Vec<C, N> {
    let mut kept = Vec::new();
    let Some(mut from) = polygon.last() else { return kept };
    let mut from_outside = outside(from);
    for to in polygon {
        let to_outside = outside(to);
        if (from_outside > R::ZERO) != (to_outside > R::ZERO) {
            let (outer, inner, a, b) = if from_outside > R::ZERO {
                (from, to, from_outside, to_outside)
            } else {
                (to, from, to_outside, from_outside)
            };
            // Only one of the two is positive.
            let _ = kept.push(between(outer, inner, a / (a - b)));
        }
        if !(to_outside > R::ZERO) {
            let _ = kept.push(*to);
        }
        (from, from_outside) = (to, to_outside);
    }
    kept
}

/// The corners of a convex face, counterclockwise. A square has four, and each plane that cuts a corner off
/// adds one.
pub(super) struct Outline<R>(Vec<Vec3<R>, { MAX_FACES + 4 }>);

impl<R: Real> Outline<R> {
    /// A square with this unit normal, whose sides are `reach` away from its middle.
    pub(super) fn square(middle: Vec3<R>, normal: Vec3<R>, reach: R) -> Self {
        let (first, second) = normal.around();
        let (right, up) = (first * reach, second * reach);
        let corners = [-right - up, right - up, right + up, up - right];
        Self(list(corners.into_iter().map(|corner| middle + corner)))
    }

    /// Cuts off what lies in front of the plane `normal · p = distance`.
    pub(super) fn clip(&mut self, normal: Vec3<R>, distance: R) {
        let height = |corner: &Vec3<R>| normal.dot(*corner) - distance;
        self.0 = cut(&self.0, height, |outer, inner, share| *outer + (*inner - *outer) * share);
    }

    /// Joins corners that are no farther from each other than `tolerance`.
    pub(super) fn join(&mut self, tolerance: R) {
        let Some(mut last) = self.0.last().copied() else { return };
        self.0.retain(|corner| {
            let is_apart = (*corner - last).magnitude() > tolerance;
            last = if is_apart { *corner } else { last };
            is_apart
        });
    }

    /// The corners in another number system.
    pub(super) fn rounded<T: Real<Setup = R>>(&self) -> Vec<Vec3<T>, { MAX_FACES + 4 }> {
        list(self.0.iter().map(|corner| Vec3::from_setup(*corner)))
    }
}

/// The items for which there is room. `collect` would panic at one item too many, and the compiler cannot
/// prove that there is no such item.
pub(crate) fn list<T, const N: usize>(items: impl Iterator<Item = T>) -> Vec<T, N> {
    let mut list = Vec::new();
    for item in items.take(N) {
        let _ = list.push(item);
    }
    list
}
