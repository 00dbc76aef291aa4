//! Where a curved surface mirrors to beside a traced ray.
//!
//! Along a surface its normal turns, and the mirrored direction twice as much. To first order, the directions into which the footprint of a
//! ray mirrors are a parallelogram around that of the ray itself: wide across a cylinder, and narrow along it. A highlight is where that
//! passes by a light (Phong, "Illumination for Computer Generated Pictures", CACM 1975), wherever it lies between traced rays.

use super::super::sample::Near;
use super::cone::Footprint;
use crate::material::Shininess;
use crate::math::{Real, Vec3};

/// A highlight is looked for within this share of what shows of it.
const SHOWN: f32 = 3.0 / 16.0;

/// The directions into which a footprint mirrors, as far as they are across that of its middle: sines of angles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sweep<R> {
    middle: Vec3<R>,
    turns: [Turn<R>; 2],
}

/// From the middle to that of a side.
#[derive(Clone, Copy, Debug)]
struct Turn<R> {
    way: Vec3<R>,
    /// Its squared length, and one over that; of less than a degree, 0: that is none.
    squared: R,
    unsquared: R,
}

impl<R: Real> Turn<R> {
    fn new(way: Vec3<R>) -> Self {
        let squared = way.length_squared();
        let unsquared = if squared > R::from_fraction(1 << 4) { squared.recip() } else { R::ZERO };
        Self { way, squared, unsquared }
    }
}

impl<R: Real> Sweep<R> {
    /// Of a ray that ends in such a footprint and is mirrored, up to those beside it toward both `sides` of the picture. The normal of the
    /// surface is known a step away from its hit.
    pub(super) fn new(
        footprint: &Footprint<R>,
        sides: [Vec3<R>; 2],
        (direction, middle): (Vec3<R>, Vec3<R>),
        normal_beside: impl Fn(Vec3<R>) -> Vec3<R>,
    ) -> Self {
        let turn = |side: Vec3<R>| {
            let (step, aside) = footprint.step(side);
            let (normal, direction) = (normal_beside(step), direction + aside);
            let height = normal.dot(direction);
            let mirrored = direction - normal * (height + height);
            let turn = across(mirrored, middle);
            // Beyond a right angle, sines become less again.
            if mirrored.dot(middle) < R::ZERO { turn.normalized().unwrap_or(turn) } else { turn }
        };
        Self { middle, turns: sides.map(|side| Turn::new(turn(side))) }
    }

    /// As far as half of the footprint.
    pub(super) fn halved(self) -> Self {
        Self { turns: self.turns.map(|turn| Turn::new(turn.way * R::from_f32(0.5))), ..self }
    }

    /// How far it reaches to the side where it is the widest, squared.
    pub(super) fn reach_squared(&self) -> R {
        let [one, other] = self.turns;
        one.squared.larger(other.squared)
    }

    /// How closely the highlight of a light must be looked for that is less than a right angle aside: not where it is so broad that it is
    /// seen anyway. Only the points that stand for the least tell of one that is tiny, or half of the footprint would be traced in vain.
    pub(super) fn nearness(&self, toward: Vec3<R>, shininess: &Shininess<R>, is_least: bool) -> Near {
        let cosine = cosine(self.reach_squared());
        let passes = |sweep: &Self| shininess.shows(sweep.nearest(toward), R::from_f32(SHOWN));
        if shininess.shows(cosine, R::from_f32(1.0 / 16.0)) || !passes(self) {
            Near::Nothing
        } else if shininess.shows(cosine, R::from_f32(1.5)) || !(is_least || passes(&self.halved())) {
            Near::Glint
        } else {
            Near::Tiny
        }
    }

    /// The cosine between a direction and the nearest of these.
    fn nearest(&self, toward: Vec3<R>) -> R {
        let (mut away, mut shares) = (across(toward, self.middle), [R::ZERO; 2]);
        // As far along each as brings it the nearest, in turns: where the two are not at right angles, once is not enough.
        for _ in 0..2 {
            for (turn, share) in self.turns.iter().zip(&mut shares) {
                let best = *share + away.dot(turn.way) * turn.unsquared;
                let best = best.larger(-R::ONE).smaller(R::ONE);
                away = away - turn.way * (best - *share);
                *share = best;
            }
        }
        cosine(away.length_squared())
    }
}

/// The part of a vector that is across a unit vector.
fn across<R: Real>(vector: Vec3<R>, along: Vec3<R>) -> Vec3<R> {
    vector - along * along.dot(vector)
}

/// The cosine of a small angle of which the squared sine is this.
fn cosine<R: Real>(sine_squared: R) -> R {
    R::ONE - sine_squared * R::from_f32(0.5)
}
