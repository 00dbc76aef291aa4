//! What is so small that it could hide between the points of the grid, where that is not known before the first ray: thin things that are
//! mirrored or refracted, or stand in the way to a light, and highlights.
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
use super::sample::Near;
use super::sweep::{self, Sweep};
use crate::math::{Ray, Real, Vec3};
use crate::prepared::ObjectSet;
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
    /// Unit vectors to the right and up.
    sides: [Vec3<R>; 2],
    /// Thin ones; `None`, where there is no set: any could be that is slender.
    thin: Option<ObjectSet>,
}

impl<R: Real> Tiny<R> {
    pub(super) fn new<S: Geometry>(renderer: &Renderer<'_, '_, R, S>, grid: Grid) -> Option<Self> {
        let (scene, eye) = (renderer.scene, renderer.viewport.eye());
        let has_sets = scene.objects_where(|_| true).is_some();
        let cone = Cone::new(&renderer.viewport, grid, if has_sets { 0 } else { SLENDER });
        let can_be_thin = |hull: Hull<R>| {
            // What is mirrored is seen from farther away.
            let distance = (hull.center - eye).length();
            cone.after(distance + distance).is_wider(&hull)
        };
        let is_thin = |object: usize| scene.hulls(object).any(can_be_thin);
        let is_glossy = |object| scene.material(object).is_some_and(|material| material.specular > R::ZERO);
        let thin =
            scene.objects_where(is_thin).or_else(|| (!scene.any_object(is_thin)).then_some(ObjectSet::NONE));
        let has_thin = thin.is_none_or(|thin| !thin.is_empty());
        (has_thin || scene.any_object(is_glossy)).then_some(Self {
            grid,
            cone,
            thin,
            sides: renderer.viewport.sides(),
        })
    }

    /// Whether anything can be thin.
    fn has_thin(&self) -> bool {
        self.thin.is_none_or(|thin| !thin.is_empty())
    }
}

/// Watches the rays of one pixel after the other for what is tiny beside them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Watch<R> {
    tiny: Tiny<R>,
    /// Around a ray from the eye, and around what leaves the last hit.
    first: Cone<R>,
    cone: Cone<R>,
    pub(super) near: Near,
    /// Whether no other point stands for half of what this one does.
    is_least: bool,
}

/// A ray, and whether it is from the eye.
type Watched<R> = (Ray<R>, bool);

impl<R: Real> Watch<R> {
    pub(super) fn new(tiny: Tiny<R>) -> Self {
        Self { tiny, first: tiny.cone, cone: tiny.cone, near: Near::Nothing, is_least: false }
    }

    /// For the rays of one point of a cell, if that stands for others: a corner for all up to half the cell's diagonal away, and in cells
    /// of eight pixels each fourth for half of that.
    pub(super) fn stand_for(&mut self, x: usize, y: usize) -> Option<&mut Self> {
        let (place, side) = (x | y, self.tiny.grid.pixels());
        self.is_least = side <= SQUARE || place % side != 0;
        self.first = if place % side == 0 {
            self.tiny.cone
        } else if place % SQUARE == 0 {
            self.tiny.cone.halved()
        } else {
            return None;
        };
        self.near = Near::Nothing;
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
        let Some(material) = scene.material(hit.object) else { return };
        let (has_thin, glossy) = (self.tiny.has_thin(), watched.1 && material.specular > R::ZERO);
        if !(has_thin || glossy) {
            return;
        }
        let (direction, point, normal) = (watched.0.direction, hit.surface.point, hit.surface.normal);
        let footprint = cone.footprint(direction, normal);
        let sweep = || {
            let normal_beside = |step| scene.normal_beside(hit.object, &hit.surface, step);
            // What a map turns is turned beside it too.
            let bump = if material.maps.is_empty() {
                Vec3::ZERO
            } else {
                hit.surface.shading_normal - normal_beside(Vec3::ZERO)
            };
            Sweep::new(&footprint, self.tiny.sides, (direction, mirrored), |step| normal_beside(step) + bump)
        };
        let ball = match scene.form(hit.object) {
            Some(Form::Ball { radius, .. }) => Some(radius),
            _ => None,
        };
        // A ball tells without a sweep that a highlight is too far aside.
        let least_cosine_squared = match ball {
            Some(radius) if glossy && material.maps.is_empty() => {
                sweep::least_cosine_squared(&footprint, radius, &material.shininess)
            }
            _ => R::ZERO,
        };
        let mut glint = None;
        let (facing, ..) = normal.facing(direction);
        for light in scene.lights {
            if self.near == Near::Tiny {
                break;
            }
            let Some((toward, distance, _)) = light.seen_from(point, facing) else { continue };
            if has_thin {
                let shadow = Ray { origin: point, direction: toward };
                let beside = |_| footprint.reach();
                let is_near = scene.any_beside((&shadow, distance), beside, self.tiny.thin, |object| {
                    footprint.can_be_shaded(&shadow, distance, scene.hulls(object))
                });
                if is_near {
                    self.near = Near::Tiny;
                }
            }
            // One that is a right angle aside is not looked for: most need no sweep.
            let cosine = toward.dot(mirrored);
            let may_glint = cosine > R::ZERO && cosine * cosine > least_cosine_squared;
            if glossy && self.near < Near::Tiny && may_glint {
                let sweep = *glint.get_or_insert_with(sweep);
                let near = sweep.nearness(toward, &material.shininess, self.is_least);
                self.near = self.near.max(near);
            }
        }
        if has_thin {
            self.cone = match ball {
                Some(radius) => cone.opened(radius),
                None => cone.turned(glint.unwrap_or_else(sweep).reach_squared().sqrt()),
            };
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
        if self.tiny.has_thin()
            && scene.any_beside((&ray, distance), |end| cone.radius_at(end), self.tiny.thin, can_see)
        {
            self.near = Near::Tiny;
        }
        cone.after(distance)
    }
}
