//! A cylinder: a [`Cone`] whose two radii are the same.

use super::{Cone, Geometry, PreparedCone};
use crate::arena::Arena;
use crate::fault::Fault;
use crate::math::{Extent, Real, Scale, Vec3};

/// A cylinder between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Cylinder {
    /// The middle of one end.
    pub base: Vec3,
    /// The middle of the other end.
    pub top: Vec3,
    /// Radius, more than 0.
    pub radius: f32,
    /// Whether discs close the ends. If not, the cylinder is a pipe without thickness.
    pub capped: bool,
}

impl Geometry for Cylinder {
    type Prepared<'m, R: Real> = PreparedCone<R>;

    fn is_solid(&self) -> bool {
        self.capped
    }

    fn extent(&self) -> Extent {
        Cone::from(*self).extent()
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, memory: &mut Arena<'m>) -> Result<PreparedCone<R>, Fault>
    where
        Self: 'm,
    {
        Cone::from(*self).prepare(scale, memory)
    }
}

impl From<Cylinder> for Cone {
    fn from(Cylinder { base, top, radius, capped }: Cylinder) -> Self {
        Self { base, base_radius: radius, top, top_radius: radius, capped }
    }
}
