//! The sweep of a footprint: the directions into which a curved surface mirrors over the footprint.
//!
//! Along a curved surface the normal turns, and the mirrored direction turns twice as much. To first order,
//! the sweep is a parallelogram around the mirrored direction of the traced ray: wide across a cylinder, and
//! narrow along it. A highlight is seen where the mirrored direction passes a light (Phong, "Illumination for
//! Computer Generated Pictures", CACM 1975). If the light lies within the sweep, a highlight lies within the
//! footprint, traced or not.

use super::super::sample::Near;
use super::footprint::Footprint;
use crate::material::Shininess;
use crate::math::{Real, Vec3};

/// A highlight counts within this share of its extent, see [`Shininess::shows`].
const SHOWN: f32 = 3.0 / 16.0;
/// A highlight that shows within this share of its extent over the whole sweep is seen anyway.
const BROAD: f32 = 1.0 / 16.0;
/// A highlight that shows within this share of its extent over the whole sweep is not [`Near::Tiny`].
const NOT_TINY: f32 = 1.5;

/// The directions into which a footprint mirrors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep<R> {
    /// The mirrored direction in the footprint's middle, a unit vector.
    middle: Vec3<R>,
    /// From there to the middles of two sides of the parallelogram.
    turns: [Turn<R>; 2],
}

/// The part of a direction that is across the middle one. Its length is the sine of the angle between them.
#[derive(Clone, Copy, Debug)]
struct Turn<R> {
    across: Vec3<R>,
    squared: R,
    /// 1 / `squared`; 0 for a turn of less than a degree, which counts as none.
    unsquared: R,
}

impl<R: Real> Turn<R> {
    fn new(across: Vec3<R>) -> Self {
        let squared = across.length_squared();
        let unsquared = if squared > R::from_fraction(1 << 4) { squared.recip() } else { R::ZERO };
        Self { across, squared, unsquared }
    }
}

impl<R: Real> Sweep<R> {
    /// The sweep of a footprint whose ray comes in `direction` and is mirrored to `middle`. `right_and_up`
    /// are unit vectors in the picture. `normal_beside` is the surface's normal a step away from the
    /// footprint's middle.
    pub(super) fn new(
        footprint: &Footprint<R>,
        right_and_up: [Vec3<R>; 2],
        (direction, middle): (Vec3<R>, Vec3<R>),
        normal_beside: impl Fn(Vec3<R>) -> Vec3<R>,
    ) -> Self {
        let turn = |toward: Vec3<R>| {
            let (step, aside) = footprint.step(toward);
            let (normal, direction) = (normal_beside(step), direction + aside);
            let height = normal.dot(direction);
            let mirrored = direction - normal * (height + height);
            let turn = across(mirrored, middle);
            // Beyond a right angle, the sine would become smaller again.
            if mirrored.dot(middle) < R::ZERO { turn.normalized().unwrap_or(turn) } else { turn }
        };
        Self { middle, turns: right_and_up.map(|toward| Turn::new(turn(toward))) }
    }

    /// The sweep of the footprint's inner half.
    fn halved(self) -> Self {
        Self { turns: self.turns.map(|turn| Turn::new(turn.across * R::from_f32(0.5))), ..self }
    }

    /// The squared sine of the angle to the side that is farthest from the middle.
    pub(super) fn reach_squared(&self) -> R {
        let [one, other] = self.turns;
        one.squared.larger(other.squared)
    }

    /// How closely the highlight of a light must be searched for. The light is less than a right angle from
    /// the middle.
    ///
    /// A highlight so broad that it is seen anyway is not searched for. A tiny one that lies in the outer
    /// half of the footprint is left to other points of the grid, unless the point `stands_for_least` of
    /// them: half of the footprint would be traced for nothing.
    pub(super) fn nearness(&self, toward: Vec3<R>, shininess: &Shininess<R>, stands_for_least: bool) -> Near {
        let cosine = cosine(self.reach_squared());
        let passes = |sweep: &Self| shininess.shows(sweep.nearest(toward), R::from_f32(SHOWN));
        if shininess.shows(cosine, R::from_f32(BROAD)) || !passes(self) {
            Near::Nothing
        } else if shininess.shows(cosine, R::from_f32(NOT_TINY))
            || !(stands_for_least || passes(&self.halved()))
        {
            Near::Glint
        } else {
            Near::Tiny
        }
    }

    /// The cosine between a direction and the nearest direction of the sweep.
    fn nearest(&self, toward: Vec3<R>) -> R {
        let (mut away, mut shares) = (across(toward, self.middle), [R::ZERO; 2]);
        // Go along one turn as far as brings the direction nearest, then along the other. The turns may not
        // be at right angles, so that a second round is needed.
        for _ in 0..2 {
            for (turn, share) in self.turns.iter().zip(&mut shares) {
                let best = *share + away.dot(turn.across) * turn.unsquared;
                let best = best.larger(-R::ONE).smaller(R::ONE);
                away = away - turn.across * (best - *share);
                *share = best;
            }
        }
        cosine(away.length_squared())
    }
}

/// The part of a vector that is at right angles to a unit vector.
fn across<R: Real>(vector: Vec3<R>, along: Vec3<R>) -> Vec3<R> {
    vector - along * along.dot(vector)
}

/// The cosine of a small angle, from its squared sine.
fn cosine<R: Real>(sine_squared: R) -> R {
    R::ONE - sine_squared * R::from_f32(0.5)
}

#[cfg(test)]
mod tests {
    use super::super::super::grid::Grid;
    use super::super::cone::Cone;
    use super::*;
    use crate::camera::{Camera, Viewport};
    use crate::math::Scale;

    const CAMERA: Camera = Camera {
        eye: Vec3::ZERO,
        target: Vec3::new(0.0, 0.0, -1.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.8,
        lens: None,
    };

    /// A ray meets a ball of this radius straight on, 30 units from the eye.
    fn sweep_of_ball(radius: f64) -> Sweep<f64> {
        let viewport = Viewport::<f64>::new(&CAMERA.prepare(Scale::ONE).unwrap(), 320, 240);
        let cone = Cone::new(&viewport, Grid::Eight, 0).after(30.0);
        let (direction, normal) = (Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.0, 0.0, 1.0));
        let normal_beside = |step: Vec3<f64>| (normal * radius + step).unit();
        Sweep::new(
            &Footprint::new(cone, direction, normal),
            viewport.right_and_up(),
            (direction, normal),
            normal_beside,
        )
    }

    #[test]
    fn highlights_are_near_where_a_light_is_within_the_sweep() {
        let shininess = Shininess::new(1000.0);
        let light = |angle: f64| Vec3::new(angle.sin(), 0.0, angle.cos());
        // Half a cell is about 0.4 units there: the normal of a ball of radius 2 turns by 0.2, the mirrored
        // direction by 0.4.
        let sweep = sweep_of_ball(2.0);
        let reach = sweep.reach_squared().sqrt();
        assert!((0.3..0.6).contains(&reach), "{reach}");
        assert_eq!(sweep.nearness(light(0.1), &shininess, false), Near::Tiny);
        assert_eq!(sweep.nearness(light(0.9 * reach), &shininess, false), Near::Glint);
        assert_eq!(sweep.nearness(light(0.9 * reach), &shininess, true), Near::Tiny);
        assert_eq!(sweep.nearness(light(reach + 0.3), &shininess, true), Near::Nothing);
        // A broad highlight is seen anyway, and so is one on a ball that is nearly flat.
        assert_eq!(sweep_of_ball(4.0).nearness(light(0.1), &Shininess::new(2.0), true), Near::Nothing);
        assert_eq!(sweep_of_ball(200.0).nearness(light(0.0), &shininess, true), Near::Nothing);
    }
}
