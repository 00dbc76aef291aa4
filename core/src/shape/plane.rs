//! An infinite plane.

use super::{Geometry, Intersect, project_onto_plane};
use crate::arena::Arena;
use crate::fault::{Fault, check_direction, check_point};
use crate::math::{Interval, Ray, Real, Vec3};
use crate::surface::Surface;

/// An infinite plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Any point of the plane.
    pub point: Vec3,
    /// Toward its front; any length but 0.
    pub normal: Vec3,
}

impl Plane {
    /// The plane through `point` across `normal`.
    pub const fn new(point: Vec3, normal: Vec3) -> Self {
        Self { point, normal }
    }
}

impl Geometry for Plane {
    type Prepared<'m, R: Real> = PreparedPlane<R>;

    fn prepare<'m, R: Real>(&self, _: &mut Arena<'m>) -> Result<PreparedPlane<R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.point)?;
        let normal: Vec3<R> = check_direction(self.normal)?;
        Ok(PreparedPlane { normal, distance: normal.dot(self.point.to()) })
    }
}

/// A [`Plane`], prepared: all points p with `normal · p = distance`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedPlane<R> {
    pub(super) normal: Vec3<R>,
    pub(super) distance: R,
}

impl<R: Real> Intersect<R> for PreparedPlane<R> {
    #[inline]
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let height = self.distance - self.normal.dot(ray.origin);
        let slope = self.normal.dot(ray.direction);
        // Only a ray that goes toward the plane reaches it, and only then is there something to divide by.
        let toward = (height > R::ZERO && slope > R::ZERO) || (height < R::ZERO && slope < R::ZERO);
        if !toward {
            return None;
        }
        let t = height / slope;
        range.contains(t).then_some(t)
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let point = project_onto_plane(ray.at(t), self.normal, self.distance);
        let magnitude = point.magnitude().larger(self.distance.abs());
        Surface { point, normal: self.normal, shading_normal: self.normal, magnitude }
    }
}
