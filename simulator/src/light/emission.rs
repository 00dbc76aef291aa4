//! The rays on which photons leave the lamps, aimed at the mirrors and the glass of a scene.
//!
//! Light is counted as in the rest of the program: a surface that faces a lamp without falloff, or that sees
//! nothing but a lamp with a size, receives the lamp's color. So flux is in units of color times area.

use core::f64::consts::PI;

use rayline::math::Ray;
use rayline::shape::{Geometry, Luminaire, Shape};
use rayline::{Falloff, Lamp as PointLamp, Light as Lamp, LightCone, PreparedScene, Scene, Sides};

use super::{Light, Vector, vector};

/// The rays by which the flux from a lamp to an object is estimated.
const ESTIMATES: usize = 256;

/// Where photons begin.
#[derive(Clone, Copy, Debug)]
enum Source {
    Point {
        position: Vector,
        falloff: Falloff,
        cone: Option<LightCone>,
    },
    Sun {
        direction: Vector,
    },
    /// A surface that emits light.
    Surface {
        luminaire: Luminaire,
        sides: Sides,
    },
    /// The background.
    Sky,
}

/// A ball around an object at which photons are aimed. Its radius is infinite for objects without end.
#[derive(Clone, Copy, Debug)]
struct Target {
    object: usize,
    center: Vector,
    radius: f64,
    /// The share of light that the object sends on, about.
    share: f64,
}

/// The photons from one lamp to one object.
#[derive(Clone, Debug)]
pub(super) struct Beam {
    source: Source,
    color: Light,
    target: Target,
    pub(super) photons: usize,
    /// The radius of a ball around all objects with an end.
    reach: f64,
}

/// A photon that leaves a lamp.
#[derive(Clone, Copy, Debug)]
pub(super) struct Departure {
    pub(super) ray: Ray<f64>,
    /// The flux of the whole beam if all photons were alike, for a lamp whose light fades as in nature.
    flux: Light,
    /// For point lamps: the share of light over distance, which is not always that of nature.
    falloff: Option<Falloff>,
}

impl Departure {
    /// The flux of the whole beam if all photons were alike and met their object at this distance.
    pub(super) fn flux(&self, distance: f64) -> Light {
        let Some(Falloff { constant, linear, quadratic }) = self.falloff else { return self.flux };
        let sum = f64::from(constant) + distance * (f64::from(linear) + distance * f64::from(quadratic));
        let share = if sum > 1.0 { 1.0 / sum } else { 1.0 };
        scaled(self.flux, share * distance * distance)
    }
}

/// The beams from all lamps to all objects that mirror or refract light and that `is_aimed_at`, with so many
/// photons in all. `sky` is the light of the background in a direction.
pub(super) fn beams(
    scene: &Scene<'_>,
    prepared: &PreparedScene<'_, f64>,
    photons: usize,
    is_aimed_at: &dyn Fn(usize) -> bool,
    sky: &dyn Fn(Vector) -> Light,
) -> Vec<Beam> {
    let (targets, reach) = targets(scene, prepared);
    let targets = targets.into_iter().filter(|target| is_aimed_at(target.object));
    let targets: Vec<_> = targets.filter(|target| target.share > 0.0).collect();
    let sources: Vec<_> = scene.lights.iter().filter_map(|lamp| source(scene, lamp)).collect();
    let pairs = sources.iter().flat_map(|source| targets.iter().map(move |target| (source, target)));
    let beams = pairs.map(|((source, color), target)| {
        let (source, color, target) = (*source, *color, *target);
        let beam = Beam { source, color, target, photons: 0, reach };
        (beam.estimate(sky) * target.share, beam)
    });
    let beams: Vec<_> = beams.filter(|(flux, _)| *flux > 0.0).collect();
    let all: f64 = beams.iter().map(|(flux, _)| flux).sum();
    let counted = |(flux, beam): (f64, Beam)| {
        let share = (photons as f64 * flux / all).ceil();
        Beam { photons: share as usize, ..beam }
    };
    beams.into_iter().map(counted).collect()
}

/// A ball around each object that mirrors or refracts light, and the radius of one around all.
fn targets(scene: &Scene<'_>, prepared: &PreparedScene<'_, f64>) -> (Vec<Target>, f64) {
    let boxes: Vec<_> = (0..scene.objects.len()).map(|object| prepared.bounds(object)).collect();
    let all = boxes.iter().flatten().copied().reduce(|all, next| all.union(next));
    let middle = all.map_or(Vector::ZERO, |all| all.center());
    let reach = all.map_or(1.0, |all| (all.max - all.min).length() * 0.5).max(1e-3);
    let targets = scene.objects.iter().zip(&boxes).enumerate().map(|(object, (shape, bounds))| {
        let (center, radius) = match (&shape.shape, bounds) {
            (Shape::Sphere(ball), _) => (vector(ball.center), f64::from(ball.radius)),
            (_, Some(bounds)) => (bounds.center(), (bounds.max - bounds.min).length() * 0.5),
            (_, None) => (middle, f64::INFINITY),
        };
        let material = scene.material_of(shape);
        let share = material.map_or(0.0, |material| material.reflectance + material.transmittance);
        Target { object, center, radius, share: f64::from(share) }
    });
    (targets.collect(), reach)
}

/// The source of photons that a lamp is, and its color; `None` for ambient light.
fn source(scene: &Scene<'_>, lamp: &Lamp) -> Option<(Source, Light)> {
    let source = match *lamp {
        Lamp::Point { position, color } => {
            (Source::Point { position: vector(position), falloff: Falloff::NONE, cone: None }, color.to())
        }
        Lamp::Lamp(PointLamp { position, color, falloff, cone }) => {
            (Source::Point { position: vector(position), falloff, cone }, color.to())
        }
        Lamp::Directional { direction, color } => {
            (Source::Sun { direction: vector(direction).normalized()? }, color.to())
        }
        Lamp::Object(id) => {
            let object = scene.objects.get(usize::from(id.0))?;
            let optics = scene.material_of(object)?.optics?;
            let luminaire = object.shape.luminaire()?;
            (Source::Surface { luminaire, sides: optics.emission_sides }, optics.emission.to())
        }
        Lamp::Sky => (Source::Sky, Light::new(1.0, 1.0, 1.0)),
        _ => return None,
    };
    Some(source)
}

impl Beam {
    /// The object at which the photons are aimed.
    pub(super) fn object(&self) -> usize {
        self.target.object
    }

    /// The mean flux of rays to the middle of the object.
    fn estimate(&self, sky: &dyn Fn(Vector) -> Light) -> f64 {
        let sum: f64 = (0..ESTIMATES)
            .filter_map(|index| self.departure(index, 0.0, sky))
            .map(|departure| {
                let distance = (self.target.center - departure.ray.origin).length();
                let Light { r, g, b } = departure.flux(distance.min(self.reach * 2.0));
                r + g + b
            })
            .sum();
        sum / ESTIMATES as f64
    }

    /// The photon of this number, which begins this far before its lamp; `None` if the lamp sends no light on
    /// that way.
    pub(super) fn departure(
        &self,
        index: usize,
        before: f64,
        sky: &dyn Fn(Vector) -> Light,
    ) -> Option<Departure> {
        let numbers = [2, 3, 5, 7].map(|base| radical_inverse(base, index as u64 + 1));
        let [x, y, ..] = numbers;
        let (ray, factor, falloff) = match self.source {
            Source::Point { position, falloff, cone } => {
                let (direction, solid_angle) = self.toward_target(position, [x, y]);
                let share = cone.map_or(1.0, |cone| share_in_cone(&cone, direction));
                (Ray { origin: position, direction }, share * solid_angle, Some(falloff))
            }
            Source::Sun { direction } => {
                let (origin, area) = self.disc_before_target(direction, [x, y]);
                (Ray { origin, direction }, area, None)
            }
            Source::Surface { luminaire, sides } => {
                let (point, normal, area) = place_on(&luminaire, numbers)?;
                let (direction, solid_angle) = self.toward_target(point, [x, y]);
                let cosine = normal.dot(direction);
                let is_two_sided = sides == Sides::Both && !matches!(luminaire, Luminaire::Ball { .. });
                let cosine = if is_two_sided { cosine.abs() } else { cosine };
                let ray = Ray { origin: point + direction * before, direction };
                (ray, cosine * area * solid_angle / PI, None)
            }
            Source::Sky => {
                let [.., u, v] = numbers;
                let direction = on_sphere([u, v]);
                let (origin, area) = self.disc_before_target(direction, [x, y]);
                let flux = scaled(sky(-direction), area * 4.0);
                return Some(Departure { ray: Ray { origin, direction }, flux, falloff: None });
            }
        };
        let flux = scaled(self.color, factor);
        (factor > 0.0).then_some(Departure { ray, flux, falloff })
    }

    /// A direction from a point into the cone that the target fills, and its solid angle.
    fn toward_target(&self, point: Vector, [x, y]: [f64; 2]) -> (Vector, f64) {
        let (axis, distance) = (self.target.center - point).unit_and_length();
        let sine = self.target.radius / distance;
        if !(sine < 1.0) {
            return (on_sphere([x, y]), 4.0 * PI);
        }
        // 1 - cos, without the difference of two numbers that are nearly alike.
        let height = sine * sine / (1.0 + (1.0 - sine * sine).sqrt());
        let cosine = 1.0 - x * height;
        (around(axis, cosine, y), 2.0 * PI * height)
    }

    /// A place far before the target on parallel rays of this direction, and the area of their beam.
    fn disc_before_target(&self, direction: Vector, [x, y]: [f64; 2]) -> (Vector, f64) {
        // Of an object without end, the part around all others.
        let radius = self.target.radius.min(self.reach * 3.0);
        let (first, second) = direction.around();
        let (across, angle) = (radius * x.sqrt(), 2.0 * PI * y);
        let place = first * (across * angle.cos()) + second * (across * angle.sin());
        (self.target.center + place - direction * (self.reach * 100.0), PI * radius * radius)
    }
}

/// A place on a lamp, its normal, and the lamp's area; `None` if the lamp has none.
fn place_on(luminaire: &Luminaire, [.., u, v]: [f64; 4]) -> Option<(Vector, Vector, f64)> {
    Some(match luminaire {
        Luminaire::Ball { center, radius } => {
            let (normal, radius) = (on_sphere([u, v]), f64::from(*radius));
            (vector(*center) + normal * radius, normal, 4.0 * PI * radius * radius)
        }
        Luminaire::Disc { center, normal, radius } => {
            let (normal, radius) = (vector(*normal).normalized()?, f64::from(*radius));
            let (first, second) = normal.around();
            let (across, angle) = (radius * u.sqrt(), 2.0 * PI * v);
            let place = first * (across * angle.cos()) + second * (across * angle.sin());
            (vector(*center) + place, normal, PI * radius * radius)
        }
        Luminaire::Rectangle { corner, right, up } => {
            let (right, up) = (vector(*right), vector(*up));
            let (normal, area) = right.cross(up).unit_and_length();
            (vector(*corner) + right * u + up * v, normal, area)
        }
        _ => return None,
    })
}

/// The share of its light that a lamp with a cone sends in a direction: as in the core.
fn share_in_cone(cone: &LightCone, direction: Vector) -> f64 {
    let Some(axis) = vector(cone.direction).normalized() else { return 0.0 };
    let (bright, dark) = (f64::from(cone.bright).cos(), f64::from(cone.dark).cos());
    let past = axis.dot(direction) - dark;
    if !(past > 0.0) {
        return 0.0;
    }
    let x = if bright > dark { (past / (bright - dark)).min(1.0) } else { 1.0 };
    x * x * (3.0 - 2.0 * x)
}

/// A unit vector, spread evenly.
fn on_sphere([x, y]: [f64; 2]) -> Vector {
    around(Vector::new(0.0, 1.0, 0.0), 1.0 - 2.0 * x, y)
}

/// The unit vector at this cosine to an axis, after a share of a turn around it.
fn around(axis: Vector, cosine: f64, turn: f64) -> Vector {
    let (first, second) = axis.around();
    let (sine, angle) = ((1.0 - cosine * cosine).max(0.0).sqrt(), 2.0 * PI * turn);
    axis * cosine + first * (sine * angle.cos()) + second * (sine * angle.sin())
}

/// The digits of a number behind the point, in reversed order: a coordinate of Halton's sequence ("On the
/// Efficiency of Certain Quasi-random Sequences of Points", Numerische Mathematik 1960).
fn radical_inverse(base: u64, mut number: u64) -> f64 {
    let (step, mut place, mut sum) = (1.0 / base as f64, 1.0, 0.0);
    while number > 0 {
        place *= step;
        sum += (number % base) as f64 * place;
        number /= base;
    }
    sum
}

/// Light times a number that may be above 1.
pub(super) fn scaled(Light { r, g, b }: Light, by: f64) -> Light {
    Light::new(r * by, g * by, b * by)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Halton's table of 1960: halves, quarters and eighths; thirds and ninths.
    #[test]
    fn the_sequence_is_that_of_halton() {
        let halves = [1, 2, 3, 4, 5].map(|number| radical_inverse(2, number));
        assert_eq!(halves, [0.5, 0.25, 0.75, 0.125, 0.625]);
        let thirds = [1, 2, 3, 4].map(|number| radical_inverse(3, number) * 9.0);
        assert!(thirds.iter().zip([3.0, 6.0, 1.0, 4.0]).all(|(a, b)| (a - b).abs() < 1e-12), "{thirds:?}");
    }

    /// The mean flux over all photons of a beam.
    fn flux(source: Source, target: (Vector, f64)) -> f64 {
        let target = Target { object: 0, center: target.0, radius: target.1, share: 1.0 };
        let color = Light::new(2.0, 0.0, 0.0);
        let beam = Beam { source, color, target, photons: 0, reach: 1.0 };
        let sky = |_: Vector| Light::new(2.0, 0.0, 0.0);
        let photons = 4096;
        let all = (0..photons).filter_map(|index| beam.departure(index, 0.0, &sky));
        all.map(|departure| departure.flux(target.center.length()).r).sum::<f64>() / f64::from(photons as u32)
    }

    /// A small ball of radius r receives the light at its place times π r².
    #[test]
    fn beams_carry_the_light_that_lamps_send() {
        let (center, radius) = (Vector::new(0.0, 0.0, 5.0), 0.05);
        let area = PI * radius * radius;
        let near = |source, light: f64| {
            let share = flux(source, (center, radius)) / (area * light);
            assert!((share - 1.0).abs() < 2e-3, "{source:?}: {share}");
        };
        near(Source::Sun { direction: Vector::new(0.0, 0.6, 0.8) }, 2.0);
        near(Source::Sky, 2.0 * 4.0);
        let position = Vector::ZERO;
        near(Source::Point { position, falloff: Falloff::NONE, cone: None }, 2.0);
        near(Source::Point { position, falloff: Falloff::inverse_square(2.5), cone: None }, 0.5);
        let direction = rayline::Vec3::new(0.0, 3f32.sqrt(), 1.0);
        // Halfway between both cosines, the smooth step is a half.
        let cone = LightCone { direction, bright: 0.75f32.acos(), dark: 0.25f32.acos() };
        near(Source::Point { position, falloff: Falloff::NONE, cone: Some(cone) }, 1.0);
        let v = rayline::Vec3::new;
        let rectangle = Luminaire::Rectangle {
            corner: v(-0.05, -0.1, 0.0),
            right: v(0.1, 0.0, 0.0),
            up: v(0.0, 0.2, 0.0),
        };
        near(Source::Surface { luminaire: rectangle, sides: Sides::Front }, 2.0 * 0.02 / (PI * 25.0));
        let disc = Luminaire::Disc { center: v(0.0, 0.0, 0.0), normal: v(0.0, 0.0, -2.0), radius: 0.1 };
        near(Source::Surface { luminaire: disc, sides: Sides::Both }, 2.0 * 0.01 / 25.0);
        assert_eq!(flux(Source::Surface { luminaire: disc, sides: Sides::Front }, (center, radius)), 0.0);
        // A ball is as bright as a disc of its radius, which its cone holds.
        let ball = Luminaire::Ball { center: v(0.0, 0.0, 0.0), radius: 0.1 };
        near(Source::Surface { luminaire: ball, sides: Sides::Both }, 2.0 * 0.01 / 25.0);
    }
}
