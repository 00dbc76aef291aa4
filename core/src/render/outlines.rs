//! The outlines of all objects of a picture, and of the shadows on the largest flat object, most often the
//! floor.
//!
//! Each object lies inside a ball or a box, which has an [`Outline`] in the picture (Weghorst, Hooper and
//! Greenberg, "Improved Computational Methods for Ray Tracing", ACM TOG 1984, project bounding volumes into a
//! buffer of items). A line or a band of lines then gets a span of pixels for each object. Outlines hold more
//! than what they enclose, so that pictures have the same bytes with and without them.

use super::outline::{Outline, Projector, Vantage};
use super::pixel::Aim;
use super::span::Span;
use crate::camera::Viewport;
use crate::integrator::OUTLINED_LIGHTS;
use crate::math::Real;
use crate::prepared::Enclosure;
use crate::prepared::ObjectSet;
use crate::prepared::PreparedScene;
use crate::shape::Geometry;

/// The most shadows whose outlines are kept.
pub(super) const SHADOW_OUTLINES: usize = ObjectSet::CAPACITY / 2;

/// The outlines of all objects of a picture, and of the shadows on the largest flat object, the *receiver*.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outlines {
    pub(super) objects: [Outline; ObjectSet::CAPACITY],
    /// The number of objects; `None` if no outlines are known.
    pub(super) count: Option<usize>,
    /// The position of the receiver; [`usize::MAX`] if there is none.
    pub(super) receiver: usize,
    /// The shadows on the receiver.
    pub(super) shadows: [ShadowOutline; SHADOW_OUTLINES],
    /// For each light, the objects that may shade the receiver and have no outline among `shadows`.
    pub(super) others: [ObjectSet; OUTLINED_LIGHTS],
}

/// The outline of the shadow that an object casts on the receiver.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadowOutline {
    pub(super) light: u8,
    pub(super) object: u8,
    pub(super) outline: Outline,
}

impl Outlines {
    /// No outlines are known: every object may be seen everywhere.
    pub(super) const UNKNOWN: Self = Self {
        objects: [Outline::Nowhere; ObjectSet::CAPACITY],
        count: None,
        receiver: usize::MAX,
        shadows: [ShadowOutline { light: 0, object: 0, outline: Outline::Nowhere }; SHADOW_OUTLINES],
        others: [ObjectSet::UNKNOWN; OUTLINED_LIGHTS],
    };

    /// Finds the outlines of a scene's objects, unless it has too many. In place, as `Outlines` is large.
    // Kept out of line: it needs much stack, once.
    #[inline(never)]
    pub(super) fn find<R: Real, S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        viewport: &Viewport<R>,
    ) {
        let Some(enclosures) = scene.enclosures() else { return };
        let eye = Vantage::eye(viewport);
        let (mut count, mut largest) = (0, 0);
        for (index, (place, enclosure)) in self.objects.iter_mut().zip(enclosures).enumerate() {
            *place = match enclosure {
                Enclosure::Ball { center, radius } => eye.outline(center.to_setup(), radius.to_setup()),
                Enclosure::Box(bounds) => Outline::of_box(bounds.to_setup(), viewport),
                Enclosure::Everywhere => Outline::Everywhere,
            };
            if place.area() > largest && scene.plane_of(index).is_some() {
                largest = place.area();
                self.receiver = index;
            }
            count = index + 1;
        }
        self.count = Some(count);
    }

    /// Finds the outlines of the shadows on the receiver, once the outlines of the objects are known.
    // Kept out of line: it needs much stack, once.
    #[inline(never)]
    pub(super) fn find_shadows<R: Real, S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        viewport: &Viewport<R>,
    ) {
        let (Some(_), Some(plane)) = (self.count(), scene.plane_of(self.receiver)) else { return };
        if scene.lights.len() > OUTLINED_LIGHTS {
            // `LineCandidates` takes any light to be unknown then.
            return;
        }
        let mut places = self.shadows.iter_mut();
        for (index, (light, others)) in scene.lights.iter().zip(&mut self.others).enumerate() {
            *others = if light.comes_from_all_around() {
                ObjectSet::NONE
            } else {
                scene.may_shade(self.receiver, index)
            };
            let projector = Projector::new(&light.source, plane, viewport);
            for object in *others {
                let Some((center, radius)) = scene.ball_of_shadow(object, &light.source) else { continue };
                let outline = projector.outline(center, radius);
                let Some(place) = places.next() else { return };
                *place = ShadowOutline { light: index as u8, object: object as u8, outline };
                *others = others.without(object);
            }
        }
    }

    /// The number of objects with an outline; `None` if no outlines are known. Without the feature
    /// `candidates`, this is a constant `None`.
    #[inline]
    pub(super) fn count(&self) -> Option<usize> {
        if cfg!(feature = "candidates") { self.count } else { None }
    }

    /// The pixels in which each object can be seen on the lines from `top` to `bottom`, both included, by
    /// rays with this aim; `None` if no outlines are known.
    pub(super) fn strip(&self, (top, bottom): (u16, u16), aim: Aim) -> Option<impl Iterator<Item = Span>> {
        let objects = self.objects.iter().take(self.count()?);
        Some(objects.map(move |outline| {
            #[cfg(feature = "distributed")]
            if aim == Aim::Corner {
                return outline.of_corners().lines(top, bottom);
            }
            let _ = aim;
            outline.lines(top, bottom)
        }))
    }

    /// The position of the receiver, which is no object's if there is none.
    pub(super) fn receiver(&self) -> usize {
        self.receiver
    }

    /// The outlines of the shadows less than `lines` lines high.
    pub(super) fn low_shadows(&self, lines: u32) -> impl Iterator<Item = &Outline> {
        let shadows = self.shadows.iter().map(|shadow| &shadow.outline);
        shadows.filter(move |outline| outline.is_lower_than(lines))
    }
}

#[cfg(all(test, feature = "candidates"))]
mod tests {
    use core::mem::MaybeUninit;

    use super::*;
    use crate::background::Background;
    use crate::camera::Camera;
    use crate::color::LinearRgb;
    use crate::light::Light;
    use crate::material::Material;
    use crate::math::Vec3;
    use crate::render::{Renderer, Settings};
    use crate::scene::{Object, Scene};
    use crate::shape::{Plane, Shape, Sphere};

    /// Ambient light has no place and no shadows, so it takes no outlines from the lamps behind it in the
    /// list.
    #[test]
    fn lights_without_a_place_have_no_shadows() {
        let ambient = [Light::Ambient { color: LinearRgb::WHITE }];
        let lamp = [Light::Point { position: Vec3::new(4.0, 6.0, 5.0), color: LinearRgb::WHITE }];
        let lights = [ambient, lamp].concat();
        let floor = Shape::Plane(Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0)));
        let ball = Shape::Sphere(Sphere::new(Vec3::new(0.0, 1.0, 0.0), 1.0));
        let objects = [floor, ball].map(|shape| Object::new(shape, 0));
        let camera = Camera {
            eye: Vec3::new(0.0, 2.0, 6.0),
            target: Vec3::new(0.0, 1.0, 0.0),
            up: Vec3::new(0.0, 1.0, 0.0),
            vertical_fov: 0.7,
            lens: None,
        };
        let materials = &[Material::matte(LinearRgb::WHITE)];
        let background = Background::BLACK;
        let scene = Scene { camera, background, objects: &objects, materials, lights: &lights, motions: &[] };
        let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
        let prepared = PreparedScene::<f32, _>::new(&scene, &mut memory).unwrap();
        let renderer = Renderer::new(&prepared, Settings::new(64, 48)).unwrap();
        let Outlines { shadows, others, .. } = &renderer.outlines;
        let found = shadows.iter().filter(|shadow| !matches!(shadow.outline, Outline::Nowhere));
        let lamps: Vec<u8> = found.map(|shadow| shadow.light).collect();
        assert!(!lamps.is_empty() && !lamps.contains(&0), "{lamps:?}");
        assert!(others[0].is_empty());
    }
}
