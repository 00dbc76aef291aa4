//! The part of a prepared scene for distributed ray tracing: lamps with a size, the sky as a light, motions.

use super::objects::PreparedObject;
use super::wide_lights::balls_and_planes;
use super::{ObjectSet, Part, PreparedScene, SceneError, prepare_all};
use crate::arena::Arena;
use crate::camera::Viewport;
use crate::color::LinearRgb;
use crate::fault::{Fault, check_coordinate};
use crate::light::{AreaLight, Light};
use crate::math::{Ray, Real, Scale, Vec3};
use crate::motion::{Moved, Mover, PreparedMotion};
use crate::scene::Scene;
use crate::shape::{Form, Geometry};

/// Lamps with a size, the sky as a light, and motions of a scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Distributed<'m, R: Real> {
    /// The objects that give light.
    areas: &'m [AreaLight<R>],
    /// The light that is the sky.
    pub(super) sky: Option<usize>,
    /// Opaque balls, in a scene of few objects.
    pub(super) balls: ObjectSet,
    /// Opaque planes without end, in a scene of few objects.
    pub(super) planes: ObjectSet,
    /// The motion of the camera.
    pub(super) camera_motion: Option<&'m PreparedMotion<R>>,
    moves: bool,
    /// The time of the sample for which rays are traced: 0 when the shutter opens, 1 when it closes.
    time: R,
}

impl<'m, R: Real> Distributed<'m, R> {
    /// Checks lamps, sky and motions, converts them, and gives each object its motion.
    pub(super) fn new<S: Geometry + 'm>(
        scene: &Scene<'_, S>,
        objects: &mut [PreparedObject<'m, R, S::Prepared<'m, R>>],
        scale: Scale,
        arena: &mut Arena<'m>,
    ) -> Result<Self, SceneError> {
        let camera_motion = set_motions(scene, objects, scale, arena)?;
        let [balls, planes] = balls_and_planes(objects);
        Ok(Self {
            areas: areas(scene, objects, scale, arena)?,
            sky: sky(scene.lights)?,
            balls,
            planes,
            camera_motion,
            moves: !scene.motions.is_empty(),
            time: R::ZERO,
        })
    }

    pub(super) fn without_lights(self) -> Self {
        Self { areas: &[], sky: None, ..self }
    }
}

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    /// The time of the sample for which rays are traced.
    pub(super) fn time(&self) -> R {
        self.distributed.time
    }

    /// Whether objects or the sky give light.
    pub(crate) fn has_wide_lights(&self) -> bool {
        self.distributed.sky.is_some() || !self.distributed.areas.is_empty()
    }

    /// The position of the light that is the sky.
    pub(crate) fn sky(&self) -> Option<usize> {
        self.distributed.sky
    }

    /// The objects that give light.
    pub(crate) fn areas(&self) -> &'m [AreaLight<R>] {
        self.distributed.areas
    }

    /// Whether anything moves while the shutter is open.
    pub(crate) fn moves(&self) -> bool {
        self.distributed.moves
    }

    /// The scene for rays of one time: 0 when the shutter opens, 1 when it closes.
    pub(crate) fn at(&self, time: R) -> Self {
        Self { distributed: Distributed { time, ..self.distributed }, ..*self }
    }

    /// A depth at which nothing that the camera sees is nearer; `None` if none is known.
    pub(crate) fn nearest_depth(&self, viewport: &Viewport<R>) -> Option<R::Setup> {
        if self.moves_camera() {
            return None;
        }
        let (eye, mut nearest) = (viewport.eye(), R::Setup::FARTHEST);
        for object in self.objects {
            let distance = match (object.bounds(), object.form()) {
                (Some(bounds), _) => bounds.to_setup().distance(eye.to_setup()),
                (None, Form::Flat { normal, distance }) => (normal.dot(eye) - distance).abs().to_setup(),
                _ => return None,
            };
            nearest = nearest.smaller(distance);
        }
        Some(nearest * viewport.least_cosine())
    }

    /// A camera ray, moved along with the camera.
    pub(crate) fn moved_by_camera(&self, ray: Ray<R>) -> Ray<R> {
        self.distributed.camera_motion.map_or(ray, |motion| motion.at(self.time()).ray(&ray))
    }

    /// How an object has moved by now; `None` if it does not move.
    pub(crate) fn moved(&self, object: usize) -> Option<Moved<R>> {
        self.objects.get(object)?.moved(self.time())
    }
}

/// The light of a scene that is the sky.
fn sky(lights: &[Light]) -> Result<Option<usize>, SceneError> {
    let mut skies = lights.iter().enumerate().filter(|(_, light)| matches!(light, Light::Sky));
    let first = skies.next().map(|(index, _)| index);
    match skies.next() {
        Some((second, _)) => Err(Part::Light(second).error()(Fault::TwoSkies)),
        None => Ok(first),
    }
}

/// The lights of a scene that are objects.
fn areas<'m, R: Real, S: Geometry + 'm>(
    scene: &Scene<'_, S>,
    objects: &[PreparedObject<'_, R, S::Prepared<'m, R>>],
    scale: Scale,
    arena: &mut Arena<'m>,
) -> Result<&'m [AreaLight<R>], SceneError> {
    let lamps = || {
        let lights = scene.lights.iter().enumerate();
        lights.filter_map(|(index, light)| Some((index, usize::from(light.object()?.0))))
    };
    let (mut light, mut rest) = (0, lamps());
    let prepared = arena.try_store_with(lamps().count(), |_, _| {
        // There is a lamp for each call; the fault is never seen.
        let (index, named) = rest.next().ok_or(Fault::NotFinite)?;
        light = index;
        let unknown = Fault::UnknownObject { named, objects: objects.len() };
        let (object, prepared) = scene.objects.get(named).zip(objects.get(named)).ok_or(unknown)?;
        let luminaire = object.shape.luminaire().ok_or(Fault::NoLuminaire)?;
        let optics = prepared.material.optics();
        let optics =
            optics.filter(|optics| optics.emission() != LinearRgb::BLACK).ok_or(Fault::NoEmission)?;
        let emitted = (optics.emission(), optics.emission_sides);
        AreaLight::new(luminaire, (named, index), emitted, scale)
    });
    match prepared {
        Ok(areas) => Ok(areas),
        Err(fault) => Err(Part::Light(light).error()(fault)),
    }
}

/// Prepares the motions of a scene and gives each object its own. Returns the camera's.
fn set_motions<'m, R: Real, S: Geometry + 'm>(
    scene: &Scene<'_, S>,
    objects: &mut [PreparedObject<'m, R, S::Prepared<'m, R>>],
    scale: Scale,
    arena: &mut Arena<'m>,
) -> Result<Option<&'m PreparedMotion<R>>, SceneError> {
    let prepared = &*prepare_all(arena, scene.motions, Part::Motion, |motion, _| {
        if let Some(extent) = scene.moved_extent(motion) {
            check_coordinate(extent.solid.larger(extent.flat).larger(extent.plane.unwrap_or(0.0)))?;
        }
        let reach = motion.reach(scene.camera.eye.magnitude());
        if motion.of == Mover::Camera && !scale.is_near::<R>(Vec3::new(reach, 0.0, 0.0)) {
            return Err(Fault::BeyondReach);
        }
        motion.prepare::<R>(scale)
    })?;
    let mut camera = None;
    for (index, (motion, prepared)) in scene.motions.iter().zip(prepared).enumerate() {
        let place = match motion.of {
            Mover::Camera => &mut camera,
            Mover::Object(object) => {
                let (named, count) = (usize::from(object.0), objects.len());
                let unknown = Fault::UnknownObject { named, objects: count };
                &mut objects.get_mut(named).ok_or(unknown).map_err(Part::Motion(index).error())?.motion
            }
        };
        if place.replace(prepared).is_some() {
            return Err(Part::Motion(index).error()(Fault::MovesTwice));
        }
    }
    Ok(camera)
}
