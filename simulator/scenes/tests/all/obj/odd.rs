//! Tests of odd lines, which are read as far as they can be, and of far, bent and smooth models.

use rayline::math::Aabb;
use rayline_formats::{ModelView, Up};
use rayline_scenes::LoadedScene;

use super::*;

/// A square of two units in the x-y plane, from -1 to 1.
const SQUARE: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";

/// The notes without the last one, which tells camera and light.
fn notes_of(obj: &str, mtl: &str) -> Vec<String> {
    with_files(obj, mtl, |import| {
        let mut notes = import.unwrap().notes;
        assert!(notes.pop().unwrap().contains("OBJ files have no camera"));
        notes
    })
}

/// The bounds of all objects.
fn bounds_of(import: &Import<'_>) -> [Vec3; 2] {
    let meshes = (0..import.scene.objects.len()).map(|index| mesh(import, index));
    let corners = meshes.flat_map(|Mesh { triangles, vertices, .. }| {
        triangles.as_flattened().iter().map(|corner| Aabb::point(vertices[usize::from(*corner)]))
    });
    let bounds = corners.reduce(Aabb::union).unwrap();
    [bounds.min, bounds.max]
}

/// The color of an object's material.
fn color_of(import: &Import<'_>, object: usize) -> LinearRgb {
    let material = import.scene.materials[usize::from(import.scene.objects[object].material.0)];
    match material.color {
        rayline::Texture::Solid(color) => color,
        _ => unreachable!("no picture is there"),
    }
}

#[test]
fn odd_lines_are_left_out_with_a_note() {
    let square = |before: &str, after: &str, expected: &[&str]| {
        let obj = format!("{before}{SQUARE}f 1 2 3 4\n{after}");
        assert_eq!(notes_of(&obj, ""), expected, "{obj}");
        with_files(&obj, "", |import| {
            let import = import.unwrap();
            assert_eq!(bounds_of(&import), [Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, 1.0, 0.0)]);
            assert_eq!(mesh(&import, 0).triangles, [[0, 1, 2], [0, 2, 3]]);
            assert_eq!((mesh(&import, 0).normals, mesh(&import, 0).uvs), (None, None));
        });
    };
    square("usemtl\n", "", &["model.obj:1: `usemtl` without a name"]);
    square("mtllib\n", "", &["model.obj:1: left out: `mtllib` without a name"]);
    square("", "f 1 2\nf 1\nf\n", &["model.obj:6, and 2 more: left out: a face of fewer than three corners"]);
    let nan = "left out: the normal has no direction";
    square(
        "vn -nan(ind) -nan(ind) 1\nvn 0 0 0\nvn 1.#QNAN 0 1\nvn 1 0\n",
        "",
        &[&format!("model.obj:1, and 3 more: {nan}")],
    );
    square(
        "vt nan 0\nvt 0 x\nvt\n",
        "",
        &["model.obj:1, and 2 more: left out: a texture coordinate is no number"],
    );
}

#[test]
fn faces_with_a_vertex_that_is_no_number_are_left_out() {
    let obj = format!("{SQUARE}v nan 0 0\nv 1 2 3 0\nf 1 2 3 4\nf 1 2 5\nf 1 2 6\n");
    let expected = "model.obj:8, and 1 more: left out: a face with a vertex that is no number";
    assert_eq!(notes_of(&obj, ""), [expected]);
}

#[test]
fn texture_coordinates_and_normals_that_are_not_there_are_left_out() {
    let obj = "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/7 2/2/-1 3/3/x\n";
    let expected = [
        "model.obj:4: a texture coordinate that is not there is left out",
        "model.obj:4: a normal that is not there is left out",
    ];
    assert_eq!(notes_of(obj, ""), expected);
    with_files(obj, "", |import| {
        let import = import.unwrap();
        let mesh = mesh(&import, 0);
        assert_eq!((mesh.triangles, mesh.uvs, mesh.normals), (&[[0, 1, 2]][..], None, None));
    });
}

#[test]
fn faces_may_come_before_their_vertices() {
    with_files("f 1/1/1 2/1/1 3/1/1\nv -1 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nvn 0 0 1\n", "", |import| {
        let import = import.unwrap();
        assert_eq!(bounds_of(&import), [Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 0.0)]);
        assert_eq!(mesh(&import, 0).uvs.unwrap(), [[0.5; 2]; 3]);
        assert_eq!(mesh(&import, 0).normals.unwrap(), [Vec3::new(0.0, 0.0, 1.0); 3]);
        assert_eq!(import.notes.len(), 1, "{:?}", import.notes);
    });
}

#[test]
fn lines_may_end_in_a_carriage_return() {
    with_files("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", "", |import| {
        assert_eq!(mesh(&import.unwrap(), 0).triangles, [[0, 1, 2]]);
    });
}

#[test]
fn lines_that_are_not_utf8_are_latin_1() {
    let folder = tempfile::tempdir().unwrap();
    let obj = format!("# Stra\u{1}e\nmtllib m.mtl\n{SQUARE}usemtl gr\u{2}n\nf 1 2 3 4\n");
    let latin = |text: &str| {
        let replaced = text.bytes().map(|byte| match byte {
            1 => 0xdf,
            2 => 0xfc,
            byte => byte,
        });
        replaced.collect::<Vec<u8>>()
    };
    fs::write(folder.path().join("model.obj"), latin(&obj)).unwrap();
    // The MTL file is in UTF-8, and has a comment behind the name.
    fs::write(folder.path().join("m.mtl"), "newmtl grün # gras\nKd 0 1 0\n").unwrap();
    let arena = Bump::new();
    let import = read(&arena, &folder.path().join("model.obj"), &OpenOptions::default()).unwrap();
    assert_eq!(color_of(&import, 0), LinearRgb::new(0.0, 1.0, 0.0));
    let first = &import.notes[0];
    assert!(
        first.ends_with("model.obj:1, and 1 more: not UTF-8, so read as Latin-1 (Windows-1252)"),
        "{first}"
    );
    assert_eq!(import.notes.len(), 2, "{:?}", import.notes);
    // The other way around.
    fs::write(folder.path().join("m.mtl"), latin("newmtl gr\u{2}n\nKd 0 1 0\n")).unwrap();
    let import = read(&arena, &folder.path().join("model.obj"), &OpenOptions::default()).unwrap();
    assert_eq!(color_of(&import, 0), LinearRgb::new(0.0, 1.0, 0.0));
}

#[test]
fn names_may_hold_a_number_sign() {
    let obj =
        format!("mtllib colors.mtl\n{SQUARE}usemtl Material #1\nf 1 2 3\nusemtl Material #2\nf 1 3 4\n");
    with_files(&obj, "newmtl Material #1\nKd 1 0 0\nnewmtl Material #2\nKd 0 0.5 1\n", |import| {
        let import = import.unwrap();
        assert_eq!(color_of(&import, 0), LinearRgb::new(1.0, 0.0, 0.0));
        assert_eq!(color_of(&import, 1), LinearRgb::new(0.0, 0.5, 1.0));
    });
    // A material that is not there is not taken for its neighbor.
    with_files(&obj, "newmtl Material #1\nKd 1 0 0\nnewmtl Material\nKd 0 0.5 1\n", |import| {
        let import = import.unwrap();
        assert_eq!(color_of(&import, 1), LinearRgb::gray(0.7));
        assert_eq!(import.notes[0], "model.obj:8: `Material #2`: there is no such material; it is gray");
    });
    // Comments are comments all the same.
    let obj = format!("mtllib colors.mtl\n{SQUARE}usemtl a # the first\nf 1 2 3 # \\\nusemtl b\nf 1 3 4#x\n");
    with_files(&obj, "newmtl a\nKd 1 0 0\nnewmtl b #second\nKd 0 0.5 1\n", |import| {
        let import = import.unwrap();
        assert_eq!(color_of(&import, 0), LinearRgb::new(1.0, 0.0, 0.0));
        assert_eq!(color_of(&import, 1), LinearRgb::new(0.0, 0.5, 1.0));
    });
}

#[test]
fn libraries_are_found_however_they_are_written() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    for name in ["Plain.mtl", "my file.mtl", "sub/deep.mtl"] {
        fs::write(folder.path().join(name), "newmtl m\nKd 1 0 0\n").unwrap();
    }
    let color = |name: &str| {
        let path = folder.path().join("model.obj");
        fs::write(&path, format!("mtllib {name}\n{SQUARE}usemtl m\nf 1 2 3 4\n")).unwrap();
        let arena = Bump::new();
        let import = read(&arena, &path, &OpenOptions::default()).unwrap();
        (color_of(&import, 0), import.notes.len())
    };
    let red = LinearRgb::new(1.0, 0.0, 0.0);
    for name in [
        ".\\Plain.mtl",
        "plain.MTL",
        "my file.mtl",
        "my\\ file.mtl",
        "\"my file.mtl\"",
        "sub\\deep.mtl",
        "SUB/deep.mtl",
        "Plain.mtl my\\ file.mtl",
    ] {
        assert_eq!(color(name), (red, 1), "{name}");
    }
    assert_eq!(color("none.mtl Plain.mtl"), (red, 2));
    // Another folder is not read; a file of that name here is.
    assert_eq!(color("C:\\models\\Plain.mtl"), (red, 2));
    assert_eq!(color("../../etc/passwd"), (LinearRgb::gray(0.7), 3));
}

#[test]
fn odd_lines_of_materials_are_left_out_with_a_note() {
    let obj = format!("mtllib colors.mtl\n{SQUARE}usemtl a\nf 1 2 3 4\n");
    let mtl = "Kd 1 1 1\nNs 3\nnewmtl a\nNs\nNs x\nNi\nd nan\nKd 0.2 0.7 0.3\nKs 1 x 1\nillum\n";
    let expected = [
        "colors.mtl:1: left out: there is no `newmtl` before this line",
        "colors.mtl:4, and 1 more: left out: `Ns` without a number",
        "colors.mtl:6: left out: `Ni` without a number",
        "colors.mtl:7: left out: `d` without a number",
        "colors.mtl:9: left out: `Ks` without a number",
        "colors.mtl:10: left out: `illum` without a number",
    ];
    assert_eq!(notes_of(&obj, mtl), expected);
    with_files(&obj, mtl, |import| {
        assert_eq!(import.unwrap().scene.materials, [plain(LinearRgb::new(0.2, 0.7, 0.3))]);
    });
    // A material without a name is that of `usemtl` without one.
    with_files(&obj.replace("usemtl a", "usemtl"), "newmtl\nKd 0 0 1", |import| {
        assert_eq!(color_of(&import.unwrap(), 0), LinearRgb::new(0.0, 0.0, 1.0));
    });
}

#[test]
fn tr_1_means_opaque_unless_illum_asks_for_transparency() {
    let obj = format!("mtllib colors.mtl\n{SQUARE}usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
    let transmittance = |mtl: &str| {
        with_files(&obj, &format!("newmtl a\nKd 1 0 0\n{mtl}\nnewmtl b"), |import| {
            let import = import.unwrap();
            (import.scene.materials[0].transmittance, import.notes.len() - 1)
        })
    };
    for (mtl, expected) in [
        ("Tr 1.0\nillum 2", (0.0, 1)),
        ("illum 2\nTr 1.0", (0.0, 1)),
        ("Tr 1", (0.0, 1)),
        ("Tr 0\nillum 2", (0.0, 0)),
        ("d 1\nTr 1", (0.0, 0)),
        ("Tr 1\nd 0.25", (0.75, 0)),
        ("Tr 0.25", (0.25, 0)),
        ("Tr 1\nillum 4", (1.0, 0)),
        ("d 0", (1.0, 0)),
    ] {
        assert_eq!(transmittance(mtl), expected, "{mtl}");
    }
}

#[test]
fn no_model_is_invisible_as_a_whole() {
    let obj = format!("mtllib colors.mtl\n{SQUARE}usemtl a\nf 1 2 3 4\n");
    for mtl in ["d 0", "Tr 1\nillum 4", "d 0\nKs 1 1 1"] {
        with_files(&obj, &format!("newmtl a\nKd 1 0 0\n{mtl}"), |import| {
            let import = import.unwrap();
            assert_eq!(import.scene.materials, [plain(LinearRgb::new(1.0, 0.0, 0.0))]);
            assert_eq!(import.notes[0], "model.obj: all of the model would be invisible, so it is opaque");
        });
    }
    // Glass is seen.
    with_files(&obj, "newmtl a\nd 0\nNi 1.5", |import| {
        assert_eq!(import.unwrap().scene.materials[0].transmittance, 1.0);
    });
}

/// The area of an object.
fn area_of(import: &Import<'_>, object: usize) -> f64 {
    let mesh = mesh(import, object);
    let area = |[a, b, c]: [Vec3; 3]| (b - a).to::<f64>().cross((c - a).to::<f64>()).length() / 2.0;
    let triangles = mesh.triangles.iter();
    triangles.map(|triangle| area(triangle.map(|corner| mesh.vertices[usize::from(corner)]))).sum()
}

#[test]
fn notches_of_faces_stay_open() {
    // A V. By shoelace its area is 6; a fan around the first corner covers 8.
    let v = "v 0 0 0\nv 1 2 0\nv 2 0 0\nv 2 3 0\nv 1 5 0\nv 0 3 0\nf 1 2 3 4 5 6\n";
    with_files(v, "", |import| {
        let import = import.unwrap();
        assert!((area_of(&import, 0) - 6.0).abs() < 1e-9);
        assert_eq!(import.notes.len(), 1, "{:?}", import.notes);
    });
    let crossed = "v 0 0 0\nv 3 3 0\nv 3 0 0\nv 0 2 0\nf 1 2 3 4\n";
    assert_eq!(
        notes_of(crossed, ""),
        ["model.obj:5: cut as a fan: a face that crosses itself, or has notches and more than 65536 corners"]
    );
}

#[test]
fn a_hundred_thousand_continued_lines_take_linear_time() {
    // A polygon of as many corners on a circle, and one that is not convex.
    let count = 100_000;
    let mut text = String::new();
    for i in 0..count {
        let (angle, radius) =
            (i as f64 / count as f64 * core::f64::consts::TAU, if i % 2 == 0 { 1.0 } else { 0.9 });
        let (x, y) = (angle.cos(), angle.sin());
        text += &format!("v {x} {y} 0\nv {} {} 1\n", x * radius, y * radius);
    }
    for first in [1, 2] {
        text += "f";
        for i in 0..count {
            text += &format!(" \\\n{}", 2 * i + first);
        }
        text += "\n";
    }
    // A triangle that is gone around as often.
    text += "f 1 2 4";
    text += &" \\\n1 2 4".repeat(count);
    text += "\nv 0 0 0";
    text += &"\\\n".repeat(count);
    let start = std::time::Instant::now();
    with_files(&text, "", |import| assert!(import.unwrap().scene.objects.len() > 1));
    assert!(start.elapsed().as_secs_f32() < 3.0, "{:?}", start.elapsed());
}

#[test]
fn a_face_that_goes_around_again_is_cut_once() {
    with_files("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 1 2 3 1 2 3\n", "", |import| {
        assert_eq!(mesh(&import.unwrap(), 0).triangles, [[0, 1, 2]]);
    });
}

#[test]
fn far_models_come_to_the_origin() {
    // Easting and northing of a photogrammetry program; f32 would round them by half a unit.
    let utm =
        "v 456789.1 5412345.0 210.0\nv 456799.1 5412345.0 210.0\nv 456799.1 5412355.25 212.0\nf 1 2 3\n";
    with_files(utm, "", |import| {
        let import = import.unwrap();
        let [a, b, c] = *mesh(&import, 0).vertices else { unreachable!() };
        assert_eq!((a, b), (Vec3::new(-4.9, -5.0, -1.0), Vec3::new(5.1, -5.0, -1.0)));
        assert_eq!(c, Vec3::new(5.1, 5.25, 1.0));
        let moved = "model.obj: moved by -456794, -5412350, -211, as a scene reaches from -1e6 to 1e6";
        assert_eq!(import.notes[0], moved);
        check(&import.scene).unwrap();
    });
    // A model in thousandths, with an unused vertex far away.
    with_files("v 0 0 0\nv 4e7 0 0\nv 0 3e7 0\nv 1e20 0 0\nf 1 2 3\n", "", |import| {
        let import = import.unwrap();
        assert_eq!(bounds_of(&import)[1], Vec3::new(2e4, 1.5e4, 0.0));
        check(&import.scene).unwrap();
    });
    with_files("v 0 0 0\nv 9e5 0 0\nv 0 9e5 0\nf 1 2 3\n", "", |import| {
        check(&import.unwrap().scene).unwrap()
    });
}

#[test]
fn smoothing_groups_have_the_normals_of_their_vertices() {
    // A roof of two squares that meet at a right angle in the line from vertex 3 to vertex 4.
    let roof = "v -1 0 0\nv -1 0 1\nv 0 1 1\nv 0 1 0\nv 1 0 1\nv 1 0 0\n";
    let half = core::f32::consts::FRAC_1_SQRT_2;
    let near = |a: Vec3, b: Vec3| assert!((a - b).length() < 1e-6, "{a:?} is not {b:?}");
    let (left, right) = (Vec3::new(-half, half, 0.0), Vec3::new(half, half, 0.0));
    with_files(&format!("{roof}s 1\nf 1 2 3 4\nf 4 3 5 6\n"), "", |import| {
        let import = import.unwrap();
        let mesh = mesh(&import, 0);
        // The ridge is shared.
        assert_eq!((mesh.vertices.len(), import.notes.len()), (6, 1));
        for (vertex, normal) in mesh.vertices.iter().zip(mesh.normals.unwrap()) {
            near(
                *normal,
                if vertex.x == 0.0 {
                    Vec3::new(0.0, 1.0, 0.0)
                } else if vertex.x < 0.0 {
                    left
                } else {
                    right
                },
            );
        }
    });
    // Of two groups, each is smooth by itself.
    with_files(&format!("{roof}s 1\nf 1 2 3 4\ns 2\nf 4 3 5 6\n"), "", |import| {
        let import = import.unwrap();
        let normals = mesh(&import, 0).normals.unwrap();
        assert_eq!(normals.len(), 8);
        normals[..4].iter().for_each(|normal| near(*normal, left));
        normals[4..].iter().for_each(|normal| near(*normal, right));
    });
    for off in ["off", "0", "", "s"] {
        with_files(&format!("{roof}s 1\ns {off}\nf 1 2 3 4\nf 4 3 5 6\n"), "", |import| {
            assert_eq!(mesh(&import.unwrap(), 0).normals, None, "{off}");
        });
    }
    // Groups and materials do not end a smoothing group, and normals of the file come first.
    with_files(&format!("{roof}vn 0 0 1\ns 1\nf 1//1 2//1 3 4\ng b\nf 4 3 5 6\n"), "", |import| {
        let import = import.unwrap();
        let normals = mesh(&import, 0).normals.unwrap();
        assert_eq!(normals[..2], [Vec3::new(0.0, 0.0, 1.0); 2]);
        near(normals[2], Vec3::new(0.0, 1.0, 0.0));
        near(mesh(&import, 1).normals.unwrap()[1], Vec3::new(0.0, 1.0, 0.0));
    });
}

#[test]
fn a_corner_weighs_as_much_as_its_angle() {
    // A box corner: the side on the left is two triangles, which together weigh as much as the other sides.
    let corner = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 1 1\nv 0 0 1\nv 1 0 1\n\
                  s 1\nf 1 4 3 2\nf 1 6 5\nf 1 5 4\nf 1 2 7 6\n";
    with_files(corner, "", |import| {
        let import = import.unwrap();
        let third = -(1f32 / 3.0).sqrt();
        let normal = mesh(&import, 0).normals.unwrap()[0];
        assert!((normal - Vec3::new(third, third, third)).length() < 1e-6, "{normal:?}");
    });
}

#[test]
fn models_stand_on_the_axis_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tower.obj");
    fs::write(&path, "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 0 0 5\nf 1 2 4\nf 2 3 4\nf 3 1 4\n").unwrap();
    let arena = Bump::new();
    let open = |up, from| {
        let view = ModelView { up: Some(up), from };
        LoadedScene::open_with(&path, &OpenOptions { view, ..OpenOptions::default() }, &arena).unwrap().scene
    };
    let scene = open(Up::Z, None);
    assert_eq!(scene.camera.up, Vec3::new(0.0, 0.0, 1.0));
    // The front is the side of -y, and the camera is above and to the right of it.
    let toward = scene.camera.eye - scene.camera.target;
    assert!(toward.y < 0.0 && toward.x > 0.0 && toward.z > 0.0, "{toward:?}");
    for (up, from, expected) in [
        (Up::Y, (0.0, 0.0), Vec3::new(0.0, 0.0, 1.0)),
        (Up::Y, (90.0, 0.0), Vec3::new(1.0, 0.0, 0.0)),
        (Up::Z, (180.0, 0.0), Vec3::new(0.0, 1.0, 0.0)),
        (Up::Z, (30.0, 90.0), Vec3::new(0.0, 0.0, 1.0)),
        (Up::MinusX, (0.0, 90.0), Vec3::new(-1.0, 0.0, 0.0)),
        (Up::MinusY, (0.0, -90.0), Vec3::new(0.0, 1.0, 0.0)),
        (Up::MinusZ, (0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)),
        (Up::X, (0.0, 90.0), Vec3::new(1.0, 0.0, 0.0)),
    ] {
        let scene = open(up, Some(from));
        check(&scene).unwrap();
        let toward = (scene.camera.eye - scene.camera.target).normalized().unwrap();
        assert!((toward - expected).length() < 1e-3, "{up:?} {from:?}: {toward:?}");
    }
    let view = ModelView { up: Some(Up::Z), from: None };
    let options = OpenOptions { view, ..OpenOptions::default() };
    let error = LoadedScene::open_with(Path::new("classic"), &options, &arena).unwrap_err();
    let expected = "classic has a camera of its own, but --up and --from are for models without one; leave \
                    them out";
    assert_eq!(error.to_string(), expected);
}
