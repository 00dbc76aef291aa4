//! Parts that all importers of models share: triangles of polygons, the place of models that are far away,
//! splitting of large meshes, meshes in one plane, pictures, and default surroundings.

mod coplanar;
mod far;
mod files;
mod pictures;
mod pieces;
pub(crate) mod polygon;
pub(crate) mod view;

pub use coplanar::{Parted, part};
pub(crate) use far::Moved;
pub(crate) use files::{Beside, beside};
pub(crate) use pictures::{Pictures, Wrapping, mean_of_codes};
pub(crate) use pieces::{Whole, has_area};
pub use view::{ModelView, Up};

/// The largest texture coordinate in fixed point.
pub(crate) const FARTHEST_UV: f32 = 59.0;
