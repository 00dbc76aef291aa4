//! Golden pictures that must be reproduced exactly: every built-in scene in every color, and backgrounds.
//!
//! On failure a test writes the picture and its difference to the golden, and prints the command that blesses
//! it. Look at a picture before you bless it.

use std::mem::MaybeUninit;
use std::path::{Path, PathBuf};

use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Gray8, Rgb565, Rgb888, RgbColor};
use rayline::builtin::{self, Builtin, PRISM};
use rayline::{DisplayColor, Dither, PreparedScene, Renderer, Scene, Settings, Transfer};
use rayline_tests::Picture;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 72;

/// The variable that blesses pictures: `RAYLINE_BLESS=1 cargo test -p rayline-tests goldens`.
const BLESS: &str = "RAYLINE_BLESS";

/// The scene as a display with the color type `C` shows it.
fn picture<C: DisplayColor + Into<Rgb888> + From<BinaryColor>>(
    scene: &Builtin,
    dither: Dither,
    transfer: Transfer,
) -> Picture {
    let mut memory = vec![MaybeUninit::uninit(); scene.scene.bytes::<f32>()];
    let prepared = PreparedScene::<f32, _>::new(scene.scene, &mut memory).expect("a legal scene");
    let settings = Settings { bounces: scene.bounces, dither, transfer, ..Settings::new(WIDTH, HEIGHT) };
    let renderer = Renderer::new(&prepared, settings).expect("legal settings");
    let mut pixels = Vec::new();
    for y in 0..HEIGHT {
        let mut line = vec![C::from(BinaryColor::Off); WIDTH as usize];
        renderer.line(y, &mut line).expect("a line");
        pixels.extend(line.into_iter().map(|color| {
            let color: Rgb888 = color.into();
            [color.r(), color.g(), color.b()]
        }));
    }
    Picture { width: WIDTH, pixels }
}

fn check(name: &str, actual: &Picture) {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("goldens").join(format!("{name}.png"));
    if std::env::var_os(BLESS).is_some() {
        actual.write(&golden);
        return;
    }
    if golden.exists() {
        let expected = Picture::read(&golden);
        if expected == *actual {
            return;
        }
        assert_eq!(expected.width, actual.width, "{name} has another size");
        let different = expected.pixels.iter().zip(&actual.pixels);
        // Any difference is shown at full brightness, because a single level would be invisible.
        let difference = Picture {
            width: actual.width,
            pixels: different
                .map(|(a, b)| std::array::from_fn(|i| if a[i] == b[i] { 0 } else { 255 }))
                .collect(),
        };
        difference.write(&written(&format!("{name}-difference.png")));
    }
    actual.write(&written(&format!("{name}-actual.png")));
    panic!(
        "{name} differs from its golden; look at {} and, if it is right, bless it with\n    \
         {BLESS}=1 cargo test -p rayline-tests goldens",
        written(&format!("{name}-actual.png")).display()
    );
}

fn written(file: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(file)
}

fn check_all<C: DisplayColor + Into<Rgb888> + From<BinaryColor>>(
    color: &str,
    dither: Dither,
    transfer: Transfer,
) {
    for scene in &builtin::ALL {
        check(&format!("{}-{color}", scene.name), &picture::<C>(scene, dither, transfer));
    }
}

#[test]
fn rgb888() {
    check_all::<Rgb888>("rgb888", Dither::None, Transfer::Srgb);
}

/// A scene in front of each kind of background.
#[test]
fn backgrounds() {
    for (name, background) in super::backgrounds::ALL {
        let scene = Box::leak(Box::new(Scene { background, ..PRISM }));
        let builtin = Builtin { name, description: "a prism in front of a background", scene, bounces: 5 };
        check(&format!("background-{name}"), &picture::<Rgb888>(&builtin, Dither::None, Transfer::Srgb));
    }
}

#[test]
fn rgb565_dithered() {
    check_all::<Rgb565>("rgb565-dithered", Dither::Ordered, Transfer::Srgb);
}

#[test]
fn gray8_linear() {
    check_all::<Gray8>("gray8-linear", Dither::None, Transfer::Linear);
}

#[test]
fn gray4() {
    check_all::<Gray4>("gray4", Dither::None, Transfer::Srgb);
}

#[test]
fn mono_dithered() {
    check_all::<BinaryColor>("mono-dithered", Dither::Ordered, Transfer::Linear);
}
