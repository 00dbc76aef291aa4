//! Which objects a line of the picture can show, and where: most pixels then test one object, or none. And which shadows
//! fall on the largest flat object of the scene, its floor most often: most of its pixels then test nothing on the way to a
//! light.
//!
//! Each object lies inside a ball or a box, which has an [`Outline`] in the picture, and along one line that is one span of
//! pixels (Weghorst, Hooper and Greenberg, "Improved Computational Methods for Ray Tracing", ACM TOG 1984, project
//! bounding volumes into item buffers; here the buffer is one line long and holds spans). Spans are wider than what they
//! hold by more than all rounding, so that the bytes are the same with and without.

use super::outline::{Outline, Projector, Vantage};
use crate::camera::Viewport;
use crate::integrator::{Blockers, OUTLINED_LIGHTS, Sight};
use crate::math::Real;
use crate::prepared::Enclosure;
use crate::prepared::ObjectSet;
use crate::prepared::PreparedScene;
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

    /// The pixels of both, and those between.
    pub(super) fn hull(self, other: Self) -> Self {
        if other.start >= other.end {
            return self;
        }
        let end = if self.start < self.end { self.end.max(other.end) } else { other.end };
        Self { start: self.start.min(other.start), end }
    }

    /// Whether it holds any of the pixels from `left` to `right`, both included.
    pub(super) fn reaches(self, left: u16, right: u16) -> bool {
        self.start <= right && left < self.end
    }

    /// The pixels that are in both.
    pub(super) fn common(self, other: Self) -> Self {
        Self { start: self.start.max(other.start), end: self.end.min(other.end) }
    }
}

/// How many shadows are known.
const SHADOWS: usize = ObjectSet::CAPACITY / 2;

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
    others: [ObjectSet; OUTLINED_LIGHTS],
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
        others: [ObjectSet::ALL; OUTLINED_LIGHTS],
    };

    /// Finds the outlines of the objects of a scene that has not too many. They are large: they are found where they stay.
    #[inline(never)]
    pub(super) fn find<R: Real, S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        viewport: &Viewport<R>,
    ) {
        let Some(enclosures) = scene.enclosures() else { return };
        let eye = Vantage::eye(viewport);
        let (mut count, mut largest) = (0, 0);
        for (index, (place, enclosure)) in self.objects.iter_mut().zip(enclosures).enumerate() {
            *place = match enclosure {
                Enclosure::Ball { center, radius } => eye.outline(center.to_setup(), radius.to_setup()),
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
    }

    /// Finds the outlines of shadows, once those of objects are known.
    #[inline(never)]
    pub(super) fn find_shadows<R: Real, S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        viewport: &Viewport<R>,
    ) {
        let (Some(_), Some(plane)) = (self.count(), scene.plane_of(self.receiver)) else { return };
        if scene.lights.len() > OUTLINED_LIGHTS {
            // Of those no more is said than of none.
            return;
        }
        let mut places = self.shadows.iter_mut();
        for (index, (light, others)) in scene.lights.iter().zip(&mut self.others).enumerate() {
            *others = scene.may_shade(self.receiver, index);
            let projector = Projector::new(&light.source, plane, viewport);
            for object in *others {
                let Some((center, radius)) = scene.ball_of_shadow(object, &light.source) else { continue };
                let outline = projector.outline(center, radius);
                let Some(place) = places.next() else { return };
                *place = Shadow { light: index as u8, object: object as u8, outline };
                *others = others.without(object);
            }
        }
    }

    /// Of how many objects outlines are known: without the feature, the compiler sees that it is none.
    #[inline(always)]
    pub(super) fn count(&self) -> Option<usize> {
        if cfg!(feature = "candidates") { self.count } else { None }
    }

    /// Where each object can be seen on the lines from `top` to `bottom`, both included; `None` where it is not known.
    pub(super) fn strip(&self, top: u16, bottom: u16) -> Option<impl Iterator<Item = Span>> {
        let objects = self.objects.iter().take(self.count()?);
        Some(objects.map(move |outline| outline.lines(top, bottom)))
    }

    /// The largest flat object, if there is one.
    pub(super) fn receiver(&self) -> usize {
        self.receiver
    }

    /// The outlines of shadows that are less than so many lines high.
    pub(super) fn low_shadows(&self, lines: u32) -> impl Iterator<Item = &Outline> {
        let shadows = self.shadows.iter().map(|shadow| &shadow.outline);
        shadows.filter(move |outline| outline.is_lower_than(lines))
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
    shades: Blockers,
    shades_until: u16,
}

impl<'o> LineCandidates<'o> {
    /// The candidates for the pixel centers of line `y`; `None` where they are not known.
    pub(super) fn new(outlines: &'o Outlines, y: u16) -> Option<Self> {
        let objects = outlines.count()?;
        let mut spans = [Span::NOWHERE; ObjectSet::CAPACITY];
        for (span, outline) in spans.iter_mut().zip(&outlines.objects).take(objects) {
            *span = outline.span(y);
        }
        let mut shadows = [Span::NOWHERE; SHADOWS];
        for (span, shadow) in shadows.iter_mut().zip(&outlines.shadows) {
            *span = shadow.outline.span(y);
        }
        let shades = Blockers { receiver: outlines.receiver, before: outlines.others };
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

    /// The column after pixel `x` up to which nothing can be seen, if that is so; `x` never decreases.
    #[inline(always)]
    pub(super) fn nothing_until(&mut self, x: u16) -> Option<u16> {
        if x >= self.until {
            self.look_up(x);
        }
        self.current.is_empty().then_some(self.until)
    }

    /// What is known of the ray through pixel `x`, of which [`nothing_until`](Self::nothing_until) was asked last.
    #[inline(always)]
    pub(super) fn sight(&mut self, x: u16) -> Sight<'_> {
        if x >= self.shades_until {
            self.look_up_shadows(x);
        }
        Sight { among: self.current, blockers: &self.shades }
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
        self.shades.before = self.outlines.others;
        self.shades_until = u16::MAX;
        for (shadow, span) in self.outlines.shadows.iter().zip(&self.shadows) {
            if span.change_after(x, &mut self.shades_until)
                && let Some(among) = self.shades.before.get_mut(usize::from(shadow.light))
            {
                *among = among.with(usize::from(shadow.object));
            }
        }
    }
}

#[cfg(feature = "candidates")]
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_is_told_its_objects_and_their_shadows() {
        let band = |start, end| Outline::Rectangle { across: Span { start, end }, top: 2, bottom: 4 };
        let mut outlines = Outlines { count: Some(4), receiver: 1, ..Outlines::UNKNOWN };
        outlines.objects[0] = band(3, 7);
        outlines.objects[1] = Outline::Everywhere;
        outlines.objects[2] = band(5, 5);
        outlines.shadows[0] = Shadow { light: 0, object: 3, outline: band(2, 9) };
        outlines.shadows[1] = Shadow { light: 1, object: 0, outline: band(8, 12) };
        outlines.others = [ObjectSet::NONE.with(2); OUTLINED_LIGHTS];
        for y in 0..6 {
            let mut line = LineCandidates::new(&outlines, y).unwrap();
            for x in 0..20 {
                let here = |start, end| (2..4).contains(&y) && (start..end).contains(&x);
                assert_eq!(line.nothing_until(x), None);
                let sight = line.sight(x);
                let objects: Vec<usize> = if here(3, 7) { vec![0, 1] } else { vec![1] };
                assert_eq!(sight.among.collect::<Vec<_>>(), objects);
                let shades = sight.blockers;
                let first: Vec<usize> = if here(2, 9) { vec![2, 3] } else { vec![2] };
                let second: Vec<usize> = if here(8, 12) { vec![0, 2] } else { vec![2] };
                assert_eq!(shades.before[0].collect::<Vec<_>>(), first);
                assert_eq!(shades.before[1].collect::<Vec<_>>(), second);
                assert_eq!(shades.before[2].collect::<Vec<_>>(), [2]);
            }
        }
    }
}
