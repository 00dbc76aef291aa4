//! Textures that change coefficients of a material, and bump maps (Blinn, "Simulation of Wrinkled Surfaces",
//! SIGGRAPH 1978).

use core::marker::PhantomData;

use super::{PreparedTexture, Texture, present};
use crate::arena::Arena;
use crate::color::{LinearRgb, check_emission};
use crate::fault::{Fault, check_coordinate, check_held, check_number, check_size};
use crate::math::{Real, Scale, Vec3};
use crate::surface::Surface;

/// A texture that changes another property of a material than its color. Only the brightness of the texture
/// is used: a quarter of red, half of green and a quarter of blue.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Map<'a> {
    /// The property that the texture changes.
    pub onto: Onto,
    /// The texture, whose brightness is the amount.
    pub texture: Texture<'a>,
}

#[cfg(feature = "serde")]
crate::read::read_struct!([] Map as Map<'m> { onto, texture });

/// The property that a [`Map`] changes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[non_exhaustive]
pub enum Onto {
    /// [`Material::ambient`](crate::Material::ambient) is multiplied by the texture.
    Ambient,
    /// [`Material::diffuse`](crate::Material::diffuse) is multiplied by the texture.
    Diffuse,
    /// [`Material::specular`](crate::Material::specular) is multiplied by the texture.
    Specular,
    /// [`Material::reflectance`](crate::Material::reflectance) is multiplied by the texture.
    Reflectance,
    /// [`Material::transmittance`](crate::Material::transmittance) is multiplied by the texture.
    Transmittance,
    /// [`Optics::reflection_color`](crate::Optics::reflection_color) is multiplied by the texture, channel by
    /// channel.
    ReflectionColor,
    /// [`Optics::transmission_color`](crate::Optics::transmission_color) is multiplied by the texture,
    /// channel by channel.
    TransmissionColor,
    /// [`Optics::emission`](crate::Optics::emission) is multiplied by the texture, channel by channel. A
    /// [`Light::Object`](crate::Light::Object) shines as without the map.
    Emission,
    /// A bump map: the normal is tilted as if the texture raised the surface. Outlines do not change.
    Bump {
        /// The height of a white texture, in units of the scene.
        height: f32,
        /// The distance over which slopes are measured, in units of the scene, above 0. A sharp edge in the
        /// texture becomes a slope of this width.
        step: f32,
    },
    /// A normal map: the texture holds unit normals. Red, green and blue from 0 to 1 are coordinates from -1
    /// to 1: along the surface to where u grows; at a right angle to that, to where v grows; and along the
    /// normal. The numbers are no light: images need [`Encoding::Linear`](crate::Encoding::Linear). Outlines
    /// do not change.
    Normal {
        /// The factor of the first two coordinates: 1 leaves the normals as they are, 0 has no effect.
        strength: f32,
    },
    /// The texture, times `most`, is the ambient light that arrives at the surface, channel by channel, in
    /// place of the scene's: baked light, which path tracing leaves out. Several such maps add up.
    AmbientLight {
        /// The light of a white texture, 0 or more.
        most: f32,
    },
}

impl<'a> Map<'a> {
    /// Whether the map changes a color of [`Optics`](crate::Optics), which the material must then have.
    pub(crate) const fn needs_optics(&self) -> bool {
        matches!(self.onto, Onto::ReflectionColor | Onto::TransmissionColor | Onto::Emission)
    }

    /// The most bytes that [`prepare_all`](Self::prepare_all) takes.
    pub(crate) const fn bytes<R: Real>(mut maps: &[Self]) -> usize {
        let mut bytes = Arena::bytes::<PreparedMap<'_, R>>(maps.len());
        while let [map, rest @ ..] = maps {
            bytes = bytes.saturating_add(map.texture.bytes::<R>());
            maps = rest;
        }
        bytes
    }

    /// Checks the maps of a material and converts them.
    pub(crate) fn prepare_all<'m, R: Real>(
        maps: &[Self],
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedMaps<'m, R>, Fault>
    where
        'a: 'm,
    {
        if maps.is_empty() {
            return Ok(PreparedMaps::new(&[]));
        }
        present()?;
        let prepared = memory.try_store_with(maps.len(), |index, memory| {
            // Every index has a map, so this fault never occurs.
            let Map { onto, texture } = maps.get(index).ok_or(Fault::NotFinite)?;
            Ok::<_, Fault>(PreparedMap {
                onto: onto.prepare(scale)?,
                texture: texture.prepare(scale, memory)?,
            })
        })?;
        // All bump maps and normal maps may tilt a normal in one direction, so the sum of their slopes must
        // be in range.
        let slopes = prepared.iter().fold(R::Setup::ZERO, |sum, map: &PreparedMap<R>| match map.onto {
            PreparedOnto::Bump { slope, .. } => sum + slope.to_setup().abs(),
            PreparedOnto::Normal { strength } => sum + strength.to_setup().abs(),
            _ => sum,
        });
        check_held::<R>(slopes)?;
        Ok(PreparedMaps::new(prepared))
    }
}

impl Onto {
    fn prepare<R: Real>(self, scale: Scale) -> Result<PreparedOnto<R>, Fault> {
        Ok(match self {
            Self::Ambient => PreparedOnto::Ambient,
            Self::Diffuse => PreparedOnto::Diffuse,
            Self::Specular => PreparedOnto::Specular,
            Self::Reflectance => PreparedOnto::Reflectance,
            Self::Transmittance => PreparedOnto::Transmittance,
            Self::ReflectionColor => PreparedOnto::Optics(OpticsColor::Reflection),
            Self::TransmissionColor => PreparedOnto::Optics(OpticsColor::Transmission),
            Self::Emission => PreparedOnto::Optics(OpticsColor::Emission),
            Self::AmbientLight { most } => {
                check_emission::<R>(LinearRgb::gray(most))?;
                PreparedOnto::AmbientLight { most: R::from_f32(most) }
            }
            Self::Normal { strength } => {
                check_number(strength)?;
                check_held::<R>(R::Setup::from_f32(strength))?;
                PreparedOnto::Normal { strength: R::from_f32(strength) }
            }
            Self::Bump { height, step } => {
                check_coordinate(height)?;
                check_coordinate(step)?;
                let length: R = scale.length(R::Setup::from_f32(step));
                if !(step > 0.0) {
                    return Err(Fault::BumpStep);
                }
                check_size(length)?;
                let slope = R::Setup::from_f32(height) / R::Setup::from_f32(step);
                check_held::<R>(slope)?;
                PreparedOnto::Bump { slope: R::from_setup(slope), step: length }
            }
        })
    }
}

/// A color of the optics of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
enum OpticsColor {
    Reflection,
    Transmission,
    Emission,
}

/// A [`Map`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedMap<'m, R: Real> {
    onto: PreparedOnto<R>,
    texture: PreparedTexture<'m, R>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum PreparedOnto<R> {
    Ambient,
    Diffuse,
    Specular,
    Reflectance,
    Transmittance,
    Optics(OpticsColor),
    AmbientLight {
        most: R,
    },
    /// The slope between black and white at the distance `step`.
    Bump {
        slope: R,
        step: R,
    },
    Normal {
        strength: R,
    },
}

/// All maps of a material. Without the feature `textures` there are none, and they take no memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedMaps<'m, R: Real> {
    #[cfg(feature = "textures")]
    maps: &'m [PreparedMap<'m, R>],
    none: PhantomData<&'m R>,
}

/// The coefficients of a material, and the factors, 0 to 1, by which its colors are multiplied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coefficients<R> {
    pub(crate) ambient: R,
    pub(crate) diffuse: R,
    pub(crate) specular: R,
    pub(crate) reflectance: R,
    pub(crate) transmittance: R,
    /// The factors of colors of the optics; `None` where no map changes them.
    pub(crate) optics: Option<OpticsShares<R>>,
    /// The ambient light in place of the scene's; `None` where no map replaces it.
    pub(crate) ambient_light: Option<LinearRgb<R>>,
}

#[cfg(test)]
impl<R: Real> Coefficients<R> {
    /// All coefficients are `value`.
    pub(crate) fn even(value: R) -> Self {
        Self {
            ambient: value,
            diffuse: value,
            specular: value,
            reflectance: value,
            transmittance: value,
            optics: None,
            ambient_light: None,
        }
    }
}

/// The factors, 0 to 1, by which the colors of a material's optics are multiplied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OpticsShares<R> {
    pub(crate) reflection: LinearRgb<R>,
    pub(crate) transmission: LinearRgb<R>,
    pub(crate) emission: LinearRgb<R>,
}

impl<R: Real> OpticsShares<R> {
    const ALL: Self = {
        let white = LinearRgb::new(R::ONE, R::ONE, R::ONE);
        Self { reflection: white, transmission: white, emission: white }
    };

    fn part(&mut self, color: OpticsColor) -> &mut LinearRgb<R> {
        match color {
            OpticsColor::Reflection => &mut self.reflection,
            OpticsColor::Transmission => &mut self.transmission,
            OpticsColor::Emission => &mut self.emission,
        }
    }
}

impl<'m, R: Real> PreparedMaps<'m, R> {
    #[cfg_attr(not(feature = "textures"), expect(unused_variables))]
    fn new(maps: &'m [PreparedMap<'m, R>]) -> Self {
        Self {
            #[cfg(feature = "textures")]
            maps,
            none: PhantomData,
        }
    }

    fn all(&self) -> &'m [PreparedMap<'m, R>] {
        #[cfg(feature = "textures")]
        return self.maps;
        #[cfg(not(feature = "textures"))]
        &[]
    }

    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.all().is_empty()
    }

    /// The coefficients at a point of a surface, from those of the material; `uv` computes the point's
    /// texture coordinates.
    pub(crate) fn coefficients(
        &self,
        mut at: Coefficients<R>,
        surface: &Surface<R>,
        uv: impl Fn(&Surface<R>) -> [R; 2],
    ) -> Coefficients<R> {
        for PreparedMap { onto, texture } in self.all() {
            let share = match onto {
                PreparedOnto::Ambient => &mut at.ambient,
                PreparedOnto::Diffuse => &mut at.diffuse,
                PreparedOnto::Specular => &mut at.specular,
                PreparedOnto::Reflectance => &mut at.reflectance,
                PreparedOnto::Transmittance => &mut at.transmittance,
                PreparedOnto::Optics(part) => {
                    let share = at.optics.get_or_insert(OpticsShares::ALL).part(*part);
                    *share = *share * texture.color(surface, || uv(surface));
                    continue;
                }
                PreparedOnto::AmbientLight { most } => {
                    let light = texture.color(surface, || uv(surface)).scaled(*most);
                    let sum = at.ambient_light.map_or(light, |sum| sum + light);
                    at.ambient_light = Some(sum);
                    continue;
                }
                PreparedOnto::Bump { .. } | PreparedOnto::Normal { .. } => continue,
            };
            *share = *share * brightness(texture, surface, &uv);
        }
        at
    }

    /// A number for each map with sharp edges, which changes where the surface crosses an edge of the map.
    /// Smooth maps have none.
    pub(crate) fn steps(
        &self,
        surface: &Surface<R>,
        uv: impl Fn(&Surface<R>) -> [R; 2],
    ) -> impl Iterator<Item = u32> {
        self.all().iter().filter_map(move |PreparedMap { texture, .. }| {
            let step = texture.step(surface, || uv(surface))?;
            Some(step ^ (brightness(texture, surface, &uv).to_q16() >> 12).rotate_left(16))
        })
    }

    /// The shading normal, tilted by bump maps and normal maps, where a ray of direction `incoming` hits the
    /// surface.
    pub(crate) fn bumped(
        &self,
        surface: &Surface<R>,
        incoming: Vec3<R>,
        uv: impl Fn(&Surface<R>) -> [R; 2],
    ) -> Vec3<R> {
        let mut normal = surface.shading_normal;
        for PreparedMap { onto, texture } in self.all() {
            match *onto {
                PreparedOnto::Bump { slope, step } => {
                    let (first, second) = surface.shading_normal.around();
                    let here = brightness(texture, surface, &uv);
                    let rise = |along: Vec3<R>| {
                        let beside = Surface { point: surface.point + along * step, ..*surface };
                        (brightness(texture, &beside, &uv) - here) * slope
                    };
                    normal = normal - first * rise(first) - second * rise(second);
                }
                PreparedOnto::Normal { strength } => {
                    let Some((along_u, along_v)) = directions_of_uv(surface, &uv) else { continue };
                    let color = texture.color(surface, || uv(surface));
                    let [x, y, z] = [color.r, color.g, color.b].map(|share| share + share - R::ONE);
                    // Relative to the normal before: several maps add up, as bumps do.
                    let tilt = along_u * (x * strength) + along_v * (y * strength);
                    normal = normal + tilt - surface.shading_normal * (R::ONE - z);
                }
                _ => {}
            }
        }
        // No map tilts it: a unit vector need not be made one.
        if normal == surface.shading_normal {
            return normal;
        }
        let Some(normal) = normal.normalized() else { return surface.shading_normal };
        facing_the_same_way(normal, surface.shading_normal, incoming)
    }
}

/// The unit vectors along a surface in which u grows, and at a right angle to it, to the side in which v
/// grows; `None` where u does not grow. They are the tangent and the bitangent of normal maps (Lengyel,
/// "Foundations of Game Engine Development 2", 2019, section 7.5), from differences of texture coordinates.
fn directions_of_uv<R: Real>(
    surface: &Surface<R>,
    uv: impl Fn(&Surface<R>) -> [R; 2],
) -> Option<(Vec3<R>, Vec3<R>)> {
    let normal = surface.shading_normal;
    let (first, second) = normal.around();
    // A 256th of the largest coordinate has many digits, and few surfaces bend much over this length.
    let step = surface.magnitude.larger(R::ONE) * R::from_fraction(1 << 8);
    let here = uv(surface);
    let half = R::from_fraction(1 << 15);
    let over = |along: Vec3<R>, step: R| {
        let [u, v] = uv(&Surface { point: surface.point + along * step, ..*surface });
        let [u_here, v_here] = here;
        (u - u_here, v - v_here)
    };
    let growth = |along: Vec3<R>| {
        let (u, v) = over(along, step);
        if u.abs() <= half && v.abs() <= half {
            return (u, v);
        }
        // The texture is dense here, or it begins again: then coordinates differ by 1 over any length.
        let (u, v) = over(along, step * R::from_fraction(1 << 12));
        let without_turn = |growth: R| match growth {
            growth if growth > half => growth - R::ONE,
            growth if growth < -half => growth + R::ONE,
            growth => growth,
        };
        let sixteen = R::from_u16(16);
        (without_turn(u) * sixteen, without_turn(v) * sixteen)
    };
    let ((u_first, v_first), (u_second, v_second)) = (growth(first), growth(second));
    // The direction in which v does not change; the sign is that of the determinant.
    let along = (first * v_second - second * v_first).normalized()?;
    let is_mirrored = u_first.times(v_second) < u_second.times(v_first);
    let across = normal.cross(along);
    Some((if is_mirrored { -along } else { along }, across))
}

/// Limits a tilted normal to the side of the surface that the ray hits. Beyond it, the hit would count as one
/// of the other side.
fn facing_the_same_way<R: Real>(tilted: Vec3<R>, normal: Vec3<R>, incoming: Vec3<R>) -> Vec3<R> {
    let (before, after) = (normal.dot(incoming), tilted.dot(incoming));
    // A cosine of 1/64, about 89 degrees: on the right side even after rounding.
    let least = R::from_fraction(1 << 10);
    let least = if before > R::ZERO { least } else { -least };
    let is_seen = if before > R::ZERO { after >= least } else { after <= least };
    if is_seen {
        return tilted;
    }
    (tilted + incoming * (least - after)).normalized().unwrap_or(normal)
}

/// The brightness of a texture at a point of a surface: 0 to 1, and exact for grays.
fn brightness<R: Real>(
    texture: &PreparedTexture<'_, R>,
    surface: &Surface<R>,
    uv: impl Fn(&Surface<R>) -> [R; 2],
) -> R {
    let color = texture.color(surface, || uv(surface));
    (color.r + color.g + color.g + color.b) * R::from_fraction(1 << 14)
}

#[cfg(test)]
mod tests {
    use super::super::{Ends, Figure, Gradient, Placed, Placement};
    use super::*;
    use crate::arena::Workspace;
    use crate::color::LinearRgb;
    use crate::math::Fixed;

    const RAMP: Placed = Placed::new(
        Figure::Gradient(Gradient { from: LinearRgb::gray(0.0), to: LinearRgb::WHITE, ends: Ends::Repeat }),
        Placement::in_scene(1.0),
    );

    #[cfg(feature = "textures")]
    fn up<R: Real>(x: f32) -> Surface<R> {
        let normal = Vec3::new(R::ZERO, R::ONE, R::ZERO);
        let point = Vec3::new(R::from_f32(x), R::ZERO, R::ZERO);
        Surface { point, normal, shading_normal: normal, magnitude: R::ONE, part: 0 }
    }

    #[cfg(feature = "textures")]
    fn assert_mapped<R: Real>() {
        let bump = Onto::Bump { height: 1.0, step: 0.125 };
        let maps =
            [bump, Onto::Diffuse, Onto::Diffuse].map(|onto| Map { onto, texture: Texture::Placed(&RAMP) });
        let mut memory = Workspace::<4096>::new();
        let memory = &mut Arena::new(memory.lend());
        let maps = Map::prepare_all::<R>(&maps, Scale::ONE, memory).unwrap();
        let surface = up::<R>(0.25);
        let at = maps.coefficients(Coefficients::even(R::ONE), &surface, |_| unreachable!());
        assert_eq!((at.diffuse.to_f32(), at.ambient.to_f32()), (0.0625, 1.0));
        // A slope of 1 tilts the normal back by 45 degrees.
        let down = -surface.normal;
        let normal = maps.bumped(&surface, down, |_| unreachable!());
        let half = core::f32::consts::FRAC_1_SQRT_2;
        assert!((normal.to_f32() - Vec3::new(-half, half, 0.0)).magnitude() < 1e-6, "{normal:?}");
        // The tilted normal still faces a flat ray, from the front and from behind.
        let flat = Vec3::new(R::from_f32(-0.9), R::from_f32(-0.3), R::ZERO).normalized().unwrap();
        for incoming in [flat, -flat] {
            let normal = maps.bumped(&surface, incoming, |_| unreachable!());
            let (before, after) = (surface.normal.dot(incoming), normal.dot(incoming));
            assert!((before > R::ZERO) == (after > R::ZERO) && after.abs() > R::ZERO, "{after:?}");
        }
    }

    #[test]
    #[cfg(feature = "textures")]
    fn coefficients_are_multiplied_and_normals_tilted() {
        assert_mapped::<f32>();
        assert_mapped::<f64>();
        assert_mapped::<Fixed>();
    }

    /// Normal maps of one color on a floor, whose u and v grow along x and -z or against them.
    #[cfg(feature = "textures")]
    fn assert_tilted<R: Real>() {
        let surface = up::<R>(0.25);
        let down = -surface.normal;
        let tilted = |[red, green]: [f32; 2], strength: f32, [u, v]: [R; 2]| {
            let texture = Texture::Solid(LinearRgb::new(red, green, 0.9));
            let maps = [Map { onto: Onto::Normal { strength }, texture }];
            let mut memory = Workspace::<4096>::new();
            let maps = Map::prepare_all::<R>(&maps, Scale::ONE, &mut Arena::new(memory.lend())).unwrap();
            let normal = maps.bumped(&surface, down, |at| [at.point.x * u, -at.point.z * v]);
            normal.to_f32()
        };
        let (one, less) = (R::ONE, -R::ONE);
        for (color, strength, uv, expected) in [
            ([0.8, 0.5], 1.0, [one, one], Vec3::new(0.6, 0.8, 0.0)),
            ([0.5, 0.8], 1.0, [one, one], Vec3::new(0.0, 0.8, -0.6)),
            ([0.8, 0.5], 1.0, [less, one], Vec3::new(-0.6, 0.8, 0.0)),
            ([0.5, 0.8], 1.0, [less, one], Vec3::new(0.0, 0.8, -0.6)),
            ([0.5, 0.8], 1.0, [one, less], Vec3::new(0.0, 0.8, 0.6)),
            ([0.2, 0.5], 1.0, [one, one], Vec3::new(-0.6, 0.8, 0.0)),
            ([0.8, 0.5], 0.0, [one, one], Vec3::new(0.0, 1.0, 0.0)),
            // Without coordinates there is no direction.
            ([0.8, 0.5], 1.0, [R::ZERO, R::ZERO], Vec3::new(0.0, 1.0, 0.0)),
        ] {
            let normal = tilted(color, strength, uv);
            assert!((normal - expected).magnitude() < 1e-4, "{normal:?}, not {expected:?}");
        }
    }

    #[test]
    #[cfg(feature = "textures")]
    fn normal_maps_tilt_along_the_coordinates() {
        assert_tilted::<f32>();
        assert_tilted::<f64>();
        assert_tilted::<Fixed>();
    }

    #[test]
    #[cfg(not(feature = "textures"))]
    fn without_the_feature_maps_are_refused() {
        let maps = [Map { onto: Onto::Diffuse, texture: Texture::Placed(&RAMP) }];
        let mut memory = Workspace::<4096>::new();
        let refused = Map::prepare_all::<f32>(&maps, Scale::ONE, &mut Arena::new(memory.lend()));
        assert_eq!(refused.err(), Some(Fault::WithoutFeature { feature: "textures" }));
    }

    #[test]
    fn bad_bumps_are_refused() {
        let refusal = |height, step| Onto::Bump { height, step }.prepare::<Fixed>(Scale::ONE).err();
        assert_eq!(refusal(0.1, 0.1), None);
        assert_eq!(refusal(0.1, 0.0), Some(Fault::BumpStep));
        assert_eq!(refusal(f32::NAN, 0.1), Some(Fault::NotFinite));
        assert_eq!(refusal(0.1, 1e-7), Some(Fault::TooSmall));
        assert_eq!(refusal(100.0, 0.1), Some(Fault::OutOfRange));
    }

    #[test]
    #[cfg(feature = "textures")]
    fn bumps_that_add_up_to_too_much_are_refused() {
        fn refusal<R: Real>(count: usize) -> Option<Fault> {
            let maps =
                [Map { onto: Onto::Bump { height: 2.9, step: 0.1 }, texture: Texture::Placed(&RAMP) }; 3];
            let mut memory = Workspace::<4096>::new();
            Map::prepare_all::<R>(&maps[..count], Scale::ONE, &mut Arena::new(memory.lend())).err()
        }
        assert_eq!(refusal::<Fixed>(2), None);
        assert_eq!(refusal::<Fixed>(3), Some(Fault::OutOfRange));
        assert_eq!(refusal::<f32>(3), None);
    }
}
