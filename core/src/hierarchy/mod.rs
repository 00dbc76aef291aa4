//! A hierarchy of boxes: boxes around objects, and boxes around those boxes. A ray that misses a box meets
//! nothing in it.
//!
//! Scenes of many objects have a hierarchy of their objects, and meshes of their triangles. A node has four
//! boxes, stored coordinate by coordinate, so that a processor that computes four numbers at once tests them
//! together (Dammertz, Hanika and Keller, "Shallow Bounding Volume Hierarchies for Fast SIMD Ray Tracing of
//! Incoherent Rays", EGSR 2008). On such processors, the hierarchy of a scene has nodes of eight boxes.
//! Meshes always have four, as they may be baked for another processor.
//!
//! The hierarchy never changes a byte of the picture: no box that might contain a hit is skipped, and of
//! several objects at the same distance the one with the lowest index counts, whichever box is visited first.
//!
//! | file | contents |
//! |---|---|
//! | [`build`] | building the hierarchy |
//! | [`slabs`] | the test of boxes against a ray, in floating point |
//! | [`segment`] | the test of boxes against a ray, in fixed point |
//! | [`beam`] | the test against a bundle of rays |
//! | [`wedge`] | the test against some lines of a picture |
//! | [`place`] | the test against a point |

mod axis;
mod beam;
mod build;
mod place;
mod segment;
mod slabs;
#[cfg(all(test, feature = "hierarchy"))]
mod tests;
mod wedge;

use heapless::Vec;

use crate::arena::Arena;
use crate::fault::Fault;
use crate::limits::MAX_HIERARCHY_DEPTH;
use crate::math::{Aabb, FOUR_AT_ONCE, Ray, Real, Vec3};
use axis::Axis;
pub(crate) use beam::Beam;
use place::Place;
use segment::Segment;
use slabs::Slabs;
pub(crate) use wedge::Wedge;

/// A hierarchy of objects, in nodes of `W` boxes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hierarchy<'m, R, const W: usize = NARROW> {
    /// All nodes; the first is the root.
    nodes: &'m [Node<R, W>],
    /// The indices of the objects: first those without bounds, then leaf by leaf.
    order: &'m [u16],
    /// The number of objects without bounds.
    unbounded: usize,
}

/// The number of boxes in a node that may be used on any processor.
pub(crate) const NARROW: usize = 4;

/// The number of boxes in a node that stays on one processor: more if that computes four numbers at once.
pub(crate) const WIDE: usize = if FOUR_AT_ONCE { 8 } else { NARROW };

/// A node: some boxes, and the contents of each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node<R, const W: usize = NARROW> {
    /// For each of x, y, z: the smallest coordinates of all boxes, and the largest.
    planes: [[[R; W]; 2]; 3],
    /// For each box the number of its objects, or [`NODE`] if it contains another node.
    count: [u8; W],
    /// For each box the place of its first object in the order, or the index of the node.
    first: [u16; W],
}

/// In place of the number of objects: the box contains a node.
const NODE: u8 = u8::MAX;

const _: () = assert!(size_of::<Node<f32>>() == 108 && size_of::<Node<f32, 8>>() == 216);

impl<R> Node<R> {
    /// A node of four boxes with these smallest and largest coordinates (x, y, z). The contents of a box are
    /// a number of objects and the place of the first; or `None` and the index of a node.
    pub const fn new(lower: [[R; 4]; 3], upper: [[R; 4]; 3], [a, b, c, d]: [(Option<u8>, u16); 4]) -> Self
    where
        R: Copy,
    {
        let ([x, y, z], [far_x, far_y, far_z]) = (lower, upper);
        const fn count((count, _): (Option<u8>, u16)) -> u8 {
            match count {
                Some(count) => count,
                None => NODE,
            }
        }
        Self {
            planes: [[x, far_x], [y, far_y], [z, far_z]],
            count: [count(a), count(b), count(c), count(d)],
            first: [a.1, b.1, c.1, d.1],
        }
    }

    /// Whether each node refers only to nodes after it, so that every walk ends.
    #[allow(clippy::indexing_slicing)] // All indices are below the lengths.
    pub(crate) const fn lead_on(nodes: &[Self]) -> bool {
        let mut i = 0;
        while i < nodes.len() {
            let mut place = 0;
            while place < NARROW {
                if nodes[i].count[place] == NODE && nodes[i].first[place] as usize <= i {
                    return false;
                }
                place += 1;
            }
            i += 1;
        }
        true
    }

    /// Whether each node lies in at most one other, so that a walk visits it once, and whether they are
    /// nested no deeper than the builder allows, so that a walk has room for all nodes that wait.
    #[allow(clippy::indexing_slicing)] // All indices are below the lengths.
    pub(crate) const fn are_shallow(nodes: &[Self]) -> bool {
        if nodes.is_empty() {
            return true;
        }
        // The current node and the nodes around it, and for each the number of boxes that were visited.
        let mut path = [(0, 0); MAX_HIERARCHY_DEPTH];
        let (mut last, mut visited) = (0, 1);
        loop {
            let (index, place) = path[last];
            if place == NARROW {
                if last == 0 {
                    return true;
                }
                last -= 1;
                continue;
            }
            path[last].1 += 1;
            let node: &Self = &nodes[index];
            let next = node.first[place] as usize;
            // A node that does not exist is not visited.
            if node.count[place] == NODE && next < nodes.len() {
                last += 1;
                visited += 1;
                if last == MAX_HIERARCHY_DEPTH || visited > nodes.len() {
                    return false;
                }
                path[last] = (next, 0);
            }
        }
    }
}

#[cfg(feature = "bake")]
impl<R: Real> Node<R> {
    /// The contents of the boxes, as [`new`](Self::new) takes them.
    pub(crate) fn contents(&self) -> [(Option<u8>, u16); 4] {
        core::array::from_fn(|place| {
            let content = self.content(place);
            ((!content.is_node()).then_some(content.count), content.first)
        })
    }

    /// The smallest and the largest coordinates of the boxes, each for x, y, z.
    pub(crate) fn planes(&self) -> [[[R; NARROW]; 3]; 2] {
        let [x, y, z] = self.planes;
        [[x[0], y[0], z[0]], [x[1], y[1], z[1]]]
    }
}

impl<R: Real, const W: usize> Node<R, W> {
    /// A node whose boxes are empty.
    const EMPTY: Self = Self { planes: [[[R::ZERO; W]; 2]; 3], count: [0; W], first: [0; W] };

    /// The contents of a box.
    #[inline]
    fn content(&self, place: usize) -> Content {
        let (count, first) = (self.count.get(place), self.first.get(place));
        Content { count: count.copied().unwrap_or(0), first: first.copied().unwrap_or(0) }
    }

    /// Sets the contents of a box.
    fn fill(&mut self, place: usize, content: Content) {
        if let (Some(count), Some(first)) = (self.count.get_mut(place), self.first.get_mut(place)) {
            (*count, *first) = (content.count, content.first);
        }
    }

    /// The corners of a box with the smallest and the largest coordinates.
    #[inline]
    fn corners(&self, place: usize) -> [Vec3<R>; 2] {
        let at = |planes: &[R; W]| planes.get(place).copied().unwrap_or(R::ZERO);
        let [[x, far_x], [y, far_y], [z, far_z]] = &self.planes;
        [Vec3::new(at(x), at(y), at(z)), Vec3::new(at(far_x), at(far_y), at(far_z))]
    }
}

/// The contents of a box: `count` objects, from place `first` of the order on; or, if `count` is [`NODE`],
/// the node with the index `first`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Content {
    count: u8,
    first: u16,
}

impl Content {
    const fn node(node: u16) -> Self {
        Self { count: NODE, first: node }
    }

    const fn is_node(self) -> bool {
        self.count == NODE
    }
}

/// A test of the boxes of a node.
trait BoxTest<R, const W: usize> {
    /// Calls `visit` with the places of the boxes that pass the test, until it returns `true`. Returns
    /// whether it did.
    fn any_met(&self, node: &Node<R, W>, visit: impl FnMut(usize) -> bool) -> bool;
}

/// A test against a ray, which also computes where boxes are met.
trait RayTest<R, const W: usize>: BoxTest<R, W> {
    /// Calls `visit` with the places of the boxes that the ray meets, and with a key for each box that grows
    /// with the distance from the ray's origin.
    fn each_met(&self, node: &Node<R, W>, visit: impl FnMut(usize, R));

    /// Ends the ray at the distance `max`.
    fn end_at(&mut self, max: R);

    /// Whether the ray still reaches a box that was met before, by its key.
    fn reaches(&self, key: R) -> bool;
}

/// The contents of a box that waits while nearer boxes are visited, and the key of that box.
type WaitingBox<R> = (R, Content);

/// At most all boxes of one node wait, and all but one of each node around it.
const MOST_WAITING: usize = (WIDE - 1) * MAX_HIERARCHY_DEPTH + 1;

impl<'m, R: Real, const W: usize> Hierarchy<'m, R, W> {
    /// A hierarchy without boxes: all objects of a list are tested one by one.
    pub(crate) fn list(objects: &'m [u16]) -> Self {
        Self { nodes: &[], order: objects, unbounded: objects.len() }
    }

    /// A hierarchy that was built before. If it has no nodes, all objects are tested one by one.
    pub(crate) const fn baked(nodes: &'m [Node<R, W>], order: &'m [u16]) -> Self {
        Self { nodes, order, unbounded: if nodes.is_empty() { order.len() } else { 0 } }
    }

    /// The nodes and the order, as [`baked`](Self::baked) takes them. All objects must have bounds.
    #[cfg(feature = "bake")]
    pub(crate) const fn parts(&self) -> (&'m [Node<R, W>], &'m [u16]) {
        (self.nodes, self.order)
    }

    /// The bytes of the hierarchy of so many objects, with up to `leaf` objects in a leaf, without the list
    /// of objects.
    pub(crate) const fn bytes(objects: usize, leaf: usize) -> usize {
        Arena::bytes::<Node<R, W>>(build::most_nodes(objects, leaf, W))
    }

    /// Builds the hierarchy of the objects in a list, and sorts the list leaf by leaf. `leaf` is the most
    /// objects in a leaf: 2 or more, and less than the number of objects.
    pub(crate) fn new(
        objects: &'m mut [u16],
        leaf: usize,
        bounds: impl Fn(u16) -> Option<Aabb<R>>,
        arena: &mut Arena<'m>,
    ) -> Result<Self, Fault> {
        build::build(objects, leaf, bounds, arena)
    }

    /// Calls `test` for all objects that a ray can meet at a distance of at most `max`, and for some more,
    /// roughly in order of their distance. `test` returns the new largest distance.
    #[inline]
    pub(crate) fn walk(&self, ray: &Ray<R>, max: R, test: impl FnMut(usize) -> R) {
        if R::IS_FIXED_POINT {
            self.walk_boxes(Segment::new(ray, max), test)
        } else {
            self.walk_boxes(Slabs::new(ray, max), test)
        }
    }

    /// Calls `test` for all objects that a ray can meet at a distance of at most `max`, and for some more, in
    /// any order, until it returns `true`. Returns whether it did.
    #[inline]
    pub(crate) fn any(&self, ray: &Ray<R>, max: R, test: impl FnMut(usize) -> bool) -> bool {
        if R::IS_FIXED_POINT {
            self.any_in_boxes(&Segment::new(ray, max), test)
        } else {
            self.any_in_boxes(&Slabs::new(ray, max), test)
        }
    }

    /// [`any`](Self::any) for all objects that may be no farther than `reach` from a ray, before it ends at
    /// `max`.
    #[inline]
    pub(crate) fn any_beside(&self, ray: &Ray<R>, max: R, reach: R, test: impl FnMut(usize) -> bool) -> bool {
        let margin = R::offset(ray.origin.magnitude()) + reach;
        if R::IS_FIXED_POINT {
            self.any_in_boxes(&Segment::inflated(ray, max, margin), test)
        } else {
            self.any_in_boxes(&Slabs::inflated(ray, max, margin), test)
        }
    }

    /// A distance from a point beyond which there is no box.
    pub(crate) fn farthest_from(&self, point: Vec3<R>) -> R {
        let mut farthest = R::ZERO;
        if let Some(root) = self.nodes.first() {
            for corner in (0..W).flat_map(|slot| root.corners(slot)) {
                let Vec3 { x, y, z } = corner - point;
                farthest = farthest.larger(x.abs() + y.abs() + z.abs());
            }
        }
        farthest
    }

    /// [`any`](Self::any) for all objects that any ray of a beam can meet.
    #[inline]
    pub(crate) fn any_in_beam(&self, beam: &Beam<R>, test: impl FnMut(usize) -> bool) -> bool {
        self.any_in_boxes(beam, test)
    }

    /// [`any`](Self::any) for all objects that reach between the two planes of a wedge.
    #[inline]
    pub(crate) fn any_between(&self, wedge: &Wedge<R>, test: impl FnMut(usize) -> bool) -> bool {
        self.any_in_boxes(wedge, test)
    }

    /// Calls `visit` for all objects that a point may lie on. The point was computed with an error of less
    /// than `margin`.
    #[inline]
    pub(crate) fn visit(&self, point: Vec3<R>, margin: R, mut visit: impl FnMut(usize)) {
        self.any_in_boxes(&Place::new(point, margin), |object| {
            visit(object);
            false
        });
    }

    /// Calls `test` for all objects in boxes that pass a test, in any order, until it returns `true`. Returns
    /// whether it did.
    fn any_in_boxes(&self, boxes: &impl BoxTest<R, W>, mut test: impl FnMut(usize) -> bool) -> bool {
        let unbounded = self.order.get(..self.unbounded).unwrap_or_default();
        if unbounded.iter().any(|object| test(usize::from(*object))) {
            return true;
        }
        let mut waiting: Vec<u16, MOST_WAITING> = Vec::new();
        let mut next = Some(0);
        while let Some(index) = next {
            if let Some(node) = self.nodes.get(usize::from(index)) {
                let found = boxes.any_met(node, |slot| {
                    let content = node.content(slot);
                    if content.is_node() {
                        let pushed = waiting.push(content.first);
                        debug_assert!(pushed.is_ok(), "deeper than the builder allows");
                        return false;
                    }
                    self.leaf(content).iter().any(|object| test(usize::from(*object)))
                });
                if found {
                    return true;
                }
            }
            next = waiting.pop();
        }
        false
    }

    /// The objects of a leaf.
    #[inline]
    fn leaf(&self, Content { count, first }: Content) -> &'m [u16] {
        let first = usize::from(first);
        self.order.get(first..first + usize::from(count)).unwrap_or_default()
    }

    /// [`walk`](Self::walk) with the test of boxes for the number system.
    fn walk_boxes(&self, mut ray: impl RayTest<R, W>, mut test: impl FnMut(usize) -> R) {
        let mut waiting: Vec<WaitingBox<R>, MOST_WAITING> = Vec::new();
        let mut objects = self.order.get(..self.unbounded).unwrap_or_default();
        let mut next = Some((R::ZERO, Content::node(0)));
        loop {
            for object in objects {
                ray.end_at(test(usize::from(*object)));
            }
            if self.nodes.is_empty() {
                return;
            }
            // Find the next leaf that the ray reaches.
            objects = loop {
                let Some((key, content)) = next.take().or_else(|| waiting.pop()) else { return };
                if !ray.reaches(key) {
                    continue;
                }
                if !content.is_node() {
                    break self.leaf(content);
                }
                if let Some(node) = self.nodes.get(usize::from(content.first)) {
                    next = nearest(&ray, node, &mut waiting);
                }
            };
        }
    }
}

/// The nearest box of a node that a ray meets. The others are added to `waiting`.
fn nearest<R: Real, const W: usize>(
    ray: &impl RayTest<R, W>,
    node: &Node<R, W>,
    waiting: &mut Vec<WaitingBox<R>, MOST_WAITING>,
) -> Option<WaitingBox<R>> {
    let mut nearest: Option<WaitingBox<R>> = None;
    ray.each_met(node, |slot, key| {
        let mut nearer = (key, node.content(slot));
        if let Some(mut farther) = nearest {
            if farther.0 < nearer.0 {
                core::mem::swap(&mut farther, &mut nearer);
            }
            let pushed = waiting.push(farther);
            debug_assert!(pushed.is_ok(), "deeper than the builder allows");
        }
        nearest = Some(nearer);
    });
    nearest
}

/// The indices of the set bits.
#[inline]
fn slots<const W: usize>(mut met: u32) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let slot = (met != 0).then(|| met.trailing_zeros() as usize % W);
        met &= met.wrapping_sub(1);
        slot
    })
}
