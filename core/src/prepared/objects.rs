//! The objects of a scene: what is known of each, and the hierarchy of their bounding boxes.

use super::{Departure, PreparedScene};
use crate::arena::Arena;
#[cfg(feature = "textures")]
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::hierarchy::{Hierarchy, WIDE};
use crate::limits::{FEW_OBJECTS, MAX_BACKS};
use crate::material::PreparedMaterial;
use crate::math::{Aabb, FOUR_AT_ONCE, Interval, Ray, Real, Vec3};
#[cfg(feature = "distributed")]
use crate::motion::{Moved, PreparedMotion};
use crate::shape::{Facet, Form, Geometry, Hull, Intersect, Rim, Silhouette, Tessellation, Tip};
use crate::surface::Surface;
use crate::throughput::Throughput;

/// An object that was checked and converted.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreparedObject<'m, R: Real, P> {
    pub(super) shape: P,
    pub(super) material: &'m PreparedMaterial<'m, R>,
    /// How it moves while the shutter is open.
    #[cfg(feature = "distributed")]
    pub(super) motion: Option<&'m PreparedMotion<R>>,
}

impl<R: Real, P: Intersect<R>> PreparedObject<'_, R, P> {
    #[inline]
    fn is_moving(&self) -> bool {
        #[cfg(feature = "distributed")]
        let is_moving = self.motion.is_some();
        #[cfg(not(feature = "distributed"))]
        let is_moving = false;
        is_moving
    }

    /// The kind of the shape. Of a moving one nothing is known.
    #[inline]
    pub(super) fn form(&self) -> Form<R> {
        if self.is_moving() { Form::Any } else { self.shape.form() }
    }

    /// A box that contains the object at all times; `None` if it has no end.
    pub(super) fn bounds(&self) -> Option<Aabb<R>> {
        let bounds = self.shape.bounds();
        #[cfg(feature = "distributed")]
        let bounds = bounds.map(|still| self.motion.map_or(still, |motion| motion.bounds(still)));
        bounds
    }

    /// How the object has moved at this time; `None` if it does not move.
    #[cfg(feature = "distributed")]
    #[inline]
    pub(super) fn moved(&self, time: R) -> Option<Moved<R>> {
        Some(self.motion?.at(time))
    }
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
    /// The distance at which a ray meets an object inside `range`.
    #[inline]
    pub(super) fn intersect(
        &self,
        object: &PreparedObject<'m, R, S::Prepared<'m, R>>,
        ray: &Ray<R>,
        range: Interval<R>,
    ) -> Option<R> {
        #[cfg(feature = "distributed")]
        if object.motion.is_some() {
            return self.intersect_moving(object, ray, range);
        }
        object.shape.intersect(ray, range)
    }

    /// The distance at which a ray that sees meets an object inside `range`: backs of one-sided surfaces are
    /// passed through.
    #[inline]
    pub(super) fn sees(
        &self,
        object: &PreparedObject<'m, R, S::Prepared<'m, R>>,
        ray: &Ray<R>,
        range: Interval<R>,
    ) -> Option<R> {
        let t = self.intersect(object, ray, range)?;
        if self.has_one_sided() && object.material.is_one_sided() {
            return self.sees_front(object, ray, Interval { min: t, ..range });
        }
        Some(t)
    }

    /// The distance of the first front of an object, at the beginning of `range` or within.
    #[cold]
    fn sees_front(
        &self,
        object: &PreparedObject<'m, R, S::Prepared<'m, R>>,
        ray: &Ray<R>,
        mut range: Interval<R>,
    ) -> Option<R> {
        for _ in 0..MAX_BACKS {
            if self.is_front(object, ray, range.min) {
                return Some(range.min);
            }
            range.min = self.intersect(object, ray, range)?;
        }
        None
    }

    /// Whether a ray meets the front of an object at this distance.
    fn is_front(&self, object: &PreparedObject<'m, R, S::Prepared<'m, R>>, ray: &Ray<R>, t: R) -> bool {
        #[cfg(feature = "distributed")]
        if let Some(moved) = object.moved(self.time()) {
            return object.shape.is_front(&moved.ray_back(ray), t);
        }
        object.shape.is_front(ray, t)
    }

    /// Whether any object is seen from one side only. Without the feature there is none, and the compiler
    /// drops the code for it.
    #[inline]
    pub(crate) fn has_one_sided(&self) -> bool {
        #[cfg(feature = "optics")]
        let has = self.has_one_sided;
        #[cfg(not(feature = "optics"))]
        let has = false;
        has
    }

    #[cfg(feature = "distributed")]
    #[cold]
    fn intersect_moving(
        &self,
        object: &PreparedObject<'m, R, S::Prepared<'m, R>>,
        ray: &Ray<R>,
        range: Interval<R>,
    ) -> Option<R> {
        object.shape.intersect(&object.moved(self.time())?.ray_back(ray), range)
    }

    /// The surface of an object that a ray meets at the distance `t`.
    #[inline]
    pub(super) fn surface(
        &self,
        object: &PreparedObject<'m, R, S::Prepared<'m, R>>,
        ray: &Ray<R>,
        t: R,
    ) -> Surface<R> {
        #[cfg(feature = "distributed")]
        if let Some(moved) = object.moved(self.time()) {
            return moved.surface(&object.shape.surface(&moved.ray_back(ray), t));
        }
        object.shape.surface(ray, t)
    }

    /// A surface of an object where the object was described, for textures; `room` keeps it.
    #[inline]
    pub(crate) fn still<'s>(
        &self,
        object: usize,
        surface: &'s Surface<R>,
        room: &'s mut Option<Surface<R>>,
    ) -> &'s Surface<R> {
        #[cfg(feature = "distributed")]
        if self.moves()
            && let Some(moved) = self.moved(object)
        {
            return room.insert(moved.surface_back(surface));
        }
        let _ = (object, room);
        surface
    }

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

    /// Whether the shape of an object has colors of its own.
    #[inline]
    pub(crate) fn is_tinted(&self, object: usize) -> bool {
        // Few scenes have such shapes, and each hit comes here.
        #[cfg(feature = "textures")]
        let is_tinted =
            self.has_tinted && self.objects.get(object).is_some_and(|object| object.shape.is_tinted());
        #[cfg(not(feature = "textures"))]
        let is_tinted = {
            let _ = object;
            false
        };
        is_tinted
    }

    /// The color of an object's own shape at a surface.
    #[cfg(feature = "textures")]
    pub(crate) fn tint(&self, object: usize, surface: &Surface<R>) -> LinearRgb<R> {
        let white = LinearRgb::even(R::ONE);
        self.objects.get(object).map_or(white, |object| object.shape.tint(surface))
    }

    /// Whether normals to shade with may differ from geometric ones: where shapes or maps bend them.
    #[inline]
    pub(crate) fn bends_normals(&self) -> bool {
        cfg!(feature = "textures") || S::Prepared::<'m, R>::IS_SMOOTHED
    }

    /// The normal of a surface of an object, turned by the maps of the material. `still` is the surface where
    /// the object was described; the ray's direction and the normal are those at the time of the sample.
    #[inline]
    pub(crate) fn bumped(
        &self,
        object: usize,
        still: &Surface<R>,
        direction: Vec3<R>,
        material: &PreparedMaterial<'_, R>,
    ) -> Vec3<R> {
        let uv = |surface: &Surface<R>| self.uv(object, surface);
        #[cfg(feature = "distributed")]
        if let Some(moved) = self.moved(object) {
            return moved.direction(material.maps.bumped(still, moved.direction_back(direction), uv));
        }
        material.maps.bumped(still, direction, uv)
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
        self.objects.get(object).map(PreparedObject::form)
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
        Some(self.objects.iter().map(|object| match object.form() {
            Form::Ball { center, radius } => Enclosure::Ball { center, radius },
            _ => object.bounds().map_or(Enclosure::Everywhere, Enclosure::Box),
        }))
    }

    /// The shading normal of an object a small step away from a surface of it.
    pub(crate) fn normal_beside(&self, object: usize, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        let object = self.objects.get(object);
        object.map_or(surface.shading_normal, |object| object.shape.normal_beside(surface, step))
    }

    /// The hulls of an object. A moving one has none: it is blurred.
    pub(crate) fn hulls(&self, object: usize) -> impl Iterator<Item = Hull<R>> {
        let shape = self.still_shape(object);
        (0..).map_while(move |part| shape?.hull(part))
    }

    /// The shape of an object that does not move.
    fn still_shape(&self, object: usize) -> Option<&'m S::Prepared<'m, R>> {
        self.objects.get(object).filter(|object| !object.is_moving()).map(|object| &object.shape)
    }

    /// The tips of an object. A moving one has none: it is blurred.
    pub(crate) fn tips(&self, object: usize) -> impl Iterator<Item = Tip<R>> {
        let shape = self.still_shape(object);
        (0..).map_while(move |number| shape?.tip(number))
    }

    /// Visits the facets of all objects, with the object's position. Moving ones are where they were
    /// described.
    pub(crate) fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(usize, &Facet<R>)) {
        for (index, object) in self.objects.iter().enumerate() {
            object.shape.each_facet(tessellation, &mut |facet: &Facet<R>| visit(index, facet));
        }
    }

    /// The boxes of all objects that have one.
    pub(crate) fn boxes(&self) -> impl Iterator<Item = Aabb<R>> {
        self.objects.iter().filter_map(PreparedObject::bounds)
    }

    /// Whether a point lies in the box of an object, or the object has none.
    pub(crate) fn may_be_inside(&self, object: usize, point: Vec3<R>) -> bool {
        self.bounds(object).is_none_or(|bounds| bounds.contains(point))
    }

    /// Visits the rims of all objects that do not move.
    pub(crate) fn each_rim(&self, mut visit: impl FnMut(Rim<R>)) {
        for object in self.objects.iter().filter(|object| !object.is_moving()) {
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
    objects.get(usize::from(object)).and_then(PreparedObject::bounds)
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
