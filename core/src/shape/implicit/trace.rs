//! Sphere tracing with bounded steps (Hart, "Sphere Tracing: A Geometric Method for the Antialiased Ray
//! Tracing of Implicit Surfaces", The Visual Computer, 1996).
//!
//! From each place, a ray steps as far as the function is known to keep its sign, but not less than a fixed
//! share of its way through the box. If the sign has changed after a step, there is a root in between, which
//! is then searched.
//!
//! The share is there because Hart's steps become ever shorter where a ray grazes a surface: their number
//! would have no bound, or rays would have to be given up, which leaves holes. With the share every ray comes
//! to its end, and two changes of the sign are lost only if they are closer together than the share.
//!
//! A small value does not count as a hit, since a ray that was spawned on the surface begins where the value
//! is small.

use crate::limits::MAX_TRACE_STEPS;
use crate::math::{Interval, Ray, Real, Vec3};
use crate::shape::chord::Chord;

/// The most steps of the search for a root between two places. Three are common.
const ROOT_STEPS: u8 = 40;

/// A ray's line through a box. It is parametrized from its point nearest to the middle of the box.
pub(super) struct TracedLine<R> {
    /// That point, relative to the middle.
    start: Vec3<R>,
    direction: Vec3<R>,
    /// The distance of that point from the ray's origin.
    advance: R,
}

impl<R: Real> TracedLine<R> {
    /// The line of a ray; `None` if it misses the ball of this radius around the middle.
    pub(super) fn new(ray: &Ray<R>, middle: Vec3<R>, radius: R) -> Option<Self> {
        let (start, advance) = ray.nearest_to_twice(middle);
        let is_near = start.length_squared_wide() <= radius.times(radius);
        is_near.then_some(Self { start, direction: ray.direction, advance })
    }

    /// The point at `t` along the line, relative to the middle.
    pub(super) fn at(&self, t: R) -> Vec3<R> {
        self.start + self.direction * t
    }

    /// The `t` at which the line is nearest to a point, which is relative to the middle.
    pub(super) fn along(&self, point: Vec3<R>) -> R {
        point.dot(self.direction)
    }

    /// The part of the line in the box with these half sides.
    fn within(&self, half: Vec3<R>) -> Option<Interval<R>> {
        let Self { start, direction, .. } = self;
        let mut chord = Chord::whole();
        chord.between(-half.x - start.x, half.x - start.x, direction.x);
        chord.between(-half.y - start.y, half.y - start.y, direction.y);
        chord.between(-half.z - start.z, half.z - start.z, direction.z);
        chord.spans().as_slice().first().copied()
    }

    /// The first distance along the ray, inside `range` and in the box, at which a function changes its sign.
    /// `look` returns its value at a place along the line, and a distance within which it keeps its sign.
    #[inline]
    pub(super) fn first_crossing(
        &self,
        half: Vec3<R>,
        range: Interval<R>,
        tolerance: R,
        look: impl Fn(R) -> (R, R),
    ) -> Option<R> {
        let part = self.within(half)?;
        // The steps do not depend on the range, so that a hit is the same whatever was hit before.
        let least = (part.max - part.min) * R::from_fraction((0x1_0000 / MAX_TRACE_STEPS) as u16);
        let end = range.max - self.advance;
        // Start at the ray's origin, not at the beginning of the range: that may be a hit, which must not be
        // found again.
        let mut t = part.min.larger(-self.advance);
        let (mut value, mut step) = look(t);
        for _ in 0..MAX_TRACE_STEPS {
            if !(t < part.max && t < end) {
                break;
            }
            let mut next = t + step.larger(least);
            // If the part is shorter than rounding, a step may not move at all: then go to its end.
            if !(next < part.max && next > t) {
                next = part.max;
            }
            let (next_value, next_step) = look(next);
            if (value < R::ZERO) != (next_value < R::ZERO) {
                let root = root_by_secants((t, value), (next, next_value), tolerance, |t| look(t).0);
                let hit = self.advance + root;
                if range.contains(hit) {
                    return Some(hit);
                }
            }
            (t, value, step) = (next, next_value, next_step);
        }
        None
    }
}

/// The root between two places, each given with the function's value there; the values have different signs.
/// By secants; the value of an end that is kept twice is halved (the Illinois method: Dowell and Jarratt, "A
/// Modified Regula Falsi Method", BIT, 1971).
fn root_by_secants<R: Real>(mut from: (R, R), mut to: (R, R), tolerance: R, value: impl Fn(R) -> R) -> R {
    let half = R::from_fraction(1 << 15);
    let from_is_negative = from.1 < R::ZERO;
    let (mut at, mut moved_from) = (from.0, None);
    for _ in 0..ROOT_STEPS {
        let last = at;
        at = from.0 + (to.0 - from.0) * (from.1 / (from.1 - to.1));
        let here = (at, value(at));
        let moves_from = (here.1 < R::ZERO) == from_is_negative;
        let again = moved_from == Some(moves_from);
        if moves_from {
            from = here;
            to.1 = if again { to.1 * half } else { to.1 };
        } else {
            to = here;
            from.1 = if again { from.1 * half } else { from.1 };
        }
        moved_from = Some(moves_from);
        if here.1 == R::ZERO || !((at - last).abs() > tolerance) {
            break;
        }
    }
    at
}
