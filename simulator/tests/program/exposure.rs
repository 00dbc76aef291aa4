//! Tests of the exposure: of what glTF lights, by a setting, and by an option.

use crate::bench::Bench;

/// A red cube of side 2 on a gray floor of 80 by 80, with a lamp beside the cube, as glTF.
fn floor(bench: &Bench) {
    let corner = |bits: u8, low: [f32; 3], high: [f32; 3]| {
        [0, 1, 2].map(|axis| if bits >> axis & 1 == 0 { low[axis] } else { high[axis] })
    };
    let cube = (0..8).map(|bits| corner(bits, [-1.0, 0.0, -1.0], [1.0, 2.0, 1.0]));
    let ground = [[-40.0, 0.0, -40.0], [-40.0, 0.0, 40.0], [40.0, 0.0, -40.0], [40.0, 0.0, 40.0]];
    let numbers = cube.chain(ground).flatten().flat_map(f32::to_le_bytes);
    let corners = [
        0u16, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7,
        4, 7, 6, 0, 1, 2, 2, 1, 3,
    ];
    let corners = corners.into_iter().flat_map(u16::to_le_bytes);
    bench.write("floor.bin", numbers.chain(corners).collect::<Vec<_>>());
    let primitive = |positions: u8, indices: u8| {
        format!(
            r#"{{"primitives": [{{"attributes": {{"POSITION": {positions}}}, "indices": {indices},
            "material": {positions}}}]}}"#
        )
    };
    let material = |color: &str| {
        format!(
            r#"{{"pbrMetallicRoughness": {{"baseColorFactor": [{color}, 1], "metallicFactor": 0,
            "roughnessFactor": 0.9}}}}"#
        )
    };
    let accessor = |offset: u16, kind: u16, count: u8, of: &str| {
        format!(
            r#"{{"bufferView": 0, "byteOffset": {offset}, "componentType": {kind}, "count": {count}, {of}}}"#
        )
    };
    let places = |low: &str, high: &str| format!(r#""type": "VEC3", "min": {low}, "max": {high}"#);
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1, 2, 3]}}],
        "nodes": [{{"mesh": 0}}, {{"mesh": 1}},
            {{"translation": [3, 5, 4], "extensions": {{"KHR_lights_punctual": {{"light": 0}}}}}},
            {{"camera": 0, "translation": [0, 4, 10], "rotation": [-0.149438, 0, 0, 0.988771]}}],
        "cameras": [{{"type": "perspective", "perspective": {{"yfov": 0.5, "znear": 0.1}}}}],
        "meshes": [{}, {}], "materials": [{}, {}],
        "extensionsUsed": ["KHR_lights_punctual"], "extensions": {{"KHR_lights_punctual": {{"lights":
            [{{"type": "point", "intensity": 54351.4}}]}}}},
        "buffers": [{{"byteLength": 228, "uri": "floor.bin"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 228}}],
        "accessors": [{}, {}, {}, {}]}}"#,
        primitive(0, 2),
        primitive(1, 3),
        material("0.8, 0.1, 0.1"),
        material("0.8, 0.8, 0.8"),
        accessor(0, 5126, 8, &places("[-1, 0, -1]", "[1, 2, 1]")),
        accessor(96, 5126, 4, &places("[-40, 0, -40]", "[40, 0, 40]")),
        accessor(144, 5123, 36, r#""type": "SCALAR""#),
        accessor(216, 5123, 6, r#""type": "SCALAR""#),
    );
    bench.write("floor.gltf", text);
}

/// The share of pixels that are white.
fn white(bytes: &[u8]) -> f64 {
    bytes.chunks(3).filter(|pixel| *pixel == [255; 3]).count() as f64 / (bytes.len() / 3) as f64
}

/// The middle of the scene is 40 away from where the light of the lamp is measured without the camera.
#[test]
fn a_floor_near_a_lamp_is_not_white() {
    let bench = Bench::new();
    floor(&bench);
    let size = ["--size", "200x150"];
    let picture = |options: &[&str]| bench.picture(&[&["floor.gltf"], &size[..], options].concat()).2;
    let exposed = picture(&[]);
    assert!(white(&exposed) < 0.01, "{}", white(&exposed));
    // Light of 0.85 is code 237.
    assert!(exposed.chunks(3).any(|pixel| pixel.iter().all(|code| *code >= 237)));
    // The front of the cube is in the middle.
    let [red, green, blue] = [0, 1, 2].map(|channel| exposed[(75 * 200 + 100) * 3 + channel]);
    assert!((150..250).contains(&red) && u32::from(red) > 2 * u32::from(green) && green == blue);
    // By the light in the middle of the scene, most is white.
    assert!(white(&picture(&["--exposure", "0"])) > 0.5);
    assert!(white(&picture(&["--exposure", "-3"])) > 0.1);
    assert_eq!(white(&picture(&["--exposure=-8"])), 0.0);
    let run = bench.run(&["convert", "floor.gltf", "out.ron"]);
    let said = String::from_utf8(run.stderr).unwrap();
    let told = "note: floor.gltf: exposure: for what the camera sees, the lights are 0.00879 times as bright \
                (-6.8 stops) as for a white middle of the scene; see --exposure";
    assert!(said.contains(told), "{said}");
}

#[test]
fn scenes_are_converted_as_they_are_drawn() {
    let bench = Bench::new();
    floor(&bench);
    for options in [&[][..], &["--exposure", "-6.5"]] {
        let run = bench.run(&[&["convert", "floor.gltf", "scene.ron", "-q"], options].concat());
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        let options = [options, &["--size", "80x60"]].concat();
        let drawn = bench.picture(&[&["floor.gltf"], &options[..]].concat());
        // The settings of glTF files are written too.
        assert!(bench.picture(&["scene.ron", "--size", "80x60"]) == drawn);
    }
}

/// A dark ball with an ambient share before a dark background, and a dim ball that emits light.
const DARK: &str = "Scene(
    camera: (eye: (0, 0, 6), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 0.7),
    background: Solid(0.1, 0.02, 0.2),
    materials: [(ambient: 0.2), (diffuse: 0, optics: (emission: (0, 0.3, 0.1)))],
    objects: [(shape: Sphere(center: (-1, 0, 0), radius: 1), material: 0),
        (shape: Sphere(center: (1, 0, 0), radius: 1), material: 1)],
    lights: [Point(position: (-9, 9, 9), color: (0.2, 0.25, 0))],
    settings: (transfer: Linear, exposure: STOPS),
)";

#[test]
fn a_stop_doubles_the_light_of_each_pixel() {
    let bench = Bench::new();
    for stops in ["0", "1"] {
        bench.write(&format!("{stops}.ron"), DARK.replace("STOPS", stops));
    }
    let picture = |arguments: &[&str]| bench.picture(&[arguments, &["--size", "80x60"]].concat()).2;
    let [once, twice] = ["0.ron", "1.ron"].map(|name| picture(&[name]));
    // Nothing is white, so a code is twice the other, or one beside it by rounding.
    for (one, two) in once.iter().zip(&twice) {
        assert!((i16::from(*two) - 2 * i16::from(*one)).abs() <= 1 && *two < 255, "{one} {two}");
    }
    // The background, the ball that emits light, and the ball in the light: 0.4 by ambient light, the rest in
    // the color of the lamp.
    let at = |x: usize| [0, 1, 2].map(|channel| twice[(30 * 80 + x) * 3 + channel]);
    assert_eq!((at(0), at(50)), ([51, 10, 102], [0, 153, 51]));
    let [red, green, _] = at(30).map(|code| f32::from(code) - 102.0);
    assert!(at(30)[2] == 102 && red > 20.0 && (green - 1.25 * red).abs() <= 1.2, "{:?}", at(30));
    // The option overrules the setting, and a scene that is converted has the light that is drawn.
    assert!(picture(&["1.ron", "--exposure", "0"]) == once);
    assert!(picture(&["0.ron", "--exposure", "1"]) == twice);
    assert!(bench.run(&["convert", "1.ron", "again.ron"]).status.success());
    assert!(picture(&["again.ron"]) == twice);
}

#[test]
fn other_exposures_are_refused() {
    let bench = Bench::new();
    bench.write("scene.ron", DARK.replace("STOPS", "21"));
    let limit = "an exposure is a number of stops from -20 to 20, such as 1.5; correct it";
    let said = bench.error(&["render", "scene.ron"]);
    assert!(said.contains("scene.ron:8:") && said.contains(limit), "{said}");
    for stops in ["21", "-20.5", "nan", "x"] {
        let run = bench.run(&["render", "classic", "--exposure", stops]);
        let said = String::from_utf8(run.stderr).unwrap();
        assert!(!run.status.success() && said.contains(limit), "{said}");
    }
}
