//! The flat faces of objects that get a texture of light, and their points.

use rayline::shape::{Cuboid, Geometry, Rectangle, Shape};
use rayline::{Placement, Vec3};

use super::{Vector, vector};

/// A flat part of an object: a parallelogram, or a part of one.
#[derive(Clone, Debug)]
pub(super) struct Face {
    /// The position of the object in the scene.
    pub(super) object: usize,
    corner: Vector,
    /// The edges along which the texture's x and y grow from 0 to 1.
    pub(super) right: Vector,
    pub(super) up: Vector,
    /// The unit normal, on the side whose light counts.
    pub(super) normal: Vector,
    outline: Outline,
}

/// The part of the parallelogram that belongs to a face.
#[derive(Clone, Debug)]
enum Outline {
    All,
    /// Below the diagonal from the upper left.
    Triangle,
    /// Inside of these corners, in units of the edges.
    Polygon(Vec<[f64; 2]>),
}

impl Face {
    /// The faces of an object, and the placement of their textures; `None` if the object has no flat faces
    /// with corners. Of a face that is seen from both sides, the side of the eye counts.
    pub(super) fn of(shape: &Shape<'_>, object: usize, eye: Vector) -> Option<(Vec<Self>, Placement)> {
        let face = |corner, [right, up]: [Vector; 2], outline| {
            let normal = right.cross(up).normalized()?;
            let normal = if normal.dot(eye - corner) < 0.0 { -normal } else { normal };
            Some(Self { object, corner, right, up, normal, outline })
        };
        let mut placement = Placement::SURFACE;
        let faces = match shape {
            Shape::Rectangle(Rectangle { corner, right, up }) => {
                vec![face(vector(*corner), [vector(*right), vector(*up)], Outline::All)?]
            }
            Shape::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices.map(vector);
                vec![face(a, [b - a, c - a], Outline::Triangle)?]
            }
            Shape::Cuboid(cuboid) => Self::of_box(cuboid, object)?,
            Shape::Polygon(polygon) => {
                let corners: Vec<_> = polygon.vertices.iter().copied().map(vector).collect();
                let (around, place) = around(&corners)?;
                placement = place;
                vec![face(around.0, around.1, Outline::Polygon(around.2))?]
            }
            _ => return None,
        };
        Some((faces, placement))
    }

    /// The six faces of a box, in the order of its parts, with the texture coordinates that it has.
    fn of_box(Cuboid { center, axes }: &Cuboid, object: usize) -> Option<Vec<Self>> {
        let (center, [a, b, c]) = (vector(*center), axes.map(vector));
        let two = |axis: Vector| axis * 2.0;
        let faces = [
            (-a, center - a - b - c, [two(c), two(b)]),
            (a, center + a - b + c, [two(-c), two(b)]),
            (-b, center - a - b - c, [two(a), two(c)]),
            (b, center - a + b + c, [two(a), two(-c)]),
            (-c, center + a - b - c, [two(-a), two(b)]),
            (c, center - a - b + c, [two(a), two(b)]),
        ];
        let face = |(outward, corner, [right, up]): (Vector, Vector, [Vector; 2])| {
            Some(Self { object, corner, right, up, normal: outward.normalized()?, outline: Outline::All })
        };
        faces.into_iter().map(face).collect()
    }

    pub(super) fn point(&self, [x, y]: [f64; 2]) -> Vector {
        self.corner + self.right * x + self.up * y
    }

    /// The area of the whole parallelogram.
    pub(super) fn whole_area(&self) -> f64 {
        self.right.cross(self.up).length()
    }

    /// Whether a place on the parallelogram belongs to the face.
    pub(super) fn has(&self, [x, y]: [f64; 2]) -> bool {
        match &self.outline {
            Outline::All => true,
            Outline::Triangle => x + y <= 1.0,
            Outline::Polygon(corners) => {
                // A line to the right crosses the outline an odd number of times (Shimrat, 1962).
                let edges = corners.iter().zip(corners.iter().cycle().skip(1));
                let crossings = edges.filter(|([ax, ay], [bx, by])| {
                    (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
                });
                crossings.count() % 2 == 1
            }
        }
    }
}

/// The rectangle around a polygon: its corner, its edges and the polygon's corners in units of them; and the
/// placement of a texture on it.
#[expect(clippy::type_complexity, reason = "the parts are taken apart at once")]
fn around(corners: &[Vector]) -> Option<((Vector, [Vector; 2], Vec<[f64; 2]>), Placement)> {
    // Newell's normal, as the shape has it.
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let normal = edges.fold(Vec3::new(0.0, 0.0, 0.0), |sum, (a, b)| sum + a.cross(*b)).normalized()?;
    let (first, second) = normal.around();
    let flat = |point: &Vector| [first.dot(*point), second.dot(*point)];
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in corners.iter().map(flat) {
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    let size = [high[0] - low[0], high[1] - low[1]];
    let height = normal.dot(*corners.first()?);
    let corner = first * low[0] + second * low[1] + normal * height;
    let outline = corners.iter().map(|point| {
        let [x, y] = flat(point);
        [(x - low[0]) / size[0], (y - low[1]) / size[1]]
    });
    let placement = Placement::SURFACE
        .stretched(Vec3::new(size[0] as f32, size[1] as f32, 1.0))
        .at(Vec3::new(low[0] as f32, low[1] as f32, 0.0));
    Some(((corner, [first * size[0], second * size[1]], outline.collect()), placement))
}

/// Whether the inside of an object is dark: it is a body, or a mesh, which most often is one.
pub(super) fn has_inside(shape: &Shape<'_>) -> bool {
    shape.is_solid() || matches!(shape, Shape::Mesh(_))
}
