//! Which objects a line of the picture can show, and where: most pixels then test one object, or none. And which shadows
//! fall on the largest flat object of the scene, its floor most often: most of its pixels then test nothing on the way to a
//! light.
//!
//! Each object lies inside a ball or a box, which has an [`Outline`] in the picture, and along one line that is one span of
//! pixels (Weghorst, Hooper and Greenberg, "Improved Computational Methods for Ray Tracing", ACM TOG 1984, project
//! bounding volumes into item buffers; here the buffer is one line long and holds spans). Spans are wider than what they
//! hold by more than all rounding, so that the bytes are the same with and without.

use super::outline::Outline;
use crate::camera::{Rect, Viewport};
use crate::integrator::{LIGHTS, Shades, Sight};
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
    pub(super) const EVERYWHERE: Self = Self { start: 0, end: u16::MAX };

    /// Whether `x` is inside, and lowers `until` to where that changes next.
    #[inline(always)]
    fn change_after(self, x: u16, until: &mut u16) -> bool {
        let is_inside = x >= self.start && x < self.end;
        let change = if is_inside { self.end } else { self.start };
        if change > x && change < *until {
            *until = change;
        }
        is_inside
    }

    /// The pixels that are in both.
    pub(super) fn common(self, other: Self) -> Self {
        Self { start: self.start.max(other.start), end: self.end.min(other.end) }
    }
}

/// How many shadows are known.
const SHADOWS: usize = 16;

/// The outlines of all objects of a picture, and of the shadows on the largest flat one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outlines {
    objects: [Outline; ObjectSet::CAPACITY],
    /// Of how many objects; `None` where nothing is known.
    count: Option<usize>,
    /// The flat object, if there is one.
    receiver: usize,
    shadows: [Shadow; SHADOWS],
    /// What may shade it from each light and has no outline.
    others: [ObjectSet; LIGHTS],
}

/// The outline of the shadow of an object.
#[derive(Clone, Copy, Debug)]
struct Shadow {
    light: u8,
    object: u8,
    outline: Outline,
}

impl Outlines {
    /// Nothing is known.
    pub(super) const UNKNOWN: Self = Self {
        objects: [Outline::Nowhere; ObjectSet::CAPACITY],
        count: None,
        receiver: usize::MAX,
        shadows: [Shadow { light: 0, object: 0, outline: Outline::Nowhere }; SHADOWS],
        others: [ObjectSet::first(ObjectSet::CAPACITY); LIGHTS],
    };

    /// Finds the outlines of a scene that has not too many objects. They are large: they are found where they stay.
    #[inline(never)]
    pub(super) fn find<R: Real, S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        viewport: &Viewport<R>,
    ) {
        let Some(enclosures) = scene.enclosures() else { return };
        let (mut count, mut largest) = (0, 0);
        for (index, (place, enclosure)) in self.objects.iter_mut().zip(enclosures).enumerate() {
            *place = match enclosure {
                Enclosure::Ball { center, radius } => {
                    Outline::of_ball(center.to_setup(), radius.to_setup(), viewport)
                }
                Enclosure::Box(bounds) => Outline::of_box(bounds.to_setup(), viewport),
                Enclosure::Everywhere => Outline::Everywhere,
            };
            if place.area() > largest && scene.plane_of(index).is_some() {
                largest = place.area();
                self.receiver = index;
            }
            count = index + 1;
        }
        self.count = Some(count);
        self.find_shadows(scene, viewport);
    }

    fn find_shadows<R: Real, S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        viewport: &Viewport<R>,
    ) {
        let Some(plane) = scene.plane_of(self.receiver) else { return };
        let mut places = self.shadows.iter_mut();
        for (index, (light, others)) in scene.lights.iter().zip(&mut self.others).enumerate() {
            *others = scene.may_shade(self.receiver, index);
            for object in *others {
                let Some((center, radius)) = scene.ball_around(object) else { continue };
                let outline = Outline::of_shadow(center, radius, &light.source, plane, viewport);
                let Some(place) = places.next() else { return };
                *place = Shadow { light: index as u8, object: object as u8, outline };
                *others = others.without(object);
            }
        }
    }
}

/// The objects that each pixel of one line can show.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineCandidates<'o> {
    outlines: &'o Outlines,
    objects: usize,
    spans: [Span; ObjectSet::CAPACITY],
    shadows: [Span; SHADOWS],
    /// The objects whose spans hold the pixels before `until`, since the last pixel that was asked for.
    current: ObjectSet,
    until: u16,
    /// The same for the shadows.
    shades: Shades,
    shades_until: u16,
}

impl<'o> LineCandidates<'o> {
    /// The candidates for the pixel centers of line `y`; `None` where they are not known.
    pub(super) fn new(outlines: &'o Outlines, y: u16) -> Option<Self> {
        let objects = outlines.count?;
        let mut spans = [Span::NOWHERE; ObjectSet::CAPACITY];
        for (span, outline) in spans.iter_mut().zip(&outlines.objects).take(objects) {
            *span = outline.span(y);
        }
        let mut shadows = [Span::NOWHERE; SHADOWS];
        for (span, shadow) in shadows.iter_mut().zip(&outlines.shadows) {
            *span = shadow.outline.span(y);
        }
        let shades = Shades { receiver: outlines.receiver, among: outlines.others };
        Some(Self {
            outlines,
            objects,
            spans,
            shadows,
            current: ObjectSet::NONE,
            until: 0,
            shades,
            shades_until: 0,
        })
    }

    /// What is known of the ray through pixel `x`, where `x` never decreases.
    #[inline(always)]
    pub(super) fn at(&mut self, x: u16) -> Sight<'_> {
        if x >= self.until {
            self.look_up(x);
        }
        if x >= self.shades_until {
            self.look_up_shadows(x);
        }
        Sight { among: Some(self.current), shades: Some(&self.shades) }
    }

    #[inline(never)]
    fn look_up(&mut self, x: u16) {
        self.current = ObjectSet::NONE;
        self.until = u16::MAX;
        for (index, span) in self.spans.iter().take(self.objects).enumerate() {
            if span.change_after(x, &mut self.until) {
                self.current = self.current.with(index);
            }
        }
    }

    #[inline(never)]
    fn look_up_shadows(&mut self, x: u16) {
        self.shades.among = self.outlines.others;
        self.shades_until = u16::MAX;
        for (shadow, span) in self.outlines.shadows.iter().zip(&self.shadows) {
            if span.change_after(x, &mut self.shades_until)
                && let Some(among) = self.shades.among.get_mut(usize::from(shadow.light))
            {
                *among = among.with(usize::from(shadow.object));
            }
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
        (0..80).map(|y| Line::<f32>::strip(&viewport, 100, y, y).span_of_ball(center, radius)).collect()
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
        let seen =
            |center, y| Line::<f32>::strip(&viewport, 100, y, y).span_of_box(Aabb::around(center, unit));
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
    fn every_pixel_is_told_its_objects_and_their_shadows() {
        let band = |start, end| Outline::Rectangle { across: Span { start, end }, top: 2, bottom: 4 };
        let mut outlines = Outlines { count: Some(4), receiver: 1, ..Outlines::UNKNOWN };
        outlines.objects[0] = band(3, 7);
        outlines.objects[1] = Outline::Everywhere;
        outlines.objects[2] = band(5, 5);
        outlines.shadows[0] = Shadow { light: 0, object: 3, outline: band(2, 9) };
        outlines.shadows[1] = Shadow { light: 1, object: 0, outline: band(8, 12) };
        outlines.others = [ObjectSet::NONE.with(2); LIGHTS];
        for y in 0..6 {
            let mut line = LineCandidates::new(&outlines, y).unwrap();
            for x in 0..20 {
                let here = |start, end| (2..4).contains(&y) && (start..end).contains(&x);
                let sight = line.at(x);
                let objects: Vec<usize> = if here(3, 7) { vec![0, 1] } else { vec![1] };
                assert_eq!(sight.among.unwrap().collect::<Vec<_>>(), objects);
                let shades = sight.shades.unwrap();
                let first: Vec<usize> = if here(2, 9) { vec![2, 3] } else { vec![2] };
                let second: Vec<usize> = if here(8, 12) { vec![0, 2] } else { vec![2] };
                assert_eq!(shades.among[0].collect::<Vec<_>>(), first);
                assert_eq!(shades.among[1].collect::<Vec<_>>(), second);
                assert_eq!(shades.among[2].collect::<Vec<_>>(), [2]);
            }
        }
    }
}
