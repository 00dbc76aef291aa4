//! Tests of pictures on surfaces.

use rayline::{Ends, Figure, Image, Onto, Placed, Placement, Texture};

use super::*;
use rayline_formats::raster::to_png;

/// A square of two units with texture coordinates from 0 to 1.
const SQUARE: &str = "mtllib m.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                      usemtl m\nf 1/1 2/2 3/3 4/4\n";

/// Two pixels: red, and a half transparent white.
const PICTURE: [u8; 8] = [255, 0, 0, 255, 255, 255, 255, 128];

/// Reads the square with this material, beside the picture `Wood.png`.
fn with_material<T>(mtl: &str, look: impl FnOnce(Import<'_>) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("maps")).unwrap();
    for name in ["Wood.png", "maps/my wood.png"] {
        fs::write(folder.path().join(name), to_png((2, 1), 4, &PICTURE).unwrap()).unwrap();
    }
    fs::write(folder.path().join("m.mtl"), format!("newmtl m\n{mtl}\n")).unwrap();
    let path = folder.path().join("model.obj");
    fs::write(&path, SQUARE).unwrap();
    let arena = Bump::new();
    let mut import = read(&arena, &path, &OpenOptions::default()).unwrap();
    check(&import.scene).unwrap();
    let folder = format!("{}/", folder.path().display());
    import.notes.iter_mut().for_each(|note| *note = note.replace(&folder, ""));
    look(import)
}

fn image<'a>(texture: &Texture<'a>) -> (Image<'a>, Placement) {
    match texture {
        Texture::Placed(Placed { figure: Figure::Image(image), placement }) => (*image, *placement),
        other => unreachable!("{other:?}"),
    }
}

#[test]
fn a_picture_is_the_color_times_kd() {
    for name in [
        "Wood.png",
        "wood.PNG",
        ".\\Wood.png",
        "maps/my wood.png",
        "maps\\my wood.png",
        "-s 1 1 1 Wood.png",
        "-bm 1 -imfchan l -mm 0 1 -t 0 0 0 -texres 4 maps/my wood.png",
        "Wood.png -blendu on",
    ] {
        with_material(&format!("Kd 1 0.5 0\nmap_Kd {name}"), |import| {
            let material = import.scene.materials[0];
            let (image, placement) = image(&material.color);
            assert_eq!((image.width, image.height, image.ends), (2, 1, Ends::Repeat), "{name}");
            assert_eq!(placement, Placement::SURFACE);
            assert_eq!(image.light(0, 0), LinearRgb::new(1.0, 0.0, 0.0));
            let right = image.light(1, 0);
            assert!(
                (right.r - 1.0).abs() < 1e-6 && (right.g - 0.5).abs() < 4e-3 && right.b == 0.0,
                "{right:?}"
            );
            assert_eq!((material.ambient, material.diffuse), (0.1, 1.0));
            assert_eq!(import.notes.len(), 1, "{:?}", import.notes);
        });
    }
}

#[test]
fn options_place_the_picture() {
    with_material("map_Kd -s 2 4 1 -o 0.5 -0.25 0 Wood.png", |import| {
        let (_, placement) = image(&import.scene.materials[0].color);
        // u · 2 + 0.5 is 0 at u = -0.25, and 1 half a unit later. v · 4 - 0.25 repeats, as v · 4 + 0.75.
        assert_eq!(placement.size, Vec3::new(0.5, 0.25, 1.0));
        assert_eq!(placement.origin, Vec3::new(-0.25, -0.1875, 0.0));
    });
    with_material("map_Kd -clamp on -o 0.5 Wood.png", |import| {
        let (image, placement) = image(&import.scene.materials[0].color);
        assert_eq!((image.ends, placement.origin), (Ends::Extend, Vec3::new(-0.5, 0.0, 0.0)));
    });
    with_material("map_Kd -s 0 0 0 Wood.png", |import| {
        assert_eq!(image(&import.scene.materials[0].color).1, Placement::SURFACE);
        assert_eq!(import.notes[0], "m.mtl:2: `-s` and `-o` are left out: they are 0, or too small or large");
    });
}

#[test]
fn a_picture_that_is_not_there_is_a_note() {
    let note = |mtl: &str| with_material(mtl, |import| import.notes[0].clone());
    assert_eq!(note("map_Kd none.png"), "m.mtl:2: `none.png`: left out: there is no such picture");
    let outside = "not in the folder of the scene or below it";
    let expected = format!("m.mtl:2: `../none.png`: left out: {outside}; move it there");
    assert_eq!(note("map_Kd ../none.png"), expected);
    let expected = format!("m.mtl:2: `C:\\\\art\\\\Wood.png`: {outside}: the file of that name here is used");
    assert_eq!(note("map_Kd C:\\art\\Wood.png"), expected);
    assert_eq!(
        note("map_Kd m.mtl"),
        "m.mtl:2: `m.mtl`: left out: it is no PNG, JPEG or PPM file; convert it to one of them"
    );
    assert_eq!(note("disp Wood.png"), "m.mtl:2: `disp` is left out");
    assert_eq!(note("map_Ke Wood.png"), "m.mtl:2: `map_Ke` is left out");
    // A black base is meant to be covered: with and without the picture.
    with_material("Kd 0 0 0\nmap_Kd none.png", |import| {
        assert_eq!(import.scene.materials[0].color, Texture::Solid(LinearRgb::gray(0.7)));
    });
    with_material("Kd 0 0 0\nmap_Kd Wood.png", |import| {
        assert_eq!(image(&import.scene.materials[0].color).0.light(1, 0), LinearRgb::WHITE);
    });
}

#[test]
fn highlights_and_opacity_have_maps() {
    with_material("Kd 1 1 1\nKs 1 1 1\nNs 20\nillum 3\nmap_Ks Wood.png", |import| {
        let material = import.scene.materials[0];
        let [specular, reflectance] = material.maps else { unreachable!() };
        assert_eq!((specular.onto, reflectance.onto), (Onto::Specular, Onto::Reflectance));
        let (image, _) = image(&specular.texture);
        // The brightness of red is a quarter, in codes: 64 of 255, which is 0.0513 of the light.
        assert!((image.light(0, 0).r - 0.0513).abs() < 2e-3, "{:?}", image.light(0, 0));
        assert_eq!(image.light(1, 0), LinearRgb::WHITE);
    });
    with_material("Kd 1 1 1\nd 0.5\nmap_d Wood.png", |import| {
        let material = import.scene.materials[0];
        let [ambient, diffuse, specular, clear] = material.maps else { unreachable!() };
        assert_eq!([ambient.onto, diffuse.onto], [Onto::Ambient, Onto::Diffuse]);
        assert_eq!([specular.onto, clear.onto], [Onto::Specular, Onto::Transmittance]);
        // The picture has an opacity of its own: 255 and 128.
        let light = |texture: &Texture<'_>, column| image(texture).0.light(column, 0).r;
        assert_eq!((material.diffuse, material.transmittance), (0.5, 1.0));
        assert!((light(&diffuse.texture, 0) - 1.0).abs() < 1e-6);
        assert!((light(&diffuse.texture, 1) - 128.0 / 255.0).abs() < 1e-4);
        assert!((light(&clear.texture, 0) - 0.5).abs() < 4e-3);
        assert!((light(&clear.texture, 1) - 0.75).abs() < 4e-3);
    });
}

#[test]
fn bumps_are_as_high_as_their_pixels_are_wide() {
    for (keyword, factor) in [("map_Bump", 1.0), ("bump -bm 0.5", 0.5), ("map_bump -bm 3 -s 1 1 1", 3.0)] {
        with_material(&format!("{keyword} Wood.png"), |import| {
            let [map] = import.scene.materials[0].maps else { unreachable!() };
            let Onto::Bump { height, step } = map.onto else { unreachable!() };
            // Two pixels lie on two units.
            assert!((step - 1.0).abs() < 1e-6 && (height - 2.0 * factor).abs() < 1e-5, "{height} {step}");
        });
    }
}

#[test]
fn normal_maps_are_numbers() {
    with_material("norm Wood.png", |import| {
        let [map] = import.scene.materials[0].maps else { unreachable!() };
        assert_eq!(map.onto, Onto::Normal { strength: 1.0 });
        let (image, _) = image(&map.texture);
        assert_eq!(image.encoding, rayline::Encoding::Linear);
        assert_eq!(image.light(0, 0), LinearRgb::new(1.0, 0.0, 0.0));
    });
}

#[test]
fn a_picture_is_held_once() {
    let folder = tempfile::tempdir().unwrap();
    let side = 512u32;
    let pixels = vec![200; (side * side * 3) as usize];
    fs::write(folder.path().join("a.png"), to_png((side, side), 3, &pixels).unwrap()).unwrap();
    let (mut obj, mut mtl) = (SQUARE.replace("usemtl m\nf 1/1 2/2 3/3 4/4\n", ""), String::new());
    for index in 0..100 {
        obj += &format!("usemtl m{index}\nf 1/1 2/2 3/3 4/4\n");
        mtl += &format!("newmtl m{index}\nmap_Kd a.png\nNs {index}\n");
    }
    fs::write(folder.path().join("m.mtl"), mtl).unwrap();
    fs::write(folder.path().join("model.obj"), obj).unwrap();
    let arena = Bump::new();
    let import = read(&arena, &folder.path().join("model.obj"), &OpenOptions::default()).unwrap();
    assert_eq!(import.scene.materials.len(), 100);
    assert!(arena.allocated_bytes() < 5 * pixels.len(), "{}", arena.allocated_bytes());
}
