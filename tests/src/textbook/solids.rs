//! Constructive solid geometry: whether a point is inside of a solid, by the definition of each solid.

use glam::{DMat3, DVec3};
use rayline::shape::{CsgStep, Shape, Solid};

use super::shapes::{from_circle, polynomial};
use super::{Crossing, Ray, vector};

/// The distance in front of a surface and behind it at which points are tested to decide whether the surface
/// is one of the result.
const ASIDE: f64 = 1e-6;

/// The intersections with all solids at which the result begins or ends.
pub(super) fn crossings(steps: &[CsgStep<Solid<'_>>], ray: Ray) -> Vec<Crossing> {
    let is_in = |t: f64| is_inside(steps, ray.origin + ray.direction * t);
    let solids = steps.iter().filter_map(|step| match step {
        CsgStep::Solid(solid) => Some(solid),
        _ => None,
    });
    let mut crossings = vec![];
    for crossing in solids.flat_map(|solid| super::shapes::crossings(&Shape::from(*solid), ray)) {
        let (before, behind) = (is_in(crossing.t - ASIDE), is_in(crossing.t + ASIDE));
        if before == behind {
            continue;
        }
        // The normal points out of the result, also where a solid was subtracted.
        let is_outward = (crossing.geometric.dot(ray.direction) < 0.0) == behind;
        let turn = if is_outward { 1.0 } else { -1.0 };
        crossings.push(Crossing {
            geometric: crossing.geometric * turn,
            normal: crossing.normal * turn,
            ..crossing
        });
    }
    crossings
}

fn is_inside(steps: &[CsgStep<Solid<'_>>], point: DVec3) -> bool {
    let mut stack = vec![];
    for step in steps {
        if let CsgStep::Solid(solid) = step {
            stack.push(holds(solid, point));
            continue;
        }
        let (right, left) = (stack.pop().unwrap(), stack.pop().unwrap());
        stack.push(match step {
            CsgStep::Intersection => left && right,
            CsgStep::Difference => left && !right,
            _ => left || right,
        });
    }
    stack.pop().unwrap()
}

/// Whether a point is inside of a solid.
fn holds(solid: &Solid<'_>, point: DVec3) -> bool {
    match *solid {
        Solid::Sphere(ball) => point.distance(vector(ball.center)) < f64::from(ball.radius),
        Solid::Plane(plane) => (point - vector(plane.point)).dot(vector(plane.normal)) < 0.0,
        Solid::Cylinder(pillar) => {
            let radius = f64::from(pillar.radius);
            in_frustum(vector(pillar.base), radius, vector(pillar.top), radius, point)
        }
        Solid::Cone(cone) => {
            let (base, top) = (f64::from(cone.base_radius), f64::from(cone.top_radius));
            in_frustum(vector(cone.base), base, vector(cone.top), top, point)
        }
        Solid::Ellipsoid(shape) => {
            let [a, b, c] = shape.axes.map(vector);
            (DMat3::from_cols(a, b, c).inverse() * (point - vector(shape.center))).length() < 1.0
        }
        Solid::Quadric(quadric) => {
            let from_center = point - vector(quadric.center);
            let (min, max) = (vector(quadric.min), vector(quadric.max));
            let in_box = from_center.cmpgt(min).all() && from_center.cmplt(max).all();
            in_box && polynomial(&quadric, point).0 < 0.0
        }
        Solid::Cuboid(cuboid) => {
            let [a, b, c] = cuboid.axes.map(vector);
            let from_center = DMat3::from_cols(a, b, c).inverse() * (point - vector(cuboid.center));
            from_center.abs().max_element() < 1.0
        }
        Solid::ConvexPolyhedron(polyhedron) => polyhedron
            .planes
            .iter()
            .all(|plane| (point - vector(plane.point)).dot(vector(plane.normal)) < 0.0),
        Solid::Torus(torus) => from_circle(&torus, point).length() < f64::from(torus.minor_radius),
    }
}

fn in_frustum(base: DVec3, base_radius: f64, top: DVec3, top_radius: f64, point: DVec3) -> bool {
    let (axis, from_base) = (top - base, point - base);
    let share = from_base.dot(axis) / axis.length_squared();
    let radius = base_radius + (top_radius - base_radius) * share;
    (0.0..1.0).contains(&share) && (from_base - axis * share).length() < radius
}
