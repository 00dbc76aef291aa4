//! Beams: bundles of rays that are tested against boxes all at once (Haines and Wallace, "Shaft Culling for
//! Efficient Ray-Traced Radiosity", Eurographics Workshop on Rendering 1991).
//!
//! A beam has a lower and an upper line. At each distance along the beam, each coordinate of each ray lies
//! between those of the two lines. Where the lower line is above a box in one coordinate, or the upper line
//! is below it, no ray is in the box. This leaves a range of distances for each line and coordinate; if these
//! ranges have no distance in common, the beam misses the box. So a beam is tested in the same way as a ray
//! ([`slabs`](super::slabs)): with six planes, as many operations, and the same room for rounding.

use super::slabs::both;
use super::{BoxTest, Node, slots};
use crate::math::{Aabb, Ray, Real, Vec3};

/// A bundle of rays.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam<R> {
    lines: [Lines<R>; 3],
    /// How far the beam reaches, in units of the directions of its lines.
    max: R,
}

/// One coordinate of both lines.
#[derive(Clone, Copy, Debug)]
struct Lines<R> {
    /// The coordinate of the lower line's origin, less room for rounding, and the distance along the beam for
    /// each unit of the coordinate.
    lower: (R, R),
    /// The coordinate of the upper line's origin, plus room for rounding, and the distance for each unit.
    upper: (R, R),
}

impl<R: Real> Beam<R> {
    /// The beam around some rays, which have no end; `None` if there are no rays.
    #[inline]
    pub(crate) fn around<'r>(rays: impl Iterator<Item = &'r Ray<R>>) -> Option<Self> {
        let ranges = rays.map(|ray| (Range::point(ray.origin), Range::point(ray.direction)));
        let (origins, directions) = ranges.reduce(|a, b| (a.0.with(b.0), a.1.with(b.1)))?;
        Some(Self::new(origins, R::ZERO, directions, R::FARTHEST))
    }

    /// The beam around all ways to a point, from all points of a box and from points no farther than `margin`
    /// from it.
    pub(crate) fn toward_point(from: Aabb<R>, margin: R, to: Vec3<R>) -> Self {
        let origins = Range(from.min, from.max);
        // Reach a little beyond the point: the rays themselves end there.
        Self::new(origins, margin, Range(to - from.min, to - from.max), R::ONE + R::from_f32(1e-3))
    }

    /// The beam of all rays in one direction, from all points of a box and from points no farther than
    /// `margin` from it.
    pub(crate) fn toward(from: Aabb<R>, margin: R, direction: Vec3<R>) -> Self {
        Self::new(Range(from.min, from.max), margin, Range::point(direction), R::FARTHEST)
    }

    #[inline]
    fn new(origins: Range<R>, margin: R, directions: Range<R>, max: R) -> Self {
        let room = margin + R::offset(origins.0.magnitude().larger(origins.1.magnitude()));
        let tiniest = R::FARTHEST.recip();
        let per_unit = |d: R| (if d.abs() < tiniest { tiniest } else { d }).recip();
        let lines = |(low, high): (R, R), (d, e): (R, R)| Lines {
            lower: (low - room, per_unit(d)),
            upper: (high + room, per_unit(e)),
        };
        let (o, d) = (origins, directions);
        Self {
            lines: [
                lines((o.0.x, o.1.x), (d.0.x, d.1.x)),
                lines((o.0.y, o.1.y), (d.0.y, d.1.y)),
                lines((o.0.z, o.1.z), (d.0.z, d.1.z)),
            ],
            max,
        }
    }
}

/// A range of vectors: the smallest and the largest coordinates.
#[derive(Clone, Copy)]
struct Range<R>(Vec3<R>, Vec3<R>);

impl<R: Real> Range<R> {
    fn point(vector: Vec3<R>) -> Self {
        Self(vector, vector)
    }

    #[inline]
    fn with(self, Self(low, high): Self) -> Self {
        Self(
            Vec3::new(self.0.x.smaller(low.x), self.0.y.smaller(low.y), self.0.z.smaller(low.z)),
            Vec3::new(self.1.x.larger(high.x), self.1.y.larger(high.y), self.1.z.larger(high.z)),
        )
    }
}

impl<R: Real> Beam<R> {
    /// A bit for each box of a node that any ray of the beam may meet.
    #[inline]
    fn meet<const W: usize>(&self, node: &Node<R, W>) -> u32 {
        let (mut near, mut far) = ([R::ZERO; W], [self.max; W]);
        for (lines, [lowest, highest]) in self.lines.iter().zip(&node.planes) {
            // The lower line must not be above the box, and the upper one must not be below it.
            let (start, per_unit) = lines.lower;
            let crossed = highest.map(|plane| (plane - start) * per_unit);
            if per_unit > R::ZERO {
                far = both(far, crossed, R::smaller);
            } else {
                near = both(near, crossed, R::larger);
            }
            let (start, per_unit) = lines.upper;
            let crossed = lowest.map(|plane| (plane - start) * per_unit);
            if per_unit > R::ZERO {
                near = both(near, crossed, R::larger);
            } else {
                far = both(far, crossed, R::smaller);
            }
        }
        R::no_larger(&near, &far)
    }
}

impl<R: Real, const W: usize> BoxTest<R, W> for Beam<R> {
    #[inline]
    fn any_met(&self, node: &Node<R, W>, visit: impl FnMut(usize) -> bool) -> bool {
        slots::<W>(self.meet(node)).any(visit)
    }
}
