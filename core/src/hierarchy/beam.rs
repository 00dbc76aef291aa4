//! Beams: many rays at once, as one that is as wide as they need (Haines and Wallace, "Shaft Culling for Efficient Ray-Traced
//! Radiosity", Eurographics Workshop on Rendering 1991).
//!
//! A beam has two lines, and at any distance along it each coordinate of each ray lies between those of the two. Where the lower line
//! is above a box in one coordinate, or the upper one below it, no ray is in the box. That leaves a range of distances for each
//! line and coordinate, and where they have none in common the box is missed. So a beam is tested as a ray is
//! ([`slabs`](super::slabs)): six planes, as many operations, and the same room for rounding.
//!
//! Beams around 8 rays that begin or point up to 1/100 apart meet 448 of the boxes in a cube where the rays meet 440.

use super::slabs::both;
use super::{BoxTest, Node, slots};
use crate::math::{Aabb, Ray, Real, Vec3};

/// Rays that lie together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam<R> {
    lines: [Lines<R>; 3],
    /// How far it reaches, in units of the directions of its lines.
    max: R,
}

/// One coordinate of both lines.
#[derive(Clone, Copy, Debug)]
struct Lines<R> {
    /// Where the lower line begins, less room for rounding, and the distance for each unit of the coordinate.
    lower: (R, R),
    /// The same of the upper line, with more room.
    upper: (R, R),
}

impl<R: Real> Beam<R> {
    /// Around rays, however far they go; `None` where there are none.
    #[inline(always)]
    pub(crate) fn around<'r>(rays: impl Iterator<Item = &'r Ray<R>>) -> Option<Self> {
        let hulls = rays.map(|ray| (Hull::point(ray.origin), Hull::point(ray.direction)));
        let (origins, directions) = hulls.reduce(|a, b| (a.0.with(b.0), a.1.with(b.1)))?;
        Some(Self::new(origins, R::ZERO, directions, R::FARTHEST))
    }

    /// From all points of a box, or from as far as `beside` them, to a point.
    pub(crate) fn toward_point(from: Aabb<R>, beside: R, to: Vec3<R>) -> Self {
        let origins = Hull(from.min, from.max);
        // What lies at the very end is cut off by the ray.
        Self::new(origins, beside, Hull(to - from.min, to - from.max), R::ONE + R::from_f32(1e-3))
    }

    /// The same in one direction.
    pub(crate) fn toward(from: Aabb<R>, beside: R, direction: Vec3<R>) -> Self {
        Self::new(Hull(from.min, from.max), beside, Hull::point(direction), R::FARTHEST)
    }

    #[inline(always)]
    fn new(origins: Hull<R>, beside: R, directions: Hull<R>, max: R) -> Self {
        let room = beside + R::offset(origins.0.magnitude().larger(origins.1.magnitude()));
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

/// The smallest and the largest coordinates of some vectors.
#[derive(Clone, Copy)]
struct Hull<R>(Vec3<R>, Vec3<R>);

impl<R: Real> Hull<R> {
    fn point(vector: Vec3<R>) -> Self {
        Self(vector, vector)
    }

    #[inline(always)]
    fn with(self, Self(low, high): Self) -> Self {
        Self(
            Vec3::new(self.0.x.smaller(low.x), self.0.y.smaller(low.y), self.0.z.smaller(low.z)),
            Vec3::new(self.1.x.larger(high.x), self.1.y.larger(high.y), self.1.z.larger(high.z)),
        )
    }
}

impl<R: Real> Beam<R> {
    /// Which of a node's boxes any ray may meet, a bit for each.
    #[cfg_attr(any(target_feature = "sse2", target_feature = "neon"), inline(always))]
    fn meet<const W: usize>(&self, node: &Node<R, W>) -> u32 {
        let (mut near, mut far) = ([R::ZERO; W], [self.max; W]);
        for (lines, [lowest, highest]) in self.lines.iter().zip(&node.planes) {
            // The lower line must not be above the box, nor the upper one below it.
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
    #[inline(always)]
    fn any_met(&self, node: &Node<R, W>, visit: impl FnMut(usize) -> bool) -> bool {
        slots::<W>(self.meet(node)).any(visit)
    }
}
