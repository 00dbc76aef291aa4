//! Tests of baked light: images for parts, and irradiance volumes.

#![allow(clippy::unwrap_used)]

use super::*;
use crate::arena::{Arena, Workspace};
use crate::math::{Fixed, Vec3};
use crate::surface::Surface;

const HALF: i16 = 16_384;
/// Dark at x = 1; at x = 3 a half from everywhere, and a half more from above.
const LIGHT: [[i16; 12]; 2] = [[0; 12], [HALF, HALF, HALF, 0, 0, 0, HALF, HALF, HALF, 0, 0, 0]];
const VOLUME: IrradianceVolume = IrradianceVolume { counts: [2, 1, 1], light: &LIGHT };
const PLACEMENT: Placement =
    Placement::in_scene(1.0).stretched(Vec3::new(2.0, 1.0, 1.0)).at(Vec3::new(1.0, 0.0, 0.0));

/// The light of a map of a figure on a surface at x that faces up or down.
fn light<R: Real>(figure: Figure<'_>, placement: Placement, x: f32, up: f32, part: u32) -> Option<f32> {
    let placed = Placed::new(figure, placement);
    let maps = [Map { onto: Onto::AmbientLight { most: 2.0 }, texture: Texture::Placed(&placed) }];
    let mut memory = Workspace::<4096>::new();
    let maps: PreparedMaps<'_, R> =
        Map::prepare_all(&maps, Scale::ONE, &mut Arena::new(memory.lend())).unwrap();
    let normal = Vec3::new(R::ZERO, R::from_f32(up), R::ZERO);
    let point = Vec3::new(R::from_f32(x), R::ZERO, R::ZERO);
    let surface = Surface { point, normal, shading_normal: normal, magnitude: R::ONE, part };
    let at = maps.coefficients(Coefficients::even(R::ONE), &surface, |_| [R::ZERO, R::ZERO]);
    at.ambient_light.map(|light| light.g.to_f32())
}

fn assert_lit<R: Real>() {
    let volume = Figure::IrradianceVolume(VOLUME);
    for (x, up, expected) in [
        (3.0, 1.0, 2.0),
        (3.0, -1.0, 0.0),
        (2.0, 1.0, 1.0),
        (1.5, 1.0, 0.5),
        (1.0, 1.0, 0.0),
        // Beyond the grid.
        (-7.0, 1.0, 0.0),
        (9.0, 1.0, 2.0),
    ] {
        let light = light::<R>(volume, PLACEMENT, x, up, 0).unwrap();
        assert!((light - expected).abs() < 1e-4, "{light}, not {expected}, at {x}");
    }
    let image = |codes: &'static [u8]| {
        let (encoding, filter) = (Encoding::Linear, Filter::Bilinear);
        Image { width: 1, height: 1, pixels: Pixels::Rgb888(codes), encoding, filter, ends: Ends::Extend }
    };
    let images = [image(&[0; 3]), image(&[51; 3]), image(&[255; 3])];
    for (part, expected) in [(0, 0.0), (1, 0.4), (2, 2.0), (7, 2.0)] {
        let light = light::<R>(Figure::Parts(&images), Placement::SURFACE, 0.0, 1.0, part).unwrap();
        assert!((light - expected).abs() < 1e-4, "{light}, not {expected}, on part {part}");
    }
}

#[test]
fn light_is_found_between_points_and_on_parts() {
    assert_lit::<f32>();
    assert_lit::<f64>();
    assert_lit::<Fixed>();
}

#[test]
fn bad_volumes_are_refused() {
    let refusal = |volume: IrradianceVolume<'_>, placement| volume.check(&placement).err();
    assert_eq!(refusal(VOLUME, PLACEMENT), None);
    let counts = [3, 1, 1];
    let fault = Some(Fault::PointCount { needed: 3, given: 2 });
    assert_eq!(refusal(IrradianceVolume { counts, ..VOLUME }, PLACEMENT), fault);
    let none = IrradianceVolume { counts: [0; 3], light: &[] };
    assert_eq!(refusal(none, PLACEMENT), Some(Fault::PointCount { needed: 0, given: 0 }));
    assert_eq!(refusal(VOLUME, Placement::SURFACE), Some(Fault::TurnedVolume));
    let turned = PLACEMENT.turned(Vec3::new(0.0, 1.0, 0.0));
    assert_eq!(refusal(VOLUME, turned), Some(Fault::TurnedVolume));
}
