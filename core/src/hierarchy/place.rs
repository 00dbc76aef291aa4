//! The test of boxes against a point, in every number system.

use super::{BoxTest, Node};
use crate::math::{Real, Vec3};

/// A point, with room for its rounding.
pub(super) struct Place<R> {
    /// The lower planes of a box must not be above this.
    upper: Vec3<R>,
    /// The upper planes of a box must not be below this.
    lower: Vec3<R>,
}

impl<R: Real> Place<R> {
    #[inline]
    pub(super) fn new(point: Vec3<R>, margin: R) -> Self {
        let margin = Vec3::new(margin, margin, margin);
        Self { upper: point + margin, lower: point - margin }
    }
}

impl<R: Real, const W: usize> BoxTest<R, W> for Place<R> {
    fn any_met(&self, node: &Node<R, W>, mut visit: impl FnMut(usize) -> bool) -> bool {
        let Self { upper, lower } = *self;
        let holds = |slot| {
            let [min, max] = node.corners(slot);
            min.x <= upper.x
                && min.y <= upper.y
                && min.z <= upper.z
                && max.x >= lower.x
                && max.y >= lower.y
                && max.z >= lower.z
        };
        (0..W).any(|slot| holds(slot) && visit(slot))
    }
}
