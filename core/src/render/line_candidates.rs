//! Which objects a line of the picture can show, and where: most pixels then test one object, or none.
//!
//! Each object lies inside a ball or a box, and along one line of the picture that is seen in one span of pixels
//! (Weghorst, Hooper and Greenberg, "Improved Computational Methods for Ray Tracing", ACM TOG 1984, project
//! bounding volumes into item buffers; here the buffer is one line long and holds spans). A span is found anew for
//! each line, for about a hundred instructions an object. Spans are wider than what they hold by more than all
//! rounding, so that the bytes are the same with and without.

use crate::camera::{Rect, Viewport};
use crate::math::{Aabb, Real, Vec3};
use crate::prepared::PreparedScene;
use crate::prepared::candidates::ObjectSet;
use crate::prepared::queries::Enclosure;
use crate::shape::Geometry;

/// The pixels `start..end` of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) start: u16,
    pub(super) end: u16,
}

impl Span {
    pub(super) const NOWHERE: Self = Self { start: u16::MAX, end: u16::MAX };
    const EVERYWHERE: Self = Self { start: 0, end: u16::MAX };

    /// The pixels that are in both.
    pub(super) fn common(self, other: Self) -> Self {
        Self { start: self.start.max(other.start), end: self.end.min(other.end) }
    }
}

/// The objects that each pixel of one line can show.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineCandidates {
    spans: [Span; ObjectSet::CAPACITY],
    objects: usize,
    /// The objects whose spans hold the pixels before `until`, since the last pixel that was asked for.
    current: ObjectSet,
    until: u16,
}

impl LineCandidates {
    /// The candidates for the pixel centers of line `y`; `None` where the scene has too many objects.
    pub(super) fn new<R: Real, S: Geometry>(
        scene: &PreparedScene<'_, R, S>,
        viewport: &Viewport<R>,
        width: u16,
        y: u16,
    ) -> Option<Self> {
        let line = Line::new(viewport, width, y);
        let mut spans = [Span::NOWHERE; ObjectSet::CAPACITY];
        let mut objects = 0;
        for (span, enclosure) in spans.iter_mut().zip(scene.enclosures()?) {
            *span = line.span(enclosure);
            objects += 1;
        }
        Some(Self { spans, objects, current: ObjectSet::NONE, until: 0 })
    }

    /// The objects that pixel `x` can show, where `x` never decreases.
    #[inline(always)]
    pub(super) fn at(&mut self, x: u16) -> ObjectSet {
        if x >= self.until {
            self.look_up(x);
        }
        self.current
    }

    fn look_up(&mut self, x: u16) {
        self.current = ObjectSet::NONE;
        self.until = u16::MAX;
        for (index, span) in self.spans.iter().take(self.objects).enumerate() {
            let change = if x < span.start {
                span.start
            } else if x < span.end {
                self.current = self.current.with(index);
                span.end
            } else {
                continue;
            };
            self.until = self.until.min(change);
        }
    }
}

/// A line of the picture, as directions from the eye; in floating point, like everything that is not done per ray.
pub(super) struct Line<'v, R: Real> {
    viewport: &'v Viewport<R>,
    width: R::Setup,
    /// In pixels from the top, at the middle of the line.
    y: R::Setup,
    /// How many pixels above and below count as well.
    reach: R::Setup,
    /// Direction of the line's beginning, and from there to its end.
    start: Vec3<R::Setup>,
    across: Vec3<R::Setup>,
}

impl<'v, R: Real> Line<'v, R> {
    fn new(viewport: &'v Viewport<R>, width: u16, y: u16) -> Self {
        Self::strip(viewport, width, y, y)
    }

    /// The lines from `top` to `bottom`, both included, as one.
    pub(super) fn strip(viewport: &'v Viewport<R>, width: u16, top: u16, bottom: u16) -> Self {
        let (top, bottom) = (R::Setup::from_u16(top), R::Setup::from_u16(bottom));
        let half = R::Setup::from_f32(0.5);
        let y = (top + bottom) * half + half;
        let (start, across) = viewport.line(y);
        Self { viewport, width: R::Setup::from_u16(width), y, reach: (bottom - top) * half, start, across }
    }

    /// The heights that count, and `more` above and below.
    pub(super) fn reach_of_pixels(&self, more: R::Setup) -> (R::Setup, R::Setup) {
        (self.y - self.reach - more, self.y + self.reach + more)
    }

    /// Where an object can be seen that is inside of this.
    pub(super) fn span(&self, enclosure: Enclosure<R>) -> Span {
        match enclosure {
            Enclosure::Ball { center, radius } => self.span_of_ball(center.to_setup(), radius.to_setup()),
            Enclosure::Box(bounds) => self.span_of_box(bounds.to_setup()),
            Enclosure::Everywhere => Span::EVERYWHERE,
        }
    }

    /// The direction d = start + x · across meets a ball around c where (c · d)² ≥ (c² − r²) d²: between the roots
    /// of a parabola in x.
    fn span_of_ball(&self, center: Vec3<R::Setup>, radius: R::Setup) -> Span {
        let c = center - self.viewport.eye().to_setup();
        let distance = c.length();
        // What a ball shows within reach, a larger one shows on the line.
        let radius = radius + distance * self.reach * self.viewport.pixel();
        // Of a ball that is seen smaller than a few degrees, rounding would eat the difference of squares.
        let radius = radius.larger(distance * R::Setup::from_f32(0.02)) * R::Setup::from_f32(1.01);
        if distance <= radius {
            return Span::EVERYWHERE;
        }
        // In units of the distance, so that nothing is large.
        let scale = distance.recip();
        let (c, relative) = (c * scale, radius * scale);
        let k = R::Setup::ONE - relative * relative;
        let (along, beginning) = (c.dot(self.across), c.dot(self.start));
        let a = k * self.across.length_squared() - along * along;
        let b = along * beginning - k * self.across.dot(self.start);
        let discriminant = b * b + a * (beginning * beginning - k * self.start.length_squared());
        // Open to one side: the ball reaches around the camera.
        if !(a > R::Setup::from_f32(1e-3) * self.across.length_squared()) {
            return Span::EVERYWHERE;
        }
        if !(discriminant > R::Setup::ZERO) {
            return Span::NOWHERE;
        }
        // The other half of the cone is behind the camera.
        let middle = b / a;
        if beginning + middle * along < R::Setup::ZERO {
            return Span::NOWHERE;
        }
        let half = discriminant.sqrt() / a;
        self.pixels((middle - half) * self.width, (middle + half) * self.width)
    }

    /// A box is seen inside the rectangle around its eight corners.
    fn span_of_box(&self, bounds: Aabb<R::Setup>) -> Span {
        let Some(Rect { left, right, top, bottom }) = self.viewport.frame(bounds) else {
            return Span::EVERYWHERE;
        };
        let margin = R::Setup::ONE + self.reach;
        if self.y < top - margin || self.y > bottom + margin {
            Span::NOWHERE
        } else {
            self.pixels(left, right)
        }
    }

    /// The pixels whose centers may lie between these two places, and one more on each side.
    pub(super) fn pixels(&self, left: R::Setup, right: R::Setup) -> Span {
        let pixel = |place: R::Setup, more: i32| {
            let clamped = if place > self.width { self.width } else { place.larger(R::Setup::ZERO) };
            u16::try_from(clamped.floor_to_i32().saturating_add(more).max(0)).unwrap_or(u16::MAX)
        };
        Span { start: pixel(left, -1), end: pixel(right, 2) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::math::Scale;

    const CAMERA: Camera = Camera {
        eye: Vec3::new(0.0, 0.0, 10.0),
        target: Vec3::new(0.0, 0.0, 0.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.8,
    };

    fn spans_of_ball(center: Vec3, radius: f32) -> Vec<Span> {
        let viewport = Viewport::new(&CAMERA.prepare::<f32>(Scale::ONE).unwrap(), 100, 80);
        (0..80).map(|y| Line::<f32>::new(&viewport, 100, y).span_of_ball(center, radius)).collect()
    }

    #[test]
    fn spans_fit_the_ball() {
        let center = Vec3::new(0.7, -0.3, 1.0);
        let viewport = Viewport::new(&CAMERA.prepare::<f32>(Scale::ONE).unwrap(), 100, 80);
        for (y, span) in (0..80u16).zip(spans_of_ball(center, 1.5)) {
            let sees = |x: u16| {
                let ray = viewport.ray((x, 0x8000), (y, 0x8000));
                let across = (center - ray.origin).cross(ray.direction).length();
                across < 1.5
            };
            let seen: Vec<u16> = (0..100).filter(|x| sees(*x)).collect();
            match (seen.first(), seen.last()) {
                (Some(first), Some(last)) => {
                    assert!(
                        span.start <= *first && span.end > *last,
                        "{span:?} at {y}, not {first} to {last}"
                    );
                    assert!(span.end - span.start < last - first + 14, "{span:?} is loose at {y}");
                }
                _ => assert!(span == Span::NOWHERE || span.end - span.start < 14, "{span:?} at {y}"),
            }
        }
    }

    #[test]
    fn behind_the_camera_is_nowhere_and_around_it_is_everywhere() {
        assert!(spans_of_ball(Vec3::new(0.0, 0.0, 20.0), 1.0).iter().all(|span| *span == Span::NOWHERE));
        assert!(spans_of_ball(Vec3::new(0.0, 0.0, 10.5), 1.0).iter().all(|span| *span == Span::EVERYWHERE));
    }

    #[test]
    fn boxes_are_seen_between_their_corners() {
        let viewport = Viewport::new(&CAMERA.prepare::<f32>(Scale::ONE).unwrap(), 100, 80);
        let unit = Vec3::new(1.0, 1.0, 1.0);
        let seen = |center, y| Line::<f32>::new(&viewport, 100, y).span_of_box(Aabb::around(center, unit));
        // Half a unit is 80 / 2 / tan(0.4) / 9 / 2 pixels high at its front.
        let half = 40.0 / 0.4f32.tan() / 9.0;
        let Span { start, end } = seen(Vec3::ZERO, 40);
        assert!(
            (f32::from(start) - (50.0 - half)).abs() < 2.5 && (f32::from(end) - (50.0 + half)).abs() < 2.5
        );
        assert_eq!(seen(Vec3::ZERO, 5), Span::NOWHERE);
        assert_eq!(seen(CAMERA.eye, 5), Span::EVERYWHERE);
    }

    #[test]
    fn every_pixel_is_told_its_objects() {
        let mut spans = [Span::NOWHERE; ObjectSet::CAPACITY];
        spans[0] = Span { start: 3, end: 7 };
        spans[1] = Span::EVERYWHERE;
        spans[2] = Span { start: 5, end: 5 };
        let mut line = LineCandidates { spans, objects: 4, current: ObjectSet::NONE, until: 0 };
        for x in 0..20 {
            let expected: Vec<usize> = if (3..7).contains(&x) { vec![0, 1] } else { vec![1] };
            assert_eq!(line.at(x).collect::<Vec<_>>(), expected);
        }
    }
}
