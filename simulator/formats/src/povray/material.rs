//! Materials in POV-Ray's language: textures, finishes and interiors.

use rayline::{Falloff, Fresnel, Highlight, LinearRgb, Map, Material, Onto, Optics, Sides};

use super::Lack;
use super::images::Images;
use super::literal::{list, rgb};
use super::pattern::{self, Coordinates, Pattern};

/// Whether a material has a texture that lies on surfaces.
pub(super) fn is_on_surface(material: &Material<'_>) -> bool {
    let maps = material.maps.iter().map(|map| &map.texture);
    maps.chain([&material.color]).any(pattern::is_on_surface)
}

/// The contents of the `texture` block of a material: its colors and finish.
pub(super) fn texture<'a>(
    material: &Material<'a>,
    coordinates: &Coordinates,
    images: &Images<'_, 'a>,
) -> Result<String, Lack> {
    let mapped = if coordinates.is_mapped() { "uv_mapping " } else { "" };
    Ok(format!("{mapped}{}", with_maps(material, material.maps, coordinates, images)?))
}

/// The material with the given part of its maps. POV-Ray blends the light of whole textures. The result is
/// the same as with blended coefficients, because light is proportional to each coefficient.
fn with_maps<'a>(
    material: &Material<'a>,
    maps: &[Map<'a>],
    coordinates: &Coordinates,
    images: &Images<'_, 'a>,
) -> Result<String, Lack> {
    let Some((Map { onto, texture }, rest)) = maps.split_first() else {
        return plain(material, coordinates, images);
    };
    match onto {
        Onto::Bump { .. } | Onto::Normal { .. } => return Err(Lack::Bumps),
        Onto::AmbientLight { .. } => return Err(Lack::BakedLight),
        Onto::ReflectionColor | Onto::TransmissionColor | Onto::Emission => return Err(Lack::ColorMap),
        _ => {}
    }
    Pattern::of(texture, coordinates, images)?.textures(&|share| {
        let mut changed = *material;
        match onto {
            Onto::Ambient => changed.ambient *= share,
            Onto::Diffuse => changed.diffuse *= share,
            Onto::Specular => changed.specular *= share,
            Onto::Reflectance => changed.reflectance *= share,
            Onto::Transmittance => changed.transmittance *= share,
            _ => return Err(Lack::New),
        }
        with_maps(&changed, rest, coordinates, images)
    })
}

/// The material without maps.
fn plain<'a>(
    material: &Material<'a>,
    coordinates: &Coordinates,
    images: &Images<'_, 'a>,
) -> Result<String, Lack> {
    let Material { ambient, diffuse, reflectance, transmittance, .. } = *material;
    let optics = *material.optics.unwrap_or(&Optics::PLAIN);
    let Optics { fresnel, reflection_color, emission, reflection_falloff, gloss, translucency, .. } = optics;
    if optics.sides == Sides::Front {
        return Err(Lack::Sides);
    }
    if optics.thin && material.ior != 1.0 {
        return Err(Lack::Thin);
    }
    if gloss.is_some() || translucency.is_some() {
        return Err(Lack::Lobes);
    }
    if reflection_falloff != Falloff::NONE {
        return Err(Lack::ReflectionFalloff);
    }
    let opacity = 1.0 - transmit(material);
    let (pigment, highlight) = (pigment(material, coordinates, images)?, highlight(material));
    let metallic = if is_matte(material) || transmittance > 0.0 { "" } else { " metallic" };
    let with_reflection = |reflection: &str| {
        format!(
            "\n  pigment {{ {pigment} }}\n  finish {{ ambient {} diffuse {} {highlight}{metallic} \
             {reflection} emission rgb {} }}",
            f64::from(ambient) / opacity,
            f64::from(diffuse) / opacity,
            rgb(emission),
        )
    };
    let mirrored =
        |share: f32| reflection_color.channels().map(|channel| f64::from(channel) * f64::from(share));
    Ok(match fresnel {
        Fresnel::Constant => with_reflection(&format!("reflection rgb {}", list(&mirrored(reflectance)))),
        Fresnel::Exact => with_reflection(&format!(
            "reflection {{ rgb 0 rgb {} fresnel on }} conserve_energy",
            list(&mirrored(reflectance + transmittance))
        )),
        Fresnel::Schlick if transmittance > 0.0 => return Err(Lack::Schlick),
        Fresnel::Schlick => {
            // The angle between ray and normal, from 0 to 180 degrees.
            let at_angle = |degrees: u32| {
                let grazing = (1.0 - f64::from(degrees).to_radians().cos().abs()).powi(5);
                let shares = mirrored(reflectance).map(|share| (share + (1.0 - share) * grazing) as f32);
                let texture = with_reflection(&format!("reflection rgb {}", list(&shares)));
                format!(" [{}{texture}]", f64::from(degrees) / 180.0)
            };
            format!("aoi texture_map {{{} }}", (0..=180).map(at_angle).collect::<String>())
        }
    })
}

/// Whether a material has a color of its own.
fn is_matte(material: &Material<'_>) -> bool {
    material.ambient != 0.0 || material.diffuse != 0.0
}

/// The share of light that the pigment transmits. In POV-Ray a fully transparent surface has no diffuse
/// color, but in the core it may have one, so the share is slightly below 1.
fn transmit(material: &Material<'_>) -> f64 {
    f64::from(material.transmittance).min(0.999_999)
}

/// The contents of the `pigment` block.
fn pigment<'a>(
    material: &Material<'a>,
    coordinates: &Coordinates,
    images: &Images<'_, 'a>,
) -> Result<String, Lack> {
    let Optics { reflection_color, transmission_color, .. } = *material.optics.unwrap_or(&Optics::PLAIN);
    let transmit = transmit(material);
    if material.transmittance > 0.0 && transmission_color != LinearRgb::WHITE {
        if is_matte(material) {
            return Err(Lack::TransmissionColor);
        }
        let LinearRgb { r, g, b } = transmission_color;
        Ok(format!("rgbf <{r}, {g}, {b}, {transmit}>"))
    } else if is_matte(material) || material.transmittance > 0.0 {
        let color = |LinearRgb { r, g, b }: LinearRgb| Ok(format!("rgbt <{r}, {g}, {b}, {transmit}>"));
        Pattern::of(&material.color, coordinates, images)?.pigment(&color)
    } else {
        // The color of the highlight.
        Ok(format!("rgb {}", rgb(reflection_color)))
    }
}

/// The highlight, as a part of the `finish` block.
fn highlight(material: &Material<'_>) -> String {
    match material.optics.unwrap_or(&Optics::PLAIN).highlight {
        Highlight::Phong => format!("phong {} phong_size {}", material.specular, material.shininess),
        Highlight::BlinnPhong => {
            // The roughness is the inverse of the exponent. An exponent of 0 has no inverse.
            let roughness = f64::from(material.shininess).max(1e-3).recip();
            format!("specular {} roughness {roughness}", material.specular)
        }
    }
}

/// The `interior` block with this index of refraction; empty for a material whose appearance does not depend
/// on it.
pub(super) fn interior(material: &Material, ior: f64) -> String {
    let optics = material.optics.unwrap_or(&Optics::PLAIN);
    if material.transmittance == 0.0 && optics.fresnel != Fresnel::Exact {
        return String::new();
    }
    let ior = if ior == 1.0 { 1.000_001 } else { ior };
    let absorption = optics.absorption.channels().map(f64::from);
    let most = absorption.into_iter().fold(0.0, f64::max);
    // With a power of 1000 or more, POV-Ray computes exp(-(1 - color) d / distance).
    let fade = if most > 0.0 {
        let color = absorption.map(|coefficient| 1.0 - coefficient / most);
        format!(" fade_power 1001 fade_distance {} fade_color rgb {}", most.recip(), list(&color))
    } else {
        String::new()
    };
    format!(" interior {{ ior {ior}{fade} }}")
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::Pictures;
    use rayline::{Texture, materials};

    const PLAIN: Material = Material::matte(LinearRgb::WHITE);

    fn written(material: Material<'_>) -> Result<String, Lack> {
        let mut pictures = Pictures::beside(Path::new("no folder/scene.pov"));
        texture(&material, &Coordinates::SPACE, &Images::new(&mut pictures))
    }

    fn with_optics(material: Material<'_>, optics: Optics) -> Result<String, Lack> {
        written(Material { optics: Some(&optics), ..material })
    }

    #[test]
    fn maps_are_blends_of_textures() {
        let maps = [
            Map { onto: Onto::Diffuse, texture: Texture::Solid(LinearRgb::new(1.0, 0.0, 0.0)) },
            Map {
                onto: Onto::Ambient,
                texture: Texture::checker_xz(LinearRgb::WHITE, LinearRgb::gray(0.5), 1.0),
            },
        ];
        let text = written(Material { maps: &maps, ambient: 0.5, ..PLAIN }).unwrap();
        for entry in
            ["[0 \n  pigment", "ambient 0.5 diffuse 0.25", "[1 \n  pigment", "ambient 0.25 diffuse 0.25"]
        {
            assert!(text.contains(entry), "{text}");
        }
        let bumps = [Map { onto: Onto::Bump { height: 0.1, step: 0.1 }, texture: PLAIN.color }];
        assert_eq!(written(Material { maps: &bumps, ..PLAIN }), Err(Lack::Bumps));
    }

    #[test]
    fn metals_are_written_for_each_angle() {
        let text = written(materials::GOLD).unwrap();
        for entry in ["aoi texture_map { [0\n  pigment", "[0.5\n  pigment", "[1\n  pigment"] {
            assert!(text.contains(entry), "{text}");
        }
        // All is mirrored at grazing angles.
        let grazing = text.split("[0.5\n").nth(1).unwrap();
        let shares = grazing.split("reflection rgb <").nth(1).unwrap().split('>').next().unwrap();
        for share in shares.split(", ") {
            assert_eq!(share, "1", "{shares}");
        }
        let straight = text.split("[1\n").nth(1).unwrap();
        assert!(straight.contains("reflection rgb <1, 0.78"), "{straight}");
    }

    #[test]
    fn colored_glass_is_a_filter() {
        let red = Optics { transmission_color: LinearRgb::new(1.0, 0.5, 0.25), ..Optics::PLAIN };
        let glass = Material { transmittance: 0.5, diffuse: 0.0, ..PLAIN };
        assert!(with_optics(glass, red).unwrap().starts_with("\n  pigment { rgbf <1, 0.5, 0.25, 0.5> }"));
        assert_eq!(with_optics(Material { diffuse: 0.5, ..glass }, red), Err(Lack::TransmissionColor));
    }

    #[test]
    fn features_that_povray_lacks_are_refused() {
        let fading = Optics { reflection_falloff: Falloff::inverse_square(2.0), ..Optics::PLAIN };
        assert_eq!(with_optics(PLAIN, fading), Err(Lack::ReflectionFalloff));
        let schlick = Optics { fresnel: Fresnel::Schlick, ..Optics::PLAIN };
        assert_eq!(with_optics(Material { transmittance: 1.0, ..PLAIN }, schlick), Err(Lack::Schlick));
        assert!(with_optics(PLAIN, Optics { highlight: Highlight::BlinnPhong, ..Optics::PLAIN }).is_ok());
    }
}
