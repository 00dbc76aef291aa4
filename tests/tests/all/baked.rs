//! Scenes as Rust source: it compiles, and it is the scene.

use std::fs;
use std::path::Path;

use rayline::{bake, builtin};

/// As a program for a board takes it in.
#[allow(dead_code, unreachable_pub)]
mod table {
    include!("../../baked/table.rs");
}

#[test]
fn the_source_is_the_scene() {
    let (is, was) = (table::SCENE, builtin::TABLE);
    assert_eq!((is.camera, is.background), (was.camera, was.background));
    assert_eq!((is.materials, is.lights), (was.materials, was.lights));
    assert_eq!(is.objects.len(), was.objects.len());
    assert_eq!(table::DESCRIPTION, was);
    // In its own set it takes no more memory than in that of all shapes.
    assert!(table::prepared_bytes::<f32>() <= was.bytes::<f32>());
}

#[test]
fn the_source_is_what_is_written_today() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("baked/table.rs");
    let source = bake::scene(&builtin::TABLE).unwrap();
    if std::env::var_os("RAYLINE_BLESS").is_some() {
        fs::write(&path, &source).unwrap();
    }
    assert!(
        fs::read_to_string(path).unwrap() == source,
        "tests/baked/table.rs is out of date: RAYLINE_BLESS=1 cargo test -p rayline-tests baked::"
    );
}

#[test]
fn a_scene_without_objects_is_refused() {
    let empty = rayline::Scene { objects: &[], ..builtin::TABLE };
    assert!(bake::scene(&empty).unwrap_err().to_string().contains("no objects"));
}
