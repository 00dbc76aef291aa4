//! The tree, as steps that are carried out on a stack.

use super::CsgStep;
use crate::arena::Arena;
use crate::fault::Fault;
use crate::limits::MAX_CSG_SOLIDS;

/// One bit for each solid.
pub(super) type Bits = u32;

const _: () = assert!(MAX_CSG_SOLIDS == Bits::BITS as usize, "a solid, or a level of the stack, is a bit");

/// Steps that leave one solid, without the solids: these are numbered in the order of the steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Program<'m> {
    steps: &'m [CsgStep<()>],
    /// The solids that are taken away from others, and not again from what these are taken away from.
    taken_away: Bits,
}

impl<'m> Program<'m> {
    pub(super) fn new<S>(steps: &[CsgStep<S>], memory: &mut Arena<'m>) -> Result<Self, Fault> {
        let (mut next, mut taken_away): (Bits, Bits) = (1, 0);
        fold(
            steps,
            0,
            |_| {
                let solid = next;
                next = next.wrapping_shl(1);
                solid
            },
            |step, left, right| {
                if *step == CsgStep::Difference {
                    taken_away ^= right;
                }
                left | right
            },
        )?;
        let mut unprepared = steps.iter();
        let steps = memory
            .store_with(steps.len(), |_| unprepared.next().map_or(CsgStep::Union, CsgStep::operator))?;
        Ok(Self { steps, taken_away })
    }

    /// Whether the inside of this solid is outside of the whole, where they share a surface.
    pub(super) fn is_taken_away(&self, solid: u8) -> bool {
        self.taken_away.wrapping_shr(solid.into()) & 1 != 0
    }

    /// Whether a place is inside, of which it is known whether it is inside of each solid.
    pub(super) fn is_inside(&self, solids: Bits) -> bool {
        // The stack is a word too: the top is the last bit.
        let (mut rest, mut stack): (Bits, Bits) = (solids, 0);
        for step in self.steps {
            if let CsgStep::Solid(()) = step {
                stack = stack << 1 | rest & 1;
                rest >>= 1;
                continue;
            }
            let right = stack & 1;
            stack >>= 1;
            match step {
                CsgStep::Intersection => stack &= !1 | right,
                CsgStep::Difference => stack &= !right,
                _ => stack |= right,
            }
        }
        stack & 1 != 0
    }
}

impl<S> CsgStep<S> {
    /// The same without the solid.
    fn operator(&self) -> CsgStep<()> {
        match self {
            Self::Solid(_) => CsgStep::Solid(()),
            Self::Union => CsgStep::Union,
            Self::Intersection => CsgStep::Intersection,
            Self::Difference => CsgStep::Difference,
        }
    }
}

/// Carries out the steps: what each solid is, and what an operator makes of the left and the right.
pub(super) fn fold<S, T: Copy>(
    steps: &[CsgStep<S>],
    blank: T,
    mut solid: impl FnMut(&S) -> T,
    mut join: impl FnMut(&CsgStep<()>, T, T) -> T,
) -> Result<T, Fault> {
    let mut stack = [blank; MAX_CSG_SOLIDS];
    let mut depth = 0usize;
    for step in steps {
        let value = match step {
            CsgStep::Solid(shape) => solid(shape),
            operator => {
                depth = depth.checked_sub(2).ok_or(Fault::NotOneSolid)?;
                let Some([left, right, ..]) = stack.get(depth..) else { return Err(Fault::NotOneSolid) };
                join(&operator.operator(), *left, *right)
            }
        };
        *stack.get_mut(depth).ok_or(Fault::NotOneSolid)? = value;
        depth += 1;
    }
    match (depth, stack.first()) {
        (1, Some(value)) => Ok(*value),
        _ => Err(Fault::NotOneSolid),
    }
}
