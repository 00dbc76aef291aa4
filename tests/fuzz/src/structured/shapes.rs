//! Shapes of all kinds, in any size.

use rayline::Vec3;
use rayline::shape::{
    Blob, Cone, ConvexPolyhedron, Csg, CsgStep, Cuboid, Cylinder, Disc, Ellipsoid, Instances, Mesh,
    Metaballs, Model, Plane, Polygon, Pose, Quadric, Rectangle, Shape, Solid, Sphere, Torus, Triangle,
};

use super::{Maker, held};

impl<'a> Maker<'_, '_, 'a> {
    /// A shape of any kind.
    pub(super) fn shape(&mut self) -> Shape<'a> {
        match self.choices.below(22) {
            0 | 1 => Shape::Sphere(self.sphere()),
            2 | 3 => Shape::Plane(self.plane()),
            4 => Shape::Disc(self.disc()),
            5 => Shape::Rectangle(self.rectangle()),
            6 => Shape::Triangle(self.triangle()),
            7 => Shape::Polygon(self.polygon()),
            8 | 9 => {
                let capped = self.choices.chance(60);
                Shape::Cylinder(Cylinder { capped, ..self.cylinder() })
            }
            10 | 11 => {
                let capped = self.choices.chance(60);
                Shape::Cone(Cone { capped, ..self.cone() })
            }
            12 => Shape::Ellipsoid(self.ellipsoid()),
            13 => {
                let capped = self.choices.chance(60);
                Shape::Quadric(Quadric { capped, ..self.quadric() })
            }
            14 => Shape::Torus(self.torus()),
            15 => Shape::Cuboid(self.cuboid()),
            16 => Shape::ConvexPolyhedron(self.polyhedron()),
            17 | 18 => Shape::Mesh(self.mesh()),
            19 => Shape::Csg(self.csg()),
            20 => Shape::Metaballs(self.metaballs()),
            _ => Shape::Instances(self.instances()),
        }
    }

    /// A shape that takes little time, of a scene of many.
    pub(super) fn small_shape(&mut self) -> Shape<'a> {
        match self.choices.below(16) {
            0..=5 => Shape::Sphere(self.sphere()),
            6 => Shape::Disc(self.disc()),
            7 => Shape::Triangle(self.triangle()),
            8 => Shape::Cuboid(self.cuboid()),
            9 => Shape::Cylinder(self.cylinder()),
            10 => Shape::Cone(self.cone()),
            11 => Shape::Rectangle(self.rectangle()),
            12 => Shape::Plane(self.plane()),
            13 => Shape::Polygon(self.polygon()),
            _ => self.shape(),
        }
    }

    /// A length that keeps what it makes within reach.
    fn reach(&mut self) -> f32 {
        self.choices.length().min(450_000.0)
    }

    fn sphere(&mut self) -> Sphere {
        let radius = self.reach();
        // Touching a point from outside, or around it.
        let place = self.place();
        let center = if self.choices.chance(50) { place } else { place + self.way() * radius };
        let center = self.keep(held(center));
        let way = self.way();
        self.keep(center + way * radius);
        Sphere::new(center, radius)
    }

    fn plane(&mut self) -> Plane {
        let (place, way) = (held(self.place()), self.way());
        self.keep_way(way);
        self.keep(place);
        let aside = self.choices.across(way) * self.choices.within(0.5, 5.0);
        self.keep(place + aside);
        Plane::new(place, way)
    }

    fn disc(&mut self) -> Disc {
        let (center, radius) = (held(self.place()), self.reach());
        let (center, normal) = (self.keep(center), self.way());
        self.keep_way(normal);
        let edge = center + self.choices.across(normal) * radius;
        self.keep(edge);
        let hole = if self.choices.chance(30) { radius * self.choices.within(0.1, 0.95) } else { 0.0 };
        Disc { center, normal, radius, hole }
    }

    /// Two sides, square to each other or not.
    fn sides(&mut self) -> [Vec3; 2] {
        let right = self.way();
        let up = self.choices.across(right);
        self.keep_way(right.cross(up));
        let slant = if self.choices.chance(30) { self.choices.within(-0.8, 0.8) } else { 0.0 };
        let [width, height] = [self.reach(), self.reach()];
        [right * width, (up + right * slant) * height]
    }

    fn rectangle(&mut self) -> Rectangle {
        let corner = held(self.place());
        let [right, up] = self.sides();
        self.keep(corner);
        self.keep(corner + right * 0.5 + up * 0.5);
        Rectangle { corner, right, up }
    }

    fn triangle(&mut self) -> Triangle {
        let a = held(self.place());
        let [right, up] = self.sides();
        let (b, c) = (held(a + right), held(a + up));
        self.keep(b);
        self.keep((a + b + c) * (1.0 / 3.0));
        let normals = self.choices.chance(20).then(|| [(); 3].map(|()| self.choices.direction()));
        Triangle { vertices: [a, b, c], normals }
    }

    fn polygon(&mut self) -> Polygon<'a> {
        let corner = held(self.place());
        let [right, up] = self.sides();
        let outline: &[[f32; 2]] = match self.choices.below(3) {
            0 => &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            // Concave.
            1 => &[[0.0, 0.0], [1.0, 0.0], [0.4, 0.4], [0.0, 1.0]],
            _ => &[[0.0, 0.0], [2.0, 0.0], [2.0, 0.1], [0.1, 0.1], [0.1, 2.0], [0.0, 2.0]],
        };
        let vertices: Vec<_> = outline.iter().map(|[u, v]| corner + right * *u + up * *v).collect();
        self.keep(corner);
        self.keep(corner + right * 0.3 + up * 0.3);
        Polygon::new(self.arena.alloc_slice_copy(&vertices))
    }

    /// An axis: two points, and a radius that may be large or small against their distance.
    fn axis(&mut self) -> (Vec3, Vec3, f32) {
        let (base, way) = (self.place(), self.way());
        self.keep_way(way);
        let length = if self.choices.chance(10) { 65_535.0 } else { self.reach() };
        let radius = match self.choices.below(3) {
            0 => length * self.choices.one_of([1e-3, 0.1, 0.5, 1.0, 10.0]),
            _ => self.reach(),
        };
        let (base, top) = (held(base), held(base + way * length));
        let aside = self.choices.across(way) * radius;
        self.keep(base);
        self.keep(top);
        self.keep(base + (top - base) * 0.3 + aside);
        (base, top, radius.clamp(1e-6, 450_000.0))
    }

    fn cylinder(&mut self) -> Cylinder {
        let (base, top, radius) = self.axis();
        Cylinder { base, top, radius, capped: true }
    }

    fn cone(&mut self) -> Cone {
        let (base, top, base_radius) = self.axis();
        let top_radius = match self.choices.below(3) {
            0 => 0.0,
            1 => base_radius * self.choices.within(0.0, 2.0),
            _ => self.reach(),
        };
        Cone { base, base_radius, top, top_radius, capped: true }
    }

    /// Three directions, square to each other.
    fn frame(&mut self) -> [Vec3; 3] {
        let one = self.way();
        let two = self.choices.across(one);
        [one, two, one.cross(two)]
    }

    fn ellipsoid(&mut self) -> Ellipsoid {
        let center = held(self.place());
        let axes = self.frame().map(|way| way * self.reach());
        self.keep(center);
        self.keep(center + axes[0]);
        Ellipsoid { center, axes }
    }

    fn quadric(&mut self) -> Quadric {
        let center = held(self.place());
        let mut coefficients = match self.choices.below(6) {
            // A ball, a hyperboloid of one sheet and of two, a double cone, a paraboloid and a saddle.
            0 => [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0],
            1 => [1.0, -1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.2],
            2 => [1.0, -1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.2],
            3 => [1.0, -1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            4 => [1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
            _ => [1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
        };
        if self.choices.chance(40) {
            for coefficient in &mut coefficients {
                *coefficient += self.choices.within(-0.5, 0.5);
            }
        }
        // The equation of the same surface in another size.
        let size = self.choices.length().clamp(1e-3, 1e4);
        for (coefficient, power) in coefficients.iter_mut().zip([2, 2, 2, 2, 2, 2, 1, 1, 1, 0]) {
            *coefficient *= size.powi(-power);
        }
        let [x, y, z] = [(); 3].map(|()| size * self.choices.within(0.5, 2.0));
        let max = Vec3::new(x, y, z);
        self.keep(center);
        self.keep(center + max);
        Quadric { center, coefficients, min: -max, max, capped: true }
    }

    fn torus(&mut self) -> Torus {
        let (center, axis) = (held(self.place()), self.way());
        let major_radius = self.reach();
        let minor_radius = major_radius * self.choices.within(0.02, 0.9);
        let ring = center + self.choices.across(axis) * major_radius;
        self.keep(ring);
        self.keep(center);
        Torus { center, axis, major_radius, minor_radius }
    }

    fn cuboid(&mut self) -> Cuboid {
        let place = held(self.place());
        let halves = [(); 3].map(|()| self.reach());
        let cuboid = if self.choices.chance(60) {
            let size = Vec3::new(halves[0], halves[1], halves[2]);
            Cuboid::aligned(place, held(place + size))
        } else {
            let mut ways = self.frame();
            for (way, half) in ways.iter_mut().zip(halves) {
                *way = *way * half;
            }
            Cuboid::oriented(place, ways)
        };
        let Cuboid { center, axes } = cuboid;
        self.keep(center);
        self.keep(center + axes[0]);
        self.keep(center + axes[0] + axes[1] + axes[2]);
        cuboid
    }

    fn polyhedron(&mut self) -> ConvexPolyhedron<'a> {
        let center = held(self.place());
        let mut planes = Vec::new();
        let (frame, size) = (self.frame(), self.reach());
        for way in frame {
            let [near, far] = [(); 2].map(|()| size * self.choices.within(0.3, 1.5));
            planes.extend([Plane::new(center + way * far, way), Plane::new(center - way * near, -way)]);
        }
        for _ in 0..self.choices.between(0, 4) {
            let way = self.choices.direction();
            planes.push(Plane::new(center + way * (size * self.choices.within(0.4, 1.5)), way));
        }
        self.keep(center);
        self.keep(center + frame[0] * size);
        ConvexPolyhedron::new(self.arena.alloc_slice_copy(&planes))
    }

    fn mesh(&mut self) -> Mesh<'a> {
        let center = held(self.place());
        let (vertices, triangles) = match self.choices.below(3) {
            0 => self.slivers(center),
            1 => self.landscape(center),
            _ => self.soup(center),
        };
        for vertex in vertices.iter().take(3) {
            self.keep(*vertex);
        }
        let normals: Option<Vec<_>> =
            self.choices.chance(25).then(|| vertices.iter().map(|_| self.choices.direction()).collect());
        let uvs: Option<Vec<_>> = self
            .choices
            .chance(20)
            .then(|| vertices.iter().map(|_| [self.choices.share(), self.choices.share()]).collect());
        let colors: Option<Vec<_>> = self
            .choices
            .chance(20)
            .then(|| vertices.iter().map(|_| [0; 3].map(|_: u8| self.choices.below(256) as u8)).collect());
        let smooth_terminator = normals.is_some() && self.choices.chance(50);
        Mesh {
            vertices: self.arena.alloc_slice_copy(&vertices),
            triangles: self.arena.alloc_slice_copy(&triangles),
            normals: normals.map(|normals| &*self.arena.alloc_slice_copy(&normals)),
            uvs: uvs.map(|uvs| &*self.arena.alloc_slice_copy(&uvs)),
            colors: colors.map(|colors| &*self.arena.alloc_slice_copy(&colors)),
            smooth_terminator,
        }
    }

    /// Triangles that are huge and thin: two corners beside each other, the third far away.
    fn slivers(&mut self, center: Vec3) -> (Vec<Vec3>, Vec<[u16; 3]>) {
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
        for i in 0..self.choices.between(1, 6) as u16 {
            let from = held(center + self.choices.point());
            let long = self.way() * self.reach();
            let thin = self.way() * self.choices.one_of([1e-3, 0.01, 0.1, 1.0]);
            vertices.extend([from, held(from + thin), held(from + long)]);
            triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        (vertices, triangles)
    }

    /// A grid of heights.
    fn landscape(&mut self, center: Vec3) -> (Vec<Vec3>, Vec<[u16; 3]>) {
        let side = self.choices.between(2, 7) as u16;
        let (step, height) = (self.reach() * 0.2, self.choices.within(0.0, 0.5));
        let mut vertices = Vec::new();
        for z in 0..side {
            for x in 0..side {
                let y = if self.choices.chance(50) { 0.0 } else { self.choices.share() * height };
                vertices.push(held(center + Vec3::new(f32::from(x), y, f32::from(z)) * step));
            }
        }
        let mut triangles = Vec::new();
        for at in (0..side - 1).flat_map(|z| (0..side - 1).map(move |x| z * side + x)) {
            triangles.extend([[at, at + side, at + 1], [at + 1, at + side, at + side + 1]]);
        }
        (vertices, triangles)
    }

    /// Triangles between any of a few points.
    fn soup(&mut self, center: Vec3) -> (Vec<Vec3>, Vec<[u16; 3]>) {
        let count = self.choices.between(3, 9);
        let size = self.reach();
        let vertices = (0..count).map(|_| held(center + self.choices.direction() * size)).collect();
        let corner = |maker: &mut Self| maker.choices.below(count) as u16;
        let triangles = (0..self.choices.between(1, 24)).map(|_| [corner(self), corner(self), corner(self)]);
        (vertices, triangles.collect())
    }

    fn solid(&mut self) -> Solid<'a> {
        match self.choices.below(10) {
            0 | 1 => Solid::Sphere(self.sphere()),
            2 => Solid::Plane(self.plane()),
            3 => Solid::Cylinder(self.cylinder()),
            4 => Solid::Cone(self.cone()),
            5 => Solid::Ellipsoid(self.ellipsoid()),
            6 => Solid::Quadric(self.quadric()),
            7 => Solid::Torus(self.torus()),
            8 => Solid::Cuboid(self.cuboid()),
            _ => Solid::ConvexPolyhedron(self.polyhedron()),
        }
    }

    fn csg(&mut self) -> Csg<'a> {
        let mut steps = vec![CsgStep::Solid(self.solid())];
        for _ in 0..self.choices.between(1, 3) {
            steps.push(CsgStep::Solid(self.solid()));
            steps.push(self.choices.one_of([CsgStep::Union, CsgStep::Intersection, CsgStep::Difference]));
        }
        Csg::new(self.arena.alloc_slice_copy(&steps))
    }

    fn metaballs(&mut self) -> Metaballs<'a> {
        let (center, size) = (held(self.place()), self.reach());
        let blobs: Vec<_> = (0..self.choices.between(1, 4))
            .map(|_| {
                let center = held(center + self.choices.direction() * (size * self.choices.share()));
                let strength = if self.choices.chance(20) { self.choices.within(-1.0, 2.0) } else { 1.0 };
                Blob { center, radius: size * self.choices.within(0.5, 1.5), strength }
            })
            .collect();
        self.keep(center);
        Metaballs::new(self.arena.alloc_slice_copy(&blobs))
    }

    fn instances(&mut self) -> Instances<'a> {
        let turns = self.choices.chance(60);
        let model = match self.choices.below(8) {
            0 => Model::Polygon(self.polygon()),
            1 | 2 => Model::Mesh(self.mesh()),
            3 => Model::ConvexPolyhedron(self.polyhedron()),
            4 => Model::Metaballs(self.metaballs()),
            5 if !turns => Model::Quadric(self.quadric()),
            _ => Model::Csg(self.csg()),
        };
        let poses: Vec<_> = (0..self.choices.one_of([1, 2, 5, 9, 20]))
            .map(|_| {
                let rotation = if turns && self.choices.chance(70) {
                    let [x, y, z] = [(); 3].map(|()| self.choices.within(-3.2, 3.2));
                    Vec3::new(x, y, z)
                } else {
                    Vec3::ZERO
                };
                let origin = held(self.place());
                Pose { rotation, origin: self.keep(origin) }
            })
            .collect();
        let size = if self.choices.chance(50) { 1.0 } else { self.choices.one_of([0.5, 2.0, 0.01, 100.0]) };
        Instances::new(self.arena.alloc(model), self.arena.alloc_slice_copy(&poses)).sized(size)
    }
}
