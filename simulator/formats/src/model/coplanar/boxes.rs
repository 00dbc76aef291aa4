//! A tree of boxes that finds the triangles of earlier objects near a triangle.

/// A triangle with the box around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
    /// The position of the object in the scene.
    pub(super) object: u32,
    /// The position of the body in the list of bodies.
    pub(super) body: u32,
    /// The position of the triangle in the body.
    pub(super) triangle: u32,
}

/// The box around several items.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: [f32; 3],
    high: [f32; 3],
    /// The earliest object of the items.
    first: u32,
}

/// A balanced binary tree. The children of node n are nodes 2 n + 1 and 2 n + 2, and each has one half of its
/// items.
#[derive(Clone, Debug)]
pub(super) struct Boxes {
    items: Vec<Item>,
    nodes: Vec<Node>,
}

/// The most items of a node without children.
const LEAF: usize = 4;

impl Boxes {
    pub(super) fn new(mut items: Vec<Item>) -> Self {
        let levels = items.len().div_ceil(LEAF).next_power_of_two();
        let nothing = Node { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3], first: u32::MAX };
        let mut nodes = vec![nothing; 2 * levels - 1];
        let mut open = vec![(0, 0, items.len())];
        while let Some((node, start, end)) = open.pop() {
            let (Some(part), Some(place)) = (items.get_mut(start..end), nodes.get_mut(node)) else {
                continue;
            };
            for item in &*part {
                place.low = each(place.low, item.low, f32::min);
                place.high = each(place.high, item.high, f32::max);
                place.first = place.first.min(item.object);
            }
            if part.len() > LEAF {
                let half = part.len() / 2;
                let axis = widest(place);
                // Equal boxes are split by their objects, so that those of later objects are passed over.
                part.select_nth_unstable_by(half, |a, b| {
                    middle(a, axis).total_cmp(&middle(b, axis)).then(a.object.cmp(&b.object))
                });
                open.push((2 * node + 2, start + half, end));
                open.push((2 * node + 1, start, start + half));
            }
        }
        Self { items, nodes }
    }

    /// Visits the items of earlier objects whose boxes overlap that of an item, as long as `found` is true.
    /// Each box and each item takes one of `steps`; without any left, the search ends.
    pub(super) fn visit(&self, item: &Item, steps: &mut u64, mut found: impl FnMut(&Item) -> bool) {
        let overlaps = |low: &[f32; 3], high: &[f32; 3], first| {
            let (below, above) = (low.iter().zip(&item.high), high.iter().zip(&item.low));
            first < item.object
                && below.into_iter().all(|(a, b)| a <= b)
                && above.into_iter().all(|(a, b)| a >= b)
        };
        let mut open = vec![(0, 0, self.items.len())];
        while let Some((node, start, end)) = open.pop() {
            let Some(Node { low, high, first }) = self.nodes.get(node) else { continue };
            *steps = steps.saturating_sub(1);
            if *steps == 0 || !overlaps(low, high, *first) {
                continue;
            }
            if end - start > LEAF {
                let half = start + (end - start) / 2;
                // The second half first: where boxes are equal, its objects lie deeper.
                open.push((2 * node + 1, start, half));
                open.push((2 * node + 2, half, end));
                continue;
            }
            let near = self.items.get(start..end).into_iter().flatten();
            for other in near.filter(|other| overlaps(&other.low, &other.high, other.object)) {
                *steps = steps.saturating_sub(1);
                if !found(other) {
                    return;
                }
            }
        }
    }
}

/// The coordinates of two corners, put together one by one.
pub(super) fn each(a: [f32; 3], b: [f32; 3], of: impl Fn(f32, f32) -> f32) -> [f32; 3] {
    let ([ax, ay, az], [bx, by, bz]) = (a, b);
    [of(ax, bx), of(ay, by), of(az, bz)]
}

/// The axis along which a box is widest.
fn widest(node: &Node) -> usize {
    let [x, y, z] = each(node.high, node.low, |high, low| high - low);
    if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    }
}

/// Twice the middle of a box along an axis.
fn middle(item: &Item, axis: usize) -> f32 {
    let at = |corner: &[f32; 3]| corner.get(axis).copied().unwrap_or(0.0);
    at(&item.low) + at(&item.high)
}
