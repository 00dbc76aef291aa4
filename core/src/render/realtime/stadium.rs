//! The outline of a long shape in the picture: all places within some distance of a line.

use crate::camera::Viewport;
use crate::math::Real;
use crate::shape::Spine;

/// The places of the picture within `radius` of the line between two places, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stadium<N> {
    from: (N, N),
    to: (N, N),
    pub(super) radius: N,
}

impl<N: Real<Setup = N>> Stadium<N> {
    /// What holds everything that is seen of a shape; `None` where it is not well in front of the camera.
    ///
    /// A point is seen at f · c / c_z. One that is δ away is seen elsewhere by f · (δ c_z - c δ_z) / (c_z (c_z + δ_z)),
    /// which is at most f · r |c| / (c_z (c_z - r)): largest at one of the ends.
    pub(super) fn new<R: Real<Setup = N>>(viewport: &Viewport<R>, spine: &Spine<R>) -> Option<Self> {
        let radius = spine.radius.to_setup();
        let (from, to) = (spine.from.to_setup(), spine.to.to_setup());
        let ends = (viewport.project(from)?, viewport.project(to)?);
        let slant = |depth: N, distance: N| distance / depth;
        let (depth, distance) = viewport.depth(from);
        let (other_depth, other_distance) = viewport.depth(to);
        let slant = slant(depth, distance).larger(slant(other_depth, other_distance));
        let nearest = if depth < other_depth { depth } else { other_depth } - radius;
        if !(nearest > radius) {
            return None;
        }
        Some(Self { from: ends.0, to: ends.1, radius: radius * slant / (nearest * viewport.pixel()) })
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
