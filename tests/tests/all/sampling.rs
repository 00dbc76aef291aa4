//! Tests of samples: how fast they converge, that they draw the same bytes in any order, and what adaptive
//! sampling leaves out.

use std::mem::MaybeUninit;

use rayline::builtin::{CLASSIC, WHITTED};
use rayline::math::Fixed;
use rayline::{
    Adaptive, Background, LinearRgb, PreparedScene, RayCounts, Real, Reconstruction, Renderer, Sampler,
    Sampling, Scene, Settings, SettingsError, Transfer,
};
use rayline_simulator::{Convergence, Number, Picture, RenderOptions, render};
use rayline_tests::Watch;

const SAMPLERS: [Sampler; 6] =
    [Sampler::R2, Sampler::Grid, Sampler::Random, Sampler::Jittered, Sampler::Poisson, Sampler::Sobol];

/// A renderer's light of all pixels, with the numbers of rays.
fn lights<R: Real>(scene: &Scene, settings: Settings) -> (Vec<LinearRgb>, RayCounts) {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R>::new(scene, &mut memory).expect("a legal scene");
    let renderer = Renderer::new(&prepared, settings).expect("legal settings");
    let mut rays = RayCounts::default();
    let pixels = (0..renderer.height()).flat_map(|y| (0..renderer.width()).map(move |x| (x, y)));
    let lights =
        pixels.map(|(x, y)| renderer.pixel(x as u16, y as u16, &mut Watch(&mut rays)).0.to_f32()).collect();
    (lights, rays)
}

/// The root mean square difference of two pictures.
fn apart(a: &[LinearRgb], b: &[LinearRgb]) -> f64 {
    let square = |(a, b): (&LinearRgb, &LinearRgb)| {
        let differences = a.channels().into_iter().zip(b.channels());
        differences.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>() / 3.0
    };
    (a.iter().zip(b).map(square).sum::<f64>() / a.len() as f64).sqrt()
}

/// Independent samples converge with the square root of their number; all others faster. Edges limit the
/// gain: in two dimensions to a power of -3/4 (Mitchell, "Consequences of Stratified Sampling in Graphics",
/// 1996).
#[test]
fn errors_fall_with_samples_as_each_sampler_promises() {
    let settings = Settings { bounces: 2, ..Settings::new(32, 24) };
    let measured = Convergence::measure(&CLASSIC, settings).unwrap();
    println!("{}", measured.table());
    let error = |sampler| measured.errors.iter().find(|(other, _)| *other == sampler).unwrap().1;
    let slope = |sampler| measured.slope(sampler);
    assert!((slope(Sampler::Random) + 0.5).abs() < 0.05, "{}", slope(Sampler::Random));
    for sampler in SAMPLERS.into_iter().filter(|sampler| *sampler != Sampler::Random) {
        assert!(slope(sampler) < -0.6, "{sampler:?}: {}", slope(sampler));
        let [_, four, sixteen, .., most] = error(sampler);
        let [_, random_four, random_sixteen, .., random_most] = error(Sampler::Random);
        assert!(four < random_four && sixteen < 0.9 * random_sixteen && most < 0.6 * random_most);
    }
    // The plot has a curve for each.
    assert_eq!(measured.plot().matches("<polyline").count(), SAMPLERS.len());
}

/// Pictures do not depend on the order of lines, on threads, or on whether a pixel is asked for alone.
#[test]
fn samples_do_not_depend_on_order() {
    for sampler in SAMPLERS {
        for (filter, adaptive) in
            [(Reconstruction::Box, None), (Reconstruction::Gaussian, Some(Adaptive::NEW))]
        {
            let sampling = Sampling { sampler, filter, adaptive, seed: 5, ..Sampling::new(9) };
            let settings = Settings { sampling, bounces: 2, ..Settings::new(40, 30) };
            let options = RenderOptions { number: Number::Fixed, threads: 1, ..RenderOptions::new(settings) };
            let whole = render(&CLASSIC, &options).unwrap();
            for threads in [2, 5] {
                let again = render(&CLASSIC, &RenderOptions { threads, ..options.clone() }).unwrap();
                assert!(again.rgb == whole.rgb, "{sampler:?}, {threads} threads");
            }
            let part = RenderOptions { lines: Some(11..19), ..options };
            let part = render(&CLASSIC, &part).unwrap();
            assert!(part.rgb == whole.rgb[11 * 120..19 * 120], "{sampler:?}");
        }
    }
}

/// Adaptive sampling takes far fewer rays, and misses little of what all samples show.
#[test]
fn adaptive_samples_show_nearly_the_same_with_fewer_rays() {
    for (name, scene) in [("classic", &CLASSIC), ("whitted", &WHITTED)] {
        let settings = |adaptive| {
            let sampling = Sampling { sampler: Sampler::Sobol, adaptive, ..Sampling::new(64) };
            Settings { sampling, bounces: 3, ..Settings::new(80, 60) }
        };
        let (all, all_rays) = lights::<f32>(scene, settings(None));
        let (few, few_rays) = lights::<f32>(scene, settings(Some(Adaptive::NEW)));
        let (plain, _) = lights::<f32>(scene, Settings { sampling: Sampling::new(4), ..settings(None) });
        let share = few_rays.camera as f64 / all_rays.camera as f64;
        let (lost, before) = (apart(&few, &all), apart(&plain, &all));
        println!("{name}: {share:.3} of the rays, off by {lost:.4}; with 4 samples {before:.4}");
        // Four samples miss what covers less than a quarter of a pixel.
        assert!(share < 0.3 && lost < 0.6 * before, "{name}");
        // Fixed point decides nearly alike.
        let (fixed, _) = lights::<Fixed>(scene, settings(Some(Adaptive::NEW)));
        assert!(apart(&fixed, &few) < 0.01, "{name}: {}", apart(&fixed, &few));
    }
}

/// A pixel in which everything agrees takes the first samples alone, and its mean is as bright.
#[test]
fn the_mean_of_few_samples_is_as_bright_as_that_of_all() {
    let gray = Scene { background: Background::gray(0.75), objects: &[], ..CLASSIC };
    for (samples, at_first) in [(64, 4), (1000, 3), (5, 5), (2, 2)] {
        let adaptive = Some(Adaptive { at_first, ..Adaptive::NEW });
        let sampling = Sampling { adaptive, ..Sampling::new(samples) };
        let settings = Settings { sampling, ..Settings::new(4, 4) };
        for (found, rays) in [lights::<f32>(&gray, settings), lights::<Fixed>(&gray, settings)] {
            assert_eq!(rays.camera, 16 * u64::from(at_first));
            assert!(found.iter().all(|light| (light.g - 0.75).abs() < 1e-4), "{:?}", found[0]);
        }
    }
}

/// A wide filter blurs, and keeps the light of the picture.
#[test]
fn filters_blur_and_keep_the_light() {
    let of = |filter| {
        let sampling = Sampling { sampler: Sampler::Sobol, filter, ..Sampling::new(64) };
        let options = RenderOptions::new(Settings {
            sampling,
            transfer: Transfer::Linear,
            bounces: 1,
            ..Settings::new(64, 48)
        });
        render(&WHITTED, &options).unwrap()
    };
    let mean = |picture: &Picture| {
        picture.rgb.iter().map(|level| f64::from(*level)).sum::<f64>() / picture.rgb.len() as f64
    };
    // The mean square difference of neighbors: how sharp a picture is.
    let sharpness = |picture: &Picture| {
        let pairs = picture.rgb.iter().zip(&picture.rgb[3..]);
        pairs.map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2)).sum::<f64>()
    };
    let [box_, tent, gaussian] =
        [Reconstruction::Box, Reconstruction::Tent, Reconstruction::Gaussian].map(of);
    for picture in [&tent, &gaussian] {
        assert!((mean(picture) - mean(&box_)).abs() < 0.01 * mean(&box_));
    }
    assert!(sharpness(&tent) < 0.8 * sharpness(&box_));
    assert!(sharpness(&gaussian) < 0.9 * sharpness(&tent));
}

#[test]
fn bad_sampling_is_refused() {
    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()];
    let prepared = PreparedScene::<f32, _>::new(&CLASSIC, &mut memory).unwrap();
    let refused = |sampling, rays_per_pixel| {
        let settings = Settings { sampling, rays_per_pixel, ..Settings::new(8, 8) };
        Renderer::new(&prepared, settings).err()
    };
    assert_eq!(refused(Sampling::new(0), 64), Some(SettingsError::Samples));
    assert_eq!(refused(Sampling::new(64), 64), None);
    let beyond = SettingsError::SamplesBeyondRays { samples: 65, rays: 64 };
    assert_eq!(refused(Sampling::new(65), 64), Some(beyond));
    let adaptive = |at_first, contrast| Sampling {
        adaptive: Some(Adaptive { at_first, contrast }),
        ..Sampling::new(16)
    };
    assert_eq!(refused(adaptive(2, 0.0), 64), None);
    for at_first in [0, 1, 17] {
        let error = SettingsError::AtFirst { given: at_first, samples: 16 };
        assert_eq!(refused(adaptive(at_first, 0.3), 64), Some(error));
    }
    for contrast in [-0.1, 1.1, f32::NAN, f32::INFINITY] {
        assert_eq!(refused(adaptive(4, contrast), 64), Some(SettingsError::Contrast));
    }
}
