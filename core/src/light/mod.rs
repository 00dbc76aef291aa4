//! Lights.

#[cfg(feature = "distributed")]
mod area;
#[cfg(feature = "distributed")]
mod closed_form;
mod lamp;

#[cfg(feature = "distributed")]
pub(crate) use area::{AreaLight, LampPoint};
#[cfg(feature = "distributed")]
pub(crate) use closed_form::{Cap, SeenLamp, light_of_ball};
pub(crate) use lamp::PreparedLamp;
pub use lamp::{Lamp, LightCone};

use crate::arena::Arena;
use crate::color::{LinearRgb, check_emission};
use crate::fault::{Fault, check_direction, check_point};
use crate::math::{Real, Scale, Vec3};

/// A light. All but [`Object`](Self::Object) and [`Sky`](Self::Sky) have no size, and shadows with sharp
/// edges.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Light {
    /// A point light that shines in all directions, equally bright at any distance.
    Point {
        /// The position of the light.
        position: Vec3,
        /// Its color and intensity, 0 or more.
        color: LinearRgb,
    },
    /// A light that is infinitely far away, like the sun.
    Directional {
        /// The direction in which the light travels; any length but 0.
        direction: Vec3,
        /// Its color and intensity, 0 or more.
        color: LinearRgb,
    },
    /// A point light with falloff, or with a cone. Needs the feature `optics`.
    Lamp(Lamp),
    /// Ambient light, by which [`Material::ambient`](crate::Material::ambient) is multiplied. Several ambient
    /// lights add up. A scene without any has white ambient light. Needs the feature `optics`.
    Ambient {
        /// Its color and intensity, 0 or more.
        color: LinearRgb,
    },
    /// The light of an object with a size, whose shadows have soft edges: a [`Sphere`](crate::shape::Sphere),
    /// a [`Disc`](crate::shape::Disc) without a hole, or a [`Rectangle`](crate::shape::Rectangle), with a
    /// material that [emits](crate::Optics::emission) light, on [one side](crate::Optics::emission_sides) or
    /// on both.
    ///
    /// The emission is the light that the lamp shows to the eye. A white surface that sees nothing but lamps
    /// in all directions is as bright as they are. Each hit takes 4 rays toward the lamp; with one sample of
    /// the pixel, 16 in the penumbra. What touches the lamp throws no shadow on the last 1/512 of the way to
    /// it. Needs the feature `distributed`.
    Object(ObjectId),
    /// The light of the background from all directions: a diffuse surface shows the mean of the sky above
    /// it, and less where objects hide the sky. It makes no highlights. At most one light of a scene is the
    /// sky. Needs the feature `distributed`.
    ///
    /// Each hit takes 4 rays into the sky; with one sample of the pixel, 16. In
    /// [closed form](crate::AreaLights::ClosedForm) it takes none: then only opaque balls and planes without
    /// end hide the sky, and a [`Panorama`](crate::Panorama) is sampled all the same.
    Sky,
}

/// The position of an object in [`Scene::objects`](crate::Scene::objects).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ObjectId(pub u16);

#[cfg(feature = "serde")]
crate::read::read_id!(ObjectId);

/// The fields of [`Light::Point`], as they are read.
#[cfg(feature = "serde")]
struct PointFields {
    position: Vec3,
    color: LinearRgb,
}

/// The fields of [`Light::Directional`], as they are read.
#[cfg(feature = "serde")]
struct DirectionalFields {
    direction: Vec3,
    color: LinearRgb,
}

/// The fields of [`Light::Ambient`], as they are read.
#[cfg(feature = "serde")]
struct AmbientFields {
    color: LinearRgb,
}

#[cfg(feature = "serde")]
crate::read::read_struct!([] PointFields as PointFields { position, color });
#[cfg(feature = "serde")]
crate::read::read_struct!([] DirectionalFields as DirectionalFields { direction, color });
#[cfg(feature = "serde")]
crate::read::read_struct!([] AmbientFields as AmbientFields { color });
#[cfg(feature = "serde")]
crate::read::plain!(Lamp);
#[cfg(feature = "serde")]
crate::read::read_enum! {
    [] Light as Light {
        Point { PointFields: position, color },
        Directional { DirectionalFields: direction, color },
        Lamp(Lamp),
        Ambient { AmbientFields: color },
        Object(ObjectId),
        Sky,
    }
}

impl Light {
    /// Whether the light needs the feature `optics`.
    pub(crate) const fn needs_optics(&self) -> bool {
        matches!(self, Self::Lamp(_) | Self::Ambient { .. })
    }

    /// The object that gives the light, if it is one.
    #[cfg(feature = "distributed")]
    pub(crate) const fn object(&self) -> Option<ObjectId> {
        if let Self::Object(object) = self { Some(*object) } else { None }
    }

    /// Whether the light needs the feature `distributed`.
    pub(crate) const fn needs_distributed(&self) -> bool {
        matches!(self, Self::Object(_) | Self::Sky)
    }

    /// The most bytes of lent memory that this light takes in addition to its `PreparedLight`.
    pub(crate) const fn bytes<R: Real>(&self) -> usize {
        #[cfg(feature = "distributed")]
        if self.object().is_some() {
            return Arena::bytes::<AreaLight<R>>(1);
        }
        if matches!(self, Self::Lamp(_)) { Arena::bytes::<PreparedLamp<R>>(1) } else { 0 }
    }

    /// The color of an ambient light; `None` for other lights.
    pub(crate) const fn ambient(&self) -> Option<LinearRgb> {
        if let Self::Ambient { color } = self { Some(*color) } else { None }
    }

    /// Checks every number and converts it.
    pub(crate) fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedLight<'m, R>, Fault> {
        if !cfg!(feature = "optics") && self.needs_optics() {
            return Err(Fault::WithoutFeature { feature: "optics" });
        }
        let mut prepared_lamp = None;
        let (source, color) = match *self {
            Self::Lamp(lamp) => {
                check_point(lamp.position)?;
                let source = Source::point(lamp.position, scale);
                prepared_lamp = Some(memory.store(lamp.prepare(scale.to_f32() * source.shrink())?)?);
                (source, lamp.color)
            }
            // An ambient light is kept in the list with direction zero, so that no surface receives light
            // from it.
            Self::Ambient { color } => (Source::Toward(Vec3::ZERO), color),
            // Objects and the sky have direction zero, too: their light is computed elsewhere.
            Self::Object(_) | Self::Sky if cfg!(feature = "distributed") => {
                (Source::Toward(Vec3::ZERO), LinearRgb::gray(0.0))
            }
            Self::Object(_) | Self::Sky => return Err(Fault::WithoutFeature { feature: "distributed" }),
            Self::Point { position, color } => {
                check_point(position)?;
                (Source::point(position, scale), color)
            }
            Self::Directional { direction, color } => {
                let direction: Vec3<R::Setup> = check_direction(direction)?;
                (Source::Toward(Vec3::from_setup(-direction)), color)
            }
        };
        check_emission::<R>(color)?;
        Ok(PreparedLight { source, color: color.to(), lamp: prepared_lamp })
    }
}

/// A light that was checked and converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedLight<'m, R> {
    pub(crate) source: Source<R>,
    pub(crate) color: LinearRgb<R>,
    lamp: Option<&'m PreparedLamp<R>>,
}

/// The place of a light, or the direction toward it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Source<R> {
    /// The position of a light.
    At(Vec3<R>),
    /// A light beyond the range of the number system: its position, scaled into range, and the scale, a power
    /// of two. Never in floating point.
    Far(Vec3<R>, R),
    /// The unit vector toward a directional light.
    Toward(Vec3<R>),
}

impl<R: Real> Source<R> {
    fn point(position: Vec3, scale: Scale) -> Self {
        if scale.is_near::<R>(position) {
            return Self::At(scale.point(position.to()));
        }
        let shrink = scale.shrink(position);
        Self::Far(scale.point((position * shrink).to()), R::from_f32(shrink))
    }

    /// The factor that scales the position of the light into range.
    fn shrink(&self) -> f32 {
        match *self {
            Self::Far(_, shrink) => shrink.to_f32(),
            Self::At(_) | Self::Toward(_) => 1.0,
        }
    }
}

impl<'m, R: Real> PreparedLight<'m, R> {
    /// The share of its light that a lamp sends to a point; `None` for a light that is no lamp. `toward` is
    /// the unit vector to the lamp, at this distance. Without the feature `optics` the compiler drops the
    /// code for it.
    // Forced, as in `seen_from`: without it, `classic` takes an M0 1.05 times the instructions in realtime
    // quality.
    #[inline(always)]
    pub(crate) fn share(&self, point: Vec3<R>, toward: Vec3<R>, distance: R) -> Option<R> {
        let lamp = if cfg!(feature = "optics") { self.lamp? } else { return None };
        let distance = match self.source {
            Source::Far(position, shrink) => (position - point * shrink).length(),
            Source::At(_) | Source::Toward(_) => distance,
        };
        Some(lamp.share(toward, distance))
    }

    /// Whether the light has no direction of its own: ambient light, the sky, and objects, whose light is
    /// found apart.
    pub(crate) fn comes_from_all_around(&self) -> bool {
        matches!(self.source, Source::Toward(toward) if toward == Vec3::ZERO)
    }

    /// The unit vector from a point to the light, the distance of the light, and the cosine between that
    /// vector and a unit normal; `None` where the light is behind the surface or at the point.
    #[inline(always)]
    pub(crate) fn seen_from(&self, point: Vec3<R>, normal: Vec3<R>) -> Option<(Vec3<R>, R, R)> {
        match self.source {
            Source::At(position) => {
                let Vec3 { x, y, z } = position - point;
                let (direction, distance, cosine) =
                    R::toward_light([x, y, z], [normal.x, normal.y, normal.z])?;
                let [x, y, z] = direction;
                Some((Vec3::new(x, y, z), distance, cosine))
            }
            Source::Far(position, shrink) => {
                // Scaling does not change the direction. The quotient saturates.
                let (direction, distance) = (position - point * shrink).unit_and_length();
                let cosine = direction.dot(normal);
                (cosine > R::ZERO).then_some((direction, (distance / shrink).smaller(R::FARTHEST), cosine))
            }
            Source::Toward(direction) => {
                let cosine = direction.dot(normal);
                (cosine > R::ZERO).then_some((direction, R::FARTHEST, cosine))
            }
        }
    }
}
