//! What holds a shape, so that what is thin in a picture is known to be.

use core::f32::consts::FRAC_1_SQRT_2;

use crate::math::{Aabb, Product, Real, Vec3};

/// A parallelepiped, and all that is no farther from it than some distance: what holds a shape, or a part of it.
///
/// Axes of no length make it a rectangle, a line or a point: a ball is what is around a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hull<R> {
    /// The middle.
    pub center: Vec3<R>,
    /// From there to the middles of three faces.
    pub axes: [Vec3<R>; 3],
    /// How far it reaches around that.
    pub radius: R,
}

impl<R: Real> Hull<R> {
    /// A ball.
    pub const fn ball(center: Vec3<R>, radius: R) -> Self {
        Self { center, axes: [Vec3::ZERO; 3], radius }
    }

    /// What is around the line between two points.
    pub fn line(from: Vec3<R>, to: Vec3<R>, radius: R) -> Self {
        let half = (to - from) * R::from_f32(0.5);
        Self { center: from + half, axes: [half, Vec3::ZERO, Vec3::ZERO], radius }
    }

    /// What two or three edges from a corner span.
    #[inline(never)]
    pub fn edges(corner: Vec3<R>, edges: [Vec3<R>; 3]) -> Self {
        let axes = edges.map(|edge| edge * R::from_f32(0.5));
        let [a, b, c] = axes;
        Self { center: corner + a + b + c, axes, radius: R::ZERO }
    }

    /// A box along the coordinate axes.
    #[inline(never)]
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

    /// A corner, by a number that has a bit for each axis; one that has no length has only the lower ends.
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

/// Where a shape tapers off: what lies between a point and the line between two others, as a corner of a triangle does, or all that is no
/// farther from that line than some distance, as at the end of a cone. However wide that is, next to the point there is little. Of blunt
/// ones it need not be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tip<R> {
    /// The point.
    pub apex: Vec3<R>,
    /// The ends of the line, which may be one point.
    pub ends: [Vec3<R>; 2],
    /// How far it reaches around that.
    pub radius: R,
}

impl<R: Real> Tip<R> {
    /// Whether it is less wide than long, at less than 53°: of others there is little that is thin.
    #[inline(never)]
    pub(crate) fn is_sharp(&self) -> bool {
        let [(a, length), (b, _)] = self.ends.map(|end| (end - self.apex).unit_and_length());
        // Where an end is the very point, its direction is anything.
        a.dot(b) > R::from_f32(0.6) && self.radius + self.radius < length
    }
}

/// A line where a shape of many parts may end as it is seen: most often an edge of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rim<R> {
    /// The ends.
    pub ends: [Vec3<R>; 2],
    /// The shape next to it.
    pub bend: Bend<R>,
}

/// How a shape is bent next to a [`Rim`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bend<R> {
    /// It is smooth, and these are normals around there, of any length. It ends there where some are seen from the front and some are not.
    Smooth([Vec3<R>; 3]),
    /// What ends there is flat, and so wide.
    Sharp(R),
}

impl<R: Real> Rim<R> {
    /// Whether the shape may end there, seen along this direction or against it, of any length.
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

/// A circle around a unit vector.
pub(crate) struct Circle<R> {
    pub(crate) center: Vec3<R>,
    pub(crate) axis: Vec3<R>,
    pub(crate) radius: R,
}

/// A circle is held by so many parts.
const ARCS: usize = 16;
/// How far it is from the lines between their ends, in radii: 1 - cos(π/16).
const SAGITTA: f32 = 0.0193;

impl<R: Real> Circle<R> {
    /// What is no farther from the circle than some distance: with number 0, the whole disc; the others, from 1 on, hold it together.
    #[inline(never)]
    pub(crate) fn hull(&self, part: usize, distance: R) -> Option<Hull<R>> {
        let (u, v) = self.axis.around();
        let Some(part) = part.checked_sub(1) else {
            let axes = [u * self.radius, v * self.radius, Vec3::ZERO];
            return Some(Hull { center: self.center, axes, radius: distance });
        };
        let at = |part: usize| {
            let (along, across) = self.place(part)?;
            Some(self.center + u * along + v * across)
        };
        let (from, to) = (at(part)?, at((part + 1) % ARCS)?);
        Some(Hull::line(from, to, distance + self.radius * R::from_f32(SAGITTA)))
    }

    /// Where a part begins, in the plane of the circle.
    fn place(&self, part: usize) -> Option<(R, R)> {
        // The cosines of a quarter's parts.
        const COSINES: [f32; ARCS / 4 + 1] = [1.0, 0.923_88, FRAC_1_SQRT_2, 0.382_683, 0.0];
        let (quarter, rest) = (part / (ARCS / 4), part % (ARCS / 4));
        let cosine = |i: usize| COSINES.get(i).copied().map(|share| self.radius * R::from_f32(share));
        let (cosine, sine) = (cosine(rest)?, cosine(ARCS / 4 - rest)?);
        match quarter {
            0 => Some((cosine, sine)),
            1 => Some((-sine, cosine)),
            2 => Some((-cosine, -sine)),
            3 => Some((sine, -cosine)),
            _ => None,
        }
    }
}
