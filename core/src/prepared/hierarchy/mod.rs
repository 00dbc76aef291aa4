//! Boxes around objects, and boxes around those boxes: a ray that misses a box meets nothing in it. Nine times the
//! objects, 820 balls for 91, then cost 1.33 times the instructions for each ray.
//!
//! Scenes with more objects than an [`ObjectSet`] holds have a hierarchy. It is stored depth first, in nodes of 28
//! bytes in `f32`; with no fewer than two objects in a leaf there are fewer nodes than objects, so that it takes at most
//! 30 bytes for each. How it is built: see [`build`]. How a box is tested: see [`segment`].
//!
//! A picture has the same bytes with and without: no box is left out that a hit might lie in, and of several objects at
//! the same distance the lowest position counts, whichever box is visited first.

mod axis;
mod build;
mod segment;
#[cfg(test)]
mod tests;

use super::PreparedObject;
use super::candidates::ObjectSet;
use crate::arena::Arena;
use crate::fault::Fault;
use crate::limits::MAX_HIERARCHY_DEPTH;
use crate::math::{Ray, Real, Vec3};
use crate::shape::Intersect;
use axis::Axis;
use segment::Segment;

/// The objects of a scene by where they are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hierarchy<'m, R> {
    /// All nodes; the first is the root. What comes after the last is never visited.
    nodes: &'m [Node<R>],
    /// The positions of all objects: first those without bounds, then leaf by leaf.
    order: &'m [u16],
    /// How many have no bounds.
    unbounded: usize,
}

/// A box, and what lies in it.
#[derive(Clone, Copy, Debug)]
struct Node<R> {
    center: Vec3<R>,
    /// From the center to the sides.
    reach: Vec3<R>,
    content: Content,
}

const _: () = assert!(size_of::<Node<f32>>() == 28);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Content {
    /// So many positions of the order, from `first` on.
    Objects { count: u8, first: u16 },
    /// Two nodes: the one right behind this and `second`, which lies farther along the axis.
    Nodes { axis: Axis, second: u16 },
}

impl<'m, R: Real> Hierarchy<'m, R> {
    /// For how many objects a hierarchy is stored: none where a scene has sets of candidates.
    const fn stored(objects: usize) -> usize {
        if objects > ObjectSet::CAPACITY { objects } else { 0 }
    }

    /// How many bytes the hierarchy of a scene takes.
    pub(super) const fn bytes(objects: usize) -> usize {
        let objects = Self::stored(objects);
        Arena::bytes::<Node<R>>(objects).saturating_add(Arena::bytes::<u16>(objects))
    }

    /// Builds the hierarchy, unless the scene has few objects.
    pub(super) fn new<P: Intersect<R>>(
        objects: &[PreparedObject<'_, R, P>],
        arena: &mut Arena<'m>,
    ) -> Result<Option<Self>, Fault> {
        if Self::stored(objects.len()) == 0 {
            return Ok(None);
        }
        let bounds = |object: u16| objects.get(usize::from(object)).and_then(|object| object.shape.bounds());
        build::build(objects.len(), bounds, arena).map(Some)
    }

    /// Calls `test` for all objects that a ray can meet at a distance of at most `max`, and for some more: near ones
    /// first, roughly. It says what the largest distance is from then on, or `None` to stop. Returns whether it stopped.
    #[inline]
    pub(super) fn walk(&self, ray: &Ray<R>, mut max: R, mut test: impl FnMut(usize) -> Option<R>) -> bool {
        for object in self.order.iter().take(self.unbounded) {
            match test(usize::from(*object)) {
                Some(nearer) => max = nearer,
                None => return true,
            }
        }
        let mut segment = Segment::new(ray, max);
        // A node is put off for each that contains the one visited: at most as many as the tree is deep.
        let mut put_off = [0; MAX_HIERARCHY_DEPTH];
        let mut count = 0usize;
        let mut visited = 0;
        loop {
            let node = self.nodes.get(usize::from(visited));
            match node.filter(|node| segment.meets(node)).map(|node| node.content) {
                Some(Content::Nodes { axis, second }) => {
                    let first = visited + 1;
                    let backward = axis.of(ray.direction) < R::ZERO;
                    let (near, far) = if backward { (second, first) } else { (first, second) };
                    debug_assert!(count < put_off.len(), "deeper than the builder allows");
                    if let Some(place) = put_off.get_mut(count) {
                        *place = far;
                        count += 1;
                    }
                    visited = near;
                    continue;
                }
                Some(Content::Objects { count, first }) => {
                    for object in self.order.iter().skip(usize::from(first)).take(usize::from(count)) {
                        match test(usize::from(*object)) {
                            Some(nearer) => segment.end_at(nearer),
                            None => return true,
                        }
                    }
                }
                None => {}
            }
            count = match count.checked_sub(1) {
                Some(count) => count,
                None => return false,
            };
            visited = put_off.get(count).copied().unwrap_or(0);
        }
    }
}
