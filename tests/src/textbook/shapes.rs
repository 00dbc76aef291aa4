//! Intersections of rays with shapes.

use glam::{DMat3, DQuat, DVec3};
use rayline::Vec3;
use rayline::shape::{Blob, Disc, Instances, Mesh, Quadric, Rectangle, Shape, Torus, Triangle};

use super::{Crossing, Ray, vector};

/// All intersections of a shape with the line of a ray, in both directions.
pub(super) fn crossings(shape: &Shape<'_>, ray: Ray) -> Vec<Crossing> {
    match *shape {
        Shape::Sphere(sphere) => self::sphere(vector(sphere.center), f64::from(sphere.radius), ray),
        Shape::Plane(plane) => {
            self::plane(vector(plane.point), vector(plane.normal), ray).into_iter().collect()
        }
        Shape::Disc(disc) => self::disc(&disc, ray).into_iter().collect(),
        Shape::Rectangle(rectangle) => self::rectangle(&rectangle, ray).into_iter().collect(),
        Shape::Triangle(triangle) => self::triangle(&triangle, ray).into_iter().collect(),
        Shape::Polygon(polygon) => {
            let vertices: Vec<DVec3> = polygon.vertices.iter().copied().map(vector).collect();
            self::polygon(&vertices, ray).into_iter().collect()
        }
        Shape::Cylinder(shape) => {
            let radius = f64::from(shape.radius);
            frustum(vector(shape.base), radius, vector(shape.top), radius, shape.capped, ray)
        }
        Shape::Cone(shape) => {
            let (base_radius, top_radius) = (f64::from(shape.base_radius), f64::from(shape.top_radius));
            frustum(vector(shape.base), base_radius, vector(shape.top), top_radius, shape.capped, ray)
        }
        Shape::Ellipsoid(shape) => ellipsoid(vector(shape.center), shape.axes.map(vector), ray),
        Shape::Quadric(shape) => self::quadric(&shape, ray),
        Shape::Torus(shape) => torus(&shape, ray),
        Shape::Cuboid(cuboid) => {
            let center = vector(cuboid.center);
            let ways = cuboid.axes.map(vector).into_iter().flat_map(|axis| [-axis, axis]);
            polyhedron(&ways.map(|way| (center + way, way)).collect::<Vec<_>>(), ray)
        }
        Shape::ConvexPolyhedron(polyhedron) => {
            let faces = polyhedron.planes.iter().map(|plane| (vector(plane.point), vector(plane.normal)));
            self::polyhedron(&faces.collect::<Vec<_>>(), ray)
        }
        Shape::Mesh(mesh) => self::mesh(mesh, ray),
        Shape::Csg(csg) => super::solids::crossings(csg.steps, ray),
        Shape::Metaballs(metaballs) => self::metaballs(metaballs.blobs, ray),
        Shape::Instances(shape) => instances(&shape, ray),
    }
}

/// The intersections with the model at each pose.
fn instances(instances: &Instances<'_>, ray: Ray) -> Vec<Crossing> {
    let (model, size) = (Shape::from(*instances.model), f64::from(instances.size));
    let places = instances.poses.iter().flat_map(|pose| {
        let DVec3 { x, y, z } = vector(pose.rotation);
        let turn = DQuat::from_rotation_z(z) * DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x);
        let back = turn.inverse();
        let origin = back * (ray.origin - vector(pose.origin)) / size;
        let there = Ray { origin, direction: back * ray.direction };
        crossings(&model, there).into_iter().map(move |crossing| Crossing {
            t: crossing.t * size,
            geometric: turn * crossing.geometric,
            normal: turn * crossing.normal,
            lift: crossing.lift * size,
        })
    });
    places.collect()
}

/// The sum of the blobs at a point, and its gradient: Wyvill's polynomial in the squared distance.
fn blobs_at(blobs: &[Blob], point: DVec3) -> (f64, DVec3) {
    let (mut sum, mut gradient) = (0.0, DVec3::ZERO);
    for blob in blobs {
        let (way, radius) = (point - vector(blob.center), f64::from(blob.radius));
        let (q, strength) = (way.length_squared() / (radius * radius), f64::from(blob.strength));
        if q < 1.0 {
            sum += strength * (1.0 - 22.0 / 9.0 * q + 17.0 / 9.0 * q * q - 4.0 / 9.0 * q * q * q);
            let slope = -22.0 / 9.0 + 34.0 / 9.0 * q - 12.0 / 9.0 * q * q;
            gradient += way * (2.0 / (radius * radius) * strength * slope);
        }
    }
    (sum, gradient)
}

/// The points where the sum crosses 1/2: searched in small steps through each blob, then by bisection.
fn metaballs(blobs: &[Blob], ray: Ray) -> Vec<Crossing> {
    const STEPS: u32 = 600;
    let at = |t: f64| ray.origin + ray.direction * t;
    let is_inside = |t: f64| blobs_at(blobs, at(t)).0 > 0.5;
    let ends: Vec<f64> = blobs
        .iter()
        .flat_map(|blob| sphere(vector(blob.center), f64::from(blob.radius), ray))
        .map(|end| end.t)
        .collect();
    let (first, last) = (
        ends.iter().copied().fold(f64::INFINITY, f64::min),
        ends.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    );
    let place = |step: u32| first + (last - first) * f64::from(step) / f64::from(STEPS);
    let mut crossings = vec![];
    for (mut before, mut after) in (0..STEPS).map(|step| (place(step), place(step + 1))) {
        if is_inside(before) == is_inside(after) {
            continue;
        }
        for _ in 0..60 {
            let middle = (before + after) / 2.0;
            if is_inside(middle) == is_inside(before) {
                before = middle;
            } else {
                after = middle;
            }
        }
        crossings.push(flat(before, -blobs_at(blobs, at(before)).1.normalize()));
    }
    crossings
}

fn flat(t: f64, normal: DVec3) -> Crossing {
    Crossing { t, geometric: normal, normal, lift: 0.0 }
}

/// The real roots of a t² + b t + c = 0.
fn quadratic(a: f64, b: f64, c: f64) -> Vec<f64> {
    if a.abs() < 1e-12 {
        return if b == 0.0 { vec![] } else { vec![-c / b] };
    }
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return vec![];
    }
    vec![(-b - discriminant.sqrt()) / (2.0 * a), (-b + discriminant.sqrt()) / (2.0 * a)]
}

/// |o + t d - c|² = r².
fn sphere(center: DVec3, radius: f64, ray: Ray) -> Vec<Crossing> {
    let from_center = ray.origin - center;
    let roots = quadratic(
        ray.direction.dot(ray.direction),
        2.0 * ray.direction.dot(from_center),
        from_center.dot(from_center) - radius * radius,
    );
    roots.into_iter().map(|t| flat(t, (from_center + ray.direction * t) / radius)).collect()
}

/// |M⁻¹ (o + t d - c)| = 1.
fn ellipsoid(center: DVec3, [a, b, c]: [DVec3; 3], ray: Ray) -> Vec<Crossing> {
    let inverse = DMat3::from_cols(a, b, c).inverse();
    let (o, d) = (inverse * (ray.origin - center), inverse * ray.direction);
    let roots = quadratic(d.dot(d), 2.0 * o.dot(d), o.dot(o) - 1.0);
    roots.into_iter().map(|t| flat(t, (inverse.transpose() * (o + d * t)).normalize())).collect()
}

/// The value of a quadric's polynomial, and its gradient.
pub(super) fn polynomial(quadric: &Quadric, p: DVec3) -> (f64, DVec3) {
    let [a, b, c, d, e, f, g, h, i, j] = quadric.coefficients.map(f64::from);
    let DVec3 { x, y, z } = p - vector(quadric.center);
    let value =
        a * x * x + b * y * y + c * z * z + d * x * y + e * x * z + f * y * z + g * x + h * y + i * z + j;
    let gradient = DVec3::new(
        2.0 * a * x + d * y + e * z + g,
        2.0 * b * y + d * x + f * z + h,
        2.0 * c * z + e * x + f * y + i,
    );
    (value, gradient)
}

/// The polynomial along the ray, by its values at three points; then the part of its surface inside of the
/// box, and for a capped one the part of the box inside of it.
fn quadric(quadric: &Quadric, ray: Ray) -> Vec<Crossing> {
    let center = vector(quadric.center);
    let (min, max) = (center + vector(quadric.min), center + vector(quadric.max));
    let at = |t: f64| ray.origin + ray.direction * t;
    let in_box = |p: DVec3, margin: f64| {
        let margin = DVec3::splat(margin);
        p.cmpge(min - margin).all() && p.cmple(max + margin).all()
    };
    let middle = ray.direction.dot((min + max) / 2.0 - ray.origin);
    let [before, here, after] = [-1.0, 0.0, 1.0].map(|step| polynomial(quadric, at(middle + step)).0);
    let roots = quadratic((before + after) / 2.0 - here, (after - before) / 2.0, here);
    let side = roots
        .into_iter()
        .map(|t| t + middle)
        .filter(|t| in_box(at(*t), 0.0))
        .map(|t| flat(t, polynomial(quadric, at(t)).1.normalize()));
    let faces = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [(max, axis), (min, -axis)]);
    let caps = faces
        .filter_map(|(corner, normal)| plane(corner, normal, ray))
        .filter(|cap| quadric.capped && in_box(at(cap.t), 1e-9) && polynomial(quadric, at(cap.t)).0 <= 0.0);
    side.chain(caps).collect()
}

/// The vector from the nearest point of the circle in the middle of the tube.
pub(super) fn from_circle(torus: &Torus, point: DVec3) -> DVec3 {
    let (axis, from_center) = (vector(torus.axis).normalize(), point - vector(torus.center));
    from_center - from_center.reject_from(axis).normalize() * f64::from(torus.major_radius)
}

/// The points where the distance from the circle crosses the tube's radius: searched in small steps, then by
/// bisection.
fn torus(torus: &Torus, ray: Ray) -> Vec<Crossing> {
    const STEPS: u32 = 300;
    let (major, minor) = (f64::from(torus.major_radius), f64::from(torus.minor_radius));
    let ends = sphere(vector(torus.center), major + minor, ray);
    let [enters, leaves] = ends[..] else { return vec![] };
    let way = |t: f64| from_circle(torus, ray.origin + ray.direction * t);
    let is_inside = |t: f64| way(t).length() < minor;
    let place = |step: u32| enters.t + (leaves.t - enters.t) * f64::from(step) / f64::from(STEPS);
    let mut crossings = vec![];
    for (mut before, mut after) in (0..STEPS).map(|step| (place(step), place(step + 1))) {
        let begins_inside = is_inside(before);
        if begins_inside == is_inside(after) {
            continue;
        }
        for _ in 0..60 {
            let middle = (before + after) / 2.0;
            *(if is_inside(middle) == begins_inside { &mut before } else { &mut after }) = middle;
        }
        crossings.push(flat(after, way(after).normalize()));
    }
    crossings
}

/// (o + t d - p) · n = 0.
fn plane(point: DVec3, normal: DVec3, ray: Ray) -> Option<Crossing> {
    let normal = normal.normalize();
    let slope = ray.direction.dot(normal);
    (slope != 0.0).then(|| flat((point - ray.origin).dot(normal) / slope, normal))
}

/// The point in the plane, tested by its distance from the center.
fn disc(disc: &Disc, ray: Ray) -> Option<Crossing> {
    let center = vector(disc.center);
    let crossing = plane(center, vector(disc.normal), ray)?;
    let distance = center.distance(ray.origin + ray.direction * crossing.t);
    (distance >= f64::from(disc.hole) && distance <= f64::from(disc.radius)).then_some(crossing)
}

/// The point in the plane, tested against both pairs of opposite sides.
fn rectangle(rectangle: &Rectangle, ray: Ray) -> Option<Crossing> {
    let (corner, right, up) = (vector(rectangle.corner), vector(rectangle.right), vector(rectangle.up));
    let crossing = plane(corner, right.cross(up), ray)?;
    let from_corner = ray.origin + ray.direction * crossing.t - corner;
    let from_opposite = from_corner - right - up;
    let between = |side: DVec3| {
        let turn = |from: DVec3| side.cross(from).dot(crossing.normal);
        turn(from_corner) * turn(from_opposite) <= 0.0
    };
    (between(right) && between(up)).then_some(crossing)
}

/// o + t d = (1 - u - v) a + u b + v c, by Cramer's rule (Möller and Trumbore, "Fast, Minimum Storage
/// Ray/Triangle Intersection", Journal of Graphics Tools, 1997).
fn triangle(triangle: &Triangle, ray: Ray) -> Option<Crossing> {
    let [a, b, c] = triangle.vertices.map(vector);
    let (ab, ac) = (b - a, c - a);
    let p = ray.direction.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let from_a = ray.origin - a;
    let u = from_a.dot(p) / determinant;
    let q = from_a.cross(ab);
    let v = ray.direction.dot(q) / determinant;
    if u < 0.0 || v < 0.0 || u + v > 1.0 {
        return None;
    }
    let geometric = ab.cross(ac).normalize();
    let normal = triangle.normals.map_or(geometric, |normals| {
        let [at_a, at_b, at_c] = normals.map(|normal| vector(normal).normalize());
        (at_a * (1.0 - u - v) + at_b * u + at_c * v).normalize()
    });
    Some(Crossing { t: ac.dot(q) / determinant, geometric, normal, lift: 0.0 })
}

/// The triangles of a mesh.
fn triangles(mesh: Mesh<'_>) -> impl Iterator<Item = Triangle> {
    mesh.triangles.iter().map(move |corners| {
        let of = |vectors: &[Vec3]| corners.map(|corner| vectors[usize::from(corner)]);
        Triangle { vertices: of(mesh.vertices), normals: mesh.normals.map(of) }
    })
}

/// The points on the triangles, and how far above them the smooth surface lies: the mean of the projections
/// of the point onto the planes at the corners that lie above it (Hanika 2021), along the triangle's normal.
fn mesh(mesh: Mesh<'_>, ray: Ray) -> Vec<Crossing> {
    let lifted = |triangle: Triangle| {
        let crossing = self::triangle(&triangle, ray)?;
        let (true, Some(normals)) = (mesh.smooth_terminator, triangle.normals) else { return Some(crossing) };
        let side = -crossing.geometric.dot(ray.direction).signum();
        let facing = crossing.geometric * side;
        let point = ray.origin + ray.direction * crossing.t;
        let [a, b, c] = triangle.vertices.map(vector);
        let area = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).length();
        let shares = [area(point, b, c), area(point, c, a), area(point, a, b)];
        let heights = [a, b, c].into_iter().zip(normals).map(|(corner, normal)| {
            let normal = vector(normal).normalize();
            let normal = normal * normal.dot(facing).signum();
            (corner - point).dot(normal).max(0.0) * normal.dot(facing)
        });
        let sum: f64 = heights.zip(shares).map(|(height, share)| height * share).sum();
        Some(Crossing { lift: sum / area(a, b, c) * side, ..crossing })
    };
    triangles(mesh).filter_map(lifted).collect()
}

/// The point in the plane of the outline (Newell's normal: Sutherland, Sproull and Schumacker 1974), tested
/// by the angle that the outline sweeps around it: an odd number of full turns means inside.
fn polygon(vertices: &[DVec3], ray: Ray) -> Option<Crossing> {
    let edges = || vertices.iter().copied().zip(vertices.iter().copied().cycle().skip(1));
    let normal: DVec3 = edges().map(|(a, b)| (a - vertices[0]).cross(b - vertices[0])).sum();
    let crossing = plane(vertices[0], normal, ray)?;
    let point = ray.origin + ray.direction * crossing.t;
    let swept: f64 = edges()
        .map(|(a, b)| (a - point, b - point))
        .map(|(a, b)| crossing.normal.dot(a.cross(b)).atan2(a.dot(b)))
        .sum();
    let turns = (swept / std::f64::consts::TAU).round() as i64;
    (turns % 2 != 0).then_some(crossing)
}

/// The points on each plane that are behind all others. A face is a point and a normal.
fn polyhedron(faces: &[(DVec3, DVec3)], ray: Ray) -> Vec<Crossing> {
    let crossing = |(index, (point, normal)): (usize, &(DVec3, DVec3))| {
        let crossing = plane(*point, *normal, ray)?;
        let at = ray.origin + ray.direction * crossing.t;
        let hidden = |(other, (point, normal)): (usize, &(DVec3, DVec3))| {
            other != index && (at - point).dot(*normal) > 0.0
        };
        (!faces.iter().enumerate().any(hidden)).then_some(crossing)
    };
    faces.iter().enumerate().filter_map(crossing).collect()
}

/// A cone, cylinder or frustum, turned so that its axis is z and its base lies at the origin: there
/// x² + y² = (base_radius + slope z)².
fn frustum(
    base: DVec3,
    base_radius: f64,
    top: DVec3,
    top_radius: f64,
    capped: bool,
    ray: Ray,
) -> Vec<Crossing> {
    let height = base.distance(top);
    let slope = (top_radius - base_radius) / height;
    let upright = DQuat::from_rotation_arc((top - base) / height, DVec3::Z);
    let (o, d) = (upright * (ray.origin - base), upright * ray.direction);
    let radius_at_origin = base_radius + slope * o.z;
    let roots = quadratic(
        d.x * d.x + d.y * d.y - slope * slope * d.z * d.z,
        2.0 * (o.x * d.x + o.y * d.y - slope * d.z * radius_at_origin),
        o.x * o.x + o.y * o.y - radius_at_origin * radius_at_origin,
    );
    let at = |t: f64| o + d * t;
    let side = roots.into_iter().filter(|t| (0.0..=height).contains(&at(*t).z)).map(|t| {
        let point = at(t);
        let gradient = DVec3::new(point.x, point.y, -slope * (base_radius + slope * point.z));
        flat(t, (upright.inverse() * gradient).normalize())
    });
    let lid = |z: f64, radius: f64, normal: DVec3| {
        let t = (z - o.z) / d.z;
        let inside = capped && at(t).truncate().length() <= radius;
        inside.then(|| flat(t, upright.inverse() * normal))
    };
    side.chain(lid(0.0, base_radius, -DVec3::Z)).chain(lid(height, top_radius, DVec3::Z)).collect()
}
