//! Parts that all importers of models share: splitting of large meshes, and a default camera and light.

mod pieces;
pub(crate) mod view;

pub(crate) use pieces::Whole;
pub use view::{ModelView, Up};

/// The largest texture coordinate in fixed point.
pub(crate) const FARTHEST_UV: f32 = 59.0;
