//! How curved surfaces become facets: a circle becomes a polygon, and a surface with two coordinates becomes
//! a grid of triangles between points of it.
//!
//! A corner is computed by the same steps for all facets that meet in it, so they leave no gaps.

use core::f32::consts::FRAC_PI_2;

use heapless::Vec;

use super::{Facet, Tessellation, list};
use crate::limits::{MAX_SEGMENTS, MIN_SEGMENTS};
use crate::math::{Real, Vec3, float};

/// A point of a surface, and the unit normal to shade with there.
pub(super) type Corner<R> = (Vec3<R>, Vec3<R>);

impl<R: Real> Tessellation<R> {
    /// The sides of the polygon that takes the place of a circle.
    pub(super) fn sides(&self) -> u16 {
        self.segments.clamp(MIN_SEGMENTS, MAX_SEGMENTS)
    }
}

/// Cosines and sines of directions that are evenly spread around a circle.
pub(super) struct Directions<R>(Vec<(R, R), { MAX_SEGMENTS as usize }>);

impl<R: Real> Directions<R> {
    /// At most [`MAX_SEGMENTS`] directions.
    pub(super) fn new(count: u16) -> Self {
        Self(list((0..count.min(MAX_SEGMENTS)).map(|number| direction(number, count))))
    }

    /// Cosine and sine of a direction, by its number. The number behind the last is the first again.
    pub(super) fn at(&self, number: u16) -> (R, R) {
        let number = usize::from(number).checked_rem(self.0.len()).unwrap_or(0);
        self.0.get(number).copied().unwrap_or((R::ONE, R::ZERO))
    }
}

/// Cosine and sine of `number` times a turn divided by `count`. They are exact for quarters of a turn.
fn direction<R: Real>(number: u16, count: u16) -> (R, R) {
    let (number, count) = (u32::from(number) * 4, u32::from(count));
    let (quarter, rest) = (number.checked_div(count).unwrap_or(0), number.checked_rem(count).unwrap_or(0));
    let (sine, cosine) = float::set_up_sin_cos(rest as f32 / count as f32 * FRAC_PI_2);
    let (sine, cosine) = (R::Setup::from_f32(sine), R::Setup::from_f32(cosine));
    // Both have the digits of `f32`: make the squares add up to 1 in all digits.
    let length = (sine * sine + cosine * cosine).sqrt();
    let (cosine, sine) = (R::from_setup(cosine / length), R::from_setup(sine / length));
    match quarter % 4 {
        0 => (cosine, sine),
        1 => (-sine, cosine),
        2 => (-cosine, -sine),
        _ => (sine, -cosine),
    }
}

/// A surface with two coordinates, cut into `columns` times `rows` parts. As seen from the front, columns are
/// numbered to the right, and rows upward.
pub(super) struct Grid {
    pub(super) columns: u16,
    pub(super) rows: u16,
    pub(super) is_closed: bool,
}

impl Grid {
    /// Calls `visit` with two facets for each part, or with one where two corners coincide. `corner` returns
    /// the corner by column and row.
    pub(super) fn each_facet<R: Real>(
        &self,
        corner: impl Fn(u16, u16) -> Corner<R>,
        visit: &mut dyn FnMut(&Facet<R>),
    ) {
        let is_closed = self.is_closed;
        for row in 0..self.rows {
            let (mut low, mut high) = (corner(0, row), corner(0, row.saturating_add(1)));
            for column in 1..=self.columns {
                let (next_low, next_high) = (corner(column, row), corner(column, row.saturating_add(1)));
                triangle([low, next_low, next_high], 0, is_closed, visit);
                triangle([low, next_high, high], 0, is_closed, visit);
                (low, high) = (next_low, next_high);
            }
        }
    }
}

/// Calls `visit` with a facet, unless two of its corners coincide.
pub(super) fn triangle<R: Real>(
    corners: [Corner<R>; 3],
    part: u32,
    is_closed: bool,
    visit: &mut dyn FnMut(&Facet<R>),
) {
    let [(a, _), (b, _), (c, _)] = corners;
    if a != b && b != c && c != a {
        let normals = corners.map(|(_, normal)| normal);
        visit(&Facet { corners: [a, b, c], normals, part, is_closed });
    }
}

/// Calls `visit` with the facets of a flat convex face. Its corners are in order, counterclockwise.
pub(super) fn face<R: Real>(
    corners: &[Vec3<R>],
    normal: Vec3<R>,
    part: u32,
    is_closed: bool,
    visit: &mut dyn FnMut(&Facet<R>),
) {
    let Some((first, rest)) = corners.split_first() else { return };
    for (second, third) in rest.iter().zip(rest.iter().skip(1)) {
        triangle([*first, *second, *third].map(|corner| (corner, normal)), part, is_closed, visit);
    }
}

/// Calls `visit` with the facets of the image of a ball. `corner` maps a point of the unit ball to the
/// surface. The poles of the ball lie along y. `is_mirrored` is `true` if the image is a mirror image.
pub(super) fn globe<R: Real>(
    tessellation: &Tessellation<R>,
    is_mirrored: bool,
    corner: impl Fn(Vec3<R>) -> Corner<R>,
    visit: &mut dyn FnMut(&Facet<R>),
) {
    // An even number: then the directions serve for both coordinates.
    let columns = tessellation.sides() & !1;
    let directions = Directions::<R>::new(columns);
    let place = |column: u16, row: u16| {
        let ((down, across), (x, z)) = (directions.at(row), directions.at(column));
        let z = across * z;
        corner(Vec3::new(across * x, -down, if is_mirrored { z } else { -z }))
    };
    Grid { columns, rows: columns / 2, is_closed: true }.each_facet(place, visit);
}

/// A ring, or a disc if the inner radius is 0.
pub(super) struct Ring<R> {
    pub(super) center: Vec3<R>,
    /// Two unit vectors in its plane, and the unit normal. They are at right angles to each other.
    pub(super) axes: [Vec3<R>; 3],
    /// The outer radius and the inner one.
    pub(super) radii: [R; 2],
    pub(super) is_closed: bool,
}

impl<R: Real> Ring<R> {
    /// Calls `visit` with the facets. The corners lie in these directions. They are counterclockwise as seen
    /// from the front, unless the two vectors in the plane are clockwise.
    pub(super) fn each_facet(
        &self,
        directions: &Directions<R>,
        is_clockwise: bool,
        visit: &mut dyn FnMut(&Facet<R>),
    ) {
        let [first, second, normal] = self.axes;
        let [outer, inner] = self.radii;
        let columns = directions.0.len() as u16;
        let corner = |column: u16, row: u16| {
            let number = if is_clockwise { columns.saturating_sub(column) } else { column };
            let (along, across) = directions.at(number);
            let outward = first * along + second * across;
            (self.center + outward * if row == 0 { outer } else { inner }, normal)
        };
        Grid { columns, rows: 1, is_closed: self.is_closed }.each_facet(corner, visit);
    }
}
