//! Shapes of each kind, for the tests of facets.

use super::super::*;

/// The properties that the facets of a shape must have.
#[derive(Clone, Copy)]
pub(super) struct Expected {
    /// The volume that they enclose, if they are closed.
    pub(super) volume: Option<f64>,
    /// How many hundredths of the volume they may be off.
    pub(super) percent: f64,
}

const OPEN: Expected = Expected { volume: None, percent: 0.0 };

const fn closed(volume: f64, percent: f64) -> Expected {
    Expected { volume: Some(volume), percent }
}

const fn vec(x: f32, y: f32, z: f32) -> Vec3 {
    Vec3::new(x, y, z)
}

pub(super) const CENTER: Vec3 = vec(0.3, 0.2, -0.4);
const CONE: Cone = Cone {
    base: vec(0.2, -0.8, 0.1),
    base_radius: 0.9,
    top: vec(-0.1, 0.9, 0.3),
    top_radius: 0.0,
    capped: true,
};
const CYLINDER: Cylinder =
    Cylinder { base: vec(-0.5, -0.6, 0.2), top: vec(0.7, 0.5, 0.1), radius: 0.5, capped: true };
/// An arrow head with a notch; a star whose edges cross each other; and a square whose hole touches it.
const ARROW: [Vec3; 4] = [vec(0.0, 0.0, 0.5), vec(2.0, -2.0, 0.5), vec(0.0, 3.0, 0.5), vec(-2.0, -2.0, 0.5)];
const STAR: [Vec3; 5] = [
    vec(0.3, 0.0, 1.0),
    vec(0.3, -0.809, -0.588),
    vec(0.3, 0.951, 0.309 - 0.4),
    vec(0.3, -0.951, 0.309),
    vec(0.3, 0.588, -0.809),
];
const NOTCHED: [Vec3; 8] = [
    vec(-1.0, 0.2, 1.0),
    vec(1.0, 0.2, 1.0),
    vec(1.0, 0.2, -1.0),
    vec(-1.0, 0.2, -1.0),
    vec(-1.0, 0.2, 1.0),
    vec(-0.2, 0.2, -0.4),
    vec(0.6, 0.2, -0.4),
    vec(0.3, 0.2, 0.5),
];
const OCTAHEDRON: [Plane; 9] = {
    const fn plane(x: f32, y: f32, z: f32) -> Plane {
        Plane::new(vec(x, 0.0, 0.0), vec(x, y, z))
    }
    [
        plane(1.0, 1.0, 1.0),
        plane(1.0, 1.0, -1.0),
        plane(1.0, -1.0, 1.0),
        plane(1.0, -1.0, -1.0),
        plane(-1.0, 1.0, 1.0),
        plane(-1.0, 1.0, -1.0),
        plane(-1.0, -1.0, 1.0),
        plane(-1.0, -1.0, -1.0),
        // Twice the same.
        plane(1.0, 1.0, 1.0),
    ]
};
const GEM: [Plane; 8] = [
    Plane::new(vec(1.0, 0.0, 0.0), vec(1.0, 0.0, 0.1)),
    Plane::new(vec(-0.7, 0.0, 0.0), vec(-1.0, 0.2, 0.0)),
    Plane::new(vec(0.0, 0.8, 0.0), vec(0.1, 1.0, 0.2)),
    Plane::new(vec(0.0, -0.5, 0.0), vec(0.0, -1.0, -0.3)),
    Plane::new(vec(0.0, 0.0, 0.6), vec(0.2, 0.1, 1.0)),
    Plane::new(vec(0.0, 0.0, -0.9), vec(0.0, 0.1, -1.0)),
    Plane::new(vec(0.6, 0.4, 0.2), vec(1.0, 1.0, 0.5)),
    // Cuts off nothing.
    Plane::new(vec(5.0, 5.0, 5.0), vec(1.0, 1.0, 1.0)),
];
const TETRAHEDRON: Mesh = Mesh::new(
    &[vec(1.0, 1.0, 1.0), vec(1.0, -1.0, -1.0), vec(-1.0, 1.0, -1.0), vec(-1.0, -1.0, 1.0)],
    &[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2], [1, 1, 2]],
);
const BEAD: Csg = Csg::new(&[
    CsgStep::Solid(Solid::Sphere(Sphere::new(CENTER, 1.0))),
    CsgStep::Solid(Solid::Cylinder(Cylinder {
        base: vec(0.3, -2.0, -0.4),
        top: vec(0.3, 2.0, -0.4),
        radius: 0.5,
        capped: true,
    })),
    CsgStep::Difference,
]);
const DROPS: Metaballs =
    Metaballs::new(&[Blob::new(vec(0.0, 0.0, 0.0), 1.4), Blob::new(vec(0.8, 0.2, 0.0), 1.1)]);
const BALL: [f32; 10] = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0];
const SADDLE: Quadric = Quadric {
    center: CENTER,
    coefficients: [1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
    min: vec(-1.0, -0.8, -1.0),
    max: vec(1.0, 0.9, 1.0),
    capped: false,
};
const MODELS: [Model; 2] = [Model::Csg(BEAD), Model::Mesh(TETRAHEDRON)];
const POSES: [Pose; 2] =
    [Pose::at(vec(-1.2, 0.1, 0.0)), Pose::at(vec(1.3, 0.0, 0.4)).turned(vec(0.3, 0.8, 0.1))];

/// One or several of each kind.
pub(super) fn shapes() -> Vec<(Shape<'static>, Expected)> {
    let pi = core::f64::consts::PI;
    let ball = 4.0 / 3.0 * pi;
    let axes = [vec(0.5, 0.1, 0.0), vec(0.0, 0.9, -0.2), vec(0.2, 0.0, 0.7)];
    let mirrored = [vec(0.9, 0.0, 0.0), vec(0.0, 0.0, 0.6), vec(0.0, 0.4, 0.0)];
    let [a, b, c] = axes.map(|axis| axis.to::<f64>());
    let cone_height = f64::from((CONE.top - CONE.base).length());
    let cylinder = pi * 0.25 * f64::from((CYLINDER.top - CYLINDER.base).length());
    // Of a ball of radius 1 with a hole of radius 1/2: 4/3 π (1 - 1/4)^(3/2).
    let bead = ball * 0.75f64.powf(1.5);
    let quadric =
        Quadric { coefficients: BALL, min: vec(-2.0, -0.5, -2.0), max: vec(2.0, 2.0, 2.0), ..SADDLE };
    let smooth = Some([vec(0.1, 0.2, 1.0), vec(0.0, -0.3, 1.0), vec(0.3, 0.0, 1.0)]);
    let flat = Triangle::flat(vec(-1.0, -0.8, 0.3), vec(1.0, -0.6, -0.5), vec(0.1, 1.0, 0.9));
    let turned = [vec(0.5, 0.5, 0.0), vec(-0.3, 0.3, 0.0), vec(0.0, 0.0, 0.75)];
    vec![
        (Shape::Sphere(Sphere::new(CENTER, 1.0)), closed(ball, 2.5)),
        (Shape::Plane(Plane::new(vec(0.0, -0.5, 0.0), vec(0.1, 1.0, -0.2))), OPEN),
        (Shape::Disc(Disc::new(CENTER, vec(0.2, 1.0, 0.4), 1.2)), OPEN),
        (Shape::Disc(Disc::ring(CENTER, vec(-0.2, -1.0, 0.4), 0.5, 1.2)), OPEN),
        (Shape::Rectangle(Rectangle::new(CENTER, vec(1.0, 0.2, 0.0), vec(0.3, 0.9, -0.5))), OPEN),
        (Shape::Triangle(flat), OPEN),
        (Shape::Triangle(Triangle { normals: smooth.map(|normals| normals.map(|n| n * 2.0)), ..flat }), OPEN),
        (Shape::Polygon(Polygon::new(&ARROW)), OPEN),
        (Shape::Polygon(Polygon::new(&STAR)), OPEN),
        (Shape::Polygon(Polygon::new(&NOTCHED)), OPEN),
        (Shape::Cylinder(CYLINDER), closed(cylinder, 1.0)),
        (Shape::Cylinder(Cylinder { capped: false, ..CYLINDER }), OPEN),
        (Shape::Cone(CONE), closed(pi * 0.27 * cone_height, 1.0)),
        (Shape::Cone(Cone { base_radius: 0.3, top_radius: 0.8, capped: false, ..CONE }), OPEN),
        (Shape::Ellipsoid(Ellipsoid { center: CENTER, axes }), closed(ball * a.cross(b).dot(c), 2.5)),
        (Shape::Ellipsoid(Ellipsoid { center: CENTER, axes: mirrored }), closed(ball * 0.216, 2.5)),
        (Shape::Quadric(SADDLE), OPEN),
        (Shape::Quadric(quadric), OPEN),
        // Half a ball, and a part of the other half.
        (
            Shape::Quadric(Quadric { capped: true, ..quadric }),
            closed(pi * (2.0 / 3.0 + 0.5 - 0.125 / 3.0), 3.0),
        ),
        (
            Shape::Torus(Torus {
                center: CENTER,
                axis: vec(0.2, 1.0, 0.3),
                major_radius: 0.8,
                minor_radius: 0.3,
            }),
            closed(2.0 * pi * pi * 0.8 * 0.09, 4.0),
        ),
        (Shape::Cuboid(Cuboid::aligned(vec(-0.5, -0.7, -1.0), vec(0.6, 0.4, 1.0))), closed(2.42, 0.01)),
        (Shape::Cuboid(Cuboid::oriented(CENTER, turned)), closed(8.0 * 0.3 * 0.75, 0.01)),
        (Shape::Cuboid(Cuboid::oriented(CENTER, [turned[0], turned[2], turned[1]])), closed(1.8, 0.01)),
        (Shape::ConvexPolyhedron(ConvexPolyhedron::new(&OCTAHEDRON)), closed(4.0 / 3.0, 0.01)),
        (Shape::ConvexPolyhedron(ConvexPolyhedron::new(&GEM)), closed(f64::NAN, f64::INFINITY)),
        (Shape::Mesh(TETRAHEDRON), OPEN),
        (Shape::Csg(BEAD), closed(bead, 3.0)),
        (Shape::Metaballs(DROPS), closed(f64::NAN, f64::INFINITY)),
        (Shape::Instances(Instances::new(&MODELS[0], &POSES)), closed(2.0 * bead, 3.0)),
        (Shape::Instances(Instances::new(&MODELS[1], &POSES).sized(0.6)), OPEN),
    ]
}
