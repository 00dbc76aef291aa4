//! Smooth edges in realtime quality, against pictures of 64 samples.

use bumpalo::Bump;
use rayline::builtin::{CLASSIC, FLAKE, PRISM, WHITTED};
use rayline::math::Fixed;
use rayline::shape::{Plane, Shape, Sphere};
use rayline::{
    Adaptive, Background, Camera, Light, LinearRgb, Material, Object, RayCounts, Real, Realtime, Sampling,
    Scene, Settings, Vec3,
};
use rayline_tests::Picture;

use super::realtime::{exact, gallery, psnr, realtime, with_renderer};

/// The picture of a scene with this many samples: exactly, or in this quality; and its rays a pixel.
fn picture<R: Real>(scene: &Scene, sampling: Sampling, quality: Option<Realtime>) -> (Picture, f64) {
    let settings = Settings { sampling, ..Settings::new(320, 240) };
    let mut rays = RayCounts::default();
    let picture = with_renderer::<R, _>(scene, settings, |renderer| match quality {
        Some(quality) => realtime(renderer, quality, &mut rays),
        None => exact(renderer, &mut rays),
    });
    let share = rays.total() as f64 / picture.pixels.len() as f64;
    (picture, share)
}

/// Two balls before the horizon of a plane, under two lights.
fn with_balls<T>(use_it: impl FnOnce(&Scene) -> T) -> T {
    let gray = |share| Material::matte(LinearRgb::gray(share));
    let ball = |x, y, z, radius| Shape::Sphere(Sphere::new(Vec3::new(x, y, z), radius));
    use_it(&Scene {
        camera: Camera {
            eye: Vec3::new(0.0, 2.0, 6.0),
            target: Vec3::new(0.0, 0.75, 0.0),
            up: Vec3::new(0.0, 1.0, 0.0),
            vertical_fov: 0.7,
            lens: None,
        },
        background: Background::gray(0.0),
        objects: &[
            Object::new(Shape::Plane(Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0))), 0),
            Object::new(ball(-0.8, 1.0, 0.0, 1.0), 1),
            Object::new(ball(1.1, 0.6, 1.0, 0.6), 2),
        ],
        materials: &[gray(0.9), gray(0.3), gray(0.6)],
        lights: &[
            Light::Point { position: Vec3::new(-4.0, 5.0, 3.0), color: LinearRgb::gray(0.6) },
            Light::Directional { direction: Vec3::new(-1.0, -2.0, -0.5), color: LinearRgb::gray(0.4) },
        ],
        motions: &[],
    })
}

/// The mean error of the pixels at edges: those that one sample shows at least 8 levels too dark or too
/// bright.
fn error_at_edges(picture: &Picture, one_sample: &Picture, reference: &Picture) -> f64 {
    let pixels = || picture.pixels.iter().zip(&one_sample.pixels).zip(&reference.pixels);
    let apart = |a: &[u8; 3], b: &[u8; 3]| f64::from(a[1].abs_diff(b[1]));
    let errors: Vec<f64> = pixels()
        .filter(|((_, one), reference)| apart(one, reference) >= 8.0)
        .map(|((pixel, _), reference)| apart(pixel, reference))
        .collect();
    assert!(errors.len() > 500, "{} pixels at edges", errors.len());
    errors.iter().sum::<f64>() / errors.len() as f64
}

fn assert_outlines_are_covered<R: Real>(reference: &Picture) {
    with_balls(|scene| {
        let (one, _) = picture::<R>(scene, Sampling::CENTER, None);
        let (smooth, rays) = picture::<R>(scene, Sampling::CENTER, Some(Realtime::fine().smooth()));
        let (before, after) =
            (error_at_edges(&one, &one, reference), error_at_edges(&smooth, &one, reference));
        println!(
            "edges of balls, shadows and a horizon: {before:.1} levels off by one sample, {after:.1} smooth, {rays:.2} rays"
        );
        assert!(after * 8.0 < before, "{after}, {before}");
        assert!(psnr(&smooth, reference) > 46.0, "{} dB", psnr(&smooth, reference));
    });
}

#[test]
fn outlines_and_shadows_of_balls_have_their_coverage() {
    let (reference, _) = with_balls(|scene| picture::<f64>(scene, Sampling::new(64), None));
    assert_outlines_are_covered::<f32>(&reference);
    assert_outlines_are_covered::<f64>(&reference);
    assert_outlines_are_covered::<Fixed>(&reference);
}

/// The table in the documentation of `Edges::Smooth`.
#[test]
fn smooth_edges_are_closer_to_many_samples_for_as_many_rays() {
    println!("scene    | stepped dB | smooth dB | rays, stepped | rays, smooth | 16 samples dB | rays");
    // The gain by smooth edges, the gain of samples beyond it, and the share of all rays that they take.
    for (name, scene, gain, more_gain, most_rays) in [
        ("classic", &CLASSIC, 5.5, 3.0, 0.7),
        ("whitted", &WHITTED, 5.0, 4.0, 0.85),
        ("flake", &FLAKE, 2.5, 4.0, 1.0),
        ("prism", &PRISM, 1.5, 4.0, 1.0),
    ] {
        let (reference, _) = picture::<f32>(scene, Sampling::new(64), None);
        let one = Sampling::CENTER;
        let (stepped, few) = picture::<f32>(scene, one, Some(Realtime::new()));
        let (smooth, also_few) = picture::<f32>(scene, one, Some(Realtime::new().smooth()));
        let adaptive = Sampling { adaptive: Some(Adaptive::NEW), ..Sampling::new(16) };
        let (sampled, more) = picture::<f32>(scene, adaptive, Some(Realtime::new().smooth()));
        let (_, all) = picture::<f32>(scene, Sampling::new(16), None);
        let close = [&stepped, &smooth, &sampled].map(|picture| psnr(picture, &reference));
        println!(
            "{name:8} | {:.1} | {:.1} | {few:.2} | {also_few:.2} | {:.1} | {more:.2}",
            close[0], close[1], close[2]
        );
        assert!(close[1] > close[0] + gain, "{name}: {close:?} dB");
        assert!(also_few < few * 1.03, "{name}: {also_few} rays, {few}");
        assert!(close[2] > close[1] + more_gain, "{name}: {close:?} dB");
        assert!(more < all * most_rays, "{name}: {more} rays, {all}");
    }
}

/// Where all rays draw numbers, all points take all samples.
#[test]
fn soft_shadows_have_their_samples() {
    let arena = Bump::new();
    let scene = gallery("light-area", &arena);
    let (reference, all) = picture::<f32>(&scene.scene, Sampling::new(64), None);
    let (smooth, rays) = picture::<f32>(&scene.scene, Sampling::new(64), Some(Realtime::fine().smooth()));
    println!("light-area: {:.1} dB, {rays:.0} of {all:.0} rays", psnr(&smooth, &reference));
    assert!(psnr(&smooth, &reference) > 36.0 && rays < all);
}
