//! The light of lamps with a size in closed form: no noise, and one ray at most.
//!
//! - A ball of angular radius α whose middle stands at the angle θ from the normal gives sin²α · cos θ of the
//!   light of a full sky. Where the horizon cuts the ball, `(cos θ + sin α)² / 4 sin α` replaces cos θ, with
//!   an error below sin α / 20.
//! - A rectangle gives Lambert's sum over its edges, after the horizon cut it (Baum, Rushmeier and Winget,
//!   "Improving Radiosity Solutions Through the Use of Analytically Determined Form-Factors", SIGGRAPH 1989).
//!   A disc is a polygon of 16 edges and the same area.
//! - A ball in the way leaves the share of the lamp's cap that its own cap does not cover (Oat and Sander,
//!   "Ambient Aperture Lighting", I3D 2007). The overlap is that of two discs in the plane whose radii and
//!   distance are the angles; Oat and Sander take a smooth step, which is off by up to 0.11. Several balls
//!   leave the product of their shares: the error is the light that two of them cover twice.

use super::area::{AreaLight, FREE_SHARE, LampSurface, ball_seen};
use crate::math::{Real, Vec3};

/// A lamp as a surface sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SeenLamp<R> {
    /// The part of the sky that it fills.
    pub(crate) cap: Cap<R>,
    /// The unit vector toward the middle of the part above the horizon, and the distance up to which other
    /// objects are in the way.
    pub(crate) toward: Vec3<R>,
    pub(crate) distance: R,
    /// The solid angle over π.
    pub(crate) weight: R,
    /// The mean cosine over the lamp, with 0 below the horizon: its product with the weight and the lamp's
    /// radiance is the light of a white surface.
    pub(crate) cosine: R,
}

impl<R: Real> SeenLamp<R> {
    /// The lamp with all directions turned.
    pub(crate) fn turned(self, turn: impl Fn(Vec3<R>) -> Vec3<R>) -> Self {
        let cap = Cap { toward: turn(self.cap.toward), ..self.cap };
        Self { cap, toward: turn(self.toward), ..self }
    }
}

/// A round part of the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cap<R> {
    /// The unit vector toward its middle.
    pub(crate) toward: Vec3<R>,
    /// The distance of what fills it.
    pub(crate) distance: R,
    /// The angle from the middle to the edge, in turns.
    radius: R,
}

/// The radius of a regular polygon of 16 corners with the area of a disc of radius 1.
const RADIUS_OF_POLYGON: f32 = 1.013_011_2;
/// Cosine and sine of a sixteenth of a turn.
const SIXTEENTH: [f32; 2] = [0.923_879_5, 0.382_683_43];
const CORNERS_OF_DISC: usize = 16;

impl<R: Real> AreaLight<R> {
    /// The lamp as a surface at `point` with this normal sees it; `None` if the whole lamp is below the
    /// horizon, or if the point is inside.
    pub(crate) fn seen_from(&self, point: Vec3<R>, normal: Vec3<R>) -> Option<SeenLamp<R>> {
        match self.surface {
            LampSurface::Ball { center, radius } => {
                let cap = Cap::of_ball(center - point, radius)?;
                let sine = radius / cap.distance;
                let whole = R::ONE + (R::ONE - sine * sine).larger(R::ZERO).sqrt();
                let up = normal.dot(cap.toward);
                let cosine = over_horizon(up, sine)? * whole * R::from_f32(0.5);
                let weight = (sine + sine) * (sine / whole);
                let height = up * cap.distance;
                let (toward, distance) = aim(center - point, normal, (height, radius));
                let distance = (distance - radius).larger(R::ZERO) * R::from_f32(FREE_SHARE);
                Some(SeenLamp { cap, toward, distance, weight, cosine })
            }
            LampSurface::Flat { center, halves: [a, b], normal: face, is_round, radius, .. } => {
                let way = center - point;
                let weight = self.weight_of(point)?;
                let light = if is_round {
                    let size = R::from_f32(RADIUS_OF_POLYGON);
                    let (a, b) = (a * size, b * size);
                    let [cosine, sine] = SIXTEENTH.map(R::from_f32);
                    let (mut x, mut y) = (R::ONE, R::ZERO);
                    let corners = [(); CORNERS_OF_DISC].map(|()| {
                        let corner = way + a * x + b * y;
                        (x, y) = (x * cosine - y * sine, x * sine + y * cosine);
                        corner
                    });
                    light_of_polygon(normal, &corners)
                } else {
                    light_of_polygon(normal, &[way - a - b, way + a - b, way + a + b, way - a + b])
                };
                if !(light > R::ZERO) {
                    return None;
                }
                let (middle, away) = way.unit_and_length();
                // Far away, both are small, and the cosine is that of the middle.
                let is_large = weight > R::from_f32(1.0 / 4096.0);
                let cosine = if is_large { light / weight } else { normal.dot(middle).larger(R::ZERO) };
                let share = light.smaller(R::ONE);
                // A ball at the zenith with this light has this radius; so has about the lamp.
                let share = share.larger((weight * face.dot(middle).abs()).smaller(R::ONE));
                let cap = Cap {
                    toward: middle,
                    distance: away,
                    radius: R::turn(share.sqrt(), (R::ONE - share).larger(R::ZERO).sqrt()),
                };
                let (toward, distance) = aim(way, normal, (normal.dot(way), radius));
                let distance = distance * R::from_f32(FREE_SHARE);
                Some(SeenLamp { cap, toward, distance, weight, cosine })
            }
        }
    }
}

/// The mean cosine of a ball whose middle has the cosine `up` and whose angular radius has this sine, over
/// the mean cosine of a ball at the zenith; `None` if the whole ball is below the horizon.
fn over_horizon<R: Real>(up: R, sine: R) -> Option<R> {
    if !(up + sine > R::ZERO) {
        return None;
    }
    Some(if up < sine { (up + sine) * ((up + sine) / (sine * R::from_u16(4))) } else { up })
}

/// The light of a ball of radiance 1 on a white surface at the origin, at most 1.
pub(crate) fn light_of_ball<R: Real>(way: Vec3<R>, radius: R, normal: Vec3<R>) -> R {
    let Some((toward, _, sine)) = ball_seen(way, radius) else { return R::ONE };
    over_horizon(normal.dot(toward), sine).map_or(R::ZERO, |cosine| (cosine * sine * sine).smaller(R::ONE))
}

/// The direction and the distance of the middle of that part of a lamp that is above the horizon. The middle
/// of the whole lamp is this high above the horizon, and the lamp has this radius.
fn aim<R: Real>(way: Vec3<R>, normal: Vec3<R>, (height, radius): (R, R)) -> (Vec3<R>, R) {
    let aim = if height < radius { way + normal * ((radius - height) * R::from_f32(0.5)) } else { way };
    aim.unit_and_length()
}

impl<R: Real> Cap<R> {
    /// The part of the sky that a ball fills, whose center is this far; `None` from inside.
    pub(crate) fn of_ball(way: Vec3<R>, radius: R) -> Option<Self> {
        let (toward, distance, sine) = ball_seen(way, radius)?;
        let cosine = (R::ONE - sine * sine).larger(R::ZERO).sqrt();
        Some(Self { toward, distance, radius: R::turn(sine, cosine) })
    }

    /// The share of the cap that another one covers.
    pub(crate) fn covered_by(&self, other: &Self) -> R {
        let sine = self.toward.cross(other.toward).length();
        let apart = R::turn(sine, self.toward.dot(other.toward));
        overlap(self.radius, other.radius, apart)
    }
}

/// In place of larger ratios of two radii, between which the overlap hardly differs.
const LARGEST_RATIO: u16 = 32;

/// The share of a disc of radius `a` that a disc of radius `b` at this distance covers.
fn overlap<R: Real>(a: R, b: R, distance: R) -> R {
    if distance >= a + b {
        return R::ZERO;
    }
    if distance + a <= b {
        return R::ONE;
    }
    if distance + b <= a {
        let ratio = b / a;
        return ratio * ratio;
    }
    // In units of the first radius. The other disc reaches over the middle of the first by -near.
    let near = (distance - b) / a;
    let most = R::from_u16(LARGEST_RATIO);
    let b = if b < a * most { b / a } else { most };
    let (distance, least) = (near + b, R::from_f32(1.0 / 32.0));
    if distance < least || b < least {
        return (b * b).smaller(R::ONE);
    }
    // The line through the two points where the circles meet cuts a segment off each.
    let cosine = (near * ((distance + b) / distance) + distance.recip()) * R::from_f32(0.5);
    let cosine = cosine.smaller(R::ONE).larger(-R::ONE);
    let half_chord = (R::ONE - cosine * cosine).sqrt();
    let tau = R::from_f32(core::f32::consts::TAU);
    let own = R::turn(half_chord, cosine) * tau - half_chord * cosine;
    let sine = half_chord / b;
    let others = if b >= R::from_u16(2) {
        // The series of β - sin β cos β, which is the difference of two large numbers.
        let square = sine * sine;
        let series = R::from_f32(2.0 / 3.0) + square * (R::from_f32(0.2) + square * R::from_f32(3.0 / 28.0));
        half_chord * half_chord * sine * series
    } else {
        let cosine = (distance * distance + b * b - R::ONE) / (distance * b) * R::from_f32(0.5);
        let (sine, cosine) = (sine.smaller(R::ONE), cosine.smaller(R::ONE).larger(-R::ONE));
        (R::turn(sine, cosine) * tau - sine * cosine) * (b * b)
    };
    ((own + others) * R::from_f32(core::f32::consts::FRAC_1_PI)).smaller(R::ONE)
}

/// The light of a polygon with radiance 1 on a white surface (Lambert's formula). The corners are seen from
/// the surface, whose horizon cuts the polygon.
fn light_of_polygon<R: Real>(normal: Vec3<R>, corners: &[Vec3<R>]) -> R {
    let Some(last) = corners.last().copied() else { return R::ZERO };
    let edge = |from: Vec3<R>, to: Vec3<R>| {
        let (from, to) = (from.unit_and_length().0, to.unit_and_length().0);
        let across = from.cross(to);
        let sine = across.length();
        // An edge that is seen end on gives nothing.
        if !(sine > R::from_f32(1e-6)) {
            return R::ZERO;
        }
        R::turn(sine, from.dot(to)) * (normal.dot(across) / sine)
    };
    let (mut sum, mut left, mut entered) = (R::ZERO, None, None);
    let (mut from, mut height) = (last, normal.dot(last));
    for to in corners.iter().copied() {
        let next = normal.dot(to);
        let (is_above, will_be) = (height > R::ZERO, next > R::ZERO);
        if is_above && will_be {
            sum = sum + edge(from, to);
        } else if is_above != will_be {
            let crossing = from + (to - from) * (height / (height - next));
            if is_above {
                sum = sum + edge(from, crossing);
                left = Some(crossing);
            } else {
                sum = sum + edge(crossing, to);
                entered = Some(crossing);
            }
        }
        (from, height) = (to, next);
    }
    if let (Some(left), Some(entered)) = (left, entered) {
        sum = sum + edge(left, entered);
    }
    sum.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::LinearRgb;
    use crate::material::Sides;
    use crate::math::{Fixed, Scale};
    use crate::shape::Luminaire;

    /// The light of a lamp with radiance 1 on a surface at the origin: by formula, and as the mean over its
    /// points.
    fn both<R: Real>(luminaire: Luminaire, normal: Vec3) -> (f64, f64) {
        let lamp =
            AreaLight::<R>::new(luminaire, (0, 0), (LinearRgb::BLACK, Sides::Both), Scale::ONE).unwrap();
        let normal: Vec3<R> = normal.to().normalized().unwrap();
        let number = |number: R| f64::from(number.to_f32());
        let seen = lamp.seen_from(Vec3::ZERO, normal);
        let closed = seen.map_or(0.0, |seen| number(seen.weight) * number(seen.cosine));
        let steps = 128u16;
        let mut sum = 0.0;
        for pair in (0..steps).flat_map(|a| (0..steps).map(move |b| [a * 512 + 256, b * 512 + 256])) {
            let Some(point) = lamp.point_seen_from(Vec3::ZERO, pair) else { continue };
            sum += number(normal.dot(point.toward)).max(0.0) * number(point.weight);
        }
        (closed, sum / f64::from(steps).powi(2))
    }

    fn assert_as_bright_as_samples<R: Real>() {
        let mut worst = 0.0f64;
        let at = |x, y, z| Vec3::new(x, y, z);
        let lamps = [
            (Luminaire::Ball { center: at(0.3, 0.2, 2.0), radius: 0.5 }, 1e-3),
            (Luminaire::Ball { center: at(0.0, 0.5, 1.0), radius: 0.9 }, 0.05),
            (Luminaire::Disc { center: at(0.5, 0.0, 2.0), normal: at(0.3, 0.2, 1.0), radius: 0.7 }, 2e-3),
            (
                Luminaire::Rectangle {
                    corner: at(-0.5, 0.2, 1.0),
                    right: at(1.5, 0.0, 0.5),
                    up: at(0.0, 1.0, 0.2),
                },
                2e-3,
            ),
        ];
        for (lamp, allowed) in lamps {
            // From the zenith to below the horizon.
            for step in 0..=24u8 {
                let angle = f32::from(step) * 0.1;
                let (closed, sampled) = both::<R>(lamp, at(angle.sin(), 0.1, angle.cos()));
                // Where the horizon cuts a ball, the formula is off by a share of its light.
                let error = (closed - sampled).abs();
                let cut = matches!(lamp, Luminaire::Ball { .. }) && step > 10;
                assert!(
                    error < if cut { 0.02 } else { allowed },
                    "{lamp:?}, {angle}: {closed}, not {sampled}"
                );
                worst = worst.max(error);
            }
        }
        println!("worst error of a lamp's light: {worst:.4}");
    }

    #[test]
    fn formulas_give_the_light_of_samples() {
        assert_as_bright_as_samples::<f32>();
        assert_as_bright_as_samples::<f64>();
        assert_as_bright_as_samples::<Fixed>();
    }

    fn assert_overlaps<R: Real>() {
        let steps = 400;
        for (b, allowed) in [
            (0.04, 0.003),
            (0.3, 0.003),
            (1.0, 0.003),
            (1.9, 0.003),
            (2.5, 0.003),
            (20.0, 0.003),
            (90.0, 0.015),
        ] {
            for step in 0..=20u8 {
                let distance = (b + 1.0) * f64::from(step) / 20.0;
                let distance = if b > 3.0 { b - 1.2 + f64::from(step) * 0.12 } else { distance };
                let mut inside = 0;
                let mut all = 0;
                for x in 0..steps {
                    for y in 0..steps {
                        let place = |index: i32| (f64::from(index) + 0.5) / f64::from(steps) * 2.0 - 1.0;
                        let (x, y) = (place(x), place(y));
                        if x * x + y * y < 1.0 {
                            all += 1;
                            inside += i32::from((x - distance).powi(2) + y * y < b * b);
                        }
                    }
                }
                let expected = f64::from(inside) / f64::from(all);
                // Radii as angles of caps are: a small lamp.
                let number = |length: f64| R::from_f32((length * 0.002) as f32);
                let found = f64::from(overlap(number(1.0), number(b), number(distance)).to_f32());
                let allowed = if R::IS_FIXED_POINT { allowed + 0.003 } else { allowed };
                assert!((found - expected).abs() < allowed, "{b}, {distance}: {found}, not {expected}");
            }
        }
    }

    #[test]
    fn discs_overlap_as_counted_points_do() {
        assert_overlaps::<f32>();
        assert_overlaps::<f64>();
        assert_overlaps::<Fixed>();
    }
}
