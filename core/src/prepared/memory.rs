//! How much memory a prepared scene takes.

use super::candidates::Candidates;
use super::objects::{PreparedObject, hierarchy_bytes};
use crate::arena::Arena;
use crate::light::PreparedLight;
use crate::material::PreparedMaterial;
use crate::math::Real;
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
        let shapes = self.shape_bytes::<R>();
        prepared_bytes::<R, Shape<'_>>(self.objects.len(), self.materials.len(), self.lights.len(), shapes)
    }

    /// How many of those bytes the shapes take: the last argument of [`prepared_bytes`](crate::prepared_bytes), where the scene is
    /// prepared with a set of fewer shapes.
    pub const fn shape_bytes<R: Real>(&self) -> usize {
        let mut shapes: usize = 0;
        let mut objects = self.objects;
        while let [object, rest @ ..] = objects {
            shapes = shapes.saturating_add(object.shape.const_bytes::<R>());
            objects = rest;
        }
        shapes
    }
}

/// How many bytes to lend to [`PreparedScene::new`](crate::PreparedScene::new), for the number system `R` and the shapes `S`: for so many
/// objects, materials and lights, and for `shapes`, the sum of [`Geometry::bytes`] over all objects.
pub const fn prepared_bytes<'m, R: Real, S: Geometry + 'm>(
    objects: usize,
    materials: usize,
    lights: usize,
    shapes: usize,
) -> usize {
    Arena::bytes::<PreparedObject<'m, R, S::Prepared<'m, R>>>(objects)
        .saturating_add(Arena::bytes::<PreparedMaterial<'m, R>>(materials))
        .saturating_add(Arena::bytes::<PreparedLight<R>>(lights))
        .saturating_add(shapes)
        .saturating_add(Candidates::<R>::bytes(objects, lights))
        .saturating_add(hierarchy_bytes::<R>(objects))
}
