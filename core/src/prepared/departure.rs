//! The surface that a ray leaves, and to which side.

/// The surface that a ray leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Departure {
    /// Position of the object.
    pub(crate) object: usize,
    /// Whether the ray goes to the side that the geometric normal points to.
    pub(crate) outward: bool,
}

impl Departure {
    /// No surface.
    pub(crate) const NONE: Self = Self { object: usize::MAX, outward: false };
}
