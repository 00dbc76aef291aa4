//! The outline of a hull in the picture: all places within some distance of a line.

use super::super::Grid;
use crate::camera::Viewport;
use crate::math::{Real, Vec3};
use crate::shape::Hull;

/// The places of the picture within `radius` of the line between two places, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stadium<N> {
    from: (N, N),
    to: (N, N),
    radius: N,
}

/// A hull has so many corners at most.
const CORNERS: usize = 8;

impl<N: Real<Setup = N>> Stadium<N> {
    /// What holds everything that is seen of a hull: the line lies along one of its axes, that for which the radius is least. `None`
    /// where it is not well in front of the camera.
    ///
    /// A point is seen at f · c / c_z. One that is δ away is seen elsewhere by f · (δ c_z - c δ_z) / (c_z (c_z + δ_z)),
    /// which is at most f · r |c| / (c_z (c_z - r)): largest at one of the corners.
    #[inline(never)]
    pub(super) fn new<R: Real<Setup = N>>(viewport: &Viewport<R>, hull: &Hull<R>) -> Option<Self> {
        let radius = hull.radius.to_setup();
        let (mut places, mut count) = ([(N::ZERO, N::ZERO); CORNERS], 0);
        let (mut slant, mut nearest) = (N::ZERO, N::FARTHEST);
        for (corner, place) in hull.corners().zip(&mut places) {
            let corner = corner.to_setup();
            *place = place_of(viewport, corner)?;
            let (depth, distance) = viewport.depth(corner);
            slant = slant.larger(distance / depth);
            nearest = nearest.smaller(depth);
            count += 1;
        }
        nearest = nearest - radius;
        if !(nearest > radius) {
            return None;
        }
        let around = radius * slant / (nearest * viewport.pixel());
        let places = places.get(..count)?;
        let mut narrowest: Option<Self> = None;
        for axis in &hull.axes {
            // Where all are none, it is a point.
            if *axis == Vec3::ZERO && narrowest.is_some() {
                continue;
            }
            let end = |end: Vec3<R>| place_of(viewport, end.to_setup());
            let (from, to) = (end(hull.center - *axis)?, end(hull.center + *axis)?);
            let stadium = Self::along(from, to, places);
            if narrowest.is_none_or(|narrowest| stadium.radius < narrowest.radius) {
                narrowest = Some(stadium);
            }
        }
        narrowest.map(|stadium| Self { radius: stadium.radius + around, ..stadium })
    }

    /// What holds some places, along the line between two.
    #[inline(never)]
    fn along(from: (N, N), to: (N, N), places: &[(N, N)]) -> Self {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let length = (x * x + y * y).sqrt();
        // MarkProbe from its end, any direction will do.
        let (x, y) = if length > N::from_f32(1e-3) { (x / length, y / length) } else { (N::ONE, N::ZERO) };
        let (mut begin, mut end, mut radius) = (N::ZERO, N::ZERO, N::ZERO);
        for place in places {
            let (right, down) = (place.0 - from.0, place.1 - from.1);
            let along = right * x + down * y;
            begin = begin.smaller(along);
            end = end.larger(along);
            radius = radius.larger((down * x - right * y).abs());
        }
        let at = |along: N| (from.0 + x * along, from.1 + y * along);
        Self { from: at(begin), to: at(end), radius }
    }

    /// Whether it could hide between the points of a grid: it is less than two cells wide or high, or aslant less than one. What is as wide
    /// as a cell does not cross a side between two points, enter and leave.
    pub(super) fn is_thin(&self, grid: Grid) -> bool {
        let two_sides = N::from_u16(2 * grid.pixels() as u16);
        let (x, y) = ((self.to.0 - self.from.0).abs(), (self.to.1 - self.from.1).abs());
        self.is_narrow(grid) || x.smaller(y) + self.radius + self.radius < two_sides
    }

    /// Whether it is less than a cell wide, however it lies.
    pub(super) fn is_narrow(&self, grid: Grid) -> bool {
        self.radius + self.radius < N::from_u16(grid.pixels() as u16)
    }

    /// Its leftmost and rightmost place between two heights, or a little more; `None` where it is not there.
    pub(super) fn extent(&self, top: N, bottom: N) -> Option<(N, N)> {
        let (top, bottom) = (top - self.radius, bottom + self.radius);
        let (from, to) = if self.from.1 > self.to.1 { (self.to, self.from) } else { (self.from, self.to) };
        if from.1 > bottom || to.1 < top {
            return None;
        }
        let (height, across) = (to.1 - from.1, to.0 - from.0);
        // Next to level lines are as good as level: they lie between the heights from end to end.
        let at = |y: N| if height > N::ONE { from.0 + across * ((y - from.1) / height) } else { from.0 };
        let upper = if top > from.1 && height > N::ONE { at(top) } else { from.0 };
        let lower = if bottom < to.1 && height > N::ONE { at(bottom) } else { to.0 };
        let (left, right) = if upper < lower { (upper, lower) } else { (lower, upper) };
        Some((left - self.radius, right + self.radius))
    }
}

/// [`Viewport::project`], once in a program's code for all places that need it.
#[inline(never)]
pub(super) fn place_of<N: Real<Setup = N>, R: Real<Setup = N>>(
    viewport: &Viewport<R>,
    point: Vec3<N>,
) -> Option<(N, N)> {
    viewport.project(point)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slanted_line_is_narrow_between_two_heights() {
        let stadium = Stadium { from: (10.0f32, 80.0), to: (90.0, 0.0), radius: 1.0 };
        let (left, right) = stadium.extent(40.0, 44.0).unwrap();
        // At heights 44 and 40 the line is at 46 and 50; each side has its radius, and that of what reaches in.
        assert!((left - 44.0).abs() < 1e-3 && (right - 52.0).abs() < 1e-3, "{left} to {right}");
        assert_eq!(stadium.extent(82.0, 84.0), None);
        assert_eq!(stadium.extent(-5.0, -2.0), None);
    }

    #[test]
    fn a_level_line_is_there_from_end_to_end() {
        let stadium = Stadium { from: (90.0f32, 20.25), to: (10.0, 20.5), radius: 2.0 };
        assert_eq!(stadium.extent(20.0, 24.0), Some((8.0, 92.0)));
        assert_eq!(stadium.extent(24.0, 28.0), None);
    }
}
