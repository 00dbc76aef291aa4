//! Tests of `rayline pixel`, `rayline scenes` and `--help`.

use crate::bench::{BALL, Bench};

#[test]
fn a_pixel_of_glass_sends_rays_both_ways() {
    let bench = Bench::new();
    let report = bench.output(&["pixel", "classic", "280,300"]);
    let lines: Vec<&str> = report.lines().collect();
    assert_eq!(lines[0], "pixel (280, 300) of 640x480, scene classic, in f32");
    assert!(lines[1].starts_with("camera ray from (0, 0, 0) toward (-0.0936"));
    assert!(lines[2].starts_with("  hits the front of object 1 (sphere, material 1) at "));
    // No light shows at this point: glass is not diffuse, and the highlights are elsewhere.
    assert!(!report.contains("light 0 toward "));
    assert!(bench.output(&["pixel", "classic", "200,380"]).contains("\n  light 0 toward "));
    assert!(lines.iter().any(|line| line.starts_with("  refracted ray ") && line.ends_with("share 0.8")));
    assert!(lines.iter().any(|line| line.starts_with("  reflected ray ") && line.ends_with("share 0.1")));
    assert!(lines.iter().any(|line| line.starts_with("    hits the back of object 1 (")));

    // The last line has the color that is in the picture.
    let (_, _, bytes) = bench.picture(&["classic"]);
    let shown: String =
        bytes[(300 * 640 + 280) * 3..][..3].iter().map(|level| format!("{level:02x}")).collect();
    assert!(lines[lines.len() - 1].ends_with(&format!("shown as #{shown} in rgb888")), "{report}");
}

#[test]
fn the_options_of_pictures_hold_for_pixels() {
    let bench = Bench::new();
    let report = |arguments: &[&str]| bench.output(&[&["pixel", "classic", "280,300"], arguments].concat());
    assert!(!report(&["--bounces", "0"]).contains("refracted ray"));
    assert!(report(&["--bounces", "0"]).contains("the limit of bounces is reached"));
    assert!(report(&["--cutoff", "0.5"]).contains("its share would be below the cut-off"));
    assert!(report(&["--rays-per-pixel", "2"]).contains("the limit of rays per pixel is reached"));
    assert_eq!(report(&["--samples", "3"]).matches("camera ray").count(), 3);
    assert!(report(&["--color", "mono"]).contains("in mono\n"));
    assert!(report(&["--number", "f64"]).contains(", in f64\n"));
    // Distances are in units of the scene in every number system.
    let fixed = report(&["--number", "fixed"]);
    assert!(
        fixed.contains(", in fixed\n")
            && fixed.contains("hits the front of object 1 (sphere, material 1) at")
    );
    assert_eq!(first_distance(&fixed), first_distance(&report(&[])), "{fixed}");
}

#[test]
fn objects_of_files_are_named_with_their_line() {
    let bench = Bench::new();
    bench.write("ball.nff", BALL);
    let report = bench.output(&["pixel", "ball.nff", "20,15"]);
    assert!(report.contains("object 0 (sphere, material 0, line 5)"), "{report}");
    let report = bench.output(&["pixel", "ball.nff", "0,0"]);
    assert!(report.contains("hits nothing; the background is (0.1, 0.2, 0.3)"), "{report}");
}

/// The color after these words in the text.
fn color_after(words: &str, text: &str) -> [f64; 3] {
    let color = text.rsplit_once(words).unwrap().1.trim_start_matches(" (").split_once(')').unwrap().0;
    let channels: Vec<f64> = color.split(", ").map(|channel| channel.parse().unwrap()).collect();
    channels.try_into().unwrap()
}

/// Asserts that the parts of a pixel's light add up in each channel, and returns their number.
fn assert_adds_up(report: &str) -> usize {
    let parts: Vec<[f64; 3]> = report
        .lines()
        .filter(|line| line.contains("to the pixel"))
        .map(|line| color_after("to the pixel", line))
        .collect();
    let seen = color_after("\nlight", report);
    for channel in 0..3 {
        let sum: f64 = parts.iter().map(|part| part[channel]).sum();
        assert!((sum - seen[channel]).abs() < 1e-3, "{sum} in channel {channel} of {report}");
    }
    parts.len()
}

/// An earlier version left out the ambient light, a sixth of this pixel's light.
#[test]
fn ambient_light_is_reported_beside_the_lights() {
    let report = Bench::new().output(&["pixel", "whitted", "320,400"]);
    let surface = report.lines().find(|line| line.contains("ambient light and emission")).unwrap();
    assert!(color_after("adds", surface).iter().sum::<f64>() > 0.1, "{report}");
    assert!(assert_adds_up(&report) > 1, "{report}");
}

/// An earlier version reported only the largest of the three channels' shares.
#[test]
fn parts_add_up_in_each_channel_behind_colored_mirrors_and_glass() {
    let bench = Bench::new();
    bench.write(
        "gold.ron",
        r#"Scene(
            camera: (eye: (0, 1, 6), target: (0, 1, 0), up: (0, 1, 0), vertical_fov: 0.6),
            background: Solid(0.2, 0.3, 0.42),
            materials: {
                "floor": (color: Checker(even: (0.8, 0.7, 0.6), odd: (0.3, 0.4, 0.5),
                    cells_per_unit: (1, 0, 1)), ambient: 0.2),
                "gold": (diffuse: 0.1, reflectance: 0.9, optics: (reflection_color: (1, 0.7, 0.2))),
                "bottle": (diffuse: 0, reflectance: 0.1, transmittance: 0.9, ior: 1.5,
                    optics: (transmission_color: (0.3, 0.9, 0.5), absorption: (1, 0.1, 0.7))),
            },
            objects: {
                "floor": (shape: Disc(center: (0, 0, 0), normal: (0, 1, 0), radius: 5), material: "floor"),
                "mirror": (shape: Sphere(center: (-1, 1, 0), radius: 0.9), material: "gold"),
                "glass": (shape: Sphere(center: (1, 1, 0), radius: 0.9), material: "bottle"),
            },
            lights: [Directional(direction: (1, -3, -2), color: (1, 1, 1))],
        )"#,
    );
    for place in ["16,34", "20,24", "30,40", "44,34", "48,24"] {
        for more in [&[][..], &["--samples", "3"], &["--number", "fixed"]] {
            let report = bench.output(&[&["pixel", "gold.ron", place, "--size", "64x64"], more].concat());
            let parts = assert_adds_up(&report);
            assert!(parts > usize::from(place != "30,40"), "{report}");
        }
    }
}

#[test]
fn scenes_are_listed_on_one_line_each_and_can_be_rendered() {
    let bench = Bench::new();
    let list = bench.output(&["scenes"]);
    let names: Vec<&str> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(names.len(), rayline::builtin::ALL.len());
    assert!(names.contains(&"classic"));
    for name in names {
        assert_eq!(bench.picture(&[name, "--size", "8x6"]).0, 8);
    }
}

#[test]
fn help_says_when_the_seed_matters_and_what_lines_do() {
    let help = Bench::new().output(&["render", "--help"]);
    let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("has no effect unless --samples is above 1"), "{help}");
    assert!(words.contains("into a picture of B-A lines"), "{help}");
}

/// The distance of the first hit, with two digits after the point.
fn first_distance(report: &str) -> String {
    let distance = report.split("distance ").nth(1).unwrap().split(',').next().unwrap();
    format!("{:.2}", distance.parse::<f64>().unwrap())
}

#[test]
fn check_tells_what_a_panel_shows() {
    let bench = Bench::new();
    let report = |panel: &str| {
        bench.output(&["check", "classic", "--board", "pico", "--size", "32x24", "--panel", panel])
    };
    assert!(!report("32x24").contains("A panel"));
    assert!(report("16x24").ends_with(
        "\nA panel of 16x24 shows 16x24 pixels of the picture (50 %), which cover 100 % of the panel. Use \
         --size 16x24.\n"
    ));
    let larger = report("64x24");
    assert!(larger.contains("shows 32x24 pixels of the picture (100 %), which cover 50 % of"), "{larger}");
}
