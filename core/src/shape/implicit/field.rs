//! What a shape is that only tells how far away it is: a signed distance bound (Hart 1996, definition 2).

use core::fmt::Debug;

use crate::fault::Fault;
use crate::math::{Real, Scale, Vec3};

/// The description of a distance field, in `f32`: what an [`Implicit`](super::Implicit) shows.
///
/// A field of your own joins a set of shapes like any other. Here is a box with round edges:
///
/// ```
/// use rayline::math::{Real, Scale};
/// use rayline::shape::{Distance, DistanceField, Implicit, Plane};
/// use rayline::{Fault, Vec3};
///
/// /// All that is no farther than `rounding` from a cube around the origin.
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
    /// What the description becomes in the number system `R`.
    type Prepared<R: Real>: Distance<R> + Copy + Debug + Send + Sync;

    /// Checks every number, scales it and converts it.
    ///
    /// # Errors
    /// A [`Fault`] that says what is wrong with the description.
    fn prepare<R: Real>(&self, scale: Scale) -> Result<Self::Prepared<R>, Fault>;
}

/// A distance field, prepared.
pub trait Distance<R: Real> {
    /// How far a point is from the surface, at least, and negative inside.
    ///
    /// Point and distance are in units after scaling. Between two points it must not change by more than the way from the one to
    /// the other: where it does, rays go through the surface. In fixed point all points lie within 1/2 of
    /// the origin along each axis, and a little beyond: squares are to be summed by
    /// [`length`](Vec3::length) or [`dot_wide`](Vec3::dot_wide), which keep their digits.
    fn distance(&self, point: Vec3<R>) -> R;
}
