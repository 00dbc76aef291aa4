//! Tests of the gallery's scenes: each can be read, written and read again, and its picture has the stored
//! digest.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use base64::prelude::{BASE64_STANDARD, Engine as _};
use bumpalo::Bump;
use rayline::{Digest, Sampling, Settings};
use rayline_simulator::raster::{Raster, shrunk, to_png};
use rayline_simulator::{Gallery, LoadedScene, Mode, Number, Picture, RenderOptions, SceneFile, render};

const SETTINGS: Settings = Settings { bounces: 6, ..Settings::new(64, 48) };

/// The smallest allowed PSNR of fixed point against f64, in decibels.
const LEAST_DB: f64 = 38.0;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The picture with the scene's own samples, but for speed at most four of each pixel.
fn picture(scene: &LoadedScene<'_>, number: Number) -> Picture {
    let own = scene.settings.sampling;
    let sampling = Sampling { samples: own.samples.min(4), adaptive: None, ..own };
    let Settings { integrator, area_lights, look, .. } = scene.settings;
    let settings = Settings { sampling, integrator, area_lights, look, ..SETTINGS };
    let options = RenderOptions { number, ..RenderOptions::new(settings) };
    render(&scene.scene, &options).unwrap_or_else(|error| panic!("{}: {error}", scene.name))
}

fn digest(picture: &Picture) -> u64 {
    let mut digest = Digest::new();
    digest.update(&picture.rgb);
    digest.value()
}

#[test]
fn pictures_have_the_stored_digests() {
    let gallery = Gallery::new(&root().join("docs/gallery")).unwrap();
    let mut lines = String::new();
    for file in gallery.files() {
        let arena = Bump::new();
        let scene = LoadedScene::open(file, &arena).unwrap_or_else(|error| panic!("{error}"));
        let (f32, fixed) = (picture(&scene, Number::F32), picture(&scene, Number::Fixed));
        let decibels = fixed.psnr(&picture(&scene, Number::F64)).unwrap_or(f64::INFINITY);
        assert!(decibels >= LEAST_DB, "{}: fixed point keeps {decibels:.1} dB", scene.name);
        writeln!(lines, "{} {:016x} {:016x}", scene.name, digest(&f32), digest(&fixed)).unwrap();
    }
    let golden = root().join("tests/goldens/gallery.txt");
    if std::env::var_os("RAYLINE_BLESS").is_some() {
        fs::write(&golden, &lines).unwrap();
    }
    let expected = fs::read_to_string(&golden).unwrap();
    for (line, expected) in lines.lines().zip(expected.lines()) {
        assert_eq!(line, expected, "after a look: RAYLINE_BLESS=1 cargo test -p rayline-tests gallery::");
    }
    assert_eq!(lines.lines().count(), expected.lines().count(), "scenes came or went");
}

#[test]
fn written_scenes_are_read_back() {
    let gallery = Gallery::new(&root().join("docs/gallery")).unwrap();
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
    for file in gallery.files() {
        let arena = Bump::new();
        let scene = LoadedScene::open(file, &arena).unwrap_or_else(|error| panic!("{error}"));
        for name in ["gallery.ron", "gallery.rayline"] {
            let path = directory.join(name);
            let file = SceneFile::new(&path, Number::F32).unwrap();
            file.contents(&scene.scene, &SETTINGS, &arena).unwrap().write().unwrap();
            let again = LoadedScene::open(&path, &arena).unwrap_or_else(|error| panic!("{error}"));
            assert!(again.scene == scene.scene, "{} in {name}", scene.name);
        }
    }
}

/// The picture of a scene in the gallery, or its preview, as red, green and blue.
fn of_gallery(name: &str) -> Vec<u8> {
    let path = root().join("docs/gallery").join(name.trim_start_matches("preview-"));
    if !name.starts_with("preview-") {
        let stored = fs::read(path.with_extension("png")).unwrap();
        return Raster::decode(&stored).unwrap_or_else(|error| panic!("{name}: {error}")).rgb();
    }
    let arena = Bump::new();
    let scene = LoadedScene::open(&path.with_extension("ron"), &arena).unwrap();
    let settings = Settings { width: 320, height: 240, ..scene.settings };
    let options = RenderOptions { mode: Mode::Preview, ..RenderOptions::new(settings) };
    render(&scene.scene, &options).unwrap().rgb
}

/// The crate's book shows pictures of the gallery, and previews, at half their size, as PNGs in base64.
/// `RAYLINE_BLESS` writes the pictures.
#[test]
fn the_book_shows_the_gallery() {
    let mut seen = 0;
    for entry in fs::read_dir(root().join("core/src/book/pictures")).unwrap() {
        let shown = entry.unwrap().path();
        let name = shown.file_stem().unwrap().to_str().unwrap();
        let half = shrunk(&of_gallery(name), (320, 240), (160, 120)).concat();
        if std::env::var_os("RAYLINE_BLESS").is_some() {
            fs::write(&shown, BASE64_STANDARD.encode(to_png((160, 120), 3, &half).unwrap())).unwrap();
        }
        let text = fs::read_to_string(&shown).unwrap();
        let png = BASE64_STANDARD.decode(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let picture = Raster::decode(&png).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(picture.rgb() == half, "after a look: RAYLINE_BLESS=1 cargo test -p rayline-tests the_book");
        seen += 1;
    }
    assert!(seen >= 7, "{seen} pictures");
}
