//! Materials: the reflection, transmission and emission of light by surfaces.

mod fresnel;
mod medium;
mod optics;
pub mod presets;
mod shininess;

pub use fresnel::Fresnel;
pub use medium::Medium;
pub use optics::{Highlight, Optics, Sides};
pub(crate) use optics::{PreparedOptics, Shares};
pub(crate) use shininess::Shininess;

use crate::arena::Arena;
use crate::color::LinearRgb;
use crate::fault::{Coefficient, Fault, check_held, check_number, check_share};
use crate::math::{Real, Scale};
use crate::surface::Surface;
use crate::texture::{Coefficients, Map, PreparedMaps, PreparedTexture, Texture};

/// The shading model of a surface.
///
/// The light from a surface is the sum of an ambient, a diffuse (Lambert) and a highlight term (Phong,
/// "Illumination for Computer Generated Pictures", CACM 1975), of a mirrored ray and of a refracted ray
/// (Whitted, "An Improved Illumination Model for Shaded Display", CACM 1980). Coefficients lie in 0..=1, and
/// `reflectance` and `transmittance` add up to at most 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Material<'a> {
    /// The color of the ambient and diffuse terms.
    pub color: Texture<'a>,
    /// The coefficient of the ambient term: color times ambient light.
    pub ambient: f32,
    /// The coefficient of the diffuse term: color times the light that arrives (Lambert).
    pub diffuse: f32,
    /// The strength of the highlight, which has the color of the light (Phong).
    pub specular: f32,
    /// The exponent of the highlight, 0 or more: a larger one makes a smaller spot.
    pub shininess: f32,
    /// The share of light from the mirrored ray.
    pub reflectance: f32,
    /// The share of light from the refracted ray, and the share that a shadow ray keeps when it passes the
    /// surface.
    pub transmittance: f32,
    /// The index of refraction behind the surface, where the normal does not point. In front of the surface
    /// it is 1, or that of [`Optics::outside`]; see [`Medium`] for nested bodies.
    pub ior: f32,
    /// Extensions of this model, if it has any. Needs the feature `optics`.
    pub optics: Option<&'a Optics>,
    /// Textures on coefficients, and bump maps. They need the feature `textures`.
    pub maps: &'a [Map<'a>],
}

/// The defaults of fields that a file leaves out.
#[cfg(feature = "serde")]
const WHITE: Material = Material::matte(LinearRgb::WHITE);

#[cfg(feature = "serde")]
crate::read::read_struct! {
    [] Material as Material<'m> {
        color = WHITE.color, ambient = WHITE.ambient, diffuse = WHITE.diffuse, specular = WHITE.specular,
        shininess = WHITE.shininess, reflectance = WHITE.reflectance, transmittance = WHITE.transmittance,
        ior = WHITE.ior, optics = WHITE.optics, maps = WHITE.maps,
    }
    may be named
}

impl<'a> Material<'a> {
    /// A matte surface: diffuse 1 and all other coefficients 0.
    pub const fn matte(color: LinearRgb) -> Self {
        Self {
            color: Texture::Solid(color),
            ambient: 0.0,
            diffuse: 1.0,
            specular: 0.0,
            shininess: 0.0,
            reflectance: 0.0,
            transmittance: 0.0,
            ior: 1.0,
            optics: None,
            maps: &[],
        }
    }

    /// Whether the material needs the feature `optics`.
    pub(crate) const fn needs_optics(&self) -> bool {
        self.optics.is_some()
    }

    /// Whether the material needs the feature `distributed`.
    pub(crate) fn needs_distributed(&self) -> bool {
        self.optics.is_some_and(Optics::needs_distributed)
    }

    /// Whether the material needs the feature `textures`.
    pub(crate) const fn needs_textures(&self) -> bool {
        matches!(self.color, Texture::Placed(_)) || !self.maps.is_empty()
    }

    /// The most bytes of lent memory that this material takes in addition to its `PreparedMaterial`.
    pub(crate) const fn bytes<R: Real>(&self) -> usize {
        let optics = if self.needs_optics() { Arena::bytes::<PreparedOptics<R>>(1) } else { 0 };
        optics.saturating_add(self.color.bytes::<R>()).saturating_add(Map::bytes::<R>(self.maps))
    }

    /// Refuses optics that do not fit the rest of the material. Without the features, nothing can misfit.
    fn check_optics(&self) -> Result<(), Fault> {
        if cfg!(feature = "optics")
            && self.transmittance > 0.0
            && self.optics.is_some_and(|optics| optics.sides == Sides::Front)
        {
            return Err(Fault::OneSidedGlass);
        }
        if cfg!(feature = "textures") && self.optics.is_none() && self.maps.iter().any(Map::needs_optics) {
            return Err(Fault::MapWithoutOptics);
        }
        Ok(())
    }

    /// Checks every number and converts it.
    pub(crate) fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedMaterial<'m, R>, Fault>
    where
        'a: 'm,
    {
        for (coefficient, share) in [
            (Coefficient::Ambient, self.ambient),
            (Coefficient::Diffuse, self.diffuse),
            (Coefficient::Specular, self.specular),
            (Coefficient::Reflectance, self.reflectance),
            (Coefficient::Transmittance, self.transmittance),
        ] {
            check_share(coefficient, share)?;
        }
        // Rounded shares may add up to slightly more than 1 in f32.
        if self.reflectance + self.transmittance > 1.000_001 {
            return Err(Fault::EnergyAboveOne);
        }
        check_number(self.shininess)?;
        if self.shininess < 0.0 {
            return Err(Fault::NegativeShininess);
        }
        let mut ior = medium::check_ior::<R>(self.ior)?;
        // Refraction depends on the ratio of the indices on both sides.
        if cfg!(feature = "optics")
            && let Some(optics) = self.optics
        {
            ior = ior / medium::check_ior::<R>(optics.outside.ior)?;
        }
        // Refraction squares the ratio.
        check_held::<R>(ior * ior)?;
        check_held::<R>((ior * ior).recip())?;
        if !cfg!(feature = "optics") && self.needs_optics() {
            return Err(Fault::WithoutFeature { feature: "optics" });
        }
        self.check_optics()?;
        let optics = match self.optics {
            None => None,
            Some(optics) => Some(memory.store(optics.prepare(ior, scale)?)?),
        };
        Ok(PreparedMaterial {
            color: self.color.prepare(scale, memory)?,
            ambient: R::from_f32(self.ambient),
            diffuse: R::from_f32(self.diffuse),
            specular: R::from_f32(self.specular),
            shininess: Shininess::new(self.shininess),
            reflectance: R::from_f32(self.reflectance),
            transmittance: R::from_f32(self.transmittance),
            eta_entering: R::from_setup(ior.recip()),
            eta_leaving: R::from_setup(ior),
            optics,
            maps: Map::prepare_all(self.maps, scale, memory)?,
            #[cfg(feature = "textures")]
            ambient_light: None,
        })
    }
}

/// A material that was checked and converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedMaterial<'m, R: Real> {
    pub(crate) color: PreparedTexture<'m, R>,
    pub(crate) ambient: R,
    pub(crate) diffuse: R,
    pub(crate) specular: R,
    pub(crate) shininess: Shininess<R>,
    pub(crate) reflectance: R,
    pub(crate) transmittance: R,
    /// The ratio of the indices of refraction for a ray that enters at the front: the index in front over
    /// that behind.
    pub(crate) eta_entering: R,
    /// The ratio for a ray that leaves: the index behind over that in front.
    pub(crate) eta_leaving: R,
    optics: Option<&'m PreparedOptics<R>>,
    pub(crate) maps: PreparedMaps<'m, R>,
    /// The ambient light that maps say, in place of the scene's.
    #[cfg(feature = "textures")]
    ambient_light: Option<&'m LinearRgb<R>>,
}

/// Room for what a map changes of a material.
pub(crate) struct MapRoom<R: Real> {
    optics: Option<PreparedOptics<R>>,
    #[cfg(feature = "textures")]
    ambient_light: Option<LinearRgb<R>>,
}

impl<R: Real> MapRoom<R> {
    pub(crate) const EMPTY: Self = Self {
        optics: None,
        #[cfg(feature = "textures")]
        ambient_light: None,
    };
}

impl<'m, R: Real> PreparedMaterial<'m, R> {
    /// The material at a point of a surface, with each coefficient multiplied by its maps. `uv` computes the
    /// texture coordinates of the point, and `room` keeps the colors that maps change.
    pub(crate) fn mapped<'r>(
        &self,
        surface: &Surface<R>,
        uv: impl Fn(&Surface<R>) -> [R; 2],
        room: &'r mut MapRoom<R>,
    ) -> PreparedMaterial<'r, R>
    where
        'm: 'r,
    {
        let Self { ambient, diffuse, specular, reflectance, transmittance, .. } = *self;
        let (optics, ambient_light) = (None, None);
        let own =
            Coefficients { ambient, diffuse, specular, reflectance, transmittance, optics, ambient_light };
        let at = self.maps.coefficients(own, surface, uv);
        let optics = match (self.optics(), at.optics) {
            (Some(optics), Some(shares)) => Some(&*room.optics.insert(optics.mapped(&shares))),
            (optics, _) => optics,
        };
        PreparedMaterial {
            ambient: at.ambient,
            diffuse: at.diffuse,
            specular: at.specular,
            reflectance: at.reflectance,
            transmittance: at.transmittance,
            optics,
            #[cfg(feature = "textures")]
            ambient_light: at.ambient_light.map(|light| &*room.ambient_light.insert(light)),
            ..*self
        }
    }

    /// The ambient light of a map; `None` where no map replaces the scene's ambient light.
    #[inline]
    pub(crate) fn ambient_light(&self) -> Option<LinearRgb<R>> {
        #[cfg(feature = "textures")]
        return self.ambient_light.copied();
        #[cfg(not(feature = "textures"))]
        None
    }

    /// Whether the surface is seen from its front only: see [`Optics::sides`].
    pub(crate) fn is_one_sided(&self) -> bool {
        self.optics().is_some_and(|optics| optics.sides == Sides::Front)
    }

    /// Whether mirrored or refracted rays may start at its surface.
    #[inline]
    pub(crate) fn sends_rays(&self) -> bool {
        self.reflectance > R::ZERO || self.transmittance > R::ZERO || self.optics().is_some()
    }

    /// Whether mirrored or refracted rays go in any direction of a lobe.
    #[cfg(feature = "distributed")]
    pub(crate) fn spreads_rays(&self) -> bool {
        self.optics().is_some_and(|optics| optics.gloss.is_some() || optics.translucency.is_some())
    }

    /// The extensions of the models of Phong and Whitted, if the material has any. Without the feature
    /// `optics` this is `None` at compile time, and the code for it is dropped.
    #[inline]
    pub(crate) fn optics(&self) -> Option<&'m PreparedOptics<R>> {
        if cfg!(feature = "optics") { self.optics } else { None }
    }
}
