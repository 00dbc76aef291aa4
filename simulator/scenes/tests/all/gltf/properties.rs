//! Property tests: every file is refused or becomes a scene, without a panic.

use core::mem::MaybeUninit;

use proptest::prelude::*;
use rayline::PreparedScene;

use super::*;

/// Reads a file and prepares the scene. The core may still refuse numbers that are in range.
fn read_and_prepare(bytes: &[u8]) {
    with_bytes("model.gltf", bytes, |import| {
        if let Ok(import) = import {
            let mut memory = vec![MaybeUninit::uninit(); import.scene.bytes::<f32>()];
            if let Err(error) = PreparedScene::<f32, _>::new(&import.scene, &mut memory) {
                let may_be_refused = matches!(error.part, Part::Camera | Part::Light(_) | Part::Object(_));
                let is_of_the_file = may_be_refused && import.name_of(error.part).is_some();
                assert!(is_of_the_file, "{error}");
            }
        }
    });
}

/// A file with every supported feature.
fn rich() -> Value {
    let mut file = cube_lists().floats(&corners()).file(json!({
        "attributes": { "POSITION": 0, "NORMAL": 2 }, "indices": 1, "material": 0,
    }));
    file["materials"] = json!([{
        "alphaMode": "BLEND",
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 0 },
        },
        "extensions": {
            "KHR_materials_transmission": { "transmissionFactor": 0.5 },
            "KHR_materials_ior": { "ior": 1.4 },
        },
    }]);
    file["textures"] = json!([{ "source": 0 }]);
    file["images"] = json!([{ "uri": "data:image/png;base64,AAAA" }]);
    file["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 0.7, "znear": 0.1 } }]);
    file["extensions"] = json!({ "KHR_lights_punctual": { "lights": [{ "type": "spot", "spot": {} }] } });
    let extensions = json!({ "KHR_lights_punctual": { "light": 0 } });
    file["nodes"] = json!([
        { "mesh": 0, "children": [1], "scale": [1, 2, 3] },
        { "camera": 0, "translation": [0, 0, 5], "rotation": [0, 0, 0, 1], "extensions": extensions },
    ]);
    file
}

/// The paths of all numbers, texts and lists in a file.
fn places(value: &Value, path: &str, places: &mut Vec<String>) {
    places.push(path.to_owned());
    match value {
        Value::Array(list) => {
            list.iter()
                .enumerate()
                .for_each(|(index, item)| self::places(item, &format!("{path}/{index}"), places));
        }
        Value::Object(map) => {
            map.iter().for_each(|(key, item)| self::places(item, &format!("{path}/{key}"), places));
        }
        _ => {}
    }
}

fn anything() -> impl Strategy<Value = Value> {
    prop_oneof![
        prop::sample::select(vec![
            json!(0),
            json!(1),
            json!(2),
            json!(-1),
            json!(0.5),
            json!(1e39),
            json!(-1e30),
            json!(u64::MAX),
            json!(4_294_967_295u32),
            json!(3),
            json!(4),
            json!(5),
            json!(6),
            json!(5120),
            json!(5121),
            json!(5123),
            json!(5125),
            json!(null),
            json!(true),
            json!(""),
            json!("VEC2"),
            json!("SCALAR"),
            json!("data:;base64,AAAAAAAAAAAA"),
            json!([]),
            json!({}),
            json!([0]),
            json!([0, 0, 0]),
            json!([1, 1, 1]),
            json!([0, 1]),
            json!([1e9, 1e-9, -1e20]),
            json!("point"),
            json!("MASK"),
        ]),
        (-10i64..40).prop_map(|number| json!(number)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..200), is_binary: bool) {
        let start: &[u8] = if is_binary { b"glTF\x02\0\0\0" } else { b"" };
        read_and_prepare(&[start, &bytes].concat());
    }

    #[test]
    fn any_bytes_in_place_of_some(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
    ) {
        let mut file = binary_cube();
        for (place, byte) in changes {
            let place = place.index(file.len());
            file[place] = byte;
        }
        read_and_prepare(&file);
    }

    #[test]
    fn anything_in_place_of_something(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), anything()), 1..5),
    ) {
        let mut file = rich();
        for (place, value) in changes {
            let mut all = Vec::new();
            places(&file, "", &mut all);
            if let Some(target) = file.pointer_mut(&all[place.index(all.len())]) {
                *target = value;
            }
        }
        read_and_prepare(file.to_string().as_bytes());
    }
}

#[test]
fn the_rich_file_is_a_scene() {
    with_file(&rich(), |import| check(&import.scene).unwrap());
}
