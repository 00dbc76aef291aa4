//! The sum of all blobs along a ray, and how far it surely keeps its sign.
//!
//! Along a ray the sum of what the blobs add changes no faster than the sum of their steepest slopes, over the blobs that the ray
//! is in.

use super::super::Room;
use super::super::trace::Line;
use super::kernel::{LEVEL, kernel, slope};
use crate::math::{Interval, Product, Real, Vec3};

/// One of the blobs, prepared: all are taken from the middle of the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PreparedBlob<R: Real> {
    pub(super) center: Vec3<R>,
    pub(super) radius: R,
    pub(super) radius_squared: R::Product,
    pub(super) strength: R,
    /// Strength over radius, where the smallest radius is 1.
    pub(super) slope: R,
    /// It adds no more than this along the smallest radius.
    pub(super) steepest: R,
}

/// What a ray meets of a blob.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<'m, R: Real> {
    blob: &'m PreparedBlob<R>,
    /// Where along the line it is nearest, and how near, squared.
    middle: R,
    distance: R::Product,
    /// Where the line enters and leaves it.
    inside: Interval<R>,
}

impl<R: Real> PreparedBlob<R> {
    pub(super) fn part(&self, line: &Line<R>) -> Option<Part<'_, R>> {
        let middle = line.along(self.center);
        let nearest = line.at(middle) - self.center;
        let distance = nearest.length_squared_wide();
        let rest = self.radius_squared - distance;
        (rest > R::Product::ZERO).then(|| {
            let half = rest.sqrt();
            Part { blob: self, middle, distance, inside: Interval { min: middle - half, max: middle + half } }
        })
    }

    /// The squared share of its radius, at this squared distance; `None` beyond it.
    fn share(&self, distance: R::Product) -> Option<R> {
        (distance < self.radius_squared).then(|| distance.share(self.radius_squared))
    }
}

/// All of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Body<'m, R: Real> {
    pub(super) blobs: &'m [PreparedBlob<R>],
    pub(super) room: Room<R>,
    /// The smallest radius.
    pub(super) unit: R,
}

impl<R: Real> Body<'_, R> {
    /// How much the sum is below that of the surface, and how far it surely remains so, or above.
    pub(super) fn look(&self, parts: &[Option<Part<'_, R>>], t: R) -> (R, R) {
        let (mut value, mut steepest, mut next) = (R::from_f32(LEVEL), R::ZERO, R::FARTHEST);
        for part in parts.iter().map_while(Option::as_ref) {
            let Part { blob, middle, distance, inside } = part;
            if t < inside.min {
                next = if inside.min - t < next { inside.min - t } else { next };
            } else if t < inside.max {
                steepest = steepest + blob.steepest;
                let along = t - *middle;
                if let Some(q) = blob.share(*distance + along.times(along)) {
                    value = value - blob.strength * kernel(q);
                }
            }
        }
        let step = if steepest > R::ZERO { value.abs() / steepest * self.unit } else { next };
        (value, if step < next { step } else { next })
    }
    /// How much the sum is below that of the surface at a point, from the middle of the box, and how it grows along the smallest
    /// radius in each direction.
    pub(super) fn slope(&self, at: Vec3<R>) -> (R, Vec3<R>) {
        let (mut value, mut gradient) = (R::from_f32(LEVEL), Vec3::ZERO);
        for blob in self.blobs {
            let from_center = at - blob.center;
            if let Some(q) = blob.share(from_center.length_squared_wide()) {
                value = value - blob.strength * kernel(q);
                let Vec3 { x, y, z } = from_center;
                let out = Vec3::new(x / blob.radius, y / blob.radius, z / blob.radius);
                // In this order: no product is larger than 1.6 times the strength.
                gradient = gradient + out * slope(q) * blob.slope;
            }
        }
        (value, gradient)
    }
}
