//! Texture coordinates u and v as functions of x, y and z: the formulas of
//! [`Intersect::uv`](rayline::shape::Intersect::uv).

use glam::DVec3;
use rayline::shape::{Cone, Cuboid, Cylinder, Polygon, Shape, Torus};

use super::formula::{XYZ, globe, linear, turn};
use super::pattern::Coordinates;
use crate::space::vector;

/// The coordinates for textures on a shape; without u and v where they have no formula.
pub(super) fn coordinates(shape: &Shape<'_>) -> Coordinates {
    let surface = match shape {
        Shape::Sphere(sphere) => {
            let center = vector(sphere.center);
            globe([DVec3::X, DVec3::Y, DVec3::Z].map(|axis| along(axis, center)))
        }
        Shape::Ellipsoid(shape) => {
            let axes = shape.axes.map(vector).map(|axis| axis / axis.length_squared());
            globe(axes.map(|axis| along(axis, vector(shape.center))))
        }
        Shape::Plane(plane) => flat(vector(plane.normal)),
        Shape::Polygon(Polygon { vertices }) => {
            let following = vertices.iter().cycle().skip(1);
            flat(vertices.iter().zip(following).map(|(a, b)| vector(*a).cross(vector(*b))).sum())
        }
        Shape::Disc(disc) => square(vector(disc.normal).normalize(), vector(disc.center), disc.radius),
        Shape::Rectangle(rectangle) => {
            weights(vector(rectangle.corner), vector(rectangle.right), vector(rectangle.up))
        }
        Shape::Triangle(triangle) => {
            let [a, b, c] = triangle.vertices.map(vector);
            weights(a, b - a, c - a)
        }
        Shape::Cylinder(Cylinder { base, top, radius, capped }) => {
            barrel([vector(*base), vector(*top)], [*radius, *radius], *capped)
        }
        Shape::Cone(Cone { base, base_radius, top, top_radius, capped }) => {
            barrel([vector(*base), vector(*top)], [*base_radius, *top_radius], *capped)
        }
        Shape::Cuboid(cuboid) => faces(cuboid),
        Shape::Torus(torus) => ring(torus),
        Shape::Mesh(mesh) if mesh.uvs.is_some() => return Coordinates::mapped(),
        _ => return Coordinates::SPACE,
    };
    Coordinates { surface: Some(surface), ..Coordinates::SPACE }
}

/// The formula of the distance from `origin` along an axis.
fn along(axis: DVec3, origin: DVec3) -> String {
    linear(axis, -axis.dot(origin), &XYZ)
}

/// Two unit vectors orthogonal to a third; the first is that closest to the x axis.
fn around(axis: DVec3) -> [DVec3; 2] {
    let toward = if axis.x.abs() > 0.9 { DVec3::Y } else { DVec3::X };
    let first = toward.reject_from_normalized(axis).normalize();
    [first, axis.cross(first)]
}

/// The texture coordinates of a plane: distances along two axes in it, from the scene's origin.
fn flat(normal: DVec3) -> [String; 2] {
    around(normal.normalize()).map(|axis| along(axis, DVec3::ZERO))
}

/// The texture coordinates of a disc: those in the square around it.
fn square(normal: DVec3, center: DVec3, radius: f32) -> [String; 2] {
    let half = 0.5 / f64::from(radius);
    around(normal).map(|axis| linear(axis * half, 0.5 - axis.dot(center) * half, &XYZ))
}

/// The texture coordinates of a triangle or rectangle: the shares of two edges that lead to a point.
fn weights(corner: DVec3, right: DVec3, up: DVec3) -> [String; 2] {
    let normal = right.cross(up);
    let volume = normal.length_squared();
    [up.cross(normal) / volume, normal.cross(right) / volume].map(|axis| along(axis, corner))
}

/// The texture coordinates of a cylinder or cone: around its side and along its axis. Caps have those of
/// discs.
fn barrel([base, top]: [DVec3; 2], radii: [f32; 2], capped: bool) -> [String; 2] {
    let length = base.distance(top);
    let axis = (top - base) / length;
    let [first, second] = around(axis).map(|axis| along(axis, base));
    let height = linear(axis / length, -axis.dot(base) / length, &XYZ);
    let around = turn(&second, &first);
    if !capped {
        return [around, height];
    }
    let [base_radius, top_radius] = radii;
    // Points are rounded: count those within a millionth of the ends to the caps.
    let (low, high) = (1e-6, 1.0 - 1e-6);
    let by_height = |below: String, side: &str, above: String| {
        format!("select({height} - {low}, {below}, select({height} - {high}, {side}, {above}))")
    };
    let ([u_below, v_below], [u_above, v_above]) =
        (square(-axis, base, base_radius), square(axis, top, top_radius));
    [by_height(u_below, &around, u_above), by_height(v_below, &height, v_above)]
}

/// The texture coordinates of a box: across and up each face.
fn faces(cuboid: &Cuboid) -> [String; 2] {
    let center = vector(cuboid.center);
    // The coordinates along the axes run from -1 to 1 within the box.
    let [x, y, z] = cuboid.axes.map(vector).map(|axis| along(axis / axis.length_squared(), center));
    let share = |at: &str| format!("({at} + 1)/2");
    let rest = |at: &str| format!("(1 - {at})/2");
    // The largest of the three coordinates selects the face.
    let by_face = |[left, right, below, above, back, front]: [String; 6]| {
        let along_x = format!("select({x}, {left}, {right})");
        let along_y = format!("select({y}, {below}, {above})");
        let along_z = format!("select({z}, {back}, {front})");
        let across = format!("select(abs({y}) - abs({z}), {along_z}, {along_y})");
        format!("select(abs({x}) - max(abs({y}), abs({z})), {across}, {along_x})")
    };
    [
        by_face([share(&z), rest(&z), share(&x), share(&x), rest(&x), share(&x)]),
        by_face([share(&y), share(&y), share(&z), rest(&z), share(&y), share(&y)]),
    ]
}

/// The texture coordinates of a torus: the angle about its axis, and the angle about its tube.
fn ring(torus: &Torus) -> [String; 2] {
    let (axis, center) = (vector(torus.axis).normalize(), vector(torus.center));
    let [first, second] = around(axis).map(|axis| along(axis, center));
    let height = along(axis, center);
    let across = format!("(sqrt({first}*{first} + {second}*{second}) - {})", torus.major_radius);
    [turn(&second, &first), turn(&height, &across)]
}
