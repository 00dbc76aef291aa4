//! Metaballs: all points where a sum of smooth kernels has a given value (Wyvill, McPheeters and Wyvill,
//! "Data structure for soft objects", The Visual Computer, 1986; see [`kernel`]). Rays find them by sphere
//! tracing (see [`sum`]).

mod kernel;
mod sum;
#[cfg(test)]
mod tests;

use super::super::marching::Lattice;
use super::super::{Facet, Geometry, Intersect, Silhouette, Tessellation, normal_after_step, uv};
use super::FieldBox;
use super::trace::TracedLine;
use kernel::{LEVEL, STEEPEST, reach_of};
use sum::{BlobSum, PreparedBlob};

use crate::arena::Arena;
use crate::fault::{Fault, check_held, check_number, check_point, check_radius, check_size};
use crate::limits::MAX_BLOBS;
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// The factor by which the box is larger than the surface: a box that touched the surface would cut it open.
const MARGIN: f32 = 1.0 + 1.0 / 128.0;

/// One of the blobs whose sum are [`Metaballs`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Blob {
    /// The point where the blob is strongest.
    pub center: Vec3,
    /// How far the blob reaches: more than 0. Alone, with strength 1, it looks like a ball of half this
    /// radius.
    pub radius: f32,
    /// The value that the blob adds at its center; if negative, the blob subtracts. The surface is where the
    /// sum of all blobs is 1/2.
    pub strength: f32,
}

impl Blob {
    /// A blob of strength 1: alone, it looks like a ball of half this radius.
    pub const fn new(center: Vec3, radius: f32) -> Self {
        Self { center, radius, strength: 1.0 }
    }
}

/// Balls that flow into each other.
///
/// Parts that are thinner than a [`MAX_TRACE_STEPS`](crate::limits::MAX_TRACE_STEPS)th of a ray's way through
/// the box around the blobs may be missed. The shape is not [solid](Geometry::is_solid).
///
/// The coordinates u and v are longitude and latitude, as seen from the middle of that box.
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
    /// The blobs: at most [`MAX_BLOBS`].
    pub blobs: &'a [Blob],
}

#[cfg(feature = "serde")]
crate::read::plain!(Blob);

#[cfg(feature = "serde")]
crate::read::read_struct!([] Metaballs as Metaballs<'m> { blobs });

impl<'a> Metaballs<'a> {
    /// The surface of the sum of these blobs.
    pub const fn new(blobs: &'a [Blob]) -> Self {
        Self { blobs }
    }

    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
        Arena::bytes::<PreparedBlob<R>>(self.blobs.len()).saturating_add(Arena::bytes::<BlobSum<'_, R>>(1))
    }

    /// A box around the surface; `None` if there is no surface.
    ///
    /// At each point of the surface the sum is 1/2, so some blob there has a kernel of at least 1/2 divided
    /// by the strengths of all positive blobs that reach the same place. The box contains, for each blob, the
    /// ball in which the kernel is that large.
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
        // Blobs that subtract count, too, as their numbers are computed with.
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
        // In fixed point slopes, which are up to 1.6 times as large, then stay below 95, and their squares in
        // range.
        check_held::<R>(sum)?;
        let bounds = self.bounds::<R::Setup>().ok_or(Fault::TooWeak)?;
        let room = FieldBox::new(bounds, scale)?;
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
        memory.store(BlobSum { blobs, room, unit: scale.length(unit) }).map(PreparedMetaballs)
    }
}

/// [`Metaballs`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedMetaballs<'m, R: Real>(&'m BlobSum<'m, R>);

impl<R: Real> Intersect<R> for PreparedMetaballs<'_, R> {
    // Not inlined: the chords of all blobs take most of a kilobyte of stack, which other shapes should not
    // pay for.
    #[inline(never)]
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let Self(sum) = self;
        let line = TracedLine::new(ray, sum.room.middle, sum.room.radius)?;
        let mut chords = [None; MAX_BLOBS];
        let met = sum.blobs.iter().filter_map(|blob| blob.chord(&line));
        chords.iter_mut().zip(met).for_each(|(slot, chord)| *slot = Some(chord));
        line.first_crossing(sum.room.half, range, sum.room.tolerance(), |t| sum.look(&chords, t))
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        Some(self.0.room.bounds())
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let BlobSum { room, unit, .. } = *self.0;
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

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        uv::globe(surface.point - self.0.room.middle)
    }
}

impl<R: Real> Silhouette<R> for PreparedMetaballs<'_, R> {
    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let Self(sum) = self;
        let is_inside = |point: Vec3<R>| sum.slope(point - sum.room.middle).0 < R::ZERO;
        let lattice = Lattice::around(sum.room.bounds(), tessellation);
        lattice.each_facet(self, true, |row| row.each(is_inside), visit);
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        normal_after_step(self, surface, step)
    }
}
