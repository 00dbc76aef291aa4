//! Sphere tracing with bounded steps (Hart, "Sphere Tracing: A Geometric Method for the Antialiased Ray Tracing of Implicit
//! Surfaces", The Visual Computer, 1996).
//!
//! From each place a ray goes as far as the function surely keeps its sign, and where the sign has changed nonetheless, the
//! root is between. It can change because no step is shorter than a share of the way: Hart's steps become ever shorter where a ray
//! grazes a surface, so that either their number is open, or the ray ends in a hole. So the number of steps
//! is fixed, every ray comes to its end, and what is lost is only what lies between two places so near to each other.
//!
//! Rejected: to call it a hit where the value is small. A ray that was spawned on the surface begins where it is small.

use crate::limits::MAX_TRACE_STEPS;
use crate::math::{Interval, Ray, Real, Vec3};
use crate::shape::chord::Chord;

/// The most steps to a root that lies between two places: three are common.
const ROOT_STEPS: u8 = 40;

/// A ray's line, from its point that is nearest to the middle of a box.
pub(super) struct Line<R> {
    /// That point, from the middle.
    start: Vec3<R>,
    direction: Vec3<R>,
    /// Its distance from the ray's origin.
    advance: R,
}

impl<R: Real> Line<R> {
    /// The line, unless it passes by the ball of this radius around the middle.
    pub(super) fn new(ray: &Ray<R>, middle: Vec3<R>, radius: R) -> Option<Self> {
        let (start, advance) = ray.nearest_to_twice(middle);
        let is_near = start.length_squared_wide() <= radius.times(radius);
        is_near.then_some(Self { start, direction: ray.direction, advance })
    }

    /// The point at a distance along the line, from the middle.
    pub(super) fn at(&self, t: R) -> Vec3<R> {
        self.start + self.direction * t
    }

    /// How far along the line a point is nearest.
    pub(super) fn along(&self, point: Vec3<R>) -> R {
        point.dot(self.direction)
    }

    /// The part in the box that reaches so far from the middle.
    fn within(&self, half: Vec3<R>) -> Option<Interval<R>> {
        let Self { start, direction, .. } = self;
        let mut chord = Chord::whole();
        chord.between(-half.x - start.x, half.x - start.x, direction.x);
        chord.between(-half.y - start.y, half.y - start.y, direction.y);
        chord.between(-half.z - start.z, half.z - start.z, direction.z);
        chord.spans().as_slice().first().copied()
    }

    /// The first distance of the ray, inside `range` and in the box, at which a function becomes negative or ceases to be.
    /// `look` gives its value at a place along the line, and how far it surely keeps its sign from there on.
    #[inline(always)]
    pub(super) fn first_crossing(
        &self,
        half: Vec3<R>,
        range: Interval<R>,
        tolerance: R,
        look: impl Fn(R) -> (R, R),
    ) -> Option<R> {
        let part = self.within(half)?;
        // The steps do not depend on the range: a hit is the same, whatever else was hit before.
        let least = (part.max - part.min) * R::from_fraction((0x1_0000 / MAX_TRACE_STEPS) as u16);
        let end = range.max - self.advance;
        // From the ray's origin, not from the range's beginning: that may be a hit, which must not be found once more a little later.
        let mut t = part.min.larger(-self.advance);
        let (mut value, mut step) = look(t);
        for _ in 0..MAX_TRACE_STEPS {
            if !(t < part.max && t < end) {
                break;
            }
            let mut next = t + step.larger(least);
            // It is no step at all where the part is shorter than rounding.
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

/// The root between two places where a function of unknown slope has different signs, by secants; of an end that stays, half its value
/// counts (the Illinois method: Dowell and Jarratt, "A Modified Regula Falsi Method", BIT, 1971).
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
