//! The objects of a scene: what is known of each, and the hierarchy of their bounding boxes.

use super::{Departure, PreparedScene};
use crate::arena::Arena;
use crate::fault::Fault;
use crate::hierarchy::{Hierarchy, WIDE};
use crate::limits::FEW_OBJECTS;
use crate::material::PreparedMaterial;
use crate::math::{Aabb, FOUR_AT_ONCE, Real, Vec3};
use crate::shape::{Form, Geometry, Hull, Intersect, Rim, Silhouette, Tip};
use crate::surface::Surface;
use crate::throughput::Throughput;

/// An object that was checked and converted.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreparedObject<'m, R: Real, P> {
    pub(super) shape: P,
    pub(super) material: &'m PreparedMaterial<'m, R>,
}

/// A volume that holds an object.
pub(crate) enum Enclosure<R> {
    /// A ball.
    Ball {
        /// Its center.
        center: Vec3<R>,
        /// Its radius.
        radius: R,
    },
    /// A box along the axes.
    Box(Aabb<R>),
    /// All of space: the object has no bounds.
    Everywhere,
}

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    /// The material of an object.
    #[inline]
    pub(crate) fn material(&self, object: usize) -> Option<&'m PreparedMaterial<'m, R>> {
        self.objects.get(object).map(|object| object.material)
    }

    /// The place of a surface of an object in texture coordinates.
    #[inline(never)]
    pub(crate) fn uv(&self, object: usize, surface: &Surface<R>) -> [R; 2] {
        self.objects.get(object).map_or([R::ZERO; 2], |object| object.shape.uv(surface, self.scale))
    }

    /// The throughput of a ray after a `length`; `None` stands for a ray to the background. The material of
    /// the surface that the ray left absorbs light on either side, and may let reflections fade with
    /// distance.
    #[inline]
    pub(crate) fn dimmed(
        &self,
        throughput: Throughput<R>,
        from: Departure,
        is_reflected: bool,
        length: Option<R>,
    ) -> Throughput<R> {
        if !cfg!(feature = "optics") {
            return throughput;
        }
        match self.material(from.object).and_then(PreparedMaterial::optics) {
            Some(optics) => optics.dimmed(throughput, from.outward, is_reflected, length),
            None => throughput,
        }
    }

    /// The kind of surface that an object is.
    pub(crate) fn form(&self, object: usize) -> Option<Form<R>> {
        self.objects.get(object).map(|object| object.shape.form())
    }

    /// The plane that an object lies in: its unit normal, and its distance from the origin along the normal.
    pub(crate) fn plane_of(&self, object: usize) -> Option<(Vec3<R::Setup>, R::Setup)> {
        match self.form(object)? {
            Form::Flat { normal, distance } => Some((normal.to_setup(), distance.to_setup())),
            _ => None,
        }
    }

    /// The volume that holds each object, in scenes with sets of candidates.
    pub(crate) fn enclosures(&self) -> Option<impl Iterator<Item = Enclosure<R>>> {
        self.candidates()?;
        Some(self.objects.iter().map(|object| match object.shape.form() {
            Form::Ball { center, radius } => Enclosure::Ball { center, radius },
            _ => object.shape.bounds().map_or(Enclosure::Everywhere, Enclosure::Box),
        }))
    }

    /// The shading normal of an object a small step away from a surface of it.
    pub(crate) fn normal_beside(&self, object: usize, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        let object = self.objects.get(object);
        object.map_or(surface.shading_normal, |object| object.shape.normal_beside(surface, step))
    }

    /// The hulls of an object.
    pub(crate) fn hulls(&self, object: usize) -> impl Iterator<Item = Hull<R>> {
        let shape = self.objects.get(object).map(|object| &object.shape);
        (0..).map_while(move |part| shape?.hull(part))
    }

    /// The tips of an object.
    pub(crate) fn tips(&self, object: usize) -> impl Iterator<Item = Tip<R>> {
        let shape = self.objects.get(object).map(|object| &object.shape);
        (0..).map_while(move |number| shape?.tip(number))
    }

    /// Visits the rims of all objects.
    pub(crate) fn each_rim(&self, mut visit: impl FnMut(Rim<R>)) {
        for object in self.objects {
            object.shape.each_rim(&mut visit);
        }
    }
}

/// The most objects in a leaf of their hierarchy.
const LEAF: usize = if FOUR_AT_ONCE { 3 } else { 2 };

/// Of how many objects a hierarchy is stored: none where sets of candidates serve.
const fn stored(objects: usize) -> usize {
    if cfg!(feature = "hierarchy") && objects > FEW_OBJECTS { objects } else { 0 }
}

/// How many bytes the hierarchy of a scene takes.
pub(super) const fn hierarchy_bytes<R: Real>(objects: usize) -> usize {
    let objects = stored(objects);
    Arena::bytes::<u16>(objects).saturating_add(Hierarchy::<R, WIDE>::bytes(objects, LEAF))
}

/// Builds the hierarchy of a scene, unless that has few objects.
pub(super) fn hierarchy<'m, R: Real, P: Intersect<R>>(
    objects: &[PreparedObject<'_, R, P>],
    arena: &mut Arena<'m>,
) -> Result<Option<Hierarchy<'m, R, WIDE>>, Fault> {
    if stored(objects.len()) == 0 {
        return Ok(None);
    }
    let order = arena.try_store_with(objects.len(), |index, _| Ok::<u16, Fault>(index as u16))?;
    Hierarchy::new(order, LEAF, |object| bounds(objects, object), arena).map(Some)
}

/// In one place for all shapes: in preparation size counts more than time.
#[inline(never)]
fn bounds<R: Real, P: Intersect<R>>(objects: &[PreparedObject<R, P>], object: u16) -> Option<Aabb<R>> {
    objects.get(usize::from(object)).and_then(|object| object.shape.bounds())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    #[test]
    fn at_most_64_bytes_an_object() {
        assert_eq!(hierarchy_bytes::<f32>(32), 0);
        let most = if FOUR_AT_ONCE { 64 } else { 50 };
        for objects in [33, 820, 65_535] {
            assert!(hierarchy_bytes::<f32>(objects) <= most * objects);
            assert!(hierarchy_bytes::<Fixed>(objects) <= most * objects);
        }
    }
}
