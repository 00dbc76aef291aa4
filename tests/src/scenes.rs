//! The scenes that tests compare: all built-in scenes, and all files in `scenes/`.

use std::path::PathBuf;

use bumpalo::Bump;
use rayline::{Scene, Settings, Transfer, builtin};

/// Makes a test for each scene, which is named after the scene and calls `check` with its name.
#[macro_export]
macro_rules! each_scene {
    ($check:ident) => {
        $crate::each_scene! {
            $check:
            classic whitted flake prism table
            balls_s1 balls_s2 balls_s3 mount_s1 rings_s1 teapot_s1 teapot_s2 tetra_s1 tetra_s2 tree_s1 tree_s2
        }
    };
    ($check:ident: $($name:ident)*) => {
        #[test]
        fn every_scene_has_a_test() {
            assert_eq!($crate::scene_names(), [$(stringify!($name)),*]);
        }

        $(#[test]
        fn $name() {
            $check(stringify!($name));
        })*
    };
}

/// The names of all built-in scenes, followed by those of the files in alphabetical order.
pub fn scene_names() -> Vec<String> {
    let mut files: Vec<String> = std::fs::read_dir(directory())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "nff"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    files.sort();
    let builtin = builtin::ALL.iter().map(|builtin| builtin.name.to_owned());
    builtin.chain(files).collect()
}

/// Calls `look` with a scene and the number of bounces that it was made for.
pub fn with_scene<T>(name: &str, look: impl FnOnce(&Scene<'_>, u8) -> T) -> T {
    if let Some(builtin) = builtin::ALL.iter().find(|builtin| builtin.name == name) {
        return look(builtin.scene, builtin.bounces);
    }
    let text = std::fs::read_to_string(directory().join(format!("{name}.nff"))).unwrap();
    let arena = Bump::new();
    let import = rayline_simulator::nff::parse(&arena, &text).unwrap();
    look(&import.scene, Settings::new(1, 1).bounces)
}

/// The settings for comparisons: 256×256 pixels in linear light, one ray through the center of each pixel.
pub fn settings(bounces: u8) -> Settings {
    Settings { bounces, transfer: Transfer::Linear, ..Settings::new(256, 256) }
}

fn directory() -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "scenes"].iter().collect()
}
