//! Tests of the pictures of `rayline` and `rayline render`.

use crate::bench::{BALL, Bench, SQUARE, pixels};

const SMALL: [&str; 3] = ["classic", "--size", "80x60"];

fn small(bench: &Bench, arguments: &[&str]) -> Vec<u8> {
    let (width, height, bytes) = bench.picture(&[&SMALL, arguments].concat());
    assert_eq!((width, height), (80, 60));
    bytes
}

#[test]
fn without_arguments_the_showcase() {
    let bench = Bench::new();
    let said = bench.output(&[]);
    assert!(said.starts_with("rayline.png: 640x480, "), "{said}");
    assert_eq!(said.lines().count(), 1);
    let (width, height, bytes) = pixels(&bench.path("rayline.png"));
    assert_eq!((width, height), (640, 480));
    // Pixel (0, 0) sees the background (0.2, 0.7, 0.8), in sRGB.
    assert_eq!(bytes[..3], [124, 218, 231]);
    assert_eq!(bench.picture(&["classic"]), (width, height, bytes));
}

#[test]
fn files_have_their_own_size_and_name_the_picture() {
    let bench = Bench::new();
    bench.write("ball.nff", BALL);
    assert!(bench.output(&["render", "ball.nff"]).starts_with("ball.png: 40x30, "));
    assert_eq!(bench.files(), ["ball.nff", "ball.png"]);
    let (width, height, bytes) = pixels(&bench.path("ball.png"));
    assert_eq!((width, height), (40, 30));
    let middle = (15 * 40 + 20) * 3;
    assert!(bytes[middle] > 100 && bytes[middle + 1] < 100, "{:?}", &bytes[middle..middle + 3]);
    assert_eq!(bench.output(&["render", "ball.nff", "--quiet"]), "");
}

#[test]
fn models_get_a_camera_and_a_light_with_a_note() {
    let bench = Bench::new();
    bench.write("square.obj", SQUARE);
    bench.write("square.mtl", "newmtl red\nKd 1 0 0\n");
    let run = bench.run(&["render", "square.obj", "--size", "40x30"]);
    assert!(run.status.success());
    let said = String::from_utf8(run.stderr).unwrap();
    assert!(
        said.starts_with("note: square.obj: OBJ files have no camera and no lights; the whole model is seen"),
        "{said}"
    );
    assert_eq!(said.lines().count(), 1);
    let (width, height, bytes) = pixels(&bench.path("square.png"));
    assert_eq!((width, height), (40, 30));
    let red = |x: usize, y: usize| bytes[(y * 40 + x) * 3] > 150 && bytes[(y * 40 + x) * 3 + 1] == 0;
    assert!(red(20, 15) && red(16, 12) && red(24, 18) && !red(2, 2) && !red(37, 27));
    assert_eq!(bench.output(&["render", "square.obj", "--quiet"]), "");
}

#[test]
fn a_byte_order_mark_changes_nothing() {
    let bench = Bench::new();
    let red = "newmtl red\nKd 1 0 0\n";
    // If the mark spoiled the first line, the square would have other corners.
    let square = SQUARE.replace("mtllib square.mtl\n", "") + "mtllib square.mtl\n";
    let triangle = r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], 
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3,
        "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, 
        "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;
    bench.write("ball.nff", BALL);
    bench.output(&["convert", "ball.nff", "scene.ron"]);
    let scene = std::fs::read_to_string(bench.path("scene.ron")).unwrap();
    let texts =
        [("ball.nff", BALL), ("square.obj", &square), ("triangle.gltf", triangle), ("scene.ron", &scene)];
    let pictures = |mark: &str| {
        bench.write("square.mtl", [mark, red].concat());
        texts.map(|(name, text)| {
            bench.write(name, [mark, text].concat());
            bench.picture(&[name, "--size", "40x30"])
        })
    };
    let without = pictures("");
    assert!(without.iter().all(|(_, _, bytes)| bytes.chunks(3).any(|pixel| pixel != &bytes[..3])));
    assert_eq!(pictures("\u{feff}"), without);
}

#[test]
fn ppm_and_png_hold_the_same_pixels() {
    let bench = Bench::new();
    for name in ["picture.PNG", "picture.ppm"] {
        bench.output(&[&["render", "-o", name][..], &SMALL].concat());
    }
    assert!(std::fs::read(bench.path("picture.PNG")).unwrap().starts_with(b"\x89PNG"));
    let ppm = std::fs::read(bench.path("picture.ppm")).unwrap();
    assert!(ppm.starts_with(b"P6"));
    let (_, _, bytes) = pixels(&bench.path("picture.PNG"));
    assert!(ppm.ends_with(&bytes) && ppm.len() < bytes.len() + 30);
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let bench = Bench::new();
    for extra in [&["--samples", "2"][..], &["--color", "mono", "--dither", "ordered"]] {
        let with = |threads| small(&bench, &[&["--threads", threads], extra].concat());
        let one = with("1");
        assert!(one == with("2") && one == with("5") && one == small(&bench, extra));
    }
}

#[test]
fn passes_end_in_the_same_bytes_and_are_told() {
    let bench = Bench::new();
    for extra in [&["--samples", "5"][..], &["--samples", "6", "--adaptive", "2", "--color", "mono"]] {
        let arguments = [&["render"], &SMALL[..], &["-o", "passes.png", "--passes"], extra].concat();
        let output = bench.output(&arguments);
        assert!(pixels(&bench.path("passes.png")).2 == small(&bench, extra));
        assert!(output.contains("pass 1 of at most"), "{output}");
        assert!(output.contains("100 % of the pixels are complete"), "{output}");
    }
}

#[test]
fn lines_are_those_of_the_whole_picture() {
    let bench = Bench::new();
    let whole = small(&bench, &["--dither", "ordered", "--color", "rgb565"]);
    let arguments = [&SMALL[..], &["--dither", "ordered", "--color", "rgb565", "--lines", "13..37"]].concat();
    let (width, height, part) = bench.picture(&arguments);
    assert_eq!((width, height), (80, 24));
    assert!(part == whole[13 * 80 * 3..37 * 80 * 3]);
}

#[test]
fn pictures_have_only_the_colors_of_their_display() {
    let bench = Bench::new();
    let levels = |arguments: &[&str]| {
        let bytes = small(&bench, arguments);
        let gray = bytes.chunks(3).all(|pixel| pixel[0] == pixel[1] && pixel[1] == pixel[2]);
        let mut levels: Vec<u8> = bytes.iter().skip(1).step_by(3).copied().collect();
        levels.sort_unstable();
        levels.dedup();
        (levels, gray)
    };
    let (all, gray) = levels(&[]);
    assert!(all.len() > 64 && !gray);
    assert!(matches!(levels(&["--color", "rgb565"]), (greens, false) if greens.len() <= 64));
    assert!(matches!(levels(&["--color", "gray8"]), (grays, true) if grays.len() > 64));
    let (grays, gray) = levels(&["--color", "gray4"]);
    assert!(gray && grays.len() > 8 && grays.iter().all(|level| level % 17 == 0), "{grays:?}");
    assert_eq!(levels(&["--color", "mono"]), (vec![0, 255], true));
}

#[test]
fn each_option_changes_the_picture() {
    let bench = Bench::new();
    let plain = small(&bench, &[]);
    for arguments in [
        &["--bounces", "0"][..],
        &["--bounces", "2"],
        &["--color", "rgb565"],
        &["--transfer", "linear"],
        &["--samples", "4"],
        &["--rays-per-pixel", "3"],
        &["--cutoff", "0.5"],
        &["--dither", "ordered"],
        &["--mode", "realtime"],
        &["--mode", "preview"],
    ] {
        assert!(small(&bench, arguments) != plain, "{arguments:?}");
    }
    for arguments in [&["--bounces", "3"][..], &["--number", "f32"], &["--color", "rgb888"], &["--seed", "7"]]
    {
        assert!(small(&bench, arguments) == plain, "{arguments:?}");
    }
}

#[test]
fn the_seed_moves_samples() {
    let bench = Bench::new();
    let with = |seed| small(&bench, &["--samples", "3", "--seed", seed]);
    assert!(with("1") == with("1") && with("1") != with("2"));
}

#[test]
fn double_precision_is_another_computation_of_the_same_picture() {
    let bench = Bench::new();
    // There are enough pixels that one of them shows the rounding.
    let arguments = ["classic", "--size", "320x240"];
    let (_, _, single) = bench.picture(&arguments);
    let (_, _, double) = bench.picture(&[&arguments[..], &["--number", "f64"]].concat());
    let far = single.iter().zip(&double).filter(|(a, b)| a.abs_diff(**b) > 2).count();
    assert!(single != double && far < single.len() / 200, "{far}");
}

/// The content of `stats.json`.
fn statistics(bench: &Bench) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(bench.path("stats.json")).unwrap()).unwrap()
}

fn figure(statistics: &serde_json::Value, pointer: &str) -> u64 {
    statistics.pointer(pointer).and_then(serde_json::Value::as_u64).unwrap()
}

/// Path tracing takes 64 samples and the rays that they need, unless it is told otherwise.
#[test]
fn path_tracing_takes_enough_samples_and_rays() {
    let bench = Bench::new();
    let figures = |more: &[&str]| {
        let size = ["--size", "8x6", "--bounces", "16", "--stats", "stats.json"];
        let picture = ["render", "classic", "--integrator", "path-tracing"];
        let output = bench.run(&[&picture[..], &size, more].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let stats = statistics(&bench);
        let figure = |pointer| figure(&stats, pointer);
        (figure("/rays/camera"), figure("/rays/scattered") > 0, figure("/cuts/rays") > 0)
    };
    assert_eq!(figures(&[]), (8 * 6 * 64, true, false));
    assert_eq!(figures(&["--samples", "128"]), (8 * 6 * 128, true, false));
    assert!(figures(&["--rays-per-pixel", "64"]).2);
}

#[test]
fn statistics_have_every_figure() {
    let bench = Bench::new();
    bench.output(&[&["render", "--stats", "stats.json", "--cutoff", "0.05"][..], &SMALL].concat());
    let stats = statistics(&bench);
    let figure = |pointer| figure(&stats, pointer);
    assert_eq!(figure("/rays/camera"), 80 * 60);
    for pointer in [
        "/rays/shadow",
        "/rays/reflected",
        "/rays/refracted",
        "/hits/camera",
        "/cuts/bounces",
        "/cuts/throughput",
        "/scene_bytes",
        "/prepared_bytes",
    ] {
        assert!(figure(pointer) > 0, "{pointer}");
    }
    assert!(figure("/hits/camera") < 80 * 60);
    assert_eq!((figure("/cuts/rays"), figure("/cuts/shadow_layers")), (0, 0));
    assert!(stats["seconds"].as_f64().unwrap() > 0.0);
}
