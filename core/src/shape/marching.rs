//! Solids as triangles, whatever their shape: marching tetrahedra (Payne and Toga, "Surface Mapping Brain
//! Function on 3D Models", IEEE Computer Graphics and Applications, 1990; Doi and Koide, "An Efficient Method
//! of Triangulating Equi-Valued Surfaces by Using Tetrahedral Cells", IEICE Transactions, 1991).
//!
//! The box around the solid is divided into cells, and each cell into six tetrahedra. The surface separates
//! the corners that lie inside from the others, by one triangle or two in each tetrahedron. Their corners
//! lie where rays along the edges of the tetrahedra meet the surface, so they are on it, and so the normals
//! are exact.
//!
//! # No gaps
//! All tetrahedra at an edge send the same ray along it and so find the same point.
//!
//! # Memory
//! Whether corners lie inside is known for two layers of cells at a time: a bit for each corner.

use heapless::Vec;

use super::tessellate::{Corner, triangle};
use super::{Facet, Intersect, Tessellation};
use crate::math::{Aabb, Interval, Ray, Real, Vec3};
use crate::surface::Surface;

/// The most cells along the longest side of the box.
const MOST_CELLS: u16 = 24;
/// The fewest cells along a side.
const FEWEST_CELLS: u16 = 2;
/// The most corners of cells along a side: there may be an additional cell.
const MOST_PLACES: usize = MOST_CELLS as usize + 2;

/// The corners of all cells.
pub(super) struct Lattice<R> {
    /// The corner with the smallest coordinates.
    least: Vec3<R>,
    /// The sides of a cell.
    step: Vec3<R>,
    /// How many corners there are along each axis.
    counts: [u16; 3],
}

/// The corners of cells on a line along x.
pub(super) struct Row<R> {
    start: Vec3<R>,
    step: R,
    count: u16,
}

impl<R: Real> Row<R> {
    /// Corner by corner: a bit for each that lies `inside`.
    pub(super) fn each(&self, inside: impl Fn(Vec3<R>) -> bool) -> u32 {
        (0..self.count).fold(0, |bits, number| {
            let point = Vec3::new(self.start.x + self.step * R::from_u16(number), self.start.y, self.start.z);
            bits | u32::from(inside(point)).wrapping_shl(number.into())
        })
    }

    /// A bit for each corner whose distance along the row lies in a part of its line.
    pub(super) fn within(&self, part: Interval<R>) -> u32 {
        let place = |number: u16| self.step * R::from_u16(number);
        let bit = |number: u16| u32::from(part.contains(place(number))).wrapping_shl(number.into());
        (0..self.count).fold(0, |bits, number| bits | bit(number))
    }

    /// The ray from the first corner to the others.
    pub(super) fn ray(&self) -> Ray<R> {
        Ray { origin: self.start, direction: Vec3::new(R::ONE, R::ZERO, R::ZERO) }
    }

    /// A bit for each corner inside a solid, by the parts of the ray inside it.
    fn inside_spans<S: Intersect<R> + ?Sized>(&self, solid: &S) -> u32 {
        let spans = solid.spans(&self.ray());
        spans.as_slice().iter().fold(0, |bits, part| bits | self.within(*part))
    }
}

impl<R: Real> Lattice<R> {
    /// Cells around a box: the outermost corners lie outside of it.
    pub(super) fn around(bounds: Aabb<R>, tessellation: &Tessellation<R>) -> Self {
        let half = R::from_f32(0.5);
        let Self { least, step, counts } = Self::divided(bounds, tessellation);
        Self { least: least - step * half, step, counts: counts.map(|count| count.saturating_add(1)) }
    }

    /// Cells inside a box: their outermost corners lie just inside of it.
    pub(super) fn within(bounds: Aabb<R>, tessellation: &Tessellation<R>) -> Self {
        let margin = (bounds.max - bounds.min) * R::from_fraction(1 << 8);
        Self::divided(Aabb { min: bounds.min + margin, max: bounds.max - margin }, tessellation)
    }

    fn divided(bounds: Aabb<R>, tessellation: &Tessellation<R>) -> Self {
        let sides = bounds.max - bounds.min;
        let cells = (tessellation.sides() / 2).min(MOST_CELLS);
        let cells = [sides.x, sides.y, sides.z].map(|side| {
            let share = side / sides.magnitude();
            let cells = (share * R::from_u16(cells)).floor_to_i32().saturating_add(1);
            cells.clamp(FEWEST_CELLS.into(), MOST_CELLS.into()) as u16
        });
        let [x, y, z] = cells.map(R::from_u16);
        let step = Vec3::new(sides.x / x, sides.y / y, sides.z / z);
        Self { least: bounds.min, step, counts: cells.map(|cells| cells.saturating_add(1)) }
    }

    fn at(&self, [x, y, z]: [u16; 3]) -> Vec3<R> {
        let Self { least, step, .. } = self;
        let [x, y, z] = [x, y, z].map(R::from_u16);
        Vec3::new(least.x + step.x * x, least.y + step.y * y, least.z + step.z * z)
    }

    /// Calls `visit` with the facets between the corners inside and outside. `insides` returns a bit for each
    /// corner of a row.
    pub(super) fn each_facet<S: Intersect<R> + ?Sized>(
        &self,
        shape: &S,
        is_closed: bool,
        insides: impl Fn(&Row<R>) -> u32,
        visit: &mut dyn FnMut(&Facet<R>),
    ) {
        let [count, rows, layers] = self.counts;
        let mut lower = [0; MOST_PLACES];
        for z in 0..layers {
            let mut upper = [0; MOST_PLACES];
            for (y, bits) in (0..rows).zip(&mut upper) {
                *bits = insides(&Row { start: self.at([0, y, z]), step: self.step.x, count });
            }
            if let Some(z) = z.checked_sub(1) {
                let low = lower.iter().zip(lower.iter().skip(1));
                let high = upper.iter().zip(upper.iter().skip(1));
                for (y, ((a, b), (c, d))) in (0..rows.saturating_sub(1)).zip(low.zip(high)) {
                    let mut cell = Cell::new(self, shape, [0, y, z]);
                    for x in 0..count.saturating_sub(1) {
                        let inside = [*a, *b, *c, *d].map(|row| row.wrapping_shr(x.into()) as u8 & 3);
                        cell.move_to(x, inside);
                        cell.each_facet(is_closed, visit);
                    }
                }
            }
            lower = upper;
        }
    }

    /// Calls `visit` with the facets of a shape that has no inside.
    fn each_open_facet<S: Intersect<R> + ?Sized>(&self, shape: &S, visit: &mut dyn FnMut(&Facet<R>)) {
        let [columns, rows, layers] = self.counts.map(|count| count.saturating_sub(1));
        for z in 0..layers {
            for y in 0..rows {
                for x in 0..columns {
                    Cell::new(self, shape, [x, y, z]).each_open_facet(visit);
                }
            }
        }
    }
}

/// A point of the surface on an edge.
#[derive(Clone, Copy)]
struct Crossing<R> {
    corner: Corner<R>,
    part: u32,
}

impl<R: Real> Crossing<R> {
    fn new(surface: &Surface<R>) -> Self {
        Self { corner: (surface.point, surface.shading_normal), part: surface.part }
    }
}

/// The edges of the tetrahedra in a cell: the edges of the cell, the diagonals of its faces, and its own.
const EDGES: usize = 12 + 6 + 1;

/// The tetrahedra in a cell. A corner of the cell is numbered by a bit for each axis. All tetrahedra have the
/// cell's diagonal in common, and each shares a face with the next one. Seen from its first corner, the other
/// three are counterclockwise if the axes are.
const TETRAHEDRA: [[u8; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// A cell.
struct Cell<'a, R, S: ?Sized> {
    lattice: &'a Lattice<R>,
    shape: &'a S,
    place: [u16; 3],
    /// A bit for each corner.
    inside: u8,
    /// Edges whose crossing is known: the numbers of their two corners, and the point of the surface.
    known: Vec<([u8; 2], Crossing<R>), EDGES>,
}

impl<'a, R: Real, S: Intersect<R> + ?Sized> Cell<'a, R, S> {
    fn new(lattice: &'a Lattice<R>, shape: &'a S, place: [u16; 3]) -> Self {
        Self { lattice, shape, place, inside: 0, known: Vec::new() }
    }

    /// Goes on to the next cell along x. `inside` has two bits for each of its four edges along x.
    fn move_to(&mut self, x: u16, [a, b, c, d]: [u8; 4]) {
        let [_, y, z] = self.place;
        (self.place, self.inside) = ([x, y, z], a | b << 2 | c << 4 | d << 6);
        // The two cells share a face, and what is known of its edges.
        self.known.retain_mut(|([from, to], _)| {
            let is_shared = *from & *to & 1 != 0;
            (*from, *to) = (*from & !1, *to & !1);
            is_shared
        });
    }

    /// Whether a corner lies inside.
    fn is_inside(&self, corner: u8) -> bool {
        self.inside.wrapping_shr(corner.into()) & 1 != 0
    }

    fn each_facet(&mut self, is_closed: bool, visit: &mut dyn FnMut(&Facet<R>)) {
        if self.inside == 0 || self.inside == u8::MAX {
            return;
        }
        for corners in TETRAHEDRA {
            self.cut(corners, is_closed, visit);
        }
    }

    /// Calls `visit` with the facets of a shape that has no inside. In each tetrahedron, corners lie behind
    /// the surface or in front of it. At the border of the shape the edges do not agree on that, and there is
    /// no facet.
    fn each_open_facet(&mut self, visit: &mut dyn FnMut(&Facet<R>)) {
        let mut crossed = CrossedEdges::default();
        for from in 0..8u8 {
            for to in (from.saturating_add(1)..8).filter(|to| from & to == from) {
                let (ray, length) = self.edge([from, to]);
                if let Some((surface, leaves)) = meet_once(self.shape, &ray, length) {
                    crossed.add([from, to], leaves);
                    // There is room for all edges.
                    let _ = self.known.push(([from, to], Crossing::new(&surface)));
                }
            }
        }
        for corners in TETRAHEDRA {
            if let Some(behind) = crossed.behind(corners) {
                self.inside = behind;
                self.cut(corners, false, visit);
            }
        }
    }

    /// Calls `visit` with the facets in a tetrahedron.
    fn cut(&mut self, corners: [u8; 4], is_closed: bool, visit: &mut dyn FnMut(&Facet<R>)) {
        let (part, [a, b, c, d]) = self.sorted(corners);
        let mut facet = |edges: [[u8; 2]; 3]| {
            let crossings = edges.map(|edge| self.crossing(edge));
            let [Crossing { part, .. }, ..] = crossings;
            triangle(crossings.map(|crossing| crossing.corner), part, is_closed, visit);
        };
        match part {
            Part::None => {}
            Part::One => facet([[a, b], [a, c], [a, d]]),
            Part::Three => facet([[a, b], [a, d], [a, c]]),
            Part::Two => {
                facet([[a, c], [a, d], [b, d]]);
                facet([[a, c], [b, d], [b, c]]);
            }
        }
    }

    /// How many corners of a tetrahedron lie inside, and its corners in an order of the same orientation: the
    /// one that differs from the other three first, or the two inside first.
    fn sorted(&self, [a, b, c, d]: [u8; 4]) -> (Part, [u8; 4]) {
        match [a, b, c, d].map(|corner| self.is_inside(corner)) {
            [true, false, false, false] => (Part::One, [a, b, c, d]),
            [false, true, false, false] => (Part::One, [b, a, d, c]),
            [false, false, true, false] => (Part::One, [c, d, a, b]),
            [false, false, false, true] => (Part::One, [d, c, b, a]),
            [false, true, true, true] => (Part::Three, [a, b, c, d]),
            [true, false, true, true] => (Part::Three, [b, a, d, c]),
            [true, true, false, true] => (Part::Three, [c, d, a, b]),
            [true, true, true, false] => (Part::Three, [d, c, b, a]),
            [true, true, false, false] => (Part::Two, [a, b, c, d]),
            [true, false, true, false] => (Part::Two, [a, c, d, b]),
            [true, false, false, true] => (Part::Two, [a, d, b, c]),
            [false, true, true, false] => (Part::Two, [b, c, a, d]),
            [false, true, false, true] => (Part::Two, [b, d, c, a]),
            [false, false, true, true] => (Part::Two, [c, d, a, b]),
            [true, true, true, true] | [false, false, false, false] => (Part::None, [a, b, c, d]),
        }
    }

    /// The point of the surface on the edge between two corners.
    fn crossing(&mut self, [one, other]: [u8; 2]) -> Crossing<R> {
        // In one direction for all cells: coordinates grow along the edge.
        let edge = [one.min(other), one.max(other)];
        if let Some((_, crossing)) = self.known.iter().find(|(known, _)| *known == edge) {
            return *crossing;
        }
        let crossing = self.meet(edge);
        // There is room for all edges.
        let _ = self.known.push((edge, crossing));
        crossing
    }

    /// The ray from the first corner of an edge to the second, and the length of the edge.
    fn edge(&self, edge: [u8; 2]) -> (Ray<R>, R) {
        let [origin, to] = edge.map(|corner| {
            let [x, y, z] = self.place;
            let bit = |number: u32| u16::from(corner.wrapping_shr(number) & 1);
            self.lattice.at([x.wrapping_add(bit(0)), y.wrapping_add(bit(1)), z.wrapping_add(bit(2))])
        });
        let (direction, length) = (to - origin).unit_and_length();
        (Ray { origin, direction }, length)
    }

    fn meet(&self, edge: [u8; 2]) -> Crossing<R> {
        let (ray, length) = self.edge(edge);
        let [leaves, _] = edge.map(|corner| self.is_inside(corner));
        if let Some(surface) = meet_between(self.shape, &ray, length, leaves) {
            return Crossing::new(&surface);
        }
        // A corner is as good as on the surface, and the two rays disagree on its side. Then the surface is
        // where the corner inside is.
        let Ray { origin, direction } = ray;
        let corner = if leaves { (origin, direction) } else { (ray.at(length), -direction) };
        Crossing { corner, part: 0 }
    }
}

/// The edges in a cell that cross the surface of a shape without an inside.
#[derive(Default)]
struct CrossedEdges {
    /// For each corner a bit for each corner of a larger number: whether the edge to it crosses the surface.
    crossed: [u8; 8],
    /// For each corner a bit for each corner of a larger number: whether the edge to it crosses the surface
    /// from behind.
    leaves: [u8; 8],
}

impl CrossedEdges {
    fn add(&mut self, [from, to]: [u8; 2], leaves: bool) {
        let bit = 1u8.wrapping_shl(to.into());
        for (list, value) in [(&mut self.crossed, true), (&mut self.leaves, leaves)] {
            if let Some(bits) = list.get_mut(usize::from(from))
                && value
            {
                *bits |= bit;
            }
        }
    }

    /// Whether the edge between two corners crosses the surface, and whether it does so from behind as seen
    /// from the first.
    fn between(&self, one: u8, other: u8) -> (bool, bool) {
        let (from, to) = (one.min(other), one.max(other));
        let is_in = |list: &[u8; 8]| {
            list.get(usize::from(from)).is_some_and(|bits| bits.wrapping_shr(to.into()) & 1 != 0)
        };
        (is_in(&self.crossed), is_in(&self.leaves) == (from == one))
    }

    /// A bit for each corner of a tetrahedron that lies behind the surface; `None` if the surface does not
    /// divide the corners into two groups.
    fn behind(&self, [a, b, c, d]: [u8; 4]) -> Option<u8> {
        // Whether a corner lies on the other side of the surface than the first one.
        let is_beyond = |corner: u8| self.between(a, corner).0;
        let agrees = |one: u8, other: u8| self.between(one, other).0 == (is_beyond(one) != is_beyond(other));
        let beyond = [b, c, d].into_iter().find(|corner| is_beyond(*corner))?;
        if !(agrees(b, c) && agrees(c, d) && agrees(d, b)) {
            return None;
        }
        let (_, first_is_behind) = self.between(a, beyond);
        let bit = |corner: u8, is_behind: bool| u8::from(is_behind).wrapping_shl(corner.into());
        let rest = [b, c, d].into_iter().map(|corner| bit(corner, is_beyond(corner) != first_is_behind));
        Some(rest.fold(bit(a, first_is_behind), |bits, bit| bits | bit))
    }
}

/// How many corners of a tetrahedron lie inside.
enum Part {
    /// None or all four.
    None,
    One,
    Two,
    Three,
}

/// The first place along a part of a ray where it leaves the shape, or where it enters it.
fn meet_between<R: Real, S: Intersect<R> + ?Sized>(
    shape: &S,
    ray: &Ray<R>,
    length: R,
    leaves: bool,
) -> Option<Surface<R>> {
    /// A part of a shape that is thinner than the edge may lie in between.
    const MOST_HITS: u8 = 8;
    // Also a little beyond the ends, for rounding.
    let beyond = length * R::from_fraction(1 << 8);
    let mut range = Interval { min: -beyond, max: length + beyond };
    for _ in 0..MOST_HITS {
        let t = shape.intersect(ray, range)?;
        let surface = shape.surface(ray, t);
        if (surface.normal.dot(ray.direction) > R::ZERO) == leaves {
            return Some(surface);
        }
        range.min = t;
    }
    None
}

/// The first place where a part of a ray crosses the shape, and whether it does so from behind; `None` if it
/// ends on the side where it began.
fn meet_once<R: Real, S: Intersect<R> + ?Sized>(
    shape: &S,
    ray: &Ray<R>,
    length: R,
) -> Option<(Surface<R>, bool)> {
    let mut range = Interval { min: R::ZERO, max: length };
    let t = shape.intersect(ray, range)?;
    range.min = t;
    if shape.intersect(ray, range).is_some() {
        return None;
    }
    let surface = shape.surface(ray, t);
    Some((surface, surface.normal.dot(ray.direction) > R::ZERO))
}

/// [`Silhouette::each_facet`](super::Silhouette::each_facet) of any shape: by the parts of rays inside it, or
/// by where the edges of the cells meet it, if there are no such parts.
pub(super) fn each_facet_of_any<R: Real, S: Intersect<R> + ?Sized>(
    shape: &S,
    tessellation: &Tessellation<R>,
    visit: &mut dyn FnMut(&Facet<R>),
) {
    let Some(bounds) = shape.bounds() else { return };
    let lattice = Lattice::around(bounds, tessellation);
    let mut has_spans = false;
    lattice.each_facet(shape, true, |row| row.inside_spans(shape), &mut |facet| {
        has_spans = true;
        visit(facet);
    });
    if !has_spans {
        lattice.each_open_facet(shape, visit);
    }
}
