//! Where a line enters and leaves solids.

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

/// The most that so many solids can have: none has more parts of a line inside than [`Spans`] hold.
const fn most(solids: usize) -> usize {
    solids * 2 * 2
}

/// With this many or fewer, a short list is enough: a long one takes longer to lay out than a lens to be met.
const FEW_SOLIDS: usize = 4;

/// Lends room for all boundaries of so many solids.
pub(super) fn with_room<R: Real, T>(solids: usize, work: impl FnOnce(&mut [Boundary<R>]) -> T) -> T {
    let blank = Boundary { t: R::ZERO, solid: 0 };
    if solids <= FEW_SOLIDS {
        work(&mut [blank; most(FEW_SOLIDS)])
    } else {
        work(&mut [blank; most(MAX_CSG_SOLIDS)])
    }
}

/// All places where a line enters or leaves solids, in the order of the line.
pub(super) struct Boundaries<'b, R> {
    places: &'b mut [Boundary<R>],
    count: usize,
    /// The solids that the line comes from inside of.
    before: Bits,
}

impl<'b, R: Real> Boundaries<'b, R> {
    #[inline(never)]
    pub(super) fn new<P: Intersect<R>>(room: &'b mut [Boundary<R>], solids: &[P], ray: &Ray<R>) -> Self {
        const { assert!(Spans::<R>::MOST == 2) };
        let mut boundaries = Self { places: room, count: 0, before: 0 };
        for (number, solid) in (0u8..).zip(solids) {
            for part in solid.spans(ray).as_slice() {
                // There is no surface where it has no end.
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

    /// Sorts one in: there are few.
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

    /// The places, and the solids that the line comes from inside of.
    pub(super) fn parts(&self) -> (&[Boundary<R>], Bits) {
        (self.places.get(..self.count).unwrap_or_default(), self.before)
    }
}

/// The surfaces of the whole along a line.
pub(super) struct Surfaces<'b, R, P> {
    rest: &'b [Boundary<R>],
    /// The solids that are around, and whether the whole is.
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

    /// Whether a boundary is so near to another before it that the two are one.
    fn is_one_place(&self, before: &Boundary<R>, after: &Boundary<R>) -> bool {
        let way = after.t - before.t;
        if way <= self.tolerance {
            return true;
        }
        // A line that grazes a face that two solids share has a long way from the one to the other.
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
            // Of those that are one place, the surface is the first that changes anything.
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
