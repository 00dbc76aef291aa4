//! Building the hierarchy, from the top down. Each box is split in two where rays that come through it are
//! expected to test the fewest objects (the surface area heuristic: MacDonald and Booth, "Heuristics for Ray
//! Tracing Using Space Subdivision", The Visual Computer 1990), by cuts at eight places along each axis
//! (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", RT 2007).
//!
//! # Bounds of depth and size
//! The best cut may separate one object from thousands. So in nodes that lie in [`CUT_DEPTH`] others, the
//! objects are halved, whatever the cost. Eight such nodes separate 65535 objects, and a leaf lies in at most
//! [`MAX_HIERARCHY_DEPTH`] nodes.
//!
//! A node without nodes in it has more objects than fit in one leaf. A node with nodes in it has as many
//! boxes as possible, with at least one object each. So for nodes of four boxes and leaves of two objects,
//! there are at most 4/9 as many nodes as objects, which takes 48 bytes for each object in `f32`. For leaves
//! of three or four objects, there are at most 1/3, which takes 36 bytes; for nodes of eight boxes and leaves
//! of three objects, at most 2/7, which takes 62 bytes.

use heapless::Vec;

use super::axis::Axis;
use super::{Content, Hierarchy, MOST_WAITING, NARROW, Node};
use crate::arena::Arena;
use crate::fault::Fault;
use crate::limits::{MAX_COUNT, MAX_HIERARCHY_DEPTH};
use crate::math::{Aabb, Real, Vec3};

/// The smallest value of the argument `leaf`. For larger leaves there are fewer nodes, and they are nested
/// less deep.
const SMALLEST_LEAF: usize = 2;
/// From this depth on, objects are halved.
const CUT_DEPTH: usize = 12;
/// The number of places for cuts along an axis.
const BINS: usize = 8;

/// The number of nested nodes that it takes to halve so many objects until they fit in leaves.
const fn halving_nodes(mut objects: usize) -> usize {
    let mut nodes = 0;
    while objects > SMALLEST_LEAF {
        objects = objects.div_ceil(NARROW);
        nodes += 1;
    }
    nodes
}

const _: () = assert!(CUT_DEPTH + halving_nodes(MAX_COUNT) <= MAX_HIERARCHY_DEPTH);

/// A quotient that cannot panic, at no level of optimization: 0 if the divisor is 0.
const fn ratio(dividend: usize, divisor: usize) -> usize {
    match dividend.checked_div(divisor) {
        Some(quotient) => quotient,
        None => 0,
    }
}

/// The most nodes of `width` boxes for so many objects, which must be more than `leaf`.
pub(super) const fn most_nodes(objects: usize, leaf: usize, width: usize) -> usize {
    let more = width.saturating_sub(1);
    let around_leaves = ratio(objects.saturating_mul(width), leaf.saturating_add(1).saturating_mul(more));
    let around_nodes = ratio(objects, more);
    if around_leaves > around_nodes { around_leaves } else { around_nodes }
}

/// A group of objects, for one box of a node.
#[derive(Clone, Copy)]
struct Cluster<R> {
    /// The index of the first object in the order.
    first: usize,
    count: usize,
    around: Aabb<R>,
}

impl<R: Real> Cluster<R> {
    /// The cluster of some objects; `None` if none of them has bounds.
    fn new(objects: &[u16], first: usize, bounds: &impl Fn(u16) -> Option<Aabb<R>>) -> Option<Self> {
        let around = objects.iter().filter_map(|object| bounds(*object)).reduce(Aabb::union)?;
        Some(Self { first, count: objects.len(), around })
    }
}

/// A cluster that is to become a node. It is small, because many of them wait.
#[derive(Clone, Copy)]
struct Pending {
    first: u16,
    count: u16,
    /// The number of nodes that contain it.
    depth: u8,
    /// The node that it lies in, and the place in that node.
    of: (u16, u8),
}

/// Builds the hierarchy of the objects in a list. See [`Hierarchy::new`].
pub(super) fn build<'m, R: Real, const W: usize>(
    order: &'m mut [u16],
    leaf: usize,
    bounds: impl Fn(u16) -> Option<Aabb<R>>,
    arena: &mut Arena<'m>,
) -> Result<Hierarchy<'m, R, W>, Fault> {
    let objects = order.len();
    let unbounded = partition(order, |object| bounds(object).is_none());
    let nodes: &'m mut [Node<R, W>] =
        arena.try_store_with(most_nodes(objects, leaf, W), |_, _| Ok::<_, Fault>(Node::EMPTY))?;

    let mut used: u16 = 0;
    // The root lies in no node: it is entered in its own first place, which is then overwritten.
    let all = Pending { first: unbounded as u16, count: (objects - unbounded) as u16, depth: 0, of: (0, 0) };
    // At most all clusters of one node wait, and all but one of each node around it.
    let mut waiting: Vec<Pending, MOST_WAITING> = Vec::new();
    let mut next = Some(all);
    while let Some(pending) = next.take().or_else(|| waiting.pop()) {
        let Pending { first, count, depth, of: (parent, place) } = pending;
        if let Some(node) = nodes.get_mut(usize::from(parent)) {
            node.fill(usize::from(place), Content::node(used));
        }
        let (first, count) = (usize::from(first), usize::from(count));
        let in_all = order.get_mut(first..first.saturating_add(count)).unwrap_or_default();
        let clusters = clusters::<R, W>(in_all, &bounds, usize::from(depth) >= CUT_DEPTH);
        let mut node = Node::EMPTY;
        for (place, cluster) in clusters.into_iter().enumerate() {
            let Some(Cluster { first: begin, count, around }) = cluster else { continue };
            // The rounding of the box test depends on the coordinates of this box, not on those of the shapes
            // in it.
            node.enclose(place, around.padded(R::offset(around.magnitude())));
            let first = first + begin;
            if count > leaf {
                let of = (used, place as u8);
                let pending = Pending { first: first as u16, count: count as u16, depth: depth + 1, of };
                let pushed = waiting.push(pending);
                debug_assert!(pushed.is_ok(), "deeper than CUT_DEPTH allows");
            } else {
                node.fill(place, Content { count: count as u8, first: first as u16 });
            }
        }
        let Some(slot) = nodes.get_mut(usize::from(used)) else { break };
        *slot = node;
        used += 1;
    }
    let nodes = nodes.get(..usize::from(used)).unwrap_or_default();
    Ok(Hierarchy { nodes, order, unbounded })
}

impl<R: Real, const W: usize> Node<R, W> {
    /// Sets one of the boxes.
    pub(super) fn enclose(&mut self, place: usize, Aabb { min, max }: Aabb<R>) {
        let rows = self.planes.iter_mut().flatten();
        for (row, plane) in rows.zip([min.x, max.x, min.y, max.y, min.z, max.z]) {
            if let Some(place) = row.get_mut(place) {
                *place = plane;
            }
        }
    }
}

/// Divides objects into up to `W` clusters: as long as there is a free place, the cluster for which the most
/// tests are expected is divided in two.
fn clusters<R: Real, const W: usize>(
    objects: &mut [u16],
    bounds: &impl Fn(u16) -> Option<Aabb<R>>,
    halve: bool,
) -> [Option<Cluster<R>>; W] {
    let cost = |cluster: &Cluster<R>| {
        let weight = R::Setup::from_u16(cluster.count as u16);
        if halve { weight } else { area(cluster.around.to_setup()) * weight }
    };
    let mut clusters = [None; W];
    if let Some(first) = clusters.first_mut() {
        *first = Cluster::new(objects, 0, bounds);
    }
    for free in 1..W {
        let several = clusters.iter_mut().flatten().filter(|cluster| cluster.count > 1);
        let Some(largest) = several.reduce(|a, b| if cost(b) > cost(a) { b } else { a }) else { break };
        let first = largest.first;
        let in_cluster = objects.get_mut(first..first.saturating_add(largest.count)).unwrap_or_default();
        let to_setup = |object| bounds(object).map_or(Aabb::point(Vec3::ZERO), Aabb::to_setup);
        let cut = split::<R::Setup>(in_cluster, to_setup, halve);
        let Some((front, behind)) = in_cluster.split_at_checked(cut) else { break };
        let behind = Cluster::new(behind, first + cut, bounds);
        let Some(front) = Cluster::new(front, first, bounds) else { break };
        *largest = front;
        if let Some(cluster) = clusters.get_mut(free) {
            *cluster = behind;
        }
    }
    clusters
}

/// Brings the objects in front of the best cut to the front of the list, and returns their number.
fn split<F: Real<Setup = F>>(objects: &mut [u16], bounds: impl Fn(u16) -> Aabb<F>, halve: bool) -> usize {
    let half = objects.len() / 2;
    let centers = objects.iter().map(|object| Aabb::point(bounds(*object).center())).reduce(Aabb::union);
    let Some(centers) = centers.filter(|_| !halve) else { return half };
    let mut best: Option<(F, Row<F>, usize)> = None;
    for axis in Axis::ALL {
        let row = Row::new(axis, centers);
        let mut bins = [Bin::empty(); BINS];
        for object in objects.iter() {
            let bounds = bounds(*object);
            if let Some(bin) = bins.get_mut(row.place(bounds.center())) {
                bin.add(&Bin { bounds, count: 1 });
            }
        }
        // Sum up what lies behind each cut, from the last to the first; then what lies in front of each.
        let mut behind = [(F::ZERO, 0); BINS];
        let (mut union, mut last) = (Bin::empty(), (F::ZERO, 0));
        for (bin, behind) in bins.iter().zip(&mut behind).rev() {
            if bin.count > 0 {
                union.add(bin);
                last = (union.cost(), union.count);
            }
            *behind = last;
        }
        let mut before = Bin::empty();
        for (cut, (bin, (cost_behind, count_behind))) in (1..BINS).zip(bins.iter().zip(behind.iter().skip(1)))
        {
            // A cut behind a place without objects is the same as the cut in front of that place.
            if bin.count == 0 || *count_behind == 0 {
                continue;
            }
            before.add(bin);
            let cost = before.cost() + *cost_behind;
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, row, cut));
            }
        }
    }
    match best {
        Some((_, row, cut)) => partition(objects, |object| row.place(bounds(object).center()) < cut),
        // All objects are in one place.
        None => half,
    }
}

/// Places of the same width along an axis.
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
    fn place(&self, center: Vec3<F>) -> usize {
        let along = self.axis.of(center) - self.start;
        let place = (along * self.places_per_unit).floor_to_i32();
        place.clamp(0, BINS as i32 - 1) as usize
    }
}

/// The objects whose centers are at one place.
#[derive(Clone, Copy)]
struct Bin<F> {
    /// The box around all of them. If there are none, its lower corner is above its upper corner.
    bounds: Aabb<F>,
    count: usize,
}

impl<F: Real> Bin<F> {
    fn empty() -> Self {
        let far = Vec3::new(F::FARTHEST, F::FARTHEST, F::FARTHEST);
        Self { bounds: Aabb { min: far, max: -far }, count: 0 }
    }

    /// Adds the objects of another bin.
    fn add(&mut self, other: &Self) {
        self.bounds = self.bounds.joined(other.bounds);
        self.count += other.count;
    }

    /// The expected number of tests: in proportion to the rays through the box, times the number of objects.
    fn cost(&self) -> F {
        if self.count == 0 { F::ZERO } else { area(self.bounds) * F::from_u16(self.count as u16) }
    }
}

/// Half the area of a box's surface, which is in proportion to the rays through the box.
fn area<F: Real>(bounds: Aabb<F>) -> F {
    let Vec3 { x, y, z } = bounds.max - bounds.min;
    x * y + y * z + z * x
}

/// Brings the objects that belong in front to the front of the list, and returns their number.
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
