//! Splitting of large meshes into meshes that the core accepts.

use std::collections::HashMap;

use bumpalo::Bump;
use rayline::Vec3;
use rayline::limits::MAX_COUNT;
use rayline::shape::Mesh;

/// A mesh of any size, as in a file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Whole<'m> {
    pub(crate) vertices: &'m [Vec3],
    pub(crate) triangles: &'m [[u32; 3]],
    /// One for each vertex.
    pub(crate) normals: Option<&'m [Vec3]>,
    /// One for each vertex.
    pub(crate) uvs: Option<&'m [[f32; 2]]>,
    /// One for each vertex, as codes of sRGB.
    pub(crate) colors: Option<&'m [[u8; 3]]>,
}

impl Whole<'_> {
    /// Whether backs can be seen from outside: where the surface has an edge, or encloses the space in front
    /// of it. Vertices in one place count as one.
    pub(crate) fn shows_backs(&self) -> bool {
        let mut edges: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
        let mut volume = 0.0;
        let at = |corner: u32| self.vertices.get(corner as usize).copied().unwrap_or(Vec3::ZERO);
        let origin = self.triangles.first().map_or(Vec3::ZERO, |[corner, ..]| at(*corner));
        for [a, b, c] in self.triangles.iter().map(|triangle| triangle.map(at)) {
            let bits = |place: Vec3| [place.x, place.y, place.z].map(|number| (number + 0.0).to_bits());
            for (from, to) in [(a, b), (b, c), (c, a)].map(|(from, to)| (bits(from), bits(to))) {
                // One direction counts up, and the other down.
                let (edge, count) = if from < to { ([from, to], 1) } else { ([to, from], -1) };
                if from != to {
                    *edges.entry(edge).or_default() += count;
                }
            }
            let [a, b, c] = [a, b, c].map(|corner| (corner - origin).to::<f64>());
            volume += a.dot(b.cross(c));
        }
        volume <= 0.0 || edges.values().any(|count| *count != 0)
    }

    /// The meshes of the core that it is split into, without those that have no area.
    pub(crate) fn meshes<'a>(&self, arena: &'a Bump) -> Vec<Mesh<'a>> {
        let of_piece = |piece: Piece| {
            let vertices = pick(arena, &piece, self.vertices, Vec3::ZERO);
            let corner = |index: u16| vertices.get(usize::from(index)).copied().unwrap_or(Vec3::ZERO);
            piece.triangles.iter().any(|triangle| has_area(triangle.map(corner))).then(|| Mesh {
                vertices,
                triangles: arena.alloc_slice_copy(&piece.triangles),
                normals: self.normals.map(|normals| pick(arena, &piece, normals, Vec3::ZERO)),
                uvs: self.uvs.map(|uvs| pick(arena, &piece, uvs, [0.0; 2])),
                colors: self.colors.map(|colors| pick(arena, &piece, colors, [u8::MAX; 3])),
                smooth_terminator: false,
            })
        };
        pieces(self.triangles, self.vertices.len(), MAX_COUNT).into_iter().filter_map(of_piece).collect()
    }
}

/// Selects the data of a piece's vertices from the data of the whole mesh's vertices.
fn pick<'a, T: Copy>(arena: &'a Bump, piece: &Piece, from: &[T], missing: T) -> &'a [T] {
    let indices = piece.vertices.iter();
    arena.alloc_slice_fill_iter(indices.map(|index| from.get(*index as usize).copied().unwrap_or(missing)))
}

/// A piece of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
struct Piece {
    /// The positions of its vertices in the whole mesh.
    vertices: Vec<u32>,
    /// Its triangles, as positions in `vertices`.
    triangles: Vec<[u16; 3]>,
}

/// Splits a mesh into pieces of at most `most` vertices and triangles, in the order of its triangles. There
/// are no gaps, because neighboring pieces have copies of the same vertices.
fn pieces(triangles: &[[u32; 3]], vertices: usize, most: usize) -> Vec<Piece> {
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
        // A triangle adds at most three vertices.
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

/// Whether a triangle is thicker than two millionths of its sides. The limit of the core is half of this, so
/// the core never refuses a triangle that passes this test, or a mesh with such a triangle.
pub(crate) fn has_area(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(Vec3::to::<f64>);
    let (ab, ac) = (b - a, c - a);
    ab.cross(ac).length() > 2e-6 * ab.length() * ac.length()
}

#[cfg(test)]
#[allow(clippy::indexing_slicing)]
mod tests {
    use super::*;

    #[test]
    fn open_and_inverted_meshes_show_their_backs() {
        let vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]];
        let vertices = vertices.map(|[x, y, z]| Vec3::new(x as f32, y as f32, z as f32));
        // A tetrahedron with its fronts outside; two of its corners are one place.
        let closed = [[0u32, 2, 1], [4, 1, 3], [0, 3, 2], [1, 2, 3]];
        let shows_backs = |triangles: &[[u32; 3]]| {
            let (vertices, normals, uvs, colors) = (&vertices, None, None, None);
            Whole { vertices, triangles, normals, uvs, colors }.shows_backs()
        };
        assert!(!shows_backs(&closed));
        assert!(shows_backs(&closed[1..]));
        assert!(shows_backs(&closed.map(|[a, b, c]| [a, c, b])));
        let [first, rest @ ..] = closed;
        let [a, b, c] = first;
        assert!(shows_backs(&[&[[a, c, b]], &rest[..]].concat()));
    }

    #[test]
    fn large_meshes_are_cut_in_pieces() {
        // A strip of squares, in pieces of at most ten vertices and six triangles.
        let squares = (0..50u32).map(|i| [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3]);
        let strip: Vec<_> = squares.flat_map(|[a, b, c, d]| [[a, b, c], [c, b, d]]).collect();
        for most in [3, 6, 10, 99] {
            let pieces = pieces(&strip, 102, most);
            let whole = pieces.iter().flat_map(|piece| {
                assert!(piece.vertices.len() <= most && piece.triangles.len() <= most);
                piece.triangles.iter().map(|triangle| triangle.map(|at| piece.vertices[usize::from(at)]))
            });
            assert_eq!(whole.collect::<Vec<_>>(), strip);
        }
        assert_eq!(pieces(&strip, 102, 102).len(), 1);
    }
}
