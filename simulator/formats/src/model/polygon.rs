//! Triangles of polygons: ears are cut (Meisters, "Polygons Have Ears", American Mathematical Monthly 1975),
//! by the crate `earcut`.

use earcut::Earcut;
use glam::{DVec2, DVec3};

/// The triangles of polygons. The memory for cutting ears is used again for each polygon.
#[derive(Default)]
pub(crate) struct Polygons {
    earcut: Earcut<f64>,
    /// The corners of a polygon in its plane.
    flat: Vec<[f64; 2]>,
    cut: Vec<u32>,
}

/// The largest part of a polygon's area by which its triangles may differ.
const TOLERANCE: f64 = 1e-6;

/// The most corners of a polygon whose ears are cut: for spikes along a circle, the time grows with the
/// square of their number, to two seconds.
pub(crate) const MOST_CORNERS: usize = 1 << 16;

/// The normal of a polygon: the mean of those of its triangles, weighted by area (Newell's method). Its
/// length is twice the area. Zero for a polygon without an area.
pub(crate) fn normal(corners: &[DVec3]) -> DVec3 {
    let Some((first, rest)) = corners.split_first() else { return DVec3::ZERO };
    let edges = rest.iter().zip(rest.iter().skip(1));
    edges.map(|(a, b)| (*a - *first).cross(*b - *first)).sum()
}

impl Polygons {
    /// The triangles of a polygon, as positions in the list of its corners, and whether they cover it. A
    /// convex polygon becomes a fan around its first corner, and so does one that crosses itself or has more
    /// than [`MOST_CORNERS`], which a fan does not cover.
    ///
    /// A polygon that is bent is seen from its mean normal.
    pub(crate) fn triangles(&mut self, corners: &[DVec3]) -> (Vec<[u32; 3]>, bool) {
        let fan = || (2..corners.len() as u32).map(|last| [0, last - 1, last]).collect::<Vec<_>>();
        let Some(normal) = normal(corners).try_normalize() else { return (fan(), true) };
        if corners.len() <= 3 {
            return (fan(), true);
        }
        let across = normal.any_orthonormal_vector();
        let (up, origin) = (normal.cross(across), corners.first().copied().unwrap_or_default());
        self.flat.clear();
        self.flat
            .extend(corners.iter().map(|corner| *corner - origin).map(|at| [at.dot(across), at.dot(up)]));
        // Seen from the normal, the polygon runs counterclockwise and its area is positive.
        let fan = fan();
        let (area, covered) = self.areas(&fan);
        if covered <= area * (1.0 + TOLERANCE) {
            return (fan, true);
        }
        if corners.len() > MOST_CORNERS {
            return (fan, false);
        }
        self.earcut.earcut_slice(&self.flat, &[], &mut self.cut);
        let mut cut = self.cut.as_chunks::<3>().0.to_vec();
        for triangle in &mut cut {
            if self.area(triangle) < 0.0 {
                triangle.reverse();
            }
        }
        let (_, covered) = self.areas(&cut);
        if (covered - area).abs() <= area * TOLERANCE { (cut, true) } else { (fan, false) }
    }

    /// The sum of the areas of triangles, and that of their absolute areas: both are the same if no triangle
    /// is turned over. All areas are doubled.
    fn areas(&self, triangles: &[[u32; 3]]) -> (f64, f64) {
        triangles
            .iter()
            .map(|triangle| self.area(triangle))
            .fold((0.0, 0.0), |(sum, covered), area| (sum + area, covered + area.abs()))
    }

    fn area(&self, triangle: &[u32; 3]) -> f64 {
        let [a, b, c] = triangle
            .map(|corner| self.flat.get(corner as usize).copied().map_or(DVec2::ZERO, DVec2::from_array));
        (b - a).perp_dot(c - a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The triangles of a polygon in the x-z plane, which need not be flat: each corner is x, z and y.
    fn triangles(corners: &[[f64; 3]]) -> (Vec<[u32; 3]>, bool) {
        let corners: Vec<_> = corners.iter().map(|[x, z, y]| DVec3::new(*x, *y, *z)).collect();
        Polygons::default().triangles(&corners)
    }

    #[test]
    fn convex_polygons_are_fans() {
        let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.3], [0.0, 1.0, 0.0]];
        assert_eq!(triangles(&square), (vec![[0, 1, 2], [0, 2, 3]], true));
        // A corner in the middle of an edge.
        let five = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
        assert_eq!(triangles(&five), (vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]], true));
    }

    #[test]
    fn ears_are_cut_where_a_fan_would_cover_more() {
        // An arrow head, in both directions, flat and bent. The notch is its second corner.
        let arrow = [[2.0, 3.0, 0.0], [1.0, 1.0, 0.0], [0.0, 3.0, 0.0], [1.0, -2.0, 0.0]];
        for lift in [0.0, 0.3] {
            let mut corners = arrow;
            corners[0][2] = lift;
            for _ in 0..2 {
                let (mut cut, covers) = triangles(&corners);
                assert!(covers);
                for triangle in &mut cut {
                    triangle.sort_unstable();
                }
                cut.sort_unstable();
                assert_eq!(cut, [[0, 1, 3], [1, 2, 3]]);
                corners.swap(0, 2);
            }
        }
    }

    #[test]
    fn a_polygon_that_crosses_itself_is_a_fan() {
        let (_, covers) = triangles(&[[0.0, 0.0, 0.0], [3.0, 3.0, 0.0], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
        assert!(!covers);
        // All corners on a line: there is no area to cover.
        assert!(triangles(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [2.0, 0.0, 0.0]]).1);
    }
}
