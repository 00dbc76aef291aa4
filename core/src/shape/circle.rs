//! Hulls of a circle with some distance around it: of tori and discs.

use core::f32::consts::FRAC_1_SQRT_2;

use super::Hull;
use crate::math::{Real, Vec3};

/// A circle in space.
pub(super) struct Circle<R> {
    pub(super) center: Vec3<R>,
    /// The unit vector across its plane.
    pub(super) axis: Vec3<R>,
    pub(super) radius: R,
}

/// The number of arcs that a circle is divided into; each arc is enclosed by one hull.
const ARCS: usize = 16;
/// The greatest distance between an arc and its chord, in radii: 1 - cos(π/16).
const SAGITTA: f32 = 0.0193;

impl<R: Real> Circle<R> {
    /// How many hulls a circle has.
    pub(super) const HULLS: usize = 1 + ARCS;

    /// Hulls of all points that are no farther than `distance` from the circle. Number 0 encloses the whole
    /// disc; numbers 1 to [`ARCS`] enclose one arc each.
    pub(super) fn hull(&self, part: usize, distance: R) -> Option<Hull<R>> {
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

    /// The start of an arc, in coordinates of the circle's plane; `None` beyond the last arc.
    fn place(&self, part: usize) -> Option<(R, R)> {
        // The cosines of 0, 1, 2, 3 and 4 arcs.
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
