//! A test of all shapes, of any size: no ray meets a shape outside of its bounds.

use super::testing::Random;
use super::*;
use crate::arena::Workspace;
use crate::math::Fixed;

/// Memory for any of the shapes below.
type ShapeMemory = Workspace<32768>;

/// Random shapes that are as small, as large, as long and as thin as descriptions may be.
struct Shapes(Random);

impl Shapes {
    fn below(&mut self, count: usize) -> usize {
        (((self.0.next() + 1.0) * 0.5 * count as f32) as usize).min(count - 1)
    }

    fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    fn coordinate(&mut self) -> f32 {
        let size = self.of(&[1.0, 1.0, 4.0, 4.0, 1e-3, 1e-5, 1e3, 65535.0, 1e6]);
        match self.below(6) {
            0 => size * 0.5,
            1 => 0.0,
            _ => self.0.next() * size,
        }
    }

    fn near(&mut self) -> f32 {
        self.0.next() * 4.0
    }

    fn place(&mut self) -> Vec3 {
        if self.below(3) == 0 {
            Vec3::new(self.coordinate(), self.coordinate(), self.coordinate())
        } else {
            Vec3::new(self.near(), self.near(), self.near())
        }
    }

    fn places<const N: usize>(&mut self) -> [Vec3; N] {
        [(); N].map(|()| self.place())
    }

    fn size(&mut self) -> f32 {
        let size = self.of(&[0.1, 1.0, 1.0, 3.0, 20.0, 1e-3, 1e-4, 1e3, 65535.0, 5e5]);
        (self.0.next() * size).abs() + size * 1e-3
    }

    fn axis(&mut self) -> Vec3 {
        let up = Vec3::new(0.0, 1.0, 0.0);
        match self.below(3) {
            0 => up,
            1 => up + self.0.vector() * self.of(&[1e-2, 1e-4, 1e-6]),
            _ => self.0.vector(),
        }
    }

    fn cone(&mut self, capped: bool) -> Cone {
        let top_radius = if self.below(2) == 0 { 0.0 } else { self.size() };
        let [base, top] = self.places();
        Cone { base, base_radius: self.size(), top, top_radius, capped }
    }

    fn cylinder(&mut self, capped: bool) -> Cylinder {
        let [base, top] = self.places();
        Cylinder { base, top, radius: self.size(), capped }
    }

    fn quadric(&mut self) -> Quadric {
        let max = Vec3::new(self.size(), self.size(), self.size());
        let coefficients = [(); 10].map(|()| self.near());
        Quadric { center: self.place(), coefficients, min: -max, max, capped: self.below(2) == 0 }
    }

    fn torus(&mut self) -> Torus {
        let major_radius = self.size();
        let minor_radius = major_radius * self.0.next().abs();
        Torus { center: self.place(), axis: self.axis(), major_radius, minor_radius }
    }

    fn mesh(&mut self) -> Mesh<'static> {
        let count = 3 + self.below(12);
        let vertices: Vec<Vec3> = (0..count).map(|_| self.place()).collect();
        let triangles: Vec<[u16; 3]> =
            (0..=self.below(24)).map(|_| [(); 3].map(|()| self.below(count) as u16)).collect();
        Mesh::new(vertices.leak(), triangles.leak())
    }

    fn solid(&mut self) -> Solid<'static> {
        match self.below(6) {
            0 => Solid::Sphere(Sphere::new(self.place(), self.size())),
            1 => Solid::Cylinder(self.cylinder(true)),
            2 => Solid::Cone(self.cone(true)),
            3 => Solid::Cuboid(Cuboid::aligned(self.place(), self.place())),
            4 => Solid::Ellipsoid(Ellipsoid { center: self.place(), axes: self.places() }),
            _ => Solid::Torus(self.torus()),
        }
    }

    fn csg(&mut self) -> Csg<'static> {
        let mut steps = vec![CsgStep::Solid(self.solid())];
        for _ in 0..=self.below(3) {
            steps.push(CsgStep::Solid(self.solid()));
            steps.push(self.of(&[CsgStep::Union, CsgStep::Intersection, CsgStep::Difference]));
        }
        Csg::new(steps.leak())
    }

    fn metaballs(&mut self) -> Metaballs<'static> {
        let blobs: Vec<Blob> = (0..=self.below(4)).map(|_| Blob::new(self.place(), self.size())).collect();
        Metaballs { blobs: blobs.leak() }
    }

    fn instances(&mut self) -> Instances<'static> {
        let model = match self.below(4) {
            0 => Model::Mesh(self.mesh()),
            1 => Model::Quadric(self.quadric()),
            2 => Model::Metaballs(self.metaballs()),
            _ => Model::Csg(self.csg()),
        };
        let poses: Vec<Pose> = (0..=self.below(12))
            .map(|_| Pose { rotation: self.0.vector() * self.of(&[0.0, 3.0]), origin: self.place() })
            .collect();
        Instances { model: Box::leak(Box::new(model)), size: self.of(&[1.0, 0.3, 2.0]), poses: poses.leak() }
    }

    /// A shape of one of the 17 kinds.
    fn shape(&mut self, kind: usize) -> Shape<'static> {
        let [a, b, c] = self.places();
        match kind % 17 {
            0 => Shape::Sphere(Sphere::new(a, self.size())),
            1 => Shape::Plane(Plane::new(a, self.axis())),
            2 => Shape::Disc(Disc::ring(a, self.axis(), 0.0, self.size())),
            3 => Shape::Rectangle(Rectangle::new(a, b, c)),
            4 => Shape::Triangle(Triangle::flat(a, b, c)),
            5 => Shape::Polygon(Polygon::new(Box::leak(Box::new([a, b, c, a + c - b])))),
            6 => Shape::Cylinder({
                let capped = self.below(2) == 0;
                self.cylinder(capped)
            }),
            7 => Shape::Cone({
                let capped = self.below(2) == 0;
                self.cone(capped)
            }),
            8 => Shape::Ellipsoid(Ellipsoid { center: a, axes: self.places() }),
            9 => Shape::Quadric(self.quadric()),
            10 => Shape::Torus(self.torus()),
            11 => Shape::Cuboid(Cuboid::aligned(a, b)),
            12 => Shape::Mesh(self.mesh()),
            13 => Shape::Csg(self.csg()),
            14 => Shape::Metaballs(self.metaballs()),
            15 => {
                let half = Vec3::new(self.size(), self.size(), self.size());
                let (right, up, back) =
                    (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0));
                let mut faces = Vec::new();
                for normal in [right, up, back, self.axis(), self.0.vector()] {
                    let reach = normal.x.abs() * half.x + normal.y.abs() * half.y + normal.z.abs() * half.z;
                    let reach = normal * (reach * 0.9 / normal.dot(normal));
                    faces.push(Plane::new(a + reach, normal));
                    faces.push(Plane::new(a - reach, -normal));
                }
                Shape::ConvexPolyhedron(ConvexPolyhedron::new(faces.leak()))
            }
            _ => Shape::Instances(self.instances()),
        }
    }

    /// A place in the bounds of a shape or near them; any place if it has no bounds.
    fn aim(&mut self, bounds: Option<Aabb<f64>>) -> Vec3 {
        let Some(Aabb { min, max }) = bounds else { return self.place() };
        let share = |random: &mut Random| f64::from(random.next() * 0.6) + 0.5;
        let (x, y, z) = (share(&mut self.0), share(&mut self.0), share(&mut self.0));
        let at = |min: f64, max: f64, share: f64| (min + (max - min) * share) as f32;
        Vec3::new(at(min.x, max.x, x), at(min.y, max.y, y), at(min.z, max.z, z))
    }
}

/// Asserts that all hits of some rays lie in the bounds of a shape. Returns the number of hits.
fn assert_met_inside_bounds<R: Real>(shape: &Shape<'static>, rays: &[(Vec3, Vec3)]) -> usize {
    let mut room = ShapeMemory::new();
    let farthest = rays.iter().map(|(origin, _)| *origin).max_by(|a, b| a.length().total_cmp(&b.length()));
    let scale = Scale::new::<R>(shape.extent(), farthest.unwrap_or(Vec3::ZERO));
    // Fixed point refuses some of the shapes.
    let Ok(prepared) = shape.prepare::<R>(scale, &mut Arena::new(room.lend())) else { return 0 };
    let Some(bounds) = prepared.bounds() else { return 0 };
    let mut met = 0;
    for (origin, toward) in rays {
        let Some(direction) = toward.to::<R::Setup>().normalized() else { continue };
        let ray = Ray { origin: scale.point(origin.to()), direction: Vec3::from_setup(direction) };
        let mut range = Interval::AHEAD;
        // No shape has more surfaces along one ray.
        for _ in 0..64 {
            let Some(t) = prepared.intersect(&ray, range) else { break };
            let point = ray.at(t);
            let room = bounds.padded(R::offset(ray.origin.magnitude().larger(point.magnitude())));
            assert!(
                room.contains(point),
                "{shape:?}\n{ray:?}\nis met at {t:?}, {point:?}, outside {bounds:?}"
            );
            met += 1;
            range.min = t;
        }
    }
    met
}

/// The rule of [`Silhouette::hulls`].
#[test]
fn hulls_are_as_many_as_are_listed() {
    fn check<R: Real>(shape: &Shape<'static>) -> usize {
        let mut room = ShapeMemory::new();
        let scale = Scale::new::<R>(shape.extent(), Vec3::ZERO);
        let Ok(prepared) = shape.prepare::<R>(scale, &mut Arena::new(room.lend())) else { return 0 };
        let listed = (0..).take_while(|part| prepared.hull(*part).is_some()).count();
        assert_eq!(prepared.hulls(), listed, "{shape:?}");
        listed
    }
    let mut shapes = Shapes(Random(5));
    let mut most = 0;
    for number in 0..1700 {
        let shape = shapes.shape(number);
        most = most.max(check::<f32>(&shape)).max(check::<Fixed>(&shape));
    }
    assert!(most > 17, "no instances of tori");
}

/// Also of the smallest, the longest and the thinnest shapes: nothing overflows.
#[test]
fn facets_lie_in_the_bounds() {
    fn check<R: Real>(shape: &Shape<'static>, segments: u16) -> usize {
        let mut room = ShapeMemory::new();
        let eye = Vec3::new(1.0, 5.0, 3.0);
        let scale = Scale::new::<R>(shape.extent(), eye);
        let Ok(prepared) = shape.prepare::<R>(scale, &mut Arena::new(room.lend())) else { return 0 };
        let bounds = prepared.bounds().map(|bounds| {
            let size = (bounds.max - bounds.min).magnitude();
            bounds.padded(R::offset(bounds.magnitude()) + R::offset(size))
        });
        let mut count = 0;
        prepared.each_facet(&Tessellation { segments, eye: scale.point(eye.to()) }, &mut |facet| {
            count += 1;
            for corner in facet.corners {
                let is_inside = match bounds {
                    Some(bounds) => bounds.contains(corner),
                    None => corner.magnitude() < R::FARTHEST + R::from_f32(1e-3),
                };
                assert!(is_inside, "{shape:?}: {corner:?} lies outside {bounds:?}");
            }
        });
        count
    }
    let mut shapes = Shapes(Random(9));
    let mut counts = [0; 17];
    for number in 0..510 {
        let shape = shapes.shape(number);
        let segments = shapes.of(&[6, 7, 13]);
        counts[number % 17] += usize::from(check::<f32>(&shape, segments) > 0);
        counts[number % 17] += usize::from(check::<Fixed>(&shape, segments) > 0);
    }
    assert!(counts.iter().all(|count| *count > 5), "{counts:?}");
}

/// The rule of [`Intersect::bounds`].
#[test]
fn no_ray_meets_a_shape_outside_its_bounds() {
    let count = std::env::var("RAYLINE_SHAPES").ok().and_then(|count| count.parse().ok()).unwrap_or(40_000);
    let mut shapes = Shapes(Random(38));
    let mut met = [0; 17];
    for number in 0..count {
        let shape = shapes.shape(number);
        let mut room = ShapeMemory::new();
        let bounds = shape.prepare::<f64>(Scale::ONE, &mut Arena::new(room.lend()));
        let Ok(bounds) = bounds.map(|shape| shape.bounds()) else { continue };
        let rays: Vec<(Vec3, Vec3)> = (0..24)
            .map(|_| {
                let (aim, origin) = (shapes.aim(bounds), shapes.place());
                // Some rays begin inside.
                let origin = if shapes.below(6) == 0 { shapes.aim(bounds) } else { origin };
                (origin, aim - origin)
            })
            .collect();
        met[number % 17] += assert_met_inside_bounds::<f32>(&shape, &rays)
            + assert_met_inside_bounds::<f64>(&shape, &rays)
            + assert_met_inside_bounds::<Fixed>(&shape, &rays);
    }
    // Planes have no bounds.
    assert!(met.iter().enumerate().all(|(kind, met)| kind == 1 || *met > count / 40), "{met:?}");
}
