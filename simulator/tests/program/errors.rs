//! Tests of errors: one line, status 1, and no files left behind.

use crate::bench::{BALL, Bench, SQUARE};

#[test]
fn unknown_scenes_are_answered_with_the_known_ones() {
    let bench = Bench::new();
    let error = bench.error(&["render", "clasic"]);
    assert!(error.starts_with("there is no scene `clasic`; did you mean `classic`? Use classic"), "{error}");
    let error = bench.error(&["pixel", "zzz", "0,0"]);
    assert!(error.starts_with("there is no scene `zzz`. Use classic"), "{error}");
    assert_eq!(bench.files(), [""; 0]);
}

#[test]
fn bad_files_are_answered_with_the_line() {
    let bench = Bench::new();
    for (content, expected) in [
        (format!("{BALL}s 1 2 3 x").into_bytes(), "bad.nff:6: expected the radius of the sphere, found `x`"),
        (
            format!("{BALL}f 1 1 1 1 0 0 .5 0").into_bytes(),
            "bad.nff:6: the index of refraction is less than 0.001; air is 1, glass about 1.5",
        ),
        (
            format!("{BALL}s 1 2 3").into_bytes(),
            "bad.nff:6: the file ends where the radius of the sphere must follow",
        ),
        (
            BALL.replace("angle 40", "angle 190").into_bytes(),
            "bad.nff:1: the vertical field of view is not between 0.0002 and 179.98 degrees; give \
             `vertical_fov` in radians: 45 degrees are 0.785",
        ),
        (b"# \xff".to_vec(), "bad.nff:1: not a text file; convert it to UTF-8"),
        (Vec::new(), "bad.nff:1: the file has no view (`v`) and no object to look at; add one of them"),
    ] {
        bench.write("bad.nff", content);
        assert_eq!(bench.error(&["render", "bad.nff"]), expected);
        assert_eq!(bench.error(&["pixel", "bad.nff", "0,0"]), expected);
    }
    assert_eq!(bench.files(), ["bad.nff"]);
    bench.write("bad.ron", b"// \xff");
    assert_eq!(bench.error(&["render", "bad.ron"]), "bad.ron:1:1: not a text file; convert it to UTF-8");
    assert!(bench.error(&["render", "missing.nff"]).starts_with("cannot read missing.nff: "));
    assert!(bench.error(&["render", "two\nlines.nff"]).starts_with("cannot read two\u{fffd}lines.nff: "));
}

#[test]
fn bad_models_are_answered_with_the_file_and_the_line() {
    let bench = Bench::new();
    bench.write("square.mtl", "newmtl red\nKd 1 0\n");
    let unknown = "bad.obj:7: there is no vertex `5`: there are 4, counted from 1; define it or correct the \
                   number";
    bench.write("bad.obj", SQUARE.replace("3 4", "3 5"));
    assert_eq!(bench.error(&["pixel", "bad.obj", "0,0"]), unknown);
    bench.write("bad.obj", BALL);
    assert_eq!(
        bench.error(&["render", "bad.obj"]),
        "bad.obj:1: expected a coordinate of the vertex, found `from`"
    );
    assert!(bench.error(&["render", "missing.obj"]).starts_with("cannot read missing.obj: "));
}

#[test]
fn the_view_of_a_model_is_refused_for_scenes_with_a_camera() {
    let bench = Bench::new();
    let expected = "classic has a camera of its own, but --up and --from are for models without one; leave \
                    them out";
    assert_eq!(bench.error(&["render", "classic", "--up", "-z"]), expected);
    assert_eq!(bench.error(&["pixel", "classic", "0,0", "--from", "-30,20"]), expected);
}

#[test]
fn files_that_cannot_be_written_are_refused_before_rendering() {
    let bench = Bench::new();
    // A picture of this size would take minutes.
    let huge = ["render", "classic", "--size", "65535x20000"];
    let error = |arguments: &[&str]| bench.error(&[&huge, arguments].concat());
    assert_eq!(error(&["-o", "picture.jpg"]), "cannot write picture.jpg: pictures are .png or .ppm files");
    assert_eq!(error(&["-o", "picture"]), "cannot write picture: pictures are .png or .ppm files");
    assert_eq!(
        error(&["-o", "nowhere/picture.png"]),
        "cannot write nowhere/picture.png: there is no directory nowhere; create it first"
    );
    assert!(
        error(&["-o", "picture.png", "--stats", "nowhere/stats.json"]).starts_with("cannot write nowhere/")
    );
    std::fs::create_dir(bench.path("directory.png")).unwrap();
    assert_eq!(
        error(&["-o", "directory.png"]),
        "cannot write directory.png: it is a directory; name a file in it"
    );
    assert_eq!(bench.files(), ["directory.png"]);
}

/// An earlier version overwrote the scene, and lost its names and comments.
#[test]
fn a_scene_is_not_overwritten_with_itself() {
    let bench = Bench::new();
    bench.output(&["convert", "classic", "a.ron"]);
    let before = std::fs::read(bench.path("a.ron")).unwrap();
    std::fs::create_dir(bench.path("x")).unwrap();
    for output in ["a.ron", "./a.ron", "x/../a.ron"] {
        let error = bench.error(&["convert", "a.ron", output]);
        let expected =
            format!("cannot write {output}: it is the file that the scene is read from; name another file");
        assert_eq!(error, expected);
    }
    assert_eq!(std::fs::read(bench.path("a.ron")).unwrap(), before);
    bench.output(&["convert", "a.ron", "b.ron"]);
    // Another existing file may be overwritten.
    bench.output(&["convert", "a.ron", "b.ron"]);
    assert_eq!(
        bench.error(&["convert", "a.ron", "y/../b.ron"]),
        "cannot write y/../b.ron: there is no directory y; create it first"
    );
}

#[test]
fn places_outside_the_picture() {
    let bench = Bench::new();
    assert_eq!(
        bench.error(&["render", "classic", "--lines", "470..481"]),
        "there is no line 480: the picture has 480, counted from 0; ask for one below 480"
    );
    assert_eq!(
        bench.error(&["pixel", "classic", "640,0"]),
        "there is no pixel 640,0: the picture is 640x480, counted from 0,0"
    );
    assert!(bench.error(&["pixel", "classic", "70000,0"]).starts_with("there is no pixel 70000,0"));
    // An earlier version took this pixel for an option.
    assert_eq!(
        bench.error(&["pixel", "classic", "-1,2"]),
        "there is no pixel -1,2: the picture is 640x480, counted from 0,0"
    );
    for arguments in
        [&["pixel", "classic", "--bounces", "0", "-1,2"], &["pixel", "classic", "-1,2", "--size", "9x9"]]
    {
        assert!(bench.error(arguments).starts_with("there is no pixel -1,2"));
    }
}

/// An earlier version took the option for a pixel.
#[test]
fn misspelled_options_are_named_wherever_the_pixel_is() {
    let bench = Bench::new();
    for arguments in [
        ["pixel", "classic", "1,2", "--smaples", "4"],
        ["pixel", "classic", "--smaples", "4", "1,2"],
        ["pixel", "classic", "-1,2", "--smaples", "4"],
    ] {
        let output = bench.run(&arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(error.contains("unexpected argument '--smaples' found"), "{error}");
        assert!(error.contains("a similar argument exists: '--samples'"), "{error}");
    }
}

#[test]
fn arguments_that_make_no_sense_are_usage_errors() {
    let bench = Bench::new();
    for (arguments, expected) in [
        (&["--size", "0x5"][..], "expected a width and a height from 1 to 65535, such as 320x240"),
        (&["--size", "65536x5"], "expected a width and a height from 1 to 65535, such as 320x240"),
        (&["--bounces", "17"], "17 is not in 0..=16"),
        (&["--number", "f16"], "possible values: f32, fixed, f64"),
        (&["--color", "cmyk"], "possible values: rgb888, rgb565, gray8, gray4, mono"),
        (&["--dither", "noise"], "possible values: none, ordered"),
        (&["--transfer", "gamma"], "possible values: srgb, linear"),
        (&["--samples", "0"], "0 is not in 1..=65535"),
        (&["--threads", "0"], "0 is not in 1..=1024"),
        (&["--lines", "9..3"], "expected the first line and the one after the last, such as 0..120"),
        (&["--cutoff", "2"], "expected a number from 0 to 1"),
        (&["--rays-per-pixel", "0"], "0 is not in 1..=4294967295"),
        (&["--seed", "x"], "invalid digit"),
    ] {
        let output = bench.run(&[&["render", "classic"], arguments].concat());
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(said.contains(expected), "{arguments:?}: {said}");
    }
    assert_eq!(bench.files(), [""; 0]);
}

#[cfg(not(feature = "window"))]
#[test]
fn without_the_feature_window_the_error_says_how_to_build_with_it() {
    let error = Bench::new().error(&["window", "classic"]);
    assert!(
        error.contains("cargo run --release -p rayline-simulator --features window -- window classic"),
        "{error}"
    );
}
