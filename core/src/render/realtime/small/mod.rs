//! What looks for things that are so small that they could lie unseen between the pixels of the grid.

mod column_set;
mod cone;
mod rim_cells;
mod stadium;
mod sweep;
mod taper;
mod thin_cells;
mod tip_points;
mod watch;

pub(super) use rim_cells::RimCells;
pub(super) use thin_cells::{ThinCells, heights, thin_objects};
pub(super) use tip_points::{TipPoints, tapering_objects};
pub(super) use watch::{Tiny, Watch};
