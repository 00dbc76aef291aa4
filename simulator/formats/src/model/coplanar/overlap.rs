//! Whether two triangles share a part of a plane.

use glam::{DVec2, DVec3};

/// A plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    point: DVec3,
    /// The unit normal on the side of the camera.
    normal: DVec3,
}

impl Plane {
    /// The distance of a point from the plane, positive on the side of the camera.
    pub(super) fn height(&self, point: DVec3) -> f64 {
        (point - self.point).dot(self.normal)
    }

    /// The shift that brings a point to this depth behind the plane; zero for a point that is as deep.
    pub(super) fn shift(&self, point: DVec3, depth: f64) -> DVec3 {
        -self.normal * (self.height(point) + depth).max(0.0)
    }
}

/// The plane of two triangles, if all of their corners lie within a tolerance of it, and the triangles cover
/// a common part that is wider than twice the tolerance.
pub(super) fn shared_plane(a: &[DVec3; 3], b: &[DVec3; 3], tolerance: f64, eye: DVec3) -> Option<Plane> {
    let (of_a, of_b) = (normal(a), normal(b));
    let (area_of_a, area_of_b) = (of_a.length(), of_b.length());
    if !(of_a.dot(of_b).abs() > 0.9 * area_of_a * area_of_b) {
        return None;
    }
    // The plane of the larger triangle is the more exact one.
    let (larger, other, normal) = if area_of_a >= area_of_b { (a, b, of_a) } else { (b, a, of_b) };
    let (normal, [point, ..]) = (normal.try_normalize()?, *larger);
    let is_behind = normal.dot(eye - point) < 0.0;
    let plane = Plane { point, normal: if is_behind { -normal } else { normal } };
    if other.iter().any(|corner| plane.height(*corner).abs() > tolerance) {
        return None;
    }
    let [a, b] = [a, b].map(|corners| corners.map(|corner| projected(corner, normal)));
    let is_apart = separates(&a, &b, 2.0 * tolerance) || separates(&b, &a, 2.0 * tolerance);
    (!is_apart).then_some(plane)
}

/// A normal of a triangle, as long as twice its area.
fn normal([a, b, c]: &[DVec3; 3]) -> DVec3 {
    (*b - *a).cross(*c - *a)
}

/// A point seen along the axis that is nearest to the normal.
fn projected(point: DVec3, normal: DVec3) -> DVec2 {
    let DVec3 { x, y, z } = normal.abs();
    match () {
        () if x >= y && x >= z => DVec2::new(point.y, point.z),
        () if y >= z => DVec2::new(point.z, point.x),
        () => DVec2::new(point.x, point.y),
    }
}

/// Whether all of a triangle lies beyond an edge of another one, or reaches no farther inside than `room`.
fn separates([a, b, c]: &[DVec2; 3], other: &[DVec2; 3], room: f64) -> bool {
    [(a, b, c), (b, c, a), (c, a, b)].into_iter().any(|(from, to, third)| {
        let across = (*to - *from).perp();
        let inward = if across.dot(*third - *from) < 0.0 { -across } else { across };
        let room = room * inward.length();
        other.iter().all(|corner| inward.dot(*corner - *from) <= room)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shared(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> bool {
        let [a, b] = [a, b].map(|corners| corners.map(DVec3::from_array));
        let shared = shared_plane(&a, &b, 1e-5, DVec3::Z);
        assert_eq!(shared.is_some(), shared_plane(&b, &a, 1e-5, DVec3::Z).is_some());
        shared.is_some()
    }

    #[test]
    fn triangles_share_a_plane_only_where_they_overlap() {
        let lower = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        // The other half of its square touches it along an edge.
        assert!(!shared(lower, [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]));
        assert!(!shared(lower, [[1.0, 5e-6, 0.0], [1.0, 1.0, 0.0], [5e-6, 1.0, 0.0]]));
        assert!(shared(lower, [[0.9, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]));
        // One inside of the other, turned over, and off by rounding.
        assert!(shared(lower, [[0.1, 0.1, 9e-6], [0.1, 0.2, 0.0], [0.2, 0.1, 0.0]]));
        assert!(!shared(lower, [[0.1, 0.1, 2e-5], [0.1, 0.2, 2e-5], [0.2, 0.1, 2e-5]]));
        // Their boxes overlap, but they do not.
        assert!(!shared(lower, [[0.9, 0.9, 0.0], [0.9, 0.2, 0.0], [0.2, 0.9, 0.0]]));
        // Upright in the plane.
        assert!(!shared(lower, [[0.1, 0.1, 0.0], [0.3, 0.1, 0.0], [0.2, 0.1, 1.0]]));
    }
}
