//! The description of a scene: plain data that can be a `static` in flash.

#[cfg(feature = "serde")]
mod array;
mod buf;
#[cfg(feature = "serde")]
mod bytes;
mod features;

pub use buf::SceneBuf;
#[cfg(feature = "serde")]
pub use bytes::BytesError;
pub use features::FASTER;

use crate::background::Background;
use crate::camera::Camera;
use crate::light::Light;
use crate::material::Material;
use crate::math::{Extent, Real, Scale};
use crate::shape::{Geometry, Shape};

/// Everything that is in a picture.
///
/// `S` is the set of shapes that objects may have; by default all built-in ones, see
/// [`shape_set!`](crate::shape_set).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Scene<'a, S = Shape<'a>> {
    /// Where the picture is taken from.
    pub camera: Camera,
    /// What a ray sees that hits nothing.
    pub background: Background<'a>,
    /// What rays can hit. Where two are at the same distance, the first in this order is seen.
    pub objects: &'a [Object<S>],
    /// What objects are made of.
    pub materials: &'a [Material<'a>],
    /// What lights them.
    pub lights: &'a [Light],
}

/// A shape and what it is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Object<S> {
    /// Where the object is and what form it has.
    pub shape: S,
    /// What it is made of.
    pub material: MaterialId,
}

/// A material of the same scene, by its position in [`Scene::materials`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MaterialId(pub u16);

#[cfg(feature = "serde")]
crate::read::read_struct! {
    [S: crate::read::Read<'m> + Copy] Scene as Scene<'m, S> {
        camera, background = Background::BLACK, objects, materials, lights = &[],
    }
}

#[cfg(feature = "serde")]
crate::read::read_struct!([S: crate::read::Read<'m>] Object as Object<S> { shape, material });

#[cfg(feature = "serde")]
impl<'m> crate::read::Read<'m> for MaterialId {
    fn read<D: serde::Deserializer<'m>>(
        from: D,
        reader: &mut crate::read::Reader<'m>,
    ) -> Result<Self, D::Error> {
        crate::read::read_number("MaterialId", from, reader).map(Self)
    }
}

impl<S: Geometry> Scene<'_, S> {
    /// How large it is traced in a number system.
    pub(crate) fn scale<R: Real>(&self) -> Scale {
        let extents = self.objects.iter().map(|object| object.shape.extent());
        Scale::new::<R>(extents.fold(Extent::default(), Extent::union), self.camera.eye)
    }
}

impl<S> Object<S> {
    /// The object of this shape and the material at this position in [`Scene::materials`].
    pub const fn new(shape: S, material: u16) -> Self {
        Self { shape, material: MaterialId(material) }
    }
}
