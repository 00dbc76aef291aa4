//! How much memory a prepared scene takes.

use super::candidates::Candidates;
use super::objects::{PreparedObject, hierarchy_bytes};
use crate::arena::Arena;
use crate::light::PreparedLight;
use crate::material::PreparedMaterial;
use crate::math::Real;
use crate::motion::Motion;
use crate::scene::Scene;
use crate::shape::Geometry;

impl Scene<'_> {
    /// How many bytes to lend to [`PreparedScene::new`](crate::PreparedScene::new), for the number system `R`
    /// and the built-in shapes: as [`prepared_bytes!`](crate::prepared_bytes!) for any set of shapes.
    ///
    /// ```
    /// use rayline::{PreparedScene, Workspace, builtin::CLASSIC};
    /// let mut memory = Workspace::<{ CLASSIC.bytes::<f32>() }>::new();
    /// let prepared = PreparedScene::<f32, _>::new(&CLASSIC, memory.lend());
    /// assert!(prepared.is_ok());
    /// ```
    pub const fn bytes<R: Real>(&self) -> usize {
        crate::prepared_bytes!(R, *self)
    }
}

impl<S: Geometry> Scene<'_, S> {
    /// All bytes, if the shapes take this many beside their places: for the macro.
    #[doc(hidden)]
    pub const fn bytes_with_shapes<R: Real>(&self, shapes: usize) -> usize {
        let motions = Motion::bytes::<R>(self.motions.len());
        let mut more = shapes.saturating_add(self.background.bytes::<R>()).saturating_add(motions);
        let mut materials = self.materials;
        while let [material, rest @ ..] = materials {
            more = more.saturating_add(material.bytes::<R>());
            materials = rest;
        }
        let mut lights = self.lights;
        while let [light, rest @ ..] = lights {
            more = more.saturating_add(light.bytes::<R>());
            lights = rest;
        }
        prepared_bytes::<R, S>(self.objects.len(), self.materials.len(), self.lights.len(), more)
    }
}

/// How many bytes to lend to [`PreparedScene::new`](crate::PreparedScene::new), for a number system and a
/// scene of any set of shapes that is known when the program is compiled: a constant.
///
/// ```
/// use rayline::shape::Sphere;
/// use rayline::{Background, Camera, LinearRgb, Material, Object, PreparedScene, Scene, Vec3};
/// use rayline::{Workspace, prepared_bytes};
///
/// static BALL: Scene<Sphere> = Scene {
///     camera: Camera {
///         eye: Vec3::new(0.0, 0.0, 4.0),
///         target: Vec3::ZERO,
///         up: Vec3::new(0.0, 1.0, 0.0),
///         vertical_fov: 0.7,
///         lens: None,
///     },
///     background: Background::BLACK,
///     objects: &[Object::new(Sphere::new(Vec3::ZERO, 1.0), 0)],
///     materials: &[Material::matte(LinearRgb::WHITE)],
///     lights: &[],
///     motions: &[],
/// };
/// let mut memory = Workspace::<{ prepared_bytes!(f32, BALL) }>::new();
/// assert!(PreparedScene::<f32, _>::new(&BALL, memory.lend()).is_ok());
/// ```
///
/// For a [`SceneBuf`](crate::SceneBuf), whose items are not known, see the function
/// [`prepared_bytes`](fn@crate::prepared_bytes).
#[macro_export]
macro_rules! prepared_bytes {
    ($Number:ty, $scene:expr) => {{
        let scene = &$scene;
        let (mut objects, mut shapes) = (scene.objects, 0usize);
        while let [object, rest @ ..] = objects {
            shapes = shapes.saturating_add(object.shape.const_bytes::<$Number>());
            objects = rest;
        }
        scene.bytes_with_shapes::<$Number>(shapes)
    }};
}

/// How many bytes to lend to [`PreparedScene::new`](crate::PreparedScene::new), for the number system `R` and
/// the shapes `S`, if only the numbers of objects, materials and lights are known. `more` is the sum of the
/// bytes that single items take in addition; the [guide on
/// shapes](crate::shape::guide#how-much-memory-to-lend) lists these items.
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
