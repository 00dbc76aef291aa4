//! Distance fields: functions that bound the distance from a point to a surface (Hart 1996, definition 2).

use core::fmt::Debug;

use crate::fault::Fault;
use crate::math::{Real, Scale, Vec3};

/// The description of a distance field, in `f32`. An [`Implicit`](super::Implicit) shows its surface.
///
/// A field of your own joins a set of shapes like any other. Here is a box with round edges:
///
/// ```
/// use rayline::math::{Real, Scale};
/// use rayline::shape::{Distance, DistanceField, Implicit, Plane};
/// use rayline::{Fault, Vec3};
///
/// /// All points that are no farther than `rounding` from a cube around the origin.
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// pub struct Pebble {
///     half: f32,
///     rounding: f32,
/// }
///
/// /// [`Pebble`], prepared.
/// #[derive(Clone, Copy, Debug)]
/// pub struct PreparedPebble<R> {
///     half: R,
///     rounding: R,
/// }
///
/// impl DistanceField for Pebble {
///     type Prepared<R: Real> = PreparedPebble<R>;
///
///     fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedPebble<R>, Fault> {
///         let length = |length| scale.length(R::Setup::from_f32(length));
///         Ok(PreparedPebble { half: length(self.half), rounding: length(self.rounding) })
///     }
/// }
///
/// impl<R: Real> Distance<R> for PreparedPebble<R> {
///     fn distance(&self, point: Vec3<R>) -> R {
///         let beyond = |x: R| (x.abs() - self.half).larger(R::ZERO);
///         Vec3::new(beyond(point.x), beyond(point.y), beyond(point.z)).length() - self.rounding
///     }
/// }
///
/// rayline::shape_set! {
///     /// A pebble on a floor.
///     pub enum Beach;
///     /// `Beach`, prepared.
///     pub enum PreparedBeach {
///         /// The pebble.
///         Pebble(Implicit<Pebble>),
///         /// The floor.
///         Floor(Plane),
///     }
/// }
///
/// let corner = Vec3::new(1.0, 1.0, 1.0);
/// let pebble = Implicit { field: Pebble { half: 0.75, rounding: 0.25 }, min: -corner, max: corner };
/// let _shape = Beach::Pebble(pebble);
/// ```
pub trait DistanceField: Copy + Debug {
    /// The prepared form in the number system `R`.
    type Prepared<R: Real>: Distance<R> + Copy + Debug + Send + Sync;

    /// Checks every number, scales the field and converts it.
    ///
    /// # Errors
    /// A [`Fault`] that says what is wrong with the description.
    fn prepare<R: Real>(&self, scale: Scale) -> Result<Self::Prepared<R>, Fault>;
}

/// A prepared distance field.
pub trait Distance<R: Real> {
    /// A lower bound of the distance from a point to the surface; negative inside. Point and distance are in
    /// scaled units.
    ///
    /// Between two points the result must not change by more than their distance, or rays may go through the
    /// surface. In fixed point all points lie within 1/2 of the origin along each axis, or a little beyond;
    /// sum squares by [`length`](Vec3::length) or [`dot_wide`](Vec3::dot_wide), which keep their digits.
    fn distance(&self, point: Vec3<R>) -> R;
}
