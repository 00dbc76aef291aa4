//! Meshes of any size, in pieces that a mesh of the core can be.

use std::collections::HashMap;

use rayline::Vec3;

/// A part of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Piece {
    /// Positions of its vertices in the whole mesh.
    pub(super) vertices: Vec<u32>,
    /// Its triangles, by positions in `vertices`.
    pub(super) triangles: Vec<[u16; 3]>,
}

/// Cuts a mesh in pieces of at most `most` vertices and triangles, in the order of its triangles. Pieces join without a gap, as they
/// have the same vertices where they do.
pub(super) fn pieces(triangles: &[[u32; 3]], vertices: usize, most: usize) -> Vec<Piece> {
    let most = most.min(usize::from(u16::MAX));
    if vertices <= most && triangles.len() <= most {
        let all = (0..vertices as u32).collect();
        let triangles = triangles.iter().map(|corners| corners.map(|corner| corner as u16)).collect();
        return vec![Piece { vertices: all, triangles }];
    }
    let mut pieces = Vec::new();
    let mut piece = Piece::default();
    let mut places = HashMap::new();
    for corners in triangles {
        // Three more vertices are the most that a triangle adds.
        if piece.vertices.len() + 3 > most || piece.triangles.len() >= most {
            pieces.push(core::mem::take(&mut piece));
            places.clear();
        }
        let triangle = corners.map(|corner| {
            *places.entry(corner).or_insert_with(|| {
                piece.vertices.push(corner);
                (piece.vertices.len() - 1) as u16
            })
        });
        piece.triangles.push(triangle);
    }
    pieces.push(piece);
    pieces
}

/// Whether a triangle is thicker than two millionths of its sides: twice as thick as the core demands, so that it never refuses a
/// mesh of which one is.
pub(super) fn has_area(triangle: &[u16; 3], vertices: &[Vec3]) -> bool {
    let [a, b, c] = triangle.map(|corner| vertices.get(usize::from(corner)).copied().unwrap_or(Vec3::ZERO));
    let (ab, ac) = ((b - a).to::<f64>(), (c - a).to::<f64>());
    ab.cross(ac).length() > 2e-6 * ab.length() * ac.length()
}
