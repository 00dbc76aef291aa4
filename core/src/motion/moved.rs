//! Where moving things are at one time.

use core::f32::consts::FRAC_PI_2;

use super::{Motion, Spin};
use crate::fault::{Fault, check_direction, check_number, check_point};
use crate::math::{Aabb, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// The most turns while the shutter is open.
const MOST_TURNS: f32 = 10.0;

impl Motion {
    /// Checks the motion and converts it.
    pub(crate) fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedMotion<R>, Fault> {
        check_point(self.by)?;
        let mut spin = None;
        if let Some(Spin { center, axis, angle }) = self.spin {
            check_point(center)?;
            check_number(angle)?;
            let turns = angle / core::f32::consts::TAU;
            if turns.abs() > MOST_TURNS {
                return Err(Fault::TooManyTurns);
            }
            let axis = check_direction::<R::Setup>(axis)?;
            spin = Some(PreparedSpin {
                center: scale.point(center.to()),
                axis: Vec3::from_setup(axis),
                turns: R::from_f32(turns),
            });
        }
        Ok(PreparedMotion { by: scale.point(self.by.to()), spin })
    }
}

/// A [`Motion`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedMotion<R> {
    by: Vec3<R>,
    spin: Option<PreparedSpin<R>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct PreparedSpin<R> {
    center: Vec3<R>,
    axis: Vec3<R>,
    turns: R,
}

/// How something has moved at one time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moved<R> {
    by: Vec3<R>,
    turn: Option<Turn<R>>,
}

#[derive(Clone, Copy, Debug)]
struct Turn<R> {
    center: Vec3<R>,
    axis: Vec3<R>,
    cosine: R,
    sine: R,
}

impl<R: Real> PreparedMotion<R> {
    /// How far the motion has come at a time: 0 when the shutter opens, 1 when it closes.
    pub(crate) fn at(&self, time: R) -> Moved<R> {
        let turn = self.spin.map(|PreparedSpin { center, axis, turns }| {
            let (cosine, sine) = cosine_and_sine(turns * time);
            Turn { center, axis, cosine, sine }
        });
        Moved { by: self.by * time, turn }
    }

    /// A box that contains the moved contents of a box at any time.
    pub(crate) fn bounds(&self, still: Aabb<R>) -> Aabb<R> {
        let mut bounds = still;
        if let Some(PreparedSpin { center, .. }) = self.spin {
            // Turned points stay in a ball.
            let farthest = still.corners().map(|corner| (corner - center).length());
            let radius = farthest.fold(R::ZERO, R::larger);
            let edge = Vec3::new(radius, radius, radius);
            bounds = bounds.union(Aabb { min: center - edge, max: center + edge });
        }
        let end = Aabb { min: bounds.min + self.by, max: bounds.max + self.by };
        let swept = bounds.union(end);
        // A ray is moved with rounding, and so is the turned corner.
        let rounding = R::offset(swept.magnitude());
        swept.padded(rounding + rounding)
    }
}

impl<R: Real> Moved<R> {
    /// A point where it was before.
    pub(crate) fn point_back(&self, point: Vec3<R>) -> Vec3<R> {
        let point = point - self.by;
        match &self.turn {
            Some(turn) => turn.center + turn.vector(point - turn.center, -turn.sine),
            None => point,
        }
    }

    fn point(&self, point: Vec3<R>) -> Vec3<R> {
        match &self.turn {
            Some(turn) => turn.center + turn.vector(point - turn.center, turn.sine) + self.by,
            None => point + self.by,
        }
    }

    /// A direction as it was before.
    pub(crate) fn direction_back(&self, direction: Vec3<R>) -> Vec3<R> {
        self.turn.as_ref().map_or(direction, |turn| turn.vector(direction, -turn.sine).unit_again())
    }

    /// A direction as it is now.
    pub(crate) fn direction(&self, direction: Vec3<R>) -> Vec3<R> {
        self.turn.as_ref().map_or(direction, |turn| turn.vector(direction, turn.sine).unit_again())
    }

    /// A ray as it would have been before. Distances along it stay the same.
    pub(crate) fn ray_back(&self, ray: &Ray<R>) -> Ray<R> {
        Ray { origin: self.point_back(ray.origin), direction: self.direction_back(ray.direction) }
    }

    /// A ray as it is now.
    pub(crate) fn ray(&self, ray: &Ray<R>) -> Ray<R> {
        Ray { origin: self.point(ray.origin), direction: self.direction(ray.direction) }
    }

    /// A surface where it is now.
    pub(crate) fn surface(&self, surface: &Surface<R>) -> Surface<R> {
        let point = self.point(surface.point);
        let mut magnitude = surface.magnitude.larger(point.magnitude()).larger(self.by.magnitude());
        if let Some(turn) = &self.turn {
            magnitude = magnitude.larger(turn.center.magnitude());
        }
        Surface {
            point,
            normal: self.direction(surface.normal),
            shading_normal: self.direction(surface.shading_normal),
            magnitude,
            part: surface.part,
        }
    }

    /// A surface where it was before.
    pub(crate) fn surface_back(&self, surface: &Surface<R>) -> Surface<R> {
        Surface {
            point: self.point_back(surface.point),
            normal: self.direction_back(surface.normal),
            shading_normal: self.direction_back(surface.shading_normal),
            ..*surface
        }
    }
}

impl<R: Real> Turn<R> {
    /// A vector, turned about the axis by the angle with this sine (Rodrigues' formula).
    fn vector(&self, vector: Vec3<R>, sine: R) -> Vec3<R> {
        let along = self.axis * self.axis.dot(vector);
        along + (vector - along) * self.cosine + self.axis.cross(vector) * sine
    }
}

/// Cosine and sine of an angle in turns. Their squares add up to 1; the angle's error is below 1e-5 turns.
fn cosine_and_sine<R: Real>(turns: R) -> (R, R) {
    let four = R::from_u16(4);
    let quarters = turns * four;
    let quadrant = quarters.floor_to_i32();
    let rest = quarters - R::from_f32(quadrant as f32);
    // The Taylor series of sin(π/2 · x).
    let sine_of = |x: R| {
        let square = x * x;
        let mut sum = R::ZERO;
        for coefficient in [1.604_411_8e-4, -4.681_754e-3, 7.969_262_6e-2, -0.645_964_1, FRAC_PI_2] {
            sum = sum * square + R::from_f32(coefficient);
        }
        sum * x
    };
    let unit = Vec3::new(sine_of(R::ONE - rest), sine_of(rest), R::ZERO).unit();
    match quadrant & 3 {
        0 => (unit.x, unit.y),
        1 => (-unit.y, unit.x),
        2 => (-unit.x, -unit.y),
        _ => (unit.y, -unit.x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    fn assert_turns<R: Real>(error: f64) {
        for step in -100..100 {
            let turns = step as f32 / 37.0;
            let (cosine, sine) = cosine_and_sine(R::from_f32(turns));
            let (cosine, sine) = (f64::from(cosine.to_f32()), f64::from(sine.to_f32()));
            let (right_sine, right_cosine) = (f64::from(turns) * core::f64::consts::TAU).sin_cos();
            assert!((cosine - right_cosine).abs() < error, "{turns}: {cosine}, not {right_cosine}");
            assert!((sine - right_sine).abs() < error, "{turns}: {sine}, not {right_sine}");
        }
    }

    #[test]
    fn cosine_and_sine_of_turns() {
        assert_turns::<f32>(1e-5);
        assert_turns::<f64>(1e-5);
        assert_turns::<Fixed>(1e-5);
    }

    fn assert_goes_there_and_back<R: Real>() {
        let up = Vec3::new(0.0, 0.0, 2.0);
        let motion = Motion::of_object(0, Vec3::new(0.25, 0.0, 0.125)).spinning(
            Vec3::new(0.5, 0.0, 0.0),
            up,
            core::f32::consts::PI,
        );
        let prepared = motion.prepare::<R>(Scale::ONE).unwrap();
        let half = prepared.at(R::from_f32(0.5));
        // A quarter turn about (½, 0), and half of the way.
        let point = half.point(Vec3::new(0.75, 0.0, 0.5).to());
        let near = |a: Vec3<R>, b: Vec3| {
            let b: Vec3<R> = b.to();
            assert!((a - b).length() < R::from_f32(1e-5), "{a:?}, not {b:?}");
        };
        near(point, Vec3::new(0.625, 0.25, 0.5625));
        near(half.point_back(point), Vec3::new(0.75, 0.0, 0.5));
        let direction = half.direction(Vec3::new(1.0, 0.0, 0.0).to());
        near(direction, Vec3::new(0.0, 1.0, 0.0));
        near(half.direction_back(direction), Vec3::new(1.0, 0.0, 0.0));
        // The box holds the point at all times.
        let still = Aabb::point(Vec3::new(0.75, 0.0, 0.5).to());
        let bounds = prepared.bounds(still);
        for step in 0..=64u16 {
            let moved = prepared.at(R::from_f32(f32::from(step) / 64.0)).point(still.min);
            let all = bounds.union(Aabb::point(moved));
            assert_eq!(all, bounds);
        }
    }

    #[test]
    fn moved_points_lie_in_the_bounds_and_go_back() {
        assert_goes_there_and_back::<f32>();
        assert_goes_there_and_back::<f64>();
        assert_goes_there_and_back::<Fixed>();
    }

    #[test]
    fn the_memory_is_enough() {
        assert!(size_of::<PreparedMotion<f32>>() <= Motion::bytes::<f32>(1));
        assert!(size_of::<PreparedMotion<f64>>() <= Motion::bytes::<f64>(1));
        assert!(size_of::<PreparedMotion<Fixed>>() <= Motion::bytes::<Fixed>(1));
    }

    #[test]
    fn bad_motions_are_refused() {
        let still = Motion::of_object(0, Vec3::ZERO);
        let refused = |motion: Motion| motion.prepare::<f32>(Scale::ONE).unwrap_err();
        assert_eq!(refused(Motion { by: Vec3::new(f32::NAN, 0.0, 0.0), ..still }), Fault::NotFinite);
        assert_eq!(refused(Motion { by: Vec3::new(2e6, 0.0, 0.0), ..still }), Fault::TooFar);
        let up = Vec3::new(0.0, 1.0, 0.0);
        assert_eq!(refused(still.spinning(Vec3::ZERO, Vec3::ZERO, 1.0)), Fault::ZeroLength);
        assert_eq!(refused(still.spinning(Vec3::ZERO, up, f32::INFINITY)), Fault::NotFinite);
        assert_eq!(refused(still.spinning(Vec3::ZERO, up, -63.0)), Fault::TooManyTurns);
    }
}
