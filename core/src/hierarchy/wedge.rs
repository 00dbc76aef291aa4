//! The test of boxes against the space between two planes through a point, such as those through the eye and
//! two lines of a picture.

use super::{BoxTest, Node};
use crate::math::{Real, Vec3};

/// All points on the positive sides of two planes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wedge<R> {
    /// A point of both planes.
    pub(crate) edge: Vec3<R>,
    /// The normals of the planes, which point to their positive sides.
    pub(crate) normals: [Vec3<R>; 2],
}

impl<R: Real, const W: usize> BoxTest<R, W> for Wedge<R> {
    fn any_met(&self, node: &Node<R, W>, mut visit: impl FnMut(usize) -> bool) -> bool {
        let Self { edge, normals } = *self;
        let reaches = |slot| {
            let [min, max] = node.corners(slot).map(|corner| corner - edge);
            normals.iter().all(|normal| {
                // Test the corner that is farthest along the normal.
                let farther = |along: R, min: R, max: R| if along > R::ZERO { max } else { min };
                let corner = Vec3::new(
                    farther(normal.x, min.x, max.x),
                    farther(normal.y, min.y, max.y),
                    farther(normal.z, min.z, max.z),
                );
                corner.dot(*normal) >= R::ZERO
            })
        };
        (0..W).any(|slot| reaches(slot) && visit(slot))
    }
}
