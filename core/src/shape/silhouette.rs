//! The outline and the curvature of a shape, as realtime quality needs them.
//!
//! Realtime quality traces a coarse grid of pixels. Parts of a shape that are thinner than the grid would
//! fall between its pixels, so the renderer looks up in advance where a shape is thin: by its [hulls](Hull),
//! [tips](Tip) and [rims](Rim). Exact quality uses none of this.

use super::marching::each_facet_of_any;
use super::{Facet, Form, Intersect, Tessellation};
use crate::math::{Aabb, Product, Real, Vec3};
use crate::surface::Surface;

/// The outline and the curvature of a shape, for realtime quality. Every item has a default that works, so
/// that an empty impl is enough: `impl<R: Real> Silhouette<R> for PreparedBowl<R> {}`.
///
/// With the defaults, realtime quality may lose parts of the shape that are thinner than its grid of pixels,
/// highlights of a pixel or two, and small things that the shape mirrors. Exact quality calls none of these
/// methods.
pub trait Silhouette<R: Real>: Intersect<R> {
    /// Whether [`each_rim`](Self::each_rim) visits any rims. If this is `false` for all shapes of a program,
    /// the code that finds the cells of rims is not linked.
    const HAS_RIMS: bool = false;

    /// A simple solid that encloses the shape, or a part of it: the renderer computes from it where the shape
    /// is thin.
    ///
    /// Part 0 encloses the whole shape. A shape that is loosely enclosed, such as a ring, has further hulls
    /// from part 1 on, which enclose it together; the result is `None` from the first number without a hull
    /// on. By default part 0 is the ball of [`form`](Intersect::form) or the box of
    /// [`bounds`](Intersect::bounds).
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        match self.form() {
            _ if part > 0 => None,
            Form::Ball { center, radius } => Some(Hull::ball(center, radius)),
            _ => self.bounds().map(Hull::aligned),
        }
    }

    /// How many [hulls](Self::hull) there are. By default they are counted.
    fn hulls(&self) -> usize {
        (0..).take_while(|part| self.hull(*part).is_some()).count()
    }

    /// A place where the shape tapers to a point, by a number from 0 on; `None` from the first number without
    /// a tip on. By default a shape has none.
    fn tip(&self, _number: usize) -> Option<Tip<R>> {
        None
    }

    /// Calls `visit` with each line at which the shape may end as it is seen: for shapes of many parts, such
    /// as the edges of a mesh. It is called only where [`HAS_RIMS`](Self::HAS_RIMS) is `true`. By default
    /// there are none.
    fn each_rim(&self, _visit: impl FnMut(Rim<R>)) {}

    /// The unit normal to shade with at a small `step` along the surface away from `surface`. The difference
    /// between this normal and the normal at `surface` is a measure of the curvature there. By default the
    /// normal does not change: the shape is treated as flat.
    fn normal_beside(&self, surface: &Surface<R>, _step: Vec3<R>) -> Vec3<R> {
        surface.shading_normal
    }

    /// Calls `visit` with the facets of the shape, or of an approximation, for scan conversion: neighbors one
    /// after the other, so that what was computed for a corner can be used again.
    ///
    /// By default rays in a grid through the [`bounds`](Intersect::bounds) find them. Along the longest side
    /// of the bounds, the grid has half as many cells as there are [`segments`](Tessellation::segments), but
    /// at most 24. Edges are cut off by up to a cell, and parts that are thinner may be lost. A shape without
    /// [`spans`](Intersect::spans) takes several times as long, and may end up to a cell before its border.
    /// A shape without bounds has no facets.
    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        each_facet_of_any(self, tessellation, visit);
    }
}

/// A solid that encloses a shape, or a part of it: a parallelepiped and all points within `radius` of it.
///
/// With axes of length 0, the parallelepiped is a rectangle, a line or a point. A ball is a point with a
/// radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hull<R> {
    /// The middle of the parallelepiped.
    pub center: Vec3<R>,
    /// From the center to the middles of three faces.
    pub axes: [Vec3<R>; 3],
    /// How far the hull reaches beyond the parallelepiped, in each direction.
    pub radius: R,
}

impl<R: Real> Hull<R> {
    /// A ball.
    pub const fn ball(center: Vec3<R>, radius: R) -> Self {
        Self { center, axes: [Vec3::ZERO; 3], radius }
    }

    /// All points within `radius` of the line between two points.
    pub fn line(from: Vec3<R>, to: Vec3<R>, radius: R) -> Self {
        let half = (to - from) * R::from_f32(0.5);
        Self { center: from + half, axes: [half, Vec3::ZERO, Vec3::ZERO], radius }
    }

    /// The parallelepiped spanned by three edges from a corner; an edge of length 0 makes it a parallelogram.
    // Not inlined, as the other functions that refer to this comment: this saves 2.7 KB of flash in realtime
    // quality.
    #[inline(never)]
    pub fn edges(corner: Vec3<R>, edges: [Vec3<R>; 3]) -> Self {
        let axes = edges.map(|edge| edge * R::from_f32(0.5));
        let [a, b, c] = axes;
        Self { center: corner + a + b + c, axes, radius: R::ZERO }
    }

    /// The box `bounds`.
    pub fn aligned(bounds: Aabb<R>) -> Self {
        let (Vec3 { x, y, z }, none) = (bounds.max - bounds.min, R::ZERO);
        Self::edges(
            bounds.min,
            [Vec3::new(x, none, none), Vec3::new(none, y, none), Vec3::new(none, none, z)],
        )
    }

    /// The corners of the parallelepiped, each once.
    pub fn corners(&self) -> impl Iterator<Item = Vec3<R>> {
        (0..8).filter_map(|number| self.corner(number))
    }

    /// A corner, by a number with a bit for each axis. An axis of length 0 has only its lower end: the corner
    /// of its upper end is `None`.
    // Not inlined: see `Hull::edges`.
    #[inline(never)]
    fn corner(&self, number: u32) -> Option<Vec3<R>> {
        let mut place = self.center;
        for (bit, axis) in (0..).zip(&self.axes) {
            let is_upper = number >> bit & 1 != 0;
            if is_upper && *axis == Vec3::ZERO {
                return None;
            }
            place = if is_upper { place + *axis } else { place - *axis };
        }
        Some(place)
    }
}

/// A place where a shape tapers to a point: it lies between the `apex` and the line between the two `ends`,
/// widened by `radius`. A corner of a triangle has two different ends and no radius; the point of a cone has
/// both ends in the middle of its base, and the base's radius. A shape need not list blunt tips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tip<R> {
    /// The point.
    pub apex: Vec3<R>,
    /// The ends of the line on the other side; they may be the same point.
    pub ends: [Vec3<R>; 2],
    /// How far the shape reaches beyond that line.
    pub radius: R,
}

impl<R: Real> Tip<R> {
    /// Whether the tip is longer than wide and narrower than 53°. Blunter tips have hardly any thin part.
    pub(crate) fn is_sharp(&self) -> bool {
        let [(a, length), (b, _)] = self.ends.map(|end| (end - self.apex).unit_and_length());
        // If an end coincides with the apex, its direction is arbitrary.
        a.dot(b) > R::from_f32(0.6) && self.radius + self.radius < length
    }
}

/// A line at which a shape of many parts may end as it is seen: most often an edge of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rim<R> {
    /// The ends of the line.
    pub ends: [Vec3<R>; 2],
    /// The shape of the surface next to the line.
    pub bend: Bend<R>,
}

/// How the surface is curved next to a [`Rim`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bend<R> {
    /// Smoothly, with these normals around the line, of any length. The shape ends there for an observer who
    /// sees some of them from the front and some from behind.
    Smooth([Vec3<R>; 3]),
    /// Not at all: a flat part of this width ends there.
    Sharp(R),
}

impl<R: Real> Rim<R> {
    /// Whether the shape may end at the line, seen along the direction `toward` or against it. The direction
    /// may have any length.
    pub(crate) fn is_seen_from(&self, toward: Vec3<R>) -> bool {
        match self.bend {
            Bend::Smooth(normals) => {
                let [a, b, c] = normals.map(|normal| normal.dot_wide(toward) > R::Product::ZERO);
                a != b || b != c
            }
            Bend::Sharp(_) => true,
        }
    }
}
