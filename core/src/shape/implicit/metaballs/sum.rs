//! The sum of all blobs along a ray, and the distance within which it keeps its sign.
//!
//! Along a ray, the sum changes no faster than the sum of the steepest slopes of all blobs that the ray is
//! in.

use super::super::FieldBox;
use super::super::trace::TracedLine;
use super::kernel::{LEVEL, kernel, slope};
use crate::math::{Interval, Product, Real, Vec3};

/// A prepared blob. Its center is relative to the middle of the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PreparedBlob<R: Real> {
    pub(super) center: Vec3<R>,
    pub(super) radius: R,
    pub(super) radius_squared: R::Product,
    pub(super) strength: R,
    /// The strength divided by the radius, in units of the smallest radius of all blobs.
    pub(super) slope: R,
    /// The most that the value of the blob changes along a way of the smallest radius.
    pub(super) steepest: R,
}

/// The part of a line inside a blob.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlobChord<'m, R: Real> {
    blob: &'m PreparedBlob<R>,
    /// The place along the line that is nearest to the center.
    middle: R,
    /// The squared distance of that place from the center.
    distance: R::Product,
    /// The part of the line inside the blob.
    inside: Interval<R>,
}

impl<R: Real> PreparedBlob<R> {
    /// The part of a line inside the blob; `None` if the line misses it.
    pub(super) fn chord(&self, line: &TracedLine<R>) -> Option<BlobChord<'_, R>> {
        let middle = line.along(self.center);
        let nearest = line.at(middle) - self.center;
        let distance = nearest.length_squared_wide();
        let rest = self.radius_squared - distance;
        (rest > R::Product::ZERO).then(|| {
            let half = rest.sqrt();
            BlobChord {
                blob: self,
                middle,
                distance,
                inside: Interval { min: middle - half, max: middle + half },
            }
        })
    }

    /// The squared distance in radii, for a squared distance from the center; `None` beyond the radius.
    fn share(&self, distance: R::Product) -> Option<R> {
        (distance < self.radius_squared).then(|| distance.share(self.radius_squared))
    }
}

/// All blobs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BlobSum<'m, R: Real> {
    pub(super) blobs: &'m [PreparedBlob<R>],
    pub(super) room: FieldBox<R>,
    /// The smallest radius of all blobs.
    pub(super) unit: R,
}

impl<R: Real> BlobSum<'_, R> {
    /// The level of the surface minus the sum at `t` along a line, which is negative inside, and a distance
    /// within which this keeps its sign. `chords` has the chords of the line inside the blobs.
    pub(super) fn look(&self, chords: &[Option<BlobChord<'_, R>>], t: R) -> (R, R) {
        let (mut value, mut steepest, mut next) = (R::from_f32(LEVEL), R::ZERO, R::FARTHEST);
        for chord in chords.iter().map_while(Option::as_ref) {
            let BlobChord { blob, middle, distance, inside } = chord;
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

    /// The level of the surface minus the sum at a point, which is relative to the middle of the box, and its
    /// gradient for each smallest radius.
    pub(super) fn slope(&self, at: Vec3<R>) -> (R, Vec3<R>) {
        let (mut value, mut gradient) = (R::from_f32(LEVEL), Vec3::ZERO);
        for blob in self.blobs {
            let from_center = at - blob.center;
            if let Some(q) = blob.share(from_center.length_squared_wide()) {
                value = value - blob.strength * kernel(q);
                let Vec3 { x, y, z } = from_center;
                let out = Vec3::new(x / blob.radius, y / blob.radius, z / blob.radius);
                // Multiply in this order: then no product is larger than 1.6 times the strength.
                gradient = gradient + out * slope(q) * blob.slope;
            }
        }
        (value, gradient)
    }
}
