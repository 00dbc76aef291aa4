//! The footprint of a cone: the ellipse that it cuts out of a surface. A shadow ray from the middle stands
//! for the shadow rays from the whole footprint.

use core::f32::consts::FRAC_1_SQRT_2;

use super::cone::Cone;
use super::stick::any_thin;
use crate::math::{Ray, Real, Vec3};
use crate::shape::Hull;

/// The least cosine between a ray and a surface's normal that counts: beyond it, the footprint does not get
/// longer.
const LEAST_COSINE: f32 = 1.0 / 16.0;

/// The ellipse that a cone cuts out of a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Footprint<R> {
    /// The cone from the surface on.
    cone: Cone<R>,
    /// Unit vector of the ray, toward the surface.
    direction: Vec3<R>,
    normal: Vec3<R>,
    /// The cosine between the two, and at least [`LEAST_COSINE`] away from 0.
    slant: R,
}

impl<R: Real> Footprint<R> {
    /// The footprint on a surface of this normal that a ray meets from this direction, where `cone` begins.
    pub(super) fn new(cone: Cone<R>, direction: Vec3<R>, normal: Vec3<R>) -> Self {
        let cosine = direction.dot(normal);
        let slant = cosine.abs().larger(R::from_f32(LEAST_COSINE));
        Self { cone, direction, normal, slant: if cosine < R::ZERO { -slant } else { slant } }
    }

    /// The ray that is half a cell away from the middle one, `toward` the right or the top of the picture:
    /// the step on the surface from the footprint's middle to the ray's end, and the difference of the
    /// directions.
    pub(super) fn step(&self, toward: Vec3<R>) -> (Vec3<R>, Vec3<R>) {
        let Self { cone, direction, normal, slant } = *self;
        let least = R::from_f32(0.25);
        let slant = if slant < R::ZERO { slant.smaller(-least) } else { slant.larger(least) };
        let aside = toward * R::from_f32(FRAC_1_SQRT_2);
        let along = aside - direction * (normal.dot(aside) / slant);
        (along * cone.radius, aside * cone.spread)
    }

    /// Half the length of the ellipse.
    pub(super) fn reach(&self) -> R {
        self.cone.radius / self.slant.abs()
    }

    /// Whether something thin can stand between a place of the footprint and a light, in a shape with these
    /// hulls. The light is at `distance` along `shadow_ray` from the middle.
    pub(super) fn can_be_shaded(
        &self,
        shadow_ray: &Ray<R>,
        distance: R,
        hulls: impl Iterator<Item = Hull<R>>,
    ) -> bool {
        // A step g across the ray becomes g - direction (g · normal) / (direction · normal) on the surface.
        let Self { cone, direction, normal, slant } = *self;
        let radius =
            |_, toward: Vec3<R>| cone.radius * (toward - normal * (direction.dot(toward) / slant)).length();
        any_thin(cone.slenderness, hulls, |stick| stick.thickness_beside(shadow_ray, distance, radius))
    }
}
