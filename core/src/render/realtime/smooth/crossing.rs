//! The place where an outline crosses the way between two rays.
//!
//! A ray passes a ball at the distance |c × d| - r, where c leads to the center, d is the ray's unit direction
//! and r is the radius. The distance is negative for rays that meet the ball, and nearly linear over a pixel:
//! its zero is where the outline lies. The edge of a ball's shadow is the same for the rays from the surface
//! toward the light.

use crate::light::Source;
use crate::math::{Ray, Real, Vec3};
use crate::prepared::{ObjectSet, PreparedScene};
use crate::shape::{Form, Geometry};

/// The share of the way from one ray to the next at which the outline of an object crosses; `None` if no
/// outline is known there. Of several balls the nearest counts, and planes after balls.
pub(super) fn of_outline<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    among: ObjectSet,
    rays: [Ray<R>; 2],
) -> Option<R> {
    let mut nearest = R::FARTHEST;
    let mut found = None;
    for object in among {
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

/// The share of the way from one camera ray to the next at which the edge of a ball's shadow crosses, on the
/// nearest flat object; `None` if none is known there.
pub(super) fn of_shadow<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    among: ObjectSet,
    rays: [Ray<R>; 2],
) -> Option<R> {
    let points = floor(scene, among, rays)?;
    for light in scene.lights {
        let [Some((first, most)), Some((second, _))] = points.map(|point| toward(&light.source, point))
        else {
            continue;
        };
        for object in scene.all() {
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

/// The points at which two rays meet the nearest flat object.
fn floor<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    among: ObjectSet,
    rays: [Ray<R>; 2],
) -> Option<[Vec3<R>; 2]> {
    let mut nearest = R::FARTHEST;
    let mut points = None;
    for object in among {
        let Some(Form::Flat { normal, distance }) = scene.form(object) else { continue };
        let [first, second] = rays.map(|ray| (distance - normal.dot(ray.origin)) / normal.dot(ray.direction));
        if first > R::ZERO && first < nearest && second > R::ZERO && second < R::FARTHEST {
            nearest = first;
            let [from, to] = rays;
            points = Some([from.at(first), to.at(second)]);
        }
    }
    points
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
        // A ball of radius 1 at distance 4 is seen up to the sine 1/4, so up to x = 4 · tan.
        let center = Vec3::new(0.0, 0.0, -4.0).to();
        let edge = 4.0 / 15f64.sqrt();
        let (inside, outside) = (edge - 0.004, edge + 0.006);
        let passed = [inside, outside].map(|x| passed(&ray(x as f32), center, R::ONE).unwrap().0);
        assert!((number(passed[0]) + 0.004 * 0.936_492).abs() < 2e-5, "{passed:?}");
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
