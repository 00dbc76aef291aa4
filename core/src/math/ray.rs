//! A ray, and the one way in which rays leave a surface.

use super::{Real, Vec3};

/// A half-line from `origin` along `direction`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<R> {
    /// The point where the ray starts.
    pub origin: Vec3<R>,
    /// The direction: a unit vector.
    pub direction: Vec3<R>,
}

impl<R: Real> Ray<R> {
    /// The point at distance `t`.
    pub fn at(&self, t: R) -> Vec3<R> {
        self.origin + self.direction * t
    }

    /// The point of the ray's whole line that is nearest to `place`, relative to `place`, and its distance
    /// along the ray. Numbers that a shape computes from this point are of the size of the shape, however far
    /// away the ray begins.
    #[inline]
    pub fn nearest_to(&self, place: Vec3<R>) -> (Vec3<R>, R) {
        let advance = (place - self.origin).dot(self.direction);
        (self.at(advance) - place, advance)
    }

    /// [`nearest_to`](Self::nearest_to) with a second step, which removes the rounding error of the first
    /// where a ray begins far away. For shapes that square small distances.
    #[inline]
    pub(crate) fn nearest_to_twice(&self, place: Vec3<R>) -> (Vec3<R>, R) {
        let (from_place, advance) = self.nearest_to(place);
        let rest = -from_place.dot(self.direction);
        (from_place + self.direction * rest, advance + rest)
    }

    /// A ray that leaves a surface and does not hit it again.
    ///
    /// The origin is moved off the surface along the geometric `normal`, to the side that `direction` goes
    /// to, by [`Real::offset`] of `magnitude`: the largest number that entered the computation of
    /// `point`, which bounds its rounding error. This is the only offset in the crate (after Wächter and
    /// Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, 2019, ch. 6).
    pub fn spawn(point: Vec3<R>, normal: Vec3<R>, direction: Vec3<R>, magnitude: R) -> Self {
        Self::spawn_to(Self::is_outward(normal, direction), point, normal, direction, magnitude)
    }

    /// `true` if a ray leaves a surface to the side of the normal.
    #[inline]
    pub(crate) fn is_outward(normal: Vec3<R>, direction: Vec3<R>) -> bool {
        !(normal.dot(direction) < R::ZERO)
    }

    /// [`spawn`](Self::spawn) for a known side: `outward` is the side of the normal.
    #[inline]
    pub(crate) fn spawn_to(
        outward: bool,
        point: Vec3<R>,
        normal: Vec3<R>,
        direction: Vec3<R>,
        magnitude: R,
    ) -> Self {
        let [x, y, z] = R::offset_along([normal.x, normal.y, normal.z], magnitude, outward);
        Self { origin: point + Vec3::new(x, y, z), direction }
    }
}
