//! The core in `f32` and in `f64` against the textbook renderer and against each other.

use std::path::Path;

use rayline_tests::{assert_alike, core_picture, settings, textbook::Textbook, with_scene};

rayline_tests::each_scene!(check);

fn check(name: &str) {
    with_scene(name, |scene, bounces| {
        let settings = settings(bounces);
        let single = core_picture::<f32>(scene, settings);
        let double = core_picture::<f64>(scene, settings);
        let textbook = Textbook::new(scene, settings).picture();
        let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
        assert_alike(directory, name, ("f32", &single), ("textbook", &textbook));
        assert_alike(directory, name, ("f64", &double), ("textbook", &textbook));
        assert_alike(directory, name, ("f32", &single), ("f64", &double));
    });
}
