//! A taper: the picture of a tip, as far as it is narrower than a cell.

use super::super::grid::Grid;
use super::shadow_projection::ShadowProjection;
use super::stadium::place_of;
use crate::camera::Viewport;
use crate::math::{Real, Vec3};
use crate::shape::Tip;

/// A triangle of the picture that encloses the end of a tip, by its corners in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taper<N> {
    corners: [(N, N); 3],
}

/// The tangent of half the angle of a tip that is sharp as it is seen, like [`Tip::is_sharp`] in space. Of a
/// blunter tip, little lies between the points of the grid.
const SHARP: f32 = 0.5;

/// The ends of a tip may lie behind the camera. They are moved to half their distance from the apex, this
/// many times.
const HALVINGS: usize = 8;

impl<N: Real<Setup = N>> Taper<N> {
    /// The end of a tip, or of its shadow if there is a `projection`; `None` if it is not sharp as it is
    /// seen, or not well in front of the camera.
    pub(super) fn new<R: Real<Setup = N>>(
        viewport: &Viewport<R>,
        tip: &Tip<R>,
        projection: Option<&ShadowProjection<N>>,
        grid: Grid,
    ) -> Option<Self> {
        let apex = tip.apex.to_setup();
        let shown = |point: Vec3<N>| projection.map_or(Some(point), |projection| projection.shadow_of(point));
        let from = place_of(viewport, shown(apex)?)?;
        // A straight line is seen as a straight line: any part of it has the same direction.
        let mut share = N::ONE;
        for _ in 0..HALVINGS {
            let end = |end: Vec3<R>| {
                let end = shown(apex + (end.to_setup() - apex) * share)?;
                let (x, y) = place_of(viewport, end)?;
                Some(((x - from.0, y - from.1), viewport.depth(end).0))
            };
            if let [Some((a, depth)), Some((b, _))] = tip.ends.map(end) {
                let radius = tip.radius.to_setup() * share / (depth * viewport.pixel());
                return Self::between(from, [a, b], radius, N::from_u16(grid.pixels() as u16));
            }
            share = share * N::from_f32(0.5);
        }
        None
    }

    /// The part narrower than `width` of what lies between an apex and the line between two `ends`, which are
    /// relative to the apex, and within `radius` of that.
    fn between((x, y): (N, N), ends: [(N, N); 2], radius: N, width: N) -> Option<Self> {
        let length = |(x, y): (N, N)| (x * x + y * y).sqrt();
        let [(a, to_a), (b, to_b)] = ends.map(|end| {
            let length = length(end);
            ((end.0 / length, end.1 / length), length)
        });
        // The sum and the difference of two unit vectors are as long as twice the cosine and twice the sine
        // of half the angle between them.
        let (sum, difference) = ((a.0 + b.0, a.1 + b.1), (a.0 - b.0, a.1 - b.1));
        let (cosine, sine) = (length(sum), length(difference));
        let longest = to_a.larger(to_b);
        let slope = sine / cosine + radius / longest;
        // Not a number if an end is the apex itself.
        if !(slope < N::from_f32(SHARP)) {
            return None;
        }
        let half = N::from_f32(0.5);
        let length = longest * cosine * half;
        let length = if width < slope * (length + length) { width * half / slope } else { length };
        let (right, down) = (sum.0 / cosine * length, sum.1 / cosine * length);
        let end = (x + right, y + down);
        Some(Self {
            corners: [
                (x, y),
                (end.0 - down * slope, end.1 + right * slope),
                (end.0 + down * slope, end.1 - right * slope),
            ],
        })
    }

    /// Its leftmost and rightmost place between two heights; `None` if it is not between them.
    pub(super) fn extent(&self, top: N, bottom: N) -> Option<(N, N)> {
        let [a, b, c] = self.corners;
        let mut extent: Option<(N, N)> = None;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (from, to) = if from.1 > to.1 { (to, from) } else { (from, to) };
            if from.1 > bottom || to.1 < top {
                continue;
            }
            let at = |y: N| from.0 + (to.0 - from.0) * ((y - from.1) / (to.1 - from.1));
            let upper = if from.1 < top { at(top) } else { from.0 };
            let lower = if to.1 > bottom { at(bottom) } else { to.0 };
            for x in [upper, lower] {
                extent = Some(extent.map_or((x, x), |(left, right)| (left.smaller(x), right.larger(x))));
            }
        }
        extent
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_taper_ends_where_the_tip_is_as_wide_as_a_cell() {
        // The tip is 40 pixels long and 10 wide at its end: it is 8 pixels wide at 32 pixels from its apex.
        let ends = [(40.0f32, 5.0), (40.0, -5.0)];
        let taper = Taper::between((10.0, 20.0), ends, 0.0, 8.0).unwrap();
        let extent = taper.extent(0.0, 99.0).unwrap();
        assert!((extent.0 - 10.0).abs() < 1e-3 && (extent.1 - 42.0).abs() < 1e-3, "{extent:?}");
        // Two pixels below the apex, only the farther half is left.
        let (left, right) = taper.extent(22.0, 30.0).unwrap();
        assert!((left - 26.0).abs() < 1e-3 && (right - 42.0).abs() < 1e-3, "{left} to {right}");
        assert_eq!(taper.extent(24.5, 30.0), None);
        // A tip that is nowhere as wide as a cell counts as a whole.
        let taper = Taper::between((10.0, 20.0), ends, 0.0, 80.0).unwrap();
        assert_eq!(taper.extent(0.0, 99.0).unwrap().1, 50.0);
    }

    #[test]
    fn blunt_tips_have_no_taper() {
        let ends = [(10.0f32, 6.0), (10.0, -6.0)];
        assert!(Taper::between((0.0, 0.0), ends, 0.0, 8.0).is_none());
        // A cone whose apex points nearly, and exactly, at the eye.
        for end in [1.0f32, 0.0] {
            assert!(Taper::between((0.0, 0.0), [(end, 0.0); 2], 5.0, 8.0).is_none());
        }
        assert!(Taper::between((0.0, 0.0), [(20.0f32, 0.0); 2], 5.0, 8.0).is_some());
    }
}
