//! Tests of exposures in files of scenes.

use bumpalo::Bump;
use rayline::{Background, Lamp, Light, LinearRgb, Pixels};
use rayline_formats::{Exposure, ExposureError};
use rayline_scenes::LoadedScene;

use crate::check;

/// A scene with light of each kind, as RON.
fn text(settings: &str, background: &str, lights: &str) -> String {
    format!(
        "Scene(
        camera: (eye: (0, 0, 6), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 0.7),
        background: {background},
        materials: [(optics: (emission: (0.5, 0, 3))), (ambient: 0.5), (color: Solid(0.5, 0.5, 0.5))],
        objects: [(shape: Sphere(center: (1, 0, 0), radius: 1), material: 0)],
        lights: [{lights}],
        settings: ({settings}),
        )"
    )
}

/// Opens a scene, and gives it and its notes to a function.
fn opened<T>(text: &str, then: impl FnOnce(Result<LoadedScene<'_>, String>) -> T) -> T {
    let (folder, arena) = (tempfile::tempdir().unwrap(), Bump::new());
    let path = folder.path().join("scene.ron");
    std::fs::write(&path, text).unwrap();
    let name = path.display().to_string();
    let scene = LoadedScene::open(&path, &arena).map_err(|error| error.to_string().replace(&name, "scene"));
    then(scene.map(|mut scene| {
        scene.notes.iter_mut().for_each(|note| *note = note.replace(&name, "scene"));
        scene
    }))
}

const LIGHTS: &str = "Point(position: (0, 1, 0), color: (1, 2, 3)), Object(0),
    Directional(direction: (0, -1, 0), color: (0.25, 0.5, 1)),
    Lamp(position: (0, 3, 0), color: (8, 0, 4), falloff: (quadratic: 0.5))";

#[test]
fn each_light_is_multiplied() {
    let sky = "Gradient(zenith: (0.1, 0.2, 0.4), horizon: (1, 2, 3), nadir: (0, 0, 5))";
    opened(&text("exposure: 2", sky, LIGHTS), |scene| {
        let scene = scene.unwrap();
        assert!(scene.notes.is_empty(), "{:?}", scene.notes);
        let Background::Gradient(sky) = scene.scene.background else { panic!() };
        let colors = [sky.zenith, sky.horizon, sky.nadir].map(LinearRgb::channels);
        assert_eq!(colors, [[0.4, 0.8, 1.6], [4.0, 8.0, 12.0], [0.0, 0.0, 20.0]]);
        let colors = scene.scene.lights.iter().map(|light| match *light {
            Light::Point { color, .. } => color.channels(),
            Light::Directional { color, .. } => color.channels(),
            Light::Ambient { color } => color.channels(),
            Light::Lamp(Lamp { color, falloff, .. }) => {
                assert_eq!(falloff.quadratic, 0.5);
                color.channels()
            }
            _ => [0.0; 3],
        });
        // The white ambient light of the scene, which has none of its own, is the last.
        let expected = [[4.0, 8.0, 12.0], [0.0; 3], [1.0, 2.0, 4.0], [32.0, 0.0, 16.0], [4.0, 4.0, 4.0]];
        assert_eq!(colors.collect::<Vec<_>>(), expected);
        let [glowing, ambient, plain] = scene.scene.materials else { panic!() };
        assert_eq!(glowing.optics.unwrap().emission, LinearRgb::new(2.0, 0.0, 12.0));
        // Coefficients are no light.
        assert_eq!((ambient.ambient, plain.optics), (0.5, None));
    });
    opened(&text("exposure: -1", "Solid(1, 3, 0)", "Ambient(color: (1, 2, 0))"), |scene| {
        let scene = scene.unwrap().scene;
        assert_eq!(scene.background, Background::Solid(LinearRgb::new(0.5, 1.5, 0.0)));
        assert_eq!(scene.lights, [Light::Ambient { color: LinearRgb::new(0.5, 1.0, 0.0) }]);
    });
}

#[test]
fn light_ends_at_the_limit_with_a_note() {
    opened(&text("exposure: 20", "Solid(0.5, 0, 2)", "Ambient(color: (0, 1, 0.25))"), |scene| {
        let scene = scene.unwrap();
        assert_eq!(scene.scene.background, Background::Solid(LinearRgb::new(524_288.0, 0.0, 1e6)));
        let ambient = Light::Ambient { color: LinearRgb::new(0.0, 1e6, 262_144.0) };
        assert_eq!(scene.scene.lights, [ambient]);
        let told = "scene: exposure: a color of light ends at 1000000, which is the limit";
        assert_eq!(scene.notes, [told]);
        assert!(check(&scene.scene).is_ok());
    });
    // A scene that is refused without an exposure is refused with one.
    for color in ["-1", "2e6", "NaN"] {
        opened(&text("exposure: -9", &format!("Solid(0, {color}, 0)"), ""), |scene| {
            assert!(check(&scene.unwrap().scene).is_err() == (color != "2e6"), "{color}");
        });
    }
}

/// Code 128 of sRGB is light of 0.2159; half of it is code 92.
#[test]
fn panoramas_are_multiplied_up_to_white() {
    let codes = |stops: i32, pixels: &str, encoding: &str| {
        let image = format!("(width: 2, height: 1, pixels: {pixels}, encoding: {encoding})");
        let scene = text(&format!("exposure: {stops}"), &format!("Image(image: {image})"), "");
        opened(&scene, |scene| {
            let scene = scene.unwrap();
            let Background::Image(panorama) = scene.scene.background else { panic!() };
            let codes = match panorama.image.pixels {
                Pixels::Rgb888(bytes) => bytes.to_vec(),
                Pixels::Palette8 { palette, .. } | Pixels::Palette4 { palette, .. } => palette.concat(),
                Pixels::Rgb565(_) => panic!(),
            };
            (codes, scene.notes)
        })
    };
    let told = "scene: exposure: the panorama has no light above white, and ends there".to_owned();
    let rgb = "Rgb888([128, 0, 255, 10, 128, 1])";
    assert_eq!(codes(-1, rgb, "Srgb"), (vec![92, 0, 188, 5, 92, 1], vec![]));
    assert_eq!(codes(-1, rgb, "Linear"), (vec![64, 0, 128, 5, 64, 1], vec![]));
    assert_eq!(codes(1, rgb, "Linear"), (vec![255, 0, 255, 20, 255, 2], vec![told.clone()]));
    let palette = "Palette8(indices: [0, 1], palette: [(128, 0, 255), (10, 0, 0)])";
    assert_eq!(codes(-1, palette, "Srgb").0, [92, 0, 188, 5, 0, 0]);
    let small = "Palette4(indices: [1], palette: [(128, 0, 255), (10, 0, 0)])";
    assert_eq!(codes(-1, small, "Srgb").0, [92, 0, 188, 5, 0, 0]);
    // 31, 0, 0 and 0, 32, 16 of 31 and 63.
    assert_eq!(codes(-1, "Rgb565([63488, 1040])", "Linear").0, [128, 0, 0, 0, 65, 66]);
}

#[test]
fn other_numbers_of_stops_are_refused() {
    for stops in ["20.1", "-21", "NaN", "inf"] {
        let said =
            opened(&text(&format!("exposure: {stops}"), "Solid(0, 0, 0)", ""), |scene| scene.unwrap_err());
        let limit = "an exposure is a number of stops from -20 to 20, such as 1.5; correct it";
        assert!(said.starts_with("scene:7:") && said.ends_with(limit), "{said}");
        assert_eq!(stops.parse::<Exposure>(), Err(ExposureError));
    }
    for stops in ["20", "-20", "0.5"] {
        assert_eq!(stops.parse::<Exposure>().map(Exposure::stops).ok(), stops.parse().ok());
    }
    assert_eq!("x".parse::<Exposure>(), Err(ExposureError));
}
