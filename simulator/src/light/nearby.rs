//! Which points are near a place: a k-d tree (Bentley, "Multidimensional Binary Search Trees Used for
//! Associative Searching", CACM 1975), as Jensen's photon map has it.

use std::collections::BinaryHeap;

use super::Vector;

/// Points in space, ready to be searched.
pub(super) struct Nearby<'p> {
    points: &'p [Vector],
    /// The positions of all points. The middle of each part divides it along the axis of the same place in
    /// `axes`: the left half lies below, the right half above.
    order: Vec<u32>,
    axes: Vec<u8>,
}

impl<'p> Nearby<'p> {
    pub(super) fn new(points: &'p [Vector]) -> Self {
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        let mut axes = vec![0; points.len()];
        divide(points, &mut order, &mut axes);
        Self { points, order, axes }
    }

    /// The distance of the point that is the `count`th nearest to a place, or of the farthest one if there
    /// are fewer.
    pub(super) fn distance(&self, place: Vector, count: usize) -> f64 {
        // Of numbers that are 0 or more, larger ones have larger bits.
        let mut nearest = BinaryHeap::with_capacity(count + 1);
        let mut most = f64::INFINITY;
        self.visit(0..self.order.len(), place, &mut |_, squared| {
            if squared < most {
                nearest.push(squared.to_bits());
                if nearest.len() > count {
                    nearest.pop();
                }
                if nearest.len() == count {
                    most = nearest.peek().map_or(most, |bits| f64::from_bits(*bits));
                }
            }
            most
        });
        nearest.peek().map_or(0.0, |bits| f64::from_bits(*bits).sqrt())
    }

    /// Calls a function with each point within a distance: its position in the list, and its distance.
    pub(super) fn within(&self, place: Vector, distance: f64, found: &mut impl FnMut(usize, f64)) {
        let most = distance * distance;
        self.visit(0..self.order.len(), place, &mut |position, squared| {
            if squared < most {
                found(position, squared.sqrt());
            }
            most
        });
    }

    /// Visits points of a part of the order: their positions and squared distances. The function returns the
    /// squared distance beyond which no point is of interest any more.
    fn visit(&self, part: core::ops::Range<usize>, place: Vector, see: &mut impl FnMut(usize, f64) -> f64) {
        if part.is_empty() {
            return;
        }
        let middle = part.start + part.len() / 2;
        let position = self.order[middle] as usize;
        let point = self.points[position];
        let beyond = along(place, self.axes[middle]) - along(point, self.axes[middle]);
        let (near, far) = (part.start..middle, middle + 1..part.end);
        let (near, far) = if beyond < 0.0 { (near, far) } else { (far, near) };
        self.visit(near, place, see);
        let most = see(position, (point - place).length_squared());
        if beyond * beyond <= most {
            self.visit(far, place, see);
        }
    }
}

/// Sorts a part of the points so that its middle divides it, along the axis on which it is longest.
fn divide(points: &[Vector], order: &mut [u32], axes: &mut [u8]) {
    if order.len() < 2 {
        return;
    }
    let length = |axis: &u8| {
        let places = || order.iter().map(|position| along(points[*position as usize], *axis));
        places().fold(f64::MIN, f64::max) - places().fold(f64::MAX, f64::min)
    };
    let axis = (0..3).max_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or_default();
    let middle = order.len() / 2;
    let key = |position: u32| along(points[position as usize], axis);
    order.select_nth_unstable_by(middle, |a, b| key(*a).total_cmp(&key(*b)).then(a.cmp(b)));
    axes[middle] = axis;
    let (left, right) = order.split_at_mut(middle);
    let (left_axes, right_axes) = axes.split_at_mut(middle);
    divide(points, left, left_axes);
    divide(points, &mut right[1..], &mut right_axes[1..]);
}

fn along(Vector { x, y, z }: Vector, axis: u8) -> f64 {
    [x, y, z][usize::from(axis)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_points_are_found_as_by_looking_at_all() {
        // Irregular, with points that are alike, in a plane and not.
        let point = |i: u64, flat: f64| {
            let [x, y, z] = [7, 11, 13].map(|step| ((i * i * step) % 97) as f64);
            Vector::new(x, y * flat, z)
        };
        let mut all = 0;
        for flat in [0.0, 1.0] {
            let points: Vec<_> = (0..300).map(|i| point(i, flat)).collect();
            let nearby = Nearby::new(&points);
            for place in (1000..1030).map(|i| point(i, 1.0)) {
                let mut expected: Vec<_> = points.iter().map(|p| (*p - place).length_squared()).collect();
                expected.sort_by(f64::total_cmp);
                for count in [1, 7, 300, 400] {
                    let distance = expected[count.min(300) - 1].sqrt();
                    assert_eq!(nearby.distance(place, count), distance, "{place:?}, {count}");
                }
                let mut found = Vec::new();
                nearby.within(place, 30.0, &mut |position, distance| {
                    assert_eq!((points[position] - place).length(), distance);
                    found.push(position);
                });
                found.sort_unstable();
                let near = (0..300).filter(|position| (points[*position] - place).length_squared() < 900.0);
                all += found.len();
                assert!(near.eq(found));
            }
        }
        assert!(all > 1000, "{all}");
        assert_eq!(Nearby::new(&[]).distance(Vector::ZERO, 3), 0.0);
    }
}
