//! Ready-made materials with measured constants.
//!
//! The reflectances of metals at normal incidence, in linear sRGB, were computed by Hoffman from measured
//! spectra ("Background: Physics and Math of Shading", SIGGRAPH 2013 course "Physically Based Shading in
//! Theory and Practice"; gold's red is slightly above 1 and is clamped). Indices of refraction are those at
//! 589 nm (Haynes (ed.), "CRC Handbook of Chemistry and Physics", 97th edition, section 10; BK7 and F2:
//! Schott data sheets). The absorption of water is that of pure water at 650, 550 and 450 nm (Pope and Fry,
//! "Absorption spectrum (380–700 nm) of pure water", Applied Optics 1997).
//!
//! Lights have no size, so that mirrors do not show them. A highlight stands for the mirrored light.
//!
//! ```
//! use rayline::{LinearRgb, Material, materials};
//! const METALS: [Material; 2] = [materials::GOLD, materials::SILVER];
//! const VASE: Material = Material { ior: 1.6, ..materials::GLASS };
//! let _red_ball = materials::glossy(LinearRgb::new(0.7, 0.05, 0.04));
//! ```

use super::{Fresnel, Material, Optics};
use crate::color::LinearRgb;
use crate::texture::Texture;

const BLACK: LinearRgb = LinearRgb::gray(0.0);
const PLAIN: Material = Material::matte(BLACK);

/// A polished metal of this reflectance (red, green, blue).
macro_rules! metal {
    ($(#[$doc:meta])* $NAME:ident, $r:literal, $g:literal, $b:literal) => {
        $(#[$doc])*
        pub const $NAME: Material = Material {
            diffuse: 0.0,
            specular: 0.9,
            shininess: 400.0,
            reflectance: 1.0,
            optics: Some(&Optics {
                fresnel: Fresnel::Schlick,
                reflection_color: LinearRgb::new($r, $g, $b),
                ..Optics::PLAIN
            }),
            ..PLAIN
        };
    };
}

metal!(
    /// Polished gold.
    GOLD, 1.0, 0.782, 0.344
);
metal!(
    /// Polished silver.
    SILVER, 0.972, 0.960, 0.915
);
metal!(
    /// Polished copper.
    COPPER, 0.955, 0.638, 0.538
);
metal!(
    /// Polished aluminum.
    ALUMINUM, 0.913, 0.922, 0.924
);
metal!(
    /// Polished iron.
    IRON, 0.562, 0.565, 0.578
);
metal!(
    /// Polished chromium.
    CHROMIUM, 0.549, 0.556, 0.554
);

/// A clear material: Fresnel's equations divide the light between reflection and refraction.
const CLEAR: Material = Material {
    diffuse: 0.0,
    specular: 0.6,
    shininess: 600.0,
    transmittance: 1.0,
    optics: Some(&Optics::CLEAR),
    ..PLAIN
};

/// Crown glass (BK7), clear.
pub const GLASS: Material = Material { ior: 1.5168, ..CLEAR };

/// Flint glass (F2), clear.
pub const FLINT: Material = Material { ior: 1.62, ..CLEAR };

/// Diamond.
pub const DIAMOND: Material = Material { ior: 2.417, ..CLEAR };

/// Ice, clear.
pub const ICE: Material = Material { ior: 1.309, ..CLEAR };

/// Water, for scenes whose unit is the meter (its absorption is per meter).
pub const WATER: Material = Material {
    ior: 1.333,
    optics: Some(&Optics { absorption: LinearRgb::new(0.340, 0.056_5, 0.009_22), ..Optics::CLEAR }),
    ..CLEAR
};

/// Lacquer or plastic: matte, under a mirroring clear coat of index 1.5.
pub const fn glossy(color: LinearRgb) -> Material<'static> {
    Material {
        color: Texture::Solid(color),
        ambient: 0.1,
        diffuse: 0.9,
        specular: 0.4,
        shininess: 120.0,
        reflectance: 1.0,
        ior: 1.5,
        optics: Some(&Optics { fresnel: Fresnel::Exact, ..Optics::PLAIN }),
        ..PLAIN
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arena::{Arena, Workspace};
    use crate::math::{Fixed, Scale};

    #[test]
    fn all_presets_can_be_prepared() {
        let all = [GOLD, SILVER, COPPER, ALUMINUM, IRON, CHROMIUM, GLASS, FLINT, DIAMOND, ICE, WATER];
        for material in all.into_iter().chain([glossy(LinearRgb::WHITE)]) {
            let mut memory = Workspace::<512>::new();
            let is_accepted = material.prepare::<f32>(Scale::ONE, &mut Arena::new(memory.lend())).is_ok()
                && material.prepare::<Fixed>(Scale::ONE, &mut Arena::new(memory.lend())).is_ok();
            assert_eq!(is_accepted, cfg!(feature = "optics"));
        }
    }
}
