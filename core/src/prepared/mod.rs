//! A scene that was checked and converted, and the two questions that rays ask of it.

mod error;
mod memory;

use core::mem::MaybeUninit;

pub use error::{Part, SceneError};
pub use memory::prepared_bytes;

use crate::arena::Arena;
use crate::camera::{Camera, PreparedCamera};
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::light::{PreparedLight, check_emission};
use crate::limits::{MAX_COUNT, MAX_SHADOW_LAYERS};
use crate::material::PreparedMaterial;
use crate::math::{Interval, Ray, Real};
use crate::scene::Scene;
use crate::shape::{Geometry, Intersect, Shape};
use crate::surface::Surface;

/// A scene that was checked and converted to the number system `R`, in memory that the caller lent.
///
/// # Guarantees
/// Every number in it is finite and in range, and every id is valid: nothing that is done with it can fail.
#[derive(Clone, Copy, Debug)]
pub struct PreparedScene<'m, R: Real, S: Geometry + 'm = Shape<'m>> {
    camera: PreparedCamera<R>,
    pub(crate) background: LinearRgb<R>,
    objects: &'m [PreparedObject<S::Prepared<'m, R>>],
    materials: &'m [PreparedMaterial<R>],
    pub(crate) lights: &'m [PreparedLight<R>],
}

#[derive(Clone, Copy, Debug)]
struct PreparedObject<P> {
    shape: P,
    material: u16,
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

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    /// Checks all of a scene and converts it: the one step that can refuse a scene.
    ///
    /// # Errors
    /// The first part that is wrong, and why. The caller's scene and memory can be used again.
    pub fn new(scene: &Scene<'_, S>, memory: &'m mut [MaybeUninit<u8>]) -> Result<Self, SceneError> {
        let Scene { camera, background, objects, materials, lights } = *scene;
        let camera = camera.prepare().map_err(Part::Camera.error())?;
        check_emission(background).map_err(Part::Background.error())?;
        let counts = [
            (objects.len(), Part::Object(MAX_COUNT)),
            (materials.len(), Part::Material(MAX_COUNT)),
            (lights.len(), Part::Light(MAX_COUNT)),
        ];
        for (given, part) in counts {
            if given > MAX_COUNT {
                return Err(part.error()(Fault::TooMany { given }));
            }
        }
        let vectors = objects.iter().fold(0, |sum: usize, object| sum.saturating_add(object.shape.vectors()));
        let needed = prepared_bytes::<R, S>(objects.len(), materials.len(), lights.len(), vectors);
        if memory.len() < needed {
            return Err(Part::Memory.error()(Fault::Memory { needed, lent: memory.len() }));
        }

        let mut arena = Arena::new(memory);
        let mut store = Store { arena: &mut arena };
        let prepared_materials = store.all(materials, Part::Material, |material, _| material.prepare())?;
        let prepared_lights = store.all(lights, Part::Light, |light, _| light.prepare())?;
        let prepared_objects = store.all(objects, Part::Object, |object, arena| {
            let named = usize::from(object.material.0);
            if named >= materials.len() {
                return Err(Fault::UnknownMaterial { named, materials: materials.len() });
            }
            Ok(PreparedObject { shape: object.shape.prepare(arena)?, material: object.material.0 })
        })?;
        Ok(Self {
            camera,
            background: background.to(),
            objects: prepared_objects,
            materials: prepared_materials,
            lights: prepared_lights,
        })
    }

    /// Looks at the same scene from elsewhere.
    ///
    /// # Errors
    /// What is wrong with the camera; the old one stays.
    pub fn set_camera(&mut self, camera: &Camera) -> Result<(), SceneError> {
        self.camera = camera.prepare().map_err(Part::Camera.error())?;
        Ok(())
    }

    pub(crate) fn camera(&self) -> &PreparedCamera<R> {
        &self.camera
    }

    pub(crate) fn material(&self, object: usize) -> Option<&PreparedMaterial<R>> {
        self.objects.get(object).and_then(|object| self.materials.get(usize::from(object.material)))
    }

    /// The first object that a ray meets inside `range`: of several at the same distance, the lowest in
    /// [`Scene::objects`].
    pub fn closest_hit(&self, ray: &Ray<R>, range: Interval<R>) -> Option<Hit<R>> {
        let (t, index) = self.closest_object(ray, range)?;
        let object = self.objects.get(index)?;
        Some(Hit { t, object: index, surface: object.shape.surface(ray, t) })
    }

    /// Distance and position of the first object that a ray meets.
    fn closest_object(&self, ray: &Ray<R>, mut range: Interval<R>) -> Option<(R, usize)> {
        let mut closest = None;
        for (index, object) in self.objects.iter().enumerate() {
            if let Some(t) = object.shape.intersect(ray, range) {
                range.max = t;
                closest = Some((t, index));
            }
        }
        closest
    }

    /// The share of light, 0 to 1, that comes through from a light at `distance` along `ray`, and whether it
    /// was cut short because more than [`MAX_SHADOW_LAYERS`] transparent surfaces lie in between.
    ///
    /// Each surface in between scales the light by its transmittance; what lies behind the light does not.
    pub fn light_through(&self, ray: &Ray<R>, distance: R) -> (R, bool) {
        let mut range = Interval { min: R::ZERO, max: distance };
        // Most often nothing, or something opaque, is in the way: any order of the objects tells.
        let mut clear = true;
        for (index, object) in self.objects.iter().enumerate() {
            if object.shape.intersect(ray, range).is_some() {
                if !(self.transmittance(index) > R::ZERO) {
                    return (R::ZERO, false);
                }
                clear = false;
            }
        }
        if clear {
            return (R::ONE, false);
        }
        // Transparent surfaces are multiplied in the order of the ray: one order, the same rounding. A shape
        // with an inside is met twice.
        let mut through = R::ONE;
        for _ in 0..MAX_SHADOW_LAYERS {
            let Some((t, index)) = self.closest_object(ray, range) else { return (through, false) };
            through = through * self.transmittance(index);
            range.min = t;
        }
        match self.closest_object(ray, range) {
            None => (through, false),
            Some(_) => (R::ZERO, true),
        }
    }

    fn transmittance(&self, object: usize) -> R {
        self.material(object).map_or(R::ZERO, |material| material.transmittance)
    }
}

/// Stores lists, and tells which item of which kind could not be prepared.
struct Store<'s, 'm> {
    arena: &'s mut Arena<'m>,
}

impl<'m> Store<'_, 'm> {
    fn all<D, P: Copy>(
        &mut self,
        descriptions: &[D],
        part: fn(usize) -> Part,
        mut prepare: impl FnMut(&D, &mut Arena<'m>) -> Result<P, Fault>,
    ) -> Result<&'m [P], SceneError> {
        let mut index = 0;
        self.arena
            .try_store_with(descriptions.len(), |i, arena| {
                index = i;
                // There is a description for every i; the fault is never seen.
                descriptions
                    .get(i)
                    .ok_or(Fault::NotFinite)
                    .and_then(|description| prepare(description, arena))
            })
            .map_err(|fault: Fault| part(index).error()(fault))
    }
}
