//! The tree of operators, as steps that are carried out on a stack.

use super::CsgStep;
use crate::arena::Arena;
use crate::fault::Fault;
use crate::limits::MAX_CSG_SOLIDS;

/// One bit for each solid.
pub(super) type Bits = u32;

const _: () = assert!(MAX_CSG_SOLIDS == Bits::BITS as usize, "a solid, or a level of the stack, is a bit");

/// The steps without the solids, which are numbered in the order of the steps. The steps are known to leave
/// one solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Program<'m> {
    steps: &'m [CsgStep<()>],
    /// A bit for each solid: whether it is subtracted an odd number of times.
    subtracted: Bits,
}

impl<'m> Program<'m> {
    pub(super) fn new<S>(steps: &[CsgStep<S>], memory: &mut Arena<'m>) -> Result<Self, Fault> {
        let (mut next, mut subtracted): (Bits, Bits) = (1, 0);
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
                    subtracted ^= right;
                }
                left | right
            },
        )?;
        let mut unprepared = steps.iter();
        let steps = memory
            .store_with(steps.len(), |_| unprepared.next().map_or(CsgStep::Union, CsgStep::operator))?;
        Ok(Self { steps, subtracted })
    }

    /// Whether the inside of this solid is outside of the combined solid, where the two share a surface.
    pub(super) fn is_subtracted(&self, solid: u8) -> bool {
        self.subtracted.wrapping_shr(solid.into()) & 1 != 0
    }

    /// Whether a place is inside the combined solid. Bit i of `solids` is 1 if the place is inside solid i.
    pub(super) fn is_inside(&self, solids: Bits) -> bool {
        // The stack is a word, too: the lowest bit is its top.
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
    /// The step without the solid.
    fn operator(&self) -> CsgStep<()> {
        match self {
            Self::Solid(_) => CsgStep::Solid(()),
            Self::Union => CsgStep::Union,
            Self::Intersection => CsgStep::Intersection,
            Self::Difference => CsgStep::Difference,
        }
    }
}

/// Carries out the steps: `solid` computes the value of a solid, and `join` the result of an operator on the
/// last but one and the last value on the stack.
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
