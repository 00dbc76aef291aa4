//! A test of the window, on a display without a screen: `xdotool` presses keys and moves the mouse, and `xwd`
//! takes pictures. It needs both, and a display; `.ci/run` has them.

// All of this is test code, but clippy counts only functions with `#[test]` as such.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing)]

use std::path::Path;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

use rayline::{Settings, builtin::CLASSIC};
use rayline_simulator::{Display, Mode, Number, Orbit, RenderOptions, render};

/// The picture; the window shows each pixel as a square of this side.
const SIZE: (u32, u32) = (160, 120);
const SCALE: u32 = 4;

/// A window that shows a file.
struct Opened {
    program: Child,
    id: String,
}

impl Drop for Opened {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// The output of `xdotool`.
fn xdotool(arguments: &[&str]) -> String {
    let output = Command::new("xdotool").args(arguments).output().unwrap();
    String::from_utf8(output.stdout).unwrap().trim().to_owned()
}

/// Waits until the function finds something.
fn wait_for<T>(what: &str, mut found: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = found() {
            return found;
        }
        assert!(start.elapsed() < Duration::from_secs(20), "{what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

impl Opened {
    fn new(directory: &Path, scene: &str) -> Self {
        let program = Command::new(env!("CARGO_BIN_EXE_rayline"))
            .args(["window", scene, "--size", "160x120"])
            .current_dir(directory)
            .spawn()
            .unwrap();
        let id = wait_for("there is no window", || {
            let ids = xdotool(&["search", "--name", "^rayline: "]);
            ids.lines().next().map(str::to_owned)
        });
        xdotool(&["windowfocus", &id]);
        Self { program, id }
    }

    fn title(&self) -> String {
        xdotool(&["getwindowname", &self.id])
    }

    /// The pixels of the window as red, green and blue, and its width. The format is that of the header
    /// `XWDFile.h`: 25 numbers, then the colors of a palette, then the lines.
    fn pixels(&self) -> (usize, Vec<[u8; 3]>) {
        let dump = Command::new("xwd").args(["-silent", "-id", &self.id]).output().unwrap().stdout;
        let number = |index: usize| u32::from_be_bytes(dump[index * 4..][..4].try_into().unwrap()) as usize;
        let (header, width, height, bits, line) = (number(0), number(4), number(5), number(11), number(12));
        assert_eq!((bits, number(7)), (32, 0), "a screen of 24 bits, least significant byte first");
        let lines = &dump[header + number(19) * 12..];
        let pixels = lines.chunks(line).take(height).flat_map(|line| line[..width * 4].as_chunks::<4>().0);
        (width, pixels.map(|&[b, g, r, _]| [r, g, b]).collect())
    }

    /// Waits until the window shows this picture, enlarged.
    fn shows(&self, what: &str, camera: rayline::Camera, options: &RenderOptions) {
        let expected = render(&rayline::Scene { camera, ..CLASSIC }, options).unwrap().rgb;
        let expected = expected.as_chunks::<3>().0;
        let scale = SCALE as usize;
        let columns = SIZE.0 as usize;
        wait_for(&format!("{what}: the window, {}, does not show the picture", self.title()), || {
            let (width, pixels) = self.pixels();
            let is_equal = |(place, color): (usize, &[u8; 3])| {
                let (x, y) = (place % width, place / width);
                expected[y / scale * columns + x / scale] == *color
            };
            let is_whole = pixels.len() == expected.len() * scale * scale;
            (is_whole && pixels.iter().enumerate().all(is_equal)).then_some(())
        });
    }

    /// Waits until the window shows a message over the picture.
    fn shows_a_message(&self) {
        wait_for("there is no message", || self.pixels().1.contains(&[160, 0, 0]).then_some(()));
    }
}

#[test]
fn keys_mouse_and_file_change_the_picture() {
    let has = |program: &str| Command::new(program).arg("-version").output().is_ok();
    if std::env::var_os("DISPLAY").is_none() || !has("xdotool") || !has("xwd") {
        println!("not tried: it needs a display of X11, xdotool and xwd");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.ron");
    let convert = Command::new(env!("CARGO_BIN_EXE_rayline"))
        .args(["convert", "classic", "scene.ron", "--quiet"])
        .current_dir(folder.path())
        .status();
    assert!(convert.unwrap().success());
    let text = std::fs::read_to_string(&file).unwrap();

    let mut options = RenderOptions::new(Settings { bounces: 3, ..Settings::new(SIZE.0, SIZE.1) });
    let mut orbit = Orbit::around(&CLASSIC).unwrap();
    let window = Opened::new(folder.path(), "scene.ron");
    window.shows("first", CLASSIC.camera, &options);

    xdotool(&["key", "Right"]);
    xdotool(&["key", "Up"]);
    orbit.turn(0.087, 0.0);
    orbit.turn(0.0, 0.087);
    window.shows("keys", orbit.camera(), &options);

    // Button 4 is the wheel, forward. For winit, its press and its release are a step each; a real wheel has
    // an axis.
    xdotool(&["mousemove", "--window", &window.id, "100", "100", "click", "4"]);
    orbit.dolly(1.1f64.powf(-1.0));
    orbit.dolly(1.1f64.powf(-1.0));
    window.shows("wheel", orbit.camera(), &options);

    xdotool(&["mousedown", "1"]);
    xdotool(&["mousemove", "--window", &window.id, "164", "100"]);
    xdotool(&["mouseup", "1"]);
    orbit.turn(-0.1 * core::f64::consts::PI, 0.0);
    window.shows("drag", orbit.camera(), &options);

    for (key, change) in [
        ("n", (|options| options.number = Number::Fixed) as fn(&mut RenderOptions)),
        ("m", |options| options.mode = Mode::Realtime),
        ("c", |options| options.display = Display::Rgb565),
    ] {
        xdotool(&["key", key]);
        change(&mut options);
        window.shows(key, orbit.camera(), &options);
    }
    let title = window.title();
    assert!(
        title.starts_with("rayline: scene, fixed realtime rgb565, ") && title.ends_with(" ms"),
        "{title}"
    );

    // A broken version leaves the picture; the next one is shown from the same camera.
    std::fs::write(&file, "Scene(").unwrap();
    window.shows_a_message();
    std::fs::write(&file, format!("// Changed.\n{text}")).unwrap();
    window.shows("changed", orbit.camera(), &options);

    xdotool(&["key", "Home"]);
    window.shows("home", CLASSIC.camera, &options);

    xdotool(&["key", "s"]);
    wait_for("there is no file", || folder.path().join("scene.png").exists().then_some(()));

    let mut window = window;
    xdotool(&["key", "q"]);
    let status = wait_for("the window does not close", || window.program.try_wait().unwrap());
    assert!(status.success());
}
