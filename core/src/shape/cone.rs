//! A cone or frustum, by the quadratic equation of its radius along the axis (Heckbert in Glassner (ed.), "An
//! Introduction to Ray Tracing", 1989, ch. 2), solved without cancellation (Press et al., "Numerical Recipes",
//! §5.6).

use super::{Geometry, Intersect};
use crate::arena::Arena;
use crate::fault::{Fault, check_coordinate, check_point, unit};
use crate::math::{Interval, Ray, Real, Vec3};
use crate::surface::Surface;

/// A cone, or the frustum of one, between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The middle of one end.
    pub base: Vec3,
    /// Radius there, 0 or more.
    pub base_radius: f32,
    /// The middle of the other end.
    pub top: Vec3,
    /// Radius there, 0 or more; one of the two is more than 0.
    pub top_radius: f32,
    /// Whether discs close the ends; without, it is a cone without thickness.
    pub capped: bool,
}

impl Geometry for Cone {
    type Prepared<'m, R: Real> = PreparedCone<R>;

    fn prepare<'m, R: Real>(&self, _: &mut Arena<'m>) -> Result<PreparedCone<R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.base)?;
        check_point(self.top)?;
        check_coordinate(self.base_radius)?;
        check_coordinate(self.top_radius)?;
        if self.base_radius < 0.0 || self.top_radius < 0.0 || self.base_radius + self.top_radius <= 0.0 {
            return Err(Fault::RadiusNotPositive);
        }
        let axis: Vec3<R> = unit(self.top - self.base)?;
        let base: Vec3<R> = self.base.to();
        let length = (self.top.to() - base).length();
        let base_radius = R::from_f32(self.base_radius);
        let slope = (R::from_f32(self.top_radius) - base_radius) / length;
        Ok(PreparedCone {
            base,
            axis,
            length,
            base_radius,
            slope,
            steepness: R::ONE + slope * slope,
            magnitude: base.magnitude() + length + base_radius.larger(R::from_f32(self.top_radius)),
            capped: self.capped,
        })
    }
}

/// A [`Cone`] or [`Cylinder`](super::Cylinder), prepared: the radius at height h along the axis is
/// `base_radius + slope · h`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedCone<R> {
    base: Vec3<R>,
    axis: Vec3<R>,
    length: R,
    base_radius: R,
    slope: R,
    /// 1 + slope²
    steepness: R,
    magnitude: R,
    capped: bool,
}

impl<R: Real> PreparedCone<R> {
    /// The nearest hit of the side. `start` lies on the ray at distance `advance` from its origin.
    fn intersect_side(
        &self,
        start: Vec3<R>,
        advance: R,
        direction: Vec3<R>,
        range: Interval<R>,
    ) -> Option<R> {
        let from_base = start - self.base;
        let height = from_base.dot(self.axis);
        let climb = direction.dot(self.axis);
        let radius = self.base_radius + self.slope * height;
        // Distance from the axis, squared, less the cone's radius there, squared: a t² + 2 b t + c.
        let a = R::ONE - self.steepness * climb * climb;
        let b = from_base.dot(direction) - height * climb - self.slope * climb * radius;
        let across = from_base - self.axis * height;
        let c = across.length_squared() - radius * radius;
        let discriminant = b * b - a * c;
        if !(discriminant > R::ZERO) {
            return None;
        }
        let root = discriminant.sqrt();
        let q = if b > R::ZERO { -b - root } else { root - b };
        // q is zero only if b and the discriminant are. Along a line of the cone a is next to 0 and q / a is
        // far away; without floats it might not be representable.
        let one = c / q;
        let other = if a.abs() > R::RAY_OFFSET * R::RAY_OFFSET { q / a } else { one };
        let on_side = |t: R| {
            let at = height + climb * t;
            // Beyond its apex the quadratic describes a second cone: there the radius is negative.
            at >= R::ZERO && at <= self.length && self.base_radius + self.slope * at >= R::ZERO
        };
        let mut nearest = None;
        let mut range = range;
        for t in [one, other] {
            if on_side(t) && range.contains(t + advance) {
                range.max = t + advance;
                nearest = Some(t + advance);
            }
        }
        nearest
    }

    /// The nearest hit of the discs at the ends.
    fn intersect_caps(
        &self,
        start: Vec3<R>,
        advance: R,
        direction: Vec3<R>,
        range: Interval<R>,
    ) -> Option<R> {
        let climb = direction.dot(self.axis);
        if climb == R::ZERO {
            return None;
        }
        let from_base = start - self.base;
        let height = from_base.dot(self.axis);
        let mut nearest = None;
        let mut range = range;
        for end in [R::ZERO, self.length] {
            // Compare before dividing: a disc that is many units away for a ray along it is not met.
            let t = (end - height) / climb;
            if range.contains(t + advance) {
                let across = from_base + direction * t - self.axis * end;
                let radius = self.base_radius + self.slope * end;
                if across.length_squared() < radius * radius {
                    range.max = t + advance;
                    nearest = Some(t + advance);
                }
            }
        }
        nearest
    }
}

impl<R: Real> Intersect<R> for PreparedCone<R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        // Start from the point of the ray nearest to the base: the coefficients stay of the cone's own size,
        // however far away the ray begins.
        let advance = (self.base - ray.origin).dot(ray.direction);
        let start = ray.at(advance);
        let side = self.intersect_side(start, advance, ray.direction, range);
        if !self.capped {
            return side;
        }
        let range = Interval { max: side.unwrap_or(range.max), ..range };
        self.intersect_caps(start, advance, ray.direction, range).or(side)
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let point = ray.at(t);
        let height = (point - self.base).dot(self.axis);
        let across = point - self.base - self.axis * height;
        let radius = self.base_radius + self.slope * height;
        let distance = across.length();
        // Of the side and the two discs, the hit belongs to the one that it is nearest to.
        let from_side = (distance - radius).abs();
        let (from_base, from_top) = (height.abs(), (height - self.length).abs());
        let (point, normal) = if self.capped && from_base < from_side && from_base <= from_top {
            (self.base + across, -self.axis)
        } else if self.capped && from_top < from_side {
            (self.base + self.axis * self.length + across, self.axis)
        } else {
            let outward = across.normalized().unwrap_or(self.axis);
            let normal = (outward - self.axis * self.slope).normalized().unwrap_or(outward);
            (self.base + self.axis * height + outward * radius, normal)
        };
        Surface { point, normal, shading_normal: normal, magnitude: self.magnitude }
    }
}
