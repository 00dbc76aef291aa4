//! The objects that a ray may meet.

use super::ObjectSet;

/// The objects that a ray may meet, as far as that is known before it is traced.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Among<'l> {
    /// Every object of the scene.
    All,
    /// The objects of a set: in scenes of up to [`FEW_OBJECTS`](crate::limits::FEW_OBJECTS).
    Few(ObjectSet),
    /// The objects at these positions: in ascending order for the closest hit, in any order for shadow rays.
    Listed(&'l [u16]),
}
