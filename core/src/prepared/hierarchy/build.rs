//! How the hierarchy is built: from the top down, each box split in two where rays that come through it are expected to
//! test the fewest objects (the surface area heuristic: MacDonald and Booth, "Heuristics for Ray Tracing Using Space
//! Subdivision", The Visual Computer 1990), with cuts at eight places along each axis (Wald, "On fast Construction of
//! SAH-based Bounding Volume Hierarchies", RT 2007).
//!
//! # How deep
//! Cuts that cost least may part two objects from thousands. So in nodes that lie in [`CUT_DEPTH`] others the objects are
//! halved: 15 halvings leave two of 65535, and a leaf lies in at most [`MAX_HIERARCHY_DEPTH`] nodes.

use super::axis::Axis;
use super::{Content, Hierarchy, Node};
use crate::arena::Arena;
use crate::fault::Fault;
use crate::limits::{MAX_COUNT, MAX_HIERARCHY_DEPTH};
use crate::math::{Aabb, Real, Vec3};

/// The most objects in a leaf: testing one takes no longer than testing a box. Five cost 2 to 4 % more.
const LEAF: usize = 3;
/// The fewest on each side of a cut, so that there are fewer nodes than objects.
const FEWEST: usize = 2;
/// In so many nodes, objects are halved.
const CUT_DEPTH: usize = 16;
/// Places along an axis.
const BINS: usize = 8;

/// How often a number of objects is halved before one leaf holds them.
const fn halvings(objects: usize) -> usize {
    let (mut objects, mut halvings) = (objects, 0);
    while objects > LEAF {
        objects = objects.div_ceil(2);
        halvings += 1;
    }
    halvings
}

const _: () = assert!(CUT_DEPTH + halvings(MAX_COUNT) <= MAX_HIERARCHY_DEPTH);

/// Objects that are to become a node and what lies in it.
#[derive(Clone, Copy)]
struct Part {
    /// Where they are in the order.
    first: usize,
    count: usize,
    /// How many nodes contain this one.
    depth: usize,
    /// The node whose second one this becomes.
    second_of: Option<usize>,
}

/// Builds the hierarchy of so many objects.
pub(super) fn build<'m, R: Real>(
    objects: usize,
    bounds: impl Fn(u16) -> Option<Aabb<R>>,
    arena: &mut Arena<'m>,
) -> Result<Hierarchy<'m, R>, Fault> {
    let order: &'m mut [u16] = arena.try_store_with(objects, |index, _| Ok::<u16, Fault>(index as u16))?;
    let unbounded = partition(order, |object| bounds(object).is_none());
    let empty =
        Node { center: Vec3::ZERO, reach: Vec3::ZERO, content: Content::Objects { count: 0, first: 0 } };
    let nodes: &'m mut [Node<R>] = arena.try_store_with(objects, |_, _| Ok::<_, Fault>(empty))?;

    let mut used = 0;
    let mut next = Some(Part { first: unbounded, count: objects - unbounded, depth: 0, second_of: None });
    // One part waits for each node that contains the one at hand.
    let mut waiting = [None; MAX_HIERARCHY_DEPTH];
    while let Some(part) = next.take().or_else(|| waiting.iter_mut().rev().find_map(Option::take)) {
        let Part { first, count, depth, second_of } = part;
        if let Some(Content::Nodes { second, .. }) =
            second_of.and_then(|node| nodes.get_mut(node)).map(|node| &mut node.content)
        {
            *second = used as u16;
        }
        let in_part = order.get_mut(first..first.saturating_add(count)).unwrap_or_default();
        let around = in_part.iter().filter_map(|object| bounds(*object)).reduce(Aabb::union);
        let (Some(around), Some(node)) = (around, nodes.get_mut(used)) else { break };
        let center = around.center();
        // What is rounded is of the size of this box, not of the shapes in it.
        let around = around.padded(R::offset(around.magnitude()));
        let (up, down) = (around.max - center, center - around.min);
        let reach = Vec3::new(up.x.larger(down.x), up.y.larger(down.y), up.z.larger(down.z));
        let content = if count <= LEAF {
            Content::Objects { count: count as u8, first: first as u16 }
        } else {
            let bounds = |object| bounds(object).map_or(Aabb::point(Vec3::ZERO), Aabb::to_setup);
            let (axis, cut) = split::<R::Setup>(in_part, bounds, depth >= CUT_DEPTH);
            let depth = depth + 1;
            next = Some(Part { first, count: cut, depth, second_of: None });
            let second = Part { first: first + cut, count: count - cut, depth, second_of: Some(used) };
            // There is a place for each depth.
            if let Some(place) = waiting.get_mut(depth - 1) {
                *place = Some(second);
            }
            Content::Nodes { axis, second: 0 }
        };
        *node = Node { center, reach, content };
        used += 1;
    }
    Ok(Hierarchy { nodes, order, unbounded })
}

/// Brings the objects of one side to the front, and says how many they are and along which axis they were cut.
fn split<F: Real<Setup = F>>(
    objects: &mut [u16],
    bounds: impl Fn(u16) -> Aabb<F>,
    halve: bool,
) -> (Axis, usize) {
    let half = (Axis::X, objects.len() / 2);
    let centers = objects.iter().map(|object| Aabb::point(bounds(*object).center())).reduce(Aabb::union);
    let Some(centers) = centers.filter(|_| !halve) else { return half };
    let mut best: Option<(F, Row<F>, usize)> = None;
    for axis in Axis::ALL {
        let row = Row::new(axis, centers);
        let mut bins = [Bin { bounds: None, count: 0 }; BINS];
        for object in objects.iter() {
            let bounds = bounds(*object);
            if let Some(bin) = bins.get_mut(row.place(bounds)) {
                *bin = bin.union(Bin { bounds: Some(bounds), count: 1 });
            }
        }
        for cut in 1..BINS {
            let before = bins.iter().take(cut).copied().fold(Bin::EMPTY, Bin::union);
            let behind = bins.iter().skip(cut).copied().fold(Bin::EMPTY, Bin::union);
            let cost = before.cost() + behind.cost();
            let enough = before.count >= FEWEST && behind.count >= FEWEST;
            if enough && best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, row, cut));
            }
        }
    }
    match best {
        Some((_, row, cut)) => (row.axis, partition(objects, |object| row.place(bounds(object)) < cut)),
        // All in one place, or all but one.
        None => half,
    }
}

/// Places along an axis, of the same width.
#[derive(Clone, Copy)]
struct Row<F> {
    axis: Axis,
    start: F,
    places_per_unit: F,
}

impl<F: Real> Row<F> {
    /// The places from the first center to the last.
    fn new(axis: Axis, centers: Aabb<F>) -> Self {
        let (start, end) = (axis.of(centers.min), axis.of(centers.max));
        let places_per_unit = if end > start { F::from_u16(BINS as u16) / (end - start) } else { F::ZERO };
        Self { axis, start, places_per_unit }
    }

    /// The place of the middle of a box.
    fn place(&self, bounds: Aabb<F>) -> usize {
        let along = self.axis.of(bounds.center()) - self.start;
        let place = (along * self.places_per_unit).floor_to_i32();
        place.clamp(0, BINS as i32 - 1) as usize
    }
}

/// The objects at one place.
#[derive(Clone, Copy)]
struct Bin<F> {
    bounds: Option<Aabb<F>>,
    count: usize,
}

impl<F: Real> Bin<F> {
    const EMPTY: Self = Self { bounds: None, count: 0 };

    // Not inlined, as the next: in preparation size counts more than time.
    #[inline(never)]
    fn union(self, other: Self) -> Self {
        let bounds = match (self.bounds, other.bounds) {
            (Some(a), Some(b)) => Some(a.union(b)),
            (a, b) => a.or(b),
        };
        Self { bounds, count: self.count + other.count }
    }

    /// The share of rays that come through, times the number of objects that they test.
    #[inline(never)]
    fn cost(self) -> F {
        self.bounds.map_or(F::ZERO, |bounds| {
            let Vec3 { x, y, z } = bounds.max - bounds.min;
            (x * y + y * z + z * x) * F::from_u16(self.count as u16)
        })
    }
}

/// Brings the objects to the front that belong there, and says how many they are.
fn partition(objects: &mut [u16], belongs_in_front: impl Fn(u16) -> bool) -> usize {
    let mut front = 0;
    for index in 0..objects.len() {
        let Some(object) = objects.get(index).copied() else { break };
        if belongs_in_front(object)
            && let Some(place) = objects.get_mut(front)
        {
            let displaced = core::mem::replace(place, object);
            if let Some(place) = objects.get_mut(index) {
                *place = displaced;
            }
            front += 1;
        }
    }
    front
}
