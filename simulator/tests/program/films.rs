//! Tests of the films of `rayline record`, and of pictures as they look on a panel.

use std::fs::File;

use crate::bench::{Bench, pixels};

const SMALL: [&str; 4] = ["classic", "--size", "32x24", "--quiet"];

/// The colors and the delay of a frame.
type Frame = (Vec<u8>, u16);

/// The size of a GIF, and its frames.
fn frames(bench: &Bench, name: &str) -> ((u16, u16), Vec<Frame>) {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut film = options.read_info(File::open(bench.path(name)).unwrap()).unwrap();
    assert_eq!(film.repeat(), gif::Repeat::Infinite);
    let mut frames = Vec::new();
    while let Some(frame) = film.read_next_frame().unwrap() {
        let rgb = frame.buffer.as_chunks().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]);
        frames.push((rgb.collect(), frame.delay));
    }
    ((film.width(), film.height()), frames)
}

#[test]
fn an_orbit_begins_at_the_picture_and_goes_around_once() {
    let bench = Bench::new();
    // In 16 grays each frame has all its colors.
    let gray = ["--color", "gray4"];
    let length = ["--seconds", "0.5", "--frames-per-second", "8"];
    assert_eq!(bench.output(&[&["record"], &SMALL[..], &gray, &length].concat()), "");
    let (size, frames) = frames(&bench, "classic.gif");
    assert_eq!((size, frames.len()), ((32, 24), 4));
    assert_eq!(frames.iter().map(|(_, delay)| *delay).collect::<Vec<_>>(), [13, 12, 13, 12]);
    let still = bench.picture(&["classic", "--size", "32x24", "--color", "gray4"]);
    assert!(still.2 == frames[0].0, "the first frame is not the picture");
    let differ = |a: &[u8], b: &[u8]| a.iter().zip(b).filter(|(a, b)| a != b).count();
    for pair in frames.windows(2) {
        assert!(differ(&pair[0].0, &pair[1].0) > 300);
    }
}

#[test]
fn animated_png_files_have_all_colors() {
    let bench = Bench::new();
    let orbit = ["-o", "film.png", "--seconds", "1", "--frames-per-second", "3"];
    bench.output(&[&["record"], &SMALL[..], &orbit].concat());
    let mut film = png::Decoder::new(std::io::BufReader::new(File::open(bench.path("film.png")).unwrap()));
    film.set_transformations(png::Transformations::IDENTITY);
    let mut film = film.read_info().unwrap();
    assert_eq!(film.info().animation_control.unwrap().num_frames, 3);
    let mut frames = vec![vec![0; 32 * 24 * 3]; 3];
    for frame in &mut frames {
        film.next_frame(frame).unwrap();
    }
    assert!(bench.picture(&["classic", "--size", "32x24"]).2 == frames[0]);
    assert!(frames[0] != frames[1] && frames[1] != frames[2]);
}

/// A mirror stands at its own place in the first frame, and a ball that has moved by a way looks as one that
/// stands there.
#[test]
fn objects_follow_a_script() {
    let bench = Bench::new();
    let scene = |x: u32| {
        format!(
            "Scene(
                camera: (eye: (0, 0, 9), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 0.7),
                materials: [(diffuse: 1)],
                objects: {{ \"ball\": (shape: Sphere(center: ({x}, 0, 0), radius: 1), material: 0) }},
                lights: [Directional(direction: (-1, -1, -1), color: (1, 1, 1))],
            )"
        )
    };
    bench.write("scene.ron", scene(0));
    bench.write("there.ron", scene(1));
    bench.write(
        "script.ron",
        "(seconds: 1, frames_per_second: 2, objects: { \"ball\": [(at: 0), (at: 1, by: (2, 0, 0))] })",
    );
    let options = ["--size", "32x24", "--color", "gray4"];
    let said = bench.output(&[&["record", "scene.ron", "--script", "script.ron"], &options[..]].concat());
    assert!(said.starts_with("scene.gif: 32x24, 2 frames, "), "{said}");
    let (_, frames) = frames(&bench, "scene.gif");
    for (name, (frame, delay)) in ["scene.ron", "there.ron"].into_iter().zip(frames) {
        let still = bench.picture(&[&[name], &options[..]].concat());
        assert!(still.2 == frame, "{name}");
        assert_eq!(delay, 50);
    }
    assert_eq!(
        bench.error(&["record", "classic", "--script", "script.ron"]),
        "script.ron: object `ball`: the scene has none of this name; numbers from 0 to 4 are possible"
    );
}

/// The script of the film in README.md.
#[test]
fn the_film_of_the_readme_can_be_recorded() {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/classic.film.ron");
    let bench = Bench::new();
    bench.output(&["record", "classic", "--quiet", "--size", "16x12", "--script", script]);
    let (size, frames) = frames(&bench, "classic.gif");
    assert_eq!((size, frames.len()), ((16, 12), 36));
}

#[test]
fn films_that_cannot_be_made_are_refused() {
    let bench = Bench::new();
    for (arguments, expected) in [
        (&["-o", "film.mp4"][..], "cannot write film.mp4: films are .gif, .png or .apng files"),
        (&["--seconds", "0"], "the length must be above 0 and at most 3600 seconds"),
        (&["--frames-per-second", "60"], "the frames in a second must be above 0 and at most 50"),
        (
            &["--theme", "lcd-green", "--color", "rgb565"],
            "--theme has two colors, but --color rgb565 has more; leave out one of them",
        ),
    ] {
        assert_eq!(bench.error(&[&["record", "classic"], arguments].concat()), expected);
    }
    assert!(bench.files().is_empty());
}

#[test]
fn panels_have_large_pixels_in_two_colors() {
    let bench = Bench::new();
    bench.output(&["render", "classic", "--size", "32x24", "--theme", "oled-blue", "--quiet"]);
    let (width, height, rgb) = pixels(&bench.path("classic.png"));
    // Three pixels for each, and one between two of them.
    assert_eq!((width, height), (32 * 4 - 1, 24 * 4 - 1));
    let mono = bench.picture(&["classic", "--size", "32x24", "--color", "mono"]).2;
    let (off, on) = ([0, 20, 40], [0, 210, 255]);
    let is_lit = |index: usize| {
        let (x, y) = (index % 127, index / 127);
        x % 4 != 3 && y % 4 != 3 && mono[(y / 4 * 32 + x / 4) * 3] == 255
    };
    let colors = rgb.as_chunks::<3>().0;
    assert!(colors.iter().enumerate().all(|(index, color)| *color == if is_lit(index) { on } else { off }));
    assert!(colors.contains(&on));

    bench.output(&["render", "classic", "--size", "8x6", "--scale", "2", "--pixel-spacing", "0", "--quiet"]);
    assert_eq!(pixels(&bench.path("classic.png")).0, 16);
}
