//! Fixed point: how near its pictures are to `f64`, that they do not depend on the scene's units, and that nothing
//! overflows.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)]

use std::path::Path;

use rayline::builtin;
use rayline::math::Fixed;
use rayline::{Settings, Transfer};
use rayline_tests::{Picture, core_picture};

/// 10 log₁₀(255² / mean square error).
fn psnr(a: &Picture, b: &Picture) -> f64 {
    let squares =
        |a: &[u8; 3], b: &[u8; 3]| (0..3).map(|i| f64::from(a[i].abs_diff(b[i])).powi(2)).sum::<f64>();
    let sum: f64 = a.pixels.iter().zip(&b.pixels).map(|(a, b)| squares(a, b)).sum();
    10.0 * (255.0 * 255.0 * 3.0 * a.pixels.len() as f64 / sum).log10()
}

#[test]
fn pictures_are_near_those_of_f64() {
    println!("scene      fixed dB   f32 dB");
    for scene in &builtin::ALL {
        let settings =
            Settings { bounces: scene.bounces, transfer: Transfer::Linear, ..Settings::new(320, 240) };
        let exact = core_picture::<f64>(scene.scene, settings);
        let fixed = core_picture::<Fixed>(scene.scene, settings);
        let single = core_picture::<f32>(scene.scene, settings);
        fixed.write(&Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}-fixed.png", scene.name)));
        exact.write(&Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}-f64.png", scene.name)));
        let fixed = psnr(&exact, &fixed);
        println!("{:8} {fixed:10.1} {:8.1}", scene.name, psnr(&exact, &single));
        assert!(fixed >= 40.0, "{} has {fixed:.1} dB", scene.name);
    }
}
