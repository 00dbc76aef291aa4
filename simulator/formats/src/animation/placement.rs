//! Shapes in another place.

use bumpalo::Bump;
use rayline::Vec3;
use rayline::shape::{
    Cone, Cuboid, Cylinder, Disc, Ellipsoid, Instances, Model, Plane, Pose, Rectangle, Shape, Sphere, Torus,
    Triangle,
};

/// A rotation about a point, and a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placement {
    pub(super) by: Vec3,
    /// The angles about the x axis, then about y, then about z.
    pub(super) rotation: Vec3,
    pub(super) about: Vec3,
}

impl Placement {
    /// The shape in its place.
    pub(super) fn placed<'a>(&self, shape: &Shape<'a>, arena: &'a Bump) -> Shape<'a> {
        let rows = rows(self.rotation);
        let turn = |vector: Vec3| times(&rows, vector);
        let turn_all = |vectors: [Vec3; 3]| vectors.map(turn);
        let point = |point: Vec3| turn(point - self.about) + self.about + self.by;
        let model = |model: Model<'a>| {
            let poses = arena.alloc_slice_copy(&[Pose::at(point(Vec3::ZERO)).turned(self.rotation)]);
            Shape::Instances(Instances::new(arena.alloc(model), poses))
        };
        match *shape {
            Shape::Sphere(sphere) => Shape::Sphere(Sphere { center: point(sphere.center), ..sphere }),
            Shape::Plane(Plane { point: through, normal }) => {
                Shape::Plane(Plane { point: point(through), normal: turn(normal) })
            }
            Shape::Disc(disc) => {
                Shape::Disc(Disc { center: point(disc.center), normal: turn(disc.normal), ..disc })
            }
            Shape::Rectangle(Rectangle { corner, right, up }) => {
                Shape::Rectangle(Rectangle { corner: point(corner), right: turn(right), up: turn(up) })
            }
            Shape::Triangle(triangle) => Shape::Triangle(Triangle {
                vertices: triangle.vertices.map(point),
                normals: triangle.normals.map(turn_all),
            }),
            Shape::Cylinder(tube) => {
                Shape::Cylinder(Cylinder { base: point(tube.base), top: point(tube.top), ..tube })
            }
            Shape::Cone(cone) => Shape::Cone(Cone { base: point(cone.base), top: point(cone.top), ..cone }),
            Shape::Ellipsoid(Ellipsoid { center, axes }) => {
                Shape::Ellipsoid(Ellipsoid { center: point(center), axes: turn_all(axes) })
            }
            Shape::Torus(torus) => {
                Shape::Torus(Torus { center: point(torus.center), axis: turn(torus.axis), ..torus })
            }
            Shape::Cuboid(Cuboid { center, axes }) => {
                Shape::Cuboid(Cuboid { center: point(center), axes: turn_all(axes) })
            }
            Shape::Polygon(polygon) => model(Model::Polygon(polygon)),
            Shape::Quadric(quadric) => model(Model::Quadric(quadric)),
            Shape::ConvexPolyhedron(polyhedron) => model(Model::ConvexPolyhedron(polyhedron)),
            Shape::Mesh(mesh) => model(Model::Mesh(mesh)),
            Shape::Csg(csg) => model(Model::Csg(csg)),
            Shape::Metaballs(metaballs) => model(Model::Metaballs(metaballs)),
            Shape::Instances(instances) => {
                let turned = |pose: &Pose| {
                    let axes = columns(&self::rows(pose.rotation)).map(turn);
                    Pose::at(point(pose.origin)).turned(angles(&columns(&axes)))
                };
                let poses = arena.alloc_slice_fill_iter(instances.poses.iter().map(turned));
                Shape::Instances(Instances { poses, ..instances })
            }
        }
    }
}

/// The rows of the matrix of a rotation by angles about x, then y, then z.
fn rows(rotation: Vec3) -> [Vec3; 3] {
    let [(sx, cx), (sy, cy), (sz, cz)] =
        [rotation.x, rotation.y, rotation.z].map(|angle| f64::from(angle).sin_cos());
    let row = |x: f64, y: f64, z: f64| Vec3::new(x as f32, y as f32, z as f32);
    [
        row(cy * cz, sx * sy * cz - cx * sz, cx * sy * cz + sx * sz),
        row(cy * sz, sx * sy * sz + cx * cz, cx * sy * sz - sx * cz),
        row(-sy, sx * cy, cx * cy),
    ]
}

/// The columns of a matrix that is given by its rows, or the other way round.
fn columns([a, b, c]: &[Vec3; 3]) -> [Vec3; 3] {
    [Vec3::new(a.x, b.x, c.x), Vec3::new(a.y, b.y, c.y), Vec3::new(a.z, b.z, c.z)]
}

fn times([x, y, z]: &[Vec3; 3], vector: Vec3) -> Vec3 {
    Vec3::new(x.dot(vector), y.dot(vector), z.dot(vector))
}

/// The angles of a rotation, from the rows of its matrix. Where the turn about y is a right angle, the turns
/// about x and z are one, and it is taken for that about x.
fn angles([first, second, third]: &[Vec3; 3]) -> Vec3 {
    let about_y = (-third.x).clamp(-1.0, 1.0).asin();
    if third.x.abs() > 1.0 - 1e-6 {
        let about_x = about_y.signum() * first.y.atan2(second.y);
        return Vec3::new(about_x, about_y, 0.0);
    }
    Vec3::new(third.y.atan2(third.z), about_y, second.x.atan2(first.x))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(actual: Vec3, expected: Vec3) {
        assert!((actual - expected).length() < 2e-5, "{actual:?} is not {expected:?}");
    }

    #[test]
    fn angles_give_their_rotation_back() {
        let right = core::f32::consts::FRAC_PI_2;
        for rotation in [
            Vec3::new(0.3, -0.8, 2.9),
            Vec3::new(-2.0, 1.5, -0.1),
            Vec3::new(0.7, right, 0.2),
            Vec3::new(0.7, -right, 0.2),
            Vec3::ZERO,
        ] {
            let matrix = rows(rotation);
            let again = rows(angles(&matrix));
            for (row, expected) in again.iter().zip(matrix) {
                assert!((*row - expected).length() < 1e-3, "{rotation:?}: {again:?} is not {matrix:?}");
            }
        }
    }

    /// About x, then y, then z, counterclockwise.
    #[test]
    fn rotations_turn_counterclockwise() {
        let quarter = core::f32::consts::FRAC_PI_2;
        let up = Vec3::new(0.0, 1.0, 0.0);
        assert_near(times(&rows(Vec3::new(quarter, 0.0, 0.0)), up), Vec3::new(0.0, 0.0, 1.0));
        assert_near(times(&rows(Vec3::new(quarter, quarter, 0.0)), up), Vec3::new(1.0, 0.0, 0.0));
        assert_near(times(&rows(Vec3::new(0.0, 0.0, quarter)), up), Vec3::new(-1.0, 0.0, 0.0));
    }

    /// A model with a place of its own, and an instance of it, go to one place.
    #[test]
    fn instances_go_where_their_model_goes() {
        let arena = Bump::new();
        let corners = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, 0.0, 3.0)];
        let triangle = Triangle { vertices: corners, normals: None };
        let pose = Placement {
            by: Vec3::new(5.0, 0.0, 1.0),
            rotation: Vec3::new(0.4, 1.0, -0.6),
            about: Vec3::new(0.0, 1.0, 0.0),
        };
        let then = Placement {
            by: Vec3::new(0.0, -2.0, 0.0),
            rotation: Vec3::new(-1.2, 0.3, 0.9),
            about: corners[0],
        };
        let Shape::Triangle(once) = pose.placed(&Shape::Triangle(triangle), &arena) else { panic!() };
        let Shape::Triangle(twice) = then.placed(&Shape::Triangle(once), &arena) else { panic!() };
        let polygon = Shape::Polygon(rayline::shape::Polygon { vertices: &corners });
        let Shape::Instances(instance) = then.placed(&pose.placed(&polygon, &arena), &arena) else {
            panic!()
        };
        let [placed] = instance.poses else { panic!("one pose") };
        for (corner, expected) in corners.into_iter().zip(twice.vertices) {
            assert_near(times(&rows(placed.rotation), corner) + placed.origin, expected);
        }
    }
}
