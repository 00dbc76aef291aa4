//! The outline of a flat convex face, cut by planes (Sutherland and Hodgman, "Reentrant Polygon Clipping",
//! Communications of the ACM, 1974).

use heapless::Vec;

use crate::limits::MAX_FACES;
use crate::math::{Real, Vec3};

/// The corners of a convex face, counterclockwise. A square has four, and each plane that cuts a corner off
/// adds one.
pub(super) struct Outline<R>(Vec<Vec3<R>, { MAX_FACES + 4 }>);

impl<R: Real> Outline<R> {
    /// A square with this unit normal, whose sides are `reach` away from its middle.
    pub(super) fn square(middle: Vec3<R>, normal: Vec3<R>, reach: R) -> Self {
        let (first, second) = normal.around();
        let (right, up) = (first * reach, second * reach);
        let corners = [-right - up, right - up, right + up, up - right];
        Self(corners.into_iter().map(|corner| middle + corner).collect())
    }

    /// Cuts off what lies in front of the plane `normal · p = distance`.
    pub(super) fn clip(&mut self, normal: Vec3<R>, distance: R) {
        let height = |corner: Vec3<R>| normal.dot(corner) - distance;
        let mut kept = Vec::new();
        let Some(mut from) = self.0.last().copied() else { return };
        let mut from_height = height(from);
        for to in &self.0 {
            let to_height = height(*to);
            if (from_height > R::ZERO) != (to_height > R::ZERO) {
                // The heights have different signs, or one of them is 0.
                let share = from_height / (from_height - to_height);
                // There is room: see above.
                let _ = kept.push(from + (*to - from) * share);
            }
            if !(to_height > R::ZERO) {
                let _ = kept.push(*to);
            }
            (from, from_height) = (*to, to_height);
        }
        self.0 = kept;
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
        self.0.iter().map(|corner| Vec3::from_setup(*corner)).collect()
    }
}
