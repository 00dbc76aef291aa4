//! The search for things that are so small that they may lie between the pixels of the grid.
//!
//! The place of some of them is known before the first ray:
//! - **Thin objects.** A shape is enclosed by a few hulls (see [`Hull`](crate::shape::Hull)). The picture of
//!   a hull is enclosed by a [`stadium`]. The cells that a thin stadium reaches are traced in full
//!   ([`thin_cells`]).
//! - **Tips** of triangles, polygons and cones end in a narrow [`taper`]. The points of the grid near one, or
//!   near a low shadow, are marked, so that every second pixel around them is traced ([`tip_points`]).
//! - **Rims** of meshes are the lines where the surface turns away from the eye. The cells that show one are
//!   verified after they are drawn ([`rim_cells`]).
//!
//! Others are found while pixels of the grid are traced, by the [`watch`]:
//! - **Mirrored things and thin shadows.** The pixels around a traced one see what lies in a [`cone`] around
//!   its ray. A surface cuts a [`footprint`] out of the cone, and each hull near a ray is compared with it as
//!   a [`stick`].
//! - **Highlights.** Over the footprint, the mirrored direction [`sweep`]s over other directions. If the
//!   light lies within the sweep, a highlight may be seen between the pixels of the grid.

mod column_set;
mod cone;
mod footprint;
mod rim_cells;
mod shadow_projection;
mod stadium;
mod stick;
mod sweep;
mod taper;
mod thin_cells;
mod tip_points;
mod watch;

pub(super) use thin_cells::{ThinCells, heights};
pub(super) use tip_points::TipPoints;
pub(super) use watch::Watch;

use rim_cells::RimCells;
use thin_cells::thin_objects;
use tip_points::tapering_objects;

use super::grid::Grid;
use crate::math::Real;
use crate::prepared::ObjectSet;
use crate::render::Renderer;
use crate::shape::Geometry;

/// The small things of a picture, as far as they are known before the first ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct SmallThings<R> {
    /// Objects that may lie unseen between the points of the grid; `None`: any may.
    thin: Option<ObjectSet>,
    /// Objects that have a sharp tip.
    tapering: ObjectSet,
    /// The cells that show the rim of a mesh, if there are any.
    rims: Option<RimCells>,
    /// The search beside traced rays for all other small things, if the scene can have any.
    pub(super) watch: Option<Watch<R>>,
}

impl<R: Real> SmallThings<R> {
    pub(super) fn new<S: Geometry>(renderer: &Renderer<'_, '_, R, S>, grid: Grid) -> Self {
        Self {
            thin: thin_objects(renderer, grid),
            tapering: tapering_objects(renderer, grid),
            rims: RimCells::new(renderer, grid),
            watch: Watch::new(renderer, grid),
        }
    }

    /// The cells of a band that can show something thin, none of which is known yet.
    pub(super) fn thin_cells(&self, width: u16, grid: Grid) -> ThinCells {
        ThinCells::none(width, grid, self.thin)
    }

    /// The points near tips and low shadows in the two rows of the grid that a band lies between, if there
    /// are any.
    pub(super) fn tip_points<S: Geometry>(
        &self,
        renderer: &Renderer<'_, '_, R, S>,
        grid: Grid,
        rows: (u16, u16),
    ) -> Option<TipPoints> {
        TipPoints::new(renderer, grid, rows, self.tapering)
    }

    /// Whether the cell that begins at this pixel shows the rim of a mesh.
    pub(super) fn has_rim(&self, left: u32, top: u32) -> bool {
        self.rims.as_ref().is_some_and(|rims| rims.hold(left, top))
    }
}
