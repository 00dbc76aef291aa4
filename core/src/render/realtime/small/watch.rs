//! Watches the rays of traced pixels for small things beside them, whose place is not known before the first
//! ray: thin things that are mirrored, refracted or stand before a light, and highlights.
//!
//! A corner of a cell stands for the pixels up to half the cell's diagonal away. In cells of eight pixels, a
//! point halfway between the corners stands for the pixels up to half this distance away. If the [`Cone`]
//! around the ray shows that one of these pixels could see something tiny, the squares around the point are
//! traced in full. No other points are watched.
//!
//! A scene with more objects than a set holds is searched with its hierarchy, and only for slender things:
//! shadows and mirror images of rows of poles suffer most, and a search for all small things would trace most
//! of the picture.

use super::super::grid::{Grid, SQUARE};
use super::super::sample::Near;
use super::cone::Cone;
use super::footprint::Footprint;
use super::sweep::Sweep;
use crate::material::PreparedMaterial;
use crate::math::{Ray, Real, Vec3};
use crate::prepared::ObjectSet;
use crate::prepared::{Hit, PreparedScene};
use crate::render::Renderer;
use crate::shape::{Form, Geometry, Hull};

/// Among more objects than a set holds, only things this many times as long as wide are searched for.
const SLENDERNESS: u16 = 8;

/// The small things that the rays of a picture are watched for.
#[derive(Clone, Copy, Debug)]
struct Targets<R> {
    grid: Grid,
    /// The cone of a ray from the eye through a point of the grid.
    cone: Cone<R>,
    /// Unit vectors to the right and up in the picture.
    right_and_up: [Vec3<R>; 2],
    /// The objects that may be thin. `None`: the scene has no sets, and any slender object may be.
    thin: Option<ObjectSet>,
}

impl<R: Real> Targets<R> {
    /// `None` if a scene has neither thin nor glossy objects.
    fn new<S: Geometry>(renderer: &Renderer<'_, '_, R, S>, grid: Grid) -> Option<Self> {
        let (scene, eye) = (renderer.scene, renderer.viewport.eye());
        let has_sets = scene.objects_where(|_| true).is_some();
        let cone = Cone::new(&renderer.viewport, grid, if has_sets { 0 } else { SLENDERNESS });
        let can_be_thin = |hull: Hull<R>| {
            // In a mirror, the hull is seen from farther away.
            let distance = (hull.center - eye).length();
            cone.after(distance + distance).is_wider(&hull)
        };
        let is_thin = |object: usize| scene.hulls(object).any(can_be_thin);
        let is_glossy = |object| scene.material(object).is_some_and(|material| material.specular > R::ZERO);
        let thin =
            scene.objects_where(is_thin).or_else(|| (!scene.any_object(is_thin)).then_some(ObjectSet::NONE));
        let targets = Self { grid, cone, right_and_up: renderer.viewport.right_and_up(), thin };
        (targets.has_thin() || scene.any_object(is_glossy)).then_some(targets)
    }

    /// Whether any object may be thin.
    fn has_thin(&self) -> bool {
        self.thin.is_none_or(|thin| !thin.is_empty())
    }
}

/// Watches the rays of one pixel after another for small things beside them.
#[derive(Clone, Copy, Debug)]
pub(in crate::render::realtime) struct Watch<R> {
    targets: Targets<R>,
    /// The cone of the pixel's ray from the eye.
    first: Cone<R>,
    /// The cone of the rays that leave the last hit.
    cone: Cone<R>,
    /// The things that were found beside the rays of the pixel.
    pub(in crate::render::realtime) near: Near,
    /// Whether no other point stands for a smaller part of the picture than this one.
    stands_for_least: bool,
}

/// A ray, and whether it comes from the eye.
type Watched<R> = (Ray<R>, bool);

impl<R: Real> Watch<R> {
    /// `None` if there is nothing to watch for.
    pub(super) fn new<S: Geometry>(renderer: &Renderer<'_, '_, R, S>, grid: Grid) -> Option<Self> {
        let targets = Targets::new(renderer, grid)?;
        let (first, cone) = (targets.cone, targets.cone);
        Some(Self { targets, first, cone, near: Near::Nothing, stands_for_least: false })
    }

    /// Begins the pixel at point (x, y) of a cell; `None` if the pixel does not stand for others.
    pub(in crate::render::realtime) fn stand_for(&mut self, x: usize, y: usize) -> Option<&mut Self> {
        let (place, size) = (x | y, self.targets.grid.pixels());
        self.stands_for_least = size <= SQUARE || place % size != 0;
        self.first = if place % size == 0 {
            self.targets.cone
        } else if place % SQUARE == 0 {
            self.targets.cone.halved()
        } else {
            return None;
        };
        self.near = Near::Nothing;
        Some(self)
    }

    /// A ray hits something. `mirrored` is the direction of the mirrored ray there.
    // Cold, and kept out of line: else the tracing of every pixel would need its registers.
    #[cold]
    pub(in crate::render::realtime) fn hit<S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        watched: Watched<R>,
        hit: Hit<R>,
        mirrored: Vec3<R>,
    ) {
        let cone = self.look_beside(scene, watched, hit.t);
        let Some(material) = scene.material(hit.object) else { return };
        let (has_thin, is_glossy) = (self.targets.has_thin(), watched.1 && material.specular > R::ZERO);
        if !(has_thin || is_glossy) {
            return;
        }
        let (surface, direction) = (&hit.surface, watched.0.direction);
        let footprint = Footprint::new(cone, direction, surface.normal);
        let (right_and_up, directions) = (self.targets.right_and_up, (direction, mirrored));
        let find_sweep = || sweep_at(scene, &hit, material, &footprint, right_and_up, directions);
        let mut sweep = None;
        let (facing, ..) = surface.normal.facing(direction);
        for light in scene.lights {
            if self.near == Near::Tiny {
                break;
            }
            let Some((toward, distance, _)) = light.seen_from(surface.point, facing) else { continue };
            let shadow_ray = Ray { origin: surface.point, direction: toward };
            if has_thin && self.can_be_shaded(scene, &footprint, &shadow_ray, distance) {
                self.near = Near::Tiny;
            }
            // A light more than a right angle from the mirrored direction makes no highlight.
            if is_glossy && self.near < Near::Tiny && toward.dot(mirrored) > R::ZERO {
                let sweep = *sweep.get_or_insert_with(find_sweep);
                let near = sweep.nearness(toward, &material.shininess, self.stands_for_least);
                self.near = self.near.max(near);
            }
        }
        if has_thin {
            self.cone = match scene.form(hit.object) {
                Some(Form::Ball { radius, .. }) => cone.opened_by_ball(radius),
                _ => cone.opened(sweep.unwrap_or_else(find_sweep).reach_squared().sqrt()),
            };
        }
    }

    /// A ray hits nothing.
    #[cold]
    pub(in crate::render::realtime) fn miss<S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        watched: Watched<R>,
    ) {
        self.look_beside(scene, watched, R::FARTHEST);
    }

    /// Searches for thin things beside a ray, up to this distance; returns the rest of the cone from there
    /// on. What lies beside a ray from the eye is known. The second ray that leaves a hit begins with the
    /// cone that the first has left behind, which is wider than its own.
    fn look_beside<S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        (ray, is_from_eye): Watched<R>,
        distance: R,
    ) -> Cone<R> {
        if is_from_eye {
            return self.first.after(distance);
        }
        let cone = self.cone;
        let can_see = |object| cone.can_see(&ray, distance, scene.hulls(object));
        if self.targets.has_thin()
            && scene.any_beside((&ray, distance), |end| cone.radius_at(end), self.targets.thin, can_see)
        {
            self.near = Near::Tiny;
        }
        cone.after(distance)
    }

    /// Whether something thin can stand between a footprint and a light, which is at `distance` along
    /// `shadow_ray`.
    fn can_be_shaded<S: Geometry>(
        &self,
        scene: &PreparedScene<'_, R, S>,
        footprint: &Footprint<R>,
        shadow_ray: &Ray<R>,
        distance: R,
    ) -> bool {
        let can_shade = |object| footprint.can_be_shaded(shadow_ray, distance, scene.hulls(object));
        scene.any_beside((shadow_ray, distance), |_| footprint.reach(), self.targets.thin, can_shade)
    }
}

/// The sweep of a hit's footprint. A map that turns the normal at the hit turns the normals beside it in the
/// same way.
fn sweep_at<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    hit: &Hit<R>,
    material: &PreparedMaterial<'_, R>,
    footprint: &Footprint<R>,
    right_and_up: [Vec3<R>; 2],
    directions: (Vec3<R>, Vec3<R>),
) -> Sweep<R> {
    let normal_beside = |step| scene.normal_beside(hit.object, &hit.surface, step);
    let bump = if material.maps.is_empty() {
        Vec3::ZERO
    } else {
        hit.surface.shading_normal - normal_beside(Vec3::ZERO)
    };
    Sweep::new(footprint, right_and_up, directions, |step| normal_beside(step) + bump)
}
