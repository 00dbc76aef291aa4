//! Lights with a size: objects that emit light.
//!
//! A point of the lamp is drawn for each ray toward it (Shirley, Wang and Zimmerman, "Monte Carlo Techniques
//! for Direct Lighting Calculations", ACM TOG 1996): in the cone that a ball fills, and on the area of flat
//! lamps.

use crate::color::LinearRgb;
use crate::fault::{Fault, check_direction};
use crate::material::Sides;
use crate::math::{Real, Scale, Vec3};
use crate::sampling::{around, centered, disc};
use crate::shape::Luminaire;

/// An object that lights the scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AreaLight<R: Real> {
    /// Position of the object in the scene.
    pub(crate) object: usize,
    /// Position of the light in the scene.
    pub(crate) light: usize,
    /// The light that its surface emits in each direction.
    pub(crate) radiance: LinearRgb<R>,
    pub(super) surface: LampSurface<R>,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum LampSurface<R: Real> {
    Ball {
        center: Vec3<R>,
        radius: R,
    },
    Flat {
        center: Vec3<R>,
        /// From the center to the middle of two sides, or to two points of the circle.
        halves: [Vec3<R>; 2],
        normal: Vec3<R>,
        /// The sides that shine.
        sides: Sides,
        is_round: bool,
        /// The radius of a disc with the same area.
        radius: R,
    },
}

/// A point of a lamp, as it is seen from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LampPoint<R> {
    /// The unit vector toward it.
    pub(crate) toward: Vec3<R>,
    /// Its distance, times [`FREE_SHARE`].
    pub(crate) distance: R,
    /// The product of this weight, the lamp's radiance and the cosine at the surface is the light of a white
    /// surface. The weight is the lamp's solid angle over π, computed from this point alone.
    pub(crate) weight: R,
}

/// Other objects can be in the way on this share of the way to a lamp. The lamp itself must not.
pub(super) const FREE_SHARE: f32 = 1.0 - 1.0 / 512.0;
/// In fixed point, flat lamps count as at least an eighth of their radius away: nearer, their weight would be
/// beyond its range.
const MOST_RADIUS_OVER_DISTANCE: f32 = 8.0;

impl<R: Real> AreaLight<R> {
    /// Converts the lamp. Its shape was checked with the object.
    pub(crate) fn new(
        luminaire: Luminaire,
        (object, light): (usize, usize),
        (radiance, sides): (LinearRgb<R>, Sides),
        scale: Scale,
    ) -> Result<Self, Fault> {
        let flat = |center: Vec3<R::Setup>, halves: [Vec3<R::Setup>; 2], is_round| {
            let [a, b] = halves;
            let normal = a.cross(b);
            // Half the sides of a rectangle span a quarter of its area.
            let area = normal.length()
                * R::Setup::from_f32(if is_round { 1.0 } else { 4.0 * core::f32::consts::FRAC_1_PI });
            Ok(LampSurface::Flat {
                center: scale.point(center),
                halves: halves.map(|half| scale.point(half)),
                normal: Vec3::from_setup(normal.normalized().ok_or(Fault::ZeroLength)?),
                sides,
                is_round,
                radius: scale.length(area.sqrt()),
            })
        };
        let surface = match luminaire {
            Luminaire::Ball { center, radius } => LampSurface::Ball {
                center: scale.point(center.to()),
                radius: scale.length(R::Setup::from_f32(radius)),
            },
            Luminaire::Disc { center, normal, radius } => {
                let (first, second) = check_direction::<R::Setup>(normal)?.around();
                let radius = R::Setup::from_f32(radius);
                flat(center.to(), [first * radius, second * radius], true)?
            }
            Luminaire::Rectangle { corner, right, up } => {
                let half = R::Setup::from_f32(0.5);
                let (right, up): (Vec3<R::Setup>, Vec3<R::Setup>) = (right.to() * half, up.to() * half);
                flat(corner.to() + right + up, [right, up], false)?
            }
        };
        Ok(Self { object, light, radiance, surface })
    }

    /// The middle of the lamp.
    #[cfg(feature = "looks")]
    pub(crate) fn center(&self) -> Vec3<R> {
        match self.surface {
            LampSurface::Ball { center, .. } | LampSurface::Flat { center, .. } => center,
        }
    }

    /// A point of the lamp that a pair of numbers draws; `None` if the lamp is not seen from there.
    pub(crate) fn point_seen_from(&self, point: Vec3<R>, pair: [u16; 2]) -> Option<LampPoint<R>> {
        match self.surface {
            LampSurface::Ball { center, radius } => in_cone(center - point, radius, pair),
            LampSurface::Flat { center, halves: [a, b], normal, sides, is_round, radius } => {
                let [x, y] = if is_round { disc(pair) } else { pair.map(centered) };
                on_flat(center + a * x + b * y - point, (normal, sides), radius)
            }
        }
    }

    /// The weight of the point of the lamp at which a ray from another point meets it, as
    /// [`point_seen_from`](Self::point_seen_from) would give it; `None` where that draws no point.
    #[cfg(feature = "path-tracing")]
    pub(crate) fn weight_between(&self, from: Vec3<R>, to: Vec3<R>) -> Option<R> {
        match self.surface {
            LampSurface::Ball { center, radius } => Some(in_cone(center - from, radius, [0; 2])?.weight),
            LampSurface::Flat { normal, sides, radius, .. } => {
                Some(on_flat(to - from, (normal, sides), radius)?.weight)
            }
        }
    }

    /// The solid angle of a flat lamp over π, computed from its middle alone; `None` from behind.
    pub(super) fn weight_of(&self, point: Vec3<R>) -> Option<R> {
        let LampSurface::Flat { center, normal, sides, radius, .. } = self.surface else { return None };
        Some(on_flat(center - point, (normal, sides), radius)?.weight)
    }
}

/// A point of a flat lamp that is this far away; `None` from a side that does not shine.
fn on_flat<R: Real>(way: Vec3<R>, (normal, sides): (Vec3<R>, Sides), radius: R) -> Option<LampPoint<R>> {
    let (toward, distance) = way.unit_and_length();
    if !(distance > R::ZERO) || (sides == Sides::Front && normal.dot(toward) > R::ZERO) {
        return None;
    }
    let mut ratio = radius / distance;
    if R::IS_FIXED_POINT {
        ratio = ratio.smaller(R::from_f32(MOST_RADIUS_OVER_DISTANCE));
    }
    let weight = ratio * ratio * normal.dot(toward).abs();
    Some(LampPoint { toward, distance: distance * R::from_f32(FREE_SHARE), weight })
}

/// The unit vector toward the center of a ball, its distance, and the sine of the ball's angular radius;
/// `None` from inside the ball.
pub(super) fn ball_seen<R: Real>(toward_center: Vec3<R>, radius: R) -> Option<(Vec3<R>, R, R)> {
    let (toward, distance) = toward_center.unit_and_length();
    (distance > radius).then(|| (toward, distance, radius / distance))
}

/// A direction in the cone that a ball fills; `None` from inside the ball.
fn in_cone<R: Real>(toward_center: Vec3<R>, radius: R, pair: [u16; 2]) -> Option<LampPoint<R>> {
    let (axis, distance, sine) = ball_seen(toward_center, radius)?;
    let sine_squared = sine * sine;
    let cosine_of_cone = (R::ONE - sine_squared).larger(R::ZERO).sqrt();
    // 1 minus the cosine, without a difference of nearly equal numbers.
    let depth_of_cone = sine_squared / (R::ONE + cosine_of_cone);
    let [x, y] = disc::<R>(pair);
    let share = (x * x + y * y).smaller(R::ONE);
    let depth = depth_of_cone * share;
    let across_squared = depth * (R::ONE + R::ONE - depth);
    let toward = around(axis, R::ONE - depth, across_squared, [x, y]);
    let inside = (sine_squared - across_squared).larger(R::ZERO).sqrt();
    let distance = distance * (R::ONE - depth - inside) * R::from_f32(FREE_SHARE);
    Some(LampPoint { toward, distance, weight: depth_of_cone + depth_of_cone })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    /// The light of a lamp on a level surface at the origin, with radiance 1.
    fn irradiance<R: Real>(luminaire: Luminaire) -> f64 {
        let lamp =
            AreaLight::<R>::new(luminaire, (0, 0), (LinearRgb::BLACK, Sides::Both), Scale::ONE).unwrap();
        let steps = 128u16;
        let (mut sum, mut count) = (0.0, 0.0);
        for pair in (0..steps).flat_map(|a| (0..steps).map(move |b| [a * 512 + 256, b * 512 + 256])) {
            count += 1.0;
            let Some(point) = lamp.point_seen_from(Vec3::ZERO, pair) else { continue };
            let cosine = f64::from(point.toward.z.to_f32()).max(0.0);
            sum += cosine * f64::from(point.weight.to_f32());
        }
        sum / count
    }

    fn assert_lamps_are_as_bright_as_they_should_be<R: Real>() {
        let up = Vec3::new(0.0, 0.0, 1.0);
        let near = |found: f64, expected: f64| {
            assert!((found / expected - 1.0).abs() < 2e-3, "{found}, not {expected}");
        };
        // A ball at the zenith gives π · sin² of its angular radius. A white surface shows this over π.
        for (distance, radius) in [(2.0f32, 0.5f32), (3.0, 2.9), (5.0, 0.1)] {
            let ball = Luminaire::Ball { center: up * distance, radius };
            near(irradiance::<R>(ball), f64::from(radius / distance).powi(2));
            let disc = Luminaire::Disc { center: up * distance, normal: up, radius };
            let squared = f64::from(radius).powi(2);
            near(irradiance::<R>(disc), squared / (squared + f64::from(distance).powi(2)));
        }
        // A ball aside: times the cosine of its center, as long as all of it is above the surface.
        let aside = Vec3::new(1.2, 0.0, 1.6);
        near(irradiance::<R>(Luminaire::Ball { center: aside, radius: 0.4 }), 0.04 * 0.8);
        // Lambert's formula for a polygon: the sum over its edges of the angle that the edge spans times the
        // cosine of the edge's plane, over 2π.
        let (corner, right, upward) =
            (Vec3::new(-0.5, 0.25, 1.0), Vec3::new(1.5, 0.0, 0.5), Vec3::new(0.0, 1.0, 0.25));
        let corners =
            [corner, corner + right, corner + right + upward, corner + upward].map(|c| c.to::<f64>());
        let mut sum = 0.0;
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let (a, b) = (a.normalized().unwrap(), b.normalized().unwrap());
            let edge = a.cross(b);
            sum += a.dot(b).acos() * edge.z / edge.length();
        }
        let rectangle = Luminaire::Rectangle { corner, right, up: upward };
        near(irradiance::<R>(rectangle), sum.abs() / core::f64::consts::TAU);
    }

    #[test]
    fn lamps_are_as_bright_as_closed_forms_say() {
        assert_lamps_are_as_bright_as_they_should_be::<f32>();
        assert_lamps_are_as_bright_as_they_should_be::<f64>();
        assert_lamps_are_as_bright_as_they_should_be::<Fixed>();
    }
}
