//! Tests of the settings that a scene in NFF gets.

use bumpalo::Bump;
use rayline::{Settings, Transfer};
use rayline_scenes::{FILE_SETTINGS, LoadedScene, ron};

const VIEW: &str = "v from 0 0 5 at 0 0 0 up 0 1 0 angle 90 hither 1 resolution 40 30\n";

#[test]
fn colors_are_codes() {
    let (arena, folder) = (Bump::new(), tempfile::tempdir().unwrap());
    let path = folder.path().join("sky.nff");
    std::fs::write(&path, format!("{VIEW}b 0.078 0.361 0.753")).unwrap();
    let LoadedScene { scene, settings, .. } = LoadedScene::open(&path, &arena).unwrap();
    assert_eq!(settings, Settings { transfer: Transfer::Linear, ..Settings::new(40, 30) });
    let text = ron::write(&scene, &settings, &FILE_SETTINGS).unwrap();
    assert!(text.contains("transfer: Linear"), "{text}");
    let path = folder.path().join("sky.ron");
    std::fs::write(&path, text).unwrap();
    assert_eq!(LoadedScene::open(&path, &arena).unwrap().settings.transfer, Transfer::Linear);
}
