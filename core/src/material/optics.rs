//! What goes beyond Phong's and Whitted's models: color of what is mirrored and refracted, Fresnel's shares, absorption, light of
//! its own.

use super::Fresnel;
use super::fresnel::{exact, schlick};
use super::medium::{Absorption, Medium};
use crate::color::{LinearRgb, check_emission};
use crate::falloff::{Falloff, PreparedFalloff};
use crate::fault::{Coefficient, Fault, check_share};
use crate::math::{Real, Scale, Vec3};
use crate::throughput::Throughput;

/// What a [`Material`](super::Material) does with light beyond the models of Phong and Whitted.
///
/// ```
/// use rayline::{Fresnel, LinearRgb, Material, Optics};
/// const BOTTLE: Material = Material {
///     diffuse: 0.0,
///     transmittance: 1.0,
///     ior: 1.5,
///     optics: Some(&Optics { fresnel: Fresnel::Exact, absorption: LinearRgb::new(1.2, 0.1, 0.9), ..Optics::PLAIN }),
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
    /// What the highlight depends on.
    pub highlight: Highlight,
    /// How the shares of mirrored and refracted light depend on the angle.
    pub fresnel: Fresnel,
    /// Color of what is mirrored, highlights included: that of metals.
    pub reflection_color: LinearRgb,
    /// Color of what comes through the surface, shadow rays included.
    pub transmission_color: LinearRgb,
    /// Coefficients of absorption behind the surface, per unit of length, 0 or more: after a way s, exp(-coefficient s) is left of light (Beer's
    /// law). A ray that left the surface inward is dimmed until it meets anything.
    pub absorption: LinearRgb,
    /// Light that the surface gives off by itself; it lights nothing else. 0 or more.
    pub emission: LinearRgb,
    /// How what is mirrored fades with the distance to what the mirrored ray meets. The background does not fade.
    pub reflection_falloff: Falloff,
    /// What lies in front of the surface, where that is not air: for bubbles, for what lies in water, and for where two bodies touch. Rays
    /// that leave the surface outward are dimmed by its absorption.
    pub outside: Medium,
}

impl Optics {
    /// Nothing of it.
    pub const PLAIN: Self = Self {
        highlight: Highlight::Phong,
        fresnel: Fresnel::Constant,
        reflection_color: LinearRgb::WHITE,
        transmission_color: LinearRgb::WHITE,
        absorption: LinearRgb::gray(0.0),
        emission: LinearRgb::gray(0.0),
        reflection_falloff: Falloff::NONE,
        outside: Medium::AIR,
    };

    /// Those of clear glass: light is shared between mirroring and refraction by Fresnel's equations.
    pub const CLEAR: Self = Self { fresnel: Fresnel::Exact, ..Self::PLAIN };
}

impl Default for Optics {
    fn default() -> Self {
        Self::PLAIN
    }
}

#[cfg(feature = "serde")]
crate::read::plain!(Optics);

/// What a highlight depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Highlight {
    /// The angle between the mirrored ray and the light (Phong 1975).
    #[default]
    Phong,
    /// The angle between the normal and the middle of the ways to eye and light (Blinn, "Models of Light Reflection for Computer
    /// Synthesized Pictures", SIGGRAPH 1977). For a spot as large as Phong's the exponent is four times his.
    BlinnPhong,
}

/// The optics of a material, checked and converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedOptics<R: Real> {
    highlight: Highlight,
    fresnel: Fresnel,
    /// The mirrored share of a ray that comes straight, by the index of refraction.
    straight: R,
    pub(crate) reflection_color: LinearRgb<R>,
    transmission_color: LinearRgb<R>,
    /// Behind the surface; `None` where nothing is absorbed.
    absorption: Option<Absorption<R>>,
    /// In front of it.
    outside: Option<Absorption<R>>,
    pub(crate) emission: LinearRgb<R>,
    falloff: Option<PreparedFalloff<R>>,
}

/// The shares of light that is mirrored and refracted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shares<R> {
    pub(crate) mirrored: Throughput<R>,
    pub(crate) refracted: Throughput<R>,
}

impl Optics {
    /// Checks every number and converts it, but for the index outside; for a material of this index, over that outside.
    pub(super) fn prepare<R: Real>(&self, ior: R::Setup, scale: Scale) -> Result<PreparedOptics<R>, Fault> {
        let Self { reflection_color, transmission_color, emission, .. } = *self;
        for (coefficient, color) in [
            (Coefficient::ReflectionColor, reflection_color),
            (Coefficient::TransmissionColor, transmission_color),
        ] {
            color.channels().into_iter().try_for_each(|share| check_share(coefficient, share))?;
        }
        check_emission::<R>(emission)?;
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
            falloff: self.reflection_falloff.prepare(scale.to_f32())?,
        })
    }
}

impl<R: Real> PreparedOptics<R> {
    /// The cosine whose power is the highlight, where `normal` is on the side that a ray came from along `incoming`, and `mirrored` is
    /// the way on.
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

    /// The shares of what is mirrored and refracted at this cosine, where a material has these and `refraction` is the ratio of the
    /// indices of refraction with the cosine behind the surface, if light gets there.
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
            // From the denser side, the angle on the other one decides.
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

    /// Whether shares depend on the angle by the index of refraction, also of what lets no light through.
    pub(crate) fn needs_angle_behind(&self) -> bool {
        self.fresnel == Fresnel::Exact
    }

    /// What is left of light after a way of this length, or without end, in front of the surface, or behind it; `None`: all of it.
    #[inline(always)]
    pub(crate) fn left_after(&self, in_front: bool, length: Option<R>) -> Option<Throughput<R>> {
        let absorption = if in_front { &self.outside } else { &self.absorption };
        absorption.as_ref().map(|absorption| absorption.left_after(length))
    }

    /// What is left of a ray's throughput where it has left this surface outward or inward and gone this far; `None`: for ever, to the
    /// background.
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
        // The background is at no distance.
        if is_mirrored && let (Some(falloff), Some(length)) = (self.falloff, length) {
            left = left * falloff.at(length);
        }
        left
    }

    /// The share of light that the surface lets through.
    pub(crate) fn transmission_color(&self) -> Throughput<R> {
        Throughput::colored(self.transmission_color)
    }

    /// Whether light is lost on either side of the surface.
    pub(crate) fn absorbs(&self) -> bool {
        self.absorption.is_some() || self.outside.is_some()
    }
}
