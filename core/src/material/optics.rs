//! Extensions of the models of Phong and Whitted: colored reflection and transmission, Fresnel terms,
//! absorption, emission.

use super::Fresnel;
use super::fresnel::{exact, schlick};
use super::medium::{Absorption, Medium};
use crate::color::{LinearRgb, check_emission};
use crate::falloff::{Falloff, PreparedFalloff};
use crate::fault::{Coefficient, Fault, check_number, check_share};
use crate::math::{Real, Scale, Vec3};
use crate::texture::OpticsShares;
use crate::throughput::Throughput;

/// Extensions of a [`Material`](super::Material) beyond the models of Phong and Whitted.
///
/// ```
/// use rayline::{Fresnel, LinearRgb, Material, Optics};
/// const BOTTLE: Material = Material {
///     diffuse: 0.0,
///     transmittance: 1.0,
///     ior: 1.5,
///     optics: Some(&Optics {
///         fresnel: Fresnel::Exact,
///         absorption: LinearRgb::new(1.2, 0.1, 0.9),
///         ..Optics::PLAIN
///     }),
///     ..Material::matte(LinearRgb::WHITE)
/// };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
pub struct Optics {
    /// The model of the highlight.
    pub highlight: Highlight,
    /// The model by which the shares of mirrored and refracted light depend on the angle.
    pub fresnel: Fresnel,
    /// The color of mirrored light and of highlights, such as that of a metal.
    pub reflection_color: LinearRgb,
    /// The color of light that passes the surface, shadow rays included.
    pub transmission_color: LinearRgb,
    /// Coefficients of absorption behind the surface, per unit of length, 0 or more: after a distance s, the
    /// share exp(-coefficient · s) of the light is left (Beer's law). A ray that leaves the surface inward is
    /// dimmed up to its next hit.
    pub absorption: LinearRgb,
    /// The light that the surface emits, 0 or more. It lights other objects if a light of the scene is this
    /// [object](crate::Light::Object).
    pub emission: LinearRgb,
    /// The sides of the surface that emit light. [`Sides::Front`] needs the feature `distributed`.
    pub emission_sides: Sides,
    /// The falloff of mirrored light with the length of the mirrored ray. The background does not fade.
    pub reflection_falloff: Falloff,
    /// The medium in front of the surface, where it is not air: for bubbles, for objects in water, and where
    /// two bodies touch. Its absorption dims the rays that leave the surface outward.
    pub outside: Medium,
    /// Gloss: the exponent n of a lobe around the mirrored direction, 0 or more. Mirrored rays are spread
    /// with a density that falls with the cosine of their angle to it, to the power n, as Phong's highlight
    /// of that [`shininess`](super::Material::shininess) does; `None`: a perfect mirror. Needs the feature
    /// `distributed`.
    pub gloss: Option<f32>,
    /// Translucency: as [`gloss`](Self::gloss), for refracted rays; `None`: clear glass.
    pub translucency: Option<f32>,
    /// The sides from which an opaque surface is seen. Camera rays, mirrored and refracted rays pass through
    /// the other side as if nothing was there. Shadows are thrown by both sides.
    pub sides: Sides,
    /// Whether the surface is a thin sheet, such as a window pane of one rectangle or a soap film: light goes
    /// straight through, and is mirrored on either side as by the front. A sheet has no inside, so that the
    /// absorption behind it must be 0.
    pub thin: bool,
}

impl Optics {
    /// No extension: the plain models of Phong and Whitted.
    pub const PLAIN: Self = Self {
        highlight: Highlight::Phong,
        fresnel: Fresnel::Constant,
        reflection_color: LinearRgb::WHITE,
        transmission_color: LinearRgb::WHITE,
        absorption: LinearRgb::gray(0.0),
        emission: LinearRgb::gray(0.0),
        emission_sides: Sides::Both,
        reflection_falloff: Falloff::NONE,
        outside: Medium::AIR,
        gloss: None,
        translucency: None,
        sides: Sides::Both,
        thin: false,
    };

    /// The optics of clear glass: Fresnel's equations divide the light between reflection and refraction.
    pub const CLEAR: Self = Self { fresnel: Fresnel::Exact, ..Self::PLAIN };
}

impl Default for Optics {
    fn default() -> Self {
        Self::PLAIN
    }
}

#[cfg(feature = "serde")]
crate::read::plain!(Optics);

/// The model of a highlight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Highlight {
    /// By the angle between the mirrored ray and the light (Phong 1975).
    #[default]
    Phong,
    /// By the angle between the normal and the half vector of the directions to eye and light (Blinn, "Models
    /// of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977). A spot as large as Phong's
    /// needs four times the exponent.
    BlinnPhong,
}

/// Sides of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Sides {
    /// Both sides.
    #[default]
    Both,
    /// The side that the normal points to: the outside of a closed shape, and the side of a
    /// [`Rectangle`](crate::shape::Rectangle) from which `right`, `up` and the viewer are right-handed.
    Front,
}

/// The optics of a material, checked and converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedOptics<R: Real> {
    highlight: Highlight,
    fresnel: Fresnel,
    /// The mirrored share at normal incidence, by the index of refraction.
    straight: R,
    pub(crate) reflection_color: LinearRgb<R>,
    transmission_color: LinearRgb<R>,
    /// The absorption behind the surface; `None` where it is 0.
    absorption: Option<Absorption<R>>,
    /// The absorption in front of the surface; `None` where it is 0.
    outside: Option<Absorption<R>>,
    emission: LinearRgb<R>,
    pub(crate) emission_sides: Sides,
    falloff: Option<PreparedFalloff<R>>,
    pub(crate) gloss: Option<Lobe<R>>,
    pub(crate) translucency: Option<Lobe<R>>,
    pub(crate) sides: Sides,
    pub(crate) thin: bool,
}

/// The shares of light from the mirrored and the refracted ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shares<R> {
    pub(crate) mirrored: Throughput<R>,
    pub(crate) refracted: Throughput<R>,
}

impl Optics {
    /// Checks every number but `outside.ior` and converts it. `ior` is the index of refraction behind the
    /// surface over that in front.
    pub(super) fn prepare<R: Real>(&self, ior: R::Setup, scale: Scale) -> Result<PreparedOptics<R>, Fault> {
        let Self { reflection_color, transmission_color, emission, .. } = *self;
        for (coefficient, color) in [
            (Coefficient::ReflectionColor, reflection_color),
            (Coefficient::TransmissionColor, transmission_color),
        ] {
            color.channels().into_iter().try_for_each(|share| check_share(coefficient, share))?;
        }
        check_emission::<R>(emission)?;
        if !cfg!(feature = "distributed") && self.emission_sides != Sides::Both {
            return Err(Fault::WithoutFeature { feature: "distributed" });
        }
        if self.thin && self.absorption != LinearRgb::gray(0.0) {
            return Err(Fault::ThinAbsorbs);
        }
        let straight = (ior - R::Setup::ONE) / (ior + R::Setup::ONE);
        Ok(PreparedOptics {
            highlight: self.highlight,
            fresnel: self.fresnel,
            straight: R::from_setup(straight * straight),
            reflection_color: reflection_color.to(),
            transmission_color: transmission_color.to(),
            absorption: Absorption::prepare(self.absorption, scale)?,
            outside: Absorption::prepare(self.outside.absorption, scale)?,
            emission: emission.to(),
            emission_sides: self.emission_sides,
            falloff: self.reflection_falloff.prepare(scale.to_f32())?,
            gloss: prepare_lobe::<R>(self.gloss)?,
            translucency: prepare_lobe::<R>(self.translucency)?,
            sides: self.sides,
            thin: self.thin,
        })
    }
}

/// The directions around a mirrored or refracted ray, whose density falls with the cosine to the power n.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lobe<R: Real> {
    /// `1 / (n + 1)`.
    pub(crate) spread: R::Factor,
    /// n.
    #[cfg(feature = "path-tracing")]
    exponent: R::Factor,
    /// π times the density in the middle.
    #[cfg(feature = "path-tracing")]
    most: R,
}

#[cfg(feature = "path-tracing")]
impl<R: Real> Lobe<R> {
    /// π times the density of directions at this cosine.
    pub(crate) fn density(&self, cosine: R) -> R {
        if cosine > R::ZERO { cosine.smaller(R::ONE).powf(self.exponent) * self.most } else { R::ZERO }
    }
}

/// Checks the exponent of a lobe, and converts it.
fn prepare_lobe<R: Real>(exponent: Option<f32>) -> Result<Option<Lobe<R>>, Fault> {
    let Some(exponent) = exponent else { return Ok(None) };
    if !cfg!(feature = "distributed") {
        return Err(Fault::WithoutFeature { feature: "distributed" });
    }
    check_number(exponent)?;
    if exponent < 0.0 {
        return Err(Fault::NegativeExponent);
    }
    Ok(Some(Lobe {
        spread: R::factor(1.0 / (exponent + 1.0)),
        #[cfg(feature = "path-tracing")]
        exponent: R::factor(exponent),
        #[cfg(feature = "path-tracing")]
        most: R::from_f32(0.5 * (exponent + 1.0)),
    }))
}

impl Optics {
    /// Whether these optics need the feature `distributed`.
    pub(crate) const fn needs_distributed(&self) -> bool {
        self.gloss.is_some() || self.translucency.is_some() || matches!(self.emission_sides, Sides::Front)
    }
}

impl<R: Real> PreparedOptics<R> {
    /// The optics with each color multiplied by its maps.
    pub(super) fn mapped(&self, shares: &OpticsShares<R>) -> Self {
        Self {
            reflection_color: self.reflection_color * shares.reflection,
            transmission_color: self.transmission_color * shares.transmission,
            emission: self.emission * shares.emission,
            ..*self
        }
    }

    /// The light that the surface emits on its front.
    pub(crate) fn emission(&self) -> LinearRgb<R> {
        self.emission
    }

    /// The light that the surface emits toward a ray of direction `incoming`. Without the feature
    /// `distributed`, it is the same on both sides.
    #[inline]
    pub(crate) fn emission_toward(&self, normal: Vec3<R>, incoming: Vec3<R>) -> LinearRgb<R> {
        let is_dark = cfg!(feature = "distributed")
            && self.emission_sides == Sides::Front
            && normal.dot(incoming) > R::ZERO;
        if is_dark { LinearRgb::BLACK } else { self.emission }
    }

    /// The cosine whose power is the highlight. `normal` is on the side of the surface that a ray of
    /// direction `incoming` hit, `mirrored` is the mirrored direction, and `toward` the direction to the
    /// light; all are unit vectors.
    pub(crate) fn highlight_cosine(
        &self,
        normal: Vec3<R>,
        incoming: Vec3<R>,
        mirrored: Vec3<R>,
        toward: Vec3<R>,
    ) -> R {
        match self.highlight {
            Highlight::Phong => mirrored.dot(toward),
            Highlight::BlinnPhong => {
                (toward - incoming).normalized().map_or(R::ZERO, |half| half.dot(normal))
            }
        }
    }

    /// The shares of mirrored and refracted light of a material with these coefficients. `cosine` is that of
    /// the angle between ray and normal, `eta` the index of refraction on the side of the ray over that on
    /// the other side, and `refracted_cosine` that of the refracted ray; it is `None` under total internal
    /// reflection.
    pub(crate) fn shares(
        &self,
        (reflectance, transmittance): (R, R),
        cosine: R,
        eta: R,
        refracted_cosine: Option<R>,
    ) -> Shares<R> {
        let (metal, glass) = (Throughput::colored(self.reflection_color), self.transmission_color());
        let opaque = |mirrored| Shares { mirrored, refracted: Throughput::even(R::ZERO) };
        let Some(behind) = refracted_cosine else {
            // Total internal reflection has no color.
            let LinearRgb { r, g, b } = self.reflection_color * reflectance;
            let all = LinearRgb::new(r + transmittance, g + transmittance, b + transmittance);
            return opaque(Throughput::colored(all));
        };
        let is_glass = transmittance > R::ZERO;
        let mirrored = match self.fresnel {
            Fresnel::Constant => {
                return Shares { mirrored: metal * reflectance, refracted: glass * transmittance };
            }
            // For a ray from the denser side, the angle on the other side counts.
            Fresnel::Schlick if is_glass => {
                schlick(self.straight, if eta > R::ONE { behind } else { cosine })
            }
            Fresnel::Schlick => {
                let LinearRgb { r, g, b } = self.reflection_color * reflectance;
                let mirrored = LinearRgb::new(schlick(r, cosine), schlick(g, cosine), schlick(b, cosine));
                return opaque(Throughput::colored(mirrored));
            }
            Fresnel::Exact => exact(eta, cosine, behind),
        };
        if !is_glass {
            return opaque(metal * (reflectance * mirrored));
        }
        let all = reflectance + transmittance;
        Shares { mirrored: metal * (all * mirrored), refracted: glass * (all * (R::ONE - mirrored)) }
    }

    /// Whether the shares depend on the refracted angle even if the material is opaque.
    pub(crate) fn needs_angle_behind(&self) -> bool {
        self.fresnel == Fresnel::Exact
    }

    /// The share of light that is left after this distance in front of the surface or behind it. A `length`
    /// of `None` is infinite; a result of `None` means that all light is left.
    #[inline]
    pub(crate) fn left_after(&self, in_front: bool, length: Option<R>) -> Option<Throughput<R>> {
        let absorption = if in_front { &self.outside } else { &self.absorption };
        absorption.as_ref().map(|absorption| absorption.left_after(length))
    }

    /// The throughput of a ray after it left this surface outward or inward and traveled this distance. A
    /// `length` of `None` means that the ray reached the background.
    pub(crate) fn dimmed(
        &self,
        throughput: Throughput<R>,
        outward: bool,
        is_mirrored: bool,
        length: Option<R>,
    ) -> Throughput<R> {
        let mut left = throughput;
        if let Some(through) = self.left_after(outward, length) {
            left = left * through;
        }
        // The falloff does not apply to the background.
        if is_mirrored && let (Some(falloff), Some(length)) = (self.falloff, length) {
            left = left * falloff.at(length);
        }
        left
    }

    /// The color of transmitted light, as a share.
    pub(crate) fn transmission_color(&self) -> Throughput<R> {
        Throughput::colored(self.transmission_color)
    }

    /// Whether the medium on either side of the surface absorbs light.
    pub(crate) fn absorbs(&self) -> bool {
        self.absorption.is_some() || self.outside.is_some()
    }
}
