//! The shapes of a file's objects.

use bumpalo::Bump;
use rayline::math::Aabb;
use rayline::shape::{Cone, Cylinder, Polygon, Shape, Sphere, Triangle};
use rayline::{Object, Vec3};

use super::NffError;
use super::tokens::Tokens;
use crate::model::has_area;
use crate::model::polygon::Polygons;
use crate::space::vector;

/// The shapes that one statement becomes, and a note if it was changed or left out.
pub(super) struct Made<'a> {
    pub(super) shapes: Vec<Shape<'a>>,
    pub(super) note: Option<&'static str>,
}

impl<'a> Made<'a> {
    fn one(shape: impl Into<Shape<'a>>) -> Self {
        Self { shapes: vec![shape.into()], note: None }
    }

    const fn left_out(note: &'static str) -> Self {
        Self { shapes: Vec::new(), note: Some(note) }
    }
}

/// The note about objects of which the inside alone is meant to be seen.
const INSIDE: &str = "a negative radius asks for the inside alone; both sides are drawn";
const NO_AREA: &str = "a polygon without area is left out";
const FEW_CORNERS: &str = "a polygon with fewer than three corners is left out";

pub(super) fn sphere<'a>(tokens: &mut Tokens<'_>) -> Result<Made<'a>, NffError> {
    let center = tokens.vector("the center of the sphere")?;
    let radius = tokens.number("the radius of the sphere")?;
    if radius == 0.0 {
        return Ok(Made::left_out("a sphere of radius 0 is left out"));
    }
    let note = (radius < 0.0).then_some(INSIDE);
    Ok(Made { note, ..Made::one(Shape::Sphere(Sphere::new(center, radius.abs()))) })
}

pub(super) fn cone<'a>(tokens: &mut Tokens<'_>) -> Result<Made<'a>, NffError> {
    let base = tokens.vector("the middle of the base")?;
    let base_radius = tokens.number("the radius of the base")?;
    let top = tokens.vector("the middle of the apex")?;
    let top_radius = tokens.number("the radius of the apex")?;
    let (least, most) = (base_radius.min(top_radius), base_radius.max(top_radius));
    if base == top {
        return Ok(Made::left_out("a cone without length is left out"));
    }
    if least == 0.0 && most == 0.0 {
        return Ok(Made::left_out("a cone of radius 0 is left out"));
    }
    if least < 0.0 && most > 0.0 {
        return Ok(Made::left_out("a cone whose radii have different signs is left out"));
    }
    let (base_radius, top_radius) = (base_radius.abs(), top_radius.abs());
    let shape = if base_radius == top_radius {
        Shape::Cylinder(Cylinder { base, top, radius: base_radius, capped: false })
    } else {
        Shape::Cone(Cone { base, base_radius, top, top_radius, capped: false })
    };
    Ok(Made { note: (least < 0.0).then_some(INSIDE), ..Made::one(shape) })
}

/// Reads a count, and then that number of items.
fn list<T>(
    tokens: &mut Tokens<'_>,
    item: impl Fn(&mut Tokens<'_>) -> Result<T, NffError>,
) -> Result<Vec<T>, NffError> {
    let count = tokens.count("the number of vertices", 0, u32::MAX)?;
    // The list grows with the contents of the file, not with the count, which may be wrong.
    let mut items = Vec::new();
    for _ in 0..count {
        items.push(item(tokens)?);
    }
    Ok(items)
}

pub(super) fn polygon<'a>(arena: &'a Bump, tokens: &mut Tokens<'_>) -> Result<Made<'a>, NffError> {
    let vertices = list(tokens, |tokens| tokens.vector("a vertex of the polygon"))?;
    Ok(match *vertices {
        [] | [_] | [_, _] => Made::left_out(FEW_CORNERS),
        [a, b, c] => {
            let triangle = Triangle::flat(a, b, c);
            if has_area(triangle.vertices) {
                Made::one(Shape::Triangle(triangle))
            } else {
                Made::left_out(NO_AREA)
            }
        }
        _ => match flatness(&vertices) {
            Flatness::Flat => Made::one(Shape::Polygon(Polygon::new(arena.alloc_slice_copy(&vertices)))),
            Flatness::NoArea => Made::left_out(NO_AREA),
            Flatness::Bent => bent(&vertices),
        },
    })
}

enum Flatness {
    Flat,
    Bent,
    NoArea,
}

/// Whether the vertices lie in a plane and enclose an area, by the rules of [`Polygon`] with a margin: twice
/// its least area, and nine tenths of its largest distance from the plane.
fn flatness(vertices: &[Vec3]) -> Flatness {
    let Some(corner) = vertices.first().map(|corner| corner.to::<f64>()) else { return Flatness::NoArea };
    let (mut doubled_area, mut largest) = (Vec3::ZERO, Vec3::ZERO);
    let (mut previous, mut extent): (_, f64) = (Vec3::ZERO, 0.0);
    for vertex in vertices {
        let vertex = vertex.to::<f64>() - corner;
        let triangle = previous.cross(vertex);
        doubled_area = doubled_area + triangle;
        if triangle.length() > largest.length() * 1.01 {
            largest = triangle;
        }
        extent = extent.max(vertex.length());
        previous = vertex;
    }
    let areas = [doubled_area, largest].map(|area| (area, area.length()));
    let mut large = areas.iter().filter(|(_, size)| *size > 2e-6 * extent * extent).peekable();
    if large.peek().is_none() {
        return Flatness::NoArea;
    }
    let is_plane = |(area, size): &(Vec3<f64>, f64)| {
        let off = |vertex: &Vec3| (vertex.to::<f64>() - corner).dot(*area).abs() / size;
        vertices.iter().all(|vertex| off(vertex) <= 9e-4 * extent)
    };
    if large.any(is_plane) { Flatness::Flat } else { Flatness::Bent }
}

/// The triangles of a polygon that is not flat.
fn bent<'a>(vertices: &[Vec3]) -> Made<'a> {
    let corners: Vec<_> = vertices.iter().map(|vertex| vector(*vertex)).collect();
    let (triangles, _) = Polygons::default().triangles(&corners);
    let at = |corner: u32| vertices.get(corner as usize).copied().unwrap_or(Vec3::ZERO);
    let triangles = triangles.into_iter().map(|triangle| triangle.map(at));
    let shapes = triangles.filter(|corners| has_area(*corners));
    let shapes = shapes.map(|[a, b, c]| Shape::Triangle(Triangle::flat(a, b, c))).collect();
    Made { shapes, note: Some("a polygon that is not flat is drawn as triangles") }
}

/// A vertex of a patch with its normal.
#[derive(Clone, Copy)]
struct Corner {
    place: Vec3,
    normal: Vec3,
}

pub(super) fn patch<'a>(tokens: &mut Tokens<'_>) -> Result<Made<'a>, NffError> {
    let mut corners = list(tokens, |tokens| {
        let place = tokens.vector("a vertex of the patch")?;
        Ok(Corner { place, normal: tokens.direction("the normal at a vertex of the patch")? })
    })?
    .into_iter();
    let (Some(first), Some(mut second)) = (corners.next(), corners.next()) else {
        return Ok(Made::left_out(FEW_CORNERS));
    };
    if corners.len() == 0 {
        return Ok(Made::left_out(FEW_CORNERS));
    }
    let (mut shapes, mut note) = (Vec::new(), None);
    for third in corners {
        let fan = [first, core::mem::replace(&mut second, third), third];
        let triangle = Triangle { vertices: fan.map(|corner| corner.place), normals: None };
        if !has_area(triangle.vertices) {
            note.get_or_insert(NO_AREA);
            continue;
        }
        let normals = fan.map(|corner| corner.normal);
        if normals.contains(&Vec3::ZERO) {
            note = Some("a normal without length is replaced by that of the plane");
        }
        let normals = Some(with_lengths(normals, &triangle));
        shapes.push(Shape::Triangle(Triangle { normals, ..triangle }));
    }
    Ok(Made { shapes, note })
}

/// The normals, with that of the triangle's plane in place of those of length 0, on the side of the others.
fn with_lengths(normals: [Vec3; 3], triangle: &Triangle) -> [Vec3; 3] {
    let [a, b, c] = triangle.vertices.map(Vec3::to::<f64>);
    let upright = (b - a).cross(c - a);
    let upright = (upright * upright.length().recip()).to_f32();
    let [first, second, third] = normals;
    let plane = if upright.dot(first + second + third) < 0.0 { -upright } else { upright };
    normals.map(|normal| if normal == Vec3::ZERO { plane } else { normal })
}

/// The bounding box of all objects; `None` if there are none.
pub(super) fn bounds(objects: &[Object<Shape<'_>>]) -> Option<Aabb<f32>> {
    objects.iter().filter_map(|object| of_shape(&object.shape)).reduce(Aabb::union)
}

fn of_shape(shape: &Shape<'_>) -> Option<Aabb<f32>> {
    let around = |center: Vec3, radius: f32| Aabb::around(center, Vec3::new(radius, radius, radius));
    let of_all = |points: &[Vec3]| points.iter().map(|point| Aabb::point(*point)).reduce(Aabb::union);
    match shape {
        Shape::Sphere(sphere) => Some(around(sphere.center, sphere.radius)),
        Shape::Cylinder(it) => Some(around(it.base, it.radius).union(around(it.top, it.radius))),
        Shape::Cone(it) => Some(around(it.base, it.base_radius).union(around(it.top, it.top_radius))),
        Shape::Triangle(triangle) => of_all(&triangle.vertices),
        Shape::Polygon(polygon) => of_all(polygon.vertices),
        // No statement becomes another shape.
        _ => None,
    }
}
