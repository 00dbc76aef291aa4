//! Where an instance stands, and how it is turned.

use super::super::{Bend, Hull, Rim, Tip, bounds_of};
use crate::fault::{Fault, check_numbers, check_point};
use crate::math::{Aabb, Ray, Real, Rotation, Scale, Vec3};
use crate::surface::Surface;

/// Where an instance stands, and how it is turned: about its model's origin first, then moved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Pose {
    /// By which angles it is turned about the x axis, then about y, then about z; in radians, counterclockwise as seen
    /// from the axis' end.
    #[cfg_attr(feature = "serde", serde(default = "unturned"))]
    pub rotation: Vec3,
    /// Where the model's origin is.
    pub origin: Vec3,
}

#[cfg(feature = "serde")]
const fn unturned() -> Vec3 {
    Vec3::ZERO
}

#[cfg(feature = "serde")]
crate::read::plain!(Pose);

impl Pose {
    /// Upright, with the model's origin there.
    pub const fn at(origin: Vec3) -> Self {
        Self { rotation: Vec3::ZERO, origin }
    }

    /// The same, turned.
    pub const fn turned(self, rotation: Vec3) -> Self {
        Self { rotation, ..self }
    }

    pub(super) fn check(&self) -> Result<(), Fault> {
        check_numbers(self.rotation)?;
        check_point(self.origin)
    }

    /// How far from the scene's origin what lies in the model's box of this half side is, along any axis.
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
    /// The ray where the model is. Distances along it are the same.
    #[inline(always)]
    pub(super) fn inward(&self, ray: &Ray<R>) -> Ray<R> {
        Ray {
            origin: self.rotation.back(ray.origin - self.origin),
            direction: self.rotation.back(ray.direction),
        }
    }

    /// A direction of the model where the instance is.
    pub(super) fn turn(&self, direction: Vec3<R>) -> Vec3<R> {
        self.rotation.turn(direction)
    }

    /// The way back.
    pub(super) fn turn_back(&self, direction: Vec3<R>) -> Vec3<R> {
        self.rotation.back(direction)
    }

    fn point(&self, point: Vec3<R>) -> Vec3<R> {
        self.rotation.turn(point) + self.origin
    }

    /// A surface of the model where the instance is.
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

    /// The way back.
    pub(super) fn inward_surface(&self, surface: &Surface<R>) -> Surface<R> {
        Surface {
            point: self.rotation.back(surface.point - self.origin),
            normal: self.rotation.back(surface.normal),
            shading_normal: self.rotation.back(surface.shading_normal),
            ..*surface
        }
    }

    /// A box around the model's box.
    pub(super) fn bounds(&self, around: Aabb<R>) -> Option<Aabb<R>> {
        bounds_of(around.corners().map(|corner| self.point(corner)))
    }

    pub(super) fn hull(&self, hull: Hull<R>) -> Hull<R> {
        let axes = hull.axes.map(|axis| self.rotation.turn(axis));
        Hull { center: self.point(hull.center), axes, ..hull }
    }

    pub(super) fn rim(&self, rim: Rim<R>) -> Rim<R> {
        let bend = match rim.bend {
            Bend::Smooth(normals) => Bend::Smooth(normals.map(|normal| self.rotation.turn(normal))),
            sharp => sharp,
        };
        Rim { ends: rim.ends.map(|end| self.point(end)), bend }
    }

    pub(super) fn tip(&self, tip: Tip<R>) -> Tip<R> {
        Tip { apex: self.point(tip.apex), ends: tip.ends.map(|end| self.point(end)), ..tip }
    }
}
