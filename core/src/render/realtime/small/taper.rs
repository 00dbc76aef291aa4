//! Where something tapers off in the picture: a triangle of which every part is narrower than a cell.

use super::super::Grid;
use super::stadium::place_of;
use crate::camera::Viewport;
use crate::light::Source;
use crate::math::{Real, Vec3};
use crate::shape::Tip;

/// The places of the picture between three corners, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taper<N> {
    corners: [(N, N); 3],
}

/// The tangent of half the angle of a tip that is sharp as it is seen, as [`Tip::is_sharp`] says of it in space: of blunter ones there is
/// little between the points of the grid.
const SHARP: f32 = 0.5;

/// What a tip leads to may reach behind the camera: it is moved to half the way so often.
const HALVINGS: usize = 8;

/// A light and a plane that it throws shadows on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shade<N> {
    /// The place of the light, or the direction toward it, and how much of a point is taken from that: 1 or 0.
    light: (Vec3<N>, N),
    normal: Vec3<N>,
    distance: N,
}

impl<N: Real<Setup = N>> Shade<N> {
    pub(super) fn new<R: Real<Setup = N>>(
        light: &Source<R>,
        (normal, distance): (Vec3<N>, N),
    ) -> Option<Self> {
        let light = match light {
            Source::At(position) => (position.to_setup(), N::ONE),
            Source::Toward(direction) => (direction.to_setup(), N::ZERO),
            Source::Far(..) => return None,
        };
        Some(Self { light, normal, distance })
    }

    /// Where the shadow of a point falls; `None` where it falls away from the plane, or nearly along it.
    #[inline(never)]
    pub(super) fn shadow(&self, point: Vec3<N>) -> Option<Vec3<N>> {
        let toward = self.light.0 - point * self.light.1;
        let (height, rise) = (self.normal.dot(point) - self.distance, self.normal.dot(toward));
        let (height, rise) = if rise < N::ZERO { (-height, -rise) } else { (height, rise) };
        let flattest = height.larger(toward.magnitude() * N::from_f32(1e-2));
        (height > N::ZERO && rise * N::from_u16(100) > flattest).then(|| point - toward * (height / rise))
    }
}

impl<N: Real<Setup = N>> Taper<N> {
    /// The end of a tip, or its shadow; `None` where it is not sharp as it is seen, or not well in front of the camera.
    #[inline(never)]
    pub(super) fn new<R: Real<Setup = N>>(
        viewport: &Viewport<R>,
        tip: &Tip<R>,
        shade: Option<&Shade<N>>,
        grid: Grid,
    ) -> Option<Self> {
        let apex = tip.apex.to_setup();
        let place = |point: Vec3<N>| shade.map_or(Some(point), |shade| shade.shadow(point));
        let from = place_of(viewport, place(apex)?)?;
        // Straight lines are seen straight, whatever part of them.
        let mut share = N::ONE;
        for _ in 0..HALVINGS {
            let end = |end: Vec3<R>| {
                let end = place(apex + (end.to_setup() - apex) * share)?;
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

    /// What lies between a place and the line between two others, of which it is known where they are seen from there, and so much around
    /// that; as far as it is narrower than a width.
    #[inline(never)]
    fn between((x, y): (N, N), ends: [(N, N); 2], radius: N, width: N) -> Option<Self> {
        let length = |(x, y): (N, N)| (x * x + y * y).sqrt();
        let [(a, to_a), (b, to_b)] = ends.map(|end| {
            let length = length(end);
            ((end.0 / length, end.1 / length), length)
        });
        // Of half the angle between the two, twice the cosine and the sine.
        let (sum, difference) = ((a.0 + b.0, a.1 + b.1), (a.0 - b.0, a.1 - b.1));
        let (cosine, sine) = (length(sum), length(difference));
        let longest = to_a.larger(to_b);
        let slope = sine / cosine + radius / longest;
        // Where nothing leads anywhere, that is no number.
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

    /// Its leftmost and rightmost place between two heights; `None` where it is not there.
    #[inline(never)]
    pub(super) fn extent(&self, top: N, bottom: N) -> Option<(N, N)> {
        let [a, b, c] = self.corners;
        let mut extent: Option<(N, N)> = None;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (from, to) = if from.1 > to.1 { (to, from) } else { (from, to) };
            if from.1 > bottom || to.1 < top {
                continue;
            }
            let at = |y: N| from.0 + (to.0 - from.0) * ((y - from.1) / (to.1 - from.1));
            for x in
                [if from.1 < top { at(top) } else { from.0 }, if to.1 > bottom { at(bottom) } else { to.0 }]
            {
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
    fn a_tip_is_as_long_as_it_is_narrow() {
        // Four times as long as wide at its end, 40 pixels away: eight pixels wide where it is 32 long.
        let ends = [(40.0f32, 5.0), (40.0, -5.0)];
        let taper = Taper::between((10.0, 20.0), ends, 0.0, 8.0).unwrap();
        let extent = taper.extent(0.0, 99.0).unwrap();
        assert!((extent.0 - 10.0).abs() < 1e-3 && (extent.1 - 42.0).abs() < 1e-3, "{extent:?}");
        // Two pixels below its middle it begins halfway.
        let (left, right) = taper.extent(22.0, 30.0).unwrap();
        assert!((left - 26.0).abs() < 1e-3 && (right - 42.0).abs() < 1e-3, "{left} to {right}");
        assert_eq!(taper.extent(24.5, 30.0), None);
        // One that ends before it is eight pixels wide is taken whole.
        let taper = Taper::between((10.0, 20.0), ends, 0.0, 80.0).unwrap();
        assert_eq!(taper.extent(0.0, 99.0).unwrap().1, 50.0);
    }

    #[test]
    fn what_is_blunt_is_no_tip() {
        let ends = [(10.0f32, 6.0), (10.0, -6.0)];
        assert!(Taper::between((0.0, 0.0), ends, 0.0, 8.0).is_none());
        // A cone seen from its point, and one seen along its axis.
        for end in [1.0f32, 0.0] {
            assert!(Taper::between((0.0, 0.0), [(end, 0.0); 2], 5.0, 8.0).is_none());
        }
        assert!(Taper::between((0.0, 0.0), [(20.0f32, 0.0); 2], 5.0, 8.0).is_some());
    }

    #[test]
    fn shadows_fall_behind_what_throws_them() {
        let floor = (Vec3::new(0.0, 1.0, 0.0), -1.0);
        let sun = Shade::new(&Source::Toward(Vec3::new(0.6f32, 0.8, 0.0)), floor).unwrap();
        let shadow = sun.shadow(Vec3::new(0.0, 3.0, 2.0)).unwrap();
        assert!((shadow - Vec3::new(-3.0, -1.0, 2.0)).length() < 1e-5, "{shadow:?}");
        assert_eq!(sun.shadow(Vec3::new(0.0, -3.0, 2.0)), None);
        let lamp = Shade::new(&Source::At(Vec3::new(0.0f32, 3.0, 0.0)), floor).unwrap();
        let shadow = lamp.shadow(Vec3::new(1.0, 1.0, 0.0)).unwrap();
        assert!((shadow - Vec3::new(2.0, -1.0, 0.0)).length() < 1e-5, "{shadow:?}");
        // Above the lamp, and beside it.
        assert_eq!(lamp.shadow(Vec3::new(1.0, 3.5, 0.0)), None);
        assert_eq!(lamp.shadow(Vec3::new(1.0, 3.0, 0.0)), None);
    }
}
