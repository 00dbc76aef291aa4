//! The cone around a traced ray that holds the rays of the pixels that the traced one stands for (Amanatides,
//! "Ray Tracing with Cones", SIGGRAPH 1984).
//!
//! A ray beside the traced one may meet something thin that lies within the cone and is mirrored, or stands
//! before a light. (Thin things that are seen directly are found by [`thin_cells`](super::thin_cells).)
//!
//! The cone reaches as far as half the diagonal of a cell. A curved mirror opens it, as two places of the
//! mirror have different normals: a ball opens it by the ball's radius, other shapes by how far the mirrored
//! direction [`sweep`](super::sweep)s.

use super::super::grid::Grid;
use super::stick::{Stick, any_thin};
use crate::camera::Viewport;
use crate::math::{Ray, Real};
use crate::shape::Hull;

/// The cone around a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone<R> {
    /// The radius where the ray begins.
    pub(super) radius: R,
    /// How much the radius grows with each unit along the ray.
    pub(super) spread: R,
    /// The things that are searched for are at least this many times as long as wide.
    pub(super) slenderness: R,
}

impl<R: Real> Cone<R> {
    /// The cone of a ray from the eye, to search for things at least `slenderness` times as long as wide.
    pub(super) fn new(viewport: &Viewport<R>, grid: Grid, slenderness: u16) -> Self {
        let half_diagonal = R::Setup::from_u16(grid.pixels() as u16) * R::Setup::from_f32(0.71);
        let spread = R::from_setup(half_diagonal * viewport.pixel()).smaller(R::ONE);
        Self { radius: R::ZERO, spread, slenderness: R::from_u16(slenderness) }
    }

    /// The cone of half the width.
    pub(super) fn halved(self) -> Self {
        let half = R::from_f32(0.5);
        Self { radius: self.radius * half, spread: self.spread * half, ..self }
    }

    /// The rest of the cone after this distance.
    pub(super) fn after(self, distance: R) -> Self {
        Self { radius: self.radius_at(distance), ..self }
    }

    /// The cone after it is mirrored or refracted by a ball of this radius. Over the cone's width, the ball
    /// turns rays by up to 2 radius / ball_radius, but at most 1.
    pub(super) fn opened_by_ball(self, ball_radius: R) -> Self {
        self.opened((self.radius + self.radius).smaller(ball_radius) / ball_radius)
    }

    /// The cone after a surface has turned the rays at its border by this angle against the middle one.
    pub(super) fn opened(self, turn: R) -> Self {
        Self { spread: (self.spread + turn).smaller(R::ONE), ..self }
    }

    /// Whether the cone searches for a hull, and is wider than it where the hull is narrowest.
    pub(super) fn is_wider(self, hull: &Hull<R>) -> bool {
        let stick = Stick::new(hull);
        stick.is_thinner(self.radius) && stick.is_slender(self.slenderness)
    }

    /// The radius at this distance along the ray.
    pub(super) fn radius_at(&self, distance: R) -> R {
        self.radius + self.spread * distance
    }

    /// Whether a ray within the cone can meet something thin before `distance`, in a shape with these hulls.
    /// The first hull encloses all others.
    pub(super) fn can_see(&self, ray: &Ray<R>, distance: R, hulls: impl Iterator<Item = Hull<R>>) -> bool {
        any_thin(self.slenderness, hulls, |stick| {
            stick.thickness_beside(ray, distance, |t, _| self.radius_at(t))
        })
    }
}
