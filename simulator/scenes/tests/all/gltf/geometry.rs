//! Tests of meshes and their transforms.

use rayline::{Light, Vec3};

use super::*;

/// The smallest and the largest of all coordinates.
fn bounds(mesh: &Mesh<'_>) -> ([f32; 3], [f32; 3]) {
    let mut bounds = ([f32::MAX; 3], [f32::MIN; 3]);
    for Vec3 { x, y, z } in mesh.vertices {
        for (axis, at) in [*x, *y, *z].into_iter().enumerate() {
            bounds.0[axis] = bounds.0[axis].min(at);
            bounds.1[axis] = bounds.1[axis].max(at);
        }
    }
    bounds
}

fn assert_bounds(file: &Value, least: [f32; 3], greatest: [f32; 3]) {
    with_file(file, |import| {
        let found = bounds(&mesh(&import, 0));
        for (found, expected) in [(found.0, least), (found.1, greatest)] {
            let near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5);
            assert!(near, "{found:?}, not {expected:?}");
        }
    });
}

/// The cosines between the normals of each triangle and the direction away from a point.
fn outward(mesh: &Mesh<'_>, from: Vec3) -> Vec<f32> {
    let triangles = mesh.triangles.iter().flat_map(|corners| {
        let [a, b, c] = corners.map(|corner| mesh.vertices[usize::from(corner)]);
        let normal = (b - a).cross(c - a);
        let smooth = mesh.normals.map_or(normal, |normals| normals[usize::from(corners[0])]);
        [(a - from).dot(normal), (a - from).dot(smooth)]
    });
    triangles.collect()
}

#[test]
fn a_cube_is_where_its_nodes_put_it() {
    let mut file = cube();
    assert_bounds(&file, [-0.5; 3], [0.5; 3]);
    let half = core::f32::consts::FRAC_1_SQRT_2;
    // Scaled, turned about z and moved; then doubled in size and moved again.
    file["nodes"] = json!([
        { "children": [1], "translation": [10, 0, 0], "scale": [2, 2, 2] },
        { "mesh": 0, "translation": [0, 1, 0], "rotation": [0, 0, half, half], "scale": [1, 2, 3] },
    ]);
    assert_bounds(&file, [8.0, 1.0, -3.0], [12.0, 3.0, 3.0]);
    // The same transforms as matrices; each line here is a column.
    file["nodes"] = json!([
        { "children": [1], "matrix": [2, 0, 0, 0,  0, 2, 0, 0,  0, 0, 2, 0,  10, 0, 0, 1] },
        { "mesh": 0, "matrix": [0, 1, 0, 0,  -2, 0, 0, 0,  0, 0, 3, 0,  0, 1, 0, 1] },
    ]);
    assert_bounds(&file, [8.0, 1.0, -3.0], [12.0, 3.0, 3.0]);
    // Without scenes, all nodes without a parent are shown.
    file.as_object_mut().unwrap().remove("scene");
    file.as_object_mut().unwrap().remove("scenes");
    assert_bounds(&file, [8.0, 1.0, -3.0], [12.0, 3.0, 3.0]);
    // A mesh at two nodes becomes two objects.
    file["nodes"].as_array_mut().unwrap().push(json!({ "name": "Other", "mesh": 0 }));
    with_file(&file, |import| {
        assert_eq!(import.scene.objects.len(), 2);
        assert_eq!(import.name_of(Part::Object(1)), Some("node 2 `Other`, mesh 0 `Cube`, primitive 0"));
        assert_eq!(import.name_of(Part::Material(0)), Some("material 0 `Red`"));
        assert_eq!((import.name_of(Part::Object(2)), import.name_of(Part::Camera)), (None, None));
    });
}

#[test]
fn fronts_stay_outside_where_nodes_mirror() {
    let lists = cube_lists().floats(&corners());
    let mut file = lists.file(json!({ "attributes": { "POSITION": 0, "NORMAL": 2 }, "indices": 1 }));
    for scale in [[1, 1, 1], [-1, 1, 1], [-2, -3, 1], [-1, -4, -1]] {
        file["nodes"][0] = json!({ "mesh": 0, "scale": scale, "translation": [3, 4, 5] });
        with_file(&file, |import| {
            let faces = outward(&mesh(&import, 0), Vec3::new(3.0, 4.0, 5.0));
            assert!(faces.len() == 24 && faces.iter().all(|away| *away > 0.0), "{scale:?}: {faces:?}");
        });
    }
    // A mirroring child of a mirroring parent.
    file["nodes"] = json!([{ "children": [1], "scale": [1, 1, -1] }, { "mesh": 0, "scale": [-1, 1, 1] }]);
    with_file(&file, |import| assert!(outward(&mesh(&import, 0), Vec3::ZERO).iter().all(|away| *away > 0.0)));
}

#[test]
fn normals_stay_normal_where_nodes_stretch() {
    let slope = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, -1.0, 0.0]];
    let lists = Lists::default().floats(&slope).floats(&[[0.5, 0.5, 0.0]; 3]);
    let mut file = lists.file(json!({ "attributes": { "POSITION": 0, "NORMAL": 1 } }));
    file["nodes"][0]["scale"] = json!([2, 1, 1]);
    with_file(&file, |import| {
        let mesh = mesh(&import, 0);
        let expected = Vec3::new(0.2f32.sqrt(), 0.8f32.sqrt(), 0.0);
        assert!(mesh.normals.unwrap().iter().all(|normal| (*normal - expected).length() < 1e-6));
        assert_eq!(mesh.vertices[2], Vec3::new(2.0, -1.0, 0.0));
    });
    // A node that flattens its mesh has no inverse.
    let lists = Lists::default().floats(&slope).floats(&[[0.0, 1.0, 0.0]; 3]);
    let mut file = lists.file(json!({ "attributes": { "POSITION": 0, "NORMAL": 1 } }));
    file["nodes"][0]["scale"] = json!([1, 0, 1]);
    with_file(&file, |import| {
        assert_eq!(mesh(&import, 0).normals.unwrap(), [Vec3::new(0.0, 1.0, 0.0); 3]);
    });
}

#[test]
fn strips_and_fans_are_triangles() {
    let points: Vec<_> = (0..6u8).map(|i| [f32::from(i), f32::from(i * i), 1.0]).collect();
    let lists = Lists::default().floats(&points).corners(&[5, 4, 3, 2, 1]);
    let triangles = |mode: u8, indices: Option<u8>| {
        let mut primitive = json!({ "attributes": { "POSITION": 0 }, "mode": mode });
        if let Some(indices) = indices {
            primitive["indices"] = json!(indices);
        }
        with_file(&lists.file(primitive), |import| mesh(&import, 0).triangles.to_vec())
    };
    assert_eq!(triangles(4, None), [[0, 1, 2], [3, 4, 5]]);
    // Left-over corners make no triangle.
    assert_eq!(triangles(4, Some(1)), [[5, 4, 3]]);
    assert_eq!(triangles(5, None), [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]]);
    assert_eq!(triangles(6, Some(1)), [[4, 3, 5], [3, 2, 5], [2, 1, 5]]);
}

#[test]
fn numbers_are_read_in_all_types_and_steps() {
    // The positions are signed bytes with a byte of padding between them.
    let bytes = [0, 0, 127, 9, 127, 0, 0, 9, 0, 0x80, 0, 9];
    let lists = Lists::default()
        .list(&bytes, json!({ "componentType": 5120, "count": 3, "type": "VEC3", "normalized": true }))
        .list(&[0, 1, 2], json!({ "componentType": 5121, "count": 3, "type": "SCALAR" }));
    let mut file = lists.file(json!({ "attributes": { "POSITION": 0 }, "indices": 1 }));
    file["bufferViews"][0]["byteStride"] = json!(4);
    file["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let vertices = |file: &Value| with_file(file, |import| mesh(&import, 0).vertices.to_vec());
    let [x, y, z] = [(1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0)].map(|(x, y, z)| Vec3::new(x, y, z));
    assert_eq!(vertices(&file), [z, x, y]);
    file["accessors"][0]["normalized"] = json!(false);
    assert_eq!(vertices(&file), [z * 127.0, x * 127.0, y * 128.0]);

    // A sparse list: zeros but for two elements.
    let lists = Lists::default().corners(&[1, 2]).floats(&[[1.0f32, 0.0, 0.0], [0.0, 1.0, 0.0]]).list(
        &[0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0],
        json!({ "componentType": 5125, "count": 3, "type": "SCALAR" }),
    );
    let mut file = lists.file(json!({ "attributes": { "POSITION": 3 }, "indices": 2 }));
    let sparse = json!({
        "count": 2,
        "indices": { "bufferView": 0, "byteOffset": 0, "componentType": 5123 },
        "values": { "bufferView": 1, "byteOffset": 0 },
    });
    let accessor = json!({ "componentType": 5126, "count": 3, "type": "VEC3", "sparse": sparse });
    file["accessors"].as_array_mut().unwrap().push(accessor);
    assert_eq!(vertices(&file), [Vec3::ZERO, x, -y]);
}

#[test]
fn texture_coordinates_grow_upward() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let lists = Lists::default().floats(&triangle).floats(&[[0.0, 0.0], [1.0, 0.25], [-2.0, 3.0]]);
    let mut file = lists.file(json!({ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 } }));
    let uvs = |file: &Value| with_file(file, |import| mesh(&import, 0).uvs.map(<[_]>::to_vec));
    assert_eq!(uvs(&file).unwrap(), [[0.0, 1.0], [1.0, 0.75], [-2.0, -2.0]]);
    // Normalized integers of 16 bits.
    file["accessors"][1] =
        json!({ "bufferView": 0, "componentType": 5123, "count": 3, "type": "VEC2", "normalized": true });
    assert_eq!(uvs(&file).unwrap().len(), 3);
}

#[test]
fn large_meshes_are_several() {
    let side = 300u32;
    let points: Vec<_> = (0..side * side).map(|i| [(i % side) as f32, (i / side) as f32, 0.0]).collect();
    let starts = (0..side * (side - 1)).filter(|i| i % side != side - 1);
    let corners: Vec<u8> = starts
        .flat_map(|i| [i, i + 1, i + side, i + 1, i + 1 + side, i + side])
        .flat_map(u32::to_le_bytes)
        .collect();
    let count = corners.len() / 4;
    let lists = Lists::default()
        .floats(&points)
        .list(&corners, json!({ "componentType": 5125, "count": count, "type": "SCALAR" }));
    with_file(&lists.file(json!({ "attributes": { "POSITION": 0 }, "indices": 1 })), |import| {
        let meshes: Vec<_> = (0..import.scene.objects.len()).map(|index| mesh(&import, index)).collect();
        assert!(meshes.len() >= 3);
        assert_eq!(meshes.iter().map(|mesh| mesh.triangles.len()).sum::<usize>(), count / 3);
    });
}

#[test]
fn skins_place_meshes_at_rest() {
    // The mesh is a hundredth of its size; joints enlarge it. Its own node is ignored.
    let small: Vec<_> = corners().iter().map(|corner| corner.map(|at| at * 0.02)).collect();
    let joint = |x: u8, y: u8| [x, y, 0, 0].repeat(8);
    let of = |kind: u16| json!({ "componentType": kind, "count": 8, "type": "VEC4" });
    let shared = json!({ "componentType": 5121, "count": 8, "type": "VEC4", "normalized": true });
    // The matrix of the second joint moves by 3 along x before the joint does anything.
    let matrices: [[f32; 16]; 2] = [
        [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.],
        [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 3., 0., 0., 1.],
    ];
    let bytes: Vec<u8> = matrices.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect();
    let mut file = Lists::default()
        .floats(&small)
        .corners(CUBE.as_flattened())
        .list(&joint(0, 1), of(5121))
        .list(&[255, 0, 0, 0].repeat(8), shared.clone())
        .list(&[128, 128, 0, 0].repeat(8), shared)
        .list(&bytes, json!({ "componentType": 5126, "count": 2, "type": "MAT4" }))
        .file(json!({
            "attributes": { "POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3 }, "indices": 1,
        }));
    file["nodes"] = json!([
        { "mesh": 0, "skin": 0, "translation": [50, 60, 70], "scale": [9, 9, 9] },
        { "scale": [100, 100, 100], "translation": [0, 1, 0], "children": [2] },
        { "translation": [0, 0, 0.01] },
    ]);
    file["scenes"] = json!([{ "nodes": [0, 1] }]);
    file["skins"] = json!([{ "joints": [1, 2] }]);
    assert_bounds(&file, [-1.0, 0.0, -1.0], [1.0, 2.0, 1.0]);
    assert_eq!(notes(&file), [""; 0]);
    // Half of each joint. The second one is one unit in front.
    file["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = json!(4);
    assert_bounds(&file, [-1.0, 0.0, -0.5], [1.0, 2.0, 1.5]);
    // The inverse matrices come first: 300 units along x, of which half are seen.
    file["skins"] = json!([{ "joints": [1, 2], "inverseBindMatrices": 5 }]);
    assert_bounds(&file, [149.0, 0.0, -0.5], [151.0, 2.0, 1.5]);
    // Joints need not be in the scene.
    file["scenes"] = json!([{ "nodes": [0] }]);
    assert_bounds(&file, [149.0, 0.0, -0.5], [151.0, 2.0, 1.5]);
    // A mirroring joint turns the triangles around, so that their fronts stay outside.
    file["nodes"][1]["scale"] = json!([-100, 100, 100]);
    with_file(&file, |import| {
        let away = outward(&mesh(&import, 0), Vec3::new(-150.0, 1.0, 0.5));
        assert!(away.iter().all(|away| *away > 0.0), "{away:?}");
    });
    // Without its joints, the mesh is where its node is.
    file["skins"] = json!([{ "joints": [1, 7] }]);
    assert_bounds(&file, [49.91, 59.91, 69.91], [50.09, 60.09, 70.09]);
    let note = "model.gltf: node 0: its skin is left out: there is no node 7: there are 3, counted from 0; \
                correct the number";
    assert_eq!(notes(&file), [note]);
}

#[test]
fn morph_targets_have_their_default_weights() {
    let up: Vec<_> = corners().iter().map(|[_, y, _]| [0.0, y + 0.5, 0.0]).collect();
    let lists = cube_lists().floats(&up).floats(&[[1.0f32, 0.0, 0.0]; 2]).corners(&[0, 1]);
    let targets = json!([{ "POSITION": 2 }, { "POSITION": 5 }]);
    let mut file = lists.file(json!({ "attributes": { "POSITION": 0 }, "indices": 1, "targets": targets }));
    // The second target is sparse: it moves the first two corners by one unit along x.
    let sparse = json!({
        "count": 2,
        "indices": { "bufferView": 4, "componentType": 5123 },
        "values": { "bufferView": 3 },
    });
    let accessor = json!({ "componentType": 5126, "count": 8, "type": "VEC3", "sparse": sparse });
    file["accessors"].as_array_mut().unwrap().push(accessor);
    assert_bounds(&file, [-0.5; 3], [0.5; 3]);
    file["meshes"][0]["weights"] = json!([2, 0]);
    assert_bounds(&file, [-0.5; 3], [0.5, 2.5, 0.5]);
    // The weights of the node come first.
    file["nodes"][0]["weights"] = json!([0, 3]);
    assert_bounds(&file, [-0.5; 3], [3.5, 0.5, 0.5]);
    assert_eq!(notes(&file), [""; 0]);
    // Targets bend normals too.
    let lists = Lists::default()
        .floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
        .floats(&[[0.0f32, 0.0, 1.0]; 3])
        .floats(&[[0.0f32, 3.0, 3.0]; 3]);
    let targets = json!([{ "NORMAL": 2 }]);
    let mut file = lists.file(json!({ "attributes": { "POSITION": 0, "NORMAL": 1 }, "targets": targets }));
    file["meshes"][0]["weights"] = json!([1]);
    with_file(&file, |import| {
        let normal = mesh(&import, 0).normals.unwrap()[0];
        assert!((normal - Vec3::new(0.0, 0.6, 0.8)).length() < 1e-6, "{normal:?}");
    });
}

#[test]
fn large_meshes_that_nodes_share_are_held_once() {
    let side = 16u16;
    let points: Vec<_> = (0..side * side).map(|i| [f32::from(i % side), f32::from(i / side), 0.0]).collect();
    let starts = (0..side * (side - 1)).filter(|i| i % side != side - 1);
    let corners: Vec<u16> =
        starts.flat_map(|i| [i, i + 1, i + side, i + 1, i + 1 + side, i + side]).collect();
    let lists = Lists::default().floats(&points).corners(&corners);
    let mut file = lists.file(json!({ "attributes": { "POSITION": 0 }, "indices": 1 }));
    let half = core::f32::consts::FRAC_1_SQRT_2;
    file["nodes"] = json!([
        { "name": "Sheet", "mesh": 0, "scale": [2, 2, 2] },
        // Turned about z by a right angle: x becomes y, and y becomes -x.
        { "mesh": 0, "scale": [2, 2, 2], "rotation": [0, 0, half, half], "translation": [100, 0, 5] },
        // Mirrored, stretched and smaller nodes cannot be instances of this size.
        { "mesh": 0, "scale": [-2, 2, 2] },
        { "mesh": 0, "scale": [2, 3, 2] },
        { "mesh": 0 },
    ]);
    file["scenes"] = json!([{ "nodes": [0, 1, 2, 3, 4] }]);
    with_file(&file, |import| {
        check(&import.scene).unwrap();
        assert_eq!(import.scene.objects.len(), 4);
        let Shape::Instances(instances) = import.scene.objects[0].shape else { unreachable!() };
        let [first, second] = instances.poses else { unreachable!() };
        assert_eq!((instances.size, first.origin, first.rotation), (1.0, Vec3::ZERO, Vec3::ZERO));
        assert_eq!(second.origin, Vec3::new(100.0, 0.0, 5.0));
        assert!((second.rotation.z - core::f32::consts::FRAC_PI_2).abs() < 1e-6, "{second:?}");
        let rayline::shape::Model::Mesh(mesh) = instances.model else { unreachable!() };
        assert_eq!(mesh.vertices[17], Vec3::new(2.0, 2.0, 0.0));
        assert_eq!(
            import.name_of(Part::Object(0)),
            Some("node 0 `Sheet` and 1 more, mesh 0 `Cube`, primitive 0")
        );
        assert_eq!(bounds(mesh), ([0.0, 0.0, 0.0], [30.0, 30.0, 0.0]));
    });
}

#[test]
fn equal_and_invisible_nodes_are_left_out() {
    let mut file = cube();
    file["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0, "translation": [3, 0, 0] }, { "mesh": 0 }]);
    file["scenes"] = json!([{ "nodes": [0, 1, 2] }]);
    with_file(&file, |import| assert_eq!(import.scene.objects.len(), 2));
    let note = "model.gltf: node 2: left out: another node draws the same mesh in the same place";
    assert_eq!(notes(&file), [note]);
    let hidden = json!({ "KHR_node_visibility": { "visible": false } });
    file["nodes"] =
        json!([{ "mesh": 0 }, { "children": [2], "extensions": hidden }, { "mesh": 0, "scale": [9, 9, 9] }]);
    file["scenes"] = json!([{ "nodes": [0, 1] }]);
    with_file(&file, |import| assert_eq!(import.scene.objects.len(), 1));
    // A scene without nodes shows all of them.
    file["scenes"] = json!([{ "name": "Empty" }]);
    with_file(&file, |import| assert_eq!(import.scene.objects.len(), 1));
    let note = "model.gltf: scene 0 `Empty`: it has no nodes, so all of the file are shown";
    assert_eq!(notes(&file), [note]);
}

#[test]
fn vertices_have_colors() {
    let mut file = cube();
    // The places of the vertices as colors: each channel has half of the light on one half of the cube.
    file["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(0);
    with_file(&file, |import| {
        let mesh = mesh(&import, 0);
        let colors = mesh.colors.unwrap();
        assert_eq!(colors.len(), mesh.vertices.len());
        for (place, color) in mesh.vertices.iter().zip(colors) {
            let expected = [place.x, place.y, place.z].map(|number| if number > 0.0 { 188 } else { 0 });
            assert_eq!(*color, expected, "{place:?}");
        }
    });
}

#[test]
fn notes_list_what_is_left_out() {
    let mut file = cube();
    file["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 1 }]);
    file["meshes"][0]["weights"] = json!([1]);
    file["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(0);
    let lines = json!({ "attributes": { "POSITION": 0 }, "mode": 1 });
    let empty = json!({ "attributes": { "POSITION": 0 }, "indices": 2 });
    file["meshes"].as_array_mut().unwrap().push(json!({ "primitives": [lines, lines, empty] }));
    file["accessors"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "componentType": 5123, "count": 3, "type": "SCALAR" }));
    file["nodes"] = json!([{ "mesh": 0, "skin": 0 }, { "mesh": 1 }]);
    file["skins"] = json!([{ "joints": [0] }]);
    file["scenes"] = json!([{ "nodes": [0, 1] }, { "name": "Attic", "nodes": [0] }]);
    file["extensionsUsed"] = json!(["KHR_materials_ior", "KHR_materials_sheen"]);
    file["animations"] = json!([{ "name": "Turn", "channels": [], "samplers": [] }]);
    let expected = [
        "extension `KHR_materials_sheen`: left out, as it is not supported",
        "animation 0 `Turn`: left out: animations are not supported",
        "scene 1 `Attic`: left out, as only one scene is shown",
        "mesh 0 `Cube`, primitive 0: a morph target is left out: it is not one vector for each vertex",
        "mesh 0 `Cube`, primitive 0: its skin is left out: it is not joints and weights for each vertex",
        "mesh 1, primitive 0, and 1 more: points and lines are left out",
        "mesh 1, primitive 2: left out: none of its triangles has an area",
    ];
    assert_eq!(notes(&file), expected.map(|note| format!("model.gltf: {note}")));
    with_file(&cube(), |import| {
        assert_eq!(import.notes.len(), 2, "{:?}", import.notes);
        assert!(import.notes[0].starts_with("model.gltf: no camera: the whole model is seen from the front"));
        assert_eq!(import.notes[1], "model.gltf: no light: it is lit from beside the camera and by a sky");
    });
}

/// A cube, a lamp and a camera far away look as near the origin: all move alike.
#[test]
fn scenes_that_lie_far_away_come_to_the_origin() {
    let lamp = json!({ "type": "point", "intensity": 9 });
    let file = |at: f64, size: f64| {
        let mut file = cube();
        file["extensionsUsed"] = json!(["KHR_lights_punctual"]);
        file["extensions"] = json!({ "KHR_lights_punctual": { "lights": [lamp] } });
        file["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 0.5, "znear": 1 } }]);
        file["nodes"] = json!([
            { "mesh": 0, "translation": [at, 0, 0], "scale": [size, size, size] },
            { "camera": 0, "translation": [at, 0, 8.0 * size] },
            { "translation": [at, 4.0 * size, 0], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        ]);
        file["scenes"] = json!([{ "nodes": [0, 1, 2] }]);
        file
    };
    with_file(&file(8_388_608.0, 1.0), |import| {
        let note = "model.gltf: the scene: moved by -8388608, -2, -4, as a scene reaches from -1e6 to 1e6";
        assert_eq!(import.notes[0], note);
        // The middle of cube, camera and lamp, rounded, is the origin.
        assert_eq!(mesh(&import, 0).vertices[0], Vec3::new(-0.5, -2.5, -4.5));
        assert_eq!(import.scene.camera.eye, Vec3::new(0.0, -2.0, 4.0));
        assert_eq!(import.scene.camera.target, Vec3::new(0.0, -2.0, -4.0));
        let [Light::Lamp(lamp)] = import.scene.lights else { unreachable!() };
        assert_eq!(lamp.position, Vec3::new(0.0, 2.0, -4.0));
    });
    // Four million times as large, it becomes a hundredth of that. The lamp's light is the same everywhere.
    with_file(&file(0.0, 4e6), |import| {
        let note = "moved by 0, -7000000, -15000000, and scaled by 0.01, as a scene reaches from -1e6 to 1e6";
        assert_eq!(import.notes[0], format!("model.gltf: the scene: {note}"));
        assert_eq!(mesh(&import, 0).vertices[7], Vec3::new(2e4, -5e4, -1.3e5));
        assert_eq!(import.scene.camera.eye, Vec3::new(0.0, -7e4, 1.7e5));
        let [Light::Lamp(lamp)] = import.scene.lights else { unreachable!() };
        assert_eq!(lamp.position, Vec3::new(0.0, 9e4, -1.5e5));
        // White at the center of the cube, 160,000 away.
        let arriving = lamp.color.r / (lamp.falloff.quadratic * 1.6e5 * 1.6e5);
        assert!((arriving - 1.0).abs() < 1e-4, "{arriving}");
    });
}
