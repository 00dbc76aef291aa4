//! A file for each row about glTF.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use rayline::shape::{Instances, Shape};
use rayline::{Fresnel, Light, Optics, Sides, Texture, Vec3};
use rayline_scenes::LoadedScene;
use serde_json::{Value, json};

use super::table::{compare, material, mesh, near, open};

/// A file with a square from -1 to 1. Its accessors: 0 positions, 1 texture coordinates, 2 corners of
/// triangles, 3 normals, 4 colors with opacity, 5 the same vector of 3 for each vertex, 6 joints, 7 weights,
/// 8 colors, 9 positions of 86 triangles, 10 the inverse of a translation by (0, 0, 5).
fn square() -> Value {
    let (mut bytes, mut views, mut accessors) = (Vec::new(), Vec::new(), Vec::new());
    let mut list = |kind: &str, component: u32, count: usize, list: Vec<u8>| {
        views.push(json!({ "buffer": 0, "byteOffset": bytes.len(), "byteLength": list.len() }));
        let view = views.len() - 1;
        accessors
            .push(json!({ "bufferView": view, "componentType": component, "count": count, "type": kind }));
        bytes.extend(list);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    };
    let floats = |list: &[f32]| list.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<_>>();
    let corners = [[-1.0f32, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    list("VEC3", 5126, 4, floats(corners.map(|[x, y]| [x, y, 0.0]).as_flattened()));
    list("VEC2", 5126, 4, floats(corners.map(|at| at.map(|at| (at + 1.0) / 2.0)).as_flattened()));
    list("SCALAR", 5123, 6, [0u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes).collect());
    list("VEC3", 5126, 4, floats([[0.0, 0.0, 1.0]; 4].as_flattened()));
    list("VEC4", 5126, 4, floats([[1.0, 0.0, 0.0, 0.5]; 4].as_flattened()));
    list("VEC3", 5126, 4, floats([[0.0, 0.0, 3.0]; 4].as_flattened()));
    list("VEC4", 5121, 4, vec![0; 16]);
    list("VEC4", 5126, 4, floats([[1.0, 0.0, 0.0, 0.0]; 4].as_flattened()));
    list("VEC3", 5126, 4, floats([[0.0, 1.0, 0.0]; 4].as_flattened()));
    let many = (0..258u16).flat_map(|i| [f32::from(i % 3 % 2), f32::from(i % 3 / 2), f32::from(i / 3)]);
    list("VEC3", 5126, 258, floats(&many.collect::<Vec<_>>()));
    let back = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -5.0, 1.0];
    list("MAT4", 5126, 1, floats(&back));
    let uri = format!("data:application/octet-stream;base64,{}", BASE64_STANDARD.encode(&bytes));
    json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 2, "material": 0 }] }],
        "materials": [{
            "doubleSided": true,
            "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0 },
        }],
        "textures": [{ "source": 0 }],
        "images": [{ "uri": "wood.png" }],
        "buffers": [{ "byteLength": bytes.len(), "uri": uri }],
        "bufferViews": views,
        "accessors": accessors,
    })
}

type Holds = fn(&LoadedScene<'_>) -> bool;
type Case = (&'static str, Value, Holds);

fn changed(change: impl FnOnce(&mut Value)) -> Value {
    let mut file = square();
    change(&mut file);
    file
}

/// The square with these attributes beside the positions.
fn with(attributes: Value) -> Value {
    changed(|file| merge(&mut file["meshes"][0]["primitives"][0]["attributes"], attributes))
}

/// The square, textured, with this in its material.
fn of(material: Value) -> Value {
    let mut file = with(json!({ "TEXCOORD_0": 1 }));
    merge(&mut file["materials"][0], material);
    file
}

/// The square of a material with this extension.
fn extended(name: &str, extension: Value) -> Value {
    of(json!({ "extensions": { name: extension } }))
}

fn merge(into: &mut Value, from: Value) {
    match (into, from) {
        (Value::Object(into), Value::Object(from)) => {
            for (key, value) in from {
                merge(into.entry(key).or_insert(Value::Null), value);
            }
        }
        (into, from) => *into = from,
    }
}

/// The square with a second node of this content.
fn beside(node: Value, more: Value) -> Value {
    let mut file = square();
    file["nodes"] = json!([{ "mesh": 0 }, node]);
    merge(&mut file, more);
    file
}

fn lit(light: Value) -> Value {
    let lights = json!({ "extensions": { "KHR_lights_punctual": { "lights": [light] } } });
    beside(
        json!({ "translation": [0, 0, 4], "extensions": { "KHR_lights_punctual": { "light": 0 } } }),
        lights,
    )
}

/// The square in a file that requires this extension.
fn required(extension: &str) -> Value {
    let named = json!([extension]);
    changed(|file| merge(file, json!({ "extensionsUsed": named, "extensionsRequired": named })))
}

fn optics(scene: &LoadedScene<'_>) -> Optics {
    material(scene).optics.copied().unwrap_or(Optics::PLAIN)
}

fn whole(scene: &LoadedScene<'_>) -> bool {
    mesh(scene, 0).triangles.len() == 2
}

fn all_at(scene: &LoadedScene<'_>, z: f32) -> bool {
    whole(scene) && mesh(scene, 0).vertices.iter().all(|vertex| vertex.z == z)
}

fn geometry() -> Vec<Case> {
    let strip = changed(|file| {
        let primitive = &mut file["meshes"][0]["primitives"][0];
        (primitive["mode"], primitive["indices"]) = (json!(6), Value::Null);
    });
    let shared = changed(|file| {
        file["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": 9 } }] }]);
        file["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0, "translation": [3, 0, 0] }]);
    });
    let mut skinned = with(json!({ "JOINTS_0": 6, "WEIGHTS_0": 7 }));
    skinned["nodes"] = json!([{ "mesh": 0, "skin": 0 }, { "translation": [0, 0, 7] }]);
    skinned["skins"] = json!([{ "joints": [1], "inverseBindMatrices": 10 }]);
    let morphed = changed(|file| {
        file["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 5 }]);
        file["meshes"][0]["weights"] = json!([0.5]);
    });
    let points = changed(|file| {
        let primitive = json!({ "attributes": { "POSITION": 0 }, "mode": 0 });
        file["meshes"][0]["primitives"].as_array_mut().unwrap().push(primitive);
    });
    vec![
        (
            "nodes, meshes, triangles",
            beside(json!({ "mesh": 0, "translation": [3, 0, 2] }), json!({})),
            |scene| mesh(scene, 1).vertices[0] == Vec3::new(2.0, -1.0, 2.0),
        ),
        ("strips, fans", strip, whole),
        ("a large mesh of several nodes", shared, |scene| {
            matches!(scene.scene.objects, [object] if matches!(object.shape,
                Shape::Instances(Instances { poses: [_, _], .. })))
        }),
        ("skins", skinned, |scene| all_at(scene, 2.0)),
        ("morph targets", morphed, |scene| all_at(scene, 1.5)),
        ("`NORMAL`", with(json!({ "NORMAL": 3 })), |scene| mesh(scene, 0).normals.is_some()),
        ("`COLOR_0`", with(json!({ "COLOR_0": 8 })), |scene| {
            mesh(scene, 0).colors == Some(&[[0, 255, 0]; 4])
        }),
        ("opacity in `COLOR_0`", with(json!({ "COLOR_0": 4 })), |scene| {
            mesh(scene, 0).colors == Some(&[[255, 0, 0]; 4])
        }),
        (
            "coordinates beyond ±1e6",
            changed(|file| file["nodes"][0]["translation"] = json!([8e6, 0, 0])),
            |scene| mesh(scene, 0).vertices[0] == Vec3::new(-1.0, -1.0, 0.0),
        ),
        ("meshes in one plane", beside(json!({ "mesh": 0, "translation": [1, 0, 0] }), json!({})), |scene| {
            let depth = mesh(scene, 1).vertices[0].z.abs();
            depth > 1e-5 && depth < 1e-3
        }),
        ("points, lines", points, whole),
    ]
}

fn materials() -> Vec<Case> {
    let sheet = |thickness: f32| {
        let mut file = extended("KHR_materials_transmission", json!({ "transmissionFactor": 0.8 }));
        file["materials"][0]["extensions"]["KHR_materials_volume"] = json!({ "thicknessFactor": thickness,
            "attenuationDistance": 2, "attenuationColor": [0.5, 1, 1] });
        file
    };
    let texture = json!({ "index": 0 });
    vec![
        ("base color", of(json!({ "pbrMetallicRoughness": { "baseColorTexture": texture } })), |scene| {
            matches!(material(scene).color, Texture::Placed(_)) && mesh(scene, 0).uvs.is_some()
        }),
        (
            "metal and roughness",
            of(json!({ "pbrMetallicRoughness": {
            "metallicFactor": 1, "roughnessFactor": 0.25 } })),
            |scene| near(material(scene).reflectance, 0.5) && optics(scene).fresnel == Fresnel::Schlick,
        ),
        ("emission", of(json!({ "emissiveFactor": [1, 0.5, 0] })), |scene| {
            optics(scene).emission.channels() == [1.0, 0.5, 0.0]
        }),
        ("normal textures", of(json!({ "normalTexture": texture })), |scene| {
            !material(scene).maps.is_empty()
        }),
        (
            "`alphaMode`",
            of(json!({ "alphaMode": "BLEND",
            "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.25] } })),
            |scene| near(material(scene).transmittance, 0.75),
        ),
        ("`doubleSided`", of(json!({ "doubleSided": false })), |scene| optics(scene).sides == Sides::Front),
        ("`KHR_materials_transmission`", sheet(0.0), |scene| {
            near(material(scene).transmittance, 0.8) && optics(scene).thin
        }),
        ("`KHR_materials_volume`", sheet(1.0), |scene| {
            near(optics(scene).absorption.r, 0.5f32.ln() / -2.0) && !optics(scene).thin
        }),
        ("`KHR_materials_ior`", extended("KHR_materials_ior", json!({ "ior": 1.75 })), |scene| {
            material(scene).ior == 1.75
        }),
        ("`KHR_materials_unlit`", extended("KHR_materials_unlit", json!({})), |scene| {
            (material(scene).ambient, material(scene).diffuse) == (1.0, 0.0)
        }),
        (
            "`KHR_materials_emissive_strength`",
            {
                let mut file = extended("KHR_materials_emissive_strength", json!({ "emissiveStrength": 5 }));
                file["materials"][0]["emissiveFactor"] = json!([1, 1, 1]);
                file
            },
            |scene| near(optics(scene).emission.r, 5.0),
        ),
        (
            "`KHR_texture_transform`",
            of(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0,
            "extensions": { "KHR_texture_transform": { "scale": [3, 3] } } } } })),
            |scene| mesh(scene, 0).uvs.is_some_and(|uvs| uvs.iter().any(|[u, _]| near(*u, 3.0))),
        ),
        (
            "`KHR_materials_clearcoat`",
            {
                let mut file = extended("KHR_materials_clearcoat", json!({ "clearcoatFactor": 1 }));
                file["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = json!(1);
                file
            },
            |scene| near(material(scene).reflectance, 1.0),
        ),
        (
            "`KHR_materials_specular`",
            extended("KHR_materials_specular", json!({ "specularFactor": 0 })),
            |scene| material(scene).reflectance == 0.0,
        ),
        (
            "`KHR_materials_pbrSpecularGlossiness`",
            extended(
                "KHR_materials_pbrSpecularGlossiness",
                json!({ "diffuseFactor": [0.5, 0, 0, 1], "specularFactor": [0.9, 0.9, 0.9] }),
            ),
            |scene| optics(scene).fresnel == Fresnel::Schlick,
        ),
        ("occlusion textures", of(json!({ "occlusionTexture": texture })), whole),
        (
            "pictures that are elsewhere",
            {
                let mut file = of(json!({ "pbrMetallicRoughness": { "baseColorTexture": texture } }));
                file["images"] = json!([{ "uri": "none.png" }]);
                file
            },
            whole,
        ),
    ]
}

fn surroundings() -> Vec<Case> {
    let camera = json!({ "type": "perspective", "perspective": { "yfov": 0.5, "znear": 1 } });
    let flat =
        json!({ "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1, "zfar": 9, "znear": 1 } });
    let seen = |camera: &Value| {
        beside(json!({ "camera": 0, "translation": [0, 0, 9] }), json!({ "cameras": [camera] }))
    };
    let moving = json!({ "animations": [{ "channels": [], "samplers": [] }] });
    vec![
        ("the first perspective camera", seen(&camera), |scene| {
            let camera = scene.scene.camera;
            (camera.eye, camera.vertical_fov) == (Vec3::new(0.0, 0.0, 9.0), 0.5)
        }),
        ("`KHR_lights_punctual`", lit(json!({ "type": "point", "intensity": 50 })), |scene| {
            matches!(scene.scene.lights, [Light::Lamp(_)])
        }),
        ("`range` of lights", lit(json!({ "type": "point", "range": 5 })), |scene| {
            scene.scene.lights.len() == 1
        }),
        ("other cameras", seen(&flat), whole),
        ("other scenes", changed(|file| file["scenes"] = json!([{ "nodes": [0] }, { "nodes": [] }])), whole),
        ("animations", changed(|file| merge(file, moving)), whole),
        ("other extensions", changed(|file| file["extensionsUsed"] = json!(["KHR_materials_sheen"])), whole),
        ("required extensions that change nothing at rest", required("KHR_materials_variants"), whole),
        ("other required extensions", required("KHR_draco_mesh_compression"), whole),
        ("buffers that are elsewhere", changed(|file| file["buffers"][0]["uri"] = json!("../a.bin")), whole),
        ("other versions", changed(|file| file["asset"]["version"] = json!("1.0")), whole),
    ]
}

#[test]
fn gltf() {
    let cases = geometry().into_iter().chain(materials()).chain(surroundings());
    let seen = cases
        .map(|(feature, file, holds)| (feature, open(&[("a.gltf", file.to_string().as_bytes())], holds)));
    compare("glTF", 15, seen.collect());
}
