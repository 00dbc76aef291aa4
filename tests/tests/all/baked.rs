//! Tests of scenes as Rust source: the source compiles and is the same scene.

use std::fs;
use std::mem::MaybeUninit;
use std::path::Path;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayline::bake::{self, BakedNumber};
use rayline::math::Fixed;
use rayline::shape::Geometry;
use rayline::{
    Digest, Fault, Part, PreparedScene, Real, Renderer, Scene, SceneError, Settings, Vec3, builtin,
};

/// Included as in a program for a board.
#[allow(dead_code, unreachable_pub)]
mod table {
    include!("../../baked/table.rs");
}
#[allow(dead_code, unreachable_pub)]
mod mesh_f32 {
    include!("../../baked/mesh_f32.rs");
}
#[allow(dead_code, unreachable_pub)]
mod mesh_fixed {
    include!("../../baked/mesh_fixed.rs");
}

#[test]
fn the_source_is_the_scene() {
    let (is, was) = (table::SCENE, builtin::TABLE);
    assert_eq!((is.camera, is.background), (was.camera, was.background));
    assert_eq!((is.materials, is.lights), (was.materials, was.lights));
    assert_eq!(is.objects.len(), was.objects.len());
    assert_eq!(table::DESCRIPTION, was);
    assert_eq!((mesh_f32::DESCRIPTION, mesh_fixed::DESCRIPTION), (builtin::MESH, builtin::MESH));
    // In its own set the scene takes no more memory than in the set of all shapes.
    assert!(table::prepared_bytes::<f32>() <= was.bytes::<f32>());
}

/// The digest of a small picture, drawn with this many bytes of memory.
fn digest<R: Real, S: Geometry>(scene: &Scene<'static, S>, bytes: usize) -> Result<u64, SceneError> {
    let mut memory = vec![MaybeUninit::uninit(); bytes];
    let prepared = PreparedScene::<R, S>::new(scene, &mut memory)?;
    let settings = Settings { bounces: 3, ..Settings::new(64, 48) };
    let renderer = Renderer::new(&prepared, settings).unwrap();
    let mut digest = Digest::new();
    let mut line = [Rgb888::BLACK; 64];
    for y in 0..48 {
        renderer.line(y, &mut line).unwrap();
        line.iter().for_each(|pixel| digest.update(&[pixel.r(), pixel.g(), pixel.b()]));
    }
    Ok(digest.value())
}

#[test]
fn baked_meshes_are_the_same_and_take_no_memory() {
    let mesh = builtin::MESH;
    let baked = digest::<f32, _>(&mesh_f32::SCENE, mesh_f32::prepared_bytes::<f32>());
    assert_eq!(baked, digest::<f32, _>(&mesh, mesh.bytes::<f32>()));
    let fixed = digest::<Fixed, _>(&mesh_fixed::SCENE, mesh_fixed::prepared_bytes::<Fixed>());
    assert_eq!(fixed, digest::<Fixed, _>(&mesh, mesh.bytes::<Fixed>()));
    // The mesh has 80 triangles.
    assert!(mesh_f32::prepared_bytes::<f32>() + 40 * 80 < mesh.bytes::<f32>());
}

#[test]
fn meshes_baked_for_another_scene_are_refused() {
    let refusal = Err(SceneError { part: Part::Object(1), fault: Fault::BakedOtherwise });
    assert_eq!(digest::<Fixed, _>(&mesh_f32::SCENE, 9999), refusal);
    assert_eq!(digest::<f32, _>(&mesh_fixed::SCENE, 9999), refusal);
    // With a camera far away, the scene has a smaller scale in fixed point.
    let mut camera = mesh_fixed::SCENE.camera;
    camera.eye = Vec3::new(0.0, 900.0, 900.0);
    assert_eq!(digest::<Fixed, _>(&Scene { camera, ..mesh_fixed::SCENE }, 9999), refusal);
}

fn is_up_to_date<N: BakedNumber>(name: &str, scene: &Scene<'_>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("baked").join(name);
    let source = bake::scene::<N>(scene).unwrap();
    if std::env::var_os("RAYLINE_BLESS").is_some() {
        fs::write(&path, &source).unwrap();
    }
    assert!(
        fs::read_to_string(path).unwrap() == source,
        "tests/baked/{name} is out of date: RAYLINE_BLESS=1 cargo test -p rayline-tests baked::"
    );
}

#[test]
fn the_baked_sources_are_up_to_date() {
    is_up_to_date::<f32>("table.rs", &builtin::TABLE);
    is_up_to_date::<f32>("mesh_f32.rs", &builtin::MESH);
    is_up_to_date::<Fixed>("mesh_fixed.rs", &builtin::MESH);
}

#[test]
fn a_scene_without_objects_is_refused() {
    let empty = Scene { objects: &[], ..builtin::TABLE };
    assert!(bake::scene::<f32>(&empty).unwrap_err().to_string().contains("no objects"));
}
