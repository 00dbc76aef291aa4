//! What a blob adds at a distance: Wyvill's kernel.
//!
//! A blob of strength s and radius R adds s (1 - q)² (1 - 4q/9) at the distance r = R √q: the paper's
//! 1 - 22/9 q + 17/9 q² - 4/9 q³, of which neither value nor slope is left at r = R. Its slope along r is
//! 4/9 s (1 - q) (11 - 6q) √q / R, which is largest where 60 q² - 102 q + 22 = 0, at q = 0.2535: 1.5835 s / R.

use crate::math::Real;

/// The steepest slope of a kernel of radius and strength 1 is 1.5835. The rest is room for rounding.
pub(super) const STEEPEST: f32 = 1.6;

/// The value of the sum at the surface.
pub(super) const LEVEL: f32 = 0.5;

/// What a blob of strength 1 adds, by the squared share of its radius: less than 1.
pub(super) fn kernel<R: Real>(q: R) -> R {
    let rest = R::ONE - q;
    rest * rest * (R::ONE - q * R::from_f32(4.0 / 9.0))
}

/// How steeply it falls there, if strength and radius are 1, divided by √q.
pub(super) fn slope<R: Real>(q: R) -> R {
    let rest = R::from_u16(11) - q * R::from_u16(6);
    (R::ONE - q) * rest * R::from_f32(4.0 / 9.0)
}

/// How far out a kernel of radius and strength 1 is at least so large; `None` where it is nowhere.
pub(super) fn reach_of<S: Real>(value: S) -> Option<S> {
    if !(value < S::ONE) {
        return None;
    }
    let half = S::from_f32(0.5);
    let (mut within, mut beyond) = (S::ZERO, S::ONE);
    for _ in 0..30 {
        let q = (within + beyond) * half;
        if kernel(q) > value {
            within = q;
        } else {
            beyond = q;
        }
    }
    Some(beyond.sqrt())
}
