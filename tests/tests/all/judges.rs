//! Outside judges of distributed ray tracing: pictures by Mitsuba 3, which stand in `tests/judges` with the
//! script that makes them, and lamps by POV-Ray.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::Command;

use bumpalo::Bump;
use rayline::math::Fixed;
use rayline::shape::{Rectangle, Shape};
use rayline::{AreaLights, LinearRgb, Sampler, Sampling, Scene, Settings, Transfer, Vec3};
use rayline_simulator::{LightOptions, LoadedScene, bake_light};
use rayline_tests::{PovrayPicture, core_picture};

use super::distributed::lights;

/// The size of the pictures.
const WIDTH: u32 = 64;
const HEIGHT: u32 = 48;
/// The light of the largest code, as in the script.
const WHITE: f32 = 4.0;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("judges")
}

fn opened<'a>(name: &str, arena: &'a Bump) -> LoadedScene<'a> {
    let loaded = LoadedScene::open(&folder().join(name).with_extension("ron"), arena);
    loaded.unwrap_or_else(|error| panic!("{error}"))
}

/// Mitsuba's picture of a scene, in linear light.
fn reference(name: &str) -> Vec<LinearRgb> {
    let file = File::open(folder().join(name).with_extension("png")).expect("a picture");
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info().expect("a PNG file");
    let mut bytes = vec![0; reader.output_buffer_size()];
    let info = reader.next_frame(&mut bytes).expect("a whole picture");
    assert_eq!((info.width, info.height, info.bit_depth), (WIDTH, HEIGHT, png::BitDepth::Sixteen));
    let light = |code: &[u8; 2]| f32::from(u16::from_be_bytes(*code)) / 65535.0 * WHITE;
    let codes = bytes.as_chunks::<2>().0;
    let pixels = codes.as_chunks::<3>().0.iter();
    pixels.map(|[r, g, b]| LinearRgb::new(light(r), light(g), light(b))).collect()
}

/// The mean difference of a picture from a reference, as a share of the reference's mean light.
fn mean_error(picture: &[LinearRgb], reference: &[LinearRgb]) -> f64 {
    let channels = |light: &[LinearRgb]| -> Vec<f64> {
        light.iter().flat_map(|light| light.channels()).map(|light| f64::from(light.min(WHITE))).collect()
    };
    let (found, expected) = (channels(picture), channels(reference));
    let apart: f64 = found.iter().zip(&expected).map(|(found, expected)| (found - expected).abs()).sum();
    apart / expected.iter().sum::<f64>()
}

#[test]
fn lenses_lamps_and_gloss_are_as_in_mitsuba() {
    for (name, closed_form) in [
        ("lens", None),
        ("rectangle", Some(0.02)),
        ("disc", Some(0.02)),
        ("ball", Some(0.02)),
        ("rough", None),
    ] {
        let arena = Bump::new();
        let LoadedScene { scene, settings, .. } = opened(name, &arena);
        let reference = reference(name);
        let settings = Settings { width: WIDTH, height: HEIGHT, cutoff: 0.0, ..settings };
        let error = |area_lights| {
            mean_error(&lights::<f32>(&scene, Settings { area_lights, ..settings }, true), &reference)
        };
        let sampled = error(AreaLights::Sampled);
        print!("{name}: {:.2} % from Mitsuba", 100.0 * sampled);
        assert!(sampled < 0.02, "{name}: {sampled}");
        if let Some(most) = closed_form {
            let closed = error(AreaLights::ClosedForm);
            print!(", {:.2} % in closed form", 100.0 * closed);
            assert!(closed < most, "{name}, closed form: {closed}");
        }
        println!();
    }
}

/// The Cornell box, and the light that a glass ball gathers, against Mitsuba's integrator `path`.
#[test]
fn paths_are_as_in_mitsuba() {
    for name in ["cornell", "caustic"] {
        let arena = Bump::new();
        let LoadedScene { scene, settings, .. } = opened(name, &arena);
        let settings = Settings { width: WIDTH, height: HEIGHT, ..settings };
        let picture = lights::<f32>(&scene, settings, true);
        let error = mean_error(&picture, &reference(name));
        println!("{name}: {:.2} % from Mitsuba", 100.0 * error);
        assert!(error < 0.02, "{name}: {error}");
    }
}

/// The Cornell box with baked light: all of it, or only the light that surfaces scatter.
#[test]
fn baked_light_is_as_in_mitsuba() {
    for (keep_lamps, most) in [(false, 0.03), (true, 0.03)] {
        let arena = Bump::new();
        let LoadedScene { scene, .. } = opened("cornell", &arena);
        let options = LightOptions { keep_lamps, budget: 24 << 10, ..LightOptions::default() };
        let baked = bake_light(&scene, &options, &arena, &|_, _| ()).expect("a scene that holds light");
        let sampling = Sampling { sampler: Sampler::Sobol, ..Sampling::new(64) };
        let settings = Settings { sampling, rays_per_pixel: 2000, ..Settings::new(WIDTH, HEIGHT) };
        for (number, picture) in [
            ("f32", lights::<f32>(&baked.scene, settings, true)),
            ("fixed", lights::<Fixed>(&baked.scene, settings, true)),
        ] {
            let error = mean_error(&picture, &reference("cornell"));
            println!("cornell, {number}, keep_lamps {keep_lamps}: {:.2} % from Mitsuba", 100.0 * error);
            assert!(error < most, "{number}, keep_lamps {keep_lamps}: {error}");
        }
    }
}

/// The light that a glass ball gathers, in a texture of the floor, against paths by Mitsuba. The floor there
/// has no end, and its far parts and the red ball have little of the light.
#[test]
fn baked_caustics_are_as_in_mitsuba() {
    let arena = Bump::new();
    let LoadedScene { scene, .. } = opened("caustic", &arena);
    let corner = Vec3::new(-6.0, 0.0, -8.0);
    let (right, up) = (Vec3::new(0.0, 0.0, 12.0), Vec3::new(12.0, 0.0, 0.0));
    let floor = Shape::Rectangle(Rectangle { corner, right, up });
    let mut objects = scene.objects.to_vec();
    objects[0].shape = floor;
    let scene = Scene { objects: &objects, ..scene };
    let options = LightOptions { budget: 200_000, ..LightOptions::default() };
    let baked = bake_light(&scene, &options, &arena, &|_, _| ()).expect("a scene that holds light");
    let sampling = Sampling { sampler: Sampler::Sobol, ..Sampling::new(64) };
    let settings = Settings { sampling, rays_per_pixel: 2000, bounces: 6, ..Settings::new(WIDTH, HEIGHT) };
    let error = mean_error(&lights::<f32>(&baked.scene, settings, true), &reference("caustic"));
    println!("caustic, baked: {:.2} % from Mitsuba", 100.0 * error);
    assert!(error < 0.05, "{error}");
}

/// The caustic of a glass ball below a lamp without a size, against POV-Ray's photons.
#[test]
fn baked_caustics_are_as_in_povray() {
    let arena = Bump::new();
    let LoadedScene { scene, settings, .. } = opened("photons", &arena);
    let settings = Settings { width: 160, height: 120, transfer: Transfer::Linear, ..settings };
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("povray-photons");
    let with_photons = |source: String| {
        let head = "global_settings { photons { count 300000 } ";
        let glass = "interior { ior 1.5 } photons { target reflection on refraction on }";
        assert!(source.contains("global_settings { ") && source.contains("interior { ior 1.5 }"));
        source.replace("global_settings { ", head).replace("interior { ior 1.5 }", glass)
    };
    let place = (directory.as_path(), "photons");
    let Some(povray) = PovrayPicture::render_changed(&scene, settings, place, with_photons) else { return };
    let options = LightOptions { budget: 200_000, ..LightOptions::default() };
    let baked = bake_light(&scene, &options, &arena, &|_, _| ()).expect("a scene that holds light");
    let ours = core_picture::<f32>(&baked.scene, settings);
    let (ours, theirs) = (to_light(&ours.pixels), to_light(&povray.picture.pixels));
    let light = |picture: &[LinearRgb]| picture.iter().map(|light| f64::from(light.g)).sum::<f64>();
    let (error, share) = (mean_error(&ours, &theirs), light(&ours) / light(&theirs));
    println!("photons: {:.2} % from POV-Ray, with {share:.4} of its light", 100.0 * error);
    assert!(error < 0.04 && (share - 1.0).abs() < 0.025, "{error}, {share}");
}

/// The linear light of a picture in 8 bits.
fn to_light(picture: &[[u8; 3]]) -> Vec<LinearRgb> {
    let light = |rgb: &[u8; 3]| {
        let [r, g, b] = rgb.map(|code| f32::from(code) / 255.0);
        LinearRgb::new(r, g, b)
    };
    picture.iter().map(light).collect()
}

/// POV-Ray's `area_light`, with `adaptive` and `jitter`.
#[test]
fn ball_lamps_are_as_in_povray() {
    let arena = Bump::new();
    let LoadedScene { scene, settings, .. } = opened("ball", &arena);
    let size = Settings { width: WIDTH, height: HEIGHT, ..settings };
    // POV-Ray takes one sample of each pixel.
    let sampling = Sampling { samples: 1, ..settings.sampling };
    let settings = Settings { transfer: Transfer::Linear, cutoff: 0.0, sampling, ..size };
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("povray-lamp");
    let Some(povray) = PovrayPicture::render(&scene, settings, &directory, "ball") else { return };
    let ours = core_picture::<f32>(&scene, settings);
    let error = mean_error(&to_light(&ours.pixels), &to_light(&povray.picture.pixels));
    println!("ball: {:.2} % from POV-Ray", 100.0 * error);
    assert!(error < 0.02, "{error}");
}

/// The pictures are what the script makes, if Mitsuba is installed. `RAYLINE_PYTHON` names another Python.
#[test]
fn references_are_what_mitsuba_draws() {
    let python = std::env::var("RAYLINE_PYTHON").unwrap_or_else(|_| "python3".into());
    let has_mitsuba = Command::new(&python).args(["-c", "import mitsuba"]).output();
    if !has_mitsuba.is_ok_and(|output| output.status.success()) {
        println!("Mitsuba is not installed: its pictures are not made again");
        return;
    }
    let script = folder().join("make_references.py");
    let output = Command::new(&python).arg(script).arg("--check").output().expect("the script runs");
    println!("{}", String::from_utf8_lossy(&output.stdout));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
