//! Tests of files that are refused, and of the part in the error.

use std::path::Path;

use rayline_formats::gltf::read;

use super::*;

/// Asserts the error of the cube's file after a change.
fn refused(change: impl FnOnce(&mut Value), expected: &str) {
    let mut file = cube();
    change(&mut file);
    assert_eq!(refusal(&file), format!("model.gltf: {expected}"));
}

#[test]
fn binary_files_are_read() {
    with_bytes("model.glb", &binary_cube(), |import| {
        let import = import.unwrap();
        assert_eq!((mesh(&import, 0).vertices.len(), mesh(&import, 0).triangles.len()), (8, 12));
        assert_eq!(mesh(&import, 0).triangles, CUBE);
    });
    // A file without a binary chunk, and one with an unknown chunk.
    let json = cube().to_string();
    for chunks in [&[(b"JSON", json.as_bytes())][..], &[(b"JSON", json.as_bytes()), (b"XMAS", b"ho ho ho")]] {
        with_bytes("model.glb", &binary(chunks), |import| assert_eq!(import.unwrap().scene.objects.len(), 1));
    }
}

#[test]
fn binary_files_that_are_cut_off_are_refused() {
    let file = binary_cube();
    for length in 0..file.len() {
        let error = with_bytes("model.glb", &file[..length], |import| import.map(|_| ()).unwrap_err());
        let expected = match length {
            // Too short for the mark of a binary file, so it is read as JSON.
            0..4 => "model.glb: ".to_owned(),
            4..12 => {
                format!("model.glb: it should have 12 bytes, but has {length}; copy the file again")
            }
            _ => format!(
                "model.glb: it should have {} bytes, but has {length}; copy the file again",
                file.len()
            ),
        };
        assert!(error.starts_with(&expected), "{length}: {error}");
    }
    let refused = |file: &[u8], expected: &str| {
        let error = with_bytes("model.glb", file, |import| import.map(|_| ()).unwrap_err());
        assert_eq!(error, format!("model.glb: {expected}"));
    };
    let mut wrong = file.clone();
    wrong[12] = 0xff;
    wrong[15] = 0xff;
    let given = file.len() - 20;
    let needed = u32::from_le_bytes([0xff, file[13], file[14], 0xff]);
    refused(
        &wrong,
        &format!("first chunk: it should have {needed} bytes, but has {given}; copy the file again"),
    );
    let mut wrong = file.clone();
    wrong[4] = 1;
    refused(&wrong, "its version is `1`; export it again as glTF 2.0");
    let mut wrong = file.clone();
    wrong[16] = b'X';
    refused(&wrong, "it does not begin with its JSON; export the file again");
    // A length field of 0 ends the file before its first chunk.
    let mut wrong = file;
    wrong[8..12].fill(0);
    let length = wrong.len();
    refused(&wrong, &format!("it should have 0 bytes, but has {length}; copy the file again"));
}

#[test]
fn other_formats_are_refused() {
    refused(
        |file| file["asset"]["version"] = json!("1.0"),
        "its version is `1.0`; export it again as glTF 2.0",
    );
    refused(
        |file| file["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]),
        "it needs the extension `KHR_draco_mesh_compression`, which is not supported; export it without",
    );
    refused(
        |file| file["nodes"] = json!([]),
        "there is no node 0: there are 0, counted from 0; correct the number",
    );
    refused(
        |file| file["nodes"] = json!([{}]),
        "the scene has no triangle with an area; check that it is the right file",
    );
    let error = with_bytes("model.gltf", b"solid cube", |import| import.map(|_| ()).unwrap_err());
    assert_eq!(error, "model.gltf: expected value at line 1 column 1; correct the file");
    let error = read(&Bump::new(), Path::new("no/such.glb"), &OpenOptions::default()).unwrap_err();
    assert!(error.to_string().starts_with("cannot read no/such.glb: "), "{error}");
}

#[test]
fn parts_that_do_not_exist_are_named() {
    let cube = "node 0 `Box`, mesh 0 `Cube`, primitive 0";
    let there_is_no = |what: &str| format!("there is no {what}, counted from 0; correct the number");
    let check = |path: &str, value: Value, place: &str, what: &str| {
        let expected =
            if place.is_empty() { there_is_no(what) } else { format!("{place}: {}", there_is_no(what)) };
        refused(|file| *file.pointer_mut(path).unwrap() = value, &expected);
    };
    check("/scene", json!(3), "", "scene 3: there are 1");
    check("/scenes/0/nodes", json!([9]), "", "node 9: there are 1");
    check("/nodes/0/mesh", json!(1), "node 0 `Box`", "mesh 1: there are 1");
    check("/meshes/0/primitives/0/material", json!(5), cube, "material 5: there are 1");
    check("/meshes/0/primitives/0/attributes/POSITION", json!(7), cube, "accessor 7: there are 2");
    check(
        "/meshes/0/primitives/0/indices",
        json!(4_000_000_000u32),
        cube,
        "accessor 4000000000: there are 2",
    );
    let position = format!("{cube}, POSITION, accessor 0");
    check("/accessors/0/bufferView", json!(2), &position, "buffer view 2: there are 2");
    check("/bufferViews/0/buffer", json!(1), &format!("{position}, buffer view 0"), "buffer 1: there are 1");
    refused(
        |file| file["nodes"][0]["children"] = json!([7]),
        "node 0 `Box`: there is no node 7: there are 1, counted from 0; correct the number",
    );
    refused(
        |file| file["nodes"][0]["camera"] = json!(0),
        "node 0 `Box`: there is no camera 0: there are 0, counted from 0; correct the number",
    );
    refused(
        |file| file["nodes"][0]["extensions"] = json!({ "KHR_lights_punctual": { "light": 2 } }),
        "node 0 `Box`: there is no light 2: there are 0, counted from 0; correct the number",
    );
    // An index of a triangle's corner.
    refused(
        |file| file["accessors"][0]["count"] = json!(7),
        &format!("{cube}, indices: there is no vertex 7: there are 7, counted from 0; correct the number"),
    );
}

#[test]
fn buffers_that_are_too_short_are_refused() {
    let position = "node 0 `Box`, mesh 0 `Cube`, primitive 0, POSITION, accessor 0";
    refused(
        |file| file["buffers"][0]["byteLength"] = json!(200),
        "buffer 0: it takes 200 bytes, but there are 168; export the file again",
    );
    refused(
        |file| file["bufferViews"][0]["byteLength"] = json!(1e15 as u64),
        &format!(
            "{position}, buffer view 0: it takes 1000000000000000 bytes, but there are 168; export the file \
             again"
        ),
    );
    refused(
        |file| file["accessors"][0]["count"] = json!(9),
        &format!("{position}: it takes 108 bytes, but there are 96; export the file again"),
    );
    refused(
        |file| file["accessors"][0]["byteOffset"] = json!(u64::MAX),
        &format!("{position}: it takes {} bytes, but there are 96; export the file again", u64::MAX),
    );
    for count in [u64::MAX, 1 << 40, 20_000_000] {
        refused(
            |file| {
                file["accessors"][0]["count"] = json!(count);
                file["accessors"][0].as_object_mut().unwrap().remove("bufferView");
            },
            "node 0 `Box`, mesh 0 `Cube`, primitive 0: more than 16777216 vertices and corners of triangles; \
             use fewer",
        );
    }
    refused(
        |file| {
            file["buffers"][0].as_object_mut().unwrap().remove("uri");
        },
        "buffer 0: it has no bytes: there is no `uri` and no binary chunk for it; add one",
    );
    refused(
        |file| file["buffers"][0]["uri"] = json!("data:;base64,AAA$"),
        "buffer 0: its bytes are not in base64: Invalid symbol 36, offset 3.; export the file again",
    );
    refused(
        |file| file["bufferViews"][0]["byteStride"] = json!(8),
        &format!("{position}: expected a stride of at least one element, found a stride of 8 bytes"),
    );
}

#[test]
fn nothing_is_read_from_outside_of_the_folder() {
    let outside = [
        "../cube.bin",
        "/etc/passwd",
        "a/../../cube.bin",
        "%2e%2e/cube.bin",
        "http://example.com/cube.bin",
        "file:///cube.bin",
        "C:\\cube.bin",
        "..\\cube.bin",
        "%2Fetc%2Fpasswd",
        "",
        "%",
        "%zz",
        "a%00b",
    ];
    for uri in outside {
        let shown = uri.escape_debug();
        let expected = format!(
            "buffer 0: `{shown}` is not in the folder of the file or below it; move it there, or use \
             --allow-paths"
        );
        refused(|file| file["buffers"][0]["uri"] = json!(uri), &expected);
    }
    let mut file = cube();
    file["buffers"][0]["uri"] = json!("cube.bin");
    assert!(refusal(&file).starts_with("model.gltf: buffer 0: cannot read cube.bin: "), "{}", refusal(&file));
}

#[test]
fn pictures_that_are_not_in_the_folder_are_left_out() {
    for uri in ["../picture.png", "..\\picture.png", "http://example.com/picture.png", "/picture.png"] {
        let mut file = cube();
        file["images"] = json!([{ "uri": uri }]);
        file["textures"] = json!([{ "name": "Paper", "source": 0 }]);
        file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
        let shown = uri.escape_debug();
        let expected = format!(
            "model.gltf: image 0: left out: `{shown}` is not in the folder of the file or below it; move it \
             there, or use --allow-paths"
        );
        assert_eq!(notes(&file), [expected]);
        with_file(&file, |import| {
            let red = rayline::LinearRgb::new(0.8, 0.1, 0.1);
            assert_eq!(import.scene.materials[0].color, rayline::Texture::Solid(red));
        });
    }
}

#[test]
fn whole_numbers_with_a_point_and_parts_of_null_are_read() {
    let text = cube().to_string();
    let plain = with_file(&cube(), |import| mesh(&import, 0).vertices.to_vec());
    for (from, to) in [
        ("5126", "5126.0"),
        ("5126", "5.126e3"),
        (r#""byteOffset":0"#, r#""byteOffset":0.0"#),
        (r#""mesh":0"#, r#""mesh":0.0,"extras":null"#),
        (r#""mesh":0"#, r#""mesh":0,"extensions":null,"children":null"#),
        (r#""mesh":0"#, r#""mesh":0,"extras":[5.0,{"mesh":"none"}]"#),
        (r#""mesh":0"#, r#""mesh":0,"extras":"text""#),
    ] {
        let changed = text.replace(from, to);
        assert_ne!(changed, text);
        with_bytes("model.gltf", changed.as_bytes(), |import| {
            assert_eq!(mesh(&import.unwrap(), 0).vertices, plain, "{to}");
        });
    }
    // A fraction is told with its position.
    with_bytes("model.gltf", text.replace("5126", "5126.5").as_bytes(), |import| {
        let error = import.map(|_| ()).unwrap_err();
        assert!(
            error.contains("invalid type: floating point `5126.5`") && error.contains("line 1"),
            "{error}"
        );
    });
}

#[test]
fn extensions_that_change_nothing_at_rest_may_be_required() {
    for extension in
        ["KHR_materials_variants", "KHR_animation_pointer", "KHR_xmp_json_ld", "EXT_texture_webp"]
    {
        let mut file = cube();
        file["extensionsUsed"] = json!([extension]);
        file["extensionsRequired"] = json!([extension]);
        let note = format!("model.gltf: extension `{extension}`: left out, as it is not supported");
        assert_eq!(notes(&file), [note]);
    }
}

#[test]
fn attributes_that_are_wrong_are_left_out() {
    let place = "model.gltf: mesh 0 `Cube`, primitive";
    let lists = cube_lists().floats(&[[0.0f32, 1.0, 0.0]; 5]).floats(&[[0.0f32, 1.0]; 3]);
    let attributes = json!({ "POSITION": 0, "NORMAL": 2, "TEXCOORD_0": 3 });
    let mut file = lists.file(json!({ "attributes": attributes, "indices": 1 }));
    let expected = [
        format!("{place} 0: normals are left out: there are not as many as positions"),
        format!("{place} 0: texture coordinates are left out: there are not as many as positions"),
    ];
    assert_eq!(notes(&file), expected);
    with_file(&file, |import| {
        let mesh = mesh(&import, 0);
        assert_eq!((mesh.vertices.len(), mesh.normals, mesh.uvs), (8, None, None));
    });
    // A list of another kind, and a primitive without positions.
    file["meshes"][0]["primitives"] = json!([
        { "attributes": { "POSITION": 0, "NORMAL": 3 }, "indices": 1 },
        { "attributes": { "NORMAL": 2 } },
    ]);
    let expected = [
        format!("{place} 0: normals are left out: they cannot be read"),
        format!("{place} 1: left out: it has no positions"),
    ];
    assert_eq!(notes(&file), expected);
}

#[test]
fn nodes_that_are_their_own_parents_are_refused() {
    let twice = "it is in the scene twice: as a child of two nodes, or of itself; make two nodes of it";
    refused(|file| file["nodes"][0]["children"] = json!([0]), &format!("node 0 `Box`: {twice}"));
    refused(
        |file| {
            file["nodes"] = json!([{ "children": [1] }, { "children": [2] }, { "children": [0], "mesh": 0 }])
        },
        &format!("node 0: {twice}"),
    );
    // Each level has the next as a child twice: 2^60 nodes, if they were shown.
    let levels: Vec<_> = (0..60).map(|i| json!({ "children": [i + 1, i + 1], "mesh": 0 })).collect();
    refused(|file| file["nodes"] = json!([levels, vec![json!({})]].concat()), &format!("node 60: {twice}"));
    // A long chain is not an error.
    let chain: Vec<_> = (0..20_000).map(|i| json!({ "children": [i + 1] })).collect();
    let mut file = cube();
    file["nodes"] = json!([chain, vec![json!({ "mesh": 0 })]].concat());
    with_file(&file, |import| assert_eq!(import.scene.objects.len(), 1));
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let with_corner = |corner: [f32; 3]| {
        let mut points = corners();
        points[3] = corner;
        let lists = Lists::default().floats(&points).corners(CUBE.as_flattened());
        refusal(&lists.file(json!({ "attributes": { "POSITION": 0 }, "indices": 1 })))
    };
    let place = "model.gltf: node 0 `Box`, mesh 0 `Cube`, primitive 0";
    assert_eq!(
        with_corner([0.0, f32::NAN, 0.0]),
        format!("{place}, POSITION, accessor 0: a coordinate must not be NaN; replace it")
    );
    assert_eq!(
        with_corner([0.0, f32::INFINITY, 0.0]),
        format!("{place}, POSITION, accessor 0: a coordinate must not be inf; replace it")
    );
    refused(
        |file| file["nodes"][0]["translation"] = json!([0, 1e39, 0]),
        "node 0 `Box`: a number of its place must not be inf; replace it",
    );
    refused(
        |file| file["nodes"][0]["rotation"] = json!([0, 0, 0, 0]),
        "node 0 `Box`: the length of its rotation must not be 0; replace it",
    );
    refused(
        |file| file["nodes"][0]["matrix"] = json!([1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
        "node 0 `Box`: expected 0, 0, 0 and 1 as the last row of its matrix, found [0.5, 0, 0, 1]",
    );
}

#[test]
fn lists_of_another_kind_are_refused() {
    let place = "node 0 `Box`, mesh 0 `Cube`, primitive 0";
    refused(
        |file| file["accessors"][0]["type"] = json!("VEC2"),
        &format!("{place}, POSITION, accessor 0: expected VEC3, found VEC2"),
    );
    refused(
        |file| {
            file["accessors"][1]["componentType"] = json!(5126);
            file["accessors"][1]["count"] = json!(18);
        },
        &format!("{place}, indices, accessor 1: expected unsigned integers, found F32"),
    );
    refused(
        |file| file["accessors"][0]["componentType"] = json!(5125),
        &format!("{place}, POSITION, accessor 0: expected integers of 8 or 16 bits, or floats, found U32"),
    );
    refused(
        |file| file["meshes"][0]["primitives"][0]["mode"] = json!(7),
        &format!("{place}: expected a mode from 0 to 6, found 7"),
    );
}
