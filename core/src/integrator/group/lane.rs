//! One pixel of a group.

use heapless::Vec;

use super::WIDTH;
use crate::color::LinearRgb;
use crate::integrator::RayBudget;
use crate::integrator::path::Path;
use crate::material::PreparedMaterial;
use crate::math::{Ray, Real, Vec3};
use crate::prepared::{Hit, ObjectSet, PreparedScene};
use crate::shape::Geometry;

/// One pixel of a group.
#[repr(C)] // As `PendingRay`.
pub(crate) struct Lane<'m, R: Real> {
    pub(super) path: Path<R>,
    pub(super) rays: RayBudget,
    /// Whether a ray is at hand.
    pub(super) goes_on: bool,
    /// The hit of the ray at hand, if there is one.
    pub(super) hit: Hit<R>,
    /// The material of the hit; `None` if the ray met nothing.
    pub(super) material: Option<&'m PreparedMaterial<'m, R>>,
}

/// The pixels of a group.
pub(crate) type Lanes<'m, R> = Vec<Lane<'m, R>, WIDTH>;

impl<'m, R: Real> Lane<'m, R> {
    /// A lane without a ray.
    pub(crate) fn new() -> Self {
        let nowhere = Ray { origin: Vec3::ZERO, direction: Vec3::ZERO };
        Self {
            path: Path::new(nowhere, ObjectSet::UNKNOWN),
            rays: RayBudget(0),
            goes_on: false,
            hit: Hit::BLANK,
            material: None,
        }
    }

    /// Begins with a camera ray and the rays that it may spend. In place: a copy would wait for what was just
    /// written to reach memory.
    pub(crate) fn begin(&mut self, ray: Ray<R>, rays: RayBudget) {
        self.path = Path::new(ray, ObjectSet::UNKNOWN);
        self.rays = rays;
        self.goes_on = true;
    }

    /// The light that came along the camera ray.
    pub(crate) fn light(&self) -> LinearRgb<R> {
        self.path.light
    }

    /// The rays that the pixel may still spend.
    pub(crate) fn rays_left(&self) -> RayBudget {
        self.rays
    }

    /// The object that the ray at hand met.
    pub(super) fn object(&self) -> Option<usize> {
        self.material.map(|_| self.hit.object)
    }

    /// Notes that the ray at hand ends at this distance, on the object of this position.
    pub(super) fn meet<S: Geometry>(&mut self, scene: &PreparedScene<'m, R, S>, closest: Option<(R, usize)>) {
        self.material = scene.write_hit(&self.path.next.ray, closest, &mut self.hit);
    }
}

/// Takes the first lanes that have the same key.
pub(super) fn take_run<'l, 'm, R: Real, K: PartialEq>(
    rest: &mut &'l mut [Lane<'m, R>],
    key: impl Fn(&Lane<'m, R>) -> K,
) -> Option<&'l mut [Lane<'m, R>]> {
    let first = key(rest.first()?);
    let count = rest.iter().take_while(|lane| key(lane) == first).count();
    let (run, others) = core::mem::take(rest).split_at_mut_checked(count)?;
    *rest = others;
    Some(run)
}
