//! Tests of cameras and lights.

use rayline::{Camera, Light, LinearRgb, Vec3};

use super::*;
use crate::{LoadedScene, check};

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

#[test]
fn lights_are_brought_to_one_measure() {
    let down = Vec3::new(0.0, -1.0, 0.0);
    with_file(&lit(json!({ "type": "directional", "intensity": 7, "color": [1, 0.5, 0] })), |import| {
        let [Light::Directional { direction, color }] = import.scene.lights else { unreachable!() };
        assert!(near(*direction, down));
        assert_eq!(*color, LinearRgb::new(1.0, 0.5, 0.0));
    });
    for intensity in [0.001, 1.0, 54_351.4] {
        with_file(&lit(json!({ "type": "point", "intensity": intensity })), |import| {
            let [Light::Lamp(lamp)] = import.scene.lights else { unreachable!() };
            assert_eq!((lamp.position, lamp.cone), (Vec3::new(0.0, 2.0, 0.0), None));
            // White in the middle, a quarter of it at twice the distance, and at most about 16 anywhere.
            assert!((arriving(lamp, 2.0).r - 1.0).abs() < 1e-5);
            assert!((arriving(lamp, 4.0).g - 0.25).abs() < 1e-5);
            assert!((lamp.color.b - 16.0).abs() < 1e-3);
        });
    }
    let angles = json!({ "innerConeAngle": 0.25, "outerConeAngle": 0.5 });
    with_file(&lit(json!({ "type": "spot", "spot": angles })), |import| {
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
    with_file(&both, |import| {
        let [Light::Directional { color, .. }, Light::Lamp(lamp)] = import.scene.lights else {
            unreachable!()
        };
        assert!((color.r - 3.0 / 10f32.sqrt()).abs() < 1e-5);
        assert!((arriving(lamp, 2.0).r - 1.0 / 10f32.sqrt()).abs() < 1e-5);
    });
}

#[test]
fn lights_without_light_are_said() {
    with_file(&lit(json!({ "type": "point", "intensity": 0, "range": 5 })), |import| {
        assert_eq!(import.scene.lights, view::lights(&import.scene.camera));
        assert_eq!(
            import.notes[0],
            "model.gltf: node 1 `Lamp`, light 0: its range is left out: it shines at any distance"
        );
        assert_eq!(import.notes[1], "model.gltf: node 1 `Lamp`, light 0: left out: it has no light");
    });
    let error = refusal(&lit(json!({ "type": "point", "intensity": -1 })));
    assert_eq!(error, "model.gltf: node 1 `Lamp`, light 0: its intensity must not be -1; replace it");
}
