//! The places at which a line enters and leaves solids.

use super::program::{Bits, Program};
use crate::limits::MAX_CSG_SOLIDS;
use crate::math::{Ray, Real};
use crate::shape::{Intersect, Spans};

/// A place where a line enters or leaves a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Boundary<R> {
    pub(super) t: R,
    pub(super) solid: u8,
}

/// The most boundaries of so many solids: each has at most [`Spans::MOST`] parts, which have two ends.
const fn most(solids: usize) -> usize {
    solids * 2 * 2
}

/// The most solids for which the short list is used: clearing the long one takes longer than testing a lens.
const FEW_SOLIDS: usize = 4;

/// Calls `work` with room for all boundaries of so many solids.
pub(super) fn with_room<R: Real, T>(solids: usize, work: impl FnOnce(&mut [Boundary<R>]) -> T) -> T {
    let blank = Boundary { t: R::ZERO, solid: 0 };
    if solids <= FEW_SOLIDS {
        work(&mut [blank; most(FEW_SOLIDS)])
    } else {
        work(&mut [blank; most(MAX_CSG_SOLIDS)])
    }
}

/// All places where a line enters or leaves solids, in order along the line.
pub(super) struct Boundaries<'b, R> {
    places: &'b mut [Boundary<R>],
    count: usize,
    /// A bit for each solid that the line is inside of before the first place.
    before: Bits,
}

impl<'b, R: Real> Boundaries<'b, R> {
    pub(super) fn new<P: Intersect<R>>(room: &'b mut [Boundary<R>], solids: &[P], ray: &Ray<R>) -> Self {
        const { assert!(Spans::<R>::MOST == 2) };
        let mut boundaries = Self { places: room, count: 0, before: 0 };
        for (number, solid) in (0u8..).zip(solids) {
            for part in solid.spans(ray).as_slice() {
                // An end at infinity is no surface.
                if part.min > -R::FARTHEST {
                    boundaries.insert(part.min, number);
                } else {
                    boundaries.before |= (1 as Bits).wrapping_shl(number.into());
                }
                if part.max < R::FARTHEST {
                    boundaries.insert(part.max, number);
                }
            }
        }
        boundaries
    }

    /// Inserts a boundary in order. There are few, so insertion sort is enough.
    fn insert(&mut self, t: R, solid: u8) {
        let Some(last) = self.places.get_mut(self.count) else { return };
        *last = Boundary { t, solid };
        let mut place = self.count;
        self.count += 1;
        while let Some(before) = place.checked_sub(1)
            && let Some([left, right]) = self.places.get_mut(before..=place)
            && left.t > right.t
        {
            core::mem::swap(left, right);
            place = before;
        }
    }

    /// The places, and the solids that the line is inside of before the first place.
    pub(super) fn parts(&self) -> (&[Boundary<R>], Bits) {
        (self.places.get(..self.count).unwrap_or_default(), self.before)
    }
}

/// The surfaces of the combined solid along a line.
pub(super) struct Surfaces<'b, R, P> {
    rest: &'b [Boundary<R>],
    /// A bit for each solid that the line is inside of after the places so far, and whether it is inside the
    /// combined solid.
    around: Bits,
    is_inside: bool,
    program: Program<'b>,
    solids: &'b [P],
    ray: &'b Ray<R>,
    tolerance: R,
}

impl<'b, R: Real, P: Intersect<R>> Surfaces<'b, R, P> {
    pub(super) fn new(
        boundaries: &'b Boundaries<'_, R>,
        program: Program<'b>,
        solids: &'b [P],
        ray: &'b Ray<R>,
        tolerance: R,
    ) -> Self {
        let (rest, around) = boundaries.parts();
        Self { rest, around, is_inside: program.is_inside(around), program, solids, ray, tolerance }
    }

    /// Whether two boundaries are so near to each other that they count as one place.
    fn is_one_place(&self, before: &Boundary<R>, after: &Boundary<R>) -> bool {
        let way = after.t - before.t;
        if way <= self.tolerance {
            return true;
        }
        // If a line grazes a face that two solids share, the way between their boundaries is long: measure it
        // at a right angle to the faces.
        let across = |boundary: &Boundary<R>| {
            let solid = self.solids.get(usize::from(boundary.solid));
            solid.map_or(way, |solid| {
                solid.surface(self.ray, boundary.t).normal.dot(self.ray.direction).abs() * way
            })
        };
        let most = R::from_u16(32);
        before.solid != after.solid
            && way <= self.tolerance * most * most
            && across(before) <= self.tolerance
            && across(after) <= self.tolerance
    }
}

impl<R: Real, P: Intersect<R>> Iterator for Surfaces<'_, R, P> {
    type Item = Boundary<R>;

    fn next(&mut self) -> Option<Boundary<R>> {
        loop {
            let first = self.rest.first()?;
            let was_inside = self.is_inside;
            // The surface is at the first boundary of the place at which the line enters or leaves the
            // combined solid. If the line is inside after the place as it was before, there is none.
            let mut surface = None;
            while let Some((boundary, rest)) = self.rest.split_first()
                && self.is_one_place(first, boundary)
            {
                self.rest = rest;
                self.around ^= (1 as Bits).wrapping_shl(boundary.solid.into());
                self.is_inside = self.program.is_inside(self.around);
                if self.is_inside != was_inside && surface.is_none() {
                    surface = Some(*boundary);
                }
            }
            if self.is_inside != was_inside && surface.is_some() {
                return surface;
            }
        }
    }
}
