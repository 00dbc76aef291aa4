//! The core in `f32` against POV-Ray, where it is installed.

use std::path::{Path, PathBuf};

use rayline::{LinearRgb, Material, Optics, Scene};
use rayline_tests::{
    Comparison, PovrayPicture, assert_alike, core_picture, ray_counts, settings, with_scene,
};

rayline_tests::each_scene!(check);

fn check(name: &str) {
    with_scene(name, |scene, bounces| {
        let settings = settings(bounces);
        let materials: Vec<Material> = scene.materials.iter().copied().map(as_in_povray).collect();
        let scene = &Scene { materials: &materials, ..*scene };
        let Some(povray) = PovrayPicture::render(scene, settings, &directory(), name) else { return };
        let core = core_picture::<f32>(scene, settings);
        if name.starts_with("teapot") {
            // No bar: handle and spout of teapot_s1 are pairs of triangles in one place, of which POV-Ray sees the
            // other one, and POV-Ray turns mirrored rays that would enter an interpolated surface.
            let alike = Comparison::new(&core, &povray.picture).alike;
            println!("{name:12} f32 / povray: {:.3} % of pixels alike", alike * 100.0);
        } else {
            assert_alike(&directory(), name, ("f32", &core), ("povray", &povray.picture));
        }
    });
}

/// The material without what POV-Ray computes in another way: it does not color highlights as it does mirrors, and light that
/// was mirrored inside of glass is not absorbed there.
fn as_in_povray(material: Material) -> Material {
    let Some(optics) = material.optics else { return material };
    let is_metal = optics.reflection_color != LinearRgb::WHITE;
    let optics = Box::leak(Box::new(Optics { absorption: LinearRgb::gray(0.0), ..*optics }));
    Material { optics: Some(optics), specular: if is_metal { 0.0 } else { material.specular }, ..material }
}

#[test]
fn ray_counts_of_balls_s3() {
    with_scene("balls_s3", |scene, bounces| {
        let settings = settings(bounces);
        let Some(povray) = PovrayPicture::render(scene, settings, &directory(), "balls_s3-counts") else {
            return;
        };
        let core = ray_counts(scene, settings);
        assert_eq!(core.camera, povray.reported("Pixels"));
        for (what, ours, theirs) in [
            // POV-Ray counts a mirrored ray before it looks whether that is one too many.
            (
                "reflected",
                core.reflected + core.cut_bounces + core.cut_throughput,
                povray.reported("Reflected Rays"),
            ),
            // It counts one for each transparent surface on the way to a light, but nothing is transparent here.
            ("shadow", core.shadow, povray.reported("Shadow Ray Tests")),
            // Rays from the eye and mirrored rays.
            (
                "camera and reflected",
                core.camera + core.reflected + core.cut_bounces + core.cut_throughput,
                povray.reported("Rays"),
            ),
        ] {
            println!("balls_s3     {what} rays: {ours} f32 / povray {theirs}");
            assert!(ours.abs_diff(theirs) * 10 <= theirs, "{what}");
        }
    });
}

fn directory() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("povray")
}
