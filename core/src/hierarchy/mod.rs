//! Boxes around objects, and boxes around those boxes: a ray that misses a box meets nothing in it. Nine times the
//! objects, 820 balls for 91, then cost 1.58 times the instructions for each ray.
//!
//! Scenes of many objects have a hierarchy, and so has a mesh of its triangles. A node holds four boxes, coordinate by
//! coordinate, so that a processor that computes four numbers at once tests them at once (Dammertz, Hanika and Keller,
//! "Shallow Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent Rays", EGSR 2008): on x86-64, in 0.44 times
//! the instructions that it took with nodes of one box. There, the hierarchy of a scene has nodes of eight boxes: it waits for the outcome
//! of fewer nodes, in 0.91 (balls_s3), 0.98 (teapot_s2) and 0.93 (rings_s1) times the time. Sixteen take 1.16 to 1.27 times as long, and
//! an M4F takes 1.06 to 1.11 times the instructions with eight. A mesh has four everywhere, as it may be built for another processor.
//!
//! To sort all boxes of a node by distance visits fewer, but takes 5 % longer than to go on with the nearest and to let the others wait
//! as they come. Two nodes of four boxes at a time take as long as one. How it is built: see [`build`]. How boxes are tested: see
//! [`slabs`] for floating point, [`segment`] for fixed point, [`place`] for points, [`beam`] for many rays at once, and [`wedge`]
//! for some lines of a picture.
//!
//! A picture has the same bytes with and without: no box is left out that a hit might lie in, and of several objects at
//! the same distance the lowest position counts, whichever box is visited first.

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

/// Objects, by where they are, in nodes of so many boxes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hierarchy<'m, R, const W: usize = NARROW> {
    /// All nodes; the first is the root.
    nodes: &'m [Node<R, W>],
    /// The objects: first those without bounds, then leaf by leaf.
    order: &'m [u16],
    /// How many have no bounds.
    unbounded: usize,
}

/// The boxes of a node that may be used on any processor.
pub(crate) const NARROW: usize = 4;

/// The boxes of a node that stays on one processor: more, where that computes four numbers at once.
pub(crate) const WIDE: usize = if FOUR_AT_ONCE { 8 } else { NARROW };

/// Some boxes, and what lies in each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node<R, const W: usize = NARROW> {
    /// For x, y, z: the smallest coordinates of the boxes, and the largest.
    planes: [[[R; W]; 2]; 3],
    /// What lies in each: so many objects of the order, or another [`NODE`].
    count: [u8; W],
    /// The first of the objects, or that node.
    first: [u16; W],
}

/// In place of a number of objects.
const NODE: u8 = u8::MAX;

const _: () = assert!(size_of::<Node<f32>>() == 108 && size_of::<Node<f32, 8>>() == 216);

impl<R> Node<R> {
    /// A node: the smallest and the largest coordinates of four boxes, and what lies in each: so many objects from the
    /// first on, or where there is no number of them, another node.
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

    /// Whether each leads only to nodes after it, so that a walk ends.
    #[allow(clippy::indexing_slicing)] // Below the lengths.
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

    /// Whether each lies in one other at most, and in no more than the builder allows, so that a walk visits it once and there is room
    /// for what waits.
    #[allow(clippy::indexing_slicing)] // Below the lengths.
    pub(crate) const fn are_shallow(nodes: &[Self]) -> bool {
        if nodes.is_empty() {
            return true;
        }
        // The nodes around the one that is looked at, and how many places of each were looked at.
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
            // What is not there is not visited.
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
    /// What lies in each of its boxes, as [`new`](Self::new) takes it.
    pub(crate) fn contents(&self) -> [(Option<u8>, u16); 4] {
        core::array::from_fn(|place| {
            let content = self.content(place);
            ((!content.is_node()).then_some(content.count), content.first)
        })
    }

    /// The smallest and the largest coordinates of its boxes: x, y, z.
    pub(crate) fn planes(&self) -> [[[R; NARROW]; 3]; 2] {
        let [x, y, z] = self.planes;
        [[x[0], y[0], z[0]], [x[1], y[1], z[1]]]
    }
}

impl<R: Real, const W: usize> Node<R, W> {
    /// No boxes yet.
    const EMPTY: Self = Self { planes: [[[R::ZERO; W]; 2]; 3], count: [0; W], first: [0; W] };

    /// What lies in a box.
    #[inline(always)]
    #[allow(clippy::indexing_slicing)] // By a remainder.
    fn content(&self, place: usize) -> Content {
        Content { count: self.count[place % W], first: self.first[place % W] }
    }

    /// Sets what lies in a box.
    fn fill(&mut self, place: usize, content: Content) {
        if let (Some(count), Some(first)) = (self.count.get_mut(place), self.first.get_mut(place)) {
            (*count, *first) = (content.count, content.first);
        }
    }

    /// The smallest and the largest coordinates of a box.
    #[inline(always)]
    #[allow(clippy::indexing_slicing)] // By a remainder.
    fn corners(&self, place: usize) -> [Vec3<R>; 2] {
        let [x, y, z] = &self.planes;
        [0, 1].map(|side: usize| Vec3::new(x[side][place % W], y[side][place % W], z[side][place % W]))
    }
}

/// What lies in a box: so many objects of the order, from `first` on, or where the number is [`NODE`], another node.
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

/// A test of what may be met in boxes.
trait BoxTest<R, const W: usize> {
    /// Calls `visit` with the places of a node's boxes that are met, until it says `true`. Returns whether it did.
    fn any_met(&self, node: &Node<R, W>, visit: impl FnMut(usize) -> bool) -> bool;
}

/// A test that tells where as well.
trait RayTest<R, const W: usize>: BoxTest<R, W> {
    /// Calls `visit` with the places of the boxes that the ray meets, and with a number for each that grows with the distance from the
    /// ray's origin.
    fn each_met(&self, node: &Node<R, W>, visit: impl FnMut(usize, R));

    /// Ends the ray at a distance.
    fn end_at(&mut self, max: R);

    /// Whether a box that was met before still matters, by its number.
    fn reaches(&self, key: R) -> bool;
}

/// A box that waits while nearer ones are visited, and the number that says how near it is.
type Waiting<R> = (R, Content);

/// All boxes of a node wait at first, then all but one for each node around the one that is visited.
const MOST_WAITING: usize = (WIDE - 1) * MAX_HIERARCHY_DEPTH + 1;

impl<'m, R: Real, const W: usize> Hierarchy<'m, R, W> {
    /// No boxes: all objects of a list, one by one.
    pub(crate) fn list(objects: &'m [u16]) -> Self {
        Self { nodes: &[], order: objects, unbounded: objects.len() }
    }

    /// One that was built before; no nodes: all objects of the list, one by one.
    pub(crate) const fn baked(nodes: &'m [Node<R, W>], order: &'m [u16]) -> Self {
        Self { nodes, order, unbounded: if nodes.is_empty() { order.len() } else { 0 } }
    }

    /// All nodes, and the objects leaf by leaf: for [`baked`](Self::baked), where all have bounds.
    #[cfg(feature = "bake")]
    pub(crate) const fn parts(&self) -> (&'m [Node<R, W>], &'m [u16]) {
        (self.nodes, self.order)
    }

    /// How many bytes the hierarchy of so many objects takes, with up to `leaf` of them in a leaf, besides the list of them.
    pub(crate) const fn bytes(objects: usize, leaf: usize) -> usize {
        Arena::bytes::<Node<R, W>>(build::most_nodes(objects, leaf, W))
    }

    /// Builds the hierarchy of the objects in a list, and brings that in its own order. There are to be more than `leaf`, the
    /// most in a leaf: 2 or more.
    pub(crate) fn new(
        objects: &'m mut [u16],
        leaf: usize,
        bounds: impl Fn(u16) -> Option<Aabb<R>>,
        arena: &mut Arena<'m>,
    ) -> Result<Self, Fault> {
        build::build(objects, leaf, bounds, arena)
    }

    /// Calls `test` for all objects that a ray can meet at a distance of at most `max`, and for some more: near ones
    /// first, roughly. It says what the largest distance is from then on.
    #[inline]
    pub(crate) fn walk(&self, ray: &Ray<R>, max: R, test: impl FnMut(usize) -> R) {
        if R::IS_FIXED_POINT {
            self.walk_boxes(Segment::new(ray, max), test)
        } else {
            self.walk_boxes(Slabs::new(ray, max), test)
        }
    }

    /// Calls `test` for all objects that a ray can meet at a distance of at most `max`, and for some more, in no order, until it says
    /// `true`. Returns whether it did.
    #[inline]
    pub(crate) fn any(&self, ray: &Ray<R>, max: R, test: impl FnMut(usize) -> bool) -> bool {
        if R::IS_FIXED_POINT {
            self.any_in_boxes(&Segment::new(ray, max), test)
        } else {
            self.any_in_boxes(&Slabs::new(ray, max), test)
        }
    }

    /// The same for all objects that may come as near to a ray as `beside`, before it ends at `max`.
    #[inline]
    pub(crate) fn any_beside(
        &self,
        ray: &Ray<R>,
        max: R,
        beside: R,
        test: impl FnMut(usize) -> bool,
    ) -> bool {
        let margin = R::offset(ray.origin.magnitude()) + beside;
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

    /// The same for all objects that any ray of a beam can meet.
    #[inline]
    pub(crate) fn any_in_beam(&self, beam: &Beam<R>, test: impl FnMut(usize) -> bool) -> bool {
        self.any_in_boxes(beam, test)
    }

    /// The same for all objects that reach between two planes.
    #[inline]
    pub(crate) fn any_between(&self, wedge: &Wedge<R>, test: impl FnMut(usize) -> bool) -> bool {
        self.any_in_boxes(wedge, test)
    }

    /// Calls `visit` for all objects that a point may lie on: a point that was computed, off by less than `margin`.
    #[inline]
    pub(crate) fn visit(&self, point: Vec3<R>, margin: R, mut visit: impl FnMut(usize)) {
        self.any_in_boxes(&Place::new(point, margin), |object| {
            visit(object);
            false
        });
    }

    #[inline(always)]
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

    /// So many objects from the first on.
    #[inline(always)]
    fn leaf(&self, Content { count, first }: Content) -> &'m [u16] {
        let first = usize::from(first);
        self.order.get(first..first + usize::from(count)).unwrap_or_default()
    }

    #[inline(always)]
    fn walk_boxes(&self, mut ray: impl RayTest<R, W>, mut test: impl FnMut(usize) -> R) {
        let mut waiting: Vec<Waiting<R>, MOST_WAITING> = Vec::new();
        let mut objects = self.order.get(..self.unbounded).unwrap_or_default();
        let mut next = Some((R::ZERO, Content::node(0)));
        loop {
            for object in objects {
                ray.end_at(test(usize::from(*object)));
            }
            if self.nodes.is_empty() {
                return;
            }
            // To the next leaf that matters.
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

/// The nearest of the boxes that a ray meets; the others wait.
#[inline(always)]
fn nearest<R: Real, const W: usize>(
    ray: &impl RayTest<R, W>,
    node: &Node<R, W>,
    waiting: &mut Vec<Waiting<R>, MOST_WAITING>,
) -> Option<Waiting<R>> {
    let mut nearest: Option<Waiting<R>> = None;
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

/// The places of the bits that are set.
#[inline(always)]
fn slots<const W: usize>(mut met: u32) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let slot = (met != 0).then(|| met.trailing_zeros() as usize % W);
        met &= met.wrapping_sub(1);
        slot
    })
}
