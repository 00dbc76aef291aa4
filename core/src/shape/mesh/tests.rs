//! Tests of meshes: closed forms, rays at edges and vertices of a closed mesh, and the same bits with and
//! without boxes.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)]

use core::mem::MaybeUninit;
use std::collections::HashMap;
use std::vec;
use std::vec::Vec;

use super::super::testing::*;
use super::*;
use crate::hierarchy::Node;
use crate::limits::MAX_HIERARCHY_DEPTH;
use crate::math::Fixed;

/// A rectangle in the plane z = 1, counterclockwise as seen from above, cut from (0, 0) to (4, 3).
const RECTANGLE: Mesh = Mesh::new(
    &[Vec3::new(0.0, 0.0, 1.0), Vec3::new(4.0, 0.0, 1.0), Vec3::new(4.0, 3.0, 1.0), Vec3::new(0.0, 3.0, 1.0)],
    &[[0, 1, 2], [0, 2, 3]],
);

const DOWN: Vec3 = Vec3::new(0.0, 0.0, -1.0);

/// A mesh that owns its lists.
struct Owned {
    vertices: Vec<Vec3>,
    triangles: Vec<[u16; 3]>,
    normals: Option<Vec<Vec3>>,
}

impl Owned {
    fn lend(&self) -> Mesh<'_> {
        Mesh { normals: self.normals.as_deref(), ..Mesh::new(&self.vertices, &self.triangles) }
    }
}

/// A ball of 20 · 4ⁿ triangles: an icosahedron, each of whose triangles is cut in four, n times.
fn ball(cuts: u32, center: Vec3, radius: f32) -> Owned {
    let golden = (1.0 + 5f32.sqrt()) / 2.0;
    let mut points: Vec<Vec3> = Vec::new();
    for (one, other) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        points.extend([Vec3::new(0.0, one, other), Vec3::new(one, other, 0.0), Vec3::new(other, 0.0, one)]);
    }
    let unit = |point: Vec3| point.normalized().unwrap();
    let mut points: Vec<Vec3> = points.into_iter().map(unit).collect();
    let near = |a: Vec3, b: Vec3| (a - b).length() < 1.2;
    let mut triangles: Vec<[u16; 3]> = Vec::new();
    for (a, b, c) in (0..12).flat_map(|a| (a..12).flat_map(move |b| (b..12).map(move |c| (a, b, c)))) {
        let [p, q, r] = [a, b, c].map(|index| points[index]);
        if a < b && b < c && near(p, q) && near(q, r) && near(r, p) {
            let outward = (q - p).cross(r - p).dot(p) > 0.0;
            triangles.push(if outward { [a, b, c] } else { [a, c, b] }.map(|index| index as u16));
        }
    }
    for _ in 0..cuts {
        let mut middles = HashMap::new();
        let mut middle = |a: u16, b: u16| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push(unit(points[usize::from(a)] + points[usize::from(b)]));
                points.len() as u16 - 1
            })
        };
        let cut = |[a, b, c]: [u16; 3]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(cut).collect();
    }
    Owned {
        vertices: points.iter().map(|point| center + *point * radius).collect(),
        triangles,
        normals: Some(points),
    }
}

/// A ray in scaled units.
fn ray<R: Real>(scale: Scale, origin: Vec3, direction: Vec3) -> Ray<R> {
    let unit = direction.to::<R::Setup>().normalized().unwrap();
    Ray { origin: scale.point(origin.to()), direction: Vec3::from_setup(unit) }
}

/// Prepares a mesh for a scene that contains nothing else, and calls `look` with it.
fn with_prepared<R: Real>(mesh: Mesh, eye: Vec3, look: impl FnOnce(Scale, PreparedMesh<'_, R>)) {
    let mut memory = vec![MaybeUninit::uninit(); mesh.bytes::<R>()];
    let scale = Scale::new::<R>(mesh.extent(), eye);
    look(scale, mesh.prepare(scale, &mut Arena::new(&mut memory)).unwrap());
}

#[test]
fn met_inside_from_both_sides() {
    for (x, y) in [(1.0, 0.5), (1.0, 2.0), (3.9, 0.1), (0.1, 2.9), (2.0, 1.5), (4.0, 3.0)] {
        assert_meets(RECTANGLE, Vec3::new(x, y, 6.0), DOWN, 5.0, [0.0, 0.0, 1.0]);
        assert_meets(RECTANGLE, Vec3::new(x, y, -1.0), -DOWN, 2.0, [0.0, 0.0, 1.0]);
    }
    let slant = Vec3::new(2.0, 1.0, -2.0);
    assert_meets(RECTANGLE, Vec3::new(-1.0, -0.5, 3.0), slant, 3.0, [0.0, 0.0, 1.0]);
}

#[test]
fn missed_outside_along_and_behind() {
    for (x, y) in [(-0.01, 1.0), (1.0, -0.01), (4.01, 1.5), (2.0, 3.01), (-1.0, -1.0)] {
        assert_misses(RECTANGLE, Vec3::new(x, y, 6.0), DOWN);
    }
    assert_misses(RECTANGLE, Vec3::new(-1.0, 1.0, 1.0), Vec3::new(1.0, 0.0, 0.0));
    assert_misses(RECTANGLE, Vec3::new(1.0, 1.0, 6.0), -DOWN);
}

#[test]
fn on_a_shared_edge_the_first_triangle_is_met() {
    fn check<R: Real>() {
        let swapped = Mesh { triangles: &[[0, 2, 3], [0, 1, 2]], ..RECTANGLE };
        let apart = Mesh { triangles: &[[0, 2, 3], [0, 0, 0], [0, 1, 2]], ..RECTANGLE };
        for (mesh, above, below) in [(RECTANGLE, 1, 0), (swapped, 0, 1), (apart, 0, 2)] {
            with_prepared::<R>(mesh, Vec3::ZERO, |scale, mesh| {
                let part = |x, y| {
                    let ray = ray(scale, Vec3::new(x, y, 3.0), DOWN);
                    mesh.surface(&ray, mesh.intersect(&ray, Interval::AHEAD).unwrap()).part
                };
                assert_eq!((part(2.0, 2.0), part(2.0, 1.0)), (above, below));
                assert_eq!(part(2.0, 1.5), above.min(below));
            });
        }
    }
    check::<f32>();
    check::<f64>();
    check::<Fixed>();
}

/// A point on an edge, a vertex or a face of a mesh.
fn target(mesh: &Mesh, random: &mut Random) -> Vec3 {
    let mut number = || (random.next() + 1.0) / 2.0;
    let triangle = mesh.triangles[(number() * mesh.triangles.len() as f32) as usize];
    let [a, b, c] = triangle.map(|index| mesh.vertices[usize::from(index)]);
    let share = number();
    match (number() * 4.0) as u32 {
        0 => a,
        1 => a + (b - a) * share,
        // A point of an edge whose share is exact in binary.
        2 => a + (b - a) * ((share * 8.0).floor() / 8.0),
        _ => a + (b - a) * share + (c - a) * ((1.0 - share) * number()),
    }
}

/// Rays at edges and vertices meet the surface there, from inside and outside.
fn nothing_gets_through<R: Real>(center: Vec3, radius: f32) {
    let owned = ball(2, center, radius);
    let mesh = owned.lend();
    let mut random = Random(7);
    with_prepared::<R>(mesh, center + Vec3::new(3.0, 0.0, 0.0) * radius, |scale, prepared| {
        let tolerance = 2e-4 * radius + 4e-6 * center.magnitude();
        let mut tested = 0;
        while tested < 100_000 {
            let target = target(&mesh, &mut random);
            let inside = random.next() < 0.0;
            let origin = center + random.direction() * (radius * if inside { 0.5 } else { 1.5 });
            let direction = (target - origin).normalized().unwrap();
            // From outside, only aim at points that no other triangle hides.
            if !inside && direction.dot(target - center) > -0.3 * radius {
                continue;
            }
            tested += 1;
            let ray = ray(scale, origin, direction);
            let t = prepared.intersect(&ray, Interval::AHEAD);
            let t = t.unwrap_or_else(|| panic!("{ray:?} at {target:?} got through"));
            let distance = t.to_f32() / scale.to_f32();
            let expected = (target - origin).length();
            assert!((distance - expected).abs() < tolerance, "{ray:?}: {distance}, not {expected}");
        }
    });
}

#[test]
fn no_ray_gets_through_edges_and_vertices() {
    nothing_gets_through::<f32>(Vec3::ZERO, 1.0);
    nothing_gets_through::<f64>(Vec3::ZERO, 1.0);
    nothing_gets_through::<Fixed>(Vec3::ZERO, 1.0);
    nothing_gets_through::<f32>(Vec3::new(30.0, -20.0, 10.0), 1.0);
    nothing_gets_through::<Fixed>(Vec3::new(30.0, -20.0, 10.0), 1.0);
    nothing_gets_through::<f32>(Vec3::new(1.0, 2.0, 3.0), 1e-2);
}

/// Each ray has the same hits and surfaces with boxes and without.
fn boxes_change_no_byte<R: Real>(mesh: Mesh, extent: f32) {
    let mut random = Random(11);
    with_prepared::<R>(mesh, Vec3::new(9.0 * extent, 0.0, 0.0), |scale, boxed| {
        let mut order: Vec<u16> = (0..mesh.triangles.len() as u16).collect();
        order.retain(|triangle| boxed.0.corners(*triangle).and_then(normal).is_some());
        order.reverse();
        let parts = MeshData { hierarchy: Hierarchy::list(&order), ..*boxed.0 };
        let listed = PreparedMesh(&parts);
        let mut hits = 0;
        for i in 0..8000 {
            let origin = random.vector() * (extent * if i % 2 == 0 { 1.0 } else { 8.0 });
            let aim = if i % 3 == 0 { target(&mesh, &mut random) } else { random.vector() * extent };
            let direction = if i % 7 == 0 { DOWN } else { (aim - origin).normalized().unwrap_or(DOWN) };
            let ray = ray(scale, origin, direction);
            let mut range = Interval::AHEAD;
            while let Some(t) = listed.intersect(&ray, range) {
                hits += 1;
                assert_eq!(boxed.intersect(&ray, range), Some(t));
                let surface = boxed.surface(&ray, t);
                assert_eq!(surface, listed.surface(&ray, t));
                assert!(boxed.bounds().unwrap().contains(surface.point));
                range.min = t;
            }
            assert_eq!(boxed.intersect(&ray, range), None);
        }
        assert!(hits > 2000, "{hits} hits");
    });
}

#[test]
fn boxes_change_nothing() {
    let ball = ball(2, Vec3::new(0.1, -0.2, 0.0), 0.8);
    // Triangles of all sizes that cross each other, some of them twice, some without area.
    let mut random = Random(5);
    let vertices: Vec<Vec3> = (0..60).map(|_| random.vector()).collect();
    let mut index = || ((random.next() + 1.0) * 30.0) as u16;
    let mut triangles: Vec<[u16; 3]> = (0..90).map(|_| [index(), index(), index()]).collect();
    triangles.extend_from_within(10..30);
    let heap = Owned { vertices, triangles, normals: None };
    for mesh in [ball.lend(), heap.lend()] {
        boxes_change_no_byte::<f32>(mesh, 1.0);
        boxes_change_no_byte::<f64>(mesh, 1.0);
        boxes_change_no_byte::<Fixed>(mesh, 1.0);
    }
}

#[test]
fn normals_are_interpolated_and_give_way_where_they_cancel() {
    let up = Vec3::new(0.0, 0.0, 9.0);
    let (right, left) = (Vec3::new(1e-6, 0.0, 0.0), Vec3::new(-5.0, 0.0, 0.0));
    let origin = Vec3::new(3.0, 0.75, 6.0);
    // In the first triangle, with the weights 1/4, 1/2 and 1/4 of its corners.
    let smooth = Mesh { normals: Some(&[up, right, up, up]), ..RECTANGLE };
    let got = shading_normal(smooth, origin, DOWN);
    let expected = core::f64::consts::FRAC_1_SQRT_2;
    assert!((got[0] - expected).abs() < 3e-5 && (got[2] - expected).abs() < 3e-5, "{got:?}");
    for normals in [[left, right, left, up], [Vec3::ZERO; 4]] {
        let cancelled = Mesh { normals: Some(&normals), ..RECTANGLE };
        let got = shading_normal(cancelled, origin, DOWN);
        assert!((got[2] - 1.0).abs() < 1e-6, "{got:?}");
    }
    assert_eq!(shading_normal(RECTANGLE, origin, DOWN), [0.0, 0.0, 1.0]);
}

#[test]
fn triangles_without_area_are_never_met() {
    let vertices = [
        Vec3::new(0.0, 0.0, 0.0),
        Vec3::new(1.0, 1.0, 0.0),
        Vec3::new(3.0, 3.0, 0.0),
        Vec3::new(5.0, 0.0, -1.0),
        Vec3::new(5.0, 1.0, -1.0),
        Vec3::new(4.0, 1.0, -1.0),
    ];
    let mesh = Mesh::new(&vertices, &[[0, 1, 2], [0, 0, 2], [1, 1, 1], [3, 4, 5]]);
    for along in [0.0, 0.5, 1.0, 2.9] {
        assert_misses(mesh, Vec3::new(along, along, 2.0), DOWN);
    }
    assert_meets(mesh, Vec3::new(4.9, 0.9, 2.0), DOWN, 3.0, [0.0, 0.0, 1.0]);
    let none = Mesh { triangles: &mesh.triangles[..3], ..mesh };
    assert_eq!(refusal(none), Fault::NoTriangles);
}

#[test]
fn spawned_rays_do_not_meet_their_own_surface() {
    for extent in EXTENTS {
        let mesh = ball(0, Vec3::new(0.2, -0.1, 0.1) * extent, 0.8 * extent);
        assert_no_self_hits(mesh.lend(), Vec3::ZERO, extent, 20_000);
    }
}

#[test]
fn at_most_64_bytes_a_triangle() {
    let each = |mesh: Mesh, bytes: usize| bytes as f32 / mesh.triangles.len() as f32;
    let owned = ball(3, Vec3::ZERO, 1.0);
    let smooth = owned.lend();
    let flat = Mesh { normals: None, ..smooth };
    for mesh in [smooth, flat] {
        let most = if mesh.normals.is_some() { 47.9 } else { 44.9 };
        assert!(each(mesh, mesh.bytes::<f32>()) < most, "{}", each(mesh, mesh.bytes::<f32>()));
        assert_eq!(mesh.bytes::<f32>(), mesh.bytes::<Fixed>());
    }
    // As many vertices as triangles.
    let corners = vec![[0; 3]; owned.vertices.len()];
    let open = Mesh { triangles: &corners, ..smooth };
    assert!(each(open, open.bytes::<f32>()) < 57.0, "{}", each(open, open.bytes::<f32>()));
    // On 64-bit processors; addresses and lengths take half as much on 32-bit ones.
    assert!(size_of::<MeshData<'_, f32>>() <= 152);
}

#[test]
fn bad_meshes_are_refused() {
    let empty = Mesh::new(&[], &[]);
    assert_eq!(refusal(empty), Fault::NoTriangles);
    assert_eq!(refusal(Mesh { triangles: &[], ..RECTANGLE }), Fault::NoTriangles);
    let unknown = Mesh { triangles: &[[0, 1, 2], [0, 3, 4]], ..RECTANGLE };
    assert_eq!(refusal(unknown), Fault::UnknownVertex { triangle: 1, named: 4, vertices: 4 });
    let few = Mesh { normals: Some(&[DOWN; 3]), ..RECTANGLE };
    assert_eq!(refusal(few), Fault::NormalCount { normals: 3, vertices: 4 });
    #[cfg(feature = "textures")]
    assert_eq!(
        refusal(Mesh { colors: Some(&[[0; 3]; 3]), ..RECTANGLE }),
        Fault::ColorCount { colors: 3, vertices: 4 }
    );
    #[cfg(not(feature = "textures"))]
    assert_eq!(
        refusal(Mesh { colors: Some(&[[0; 3]; 4]), ..RECTANGLE }),
        Fault::WithoutFeature { feature: "textures" }
    );
    let nan = Vec3::new(0.0, f32::NAN, 0.0);
    assert_eq!(refusal(Mesh { vertices: &[DOWN, nan, DOWN, DOWN], ..RECTANGLE }), Fault::NotFinite);
    assert_eq!(refusal(Mesh { normals: Some(&[DOWN, DOWN, nan, DOWN]), ..RECTANGLE }), Fault::NotFinite);
    let (vertices, triangles) = (vec![DOWN; 65_536], vec![[0u16, 1, 2]; 65_536]);
    assert_eq!(refusal(Mesh { vertices: &vertices, ..RECTANGLE }), Fault::TooMany { given: 65_536 });
    assert_eq!(refusal(Mesh { triangles: &triangles, ..RECTANGLE }), Fault::TooMany { given: 65_536 });
}

#[test]
fn coordinates_are_weights_or_interpolated() {
    let at = |x, y| Vec3::new(x, y, 5.0);
    assert_uv(RECTANGLE, at(3.0, 0.75), DOWN, [0.5, 0.25]);
    assert_uv(RECTANGLE, at(1.0, 2.25), DOWN, [0.25, 0.5]);
    let uvs = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    let mapped = Mesh { uvs: Some(&uvs), ..RECTANGLE };
    assert_uv(mapped, at(3.0, 0.75), DOWN, [1.5, 0.25]);
    assert_uv(mapped, at(1.0, 2.25), DOWN, [0.5, 0.75]);
    assert_eq!(refusal(Mesh { uvs: Some(&uvs[1..]), ..RECTANGLE }), Fault::UvCount { uvs: 3, vertices: 4 });
    let bad = [[f32::NAN, 0.0]; 4];
    assert_eq!(refusal(Mesh { uvs: Some(&bad), ..RECTANGLE }), Fault::NotFinite);
}

#[test]
fn small_triangles_far_from_a_ray_are_not_met() {
    // The area of this triangle is 1e-11 of the products whose differences determine the sides.
    let size = 1e-6;
    let vertices = [Vec3::ZERO, Vec3::new(size, 0.0, 0.0), Vec3::new(size, size, 0.3 * size)];
    let mesh = Mesh::new(&vertices, &[[0, 1, 2]]);
    let mut random = Random(11);
    with_prepared::<f32>(mesh, Vec3::ZERO, |scale, mesh| {
        for _ in 0..100_000 {
            let (origin, direction) = (random.vector() * 3.0, random.direction());
            // Only test rays that pass at a distance of at least an eighth of the way.
            let aside = origin - direction * origin.dot(direction);
            if aside.length() > 0.125 * origin.length() {
                let met = mesh.intersect(&ray(scale, origin, direction), Interval::AHEAD);
                assert_eq!(met, None, "{origin:?} {direction:?}");
            }
        }
    });
}

/// Nodes in nodes, to this depth: each has a triangle in three boxes, and the next node in the fourth.
fn nested(depth: u16) -> BakedMesh<f32> {
    let node = |index: u16| {
        let last = if index + 1 == depth { (Some(1), 0) } else { (None, index + 1) };
        let leaf = (Some(1), 0);
        Node::new([[0.0; 4]; 3], [[4.0; 4]; 3], [leaf, leaf, leaf, last])
    };
    BakedMesh::new(BakedParts {
        triangles: RECTANGLE.triangles,
        uvs: &[],
        colors: &[],
        vertices: RECTANGLE.vertices,
        normals: &[],
        order: &[0],
        nodes: (0..depth).map(node).collect::<Vec<_>>().leak(),
        bounds: [Vec3::new(0.0, 0.0, 1.0), Vec3::new(4.0, 3.0, 1.0)],
        lift: 0.0,
        scale: 1.0,
        extent: 4.0,
    })
}

/// Rays once left out nodes that they had no room for.
#[test]
fn baked_meshes_are_no_deeper_than_rays_can_go() {
    let meet = |mesh: BakedMesh<f32>| {
        let mesh: &'static BakedMesh<f32> = std::boxed::Box::leak(std::boxed::Box::new(mesh));
        let prepared = mesh.prepare::<f32>(Scale::ONE, &mut Arena::new(&mut [])).unwrap();
        prepared.intersect(&Ray { origin: Vec3::new(3.0, 1.0, 5.0), direction: DOWN }, Interval::AHEAD)
    };
    assert_eq!(meet(nested(1)), Some(4.0));
    assert_eq!(meet(nested(MAX_HIERARCHY_DEPTH as u16)), Some(4.0));
    for depth in [MAX_HIERARCHY_DEPTH as u16 + 1, 60] {
        assert!(std::panic::catch_unwind(|| nested(depth)).is_err(), "{depth}");
    }
    // Each node is twice in the one before: rays would visit the last one a million times.
    let leaf = (Some(1), 0);
    let twice = |index: u16| if index < 20 { (None, index) } else { leaf };
    let nodes = (1..21)
        .map(|next| Node::<f32>::new([[0.0; 4]; 3], [[4.0; 4]; 3], [leaf, twice(next), leaf, twice(next)]));
    assert!(!Node::are_shallow(&nodes.collect::<Vec<_>>()));
    assert!(Node::<f32>::are_shallow(&[]));
}

/// A corner of an octahedron in the unit ball: each plane at a corner lies 1 - 1/3 above the middle of the
/// triangle along its own normal, which is at 1/√3 to the triangle's.
#[test]
fn rays_leave_the_smooth_surface_if_wanted() {
    let corners = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)];
    let mesh = Mesh { normals: Some(&corners), ..Mesh::new(&corners, &[[0, 1, 2]]) };
    let height = 1.0 / 3f64.sqrt();
    let leaves = |mesh: Mesh<'_>, from: f32| {
        let way = Vec3::new(-from, -from, -from);
        let point = surface_point(mesh, Vec3::new(from, from, from) * 2.0, way);
        assert!((point[0] - point[1]).abs() < 1e-6 && (point[1] - point[2]).abs() < 1e-6);
        point[0] * 3f64.sqrt()
    };
    let lifted = Mesh { smooth_terminator: true, ..mesh };
    assert!((leaves(mesh, 1.0) - height).abs() < 1e-6);
    assert!((leaves(lifted, 1.0) - height * (1.0 + 2.0 / 3.0)).abs() < 1e-4);
    // From behind, the surface is hollow.
    assert!((leaves(lifted, -1.0) - height).abs() < 1e-6);
    // All surfaces lie in the bounds.
    with_prepared::<f32>(lifted, Vec3::ZERO, |_, prepared| {
        let bounds = prepared.bounds().unwrap();
        assert!(prepared.is_lifted() && bounds.contains(Vec3::new(0.5556, 0.5556, 0.5556)));
    });
    assert_eq!(refusal(Mesh { normals: None, ..lifted }), Fault::TerminatorWithoutNormals);
}
