//! A stadium: all places of the picture within some distance of a line. It encloses the picture of a hull.

use super::super::grid::Grid;
use crate::camera::Viewport;
use crate::math::{Real, Vec3};
use crate::shape::Hull;

/// The places of the picture within `radius` of the line from `from` to `to`, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stadium<N> {
    from: (N, N),
    to: (N, N),
    radius: N,
}

/// The most corners of a hull's parallelepiped.
const CORNERS: usize = 8;

impl<N: Real<Setup = N>> Stadium<N> {
    /// Encloses everything that is seen of a hull. Its line lies along that axis of the hull for which the
    /// radius is least. `None` if the hull is not well in front of the camera.
    ///
    /// A point c, relative to the camera, is seen at f · c / c_z. A point at distance δ from it is seen
    /// elsewhere by f · (δ c_z - c δ_z) / (c_z (c_z + δ_z)), which is at most f · r |c| / (c_z (c_z - r)) for
    /// a hull of radius r. That is largest at one of the corners.
    pub(super) fn new<R: Real<Setup = N>>(viewport: &Viewport<R>, hull: &Hull<R>) -> Option<Self> {
        let (mut places, mut count) = ([(N::ZERO, N::ZERO); CORNERS], 0);
        let (mut slant, mut nearest) = (N::ZERO, N::FARTHEST);
        let mut largest = viewport.eye().to_setup().magnitude();
        for (corner, place) in hull.corners().zip(&mut places) {
            let corner = corner.to_setup();
            *place = place_of(viewport, corner)?;
            let (depth, distance) = viewport.depth(corner);
            slant = slant.larger(distance / depth);
            nearest = nearest.smaller(depth);
            largest = largest.larger(corner.magnitude());
            count += 1;
        }
        // Rounding moves the hull, and hits beside it (see `Intersect::bounds`): a corner at the eye is seen
        // anywhere.
        let rounding = R::offset(R::from_setup(largest)).to_setup();
        let radius = hull.radius.to_setup() + rounding + rounding;
        nearest = nearest - radius;
        if !(nearest > radius) {
            return None;
        }
        let around = radius * slant / (nearest * viewport.pixel());
        let places = places.get(..count)?;
        let mut narrowest: Option<Self> = None;
        for axis in &hull.axes {
            // A hull without axes is a ball: one axis of length 0 is enough for it.
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

    /// Encloses some places, along the line through `from` and `to`.
    fn along(from: (N, N), to: (N, N), places: &[(N, N)]) -> Self {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let length = (x * x + y * y).sqrt();
        // An axis that is seen from its end gives no direction: take any.
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

    /// Whether it may lie unseen between the points of a grid: it is less than two cells wide or high, or
    /// less than one cell wide at an angle. A stadium as wide as a cell cannot enter and leave through a side
    /// between two points.
    pub(super) fn is_thin(&self, grid: Grid) -> bool {
        let two_sides = N::from_u16(2 * grid.pixels() as u16);
        let (x, y) = ((self.to.0 - self.from.0).abs(), (self.to.1 - self.from.1).abs());
        self.is_narrow(grid) || x.smaller(y) + self.radius + self.radius < two_sides
    }

    /// Whether it is less than one cell wide, at any angle.
    pub(super) fn is_narrow(&self, grid: Grid) -> bool {
        self.radius + self.radius < N::from_u16(grid.pixels() as u16)
    }

    /// Its leftmost and rightmost place between two heights, or a little more; `None` if it is not between
    /// them.
    pub(super) fn extent(&self, top: N, bottom: N) -> Option<(N, N)> {
        let (top, bottom) = (top - self.radius, bottom + self.radius);
        let (from, to) = if self.from.1 > self.to.1 { (self.to, self.from) } else { (self.from, self.to) };
        if from.1 > bottom || to.1 < top {
            return None;
        }
        let (height, across) = (to.1 - from.1, to.0 - from.0);
        // A line less than a pixel high counts from end to end: its slope is too inexact.
        let at = |y: N| if height > N::ONE { from.0 + across * ((y - from.1) / height) } else { from.0 };
        let upper = if top > from.1 && height > N::ONE { at(top) } else { from.0 };
        let lower = if bottom < to.1 && height > N::ONE { at(bottom) } else { to.0 };
        let (left, right) = if upper < lower { (upper, lower) } else { (lower, upper) };
        Some((left - self.radius, right + self.radius))
    }
}

/// The place of the picture where a point is seen: [`Viewport::project`], in one copy for all callers in this
/// folder.
pub(super) fn place_of<N: Real<Setup = N>, R: Real<Setup = N>>(
    viewport: &Viewport<R>,
    point: Vec3<N>,
) -> Option<(N, N)> {
    viewport.project(point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::math::{Fixed, Scale};

    /// The stadium of a parallelogram that has a corner at the eye.
    fn at_the_eye<R: Real>(eye: Vec3, [right, up]: [Vec3; 2]) -> Option<Stadium<R::Setup>> {
        let target = eye + right + up;
        let camera = Camera { eye, target, up: Vec3::new(0.3, 0.5, 0.8), vertical_fov: 1.0, lens: None };
        let scale = Scale::ONE.enlarged(1.0 / 64.0);
        let viewport = Viewport::new(&camera.prepare::<R>(scale).unwrap(), 20, 15);
        // Off by a rounding toward the target.
        let corner = scale.point::<R>(eye.to());
        let corner = corner + (scale.point(target.to()) - corner) * R::from_f32(2e-6);
        let [right, up] = [right, up].map(|edge| scale.point::<R>(edge.to()));
        Stadium::new(&viewport, &Hull::edges(corner, [right, up, Vec3::ZERO]))
    }

    /// A triangle was shown or not, depending on the bands, by an eye at its corner.
    #[test]
    fn what_begins_at_the_eye_is_seen_anywhere() {
        let eye = Vec3::new(-4.0, -2.0, -4.0);
        let edges = [Vec3::new(0.0, 0.5, 0.0), Vec3::new(0.456, 0.0, -0.205)];
        assert!(at_the_eye::<f32>(eye, edges).is_none());
        assert!(at_the_eye::<Fixed>(eye, edges).is_none());
    }

    #[test]
    fn a_slanted_line_is_narrow_between_two_heights() {
        let stadium = Stadium { from: (10.0f32, 80.0), to: (90.0, 0.0), radius: 1.0 };
        let (left, right) = stadium.extent(40.0, 44.0).unwrap();
        // The line is at x = 46 at height 44, and at 50 at height 40. The radius is added twice: to the
        // heights, and to the sides.
        assert!((left - 44.0).abs() < 1e-3 && (right - 52.0).abs() < 1e-3, "{left} to {right}");
        assert_eq!(stadium.extent(82.0, 84.0), None);
        assert_eq!(stadium.extent(-5.0, -2.0), None);
    }

    #[test]
    fn a_level_line_counts_from_end_to_end() {
        let stadium = Stadium { from: (90.0f32, 20.25), to: (10.0, 20.5), radius: 2.0 };
        assert_eq!(stadium.extent(20.0, 24.0), Some((8.0, 92.0)));
        assert_eq!(stadium.extent(24.0, 28.0), None);
    }
}
