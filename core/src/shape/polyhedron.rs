//! A convex polyhedron: all points behind all of its planes (Haines, "Fast Ray-Convex Polyhedron
//! Intersection", Graphics Gems II, 1991).
//!
//! # Vertices
//! The bounds are those of the vertices. To find these, the common line of each pair of planes is cut by all
//! other planes, as a ray is: the part that is left is an edge. If an edge has no end, or there is no edge at
//! all, the planes do not enclose a solid. This needs no memory, and a number of steps that grows with the
//! cube of the number of planes: 130,000 for [`MAX_FACES`].

use super::chord::Chord;
use super::clip::Outline;
use super::tessellate::face;
use super::{
    Facet, Geometry, Intersect, Plane, PreparedPlane, Silhouette, Spans, Tessellation, project_onto_plane, uv,
};
use crate::arena::Arena;
use crate::fault::{Fault, check_coordinate, check_direction, check_point, check_size};
use crate::limits::{MAX_COORDINATE, MAX_FACES};
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// A convex solid with flat faces.
///
/// The [part](Surface::part) of a hit is the index of the face's plane in `planes`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ConvexPolyhedron<'a> {
    /// The planes of the faces, with outward normals; at most [`MAX_FACES`].
    pub planes: &'a [Plane],
}

#[cfg(feature = "serde")]
crate::read::read_struct!([] ConvexPolyhedron as ConvexPolyhedron<'m> { planes });

impl<'a> ConvexPolyhedron<'a> {
    /// The solid behind all of these planes.
    pub const fn new(planes: &'a [Plane]) -> Self {
        Self { planes }
    }

    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
        Arena::bytes::<PreparedPlane<R>>(self.planes.len())
    }

    /// Calls `each` with both ends of each edge, and with a number for how well each end is determined: 1 if
    /// the planes meet there at right angles, less if they meet at a small angle.
    fn vertices<S: Real>(&self, mut each: impl FnMut(Vec3<S>, S)) -> Result<(), Fault> {
        // Vertices beyond this are refused in any case.
        let endless = S::from_f32(8.0 * MAX_COORDINATE);
        for (i, one) in self.planes.iter().enumerate() {
            for (j, other) in self.planes.iter().enumerate().skip(i.wrapping_add(1)) {
                let Some((line, sine)) = CommonLine::common(one, other)? else { continue };
                let (mut from, mut to) = ((-endless, S::ONE), (endless, S::ONE));
                for (k, plane) in self.planes.iter().enumerate() {
                    if k != i && k != j {
                        line.clip(plane, &mut from, &mut to)?;
                    }
                }
                if from.0 < to.0 {
                    if !(from.0 > -endless && to.0 < endless) {
                        return Err(Fault::NotEnclosed);
                    }
                    for (t, slope) in [from, to] {
                        each(line.origin + line.direction * t, sine * slope);
                    }
                }
            }
        }
        Ok(())
    }
}

/// The common line of two planes.
struct CommonLine<S> {
    origin: Vec3<S>,
    direction: Vec3<S>,
}

/// Two planes, or a line and a plane, are parallel if the sine of their angle is at most this.
const PARALLEL: f32 = 1e-5;

impl<S: Real> CommonLine<S> {
    /// The line, and the sine of the angle between the planes; `None` if they are parallel.
    fn common(one: &Plane, other: &Plane) -> Result<Option<(Self, S)>, Fault> {
        let (normal, across): (Vec3<S>, Vec3<S>) =
            (check_direction(one.normal)?, check_direction(other.normal)?);
        let (direction, sine) = normal.cross(across).unit_and_length();
        if !(sine > S::from_f32(PARALLEL)) {
            return Ok(None);
        }
        // Go from the point of the first plane, within it and at a right angle to the line, to the second
        // plane.
        let start: Vec3<S> = one.point.to();
        let height = across.dot(other.point.to() - start);
        Ok(Some((Self { origin: start + direction.cross(normal) * (height / sine), direction }, sine)))
    }

    /// Cuts off the part of the line in front of a plane. With each end is stored the sine of the angle
    /// between the line and the plane that cut it.
    fn clip(&self, plane: &Plane, from: &mut (S, S), to: &mut (S, S)) -> Result<(), Fault> {
        let normal: Vec3<S> = check_direction(plane.normal)?;
        let beyond = plane.point.to() - self.origin;
        let height = normal.dot(beyond);
        let slope = normal.dot(self.direction);
        let t = height / slope;
        if slope.abs() <= S::from_f32(PARALLEL) {
            // A parallel plane cuts off all of the line or nothing. One that contains the line cuts off
            // nothing, since more than two planes may meet in it.
            if height < -S::from_f32(PARALLEL) * beyond.magnitude() {
                *to = *from;
            }
        } else if slope > S::ZERO {
            if t < to.0 {
                *to = (t, slope);
            }
        } else if t > from.0 {
            *from = (t, -slope);
        }
        Ok(())
    }
}

impl Geometry for ConvexPolyhedron<'_> {
    type Prepared<'m, R: Real>
        = PreparedPolyhedron<'m, R>
    where
        Self: 'm;

    fn bytes<R: Real>(&self) -> usize {
        self.const_bytes::<R>()
    }

    fn is_solid(&self) -> bool {
        true
    }

    fn extent(&self) -> Extent {
        let mut reach = 0f32;
        // A polyhedron without vertices is refused when it is prepared.
        let known = self.planes.len() <= MAX_FACES
            && self.vertices(|vertex: Vec3, _| reach = reach.larger(vertex.magnitude())).is_ok();
        Extent::flat(if known { reach } else { 0.0 })
    }

    fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedPolyhedron<'m, R>, Fault>
    where
        Self: 'm,
    {
        if self.planes.len() > MAX_FACES {
            return Err(Fault::TooManyFaces { given: self.planes.len() });
        }
        self.planes.iter().map(|plane| plane.point).try_for_each(check_point)?;
        let mut corners: Option<Aabb<R::Setup>> = None;
        let (mut sum, mut count, mut least_sure) = (Vec3::ZERO, R::Setup::ZERO, R::Setup::ONE);
        self.vertices(|vertex, sure| {
            let corner = Aabb::point(vertex);
            corners = Some(corners.map_or(corner, |corners| corners.union(corner)));
            (sum, count) = (sum + vertex, count + R::Setup::ONE);
            least_sure = if sure < least_sure { sure } else { least_sure };
        })?;
        let corners = corners.ok_or(Fault::NotEnclosed)?;
        let reach = corners.magnitude();
        check_coordinate(reach.to_f32())?;
        // The mean of the vertices lies inside, unless the solid has no volume.
        let (middle, size) = (sum * count.recip(), (corners.max - corners.min).magnitude());
        let planes = memory.try_store_with(self.planes.len(), |index, _| {
            let plane = self.planes.get(index).ok_or(Fault::NotEnclosed)?;
            let normal: Vec3<R::Setup> = check_direction(plane.normal)?;
            let depth = normal.dot(plane.point.to() - middle);
            if !(depth > R::Setup::from_f32(1e-6) * size) {
                return Err(Fault::NotEnclosed);
            }
            check_size(scale.length::<R>(depth))?;
            // A plane far outside might be out of range. At twice the solid's reach it still cuts off
            // nothing.
            let (distance, outside) = (normal.dot(plane.point.to()), reach + reach);
            let distance = if distance < outside { distance } else { outside };
            Ok(PreparedPlane::new(normal, distance, scale))
        })?;
        let scaled = Aabb { min: scale.point::<R>(corners.min), max: scale.point(corners.max) };
        // Rounding of planes moves a vertex farther if it is not well determined.
        let offset = R::offset(scaled.magnitude()).to_setup() / least_sure;
        let most = scale.setup::<R>(reach);
        let margin = R::from_setup(if offset < most { offset } else { most });
        Ok(PreparedPolyhedron { planes, bounds: scaled.padded(margin) })
    }
}

/// A [`ConvexPolyhedron`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedPolyhedron<'m, R> {
    planes: &'m [PreparedPlane<R>],
    bounds: Aabb<R>,
}

impl<R: Real> PreparedPolyhedron<'_, R> {
    /// The part of a ray's line inside the solid.
    fn chord(&self, ray: &Ray<R>) -> Chord<R> {
        let mut chord = Chord::whole();
        for PreparedPlane { normal, distance } in self.planes {
            chord.below(*distance - normal.dot(ray.origin), normal.dot(ray.direction));
            if !chord.is_left() {
                break;
            }
        }
        chord
    }

    /// The outline of a face. `None` if another plane in the list is the same: the face belongs to the first.
    fn face(&self, number: usize, plane: &PreparedPlane<R>) -> Option<Outline<R::Setup>> {
        let in_setup = |plane: &PreparedPlane<R>| (plane.normal.to_setup(), plane.distance.to_setup());
        let bounds = self.bounds.to_setup();
        let (normal, distance) = in_setup(plane);
        let middle = project_onto_plane(bounds.center(), normal, distance);
        let size = (bounds.max - bounds.min).length();
        let tolerance = R::offset(self.bounds.magnitude()).to_setup();
        let mut outline = Outline::square(middle, normal, size);
        for (other_number, other) in self.planes.iter().enumerate() {
            let (other_normal, other_distance) = in_setup(other);
            let height = (other_normal.dot(middle) - other_distance).abs();
            let is_same = height + (normal - other_normal).length() * size <= tolerance;
            if is_same && other_number < number {
                return None;
            }
            if !is_same {
                outline.clip(other_normal, other_distance);
            }
        }
        outline.join(tolerance);
        Some(outline)
    }
}

impl<R: Real> Intersect<R> for PreparedPolyhedron<'_, R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        self.chord(ray).first(range)
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        Some(self.bounds)
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        self.chord(ray).spans()
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let point = ray.at(t);
        // The hit belongs to the face whose plane it is the farthest in front of, or the least behind.
        let height = |plane: &PreparedPlane<R>| plane.normal.dot(point) - plane.distance;
        let mut nearest: Option<(R, u32, &PreparedPlane<R>)> = None;
        for (part, plane) in (0..).zip(self.planes) {
            let height = height(plane);
            if nearest.is_none_or(|(most, ..)| height > most) {
                nearest = Some((height, part, plane));
            }
        }
        let none = PreparedPlane { normal: -ray.direction, distance: R::ZERO };
        let (part, plane) = nearest.map_or((0, &none), |(_, part, plane)| (part, plane));
        Surface { part, ..plane.surface(ray, t) }
    }

    fn uv(&self, surface: &Surface<R>, scale: Scale) -> [R; 2] {
        uv::flat(surface.normal, surface.point, scale)
    }
}

impl<R: Real> Silhouette<R> for PreparedPolyhedron<'_, R> {
    fn each_facet(&self, _: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        for (part, plane) in (0..).zip(self.planes) {
            if let Some(outline) = self.face(part, plane) {
                face(&outline.rounded(), plane.normal, part as u32, true, visit);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;

    const fn plane(x: f32, y: f32, z: f32, distance: f32) -> Plane {
        let along = distance / (x * x + y * y + z * z);
        Plane::new(Vec3::new(x * along, y * along, z * along), Vec3::new(x, y, z))
    }

    /// Two wide, one high, four deep.
    const BLOCK: [Plane; 6] = [
        plane(-1.0, 0.0, 0.0, 1.0),
        plane(1.0, 0.0, 0.0, 1.0),
        plane(0.0, -1.0, 0.0, 0.0),
        plane(0.0, 1.0, 0.0, 1.0),
        plane(0.0, 0.0, -1.0, 2.0),
        plane(0.0, 0.0, 1.0, 2.0),
    ];

    /// All points whose absolute coordinates have a sum of at most 1.
    const OCTAHEDRON: [Plane; 8] = [
        plane(1.0, 1.0, 1.0, 1.0),
        plane(1.0, 1.0, -1.0, 1.0),
        plane(1.0, -1.0, 1.0, 1.0),
        plane(1.0, -1.0, -1.0, 1.0),
        plane(-1.0, 1.0, 1.0, 1.0),
        plane(-1.0, 1.0, -1.0, 1.0),
        plane(-1.0, -1.0, 1.0, 1.0),
        plane(-1.0, -1.0, -1.0, 1.0),
    ];

    const LEFT: Vec3 = Vec3::new(-1.0, 0.0, 0.0);
    const DOWN: Vec3 = Vec3::new(0.0, -1.0, 0.0);

    #[test]
    fn met_from_outside_and_from_inside() {
        let block = ConvexPolyhedron::new(&BLOCK);
        assert_meets(block, Vec3::new(5.0, 0.5, 1.5), LEFT, 4.0, [1.0, 0.0, 0.0]);
        assert_meets(block, Vec3::new(0.5, 0.5, 1.5), LEFT, 1.5, [-1.0, 0.0, 0.0]);
        assert_meets(block, Vec3::new(0.5, 5.0, -1.5), DOWN, 4.0, [0.0, 1.0, 0.0]);
        assert_misses(block, Vec3::new(1.1, 5.0, -1.5), DOWN);
        assert_misses(block, Vec3::new(5.0, 0.5, 1.5), -LEFT);
        assert_misses(block, Vec3::new(5.0, 1.5, 1.5), LEFT);
        let third = 3f64.sqrt().recip();
        let octahedron = ConvexPolyhedron::new(&OCTAHEDRON);
        assert_meets(octahedron, Vec3::new(0.25, 5.0, 0.25), DOWN, 4.5, [third, third, third]);
        assert_meets(octahedron, Vec3::new(-0.25, 5.0, 0.5), DOWN, 4.75, [-third, third, third]);
        assert_meets(octahedron, Vec3::new(0.0, 0.25, 0.125), LEFT, 0.625, [-third, third, third]);
        assert_misses(octahedron, Vec3::new(0.5, 5.0, 0.51), DOWN);
    }

    #[test]
    fn its_inside_is_a_chord() {
        let octahedron = ConvexPolyhedron::new(&OCTAHEDRON);
        assert_spans(octahedron, Vec3::new(0.25, 5.0, 0.25), DOWN, &[(4.5, 5.5)]);
        assert_spans(octahedron, Vec3::new(0.25, 0.25, 0.25), DOWN, &[(-0.25, 0.75)]);
        assert_spans(octahedron, Vec3::new(0.75, 0.0, 0.5), DOWN, &[]);
        for extent in EXTENTS {
            let (planes, middle) = gem(extent);
            assert_spans_are_met(ConvexPolyhedron::new(&planes), middle, extent, 2_000);
        }
    }

    #[test]
    fn faces_are_numbered_as_their_planes() {
        let mut memory = Memory::new();
        for planes in [&BLOCK[..], &OCTAHEDRON] {
            let prepared = prepared::<_, f32>(ConvexPolyhedron::new(planes), &mut memory).unwrap();
            for (face, plane) in (0..).zip(planes) {
                let inward = -plane.normal.normalized().unwrap();
                let aim = Vec3::new(0.1, 0.4, 0.2) * 0.5;
                let ray = Ray { origin: aim - inward * 9.0, direction: inward };
                let t = prepared.intersect(&ray, Interval::AHEAD).unwrap();
                let surface = prepared.surface(&ray, t);
                assert_eq!(surface.part, face);
                assert!((surface.normal + inward).magnitude() < 1e-6);
            }
        }
    }

    #[test]
    fn bounds_are_those_of_the_vertices() {
        // Planes that cut nothing off, or that are there already, change nothing.
        let more: Vec<Plane> = BLOCK
            .into_iter()
            .chain([plane(1.0, 1.0, 0.0, 9e5), BLOCK[1], plane(3.0, 3.0, 0.0, 6.0)])
            .collect();
        for (planes, min, max) in [
            (&BLOCK[..], Vec3::new(-1.0, 0.0, -2.0), Vec3::new(1.0, 1.0, 2.0)),
            (&more, Vec3::new(-1.0, 0.0, -2.0), Vec3::new(1.0, 1.0, 2.0)),
            (&OCTAHEDRON, Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0)),
        ] {
            let polyhedron = ConvexPolyhedron::new(planes);
            let mut memory = Memory::new();
            let bounds = prepared::<_, f32>(polyhedron, &mut memory).unwrap().bounds().unwrap();
            assert!((bounds.min - min).magnitude() < 1e-3, "{bounds:?}");
            assert!((bounds.max - max).magnitude() < 1e-3, "{bounds:?}");
            assert!((polyhedron.extent().flat - bounds.magnitude()).abs() < 1e-3);
        }
        assert_meets(ConvexPolyhedron::new(&more), Vec3::new(5.0, 0.5, 1.5), LEFT, 4.0, [1.0, 0.0, 0.0]);
    }

    /// A solid with faces in all directions, at least 30 degrees from each other, at a distance of 0.8 from
    /// its middle.
    fn gem(extent: f32) -> (Vec<Plane>, Vec3) {
        let mut random = Random(7);
        let mut normals = BLOCK.map(|plane| plane.normal).to_vec();
        for _ in 0..50 {
            let normal = random.direction();
            if normals.iter().all(|other| normal.dot(*other) < 0.86) {
                normals.push(normal);
            }
        }
        let middle = Vec3::new(0.3, -0.7, 0.2) * extent;
        let face = |normal: Vec3| Plane::new(middle + normal * (0.8 * extent), normal);
        (normals.into_iter().map(face).collect(), middle)
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            let (planes, middle) = gem(extent);
            assert_no_self_hits(ConvexPolyhedron::new(&planes), middle, extent, 20_000);
        }
    }

    #[test]
    fn planes_that_enclose_nothing_are_refused() {
        let refused = |planes: &[Plane]| refusal(ConvexPolyhedron::new(planes));
        // No plane, a half of space, a slab, half of a slab, a pipe, and a pipe that is closed at one end.
        for count in 0..BLOCK.len() {
            assert_eq!(refused(&BLOCK[..count]), Fault::NotEnclosed, "{count}");
        }
        assert_eq!(refused(&OCTAHEDRON[..4]), Fault::NotEnclosed);
        // Inward normals, and planes that leave nothing or no volume between them.
        let inward = BLOCK.map(|Plane { point, normal }| Plane::new(point, -normal));
        assert_eq!(refused(&inward), Fault::NotEnclosed);
        let mut empty = BLOCK;
        empty[3] = plane(0.0, 1.0, 0.0, -1.0);
        assert_eq!(refused(&empty), Fault::NotEnclosed);
        empty[3] = plane(0.0, 1.0, 0.0, 0.0);
        assert_eq!(refused(&empty), Fault::NotEnclosed);
    }

    #[test]
    fn coordinates_are_lengths_along_its_faces() {
        assert_uv(ConvexPolyhedron::new(&BLOCK), Vec3::new(0.5, 5.0, -1.5), DOWN, [0.5, 1.5]);
    }

    #[test]
    fn bad_planes_are_refused() {
        let with = |plane: Plane| {
            let mut planes = BLOCK;
            planes[2] = plane;
            refusal(ConvexPolyhedron::new(&planes))
        };
        assert_eq!(with(Plane::new(Vec3::ZERO, Vec3::ZERO)), Fault::ZeroLength);
        assert_eq!(with(Plane::new(Vec3::ZERO, DOWN * f32::NAN)), Fault::NotFinite);
        assert_eq!(with(Plane::new(DOWN * f32::INFINITY, DOWN)), Fault::NotFinite);
        assert_eq!(with(Plane::new(DOWN * 2e6, DOWN)), Fault::TooFar);
        assert_eq!(refusal(ConvexPolyhedron::new(&[BLOCK[0]; 65])), Fault::TooManyFaces { given: 65 });
    }
}
