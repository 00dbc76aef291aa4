//! Tests of cameras and lights.

use std::fs;

use rayline::{Camera, Light, LinearRgb, Vec3};

use super::*;
use rayline_formats::Exposure;
use rayline_scenes::LoadedScene;

/// The cube with a camera that is moved and turned to the side.
fn seen() -> Value {
    let mut file = cube();
    let half = core::f32::consts::FRAC_1_SQRT_2;
    file["cameras"] = json!([
        { "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9 } },
        {
            "name": "Main",
            "type": "perspective",
            "perspective": { "yfov": 0.75, "aspectRatio": 1.5, "znear": 0.1 },
        },
    ]);
    file["nodes"] = json!([
        { "mesh": 0 },
        { "camera": 0 },
        { "translation": [4, 1, 0], "children": [3, 4] },
        // Turned left by a right angle, from -z to -x.
        { "camera": 1, "rotation": [0, half, 0, half], "scale": [3, 3, 3] },
        { "camera": 1 },
    ]);
    file["scenes"] = json!([{ "nodes": [0, 1, 2] }]);
    file
}

fn near(a: Vec3, b: Vec3) -> bool {
    (a - b).length() < 1e-5
}

#[test]
fn the_first_perspective_camera_takes_the_picture() {
    with_file(&seen(), |import| {
        let Camera { eye, target, up, vertical_fov, .. } = import.scene.camera;
        assert_eq!((eye, vertical_fov), (Vec3::new(4.0, 1.0, 0.0), 0.75));
        // The target is at the distance of the middle of the cube.
        assert!(near(target, Vec3::new(0.0, 1.0, 0.0)) && near(up, Vec3::new(0.0, 1.0, 0.0)));
        assert_eq!(import.resolution, (720, 480));
        assert_eq!(import.name_of(Part::Camera), Some("node 3, camera 1 `Main`"));
    });
    let expected = [
        "model.gltf: node 1, camera 0: left out: it is not perspective",
        "model.gltf: node 4, camera 1 `Main`: left out, as only the first camera is used",
    ];
    assert_eq!(notes(&seen()), expected);
}

#[test]
fn a_scene_that_is_refused_tells_the_part_of_the_file() {
    let explained = |file: &Value| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("model.GLTF");
        fs::write(&path, file.to_string()).unwrap();
        let arena = Bump::new();
        let loaded = LoadedScene::open(&path, &arena).unwrap();
        let error = check(&loaded.scene).unwrap_err();
        loaded.explain(&error).replace(&format!("{}/", folder.path().display()), "")
    };
    let mut file = seen();
    file["cameras"][1]["perspective"]["yfov"] = json!(4);
    let expected = "model.GLTF: node 3, camera 1 `Main`: ";
    assert!(explained(&file).starts_with(expected), "{}", explained(&file));
    let file = lit(
        json!({ "type": "spot", "name": "Spot", "spot": { "innerConeAngle": 1, "outerConeAngle": 0.5 } }),
    );
    let expected = "model.GLTF: node 1 `Lamp`, light 0 `Spot`: ";
    assert!(explained(&file).starts_with(expected), "{}", explained(&file));
}

/// The cube with this light, two units above it, pointing down.
fn lit(light: Value) -> Value {
    let mut file = cube();
    let half = core::f32::consts::FRAC_1_SQRT_2;
    file["extensions"] = json!({ "KHR_lights_punctual": { "lights": [light] } });
    file["nodes"] = json!([
        { "mesh": 0 },
        {
            "name": "Lamp",
            "translation": [0, 2, 0],
            "rotation": [-half, 0, 0, half],
            "extensions": { "KHR_lights_punctual": { "light": 0 } },
        },
    ]);
    file["scenes"] = json!([{ "nodes": [0, 1] }]);
    file
}

/// The light that arrives at a distance below a lamp.
fn arriving(lamp: &rayline::Lamp, distance: f32) -> LinearRgb {
    lamp.color * (1.0 / (lamp.falloff.quadratic * distance * distance))
}

/// Looks at a file that is opened with an exposure of 0.
fn unexposed<T>(file: &Value, look: impl FnOnce(Import<'_>) -> T) -> T {
    let options = OpenOptions { exposure: Some(Exposure::default()), ..OpenOptions::default() };
    with_options("model.gltf", file.to_string().as_bytes(), &options, |import| look(import.unwrap()))
}

#[test]
fn an_exposure_measures_lights_in_the_middle_of_the_scene() {
    let down = Vec3::new(0.0, -1.0, 0.0);
    unexposed(&lit(json!({ "type": "directional", "intensity": 7, "color": [1, 0.5, 0] })), |import| {
        let [Light::Directional { direction, color }] = import.scene.lights else { unreachable!() };
        assert!(near(*direction, down));
        assert_eq!(*color, LinearRgb::new(1.0, 0.5, 0.0));
    });
    for intensity in [0.001, 1.0, 54_351.4] {
        unexposed(&lit(json!({ "type": "point", "intensity": intensity })), |import| {
            let [Light::Lamp(lamp)] = import.scene.lights else { unreachable!() };
            assert_eq!((lamp.position, lamp.cone), (Vec3::new(0.0, 2.0, 0.0), None));
            // White in the middle, a quarter of it at twice the distance, and at most about 16 anywhere.
            assert!((arriving(lamp, 2.0).r - 1.0).abs() < 1e-5);
            assert!((arriving(lamp, 4.0).g - 0.25).abs() < 1e-5);
            assert!((lamp.color.b - 16.0).abs() < 1e-3);
        });
    }
    let angles = json!({ "innerConeAngle": 0.25, "outerConeAngle": 0.5 });
    unexposed(&lit(json!({ "type": "spot", "spot": angles })), |import| {
        let [Light::Lamp(lamp)] = import.scene.lights else { unreachable!() };
        let cone = lamp.cone.unwrap();
        assert!(near(cone.direction, down) && (cone.bright, cone.dark) == (0.25, 0.5));
        assert_eq!(import.name_of(Part::Light(0)), Some("node 1 `Lamp`, light 0"));
    });
    // Illuminances of 3 lux and, by 4 candela, 1 lux: the root of the sum of squares is √10.
    let mut both = lit(json!({ "type": "directional", "intensity": 3 }));
    let lights = both["extensions"]["KHR_lights_punctual"]["lights"].as_array_mut().unwrap();
    lights.push(json!({ "type": "point", "intensity": 4 }));
    both["nodes"].as_array_mut().unwrap().push(json!({
        "translation": [2, 0, 0],
        "extensions": { "KHR_lights_punctual": { "light": 1 } },
    }));
    both["scenes"] = json!([{ "nodes": [0, 1, 2] }]);
    unexposed(&both, |import| {
        let [Light::Directional { color, .. }, Light::Lamp(lamp)] = import.scene.lights else {
            unreachable!()
        };
        assert!((color.r - 3.0 / 10f32.sqrt()).abs() < 1e-5);
        assert!((arriving(lamp, 2.0).r - 1.0 / 10f32.sqrt()).abs() < 1e-5);
    });
}

/// A floor at height 0, of a red color 0.8, with this light two units above it, as is a camera that looks
/// down from the same place. It sees two units to either side and 2.67 to right and left.
fn above_a_floor(light: Value) -> Value {
    let mut file = lit(light);
    file["nodes"][0]["scale"] = json!([80, 0.5, 80]);
    file["nodes"][0]["translation"] = json!([0, -0.25, 0]);
    file["nodes"][1]["camera"] = json!(0);
    let yfov = core::f32::consts::FRAC_PI_2;
    file["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": yfov, "znear": 0.1 } }]);
    file
}

/// The ambient coefficient is a tenth of the diffuse one: 0.9 is 0.08 and 0.8 times the light. Where the
/// camera sees each part of the floor at the distance r from the lamp, in units of its height, it has (1 +
/// r²)^-1.5 of the brightest light.
#[test]
fn lights_are_exposed_for_what_the_camera_sees() {
    let brightest = (0.9 - 0.08) / 0.8;
    with_file(&above_a_floor(json!({ "type": "directional", "intensity": 7 })), |import| {
        let [Light::Directional { color, .. }] = import.scene.lights else { unreachable!() };
        assert!((color.r - brightest).abs() < 1e-4, "{color:?}");
        let told = "model.gltf: exposure: for what the camera sees, the lights are 1.02 times as bright \
                    (+0.0 stops) as for a white middle of the scene; see --exposure";
        assert_eq!(import.notes, [told]);
    });
    // A hundredth of the picture of 4 times 5.33 is a circle with r² = 0.017; of the part that a spot lights,
    // with a radius of tan 0.5, it is one with r² = 0.003.
    let spot = json!({ "innerConeAngle": 0.25, "outerConeAngle": 0.5 });
    for (light, squared) in [
        (json!({ "type": "point", "intensity": 0.001 }), 0.017f32),
        (json!({ "type": "point", "intensity": 54_351.4 }), 0.017),
        (json!({ "type": "spot", "spot": spot }), 0.003),
    ] {
        with_file(&above_a_floor(light.clone()), |import| {
            let [Light::Lamp(lamp)] = import.scene.lights else { unreachable!() };
            let below = arriving(lamp, 2.0).r;
            let expected = brightest * (1.0 + squared).powf(1.5);
            assert!((below / expected - 1.0).abs() < 0.01, "{light}: {below}, not {expected}");
            // The middle of the scene is far away: its light would be white at half of the diagonal, 56.6.
            let note = &import.notes[0];
            assert!(note.contains(" times as bright (-9.6 stops) "), "{note}");
        });
    }
}

/// A floor of 0.05 would be 0.9 by 18.1 times the light of a white middle.
#[test]
fn dark_floors_stay_dark() {
    let mut file = above_a_floor(json!({ "type": "directional" }));
    file["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = json!([0.05, 0, 0, 1]);
    with_file(&file, |import| {
        let [Light::Directional { color, .. }] = import.scene.lights else { unreachable!() };
        assert_eq!(*color, LinearRgb::gray(4.0));
    });
}

#[test]
fn lights_that_reach_nothing_in_the_picture_are_measured_in_the_middle_of_the_scene() {
    let mut file = above_a_floor(json!({ "type": "point", "intensity": 3 }));
    file["nodes"][1]["rotation"] = json!([core::f32::consts::FRAC_1_SQRT_2, 0, 0, 0.707_106_77]);
    let by_the_middle = unexposed(&file, |import| import.scene.lights.to_vec());
    with_file(&file, |import| {
        assert_eq!(import.scene.lights, by_the_middle);
        let told = "model.gltf: exposure: the camera sees nothing that the lights reach; see --exposure";
        assert_eq!(import.notes, [told]);
    });
}

#[test]
fn lights_without_light_are_said() {
    with_file(&lit(json!({ "type": "point", "intensity": 0, "range": 5 })), |import| {
        // The default lights.
        assert_eq!(import.scene.lights, with_file(&cube(), |import| import.scene.lights.to_vec()));
        assert!(matches!(import.scene.lights, [Light::Directional { .. }, Light::Ambient { .. }]));
        assert_eq!(
            import.notes[0],
            "model.gltf: node 1 `Lamp`, light 0: its range is left out: it shines at any distance"
        );
        assert_eq!(import.notes[1], "model.gltf: node 1 `Lamp`, light 0: left out: it has no light");
        assert!(!import.notes.iter().any(|note| note.contains("exposure")));
    });
    let error = refusal(&lit(json!({ "type": "point", "intensity": -1 })));
    assert_eq!(error, "model.gltf: node 1 `Lamp`, light 0: its intensity must not be -1; replace it");
}
