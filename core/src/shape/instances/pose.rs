//! The place and the rotation of an instance.

use super::super::{Bend, Facet, Hull, Rim, Tip, bounds_of};
use crate::fault::{Fault, check_numbers, check_point};
use crate::math::{Aabb, Ray, Real, Rotation, Scale, Vec3};
use crate::surface::Surface;

/// The place and the rotation of an instance. The model is first turned about its origin, then moved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Pose {
    /// The angles by which the model is turned about the x axis, then about y, then about z; in radians,
    /// counterclockwise as seen from the positive end of the axis.
    #[cfg_attr(feature = "serde", serde(default = "unturned"))]
    pub rotation: Vec3,
    /// The place of the model's origin.
    pub origin: Vec3,
}

#[cfg(feature = "serde")]
const fn unturned() -> Vec3 {
    Vec3::ZERO
}

#[cfg(feature = "serde")]
crate::read::plain!(Pose);

impl Pose {
    /// Upright, with the model's origin at this point.
    pub const fn at(origin: Vec3) -> Self {
        Self { rotation: Vec3::ZERO, origin }
    }

    /// The same place with this rotation.
    pub const fn turned(self, rotation: Vec3) -> Self {
        Self { rotation, ..self }
    }

    /// Refuses numbers that are not finite, and origins that are too far away.
    pub(super) fn check(&self) -> Result<(), Fault> {
        check_numbers(self.rotation)?;
        check_point(self.origin)
    }

    /// The largest absolute coordinate of a cube of this half side around the model's origin, as it stands in
    /// the scene.
    pub(super) fn reach(&self, half: f32) -> f32 {
        let rotation = Rotation::<f32>::new(self.rotation);
        let most = |toward: Vec3| (toward.x.abs() + toward.y.abs() + toward.z.abs()) * half;
        let Vec3 { x, y, z } = self.origin;
        let [one, two, three] = rotation.rows();
        (x.abs() + most(one)).larger(y.abs() + most(two)).larger(z.abs() + most(three))
    }

    pub(super) fn prepare<R: Real>(&self, scale: Scale) -> PreparedPose<R> {
        let rotation = Rotation::<R::Setup>::new(self.rotation);
        PreparedPose { rotation: rotation.rounded(), origin: scale.point(self.origin.to()) }
    }
}

/// A [`Pose`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PreparedPose<R> {
    rotation: Rotation<R>,
    origin: Vec3<R>,
}

impl<R: Real> PreparedPose<R> {
    /// Transforms a ray from the scene to the model. Distances along it stay the same.
    #[inline]
    pub(super) fn inward(&self, ray: &Ray<R>) -> Ray<R> {
        Ray {
            origin: self.rotation.back(ray.origin - self.origin),
            direction: self.rotation.back(ray.direction),
        }
    }

    /// Transforms a direction from the model to the scene.
    pub(super) fn turn(&self, direction: Vec3<R>) -> Vec3<R> {
        self.rotation.turn(direction)
    }

    /// Transforms a direction from the scene to the model.
    pub(super) fn turn_back(&self, direction: Vec3<R>) -> Vec3<R> {
        self.rotation.back(direction)
    }

    /// Transforms a point from the model to the scene.
    fn point(&self, point: Vec3<R>) -> Vec3<R> {
        self.rotation.turn(point) + self.origin
    }

    /// Transforms a surface from the model to the scene.
    pub(super) fn outward(&self, surface: Surface<R>) -> Surface<R> {
        let point = self.point(surface.point);
        Surface {
            point,
            normal: self.rotation.turn(surface.normal),
            shading_normal: self.rotation.turn(surface.shading_normal),
            magnitude: surface.magnitude.larger(self.origin.magnitude()).larger(point.magnitude()),
            part: surface.part,
        }
    }

    /// Transforms a surface from the scene to the model.
    pub(super) fn inward_surface(&self, surface: &Surface<R>) -> Surface<R> {
        Surface {
            point: self.rotation.back(surface.point - self.origin),
            normal: self.rotation.back(surface.normal),
            shading_normal: self.rotation.back(surface.shading_normal),
            ..*surface
        }
    }

    /// The bounds of the transformed box `around`.
    pub(super) fn bounds(&self, around: Aabb<R>) -> Option<Aabb<R>> {
        bounds_of(around.corners().map(|corner| self.point(corner)))
    }

    /// Transforms a hull from the model to the scene.
    pub(super) fn hull(&self, hull: Hull<R>) -> Hull<R> {
        let axes = hull.axes.map(|axis| self.rotation.turn(axis));
        Hull { center: self.point(hull.center), axes, ..hull }
    }

    /// Transforms a rim from the model to the scene.
    pub(super) fn rim(&self, rim: Rim<R>) -> Rim<R> {
        let bend = match rim.bend {
            Bend::Smooth(normals) => Bend::Smooth(normals.map(|normal| self.rotation.turn(normal))),
            sharp => sharp,
        };
        Rim { ends: rim.ends.map(|end| self.point(end)), bend }
    }

    /// Transforms a facet from the model to the scene.
    pub(super) fn facet(&self, facet: &Facet<R>) -> Facet<R> {
        Facet {
            corners: facet.corners.map(|corner| self.point(corner)),
            normals: facet.normals.map(|normal| self.rotation.turn(normal)),
            ..*facet
        }
    }

    /// Transforms a tip from the model to the scene.
    pub(super) fn tip(&self, tip: Tip<R>) -> Tip<R> {
        Tip { apex: self.point(tip.apex), ends: tip.ends.map(|end| self.point(end)), ..tip }
    }
}
