//! The description of a scene: plain data that can be a `static` in flash.

#[cfg(feature = "serde")]
mod array;
mod buf;
#[cfg(feature = "serde")]
mod bytes;
mod features;

pub use buf::{Full, SceneBuf};
#[cfg(feature = "serde")]
pub use bytes::BytesError;
pub use features::FASTER;

use crate::background::Background;
use crate::camera::Camera;
use crate::light::Light;
use crate::material::Material;
use crate::math::{Extent, Real, Scale};
use crate::motion::{Motion, Mover};
use crate::shape::{Geometry, Shape};

/// The description of a scene: everything that is in a picture.
///
/// `S` is the set of shapes that objects may have: by default all built-in shapes, or one made by
/// [`shape_set!`](crate::shape_set).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Scene<'a, S = Shape<'a>> {
    /// The camera.
    pub camera: Camera,
    /// The color of rays that hit nothing.
    pub background: Background<'a>,
    /// The objects that rays can hit. Where two are hit at the same distance, the first in this order is
    /// seen.
    pub objects: &'a [Object<S>],
    /// The materials that objects refer to by their [`MaterialId`].
    pub materials: &'a [Material<'a>],
    /// The lights.
    pub lights: &'a [Light],
    /// The motions of objects and of the camera while the shutter is open: most often none.
    pub motions: &'a [Motion],
}

/// A shape with a material.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Object<S> {
    /// The shape, which also has the position.
    pub shape: S,
    /// The material.
    pub material: MaterialId,
}

/// The position of a material in [`Scene::materials`], counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MaterialId(pub u16);

#[cfg(feature = "serde")]
crate::read::read_struct! {
    [S: crate::read::Read<'m> + Copy] Scene as Scene<'m, S> {
        camera, background = Background::BLACK, objects, materials, lights = &[], motions = &[],
    }
}

#[cfg(feature = "serde")]
crate::read::read_struct!([S: crate::read::Read<'m>] Object as Object<S> { shape, material });

#[cfg(feature = "serde")]
crate::read::read_id!(MaterialId);

impl<S: Geometry> Scene<'_, S> {
    /// The scale at which the scene is traced in the number system `R`.
    pub(crate) fn scale<R: Real>(&self) -> Scale {
        let extents = self.objects.iter().map(|object| object.shape.extent());
        let still = extents.fold(Extent::default(), Extent::union);
        let moved = self.motions.iter().filter_map(|motion| self.moved_extent(motion));
        Scale::new::<R>(moved.fold(still, Extent::union), self.camera.eye)
    }
}

impl<S: Geometry> Scene<'_, S> {
    /// The extent of an object where a motion takes it; `None` for the camera.
    pub(crate) fn moved_extent(&self, motion: &Motion) -> Option<Extent> {
        let Mover::Object(object) = motion.of else { return None };
        let object = self.objects.get(usize::from(object.0))?;
        Some(motion.extent(object.shape.extent()))
    }
}

impl<'a, S> Scene<'a, S> {
    /// The material of an object; `None` if the scene has none at that position.
    pub fn material_of(&self, object: &Object<S>) -> Option<&'a Material<'a>> {
        self.materials.get(usize::from(object.material.0))
    }
}

impl<S> Object<S> {
    /// An object of this shape, with the material at this position in [`Scene::materials`].
    pub const fn new(shape: S, material: u16) -> Self {
        Self { shape, material: MaterialId(material) }
    }
}
