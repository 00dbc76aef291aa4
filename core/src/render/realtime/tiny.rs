//! What is so small that it could hide between the points of the grid, where that is not known before the first ray: thin things that are
//! mirrored or refracted, or stand in the way to a light, and the smallest highlights.
//!
//! A point of the grid stands for the pixels up to half the diagonal of a cell away, and one of half the grid for half of that. Where one
//! of these could see something tiny, as the [`Cone`] around the ray tells, the square is traced in full. Asked at points of the grid and
//! of half the grid alone, that is a fifth to a half fewer instructions than at every traced pixel.
//!
//! Among more objects than a set holds, a hierarchy finds what is near a cone, and only sticks are looked for: rows of them lose most.
//! A fence of 60 poles then is byte for byte as the exact picture, for an eighth more rays. With those that are four times as long as wide,
//! a chain of rings made of 60 balls and short cylinders would take three times the rays, and with all that is small, 91 balls twice.

use super::super::Renderer;
use super::Grid;
use super::cell::SQUARE;
use super::cone::Cone;
use crate::math::{Ray, Real, Vec3};
use crate::prepared::candidates::ObjectSet;
use crate::prepared::{Hit, PreparedScene};
use crate::shape::{Form, Geometry, Hull};

/// Among more objects than a set holds, what is looked for is so many times as long as wide.
const SLENDER: u16 = 8;

/// The objects that could hide, where there are any.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tiny<R> {
    grid: Grid,
    /// Of a ray from the eye.
    cone: Cone<R>,
    /// Thin ones; `None`, where there is no set: any could be that is slender.
    thin: Option<ObjectSet>,
    /// Balls, for their highlights.
    glossy: ObjectSet,
}

impl<R: Real> Tiny<R> {
    /// `near`: so many times as far as a highlight shows, it is looked for in any case.
    pub(super) fn new<S: Geometry>(renderer: &Renderer<'_, '_, R, S>, grid: Grid, near: R) -> Option<Self> {
        let (scene, eye) = (renderer.scene, renderer.viewport.eye());
        let has_sets = scene.objects_where(|_| true).is_some();
        let cone = Cone::new(&renderer.viewport, grid, if has_sets { 0 } else { SLENDER });
        let distance = |center: Vec3<R>| (center - eye).length();
        let can_be_thin = |hull: Hull<R>| {
            // What is mirrored is seen from farther away.
            let distance = distance(hull.center);
            cone.after(distance + distance).is_wider(&hull)
        };
        let is_glossy = |object: usize| match (scene.form(object), scene.material(object)) {
            (Some(Form::Ball { center, radius }), Some(material)) if material.specular > R::ZERO => {
                let cosine = cone.after(distance(center)).opened(radius).least_cosine();
                // Near a larger one there is a point of the grid.
                !material.shininess.shows(cosine, near * R::from_u16(4))
            }
            _ => false,
        };
        let is_thin = |object: usize| scene.hulls(object).any(can_be_thin);
        let thin = scene.objects_where(is_thin);
        let has_thin = thin.map_or_else(|| scene.any_object(is_thin), |thin| !thin.is_empty());
        let glossy = scene.objects_where(is_glossy).unwrap_or(ObjectSet::NONE);
        (has_thin || !glossy.is_empty()).then_some(Self { grid, cone, thin, glossy })
    }
}

/// Watches the rays of one pixel after the other for what is tiny beside them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Watch<R> {
    tiny: Tiny<R>,
    /// Around a ray from the eye, and around what leaves the last hit.
    first: Cone<R>,
    cone: Cone<R>,
    /// Whether something tiny is near.
    pub(super) is_near: bool,
}

/// A ray, and whether it is from the eye.
type Watched<R> = (Ray<R>, bool);

impl<R: Real> Watch<R> {
    pub(super) fn new(tiny: Tiny<R>) -> Self {
        Self { tiny, first: tiny.cone, cone: tiny.cone, is_near: false }
    }

    /// For the rays of one point of a cell, if that stands for others: a corner for all up to half the cell's diagonal away, and in cells
    /// of eight pixels each fourth for half of that.
    pub(super) fn stand_for(&mut self, x: usize, y: usize) -> Option<&mut Self> {
        let (place, side) = (x | y, self.tiny.grid.pixels());
        self.first = if place % side == 0 {
            self.tiny.cone
        } else if place % SQUARE == 0 {
            self.tiny.cone.halved()
        } else {
            return None;
        };
        self.is_near = false;
        Some(self)
    }

    /// A ray hits something, and would be mirrored this way.
    #[cold]
    #[inline(never)]
    pub(super) fn hit<S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        watched: Watched<R>,
        hit: Hit<R>,
        mirrored: Vec3<R>,
    ) {
        let cone = self.look(scene, watched, hit.t);
        let (direction, point, normal) = (watched.0.direction, hit.surface.point, hit.surface.normal);
        let lights =
            |normal: Vec3<R>| scene.lights.iter().filter_map(move |light| light.seen_from(point, normal));
        let (facing, ..) = normal.facing(direction);
        let footprint = cone.footprint(direction, normal);
        self.is_near |= lights(facing).any(|(toward, distance, _)| {
            let shadow = Ray { origin: point, direction: toward };
            let beside = |_| footprint.reach();
            scene.any_beside((&shadow, distance), beside, self.tiny.thin, |object| {
                footprint.can_be_shaded(&shadow, distance, scene.hulls(object))
            })
        });
        self.cone = match scene.form(hit.object) {
            Some(Form::Ball { radius, .. }) => cone.opened(radius),
            _ => cone,
        };
        if self.tiny.glossy.contains(hit.object) {
            let least = self.cone.least_cosine();
            self.is_near |= lights(mirrored).any(|(.., cosine)| cosine > least);
        }
    }

    /// A ray hits nothing.
    #[cold]
    #[inline(never)]
    pub(super) fn miss<S: Geometry>(&mut self, scene: &PreparedScene<'_, R, S>, watched: Watched<R>) {
        self.look(scene, watched, R::FARTHEST);
    }

    /// Looks for thin things beside a ray up to this distance; the cone there. What is beside one from the eye is known. A ray that leaves
    /// a hit later than another one does begins with what that has left: with more than its own.
    #[inline(never)]
    fn look<S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        (ray, is_first): Watched<R>,
        distance: R,
    ) -> Cone<R> {
        if is_first {
            return self.first.after(distance);
        }
        let cone = self.cone;
        let can_see = |object| cone.can_see(&ray, distance, scene.hulls(object));
        self.is_near |=
            scene.any_beside((&ray, distance), |end| cone.radius_at(end), self.tiny.thin, can_see);
        cone.after(distance)
    }
}
