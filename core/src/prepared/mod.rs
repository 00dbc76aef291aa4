//! A scene that was checked and converted: all that rays need.
//!
//! | file | [`PreparedScene`] computes |
//! |---|---|
//! | `closest` | the first object that a ray meets |
//! | `shadow` | the light that gets through between two points |
//! | `wide_lights` | the share of a lamp with a size, or of the sky, that objects hide |
//! | `objects` | hits, normals and textures of objects; the hierarchy of boxes around them |
//! | `candidates`, `object_set`, `among` | the objects that a ray can meet at all |
//! | `departure` | the object that a ray leaves, and the side that it leaves to |
//! | `search` | the objects in a part of space |
//! | `distributed` | objects that move, and the lamps and the sky that have a size |
//! | `memory` | the bytes to lend |
//! | `error` | the part of a scene that was refused |

mod among;
pub(crate) mod candidates;
pub(crate) mod closest;
mod departure;
#[cfg(feature = "distributed")]
mod distributed;
mod error;
mod memory;
mod object_set;
mod objects;
mod search;
mod shadow;
#[cfg(feature = "distributed")]
mod wide_lights;

use core::mem::MaybeUninit;

pub(crate) use among::Among;
pub(crate) use departure::Departure;
pub use error::{Part, SceneError};
pub use memory::prepared_bytes;
pub(crate) use object_set::ObjectSet;
pub(crate) use objects::Enclosure;
pub use shadow::Through;

use candidates::Candidates;
#[cfg(feature = "distributed")]
use distributed::Distributed;
use objects::PreparedObject;

use crate::arena::Arena;
use crate::background::PreparedBackground;
use crate::camera::{Camera, PreparedCamera};
use crate::color::{LinearRgb, check_emission};
use crate::fault::Fault;
use crate::hierarchy::{Hierarchy, WIDE};
use crate::light::{Light, PreparedLight};
use crate::limits::MAX_COUNT;
use crate::material::Material;
use crate::math::{Aabb, Ray, Real, Scale, Vec3};
use crate::motion::Motion;
use crate::scene::Scene;
use crate::shape::{Form, Geometry, Intersect, Shape};
use crate::surface::Surface;

/// A scene that was checked and converted to the number system `R`, in memory that the caller lent.
///
/// # Guarantees
/// Every number in it is finite and in range, and every id is valid: nothing that is done with it can fail.
#[derive(Clone, Copy, Debug)]
pub struct PreparedScene<'m, R: Real, S: Geometry + 'm = Shape<'m>> {
    camera: PreparedCamera<R>,
    pub(crate) background: PreparedBackground<'m, R>,
    objects: &'m [PreparedObject<'m, R, S::Prepared<'m, R>>],
    pub(crate) lights: &'m [PreparedLight<'m, R>],
    /// Of distributed ray tracing.
    #[cfg(feature = "distributed")]
    distributed: Distributed<'m, R>,
    /// `None`: white.
    ambient: Option<LinearRgb<R>>,
    /// Whether any object is seen from one side only.
    #[cfg(feature = "optics")]
    has_one_sided: bool,
    /// Whether any object has colors of its own.
    #[cfg(feature = "textures")]
    has_tinted: bool,
    scale: Scale,
    /// `None`: too many objects for sets, or not wanted.
    candidates: Option<Candidates<'m, R>>,
    /// `None`: few objects, or not wanted.
    hierarchy: Option<Hierarchy<'m, R, WIDE>>,
}

/// Where a ray met an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<R> {
    /// Distance from the ray's origin.
    pub t: R,
    /// Position of the object in [`Scene::objects`].
    pub object: usize,
    /// The surface there.
    pub surface: Surface<R>,
}

impl<R: Real> Hit<R> {
    /// None yet.
    pub(crate) const BLANK: Self = {
        let (point, normal) = (Vec3::ZERO, Vec3::ZERO);
        let surface = Surface { point, normal, shading_normal: normal, magnitude: R::ZERO, part: 0 };
        Self { t: R::ZERO, object: 0, surface }
    };

    /// The side of the surface to which a ray of this direction leaves it.
    #[inline]
    pub(crate) fn departure(&self, direction: Vec3<R>) -> Departure {
        Departure { object: self.object, outward: Ray::is_outward(self.surface.normal, direction) }
    }

    /// A ray that leaves the surface, to the side that [`departure`](Self::departure) returned.
    #[inline]
    pub(crate) fn spawn(&self, direction: Vec3<R>, from: Departure) -> Ray<R> {
        let Surface { point, normal, magnitude, .. } = self.surface;
        Ray::spawn_to(from.outward, point, normal, direction, magnitude)
    }
}

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    /// Checks all of a scene and converts it: the one step that can refuse a scene.
    ///
    /// # Errors
    /// The first part that is wrong, and why. The caller's scene and memory can be used again.
    pub fn new(scene: &Scene<'m, S>, memory: &'m mut [MaybeUninit<u8>]) -> Result<Self, SceneError> {
        let Scene { camera, background, objects, materials, lights, motions } = *scene;
        let scale = scene.scale::<R>();
        let camera = camera.prepare(scale).map_err(Part::Camera.error())?;
        check_counts(scene)?;
        // As `Scene::bytes_with_shapes`, whose loops for constants take 600 bytes more flash.
        let parts = (objects.iter().map(|object| object.shape.bytes::<R>()))
            .chain(materials.iter().map(Material::bytes::<R>))
            .chain(lights.iter().map(Light::bytes::<R>));
        let more = background.bytes::<R>().saturating_add(Motion::bytes::<R>(motions.len()));
        let more = parts.fold(more, usize::saturating_add);
        let needed = prepared_bytes::<R, S>(objects.len(), materials.len(), lights.len(), more);
        if memory.len() < needed {
            return Err(Part::Memory.error()(Fault::Memory { needed, lent: memory.len() }));
        }

        let arena = &mut Arena::new(memory);
        let background = background.prepare(arena).map_err(Part::Background.error())?;
        let prepared_materials =
            prepare_all(arena, materials, Part::Material, |material, arena| material.prepare(scale, arena))?;
        let prepared_lights =
            prepare_all(arena, lights, Part::Light, |light, arena| light.prepare(scale, arena))?;
        let prepared_objects = prepare_all(arena, objects, Part::Object, |object, arena| {
            let (named, materials) = (usize::from(object.material.0), prepared_materials.len());
            let material =
                prepared_materials.get(named).ok_or(Fault::UnknownMaterial { named, materials })?;
            let shape = object.shape.prepare(scale, arena)?;
            if shape.is_lifted() && material.transmittance > R::ZERO {
                return Err(Fault::TerminatorOnGlass);
            }
            Ok(PreparedObject {
                shape,
                material,
                #[cfg(feature = "distributed")]
                motion: None,
            })
        })?;
        #[cfg(feature = "distributed")]
        let distributed = Distributed::new(scene, prepared_objects, scale, arena)?;
        #[cfg(not(feature = "distributed"))]
        if !motions.is_empty() {
            return Err(Part::Motion(0).error()(Fault::WithoutFeature { feature: "distributed" }));
        }
        let prepared_objects = &*prepared_objects;
        let candidates = Candidates::new(prepared_objects, prepared_lights, arena);
        let candidates = candidates.map_err(Part::Memory.error())?;
        let hierarchy = objects::hierarchy(prepared_objects, arena).map_err(Part::Memory.error())?;
        Ok(Self {
            camera,
            background,
            objects: prepared_objects,
            lights: prepared_lights,
            #[cfg(feature = "distributed")]
            distributed,
            ambient: ambient::<R>(lights)?,
            #[cfg(feature = "optics")]
            has_one_sided: prepared_objects.iter().any(|object| object.material.is_one_sided()),
            #[cfg(feature = "textures")]
            has_tinted: prepared_objects.iter().any(|object| object.shape.is_tinted()),
            scale,
            candidates,
            hierarchy,
        })
    }

    /// The scene without candidates and hierarchy: exact pictures have the same bytes and take longer. For
    /// measurements of acceleration, and for tests that it changes nothing.
    pub fn without_acceleration(self) -> Self {
        Self { candidates: None, hierarchy: None, ..self }
    }

    /// The scene without lights.
    pub(crate) fn without_lights(self) -> Self {
        Self {
            lights: &[],
            #[cfg(feature = "distributed")]
            distributed: self.distributed.without_lights(),
            ..self
        }
    }

    /// Looks at the same scene from elsewhere.
    ///
    /// In fixed point, the scene was scaled for the eye with which it was prepared. A new eye that is no
    /// farther from the origin than that eye is always near enough. [`Fixed`](crate::math::Fixed) states how
    /// far away other eyes may be.
    ///
    /// # Errors
    /// What is wrong with the camera; the old one stays.
    pub fn set_camera(&mut self, camera: &Camera) -> Result<(), SceneError> {
        let camera = camera.prepare(self.scale).map_err(Part::Camera.error())?;
        if !self.planes_are_near(camera.eye()) {
            return Err(Part::Camera.error()(Fault::BeyondReach));
        }
        self.camera = camera;
        Ok(())
    }

    /// Whether infinite planes are seen up to the horizon from there.
    fn planes_are_near(&self, eye: Vec3<R>) -> bool {
        let is_near = |shape: &S::Prepared<'m, R>| match shape.form() {
            Form::Flat { normal, distance } => {
                shape.bounds().is_some() || Scale::is_near_plane(normal.dot(eye) - distance)
            }
            _ => true,
        };
        !R::IS_FIXED_POINT || self.objects.iter().all(|object| is_near(&object.shape))
    }

    /// How many units of rays, hits and events one unit of the scene is: a power of two, and 1 in floating
    /// point.
    ///
    /// Fixed point has little range, so the scene is scaled into it. Pictures show nothing of that.
    pub fn scale(&self) -> f32 {
        self.scale.to_f32()
    }

    /// A box that contains the object at this position at all times, in units of rays; `None` if the object
    /// has no end, or if there is none.
    pub fn bounds(&self, object: usize) -> Option<Aabb<R>> {
        self.objects.get(object)?.bounds()
    }

    /// The ambient light, where it is not white.
    #[inline]
    pub(crate) fn ambient(&self) -> Option<LinearRgb<R>> {
        if cfg!(feature = "optics") { self.ambient } else { None }
    }

    pub(crate) fn camera(&self) -> &PreparedCamera<R> {
        &self.camera
    }

    /// Whether rays draw numbers for what the scene holds, so that a sample is more than its place in the
    /// pixel.
    pub(crate) fn is_distributed(&self, samples_areas: bool) -> bool {
        #[cfg(feature = "distributed")]
        {
            let spreads_rays = |object: &PreparedObject<'_, R, _>| object.material.spreads_rays();
            self.moves()
                || (samples_areas && self.has_wide_lights())
                || (self.distributed.sky.is_some() && !self.background.has_closed_form())
                || self.objects.iter().any(spreads_rays)
        }
        #[cfg(not(feature = "distributed"))]
        {
            let _ = samples_areas;
            false
        }
    }

    /// Whether the camera moves.
    pub(crate) fn moves_camera(&self) -> bool {
        #[cfg(feature = "distributed")]
        let moves = self.distributed.camera_motion.is_some();
        #[cfg(not(feature = "distributed"))]
        let moves = false;
        moves
    }

    /// The sets of candidates. Without the feature there are none, and the compiler drops the code that uses
    /// them.
    #[inline]
    fn candidates(&self) -> Option<&Candidates<'m, R>> {
        if cfg!(feature = "candidates") { self.candidates.as_ref() } else { None }
    }

    /// The hierarchy. Without the feature there is none, and the compiler drops the code that uses it.
    #[inline]
    pub(crate) fn hierarchy(&self) -> Option<&Hierarchy<'m, R, WIDE>> {
        if cfg!(feature = "hierarchy") { self.hierarchy.as_ref() } else { None }
    }
}

/// Refuses lists that are too long for their numbers.
fn check_counts<S>(scene: &Scene<'_, S>) -> Result<(), SceneError> {
    let counts = [
        (scene.objects.len(), Part::Object(MAX_COUNT)),
        (scene.materials.len(), Part::Material(MAX_COUNT)),
        (scene.lights.len(), Part::Light(MAX_COUNT)),
        (scene.motions.len(), Part::Motion(MAX_COUNT)),
    ];
    match counts.into_iter().find(|(given, _)| *given > MAX_COUNT) {
        Some((given, part)) => Err(part.error()(Fault::TooMany { given })),
        None => Ok(()),
    }
}

/// The sum of a scene's ambient lights, if it has any.
fn ambient<R: Real>(lights: &[Light]) -> Result<Option<LinearRgb<R>>, SceneError> {
    let mut sum: Option<LinearRgb> = None;
    for (index, light) in lights.iter().enumerate() {
        if let Some(color) = light.ambient() {
            let all = sum.map_or(color, |sum| sum + color);
            check_emission::<R>(all).map_err(Part::Light(index).error())?;
            sum = Some(all);
        }
    }
    Ok(sum.map(LinearRgb::to))
}

/// Stores the prepared form of each description, or returns an error for the description that is wrong.
fn prepare_all<'m, D, P: Copy>(
    arena: &mut Arena<'m>,
    descriptions: &[D],
    part: fn(usize) -> Part,
    mut prepare: impl FnMut(&D, &mut Arena<'m>) -> Result<P, Fault>,
) -> Result<&'m mut [P], SceneError> {
    let mut index = 0;
    let prepared = arena.try_store_with(descriptions.len(), |i, arena| {
        index = i;
        // There is a description for every i; the fault is never seen.
        descriptions.get(i).ok_or(Fault::NotFinite).and_then(|description| prepare(description, arena))
    });
    match prepared {
        Ok(prepared) => Ok(prepared),
        Err(fault) => Err(part(index).inner(arena.blamed()).error()(fault)),
    }
}
