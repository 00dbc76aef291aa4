//! Tests of exported scenes: their pictures are files beside them, and POV-Ray draws them alike.

use std::io::ErrorKind;
use std::process::Command;

use rayline_simulator::raster::to_png;

use crate::bench::{Bench, pixels};

/// A square of side 2 in front of a camera at (0, 0, 4), with a texture on it, as glTF. The texture stands in
/// `wood.png`.
fn square(material: &str, sampler: &str, more: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1, 2]}}],
        "nodes": [{{"mesh": 0}}, {{"camera": 0, "translation": [0, 0, 4]}},
            {{"mesh": 0, "translation": [1, 0.5, -2]}}],
        "cameras": [{{"type": "perspective",
            "perspective": {{"yfov": 0.7, "znear": 0.1, "aspectRatio": 1.3333}}}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}},
            "indices": 2, "material": 0}}]}}],
        "materials": [{{"pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}, "metallicFactor": 0,
            "roughnessFactor": 1}}, "doubleSided": true{material}}}],
        "textures": [{{"source": 0, "sampler": 0}}], "images": [{{"uri": "wood.png"}}],
        "samplers": [{{{sampler}}}],
        "buffers": [{{"byteLength": 92, "uri": "square.bin"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 48}},
            {{"buffer": 0, "byteOffset": 48, "byteLength": 32}},
            {{"buffer": 0, "byteOffset": 80, "byteLength": 12}}],
        "accessors": [
            {{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                "min": [-1, -1, 0], "max": [1, 1, 0]}},
            {{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}},
            {{"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}}]{more}}}"#
    )
}

/// Writes the square's buffer, with texture coordinates from 0 to `repeats`, and a picture of so many pixels
/// a side without symmetry.
fn write_parts(bench: &Bench, repeats: f32, side: u8) {
    let places: [f32; 12] = [-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0, 0.0];
    let uvs = [0.0, repeats, repeats, repeats, repeats, 0.0, 0.0, 0.0];
    let numbers = places.into_iter().chain(uvs).flat_map(f32::to_le_bytes);
    let corners = [0u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes);
    bench.write("square.bin", numbers.chain(corners).collect::<Vec<_>>());
    let pixel = |x: u8, y: u8| [x * 50, 255 - y * 50, x * y * 10, 255 - x * 30 - y * 20];
    let pixels: Vec<u8> = (0..side).flat_map(|y| (0..side).flat_map(move |x| pixel(x, y))).collect();
    bench.write("wood.png", to_png((side.into(), side.into()), 4, &pixels).unwrap());
}

/// Converts a scene, which may have notes, and returns what the program said.
fn convert(bench: &Bench, scene: &str, to: &str) -> String {
    let run = bench.run(&["convert", scene, to]);
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    String::from_utf8(run.stdout).unwrap()
}

/// POV-Ray's picture of a scene in linear light; `None` if `povray` is not installed.
fn povray(bench: &Bench, scene: &str, (width, height): (u32, u32)) -> Option<Vec<u8>> {
    let mut command = Command::new("povray");
    command.current_dir(bench.path("")).args([
        format!("+I{scene}"),
        "+Opovray.png".to_owned(),
        format!("+W{width}"),
        format!("+H{height}"),
    ]);
    command.args(["+FN8", "File_Gamma=1", "Dither=off", "-D", "-A", "+WT1"]);
    let finished = match command.output() {
        Err(error) if error.kind() == ErrorKind::NotFound => return None,
        finished => finished.unwrap(),
    };
    assert!(finished.status.success(), "{}", String::from_utf8_lossy(&finished.stderr));
    let (wide, high, bytes) = pixels(&bench.path("povray.png"));
    assert_eq!((wide, high), (width, height));
    Some(bytes)
}

/// The share of pixels that differ by more than 3 of 255 in a channel.
fn different(ours: &[u8], theirs: &[u8]) -> f64 {
    assert_eq!(ours.len(), theirs.len());
    let pairs = ours.chunks(3).zip(theirs.chunks(3));
    let differ = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 3);
    pairs.filter(differ).count() as f64 / (ours.len() / 3) as f64
}

/// Asserts that POV-Ray draws an exported scene as the program does.
fn assert_drawn_alike(bench: &Bench, scene: &str) {
    convert(bench, scene, "export.pov");
    let Some(theirs) = povray(bench, "export.pov", (160, 120)) else { return };
    let (_, _, ours) = bench.picture(&[scene, "--size", "160x120", "--transfer", "linear"]);
    assert!(ours.chunks(3).any(|pixel| pixel != &ours[..3]), "{scene} shows nothing");
    let share = different(&ours, &theirs);
    assert!(share < 0.01, "{:.1} % of the pixels of {scene} differ from POV-Ray's", 100.0 * share);
}

const BLEND: &str = r#", "alphaMode": "BLEND""#;
const NEAREST: &str = r#""magFilter": 9728"#;
const MIRRORED: &str = r#""wrapS": 33648, "wrapT": 33648"#;
const CLAMPED: &str = r#""wrapS": 33071, "wrapT": 33071"#;

#[test]
fn pictures_are_files_beside_ron_scenes() {
    let bench = Bench::new();
    write_parts(&bench, 1.5, 5);
    for (material, sampler) in [("", ""), (BLEND, NEAREST), (BLEND, MIRRORED), ("", CLAMPED)] {
        bench.write("square.gltf", square(material, sampler, ""));
        let said = convert(&bench, "square.gltf", "scene.ron");
        let scene = std::fs::read_to_string(bench.path("scene.ron")).unwrap();
        let (pictures, count) =
            if material == BLEND { (" and 2 pictures", 3) } else { (" and 1 picture", 1) };
        assert!(said.contains(pictures) || count == 3 && said.contains(" and 3 pictures"), "{said}");
        assert!(scene.contains("scene-1.png\"") && !scene.contains("Rgb888"), "{scene}");
        let options = ["--size", "80x60"];
        let picture = bench.picture(&[&["square.gltf"], &options[..]].concat());
        assert!(bench.picture(&[&["scene.ron"], &options[..]].concat()) == picture, "{material} {sampler}");
    }
    // Unusual filters are written beside the name, and the usual ones are the name's own.
    bench.write("square.gltf", square("", "", ""));
    convert(&bench, "square.gltf", "usual.ron");
    let usual = std::fs::read_to_string(bench.path("usual.ron")).unwrap();
    assert!(usual.contains("Image(\"usual-1.png\")"), "{usual}");
    bench.write("square.gltf", square("", NEAREST, ""));
    convert(&bench, "square.gltf", "other.ron");
    let other = std::fs::read_to_string(bench.path("other.ron")).unwrap();
    assert!(other.contains("file: \"other-1.png\"") && other.contains("filter: Nearest"), "{other}");
}

#[test]
fn pictures_do_not_replace_files() {
    let bench = Bench::new();
    write_parts(&bench, 1.0, 4);
    bench.write("square.gltf", square("", "", ""));
    bench.write("scene-1.png", "of somebody else");
    for _ in 0..2 {
        convert(&bench, "square.gltf", "scene.ron");
    }
    let files = ["scene-1.png", "scene-2.png", "scene.ron", "square.bin", "square.gltf", "wood.png"];
    assert_eq!(bench.files(), files);
    assert_eq!(std::fs::read(bench.path("scene-1.png")).unwrap(), b"of somebody else");
    // A scene with its pictures may lie in another folder than the program runs in.
    std::fs::create_dir(bench.path("folder")).unwrap();
    convert(&bench, "scene.ron", "folder/scene.ron");
    let size = ["--size", "40x30"];
    let picture = bench.picture(&[&["scene.ron"], &size[..]].concat());
    assert!(bench.picture(&[&["folder/scene.ron"], &size[..]].concat()) == picture);
}

#[test]
fn textures_are_drawn_alike_by_povray() {
    let bench = Bench::new();
    write_parts(&bench, 1.5, 4);
    for (material, sampler) in [("", ""), (BLEND, NEAREST), (BLEND, ""), ("", MIRRORED), (BLEND, CLAMPED)] {
        bench.write("square.gltf", square(material, sampler, ""));
        assert_drawn_alike(&bench, "square.gltf");
    }
}

#[test]
fn lamps_with_an_inverse_square_are_drawn_alike_by_povray() {
    let bench = Bench::new();
    write_parts(&bench, 1.0, 4);
    for kind in ["\"point\"", "\"spot\", \"spot\": {\"outerConeAngle\": 0.3}"] {
        let lamp = format!(
            r#", "extensionsUsed": ["KHR_lights_punctual"], "extensions": {{
            "KHR_lights_punctual": {{"lights": [
            {{"type": {kind}, "intensity": 60, "color": [1, 0.9, 0.8]}}]}}}}"#
        );
        let lit = square("", "", &lamp).replace(
            r#"{"mesh": 0, "translation""#,
            r#"{"extensions": {"KHR_lights_punctual": {"light": 0}}, "mesh": 0, "translation""#,
        );
        // The lamp stands in front of the square.
        bench.write(
            "lamp.gltf",
            lit.replace("[1, 0.5, -2]", "[0.25, 0.5, 2.5]").replace(r#", "mesh": 0, "tr"#, r#", "tr"#),
        );
        assert_drawn_alike(&bench, "lamp.gltf");
    }
}

#[test]
fn exported_scenes_may_be_drawn_in_any_shape() {
    let bench = Bench::new();
    let view = "v from 0 0 5 at 0 0 0 up 0 1 0 angle 40 hither 1 resolution 256 256\n";
    bench.write("ball.nff", format!("{view}b 0 0 .4\nl 4 5 6\nl -4 -5 6 f 1 .2 .1 .8 0 0 0 1 s 0 0 0 1"));
    convert(&bench, "ball.nff", "ball.pov");
    let Some(theirs) = povray(&bench, "ball.pov", (320, 160)) else { return };
    let (_, _, ours) = bench.picture(&["ball.nff", "--size", "320x160"]);
    // The ball is red, and its background blue.
    let size = |bytes: &[u8]| {
        let is_ball = |place: usize| bytes[3 * place + 2] < 100;
        let seen: Vec<usize> = (0..320 * 160).filter(|place| is_ball(*place)).collect();
        let columns = seen.iter().map(|place| place % 320);
        let lines = seen.iter().map(|place| place / 320);
        (
            columns.clone().max().unwrap() - columns.min().unwrap() + 1,
            lines.clone().max().unwrap() - lines.min().unwrap() + 1,
        )
    };
    let (width, height) = size(&theirs);
    assert_eq!(size(&ours), (width, height));
    assert!(width == height && (88..=92).contains(&width), "{width}x{height}");
    assert!(different(&ours, &theirs) < 0.005);
}

/// A room with a named box, a ball and a lamp.
const ROOM: &str = r#"Scene(
    camera: (eye: (0, 1, 3), target: (0, 0.5, 0), up: (0, 1, 0), vertical_fov: 0.8),
    materials: {"white": (color: Solid(0.7, 0.7, 0.7))},
    objects: {
        "floor": (shape: Rectangle(corner: (-2, 0, -2), right: (0, 0, 4), up: (4, 0, 0)), material: "white"),
        "box": (shape: Cuboid(center: (0.5, 0.4, 0), axes: ((0.4, 0, 0), (0, 0.4, 0), (0, 0, 0.4))), material: "white"),
        "ball": (shape: Sphere(center: (-0.6, 0.5, 0), radius: 0.4), material: "white"),
    },
    lights: [Point(position: (1, 4, 3), color: (0.8, 0.8, 0.8))],
)"#;

/// The light of a scene is baked into all formats, which show one picture.
#[test]
fn baked_light_is_written_in_all_formats() {
    let bench = Bench::new();
    bench.write("room.ron", ROOM);
    for output in ["lit.ron", "lit.rayline", "lit.rs"] {
        let run = bench.run(&["bake", "room.ron", output, "--light", "--budget", "6000", "--grid", "2x2x2"]);
        let (said, errors) = (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
        assert!(run.status.success(), "{errors}");
        assert!(said.contains("light at ") && said.contains("0 lights"), "{said}");
    }
    let shown = |scene: &str| {
        let picture = format!("{scene}.png");
        let run = bench.run(&["render", scene, "-o", &picture, "--size", "40x30", "--transfer", "linear"]);
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        pixels(&bench.path(&picture))
    };
    assert!(shown("lit.ron") == shown("lit.rayline"));
    let source = std::fs::read_to_string(bench.path("lit.rs")).unwrap();
    assert!(source.contains("IrradianceVolume") && source.contains("AmbientLight"));
    // A box that moves throws no shadow, and gets a material with light from the volume.
    let run = bench.run(&["bake", "room.ron", "moving.ron", "--light", "indirect", "--moving", "box"]);
    assert!(run.status.success());
    let text = std::fs::read_to_string(bench.path("moving.ron")).unwrap();
    assert_eq!(text.matches("IrradianceVolume").count(), 1);
    assert!(text.contains("Point("), "{text}");
    for (arguments, expected) in [
        (&["--light", "--budget", "20"][..], "raise the budget"),
        (&["--light", "--grid", "0x1x1"], "three numbers from 1 to 255"),
        (&["--light", "--moving", "cat"], "has no object cat"),
        (&["--budget", "20"], "--light"),
    ] {
        let run = bench.run(&[&["bake", "room.ron", "bad.ron"], arguments].concat());
        let errors = String::from_utf8_lossy(&run.stderr);
        assert!(!run.status.success() && errors.contains(expected), "{arguments:?}: {errors}");
    }
    // POV-Ray's language has no such textures.
    let run = bench.run(&["bake", "room.ron", "lit.pov", "--light"]);
    assert!(String::from_utf8_lossy(&run.stderr).contains("holds no baked light"));
}
