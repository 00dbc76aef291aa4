//! An infinite plane.

use super::{Form, Geometry, Intersect, project_onto_plane};
use crate::arena::Arena;
use crate::fault::{Fault, check_direction, check_point};
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
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

    fn extent(&self) -> Extent {
        let normal = check_direction::<f32>(self.normal).unwrap_or(Vec3::ZERO);
        Extent::plane(normal.dot(self.point).abs())
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, _: &mut Arena<'m>) -> Result<PreparedPlane<R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.point)?;
        let normal = check_direction(self.normal)?;
        Ok(PreparedPlane::new(normal, normal.dot(self.point.to()), scale))
    }
}

/// A [`Plane`], prepared: all points p with `normal · p = distance`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedPlane<R> {
    pub(super) normal: Vec3<R>,
    pub(super) distance: R,
}

impl<R: Real> PreparedPlane<R> {
    /// The plane with this unit normal and distance in the scene's units.
    pub(super) fn new(normal: Vec3<R::Setup>, distance: R::Setup, scale: Scale) -> Self {
        Self { normal: Vec3::from_setup(normal), distance: scale.length(distance) }
    }

    /// The distance at which a ray meets the plane.
    #[inline]
    pub(super) fn meet(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
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
}

impl<R: Real> Intersect<R> for PreparedPlane<R> {
    #[inline]
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let t = self.meet(ray, range)?;
        // The next ray begins there, so it must be a place that can be computed with.
        let held = R::REACH.is_none_or(|reach| ray.at(t).magnitude() < R::from_f32(reach));
        held.then_some(t)
    }

    fn form(&self) -> Form<R> {
        Form::Flat { normal: self.normal, distance: self.distance }
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        None
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let point = project_onto_plane(ray.at(t), self.normal, self.distance);
        let magnitude = point.magnitude().larger(self.distance.abs());
        Surface { point, normal: self.normal, shading_normal: self.normal, magnitude, part: 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;

    const FLOOR: Plane = Plane::new(Vec3::new(7.0, -1.0, 3.0), Vec3::new(0.0, 5.0, 0.0));

    #[test]
    fn met_from_both_sides() {
        assert_meets(FLOOR, Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, -1.0, 0.0), 3.0, [0.0, 1.0, 0.0]);
        assert_meets(FLOOR, Vec3::new(0.0, -4.0, 0.0), Vec3::new(0.0, 1.0, 0.0), 3.0, [0.0, 1.0, 0.0]);
        let slant = Vec3::new(3.0, -4.0, 0.0);
        assert_meets(FLOOR, Vec3::new(0.0, 3.0, 0.0), slant, 5.0, [0.0, 1.0, 0.0]);
    }

    #[test]
    fn missed_behind_and_along() {
        assert_misses(FLOOR, Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
        assert_misses(FLOOR, Vec3::new(0.0, 2.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
        assert_misses(FLOOR, Vec3::new(0.0, -1.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            let point = Vec3::new(0.3, -0.7, 0.2) * extent;
            assert_no_self_hits(Plane::new(point, Vec3::new(0.3, 0.9, -0.2)), point, extent, 20_000);
        }
    }

    #[test]
    fn bad_planes_are_refused() {
        assert_eq!(refusal(Plane { normal: Vec3::ZERO, ..FLOOR }), Fault::ZeroLength);
        assert_eq!(refusal(Plane { normal: Vec3::new(0.0, f32::NAN, 1.0), ..FLOOR }), Fault::NotFinite);
        assert_eq!(refusal(Plane { point: Vec3::new(0.0, -3e6, 1.0), ..FLOOR }), Fault::TooFar);
    }

    #[test]
    fn a_tiny_normal_is_a_direction() {
        let floor = Plane::new(Vec3::ZERO, Vec3::new(0.0, 1e-30, 0.0));
        assert_meets(floor, Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, -1.0, 0.0), 2.0, [0.0, 1.0, 0.0]);
    }
}
