//! A ray that is still to be traced.

use crate::math::Ray;
use crate::prepared::Departure;
use crate::prepared::ObjectSet;
use crate::probe::RayKind;
use crate::throughput::Throughput;

/// A ray that is still to be traced.
#[derive(Clone, Copy, Debug)]
// In this order, or copies wait for fields that were just written to reach memory.
#[repr(C)]
pub(super) struct PendingRay<R> {
    pub(super) ray: Ray<R>,
    /// The share of its light that reaches the pixel.
    pub(super) throughput: Throughput<R>,
    pub(super) bounces: u8,
    pub(super) kind: RayKind,
    /// The surface that the ray leaves; for a camera ray, none.
    pub(super) from: Departure,
    /// The objects that the ray can meet, where the scene has sets of objects.
    pub(super) among: ObjectSet,
}
