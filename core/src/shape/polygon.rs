//! A planar polygon, convex or concave: a hit of its plane counts if a half-line in the plane crosses the
//! outline an odd number of times (Haines, "Point in Polygon Strategies", Graphics Gems IV, 1994).

use super::tessellate::face;
use super::trapezoids::each_trapezoid;
use super::{
    Facet, Form, Geometry, Hull, Intersect, PreparedPlane, Silhouette, Tessellation, Tip, bounds_of,
};
use crate::arena::Arena;
use crate::fault::{Fault, check_point, check_size};
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// A planar polygon. Its front is the side from which the vertices run counterclockwise.
///
/// If the outline crosses itself, the parts that it winds around twice are holes (even-odd rule). If it
/// encloses as much area clockwise as counterclockwise, as a bow tie does, three vertices determine the
/// front: the first, and the two consecutive ones that span the largest triangle with it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Polygon<'a> {
    /// The outline: three vertices or more. An edge joins the last vertex to the first.
    pub vertices: &'a [Vec3],
}

#[cfg(feature = "serde")]
crate::read::read_struct!([] Polygon as Polygon<'m> { vertices });

impl<'a> Polygon<'a> {
    /// The polygon with this outline.
    pub const fn new(vertices: &'a [Vec3]) -> Self {
        Self { vertices }
    }

    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
        Arena::bytes::<Vec3<R>>(self.vertices.len())
    }

    /// The unit normal of the plane of all vertices.
    ///
    /// By Newell's method: the sum of the cross products of neighboring vertices, as seen from the first one,
    /// is twice the enclosed area along the normal (Sutherland, Sproull and Schumacker 1974).
    fn normal<S: Real<Setup = S>>(&self) -> Result<Vec3<S>, Fault> {
        let [first, .., last] = self.vertices else { return Err(Fault::NoArea) };
        let corner: Vec3<S> = first.to();
        let mut doubled_area = Vec3::ZERO;
        let mut largest = Vec3::ZERO;
        let mut previous = last.to() - corner;
        let mut extent = S::ZERO;
        for vertex in self.vertices {
            let vertex = vertex.to() - corner;
            let triangle = previous.cross(vertex);
            doubled_area = doubled_area + triangle;
            // Of several triangles that are equally large but for rounding, take the first.
            if triangle.length_squared() > largest.length_squared() * S::from_f32(1.01) {
                largest = triangle;
            }
            extent = extent.larger(vertex.length());
            previous = vertex;
        }
        let least = S::from_f32(1e-6) * extent * extent;
        let tolerance = S::from_f32(PLANARITY) * extent;
        let is_normal = |normal: Vec3<S>| {
            self.vertices.iter().all(|vertex| !(normal.dot(vertex.to() - corner).abs() > tolerance))
        };
        // If the outline crosses itself, the area may cancel and leave little but rounding: then try the
        // largest triangle.
        let mut found = Err(Fault::NoArea);
        for area in [doubled_area, largest] {
            if area.length() > least
                && let Some(normal) = area.normalized()
            {
                found = if is_normal(normal) { Ok(normal) } else { Err(Fault::NotPlanar) };
                if found.is_ok() {
                    break;
                }
            }
        }
        found
    }
}

/// The most that a vertex may be off the plane, as a share of the polygon's extent: more is no rounding.
const PLANARITY: f32 = 1e-3;

impl Geometry for Polygon<'_> {
    type Prepared<'m, R: Real>
        = PreparedPolygon<'m, R>
    where
        Self: 'm;

    fn bytes<R: Real>(&self) -> usize {
        self.const_bytes::<R>()
    }

    fn extent(&self) -> Extent {
        Extent::flat_between(self.vertices.iter().copied())
    }

    fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedPolygon<'m, R>, Fault>
    where
        Self: 'm,
    {
        self.vertices.iter().copied().try_for_each(check_point)?;
        let [first, ..] = self.vertices else { return Err(Fault::NoArea) };
        let normal: Vec3<R::Setup> = self.normal()?;
        // Drop the axis along which the polygon is thinnest: then the projection has the largest area.
        let (x, y, z) = (normal.x.abs(), normal.y.abs(), normal.z.abs());
        let dropped = if x >= y && x >= z {
            Projection::X
        } else if y >= z {
            Projection::Y
        } else {
            Projection::Z
        };
        let vertices = self.vertices;
        let edges = memory.store_with(vertices.len(), |i| {
            let place = |vertex: &Vec3| dropped.flatten(scale.point::<R>(vertex.to()));
            let (u, v) = place(vertices.get(i).unwrap_or(first));
            let (next_u, next_v) = place(vertices.get(i.wrapping_add(1)).unwrap_or(first));
            let slope = if next_v == v { R::ZERO } else { (next_u - u) / (next_v - v) };
            Vec3::new(u, v, slope)
        })?;
        // In floating point no size is too small for a polygon that has an area.
        if R::IS_FIXED_POINT {
            let sides = |vertex: &Vec3| (vertex.to::<R::Setup>() - first.to()).magnitude();
            let extent = vertices.iter().map(sides).fold(R::Setup::ZERO, R::Setup::larger);
            check_size(scale.length::<R>(extent))?;
        }
        let plane = PreparedPlane::new(normal, normal.dot(first.to()), scale);
        Ok(PreparedPolygon { plane, dropped, edges, rectangle: rectangle(edges) })
    }
}

/// The smallest and the largest u, and the smallest and the largest v, if the outline is a rectangle along
/// the axes.
fn rectangle<R: Real>(edges: &[Vec3<R>]) -> Option<[R; 4]> {
    let [a, b, c, d] = edges else { return None };
    let across_first = a.y == b.y && b.x == c.x && c.y == d.y && d.x == a.x;
    let along_first = a.x == b.x && b.y == c.y && c.x == d.x && d.y == a.y;
    let ordered = |p: R, q: R| if p < q { (p, q) } else { (q, p) };
    let ((least_u, most_u), (least_v, most_v)) = (ordered(a.x, c.x), ordered(a.y, c.y));
    (across_first || along_first).then_some([least_u, most_u, least_v, most_v])
}

/// A polygon that is at least so many times as long as wide may be thin as it is seen from its front.
const SLENDER: u16 = 4;

/// An outline of more vertices is taken for a round one, without tips.
const MOST_TIPS: usize = 64;

/// The projection of a polygon to two dimensions: the axis that is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Projection {
    X,
    Y,
    Z,
}

impl Projection {
    /// The two coordinates (u, v) of a point.
    fn flatten<R>(self, point: Vec3<R>) -> (R, R) {
        match self {
            Self::X => (point.y, point.z),
            Self::Y => (point.z, point.x),
            Self::Z => (point.x, point.y),
        }
    }

    /// The coordinate of a vector that is left out.
    fn height<R>(self, vector: Vec3<R>) -> R {
        match self {
            Self::X => vector.x,
            Self::Y => vector.y,
            Self::Z => vector.z,
        }
    }

    /// The point of the plane with the coordinates (u, v).
    // Not inlined: see `Hull::edges`.
    #[inline(never)]
    fn unflatten<R: Real>(self, u: R, v: R, plane: &PreparedPlane<R>) -> Vec3<R> {
        let PreparedPlane { normal: n, distance } = *plane;
        // The plane's equation yields the dropped coordinate. It divides by the largest coordinate of the
        // normal.
        let (nu, nv) = self.flatten(n);
        let rest = distance - nu * u - nv * v;
        match self {
            Self::X => Vec3::new(rest / n.x, u, v),
            Self::Y => Vec3::new(v, rest / n.y, u),
            Self::Z => Vec3::new(u, v, rest / n.z),
        }
    }
}

/// A [`Polygon`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedPolygon<'m, R> {
    plane: PreparedPlane<R>,
    dropped: Projection,
    /// For each vertex its coordinates u and v, and du/dv along the edge to the next vertex.
    edges: &'m [Vec3<R>],
    /// The outline as the ranges of u and v, if it is a rectangle along the axes.
    rectangle: Option<[R; 4]>,
}

impl<R: Real> PreparedPolygon<'_, R> {
    fn vertices(&self) -> impl Iterator<Item = Vec3<R>> {
        self.edges.iter().map(|edge| self.dropped.unflatten(edge.x, edge.y, &self.plane))
    }

    /// Whether the point (u, v) is inside the outline: the half-line from it toward +u crosses an odd number
    /// of edges. A vertex belongs to the edge above it, so that no vertex counts twice.
    fn encloses(&self, (u, v): (R, R)) -> bool {
        if let Some([least_u, most_u, least_v, most_v]) = self.rectangle {
            // Includes the same borders as the count of edges below.
            return u >= least_u && u < most_u && v >= least_v && v < most_v;
        }
        let mut inside = false;
        let Some(mut edge) = self.edges.last() else { return false };
        let mut begins_above = edge.y > v;
        for next in self.edges {
            let ends_above = next.y > v;
            if begins_above != ends_above && is_left(u, v, edge, next) {
                inside = !inside;
            }
            (edge, begins_above) = (next, ends_above);
        }
        inside
    }
}

/// Whether (u, v) lies on the left of the edge that begins at `edge` and ends at `next`.
#[inline]
fn is_left<R: Real>(u: R, v: R, edge: &Vec3<R>, next: &Vec3<R>) -> bool {
    if !R::IS_FIXED_POINT {
        return u < edge.x + (v - edge.y) * edge.z;
    }
    // In fixed point slopes may be out of range: compare exact products instead.
    let (along, across) = ((v - edge.y).times(next.x - edge.x), (u - edge.x).times(next.y - edge.y));
    if next.y > edge.y { across < along } else { across > along }
}

impl<R: Real> Intersect<R> for PreparedPolygon<'_, R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let t = self.plane.meet(ray, range)?;
        let [(u, v), (du, dv)] = [ray.origin, ray.direction].map(|vector| self.dropped.flatten(vector));
        self.encloses((u + du * t, v + dv * t)).then_some(t)
    }

    fn form(&self) -> Form<R> {
        self.plane.form()
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        bounds_of(self.vertices())
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        self.plane.surface(ray, t)
    }

    fn uv(&self, surface: &Surface<R>, scale: Scale) -> [R; 2] {
        self.plane.uv(surface, scale)
    }
}

impl<R: Real> Silhouette<R> for PreparedPolygon<'_, R> {
    // Not inlined: see `Hull::edges`.
    #[inline(never)]
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        if part > 0 {
            return None;
        }
        // Part 0: the rectangle along the longest edge.
        let corner = self.vertices().last()?;
        let (mut along, mut previous) = (Vec3::ZERO, corner);
        for vertex in self.vertices() {
            let edge = vertex - previous;
            along = if edge.length() > along.length() { edge } else { along };
            previous = vertex;
        }
        let along = along.normalized()?;
        let across = self.plane.normal.cross(along);
        let place =
            |vertex: Vec3<R>| Vec3::new(along.dot(vertex - corner), across.dot(vertex - corner), R::ZERO);
        let Aabb { min, max } = bounds_of(self.vertices().map(place))?;
        let size = max - min;
        if size.x < size.y * R::from_u16(SLENDER) {
            // Not slender: most often a face of a solid, which looks narrow only next to another face. The
            // bounds of the polygon are enough.
            return self.bounds().map(Hull::aligned);
        }
        let edges = [along * size.x, across * size.y, Vec3::ZERO];
        Some(Hull::edges(corner + along * min.x + across * min.y, edges))
    }

    /// One tip at each vertex. A vertex that is turned inward is the tip of a notch, which may be as thin.
    // Not inlined: see `Hull::edges`.
    #[inline(never)]
    fn tip(&self, number: usize) -> Option<Tip<R>> {
        let count = self.edges.len();
        if number >= count || count > MOST_TIPS {
            return None;
        }
        let vertex = |i: usize| {
            let edge = self.edges.get(i.checked_rem(count)?)?;
            Some(self.dropped.unflatten(edge.x, edge.y, &self.plane))
        };
        let ends = [vertex(number + count - 1)?, vertex(number + 1)?];
        Some(Tip { apex: vertex(number)?, ends, radius: R::ZERO })
    }

    fn each_facet(&self, _: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let normal = self.plane.normal;
        // Whether u and v are counterclockwise as seen from the front.
        let is_front = self.dropped.height(normal) > R::ZERO;
        each_trapezoid(self.edges, |corners| {
            let [a, b, c, d] =
                corners.map(|(u, v)| self.dropped.unflatten(R::from_setup(u), R::from_setup(v), &self.plane));
            let corners = if is_front { [a, b, c, d] } else { [d, c, b, a] };
            face(&corners, normal, 0, false, visit);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;
    use crate::math::Fixed;

    /// An arrow head with a notch, in the plane z = 0.
    const ARROW: [Vec3; 4] = [
        Vec3::new(0.0, 0.0, 0.0),
        Vec3::new(2.0, -2.0, 0.0),
        Vec3::new(0.0, 3.0, 0.0),
        Vec3::new(-2.0, -2.0, 0.0),
    ];

    fn down(x: f32, y: f32) -> (Vec3, Vec3) {
        (Vec3::new(x, y, 2.0), Vec3::new(0.0, 0.0, -1.0))
    }

    #[test]
    fn a_concave_outline_has_a_notch() {
        let arrow = Polygon::new(&ARROW);
        for (x, y) in [(0.0, 0.5), (0.0, 2.9), (1.5, -1.4), (-1.5, -1.4), (0.3, 0.0)] {
            let (origin, toward) = down(x, y);
            assert_meets(arrow, origin, toward, 2.0, [0.0, 0.0, 1.0]);
        }
        for (x, y) in [(0.0, -0.5), (0.0, -1.9), (1.0, -1.5), (1.5, 2.0), (0.0, 3.1), (3.0, 0.0)] {
            let (origin, toward) = down(x, y);
            assert_misses(arrow, origin, toward);
        }
        assert_misses(arrow, Vec3::new(0.0, 1.0, 2.0), Vec3::new(0.0, 0.0, 1.0));
        assert_misses(arrow, Vec3::new(-5.0, 1.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
    }

    #[test]
    fn each_corner_of_an_outline_of_few_is_a_tip() {
        let mut memory = Memory::new();
        let arrow = prepared::<_, f64>(Polygon::new(&ARROW), &mut memory).unwrap();
        let corners = [(3, 0, 1, false), (0, 1, 2, true), (1, 2, 3, true), (2, 3, 0, true)];
        for (number, (before, apex, next, is_sharp)) in corners.into_iter().enumerate() {
            let [before, apex, next] = [before, apex, next].map(|i: usize| ARROW[i].to());
            let tip = arrow.tip(number).unwrap();
            assert_eq!((tip, tip.is_sharp()), (Tip { apex, ends: [before, next], radius: 0.0 }, is_sharp));
        }
        assert_eq!(arrow.tip(4), None);
        let round: Vec<_> =
            (0..65).map(|i| Vec3::new((i as f32 * 0.09).cos(), (i as f32 * 0.09).sin(), 0.0)).collect();
        let mut memory = Memory::new();
        assert_eq!(prepared::<_, f64>(Polygon::new(&round), &mut memory).unwrap().tip(0), None);
    }

    #[test]
    fn every_orientation_is_the_same_polygon() {
        // A unit square, turned through all three planes and both windings.
        for (u, v, n) in [
            ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]),
            ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
            ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
        ] {
            let vec = |[x, y, z]: [f32; 3]| Vec3::new(x, y, z);
            let (u, v, n) = (vec(u), vec(v), vec(n));
            for sign in [1.0, -1.0] {
                let square = [Vec3::ZERO, u * sign, u * sign + v, v];
                let normal = n * sign;
                let origin = u * (0.25 * sign) + v * 0.75 + n * 3.0;
                let expected = [normal.x, normal.y, normal.z].map(f64::from);
                assert_meets(Polygon::new(&square), origin, -n, 3.0, expected);
                assert_misses(Polygon::new(&square), origin + v * 0.5, -n);
            }
        }
    }

    #[test]
    fn two_polygons_share_their_common_edge() {
        // Points on the edge, and on its ends, belong to one of the two polygons, never to both or none.
        let left = [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
        let right = left.map(|vertex| vertex + Vec3::new(1.0, 0.0, 0.0));
        for i in 1..100u16 {
            let point = Vec3::new(1.0, f32::from(i) / 100.0, 0.0);
            let inside = |outline: &[Vec3]| {
                let mut memory = Memory::new();
                let polygon = prepared::<_, f32>(Polygon::new(outline), &mut memory).unwrap();
                polygon.encloses(polygon.dropped.flatten(point))
            };
            assert!(inside(&left) != inside(&right), "{point:?}");
        }
    }

    #[test]
    fn an_outline_that_crosses_itself_encloses_both_its_sides() {
        let vec = |x: f32, y: f32| Vec3::new(x, y, 0.0);
        // Two triangles that meet in the middle and run in opposite directions: the areas cancel, or almost.
        for (height, front) in [(1.0, -1.0), (1.001, 1.0)] {
            let bow_tie = [vec(-1.0, -1.0), vec(-1.0, 1.0), vec(1.0, -height), vec(1.0, height)];
            for (x, y) in [(-0.9, 0.0), (-0.5, 0.4), (-0.5, -0.4), (0.9, 0.0), (0.5, 0.4), (0.5, -0.4)] {
                let (origin, toward) = down(x, y);
                assert_meets(Polygon::new(&bow_tie), origin, toward, 2.0, [0.0, 0.0, front]);
            }
            for (x, y) in [(0.0, 0.5), (0.0, -0.5), (-0.5, 0.6), (0.5, -0.6), (1.1, 0.0)] {
                let (origin, toward) = down(x, y);
                assert_misses(Polygon::new(&bow_tie), origin, toward);
            }
        }
    }

    #[test]
    fn a_bow_tie_in_any_plane_has_a_front() {
        // Turned and far from the origin, where only rounding is left of the area.
        let (right, up) = (Vec3::new(0.3, 0.7, -0.2), Vec3::new(-0.5, 0.1, 0.4));
        let front = up.cross(right).normalized().unwrap();
        let center = Vec3::new(3.1, -4.7, 2.3);
        let outline = [center - right - up, center - right + up, center + right - up, center + right + up];
        // If it begins at its second vertex, the first triangle is part of the other wing.
        for (outline, front) in [(outline, front), ([outline[1], outline[2], outline[3], outline[0]], -front)]
        {
            let mut memory = Memory::new();
            let bow_tie = prepared::<_, f32>(Polygon::new(&outline), &mut memory).unwrap();
            assert!((bow_tie.plane.normal - front).length() < 1e-5, "{:?}", bow_tie.plane.normal);
            let encloses = |point| bow_tie.encloses(bow_tie.dropped.flatten(point));
            assert!(encloses(center - right * 0.5) && encloses(center + right * 0.5));
            assert!(!encloses(center - up * 0.5) && !encloses(center + up * 0.5));
        }
    }

    #[test]
    fn rectangles_are_polygons() {
        // A square as a rectangle along the axes, and with a fifth vertex on its outline.
        let vec = |x: f32, y: f32| Vec3::new(x, y, 0.0);
        let square = [vec(-1.0, -2.0), vec(3.0, -2.0), vec(3.0, 1.0), vec(-1.0, 1.0)];
        let turned = [square[1], square[2], square[3], square[0]];
        let opposite = [square[3], square[2], square[1], square[0]];
        let pentagon = [square[0], square[1], square[2], vec(0.5, 1.0), square[3]];
        let inside = |outline: &[Vec3], point: Vec3| {
            let mut memory = Memory::new();
            let polygon = prepared::<_, f32>(Polygon::new(outline), &mut memory).unwrap();
            polygon.encloses(polygon.dropped.flatten(point))
        };
        let places = [-2.5, -2.0, -1.0, 0.3, 0.999, 1.0, 2.9, 3.0, 3.1];
        for point in places.iter().flat_map(|x| places.map(|y| vec(*x, y))) {
            for outline in [square, turned, opposite] {
                assert_eq!(inside(&outline, point), inside(&pentagon, point), "{point:?}");
            }
        }
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            let tilted = ARROW.map(|v| Vec3::new(v.x, v.y, 0.5 * v.x - 0.2 * v.y + 0.3) * (0.5 * extent));
            assert_no_self_hits(Polygon::new(&tilted), Vec3::ZERO, extent, 20_000);
        }
    }

    #[test]
    fn coordinates_are_lengths_in_its_plane() {
        let outline = [Vec3::new(1.0, 2.0, 3.0), Vec3::new(1.0, 2.0, 9.0), Vec3::new(7.0, 2.0, 9.0)];
        let triangle = Polygon::new(&outline);
        assert_uv(triangle, Vec3::new(2.0, 5.0, 8.0), Vec3::new(0.0, -1.0, 0.0), [2.0, -8.0]);
    }

    #[test]
    fn bad_polygons_are_refused() {
        assert_eq!(refusal(Polygon::new(&[])), Fault::NoArea);
        assert_eq!(refusal(Polygon::new(&ARROW[..2])), Fault::NoArea);
        let [a, b, c, d] = ARROW;
        assert_eq!(refusal(Polygon::new(&[a, b, a, b])), Fault::NoArea);
        assert_eq!(refusal(Polygon::new(&[a, b, c + Vec3::new(0.0, 0.0, 0.5), d])), Fault::NotPlanar);
        assert_eq!(refusal(Polygon::new(&[a, b, c, d * f32::INFINITY])), Fault::NotFinite);
        // A tiny one far away from the origin, for fixed point.
        let far = [a, b, c, d].map(|vertex| Vec3::new(3e5, 0.0, 0.0) + vertex * 0.04);
        let mut memory = Memory::new();
        assert_eq!(prepared::<_, Fixed>(Polygon::new(&far), &mut memory).unwrap_err(), Fault::TooSmall);
    }
}
