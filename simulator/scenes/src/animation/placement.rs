//! Shapes in another place.

use bumpalo::Bump;
use glam::DVec3;
use rayline::Vec3;
use rayline::shape::{
    Cone, Cuboid, Cylinder, Disc, Ellipsoid, Instances, Model, Plane, Pose, Rectangle, Shape, Sphere, Torus,
    Triangle,
};
use rayline_formats::space::{self, vector};

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
        let rotation = space::rotation(self.rotation);
        let turn = |way: Vec3| rounded(rotation * vector(way));
        let turn_all = |ways: [Vec3; 3]| ways.map(turn);
        let (about, by) = (vector(self.about), vector(self.by));
        let point = |point: Vec3| rounded(rotation * (vector(point) - about) + about + by);
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
                    let angles = space::angles(&(rotation * space::rotation(pose.rotation)));
                    Pose::at(point(pose.origin)).turned(angles)
                };
                let poses = arena.alloc_slice_fill_iter(instances.poses.iter().map(turned));
                Shape::Instances(Instances { poses, ..instances })
            }
        }
    }
}

fn rounded(vector: DVec3) -> Vec3 {
    Vec3::new(vector.x as f32, vector.y as f32, vector.z as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(actual: Vec3, expected: Vec3) {
        assert!((actual - expected).length() < 2e-5, "{actual:?} is not {expected:?}");
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
            let turned = rounded(space::rotation(placed.rotation) * vector(corner));
            assert_near(turned + placed.origin, expected);
        }
    }
}
