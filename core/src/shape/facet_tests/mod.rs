//! Tests of the facets of all shapes.

mod samples;

use std::collections::HashMap;

use super::testing::Random;
use super::*;
use crate::arena::Workspace;
use crate::math::Fixed;
use samples::{CENTER, shapes};

/// Memory for any of the shapes below.
type ShapeMemory = Workspace<32768>;

/// From where planes are seen.
const EYE: Vec3 = Vec3::new(1.5, 2.0, 4.0);
const SEGMENTS: u16 = 32;

#[test]
fn there_is_a_shape_of_each_kind() {
    for name in Shape::NAMES {
        assert!(
            shapes().iter().any(|(shape, _)| format!("{shape:?}").starts_with(&format!("{name}("))),
            "{name}"
        );
    }
}

/// A facet, in `f64`.
struct TestFacet {
    corners: [Vec3<f64>; 3],
    normals: [Vec3<f64>; 3],
    is_closed: bool,
    part: u32,
}

impl TestFacet {
    /// The vector at a right angle, whose length is twice the area.
    fn area(&self) -> Vec3<f64> {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// The distance at which a ray meets the facet (Möller and Trumbore 1997).
    fn meet(&self, ray: &Ray<f64>) -> Option<f64> {
        let [a, b, c] = self.corners;
        let (ab, ac, from_a) = (b - a, c - a, ray.origin - a);
        let across = ray.direction.cross(ac);
        let volume = ab.dot(across);
        let u = from_a.dot(across) / volume;
        let v = ray.direction.dot(from_a.cross(ab)) / volume;
        let t = ac.dot(from_a.cross(ab)) / volume;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
    }
}

/// A shape that is prepared alone, and its facets.
struct Tested<P> {
    name: String,
    prepared: P,
    facets: Vec<TestFacet>,
    scale: f32,
    /// The length of the diagonal of the bounds; for a plane, the height of the eye above it.
    size: f64,
}

fn double<R: Real>(v: Vec3<R>) -> Vec3<f64> {
    v.to_f32().to()
}

impl<P> Tested<P> {
    fn new<'m, R: Real, G: Geometry + 'm>(
        shape: G,
        segments: u16,
        room: &'m mut ShapeMemory,
    ) -> Tested<G::Prepared<'m, R>> {
        let scale = Scale::new::<R>(shape.extent(), EYE);
        let prepared = shape.prepare::<R>(scale, &mut Arena::new(room.lend())).expect("a legal shape");
        let tessellation = Tessellation { segments, eye: scale.point(EYE.to()) };
        let mut facets = vec![];
        prepared.each_facet(&tessellation, &mut |facet: &Facet<R>| {
            let Facet { corners, normals, part, is_closed } = *facet;
            facets.push(TestFacet {
                corners: corners.map(double),
                normals: normals.map(double),
                is_closed,
                part,
            });
        });
        let size = prepared
            .bounds()
            .map_or(2.5 * f64::from(scale.to_f32()), |bounds| double(bounds.max - bounds.min).length());
        Tested {
            name: format!("{shape:?} in {}", core::any::type_name::<R>()),
            prepared,
            facets,
            scale: scale.to_f32(),
            size,
        }
    }
}

/// Checks each shape in two number systems. A check returns a complaint, or nothing.
macro_rules! assert_for_each_shape {
    (|$tested:ident, $expected:ident| $check:block) => {
        let mut complaints = vec![];
        for (shape, $expected) in shapes() {
            let mut room = ShapeMemory::new();
            {
                let $tested = Tested::<()>::new::<f32, _>(shape, SEGMENTS, &mut room);
                let complaint: Option<String> = $check;
                complaints.extend(complaint.map(|complaint| format!("{}: {complaint}", $tested.name)));
            }
            let $tested = Tested::<()>::new::<Fixed, _>(shape, SEGMENTS, &mut room);
            let complaint: Option<String> = $check;
            complaints.extend(complaint.map(|complaint| format!("{}: {complaint}", $tested.name)));
        }
        assert!(complaints.is_empty(), "{}", complaints.join("\n"));
    };
}

fn converted<R: Real>(ray: Ray<f64>) -> Ray<R> {
    let [origin, direction] = [ray.origin, ray.direction].map(|vector| vector.to_f32().to());
    Ray { origin, direction }
}

/// The distances of all hits of a ray.
fn hits<R: Real>(shape: &impl Intersect<R>, ray: Ray<f64>) -> Vec<f64> {
    let ray = converted::<R>(ray);
    let (mut range, mut hits) = (Interval::AHEAD, vec![]);
    while let Some(t) = shape.intersect(&ray, range)
        && hits.len() < 32
    {
        hits.push(f64::from(t.to_f32()));
        range.min = t;
    }
    hits
}

/// The distance between a facet's corner and the surface, by rays near it: rays at the very border of a shape
/// may miss it.
fn distance_from_surface<R: Real>(
    shape: &impl Intersect<R>,
    facet: &TestFacet,
    corner: usize,
    size: f64,
) -> f64 {
    let [a, b, c] = facet.corners;
    let middle = (a + b + c) * (1.0 / 3.0);
    let (point, normal) = (facet.corners[corner], facet.normals[corner]);
    let height = 0.05 * size;
    let mut least = f64::INFINITY;
    let flat = facet.area().normalized().unwrap_or(normal);
    for toward in [normal, flat, (normal + flat).normalized().unwrap_or(normal)] {
        for share in [0.0, 1e-3, 1e-2] {
            for sign in [1.0, -1.0] {
                let direction = toward * sign;
                let aim = point + (middle - point) * share;
                let ray = Ray { origin: aim - direction * height, direction };
                for t in hits(shape, ray) {
                    least = least.min((ray.at(t) - point).length());
                }
            }
        }
    }
    least
}

#[test]
fn corners_lie_on_the_surface() {
    assert_for_each_shape!(|tested, _expected| {
        let Tested { prepared, facets, size, .. } = &tested;
        let mut most = 0f64;
        for facet in facets.iter().step_by(1 + facets.len() / 2000) {
            // Rays may miss a sliver. Far away on a plane, they do not have the digits.
            if facet.area().length() < 1e-5 * size * size || facet.corners[0].length() > 30.0 * size {
                continue;
            }
            for corner in 0..3 {
                most = most.max(distance_from_surface(prepared, facet, corner, *size));
            }
        }
        // The distance of the rays from the corner, not of the corner from the surface.
        (facets.is_empty() || most > 1e-3 * size).then(|| format!("{most:e} off, the size is {size}"))
    });
}

#[test]
fn winding_agrees_with_unit_normals() {
    assert_for_each_shape!(|tested, _expected| {
        let (mut right, mut all, mut off) = (0.0, 0.0, 0f64);
        for facet in &tested.facets {
            let area = facet.area();
            for normal in facet.normals {
                off = off.max((normal.length() - 1.0).abs());
                all += area.length();
                right += if area.dot(normal) > 0.0 { area.length() } else { 0.0 };
            }
        }
        // Cells cut the edges of combined solids: the normals of such a facet are those of both faces.
        let least = if tested.name.contains("Csg") { 0.98 } else { 0.999_999 };
        (right < least * all || off > 1e-5).then(|| format!("{} of the area, {off:e} off", right / all))
    });
}

/// Numbers the corners: those within `tolerance` of each other have one number.
fn numbered(facets: &[TestFacet], tolerance: f64) -> Vec<[usize; 3]> {
    let mut known = HashMap::<[i64; 3], Vec<usize>>::new();
    let mut places: Vec<Vec3<f64>> = vec![];
    let mut number = |corner: Vec3<f64>| {
        let [x, y, z] = [corner.x, corner.y, corner.z].map(|x| (x / tolerance).floor() as i64);
        for (i, j, k) in (0..27).map(|n| (n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)) {
            for place in known.get(&[x + i, y + j, z + k]).into_iter().flatten() {
                if (places[*place] - corner).length() < tolerance {
                    return *place;
                }
            }
        }
        places.push(corner);
        known.entry([x, y, z]).or_default().push(places.len() - 1);
        places.len() - 1
    };
    facets.iter().map(|facet| facet.corners.map(&mut number)).collect()
}

/// Each edge is shared by two facets, which pass it in opposite directions.
#[test]
fn closed_shapes_are_watertight() {
    assert_for_each_shape!(|tested, expected| {
        let Tested { facets, size, .. } = &tested;
        let is_closed = expected.volume.is_some();
        // For each edge, how often it is passed in each direction.
        let mut edges = HashMap::<(usize, usize), [u32; 2]>::new();
        for [a, b, c] in numbered(facets, 1e-6 * size) {
            for (from, to) in [(a, b), (b, c), (c, a)].into_iter().filter(|(from, to)| from != to) {
                edges.entry((from.min(to), from.max(to))).or_default()[usize::from(from < to)] += 1;
            }
        }
        let open = edges.values().filter(|[one, other]| one != other).count();
        let joined = edges.values().filter(|[one, _]| *one != 1).count();
        let is_wrong =
            facets.iter().any(|facet| facet.is_closed != is_closed) || is_closed && (open > 0 || joined > 0);
        is_wrong.then(|| format!("of {} edges, {open} are open, {joined} not shared by two", edges.len()))
    });
}

#[test]
fn closed_shapes_have_their_volume() {
    assert_for_each_shape!(|tested, expected| {
        let Tested { facets, scale, .. } = &tested;
        // The divergence theorem.
        let sum: f64 = facets.iter().map(|facet| facet.corners[0].dot(facet.area())).sum();
        let volume = sum / 6.0 / f64::from(*scale).powi(3);
        let off = expected.volume.map_or(0.0, |expected| (volume / expected - 1.0).abs() * 100.0);
        (off > expected.percent).then(|| format!("the volume is {volume}, not {:?}", expected.volume))
    });
}

/// Of many rays, how many meet a shape, how many its facets, and how many both.
fn met<R: Real, P: Intersect<R>>(tested: &Tested<P>) -> [f64; 3] {
    let Tested { prepared, facets, size, .. } = tested;
    let mut random = Random(17);
    let (mut shape, mut by_facets, mut both) = (0.0, 0.0, 0.0);
    let middle = prepared.bounds().map_or(Vec3::ZERO, |bounds| double(bounds.center()));
    for _ in 0..1500 {
        let origin = middle + random.direction().to::<f64>() * *size;
        let aim = middle + random.vector().to::<f64>() * (*size * 0.4);
        let ray = Ray { origin, direction: (aim - origin).normalized().expect("a direction") };
        let meets_shape = !hits(prepared, ray).is_empty();
        let meets_facets = facets.iter().any(|facet| facet.meet(&ray).is_some());
        shape += f64::from(u8::from(meets_shape));
        by_facets += f64::from(u8::from(meets_facets));
        both += f64::from(u8::from(meets_shape && meets_facets));
    }
    [shape, by_facets, both]
}

#[test]
fn rays_that_meet_a_shape_meet_its_facets() {
    assert_for_each_shape!(|tested, _expected| {
        let [shape, facets, both] = met(&tested);
        let is_wrong = shape < 100.0 || both < 0.97 * shape || both < 0.97 * facets;
        is_wrong.then(|| format!("{shape} rays meet the shape, {facets} the facets, {both} both"))
    });
}

/// A ball or its lower half, as somebody else may describe it.
#[derive(Clone, Copy, Debug)]
struct Own {
    is_solid: bool,
}

#[derive(Clone, Copy, Debug)]
struct PreparedOwn<R: Real> {
    sphere: PreparedSphere<R>,
    rim: R,
    is_solid: bool,
}

impl Geometry for Own {
    type Prepared<'m, R: Real> = PreparedOwn<R>;

    fn extent(&self) -> Extent {
        Extent::solid(2.0)
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, memory: &mut Arena<'m>) -> Result<PreparedOwn<R>, Fault>
    where
        Self: 'm,
    {
        let sphere = Sphere::new(CENTER, 1.0).prepare(scale, memory)?;
        Ok(PreparedOwn { sphere, rim: scale.length(R::Setup::from_f32(0.4)), is_solid: self.is_solid })
    }
}

impl<R: Real> Intersect<R> for PreparedOwn<R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let inside = self.sphere.spans(ray);
        let mut ends = inside.as_slice().iter().flat_map(|part| [part.min, part.max]);
        ends.find(|t| range.contains(*t) && (self.is_solid || ray.at(*t).y < self.rim))
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        self.sphere.bounds()
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        if self.is_solid { self.sphere.spans(ray) } else { Spans::NONE }
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        self.sphere.surface(ray, t)
    }

    fn uv(&self, surface: &Surface<R>, scale: Scale) -> [R; 2] {
        self.sphere.uv(surface, scale)
    }
}

impl<R: Real> Silhouette<R> for PreparedOwn<R> {}

/// By the default of [`Silhouette::each_facet`].
#[test]
fn shapes_of_ones_own_have_facets() {
    fn check<R: Real>(is_solid: bool) {
        let mut room = ShapeMemory::new();
        let tested = Tested::<()>::new::<R, _>(Own { is_solid }, SEGMENTS, &mut room);
        let [shape, facets, both] = met(&tested);
        let least = if is_solid { 0.98 } else { 0.93 };
        assert!(both > least * shape && both > 0.99 * facets, "{shape}, {facets}, {both}");
        for facet in &tested.facets {
            assert_eq!(facet.is_closed, is_solid);
            assert!(facet.normals.iter().all(|normal| normal.dot(facet.area()) >= 0.0));
        }
    }
    for is_solid in [true, false] {
        check::<f32>(is_solid);
        check::<f64>(is_solid);
        check::<Fixed>(is_solid);
    }
}

#[test]
fn parts_are_those_of_surfaces() {
    assert_for_each_shape!(|tested, _expected| {
        let Tested { prepared, facets, size, .. } = &tested;
        let (mut same, mut all) = (0, 0);
        for facet in facets.iter().step_by(1 + facets.len() / 2000) {
            let [a, b, c] = facet.corners;
            let Some(normal) = facet.area().normalized() else { continue };
            let height = size * 0.02;
            let origin = (a + b + c) * (1.0 / 3.0) + normal * height;
            if let Some(part) = part_near(prepared, Ray { origin, direction: -normal }, height) {
                all += 1;
                same += u32::from(part == facet.part);
            }
        }
        // Where a cell is cut by several faces, a facet is of one of them.
        let least = if tested.name.contains("Csg") { 0.9 } else { 1.0 };
        (f64::from(same) < least * f64::from(all)).then(|| format!("{same} of {all}"))
    });
}

/// The part of the shape that the ray meets near this distance.
fn part_near<R: Real>(shape: &impl Intersect<R>, ray: Ray<f64>, distance: f64) -> Option<u32> {
    let near = |share: f64| R::from_f32((distance * share) as f32);
    let ray = converted(ray);
    let t = shape.intersect(&ray, Interval { min: near(0.5), max: near(1.5) })?;
    Some(shape.surface(&ray, t).part)
}
