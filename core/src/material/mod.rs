//! What a surface does with light.

mod fresnel;
mod medium;
mod optics;
pub mod presets;
mod shininess;

pub use fresnel::Fresnel;
pub use medium::Medium;
pub use optics::{Highlight, Optics};
pub(crate) use optics::{PreparedOptics, Shares};
pub(crate) use shininess::Shininess;

use crate::arena::Arena;
use crate::color::LinearRgb;
use crate::fault::{Coefficient, Fault, check_held, check_number, check_share};
use crate::math::{Real, Scale};
use crate::surface::Surface;
use crate::texture::{Map, PreparedMaps, PreparedTexture, Texture};

/// What a surface does with light: the recursive model of the lectures.
///
/// Ambient, Lambert and Phong terms (Phong, "Illumination for Computer Generated Pictures", CACM 1975) plus
/// what a mirror and a refracted ray bring (Whitted, "An Improved Illumination Model for Shaded Display",
/// CACM 1980). Coefficients lie in 0..=1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Material<'a> {
    /// The color of the ambient and diffuse terms.
    pub color: Texture<'a>,
    /// Share of the color that is always seen.
    pub ambient: f32,
    /// Share of the color that lights show (Lambert).
    pub diffuse: f32,
    /// Strength of the highlight, which has the color of the light (Phong).
    pub specular: f32,
    /// Exponent of the highlight: the larger, the smaller the spot.
    pub shininess: f32,
    /// Share of what the mirrored ray sees.
    pub reflectance: f32,
    /// Share of what the refracted ray sees, and of the light that a shadow ray keeps at each surface.
    pub transmittance: f32,
    /// Index of refraction behind the surface: the side that its normal points away from. In front of it, 1, or what
    /// [`Optics::outside`] says; see [`Medium`] for what is nested.
    pub ior: f32,
    /// What goes beyond this model, if anything does.
    pub optics: Option<&'a Optics>,
    /// Textures on coefficients, and bumps. Need the feature `textures`.
    pub maps: &'a [Map<'a>],
}

/// What a file leaves out is as in this.
#[cfg(feature = "serde")]
const WHITE: Material = Material::matte(LinearRgb::WHITE);

#[cfg(feature = "serde")]
crate::read::read_struct! {
    [] Material as Material<'m> {
        color = WHITE.color, ambient = WHITE.ambient, diffuse = WHITE.diffuse, specular = WHITE.specular,
        shininess = WHITE.shininess, reflectance = WHITE.reflectance, transmittance = WHITE.transmittance, ior = WHITE.ior,
        optics = WHITE.optics, maps = WHITE.maps,
    }
    may be named
}

impl<'a> Material<'a> {
    /// A plain matte surface.
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

    /// Whether it asks for the feature `optics`.
    pub(crate) const fn needs_optics(&self) -> bool {
        self.optics.is_some()
    }

    /// Whether it asks for the feature `textures`.
    pub(crate) const fn needs_textures(&self) -> bool {
        matches!(self.color, Texture::Placed(_)) || !self.maps.is_empty()
    }

    /// The most bytes that the material takes from the memory that the caller lends, beyond what each does.
    pub(crate) const fn bytes<R: Real>(&self) -> usize {
        let optics = if self.needs_optics() { Arena::bytes::<PreparedOptics<R>>(1) } else { 0 };
        optics.saturating_add(self.color.bytes::<R>()).saturating_add(Map::bytes::<R>(self.maps))
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
        // Shares such as 0.1 and 0.9 add up to a little more than 1 in f32.
        if self.reflectance + self.transmittance > 1.000_001 {
            return Err(Fault::EnergyAboveOne);
        }
        check_number(self.shininess)?;
        if self.shininess < 0.0 {
            return Err(Fault::NegativeShininess);
        }
        let mut ior = medium::check_ior::<R>(self.ior)?;
        // What bends rays is the ratio of both sides.
        if cfg!(feature = "optics")
            && let Some(optics) = self.optics
        {
            ior = ior / medium::check_ior::<R>(optics.outside.ior)?;
        }
        // Squared when a ray is refracted.
        check_held::<R>(ior * ior)?;
        check_held::<R>((ior * ior).recip())?;
        if !cfg!(feature = "optics") && self.needs_optics() {
            return Err(Fault::WithoutFeature { feature: "optics" });
        }
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
    /// Ratio of the indices of refraction for a ray that goes in at the front: that in front over that behind.
    pub(crate) eta_entering: R,
    /// The same for a ray that comes out.
    pub(crate) eta_leaving: R,
    optics: Option<&'m PreparedOptics<R>>,
    pub(crate) maps: PreparedMaps<'m, R>,
}

impl<'m, R: Real> PreparedMaterial<'m, R> {
    /// The material at a surface, where it has maps: each coefficient times the textures on it. `uv` tells where on its shape a
    /// surface is.
    pub(crate) fn mapped(&self, surface: &Surface<R>, uv: impl Fn(&Surface<R>) -> [R; 2]) -> Self {
        let shares = self.maps.shares(surface, uv);
        Self {
            ambient: self.ambient * shares.ambient,
            diffuse: self.diffuse * shares.diffuse,
            specular: self.specular * shares.specular,
            reflectance: self.reflectance * shares.reflectance,
            transmittance: self.transmittance * shares.transmittance,
            ..*self
        }
    }

    /// Whether any ray may have to be followed from its surface.
    #[inline(always)]
    pub(crate) fn sends_rays(&self) -> bool {
        self.reflectance > R::ZERO || self.transmittance > R::ZERO || self.optics().is_some()
    }

    /// What goes beyond Phong's and Whitted's models, if anything does. Without the feature, the compiler sees that nothing does
    /// and drops the code for it.
    #[inline(always)]
    pub(crate) fn optics(&self) -> Option<&'m PreparedOptics<R>> {
        if cfg!(feature = "optics") { self.optics } else { None }
    }
}
