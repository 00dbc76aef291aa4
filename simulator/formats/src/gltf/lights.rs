//! Lights (`KHR_lights_punctual`).

use rayline::math::Aabb;
use rayline::{Falloff, Lamp, Light, LightCone, LinearRgb, Scene};

use super::error::{At, GltfFault, Wrong, find, name};
use super::json::{Light as Punctual, Root, Spot};
use super::nodes::{Place, Placed};
use crate::meter;
use crate::nff::Excerpt;
use crate::notes::Notes;

/// The lights of a scene.
#[derive(Debug, Default)]
pub(super) struct Lights<'f> {
    all: Vec<Lit<'f>>,
    /// The root of the sum of their squared illuminances, in lux, in the middle of the scene.
    white: f64,
}

/// The kind of a light of the file.
#[derive(Clone, Copy, Debug)]
enum Type {
    Directional,
    Point,
    Spot,
}

/// A light of the file at a node.
#[derive(Debug)]
struct Lit<'f> {
    light: &'f Punctual,
    /// In lux or candela of the scene.
    intensity: f64,
    kind: Type,
    place: Place,
    /// The illuminance, in lux, of a surface in the middle of the scene that faces the light.
    illuminance: f64,
    name: String,
}

/// The smallest distance at which the falloff of a lamp begins.
const NEAREST: f32 = 2e-3;

/// The largest light of a lamp near its position, in units of white.
const BRIGHTEST: f32 = 16.0;

/// The factor of the lights while they are measured. Lamps as faint as this fall off by the inverse square
/// even near to their positions.
const FAINT: f64 = 1.0 / 1024.0;

/// The least and the largest factor of the exposure: -20 and 2 stops. At twice the distance there is a
/// quarter of the light. What the lights still leave dark is dark itself, and must not look white.
const FACTORS: (f64, f64) = (1.0 / 1_048_576.0, 4.0);

/// All lights of the nodes. `unit` is the length of a unit of the file in the scene.
pub(super) fn of<'f>(
    root: &'f Root,
    nodes: &[Placed<'_>],
    (bounds, unit): (Aabb<f32>, f64),
    notes: &mut Notes,
) -> Result<Lights<'f>, Wrong> {
    let mut all = Vec::new();
    for placed in nodes {
        let Some(extension) = &placed.node.extensions.light else { continue };
        let lit = lit(root, extension.light, placed, (bounds, unit)).at(|| placed.name())?;
        if lit.light.range.is_some() {
            notes.add(&*lit.name, "its range is left out: it shines at any distance");
        }
        if lit.illuminance > 0.0 {
            all.push(lit);
        } else {
            notes.add(&*lit.name, "left out: it has no light");
        }
    }
    let sum: f64 = all.iter().map(|lit| lit.illuminance * lit.illuminance).sum();
    Ok(Lights { all, white: sum.sqrt() })
}

impl Lights<'_> {
    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    pub(super) fn names(self) -> Vec<String> {
        self.all.into_iter().map(|lit| lit.name).collect()
    }

    /// The lights, so bright that the root of the sum of their squared illuminances in the middle of the
    /// scene is this factor times white.
    pub(super) fn described(&self, factor: f64) -> Result<Vec<Light>, Wrong> {
        let light = |lit: &Lit<'_>| lit.described(self.white / factor).at(|| lit.name.clone());
        self.all.iter().map(light).collect()
    }

    /// The lights with the exposure that makes the brightest lit pixels almost white, in a picture of this
    /// size. `scene` is the scene without lights.
    pub(super) fn exposed(
        &self,
        scene: &Scene<'_>,
        resolution: (u32, u32),
        notes: &mut Notes,
    ) -> Result<Vec<Light>, Wrong> {
        let faint = self.described(FAINT)?;
        let Some(factor) = meter::factor(&Scene { lights: &faint, ..*scene }, resolution) else {
            notes.add("exposure", "the camera sees nothing that the lights reach; see --exposure");
            return self.described(1.0);
        };
        let factor = (f64::from(factor) * FAINT).clamp(FACTORS.0, FACTORS.1);
        // Three digits.
        let digits = (2.0 - factor.log10().floor()).max(0.0) as usize;
        let what = format!(
            "for what the camera sees, the lights are {factor:.digits$} times as bright ({:+.1} stops) as \
             for a white middle of the scene; see --exposure",
            factor.log2()
        );
        notes.add("exposure", what);
        self.described(factor)
    }
}

fn lit<'f>(
    root: &'f Root,
    index: usize,
    placed: &Placed<'_>,
    (bounds, unit): (Aabb<f32>, f64),
) -> Result<Lit<'f>, Wrong> {
    let light = find(&root.extensions.lights.lights, "light", index)?;
    let at = || name("light", index, light.name.as_ref());
    let [red, green, blue] = light.color;
    for (meaning, number) in
        [("its intensity", light.intensity), ("its color", red), ("its color", green), ("its color", blue)]
    {
        if !(0.0..=1e9).contains(&number) {
            return Err(GltfFault::Number { meaning, found: number.into() }).at(at);
        }
    }
    let kind = match &*light.kind {
        "directional" => Type::Directional,
        "point" => Type::Point,
        "spot" => Type::Spot,
        other => {
            let found = format!("`{}`", Excerpt(other));
            return Err(GltfFault::Kind { expected: "a point, spot or directional light", found }).at(at);
        }
    };
    // A lamp is as bright at the same place of a smaller scene if its candela shrink with the area.
    let area = if matches!(kind, Type::Directional) { 1.0 } else { unit * unit };
    let intensity = f64::from(light.intensity) * area;
    let brightest = f64::from(light.intensity * red.max(green).max(blue)) * area;
    let illuminance = match kind {
        Type::Directional => brightest,
        Type::Point | Type::Spot => {
            // For a lamp inside of the scene, assume at least half of the scene's diagonal.
            let radius = (bounds.max - bounds.min).length() * 0.5;
            let distance = (placed.place.point([0.0; 3]) - bounds.center()).length().max(radius);
            brightest / f64::from(distance).powi(2)
        }
    };
    Ok(Lit {
        light,
        intensity,
        kind,
        place: placed.place,
        illuminance,
        name: format!("{}, {}", placed.name(), at()),
    })
}

impl Lit<'_> {
    /// Converts the light; an illuminance of `white`, in lux, becomes 1.
    fn described(&self, white: f64) -> Result<Light, GltfFault> {
        let [red, green, blue] = &self.light.color;
        let measured = (self.intensity / white) as f32;
        let colored = |strength: f32| {
            let share = measured * strength;
            LinearRgb::new(red * share, green * share, blue * share)
        };
        let nothing = GltfFault::Number { meaning: "the length of its direction", found: 0.0 };
        let direction = || self.place.direction([0.0, 0.0, -1.0]).ok_or(nothing);
        let cone = match self.kind {
            Type::Directional => {
                return Ok(Light::Directional { direction: direction()?, color: colored(1.0) });
            }
            Type::Point => None,
            Type::Spot => {
                let Spot { inner_cone_angle: bright, outer_cone_angle: dark } = self.light.spot;
                Some(LightCone { direction: direction()?, bright, dark })
            }
        };
        let brightest = measured * red.max(*green).max(*blue);
        let distance = (brightest / BRIGHTEST).sqrt().clamp(NEAREST, 1e6);
        Ok(Light::Lamp(Lamp {
            position: self.place.point([0.0; 3]),
            color: colored(1.0 / (distance * distance)),
            falloff: Falloff::inverse_square(distance),
            cone,
        }))
    }
}
