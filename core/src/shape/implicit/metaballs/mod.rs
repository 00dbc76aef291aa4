//! Metaballs: a level set of a sum of smooth kernels (Wyvill, McPheeters and Wyvill, "Data structure for soft objects", The Visual
//! Computer, 1986; see [`kernel`]), found by sphere tracing (see [`sum`]).

mod kernel;
mod sum;
#[cfg(test)]
mod tests;

use super::super::{Geometry, Intersect, beside, uv};
use super::Room;
use super::trace::Line;
use kernel::{LEVEL, STEEPEST, reach_of};
use sum::{Body, PreparedBlob};

use crate::arena::Arena;
use crate::fault::{Fault, check_held, check_number, check_point, check_radius, check_size};
use crate::limits::MAX_BLOBS;
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// The box is so much larger than what it must hold: one that touched the surface would cut it open.
const MARGIN: f32 = 1.0 + 1.0 / 128.0;

/// One of the blobs that [`Metaballs`] are the sum of.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Blob {
    /// Where it is strongest.
    pub center: Vec3,
    /// How far it reaches: more than 0. By itself, with strength 1, it is a ball of half this radius.
    pub radius: f32,
    /// What it adds at its center: the surface is where the sum is 1/2. One that is negative takes away.
    pub strength: f32,
}

impl Blob {
    /// The blob that is, by itself, half as large as it reaches.
    pub const fn new(center: Vec3, radius: f32) -> Self {
        Self { center, radius, strength: 1.0 }
    }
}

/// Balls that flow into each other.
///
/// What is thinner than a [`MAX_TRACE_STEPS`](crate::limits::MAX_TRACE_STEPS)th of a ray's way through the box around them may be
/// missed. The shape is not [solid](Geometry::is_solid).
///
/// Its coordinates u and v are longitude and latitude, as seen from the middle of that box.
///
/// ```
/// use rayline::Vec3;
/// use rayline::shape::{Blob, Metaballs, Shape};
///
/// static DROPS: [Blob; 2] =
///     [Blob::new(Vec3::ZERO, 1.0), Blob::new(Vec3::new(0.75, 0.25, 0.0), 0.75)];
/// static WATER: Shape = Shape::Metaballs(Metaballs::new(&DROPS));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Metaballs<'a> {
    /// At most [`MAX_BLOBS`].
    pub blobs: &'a [Blob],
}

#[cfg(feature = "serde")]
crate::read::plain!(Blob);

#[cfg(feature = "serde")]
crate::read::read_struct!([] Metaballs as Metaballs<'m> { blobs });

impl<'a> Metaballs<'a> {
    /// The sum of these blobs.
    pub const fn new(blobs: &'a [Blob]) -> Self {
        Self { blobs }
    }

    pub(in crate::shape) const fn const_bytes<R: Real>(&self) -> usize {
        Arena::bytes::<PreparedBlob<R>>(self.blobs.len()).saturating_add(Arena::bytes::<Body<'_, R>>(1))
    }

    /// A box around the surface. At each of its points some blob adds at least its share of 1/2, of all that reach there: the
    /// point is no farther from that blob than where the kernel is as large.
    fn bounds<S: Real>(&self) -> Option<Aabb<S>> {
        let ball = |blob: &Blob| {
            let (center, radius) = (blob.center.to::<S>(), S::from_f32(blob.radius));
            let overlaps = |other: &Blob| {
                (other.center.to::<S>() - center).length() < radius + S::from_f32(other.radius)
            };
            let strengths = self.blobs.iter().filter(|other| other.strength > 0.0 && overlaps(other));
            let sum = strengths.fold(S::ZERO, |sum, other| sum + S::from_f32(other.strength));
            let reach = radius * reach_of(S::from_f32(LEVEL) / sum)? * S::from_f32(MARGIN);
            Some(Aabb::around(center, Vec3::new(reach, reach, reach)))
        };
        self.blobs.iter().filter(|blob| blob.strength > 0.0).filter_map(ball).reduce(Aabb::union)
    }
}

impl Geometry for Metaballs<'_> {
    type Prepared<'m, R: Real>
        = PreparedMetaballs<'m, R>
    where
        Self: 'm;

    fn bytes<R: Real>(&self) -> usize {
        self.const_bytes::<R>()
    }

    fn extent(&self) -> Extent {
        // Also of what takes away: it is computed with as well.
        let reach = |blob: &Blob| blob.center.magnitude() + blob.radius.abs();
        Extent::solid(self.blobs.iter().map(reach).fold(0.0, Real::larger))
    }

    fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedMetaballs<'m, R>, Fault>
    where
        Self: 'm,
    {
        if self.blobs.len() > MAX_BLOBS {
            return Err(Fault::TooManyBlobs { given: self.blobs.len() });
        }
        let (mut unit, mut sum) = (R::Setup::from_f32(f32::MAX), R::Setup::ZERO);
        for blob in self.blobs {
            check_point(blob.center)?;
            check_radius(blob.radius)?;
            check_number(blob.strength)?;
            let radius = R::Setup::from_f32(blob.radius);
            unit = if radius < unit { radius } else { unit };
            sum = sum + R::Setup::from_f32(blob.strength).abs();
        }
        check_size(scale.length::<R>(unit))?;
        // In fixed point slopes of 1.6 times as much are below 95, and so do their squares fit.
        check_held::<R>(sum)?;
        let bounds = self.bounds::<R::Setup>().ok_or(Fault::TooWeak)?;
        let room = Room::new(bounds, scale)?;
        let middle = bounds.center();
        let blobs = memory.try_store_with(self.blobs.len(), |index, _| {
            let blob = self.blobs.get(index).ok_or(Fault::TooWeak)?;
            let strength = R::Setup::from_f32(blob.strength);
            let radius: R = scale.length(R::Setup::from_f32(blob.radius));
            let slope = strength * unit / R::Setup::from_f32(blob.radius);
            Ok::<_, Fault>(PreparedBlob {
                center: scale.point(blob.center.to() - middle),
                radius,
                radius_squared: radius.times(radius),
                strength: R::from_setup(strength),
                slope: R::from_setup(slope),
                steepest: R::from_setup(slope.abs() * R::Setup::from_f32(STEEPEST)) + R::offset(R::ZERO),
            })
        })?;
        memory.store(Body { blobs, room, unit: scale.length(unit) }).map(PreparedMetaballs)
    }
}

/// [`Metaballs`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedMetaballs<'m, R: Real>(&'m Body<'m, R>);

impl<R: Real> Intersect<R> for PreparedMetaballs<'_, R> {
    // What it meets of all blobs takes most of a kilobyte: on no stack but its own.
    #[inline(never)]
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let Self(body) = self;
        let line = Line::new(ray, body.room.middle, body.room.radius)?;
        let mut parts = [None; MAX_BLOBS];
        let met = body.blobs.iter().filter_map(|blob| blob.part(&line));
        parts.iter_mut().zip(met).for_each(|(slot, part)| *slot = Some(part));
        line.first_crossing(body.room.half, range, body.room.tolerance(), |t| body.look(&parts, t))
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        Some(self.0.room.bounds())
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let Body { room, unit, .. } = *self.0;
        let at = ray.at(t) - room.middle;
        let (value, gradient) = self.0.slope(at);
        let (normal, length) = gradient.unit_and_length();
        let is_sloped = length > R::ZERO;
        let normal = if is_sloped { normal } else { -ray.direction };
        let distance = if is_sloped { value / length * unit } else { R::ZERO };
        Surface {
            point: room.middle + at - normal * room.step_back(distance),
            normal,
            shading_normal: normal,
            magnitude: room.magnitude,
            part: 0,
        }
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        beside(self, surface, step)
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        uv::globe(surface.point - self.0.room.middle)
    }
}
