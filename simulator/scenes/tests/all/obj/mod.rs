//! Tests with small files, valid and broken.

use core::mem::MaybeUninit;
use std::fs;
use std::path::Path;

use bumpalo::Bump;
use proptest::prelude::*;
use rayline::limits::MAX_COUNT;
use rayline::shape::{Mesh, Shape};
use rayline::{LinearRgb, Material, Optics, Part, PreparedScene, Texture, Vec3};
use rayline_formats::OpenOptions;
use rayline_formats::obj::{Import, read};

use crate::check;

mod maps;
mod odd;

/// A pyramid on a square, of two materials. The corners of the square have texture coordinates.
const PYRAMID: &str = "\
# a comment
mtllib colors.mtl
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1 # in the middle of a line
v 0 3 0 1.5
vt 0 0
vt 1
g base
usemtl red
f 1/1 2/2 3/1 4/2
g roof
usemtl glass
f -1 -2 \\
  -3
f 5 3 2
f 5 2 1
f 5 1 4
";

const COLORS: &str = "\
newmtl red
Kd 1 0 0
Ks 0.25 0.5 0.75
Ns 20
illum 2
newmtl glass
Kd 0.5
Ks 1
illum 3
Ns 500
d 0.25
Ni 1.5
";

/// Reads an OBJ file and an MTL file with these contents.
fn with_files<T>(obj: &str, mtl: &str, look: impl FnOnce(Result<Import<'_>, String>) -> T) -> T {
    let arena = Bump::new();
    look(import(&arena, obj, mtl))
}

fn import<'a>(arena: &'a Bump, obj: &str, mtl: &str) -> Result<Import<'a>, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.obj");
    fs::write(&path, obj).unwrap();
    fs::write(folder.path().join("colors.mtl"), mtl).unwrap();
    let clean = |text: &str| text.replace(&format!("{}/", folder.path().display()), "");
    let import = read(arena, &path, &OpenOptions::default());
    let mut import = import.map_err(|error| clean(&error.to_string()))?;
    import.notes.iter_mut().for_each(|note| *note = clean(note));
    Ok(import)
}

fn mesh<'a>(import: &Import<'a>, index: usize) -> Mesh<'a> {
    let Shape::Mesh(mesh) = import.scene.objects[index].shape else { unreachable!("only meshes are read") };
    mesh
}

#[test]
fn groups_are_meshes_that_share_their_vertices() {
    with_files(PYRAMID, COLORS, |import| {
        let import = import.unwrap();
        assert_eq!(import.scene.objects.len(), 2);
        let (base, roof) = (mesh(&import, 0), mesh(&import, 1));
        // Relative indices refer to the same five vertices.
        assert_eq!((base.vertices.len(), base.triangles), (4, &[[0, 1, 2], [0, 2, 3]][..]));
        assert_eq!((roof.vertices.len(), roof.triangles.len()), (5, 4));
        assert_eq!(roof.vertices[0], Vec3::new(0.0, 2.0, 0.0));
        // Where the second coordinate is missing, it is 0.
        assert_eq!(base.uvs, Some(&[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [1.0, 0.0]][..]));
        assert_eq!((roof.uvs, roof.normals), (None, None));
        assert_eq!(roof.triangles[..2], [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(import.name_of(Part::Object(1)), Some("roof"));
        assert_eq!(import.notes.len(), 1, "{:?}", import.notes);
    });
}

#[test]
fn a_comment_that_ends_in_a_backslash_ends_there() {
    with_files(&PYRAMID.replace("# a comment", "# from C:\\models\\"), COLORS, |import| {
        let import = import.unwrap();
        assert_eq!(import.notes.len(), 1, "{:?}", import.notes);
        assert_eq!(import.scene.materials.len(), 2);
    });
}

/// The expected material for an MTL file with nothing but a color.
fn plain(color: LinearRgb) -> Material<'static> {
    Material { ambient: 0.1, ..Material::matte(color) }
}

#[test]
fn materials_go_as_far_as_they_can() {
    with_files(PYRAMID, COLORS, |import| {
        let import = import.unwrap();
        let of = |index: usize| import.scene.materials[usize::from(import.scene.objects[index].material.0)];
        let shiny = Material { specular: 0.5, shininess: 20.0, ..plain(LinearRgb::new(1.0, 0.0, 0.0)) };
        assert_eq!(of(0), shiny);
        let glass = Material {
            ambient: 0.025,
            diffuse: 0.25,
            specular: 1.0,
            shininess: 500.0,
            reflectance: 0.25,
            transmittance: 0.75,
            ior: 1.5,
            ..Material::matte(LinearRgb::gray(0.5))
        };
        assert_eq!(of(1), glass);
    });
    let first = |mtl: &str, expected: Material<'_>| {
        with_files(PYRAMID, &format!("newmtl red\n{mtl}"), |import| {
            assert_eq!(import.unwrap().scene.materials[0], expected);
        });
    };
    let half =
        Material { ior: 0.14, transmittance: 0.5, diffuse: 0.5, ambient: 0.05, ..plain(LinearRgb::WHITE) };
    first("Kd 1 1 1\nTr 0.5\nNi 0", half);
    let emission = LinearRgb::new(2.0, 0.5, 0.0);
    let lamp = Material {
        optics: Some(&Optics { emission, ..Optics::PLAIN }),
        ..plain(LinearRgb::new(1.0, 0.8, 0.1))
    };
    // The emission is added to the color.
    first("Kd 1 0.8 0.1\nKe 2 0.5 0", lamp);
    // Without an exponent there is no highlight; colors by wavelength are not known.
    first("Kd spectral file.rfl 1\nKs 1 1 1\nd -halo 1.0\nKa 1 1 1", plain(LinearRgb::gray(0.7)));
}

#[test]
fn corners_without_a_normal_get_that_of_their_face() {
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nvn 0 0 -2\n";
    let (up, down) = (Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, 0.0, -2.0));
    let normalized = |normal: Vec3| normal.normalized().unwrap();
    with_files(&format!("{corners}f 1//1 2//1 3//1\nf 3//-1 2//1 4//1"), "", |import| {
        let import = import.unwrap();
        let smooth = mesh(&import, 0);
        // The third vertex has two normals, so it is stored twice.
        assert_eq!(smooth.vertices.len(), 5);
        assert_eq!(smooth.triangles, [[0, 1, 2], [3, 1, 4]]);
        assert_eq!(smooth.normals.unwrap(), [up, up, up, down, up]);
    });
    // The second face lies in the same plane, but is turned.
    with_files(&format!("{corners}f 1//1 2//1 3//1\nf 3 4 2"), "", |import| {
        let import = import.unwrap();
        assert_eq!(mesh(&import, 0).triangles, [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(mesh(&import, 0).normals.unwrap(), [up, up, up, down, down, down].map(normalized));
        assert_eq!(import.notes.len(), 1, "{:?}", import.notes);
    });
    // In a face with a normal, the others are on its side.
    with_files(&format!("{corners}f 3//1 4 2"), "", |import| {
        assert_eq!(mesh(&import.unwrap(), 0).normals.unwrap(), [up, up, up]);
    });
}

#[test]
fn vertices_have_colors() {
    let faces = "vt 0 0\nv 1 1 0\nf 1 2 3\n";
    const CODES: [[u8; 3]; 3] = [[255, 0, 128], [0, 51, 0], [255; 3]];
    for colored in
        ["v 0 0 0 1 0 0.502\nv 1 0 0 0 0.2 0\nv 0 1 0\n", "v 0 0 0 255 0 128\nv 1 0 0 1 0 51 0\nv 0 1 0\n"]
    {
        with_files(&format!("{colored}{faces}"), "", |import| {
            let import = import.unwrap();
            assert_eq!(mesh(&import, 0).colors, Some(&CODES[..]));
            // The vertices have the whole color.
            assert_eq!(import.scene.materials[0].color, Texture::Solid(LinearRgb::WHITE));
            assert_eq!(import.notes.len(), 1, "{:?}", import.notes);
        });
    }
    // White is no color.
    with_files(&format!("v 0 0 0 1 1 1\nv 1 0 0 1 1 1\nv 0 1 0\n{faces}"), "", |import| {
        let import = import.unwrap();
        assert_eq!(mesh(&import, 0).colors, None);
        assert_eq!(import.scene.materials[0].color, Texture::Solid(LinearRgb::gray(0.7)));
    });
    with_files(&format!("v 0 0 0 1 x 0\nv 1 0 0\nv 0 1 0\n{faces}"), "", |import| {
        let expected = "model.obj:1: the color of the vertex is left out, as it is no number";
        assert_eq!(import.unwrap().notes[0], expected);
    });
}

#[test]
fn texture_coordinates_are_kept_where_all_corners_have_some() {
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nvt 0 0.5\nvt 1 -2.5 7\nvt 59 3\n";
    with_files(&format!("{corners}f 1/1/1 2/2/1 3/1/1\nf 3/-3/1 2/-1/1 4/1/1"), "", |import| {
        let import = import.unwrap();
        let mesh = mesh(&import, 0);
        // At the seam, the second vertex is stored twice.
        assert_eq!(mesh.triangles, [[0, 1, 2], [2, 3, 4]]);
        assert_eq!(mesh.vertices[1], mesh.vertices[3]);
        let (first, second) = ([0.0, 0.5], [1.0, -2.5]);
        assert_eq!(mesh.uvs.unwrap(), [first, second, first, [59.0, 3.0], first]);
        assert!(mesh.normals.is_some());
        assert_eq!(import.notes.len(), 1, "{:?}", import.notes);
    });
    let left_out = |faces: &str, expected: &str| {
        with_files(&format!("{corners}vt 60\n{faces}"), "", |import| {
            let import = import.unwrap();
            assert_eq!(mesh(&import, 0).uvs, None);
            assert!(import.notes[0].ends_with(expected), "{:?}", import.notes);
        });
    };
    left_out(
        "f 1/1 2/2 3/1\nf 3 2 4",
        ": texture coordinates are left out: not all of its corners have them",
    );
    // From 0 to 150 in one face; reduced by 25, it still reaches beyond the limit.
    left_out("vt 150\nf 1/1 2/1 3/5", ": texture coordinates are left out: some are beyond ±59");
    with_files(&format!("{corners}vt 1000.25 -70.5\nf 1/4 2/4 3/4"), "", |import| {
        assert_eq!(mesh(&import.unwrap(), 0).uvs.unwrap(), [[0.25, 0.5]; 3]);
    });
}

#[test]
fn notes_list_what_is_left_out() {
    let obj = PYRAMID.replace("colors.mtl", "missing.mtl").replace("g roof", "l 1 2 3\nl 2 3\np 1");
    with_files(&obj, "", |import| {
        let notes = import.unwrap().notes;
        let expected = [
            "model.obj:13, and 1 more: `l` is left out",
            "model.obj:15: `p` is left out",
            "model.obj:2: `missing.mtl`: there is no such file; its materials are left out",
            "model.obj:11: `red`, and 1 more: there is no such material; it is gray",
        ];
        assert_eq!(notes[..4], expected);
        assert!(notes[4].starts_with("model.obj: OBJ files have no camera and no lights; "), "{notes:?}");
        assert_eq!(notes.len(), 5);
    });
}

#[test]
fn bad_files_are_refused_with_the_line() {
    let refused = |obj: &str, mtl: &str, expected: &str| {
        assert_eq!(with_files(obj, mtl, |import| import.map(|_| ()).unwrap_err()), expected);
    };
    for (from, to, expected) in [
        ("v 1 0 1\n", "v 1 x 1\n", "model.obj:5: expected a coordinate of the vertex, found `x`"),
        ("v 1 0 1\n", "v 1 0\n", "model.obj:5: the line ends where a coordinate of the vertex must follow"),
        ("v 1 0 1\n", "v 1 2e30 1\n", "model.obj:5: a coordinate is beyond ±1e30: `1 2e30 1`; replace it"),
        (
            "f 5 2 1",
            "f 6 2 1",
            "model.obj:18: there is no vertex `6`: there are 5, counted from 1; define it or correct the \
             number",
        ),
        (
            "f 5 2 1",
            "f 5 2 -6",
            "model.obj:18: there is no vertex `-6`: there are 5, counted from 1; define it or correct the \
             number",
        ),
        (
            "f 5 2 1",
            "f 5 2 0",
            "model.obj:18: there is no vertex `0`: there are 5, counted from 1; define it or correct the \
             number",
        ),
        (
            "f 5 2 1",
            "f 5 a 1",
            "model.obj:18: expected the number of a vertex, a texture coordinate or a normal, found `a`",
        ),
    ] {
        assert!(PYRAMID.contains(from));
        refused(&PYRAMID.replace(from, to), COLORS, expected);
    }
    refused("v 0 0 0\n", "", "model.obj: the file has no face with an area; check that it is an OBJ file");
    refused(
        "v 0 0 0\nf 1 1 1",
        "",
        "model.obj: the file has no face with an area; check that it is an OBJ file",
    );
}

#[test]
fn a_file_that_cannot_be_read_is_refused() {
    let error = read(&Bump::new(), Path::new("no/such.obj"), &OpenOptions::default()).unwrap_err();
    assert!(error.to_string().starts_with("cannot read no/such.obj: "), "{error}");
}

#[test]
fn more_vertices_than_a_mesh_may_have() {
    let side = 300;
    let mut text = String::new();
    for i in 0..side * side {
        text += &format!("v {} {} 0\n", i % side, i / side);
    }
    for i in (0..side * (side - 1)).filter(|i| i % side != side - 1) {
        text += &format!("f {} {} {} {}\n", i + 1, i + 2, i + 2 + side, i + 1 + side);
    }
    with_files(&text, "", |import| {
        let import = import.unwrap();
        let meshes: Vec<_> = (0..import.scene.objects.len()).map(|index| mesh(&import, index)).collect();
        assert_eq!(meshes.iter().map(|mesh| mesh.triangles.len()).sum::<usize>(), 2 * 299 * 299);
        assert!(meshes.len() >= 3 && meshes.iter().all(|mesh| mesh.vertices.len() <= MAX_COUNT));
    });
}

#[test]
fn the_whole_model_is_in_the_picture() {
    let long = PYRAMID.replace("v 1 0 1", "v 40 0 1");
    with_files(&long, COLORS, |import| {
        let scene = import.unwrap().scene;
        let camera = scene.camera;
        let forward = (camera.target - camera.eye).normalized().unwrap();
        let right = forward.cross(camera.up).normalized().unwrap();
        let up = right.cross(forward);
        let half = (camera.vertical_fov / 2.0).tan();
        let mut nearest_to_edge = 0.0f32;
        for object in scene.objects {
            let Shape::Mesh(mesh) = object.shape else { continue };
            for vertex in mesh.vertices {
                let seen = *vertex - camera.eye;
                let depth = seen.dot(forward) * half;
                assert!(depth > 0.0);
                let across = seen.dot(up).abs().max(seen.dot(right).abs() * 3.0 / 4.0);
                nearest_to_edge = nearest_to_edge.max(across / depth);
            }
        }
        assert!((0.6..0.95).contains(&nearest_to_edge), "{nearest_to_edge}");
    });
}

/// Random lines of a few words each, some of them valid statements.
fn lines_of(keywords: &'static [&'static str]) -> impl Strategy<Value = String> {
    let word = prop::sample::select(&[
        "1", "2", "3", "-1", "0", "0.5", "1//1", "2/1/1", "nan", "1e9", "a", "é", "\\", "#", "",
    ]);
    let line = (prop::sample::select(keywords), proptest::collection::vec(word, 0..5));
    let text = |(keyword, words): (&str, Vec<&str>)| format!("{keyword} {}\n", words.join(" "));
    proptest::collection::vec(line.prop_map(text), 0..20).prop_map(|lines| lines.concat())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text_is_refused_or_a_scene(
        obj in lines_of(
            &["v", "vn", "vt", "f 1 2 3", "f", "g", "usemtl", "usemtl a", "l", "surf", "s", "mtllib"],
        ),
        mtl in lines_of(&["newmtl", "newmtl a", "Kd", "Ks", "Ke", "Ns", "Ni", "d", "Tr", "illum", "map_Kd"]),
    ) {
        let triangle = "mtllib colors.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
        for (obj, mtl) in [(format!("{triangle}{obj}"), ""), (format!("{triangle}usemtl a\nf 1 2 \
                                                                       3"), &*mtl)] {
            with_files(&obj, mtl, |import| {
                if let Ok(Import { scene, .. }) = import {
                    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
                    let prepared = PreparedScene::<f32, _>::new(&scene, &mut memory);
                    prepared.unwrap_or_else(|error| unreachable!("{error}:\n{obj}\n{mtl}"));
                }
            });
        }
    }
}
