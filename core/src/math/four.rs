//! Four rays at once, for processors that compute four numbers at once.
//!
//! The rays are stored coordinate by coordinate, [`each`] computes one step for all four, and the hits are
//! bits, one for each ray. No step depends on another ray, so that the compiler makes one instruction of four
//! equal ones. So a test of four rays takes little longer than one of a single ray (Wald, Slusallek, Benthin
//! and Wagner, "Interactive Rendering with Coherent Ray Tracing", Eurographics 2001).

use super::{Interval, Ray, Real, Vec3};

/// Whether the processor computes four numbers at once.
pub(crate) const FOUR_AT_ONCE: bool = cfg!(any(target_feature = "sse2", target_feature = "neon"));

/// Four rays, coordinate by coordinate.
#[derive(Clone, Copy, Debug)]
pub struct FourRays<R> {
    origins: [[R; 4]; 3],
    directions: [[R; 4]; 3],
}

impl<R: Real> FourRays<R> {
    /// Groups four rays.
    #[inline(always)]
    pub fn new(rays: [&Ray<R>; 4]) -> Self {
        Self {
            origins: columns(rays.map(|ray| ray.origin)),
            directions: columns(rays.map(|ray| ray.direction)),
        }
    }

    /// The ray at a place: 0 to 3.
    #[inline]
    pub fn ray(&self, place: usize) -> Ray<R> {
        Ray { origin: row(&self.origins, place), direction: row(&self.directions, place) }
    }

    /// Tests the four rays one by one. Returns a bit for each ray with a hit nearer than its `max`, and the
    /// distance of each hit; without a hit, `max`.
    #[inline(always)]
    pub fn one_by_one(
        &self,
        max: &[R; 4],
        intersect: impl Fn(&Ray<R>, Interval<R>) -> Option<R>,
    ) -> (u32, [R; 4]) {
        let (mut met, mut distances) = (0, *max);
        for (place, distance) in distances.iter_mut().enumerate() {
            if let Some(t) = intersect(&self.ray(place), Interval { min: R::ZERO, max: *distance }) {
                met |= 1 << place;
                *distance = t;
            }
        }
        (met, distances)
    }
}

#[inline(always)]
fn columns<R: Real>([a, b, c, d]: [Vec3<R>; 4]) -> [[R; 4]; 3] {
    [[a.x, b.x, c.x, d.x], [a.y, b.y, c.y, d.y], [a.z, b.z, c.z, d.z]]
}

#[inline(always)]
#[allow(clippy::indexing_slicing)] // The index is a remainder.
fn row<R: Real>([x, y, z]: &[[R; 4]; 3], place: usize) -> Vec3<R> {
    let place = place % 4;
    Vec3::new(x[place], y[place], z[place])
}

/// A value for each of the four places.
#[inline(always)]
pub(crate) fn each<T>(value: impl Fn(usize) -> T) -> [T; 4] {
    [value(0), value(1), value(2), value(3)]
}

/// For each place, the first value if its bit is set, else the second.
#[inline(always)]
pub(crate) fn choose<T: Copy>(bits: u32, [a, b, c, d]: [T; 4], [e, f, g, h]: [T; 4]) -> [T; 4] {
    let one = |place: u32, set: T, unset: T| if bits >> place & 1 != 0 { set } else { unset };
    [one(0, a, e), one(1, b, f), one(2, c, g), one(3, d, h)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_come_back_and_bits_choose() {
        let vector = |x: f32| Vec3::new(x, x + 0.25, x + 0.5);
        let rays: [Ray<f32>; 4] =
            each(|i| Ray { origin: vector(i as f32), direction: vector(10.0 * i as f32) });
        let four = FourRays::new(rays.each_ref());
        assert_eq!(each(|i| four.ray(i)), rays);
        assert_eq!(choose(0b0101, [1, 2, 3, 4], [5, 6, 7, 8]), [1, 6, 3, 8]);
        let near = |ray: &Ray<f32>, range: Interval<f32>| (ray.origin.x < range.max).then_some(ray.origin.x);
        assert_eq!(four.one_by_one(&[1.0, 1.0, 3.0, 3.0], near), (0b0101, [0.0, 1.0, 2.0, 3.0]));
    }
}
