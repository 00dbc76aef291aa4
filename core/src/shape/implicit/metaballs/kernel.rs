//! The kernel of a blob: Wyvill's.
//!
//! A blob of strength s and radius R adds s (1 - q)² (1 - 4q/9) at the distance r = R √q. This is the paper's
//! 1 - 22/9 q + 17/9 q² - 4/9 q³; at r = R both its value and its slope are 0. The slope along r is 4/9 s (1
//! - q) (11 - 6q) √q / R downward. It is largest where 60 q² - 102 q + 22 = 0, at q = 0.2535: 1.5835 s / R.

use crate::math::Real;

/// An upper bound of the slope of a kernel of radius and strength 1, which is 1.5835, with room for rounding.
pub(super) const STEEPEST: f32 = 1.6;

/// The value of the sum at the surface.
pub(super) const LEVEL: f32 = 0.5;

/// The value of a blob of strength 1, where `q` is the squared distance from its center in radii: 0 to 1.
pub(super) fn kernel<R: Real>(q: R) -> R {
    let rest = R::ONE - q;
    rest * rest * (R::ONE - q * R::from_f32(4.0 / 9.0))
}

/// The slope of a blob of strength and radius 1 there, divided by √q; positive, although the value falls.
pub(super) fn slope<R: Real>(q: R) -> R {
    let rest = R::from_u16(11) - q * R::from_u16(6);
    (R::ONE - q) * rest * R::from_f32(4.0 / 9.0)
}

/// The distance up to which a kernel of radius and strength 1 is at least `value`; `None` if it is so
/// nowhere.
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
