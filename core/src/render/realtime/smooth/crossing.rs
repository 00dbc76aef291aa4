//! The place where an outline crosses the way between two rays.
//!
//! A ray passes a ball at the distance |c × d| - r, where c leads to the center, d is the ray's unit
//! direction and r is the radius. The distance is negative for rays that meet the ball, and nearly linear
//! over a pixel: its zero is where the outline lies. The edge of a ball's shadow is the same for the rays
//! from the surface toward the light.
//!
//! Between two cells of a texture on a flat object, the edge is found by bisection along the surface, which
//! takes no ray.
//!
//! One ray through the middle of a cell finds the outlines that may cross the cell at all: few, as a rule.

use crate::light::Source;
use crate::math::{Ray, Real, Vec3};
use crate::prepared::{ObjectSet, PreparedScene};
use crate::shape::{Form, Geometry};
use crate::surface::Surface;

/// A flat object.
#[derive(Clone, Copy, Debug)]
struct Flat<R> {
    object: usize,
    /// The unit normal of its plane, and the distance of the plane from the origin along the normal.
    plane: (Vec3<R>, R),
}

/// The shadows whose edges may cross a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadowsNear<R> {
    /// The plane of the nearest flat object.
    plane: (Vec3<R>, R),
    /// The balls that throw the shadows.
    balls: ObjectSet,
}

/// The objects among these whose outlines may cross a cell: flat ones, and balls that the ray through the
/// middle of the cell passes within an angle.
pub(super) fn outlines_near<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    among: ObjectSet,
    ray: &Ray<R>,
    angle: R,
) -> ObjectSet {
    among
        .filter(|object| match scene.form(*object) {
            Some(Form::Ball { center, radius }) => {
                passed(ray, center, radius).is_some_and(|(beside, along)| beside.abs() < along * angle)
            }
            Some(Form::Flat { .. }) => true,
            _ => false,
        })
        .fold(ObjectSet::NONE, ObjectSet::with)
}

/// The shadows on the nearest flat object among these whose edges may cross a cell: of balls that a ray from
/// there toward a light passes within the size of the cell. `None` if no flat object is seen.
pub(super) fn shadows_near<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    among: ObjectSet,
    ray: &Ray<R>,
    angle: R,
) -> Option<ShadowsNear<R>> {
    let (Flat { plane, .. }, distance) = floor(scene, among, ray)?;
    let (point, size) = (ray.at(distance), distance * angle / plane.0.dot(ray.direction).abs());
    let mut balls = ObjectSet::NONE;
    for (toward, _) in scene.lights.iter().filter_map(|light| toward(&light.source, point)) {
        for object in scene.all() {
            if let Some(Form::Ball { center, radius }) = scene.form(object)
                && passed(&toward, center, radius).is_some_and(|(beside, _)| beside.abs() < size)
            {
                balls = balls.with(object);
            }
        }
    }
    Some(ShadowsNear { plane, balls })
}

/// The share of the way from one ray to the next at which the outline of an object crosses; `None` if no
/// outline is known there. Of several balls the nearest counts, and planes after balls.
pub(super) fn of_outline<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    near: ObjectSet,
    rays: [Ray<R>; 2],
) -> Option<R> {
    let mut nearest = R::FARTHEST;
    let mut found = None;
    for object in near {
        match scene.form(object) {
            Some(Form::Ball { center, radius }) => {
                let passed = rays.map(|ray| passed(&ray, center, radius));
                if let [Some((distance, along)), Some((other, _))] = passed
                    && along < nearest
                    && let Some(place) = zero(distance, other)
                {
                    (nearest, found) = (along, Some(place));
                }
            }
            // The horizon.
            Some(Form::Flat { normal, .. }) if found.is_none() => {
                let [slant, other] = rays.map(|ray| normal.dot(ray.direction));
                found = zero(slant, other);
            }
            _ => {}
        }
    }
    found
}

/// The share of the way from one camera ray to the next at which the edge of a shadow crosses; `None` if none
/// is known there.
pub(super) fn of_shadow<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    near: &ShadowsNear<R>,
    rays: [Ray<R>; 2],
) -> Option<R> {
    if near.balls.is_empty() {
        return None;
    }
    let [from, to] = rays.map(|ray| Some(ray.at(distance(&ray, near.plane)?)));
    let points = [from?, to?];
    for light in scene.lights {
        let [Some((first, most)), Some((second, _))] = points.map(|point| toward(&light.source, point))
        else {
            continue;
        };
        for object in near.balls {
            let Some(Form::Ball { center, radius }) = scene.form(object) else { continue };
            let passed = [first, second].map(|ray| passed(&ray, center, radius));
            if let [Some((distance, along)), Some((other, _))] = passed
                && along < most
                && let Some(place) = zero(distance, other)
            {
                return Some(place);
            }
        }
    }
    None
}

/// How often the way between two points of a texture is halved.
const HALVINGS: u32 = 5;

/// The share of the way from one camera ray to the next at which the edge between two cells of a texture
/// crosses, on the nearest flat object; `None` if something else may be nearer, or both rays meet the same
/// cell.
pub(super) fn of_texture<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    among: ObjectSet,
    rays: [Ray<R>; 2],
) -> Option<R> {
    let (Flat { object, plane }, nearest) = floor(scene, among, &rays[0])?;
    let is_hidden = among.into_iter().any(|object| match scene.form(object) {
        Some(Form::Ball { center, radius }) => passed(&rays[0], center, radius)
            .is_some_and(|(beside, along)| beside < R::ZERO && along < nearest),
        Some(Form::Flat { .. }) => false,
        _ => true,
    });
    let texture = &scene.material(object).filter(|_| !is_hidden)?.color;
    let cell = |point| {
        let (normal, _) = plane;
        let surface = Surface { point, normal, shading_normal: normal, magnitude: R::ZERO, part: 0 };
        texture.step(&surface, || scene.uv(object, &surface))
    };
    let [from, to] = rays.map(|ray| Some(ray.at(distance(&ray, plane)?)));
    let (mut from, mut to) = (from?, to?);
    let here = cell(from)?;
    if cell(to)? == here {
        return None;
    }
    let half = R::from_fraction(1 << 15);
    let (mut place, mut step) = (R::ZERO, R::ONE);
    for _ in 0..HALVINGS {
        step = step * half;
        let middle = from + (to - from) * half;
        if cell(middle) == Some(here) {
            (from, place) = (middle, place + step);
        } else {
            to = middle;
        }
    }
    Some(place + step * half)
}

/// The nearest flat object that a ray meets, or would meet if the object had no end, and its distance.
fn floor<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    among: ObjectSet,
    ray: &Ray<R>,
) -> Option<(Flat<R>, R)> {
    let mut nearest = R::FARTHEST;
    let mut found = None;
    for object in among {
        if let Some(Form::Flat { normal, distance: height }) = scene.form(object)
            && let plane = (normal, height)
            && let Some(distance) = distance(ray, plane)
            && distance < nearest
        {
            (nearest, found) = (distance, Some((Flat { object, plane }, distance)));
        }
    }
    found
}

/// The distance at which a ray meets a plane.
fn distance<R: Real>(ray: &Ray<R>, (normal, height): (Vec3<R>, R)) -> Option<R> {
    let distance = (height - normal.dot(ray.origin)) / normal.dot(ray.direction);
    (distance > R::ZERO && distance < R::FARTHEST).then_some(distance)
}

/// The ray from a point toward a light, and the light's distance; `None` at the light and for lights beyond
/// the range of the number system.
fn toward<R: Real>(light: &Source<R>, point: Vec3<R>) -> Option<(Ray<R>, R)> {
    match *light {
        Source::At(position) => {
            let (direction, distance) = (position - point).unit_and_length();
            (distance > R::ZERO).then_some((Ray { origin: point, direction }, distance))
        }
        Source::Toward(direction) => Some((Ray { origin: point, direction }, R::FARTHEST)),
        Source::Far(..) => None,
    }
}

/// The distance at which a ray passes a ball, and how far along the ray; `None` if the ball lies behind.
fn passed<R: Real>(ray: &Ray<R>, center: Vec3<R>, radius: R) -> Option<(R, R)> {
    let way = center - ray.origin;
    let along = way.dot(ray.direction);
    (along > R::ZERO).then(|| (way.cross(ray.direction).length() - radius, along))
}

/// The zero of a linear function with these values at 0 and 1, if it lies in between.
fn zero<R: Real>(at_0: R, at_1: R) -> Option<R> {
    ((at_0 > R::ZERO) != (at_1 > R::ZERO)).then(|| at_0 / (at_0 - at_1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    fn assert_passes<R: Real>() {
        let number = |number: R| f64::from(number.to_f32());
        let ray = |x: f32| {
            let direction: Vec3<R> = Vec3::new(x, 0.0, -4.0).to().normalized().unwrap();
            Ray { origin: Vec3::ZERO, direction }
        };
        // A ball of radius 1 at distance 4 is seen up to the sine 1/4, so up to x = 4 · tan. There the
        // distance, 4 sin θ - 1, grows by cos³θ from one x to the next.
        let center = Vec3::new(0.0, 0.0, -4.0).to();
        let edge = 4.0 / 15f64.sqrt();
        let (inside, outside) = (edge - 0.004, edge + 0.006);
        let passed = [inside, outside].map(|x| passed(&ray(x as f32), center, R::ONE).unwrap().0);
        assert!((number(passed[0]) + 0.004 * 0.907_73).abs() < 2e-5, "{passed:?}");
        let place = number(zero(passed[0], passed[1]).unwrap());
        assert!((place - 0.4).abs() < 2e-3, "{place}");
        assert_eq!(zero(passed[1], passed[1]), None);
        let behind = Vec3::new(0.0, 0.0, 4.0).to();
        assert!(super::passed(&ray(0.0), behind, R::ONE).is_none());
    }

    #[test]
    fn outlines_cross_where_balls_end() {
        assert_passes::<f32>();
        assert_passes::<f64>();
        assert_passes::<Fixed>();
    }
}
