//! A hull, simplified to a line with some radius, next to a ray.

use crate::math::{Ray, Real, Vec3};
use crate::shape::Hull;

/// A hull, simplified to a line with some radius: the line lies along the hull's longest axis.
pub(super) struct Stick<R> {
    center: Vec3<R>,
    /// Unit vector along the line; zero for a ball.
    along: Vec3<R>,
    half_length: R,
    radius: R,
}

/// How thick a thing is that reaches into a cone, next to the cone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Thickness {
    /// Thinner than the cone: pixels beside the traced one may see it, and the traced one may not.
    Thin,
    /// Thicker than the cone, or around one of the ends of the ray: it is seen anyway.
    Thick,
}

/// Whether one of the hulls of a shape is thin beside a ray, as `thickness` finds out, and at least
/// `slenderness` times as long as wide. The first hull encloses all others.
pub(super) fn any_thin<R: Real>(
    slenderness: R,
    mut hulls: impl Iterator<Item = Hull<R>>,
    thickness: impl Fn(&Stick<R>) -> Option<Thickness>,
) -> bool {
    let thickness_of = |hull: Hull<R>| {
        let stick = Stick::new(&hull);
        let thickness = thickness(&stick)?;
        Some(if stick.is_slender(slenderness) { thickness } else { Thickness::Thick })
    };
    match hulls.next().and_then(thickness_of) {
        None => false,
        Some(Thickness::Thin) => true,
        Some(Thickness::Thick) => hulls.any(|hull| thickness_of(hull) == Some(Thickness::Thin)),
    }
}

impl<R: Real> Stick<R> {
    pub(super) fn new(hull: &Hull<R>) -> Self {
        let (mut along, mut half_length, mut lengths) = (Vec3::ZERO, R::ZERO, R::ZERO);
        for axis in &hull.axes {
            // Most hulls have one axis; skip the others, as a root takes long.
            if *axis == Vec3::ZERO {
                continue;
            }
            let (unit, length) = axis.unit_and_length();
            lengths = lengths + length;
            if length > half_length {
                (along, half_length) = (unit, length);
            }
        }
        Self { center: hull.center, along, half_length, radius: hull.radius + (lengths - half_length) }
    }

    /// Whether it is at least `slenderness` times as long as wide.
    pub(super) fn is_slender(&self, slenderness: R) -> bool {
        self.half_length >= self.radius * slenderness
    }

    /// Whether it is thinner than this radius.
    pub(super) fn is_thinner(&self, radius: R) -> bool {
        self.radius < radius
    }

    /// The distance along a ray at which the line is nearest, and the way from there to the line.
    fn nearest(&self, ray: &Ray<R>) -> (R, Vec3<R>) {
        let mut toward = self.center - ray.origin;
        if self.half_length > R::ZERO {
            let cosine = self.along.dot(ray.direction);
            let sine_squared = R::ONE - cosine * cosine;
            // If the two are parallel, all places of the line are as near.
            let place = if sine_squared > R::from_f32(1e-3) {
                (cosine * toward.dot(ray.direction) - self.along.dot(toward)) / sine_squared
            } else {
                R::ZERO
            };
            toward = toward + self.along * place.larger(-self.half_length).smaller(self.half_length);
        }
        let t = toward.dot(ray.direction);
        (t, toward - ray.direction * t)
    }

    /// How thick it is beside a ray that ends at `distance`, within the cone that has `radius(t, direction)`
    /// at a distance from the ray's origin and into a unit direction; `None` if it does not reach into the
    /// cone.
    pub(super) fn thickness_beside(
        &self,
        ray: &Ray<R>,
        distance: R,
        radius: impl Fn(R, Vec3<R>) -> R,
    ) -> Option<Thickness> {
        let (t, across) = self.nearest(ray);
        // Leave out what lies behind the origin or beyond the end.
        let end = t + self.radius;
        if !(end > R::ZERO && t - self.radius < distance) {
            return None;
        }
        let (toward, away) = across.unit_and_length();
        let radius = radius(end.smaller(distance), toward);
        if !(away < self.radius + radius) {
            return None;
        }
        // The things at which the ray begins and ends are seen anyway.
        let is_between = t > R::ZERO && t < distance;
        Some(if is_between && self.radius < radius { Thickness::Thin } else { Thickness::Thick })
    }
}
