//! Shapes in POV-Ray's language.

use rayline::shape::{
    Blob, Csg, CsgStep, Instances, Mesh, Metaballs, Plane, Quadric, Rectangle, Shape, Torus,
};
use rayline::{Real, Vec3};

use super::literal::{degrees, list, matrix, point, points, unit, xyz};

/// The keyword and the numbers of a shape; `None` for a CSG whose steps do not combine into one solid.
pub(super) fn shape(shape: &Shape<'_>) -> Option<(&'static str, String)> {
    let open = |capped: bool| if capped { "" } else { " open" };
    Some(match shape {
        Shape::Sphere(sphere) => ("sphere", format!("{}, {}", point(sphere.center), sphere.radius)),
        Shape::Plane(plane) => ("plane", self::plane(plane)),
        Shape::Disc(disc) => (
            "disc",
            format!("{}, {}, {}, {}", point(disc.center), point(disc.normal), disc.radius, disc.hole),
        ),
        Shape::Rectangle(rectangle) => polygon(&corners(rectangle)),
        Shape::Triangle(triangle) => match triangle.normals {
            None => ("triangle", points(&triangle.vertices)),
            Some(normals) => {
                let corners =
                    triangle.vertices.iter().zip(&normals).flat_map(|(vertex, normal)| [*vertex, *normal]);
                ("smooth_triangle", points(&corners.collect::<Vec<_>>()))
            }
        },
        Shape::Polygon(polygon) => {
            self::polygon(&polygon.vertices.iter().map(|vertex| vertex.to()).collect::<Vec<_>>())
        }
        Shape::Cylinder(shape) => (
            "cylinder",
            format!("{}, {}{}", points(&[shape.base, shape.top]), shape.radius, open(shape.capped)),
        ),
        Shape::Cone(shape) => (
            "cone",
            format!(
                "{}, {}, {}, {}{}",
                point(shape.base),
                shape.base_radius,
                point(shape.top),
                shape.top_radius,
                open(shape.capped)
            ),
        ),
        Shape::Mesh(mesh) => ("mesh2", self::mesh(mesh)),
        Shape::Ellipsoid(shape) => {
            // A unit sphere, mapped by the images of its axes and its origin.
            let [a, b, c] = shape.axes;
            ("sphere", format!("0, 1 {}", matrix([a, b, c, shape.center].map(Vec3::to))))
        }
        Shape::Quadric(shape) => quadric(shape),
        Shape::Cuboid(cuboid) => {
            let [a, b, c] = cuboid.axes;
            ("box", format!("-1, 1 {}", matrix([a, b, c, cuboid.center].map(Vec3::to))))
        }
        Shape::ConvexPolyhedron(polyhedron) => {
            let planes = polyhedron.planes.iter().map(|plane| format!("plane {{ {} }}", self::plane(plane)));
            ("intersection", planes.collect::<Vec<_>>().join(" "))
        }
        Shape::Torus(torus) => ("torus", self::torus(torus)),
        Shape::Csg(csg) => return self::csg(csg),
        Shape::Metaballs(metaballs) => ("isosurface", self::metaballs(metaballs)),
        Shape::Instances(instances) => return self::instances(instances),
    })
}

/// The union of all instances of a model.
fn instances(instances: &Instances<'_>) -> Option<(&'static str, String)> {
    let (kind, model) = shape(&Shape::from(*instances.model))?;
    let mut all = instances.poses.iter().map(|pose| {
        let degrees = degrees(pose.rotation);
        format!("{model} scale {} rotate {degrees} translate {}", instances.size, point(pose.origin))
    });
    if instances.poses.len() == 1 {
        return all.next().map(|only| (kind, only));
    }
    Some(("union", all.map(|one| format!("{kind} {{ {one} }}")).collect::<Vec<_>>().join("\n  ")))
}

/// A CSG: its steps, carried out on a stack of texts.
fn csg(csg: &Csg<'_>) -> Option<(&'static str, String)> {
    let mut stack: Vec<(&'static str, String)> = vec![];
    for step in csg.steps {
        let piece = match step {
            CsgStep::Solid(solid) => shape(&Shape::from(*solid))?,
            operator => {
                let ((right, right_text), (left, left_text)) = (stack.pop()?, stack.pop()?);
                // A merge is a union that has no walls inside.
                let kind = match operator {
                    CsgStep::Intersection => "intersection",
                    CsgStep::Difference => "difference",
                    _ => "merge",
                };
                (kind, format!("{left} {{ {left_text} }} {right} {{ {right_text} }}"))
            }
        };
        stack.push(piece);
    }
    let whole = stack.pop()?;
    stack.is_empty().then_some(whole)
}

/// A quadric: intersected with its box if it is capped, else clipped by the box.
fn quadric(shape: &Quadric) -> (&'static str, String) {
    let [squares @ .., constant] = &shape.coefficients;
    let equation = squares.chunks(3).map(list).collect::<Vec<_>>().join(", ");
    let equation = format!("{equation}, {constant} translate {}", point(shape.center));
    let corners = format!("box {{ {} }}", points(&[shape.center + shape.min, shape.center + shape.max]));
    if shape.capped {
        ("intersection", format!("quadric {{ {equation} }} {corners}"))
    } else {
        ("quadric", format!("{equation} clipped_by {{ {corners} }}"))
    }
}

/// Metaballs: the sum of the blobs as a function, in the bounding box of all blobs. POV-Ray's own blobs have
/// another kernel.
fn metaballs(metaballs: &Metaballs<'_>) -> String {
    let term = |blob: &Blob| {
        let Vec3 { x, y, z } = blob.center;
        let squared = format!("(pow(x - ({x}), 2) + pow(y - ({y}), 2) + pow(z - ({z}), 2))");
        let share = format!("min(1, {squared} / {})", f64::from(blob.radius).powi(2));
        format!(" - ({}) * pow(1 - {share}, 2) * (1 - {share} * 4 / 9)", blob.strength)
    };
    let terms: String = metaballs.blobs.iter().map(term).collect();
    let corner = |side: f32| {
        let reach = |blob: &Blob| blob.center + Vec3::new(1.0, 1.0, 1.0) * (blob.radius * side);
        let farther = |a: f32, b: f32| if (b - a) * side > 0.0 { b } else { a };
        let farthest = metaballs
            .blobs
            .iter()
            .map(reach)
            .reduce(|a, b| Vec3::new(farther(a.x, b.x), farther(a.y, b.y), farther(a.z, b.z)));
        point(farthest.unwrap_or(Vec3::ZERO))
    };
    // A bound on the gradient at a point: the sum of the steepest slopes of all blobs that overlap a blob
    // there.
    let steepest = |at: &Blob| -> f32 {
        let overlaps = |blob: &&Blob| (blob.center - at.center).length() < blob.radius + at.radius;
        metaballs.blobs.iter().filter(overlaps).map(|blob| 1.6 * blob.strength.abs() / blob.radius).sum()
    };
    let gradient = metaballs.blobs.iter().map(steepest).fold(0.0, f32::max);
    // POV-Ray's default accuracy, a thousandth of a unit, turns normals so much that colors change by several
    // levels.
    let accuracy = metaballs.blobs.iter().map(|blob| blob.radius).fold(1.0, f32::min) * 1e-4;
    format!(
        "function {{ 0.5{terms} }} contained_by {{ box {{ {}, {} }} }} accuracy {accuracy} max_gradient \
         {gradient}",
        corner(-1.0),
        corner(1.0)
    )
}

fn torus(torus: &Torus) -> String {
    // The axis of POV-Ray's torus is the y axis.
    let up = unit(torus.axis.to::<f64>());
    let aside = if up.x.abs() < 0.5 { Vec3::new(1.0, 0.0, 0.0) } else { Vec3::new(0.0, 1.0, 0.0) };
    let right = unit(up.cross(aside));
    let turned = matrix([right, up, right.cross(up), torus.center.to()]);
    format!("{}, {} {turned}", torus.major_radius, torus.minor_radius)
}

fn plane(plane: &Plane) -> String {
    let normal = unit(plane.normal.to::<f64>());
    format!("{}, {}", xyz(normal), normal.dot(plane.point.to()))
}

fn polygon(vertices: &[Vec3<f64>]) -> (&'static str, String) {
    // POV-Ray requires the first point again at the end.
    let closed: Vec<_> = vertices.iter().chain(vertices.first()).map(|vertex| xyz(*vertex)).collect();
    ("polygon", format!("{}, {}", closed.len(), closed.join(", ")))
}

/// The corners of a rectangle. They are exact in `f64`: POV-Ray draws no polygon whose corners do not lie
/// exactly in one plane.
pub(super) fn corners<R: Real>(rectangle: &Rectangle) -> [Vec3<R>; 4] {
    let [corner, right, up] = [rectangle.corner, rectangle.right, rectangle.up].map(Vec3::to);
    [corner, corner + right, corner + right + up, corner + up]
}

fn mesh(mesh: &Mesh<'_>) -> String {
    let vectors = |name, vectors: &[Vec3]| format!("{name} {{ {}, {} }}", vectors.len(), points(vectors));
    let faces: Vec<_> = mesh.triangles.iter().map(|triangle| list(triangle)).collect();
    let normals = mesh.normals.map_or(String::new(), |normals| vectors("normal_vectors", normals) + " ");
    let uvs = mesh.uvs.map_or(String::new(), |uvs| {
        let places: Vec<_> = uvs.iter().map(|uv| list(uv)).collect();
        format!("uv_vectors {{ {}, {} }} ", places.len(), places.join(", "))
    });
    format!(
        "{} {normals}{uvs}face_indices {{ {}, {} }}",
        vectors("vertex_vectors", mesh.vertices),
        faces.len(),
        faces.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayline::shape::{Ellipsoid, Model, Pose, Solid, Sphere};

    const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);

    #[test]
    fn ellipsoids_and_quadrics() {
        let egg = Ellipsoid::new(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.5, 1.0, 2.0));
        let (kind, text) = shape(&Shape::Ellipsoid(egg)).unwrap();
        assert_eq!((kind, text.as_str()), ("sphere", "0, 1 matrix <0.5, 0, 0, 0, 1, 0, 0, 0, 2, 1, 2, 3>"));
        let corner = Vec3::new(1.0, 1.0, 1.0);
        let bowl = Quadric {
            center: UP,
            coefficients: [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, -10.0],
            min: -corner,
            max: corner,
            capped: true,
        };
        let equation = "<1, 2, 3>, <4, 5, 6>, <7, 8, 9>, -10 translate <0, 1, 0>";
        let corners = "box { <-1, 0, -1>, <1, 2, 1> }";
        let (kind, text) = shape(&Shape::Quadric(bowl)).unwrap();
        assert_eq!((kind, text), ("intersection", format!("quadric {{ {equation} }} {corners}")));
        let (kind, text) = shape(&Shape::Quadric(Quadric { capped: false, ..bowl })).unwrap();
        assert_eq!((kind, text), ("quadric", format!("{equation} clipped_by {{ {corners} }}")));
    }

    #[test]
    fn metaballs_are_a_function() {
        let blobs = [Blob::new(UP, 2.0), Blob { strength: -0.5, ..Blob::new(Vec3::ZERO, 1.0) }];
        let (kind, text) = shape(&Shape::Metaballs(Metaballs::new(&blobs))).unwrap();
        let first = "min(1, (pow(x - (0), 2) + pow(y - (1), 2) + pow(z - (0), 2)) / 4)";
        let second = "min(1, (pow(x - (0), 2) + pow(y - (0), 2) + pow(z - (0), 2)) / 1)";
        let first = format!("(1) * pow(1 - {first}, 2) * (1 - {first} * 4 / 9)");
        let second = format!("(-0.5) * pow(1 - {second}, 2) * (1 - {second} * 4 / 9)");
        let within = "contained_by { box { <-2, -1, -2>, <2, 3, 2> } } accuracy 0.0001 max_gradient 1.6";
        assert_eq!((kind, text), ("isosurface", format!("function {{ 0.5 - {first} - {second} }} {within}")));
    }

    #[test]
    fn instances_are_enlarged_turned_and_moved() {
        let blobs = [Blob::new(Vec3::ZERO, 2.0)];
        let model = Model::Metaballs(Metaballs::new(&blobs));
        let (_, ball) = shape(&Shape::from(model)).unwrap();
        let places = [Pose::at(UP).turned(Vec3::new(0.0, core::f32::consts::PI, 0.0)), Pose::at(Vec3::ZERO)];
        let pair = Instances::new(&model, &places).sized(0.5);
        let first = format!("{ball} scale 0.5 rotate <0, 180.00000500895632, 0> translate <0, 1, 0>");
        let second = format!("{ball} scale 0.5 rotate <0, 0, 0> translate <0, 0, 0>");
        let all = format!("isosurface {{ {first} }}\n  isosurface {{ {second} }}");
        assert_eq!(shape(&Shape::Instances(pair)), Some(("union", all)));
        let alone = Instances { poses: &places[..1], ..pair };
        assert_eq!(shape(&Shape::Instances(alone)), Some(("isosurface", first)));
    }

    #[test]
    fn tori_are_turned() {
        let axis = Vec3::new(0.0, 0.0, 2.0);
        let ring = Torus { center: UP, axis, major_radius: 2.0, minor_radius: 0.5 };
        let (kind, text) = shape(&Shape::Torus(ring)).unwrap();
        assert_eq!((kind, text.as_str()), ("torus", "2, 0.5 matrix <0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0>"));
    }

    #[test]
    fn meshes_keep_their_shared_vertices() {
        let corners = [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0), UP, Vec3::new(1.0, 1.0, 0.0)];
        let mesh = Mesh::new(&corners, &[[0, 1, 2], [2, 1, 3]]);
        let flat = "vertex_vectors { 4, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>, <1, 1, 0> }";
        let faces = "face_indices { 2, <0, 1, 2>, <2, 1, 3> }";
        assert_eq!(shape(&Shape::Mesh(mesh)), Some(("mesh2", format!("{flat} {faces}"))));
        let smooth = Shape::Mesh(Mesh { normals: Some(&[UP; 4]), ..mesh });
        let normals = "normal_vectors { 4, <0, 1, 0>, <0, 1, 0>, <0, 1, 0>, <0, 1, 0> }";
        assert_eq!(shape(&smooth), Some(("mesh2", format!("{flat} {normals} {faces}"))));
    }

    #[test]
    fn solids_are_put_together() {
        let ball = |radius: f32| CsgStep::Solid(Solid::Sphere(Sphere::new(Vec3::ZERO, radius)));
        let steps = [
            ball(1.0),
            ball(2.0),
            CsgStep::Union,
            ball(3.0),
            ball(4.0),
            CsgStep::Intersection,
            CsgStep::Difference,
        ];
        let (kind, text) = shape(&Shape::Csg(Csg::new(&steps))).unwrap();
        let sphere = |radius: u8| format!("sphere {{ <0, 0, 0>, {radius} }}");
        let pair = |kind: &str, a: u8, b: u8| format!("{kind} {{ {} {} }}", sphere(a), sphere(b));
        assert_eq!(kind, "difference");
        assert_eq!(text, format!("{} {}", pair("merge", 1, 2), pair("intersection", 3, 4)));
        assert_eq!(shape(&Shape::Csg(Csg::new(&steps[..4]))), None);
    }
}
