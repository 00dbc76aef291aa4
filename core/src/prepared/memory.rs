//! How much memory a prepared scene takes.

use super::candidates::Candidates;
use super::objects::{PreparedObject, hierarchy_bytes};
use crate::arena::Arena;
use crate::light::PreparedLight;
use crate::material::PreparedMaterial;
use crate::math::Real;
use crate::motion::Motion;
use crate::scene::Scene;
use crate::shape::{Geometry, Shape};

impl Scene<'_> {
    /// How many bytes to lend to [`PreparedScene::new`](crate::PreparedScene::new), for the number system `R`
    /// and the built-in shapes. For a set of your own see [`prepared_bytes`](crate::prepared_bytes).
    ///
    /// ```
    /// use rayline::{PreparedScene, Workspace, builtin::CLASSIC};
    /// let mut memory = Workspace::<{ CLASSIC.bytes::<f32>() }>::new();
    /// let prepared = PreparedScene::<f32, _>::new(&CLASSIC, memory.lend());
    /// assert!(prepared.is_ok());
    /// ```
    pub const fn bytes<R: Real>(&self) -> usize {
        let more = self.part_bytes::<R>();
        prepared_bytes::<R, Shape<'_>>(self.objects.len(), self.materials.len(), self.lights.len(), more)
    }

    /// How many of those bytes the background and single shapes, materials and lights take beyond what each
    /// of its kind does: the last argument of [`prepared_bytes`](crate::prepared_bytes), where the scene is
    /// prepared with a set of fewer shapes.
    pub const fn part_bytes<R: Real>(&self) -> usize {
        self.parts_bytes::<R>(false)
    }

    /// As [`part_bytes`](Self::part_bytes), for a scene whose meshes were [baked](crate::shape::BakedMesh).
    pub const fn part_bytes_baked<R: Real>(&self) -> usize {
        self.parts_bytes::<R>(true)
    }

    const fn parts_bytes<R: Real>(&self, has_baked: bool) -> usize {
        let motions = Motion::bytes::<R>(self.motions.len());
        let mut bytes = self.background.bytes::<R>().saturating_add(motions);
        let mut objects = self.objects;
        while let [object, rest @ ..] = objects {
            bytes = bytes.saturating_add(match &object.shape {
                Shape::Mesh(_) if has_baked => 0,
                shape => shape.const_bytes::<R>(),
            });
            objects = rest;
        }
        let mut materials = self.materials;
        while let [material, rest @ ..] = materials {
            bytes = bytes.saturating_add(material.bytes::<R>());
            materials = rest;
        }
        let mut lights = self.lights;
        while let [light, rest @ ..] = lights {
            bytes = bytes.saturating_add(light.bytes::<R>());
            lights = rest;
        }
        bytes
    }
}

/// How many bytes to lend to [`PreparedScene::new`](crate::PreparedScene::new), for the number system `R` and
/// the shapes `S`: for so many objects, materials and lights, and for `more`, what single ones take beyond
/// that: [`Scene::part_bytes`](crate::Scene::part_bytes), or the sum of [`Geometry::bytes`] over all objects
/// where nothing else takes more. The module [`shape`](crate::shape#how-much-memory-to-lend) tells what takes
/// more, with an example.
///
/// ```
/// use rayline::{Workspace, prepared_bytes, shape::Sphere};
/// // For up to eight spheres of two materials, and one light.
/// let mut memory = Workspace::<{ prepared_bytes::<f32, Sphere>(8, 2, 1, 0) }>::new();
/// # memory.lend();
/// ```
pub const fn prepared_bytes<'m, R: Real, S: Geometry + 'm>(
    objects: usize,
    materials: usize,
    lights: usize,
    more: usize,
) -> usize {
    Arena::bytes::<PreparedObject<'m, R, S::Prepared<'m, R>>>(objects)
        .saturating_add(Arena::bytes::<PreparedMaterial<'m, R>>(materials))
        .saturating_add(Arena::bytes::<PreparedLight<'m, R>>(lights))
        .saturating_add(more)
        .saturating_add(Candidates::<R>::bytes(objects, lights))
        .saturating_add(hierarchy_bytes::<R>(objects))
}
