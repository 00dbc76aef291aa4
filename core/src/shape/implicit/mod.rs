//! Implicit surfaces: all points where a function of space is zero. Rays find them by sphere tracing (Hart,
//! "Sphere Tracing: A Geometric Method for the Antialiased Ray Tracing of Implicit Surfaces", The Visual
//! Computer, 1996; see [`trace`]).

mod field;
mod metaballs;
#[cfg(test)]
mod tests;
mod trace;

use super::marching::Lattice;
use super::{Facet, Geometry, Intersect, Silhouette, Tessellation, normal_after_step, uv};
use crate::arena::Arena;
use crate::fault::{Fault, check_point, check_size};
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;
use trace::TracedLine;

pub use field::{Distance, DistanceField};
pub use metaballs::{Blob, Metaballs, PreparedMetaballs};

/// The part of a distance field's surface in a box.
///
/// A ray takes at most [`MAX_TRACE_STEPS`](crate::limits::MAX_TRACE_STEPS) steps through the box. Parts that
/// are thinner than this share of its way may be missed, so make the box tight, but do not let it touch the
/// surface: where the box cuts the surface, the shape is open. Normals are computed from differences over a
/// 256th of the box. So edges look rounded by that much, and a ray that leaves an edge may meet the surface
/// again. The shape is not [solid](Geometry::is_solid).
///
/// The coordinates u and v are longitude and latitude, as seen from the middle of the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Implicit<F> {
    /// The distance field: the surface is where it is 0.
    pub field: F,
    /// The corner of the box with the smallest coordinates.
    pub min: Vec3,
    /// The corner of the box with the largest coordinates.
    pub max: Vec3,
}

impl<F: DistanceField> Implicit<F> {
    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
        0
    }
}

impl<F: DistanceField> Geometry for Implicit<F> {
    type Prepared<'m, R: Real>
        = PreparedImplicit<F::Prepared<R>, R>
    where
        Self: 'm;

    fn extent(&self) -> Extent {
        Extent::solid(self.min.magnitude().larger(self.max.magnitude()))
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, _: &mut Arena<'m>) -> Result<Self::Prepared<'m, R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.min)?;
        check_point(self.max)?;
        let room = FieldBox::new(Aabb { min: self.min.to(), max: self.max.to() }, scale)?;
        Ok(PreparedImplicit { field: self.field.prepare(scale)?, room })
    }
}

/// The box around an implicit surface.
#[derive(Clone, Copy, Debug, PartialEq)]
struct FieldBox<R> {
    middle: Vec3<R>,
    /// Half of each side.
    half: Vec3<R>,
    /// The distance from the middle to the corners.
    radius: R,
    /// The largest absolute coordinate.
    magnitude: R,
}

impl<R: Real> FieldBox<R> {
    fn new(bounds: Aabb<R::Setup>, scale: Scale) -> Result<Self, Fault> {
        let half = (bounds.max - bounds.min) * R::Setup::from_f32(0.5);
        for reach in [half.x, half.y, half.z] {
            if !(reach > R::Setup::ZERO) {
                return Err(Fault::NoVolume);
            }
            check_size(scale.length::<R>(reach))?;
        }
        Ok(Self {
            middle: scale.point(bounds.center()),
            half: scale.point(half),
            radius: scale.length(half.length()),
            magnitude: scale.length(bounds.magnitude()),
        })
    }

    fn bounds(&self) -> Aabb<R> {
        Aabb::around(self.middle, self.half).padded(R::offset(self.magnitude))
    }

    /// The accuracy of a hit: a sixteenth of the offset of a spawned ray, which is far above rounding.
    fn tolerance(&self) -> R {
        R::offset(self.magnitude) * R::from_fraction(1 << 12)
    }

    /// The step from a hit back to the surface, which is `distance` away along the normal. A step that is
    /// longer than the rounding of a hit would be wrong: then it is 0.
    fn step_back(&self, distance: R) -> R {
        let longest = R::offset(self.magnitude) * R::from_fraction(1 << 15);
        if distance.abs() <= longest { distance } else { R::ZERO }
    }
}

/// An [`Implicit`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedImplicit<D, R> {
    field: D,
    room: FieldBox<R>,
}

impl<D: Distance<R>, R: Real> PreparedImplicit<D, R> {
    /// The direction of the gradient, by central differences over a 256th of the box, or over 4 offsets of
    /// spawned rays if that is more; `None` if the field does not change there.
    fn normal(&self, point: Vec3<R>) -> Option<Vec3<R>> {
        let share = self.room.radius * R::from_fraction(1 << 8);
        let step = share.larger(R::offset(self.room.magnitude) * R::from_u16(4));
        let (none, field) = (R::ZERO, &self.field);
        let across = |step: Vec3<R>| field.distance(point + step) - field.distance(point - step);
        let difference = Vec3::new(
            across(Vec3::new(step, none, none)),
            across(Vec3::new(none, step, none)),
            across(Vec3::new(none, none, step)),
        );
        difference.normalized()
    }
}

impl<D: Distance<R>, R: Real> Intersect<R> for PreparedImplicit<D, R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let FieldBox { middle, half, radius, .. } = self.room;
        let line = TracedLine::new(ray, middle, radius)?;
        line.first_crossing(half, range, self.room.tolerance(), |t| {
            let distance = self.field.distance(middle + line.at(t));
            (distance, distance.abs())
        })
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        Some(self.room.bounds())
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let at = ray.at(t);
        let normal = self.normal(at).unwrap_or(-ray.direction);
        let point = at - normal * self.room.step_back(self.field.distance(at));
        Surface { point, normal, shading_normal: normal, magnitude: self.room.magnitude, part: 0 }
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        uv::globe(surface.point - self.room.middle)
    }
}

impl<D: Distance<R>, R: Real> Silhouette<R> for PreparedImplicit<D, R> {
    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let is_inside = |point: Vec3<R>| self.field.distance(point) < R::ZERO;
        // The box may cut the surface open.
        let lattice = Lattice::within(self.room.bounds(), tessellation);
        lattice.each_facet(self, false, |row| row.each(is_inside), visit);
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        normal_after_step(self, surface, step)
    }
}
