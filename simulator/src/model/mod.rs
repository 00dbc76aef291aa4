//! What models in all formats need: meshes of any size in pieces that the core holds, and a camera and a light where there is none.

mod pieces;
pub(crate) mod view;

pub(crate) use pieces::Whole;

/// Texture coordinates beyond this fixed point cannot compute with.
pub(crate) const FARTHEST_UV: f32 = 59.0;
