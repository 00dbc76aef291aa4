//! Error bounds of functions that every processor has, against `f64`.

use super::{TOWARD_LIGHT_ERROR, toward_light};
use crate::math::fixed::tests::{Random, dot, length};

fn bits(vector: [f64; 3]) -> [i32; 3] {
    vector.map(|number| (number * 16_777_216.0) as i32)
}

#[test]
fn directions_to_lights_keep_their_bounds() {
    let mut random = Random(1);
    let (mut astray, mut off_length, mut off_unit, mut off_cosine) = (0f64, 0f64, 0f64, 0f64);
    for i in 0..1_000_000 {
        let (near, normal) = (random.place(), random.unit());
        // From 2⁻¹⁰ to 2⁶.
        let way = near.map(|number| number * 2f64.powi(i % 17 - 10));
        let way_bits = bits(way);
        let way = way_bits.map(|number| f64::from(number) / 16_777_216.0);
        let exact = dot(way, normal) / length(way);
        let found = toward_light(way_bits, bits(normal));
        assert!(found.is_some() || exact < 1e-4, "{way:?} {normal:?}");
        let Some((unit, distance, cosine)) = found else { continue };
        let [unit, [distance, cosine, _]] =
            [unit, [distance, cosine, 0]].map(|bits| bits.map(|number| f64::from(number) / 16_777_216.0));
        let along = dot(unit, way) / length(way);
        let across = [0, 1, 2].map(|axis| unit[axis] - way[axis] / length(way) * along);
        astray = astray.max(length(across) / along);
        off_unit = off_unit.max((length(unit) - 1.0).abs());
        // Of short ways two units of 2⁻²⁴ are more.
        off_length = off_length.max(((distance - length(way)).abs() - 2f64.powi(-23)) / length(way));
        let units = 2f64.powi(-23) / length(way);
        off_cosine = off_cosine.max((cosine - exact).abs() - exact * 2f64.powi(-12) - units);
    }
    println!("2^{} 2^{} 2^{}", astray.log2(), off_length.log2(), off_unit.log2());
    assert!(astray < f64::from(TOWARD_LIGHT_ERROR), "2^{}", astray.log2());
    assert!(off_unit < 2f64.powi(-22), "2^{}", off_unit.log2());
    assert!(off_length < 2f64.powi(-12), "2^{}", off_length.log2());
    assert!(off_cosine < 2f64.powi(-13), "2^{}", off_cosine.log2());
    // A light that is above the surface by no digit that counts.
    let grazing = toward_light([0, 0x7FFF, i32::MIN], [0, 1 << 24, 0]);
    assert_eq!(grazing.map(|(_, _, cosine)| cosine), Some(0));
    // Vectors of length 0, of a few units, and with the largest coordinate.
    assert_eq!(toward_light([0; 3], [1 << 24, 0, 0]), None);
    assert!(toward_light([-1; 3], [-1 << 24, 0, 0]).is_some());
    let (unit, distance, cosine) = toward_light([i32::MAX, 0, 0], [1 << 24, 0, 0]).unwrap();
    assert!(unit[0] > (1 << 24) - 256 && distance > i32::MAX - (1 << 19) && cosine > (1 << 24) - 2048);
}
