//! Tests of materials and textures.

use std::fs;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use rayline::{
    Encoding, Ends, Figure, Filter, Fresnel, Highlight, Image, LinearRgb, Map, Material, Onto, Optics,
    Pixels, Placed, Sides, Texture,
};

use super::*;
use rayline_formats::raster::to_png;

/// Imports the cube with this material.
fn with_material(material: Value, look: impl FnOnce(Material<'_>)) {
    let mut file = cube();
    file["materials"] = json!([material]);
    with_file(&file, |import| look(import.scene.materials[0]));
}

fn pbr(base: [f32; 4], metallic: f32, roughness: f32) -> Value {
    json!({ "pbrMetallicRoughness": {
        "baseColorFactor": base, "metallicFactor": metallic, "roughnessFactor": roughness,
    } })
}

const RED: LinearRgb = LinearRgb::new(0.75, 0.25, 0.0);
const MATTE_RED: Material<'static> = Material { ambient: 0.1, ..Material::matte(RED) };

#[test]
fn rough_plastic_is_matte() {
    for roughness in [0.9, 1.0] {
        with_material(pbr([0.75, 0.25, 0.0, 0.5], 0.0, roughness), |material| {
            assert_eq!(material, MATTE_RED)
        });
    }
    // The default material is a white metal of roughness 1.
    let mut file = cube();
    file["meshes"][0]["primitives"][0].as_object_mut().unwrap().remove("material");
    with_file(&file, |import| {
        let Material { color, diffuse, reflectance, .. } = import.scene.materials[0];
        assert_eq!((color, diffuse, reflectance), (Texture::Solid(LinearRgb::WHITE), 1.0, 0.0));
        assert_eq!(import.name_of(Part::Material(0)), Some("the default material"));
    });
}

#[test]
fn smooth_plastic_has_a_coat_that_mirrors() {
    with_material(pbr([0.75, 0.25, 0.0, 1.0], 0.0, 0.25), |material| {
        // The exponent is n = 2 / 0.25⁴ - 2. The strength (1 - 0.25) 0.04 n / 8 is above its limit 1 - 0.25.
        assert_eq!((material.shininess, material.specular), (510.0, 0.75));
        assert_eq!((material.diffuse, material.reflectance, material.ior), (1.0, 0.5, 1.5));
        let optics = Optics { highlight: Highlight::BlinnPhong, fresnel: Fresnel::Exact, ..Optics::PLAIN };
        assert_eq!(material.optics, Some(&optics));
    });
    with_material(pbr([0.75, 0.25, 0.0, 1.0], 0.0, 0.5), |material| {
        assert_eq!((material.shininess, material.reflectance), (30.0, 0.0));
        assert!((material.specular - 0.5 * 0.04 * 30.0 / 8.0).abs() < 1e-6);
    });
    with_material(pbr([1.0; 4], 0.0, 0.0), |material| {
        assert_eq!((material.shininess, material.specular, material.reflectance), (2000.0, 1.0, 1.0));
    });
}

#[test]
fn metals_mirror_in_their_color() {
    with_material(pbr([0.75, 0.25, 0.0, 1.0], 1.0, 0.125), |material| {
        assert_eq!((material.diffuse, material.reflectance, material.transmittance), (0.25, 0.75, 0.0));
        let optics = material.optics.unwrap();
        assert_eq!((optics.fresnel, optics.reflection_color), (Fresnel::Schlick, RED));
    });
}

#[test]
fn glass_refracts_and_absorbs() {
    let mut glass = pbr([0.25, 1.0, 0.0, 1.0], 0.0, 0.0);
    glass["extensions"] = json!({
        "KHR_materials_transmission": { "transmissionFactor": 0.75 },
        "KHR_materials_ior": { "ior": 1.25 },
        "KHR_materials_volume": {
            "thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [0.5, 1, 1],
        },
    });
    with_material(glass, |material| {
        assert_eq!((material.diffuse, material.transmittance, material.ior), (0.25, 0.75, 1.25));
        let optics = material.optics.unwrap();
        assert_eq!(
            (optics.fresnel, optics.transmission_color),
            (Fresnel::Exact, LinearRgb::new(0.5, 1.0, 0.0))
        );
        // Half of the red is left after two units.
        assert!(((-2.0 * optics.absorption.r).exp() - 0.5).abs() < 1e-6);
        assert_eq!((optics.absorption.g, optics.absorption.b), (0.0, 0.0));
    });
    let window = json!({
        "extensions": {
            "KHR_materials_transmission": { "transmissionFactor": 1 },
            "KHR_materials_volume": {},
        },
        "pbrMetallicRoughness": { "metallicFactor": 0 },
    });
    with_material(window, |material| {
        assert_eq!((material.diffuse, material.transmittance, material.ior), (0.0, 1.0, 1.5));
        // Without a thickness, the surface is a sheet.
        let optics = material.optics.unwrap();
        assert_eq!((optics.absorption, optics.thin), (Optics::PLAIN.absorption, true));
    });
    let sheet = json!({
        "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1 } },
        "pbrMetallicRoughness": { "metallicFactor": 0, "baseColorFactor": [0.25, 1, 0, 1] },
    });
    with_material(sheet, |material| {
        let optics = material.optics.unwrap();
        assert_eq!((optics.transmission_color, optics.thin), (LinearRgb::new(0.25, 1.0, 0.0), true));
    });
}

#[test]
fn emissive_unlit_and_transparent_materials() {
    let mut lamp = pbr([0.0, 0.0, 0.0, 1.0], 0.0, 1.0);
    lamp["emissiveFactor"] = json!([1, 0.5, 0]);
    lamp["extensions"] = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 4 } });
    with_material(lamp, |material| {
        assert_eq!(material.optics.unwrap().emission, LinearRgb::new(4.0, 2.0, 0.0));
    });
    let mut unlit = pbr([0.75, 0.25, 0.0, 1.0], 1.0, 0.0);
    unlit["extensions"] = json!({ "KHR_materials_unlit": {} });
    with_material(unlit, |material| {
        assert_eq!(material, Material { ambient: 1.0, diffuse: 0.0, ..Material::matte(RED) });
    });
    let mut veil = pbr([0.75, 0.25, 0.0, 0.25], 0.0, 1.0);
    veil["alphaMode"] = json!("BLEND");
    with_material(veil.clone(), |material| {
        let expected = Material { ambient: 0.025, diffuse: 0.25, transmittance: 0.75, ..MATTE_RED };
        assert_eq!(Material { optics: None, ..material }, expected);
    });
    veil["alphaMode"] = json!("MASK");
    with_material(veil.clone(), |material| {
        assert_eq!((material.diffuse, material.transmittance), (0.0, 1.0))
    });
    veil["alphaCutoff"] = json!(0.25);
    with_material(veil, |material| assert_eq!(material, MATTE_RED));
}

#[test]
fn numbers_beyond_their_range_are_brought_into_it() {
    let mut wild = pbr([1e38, -5.0, 2.0, 1.0], 0.0, -7.0);
    wild["emissiveFactor"] = json!([1e30, -1, 0]);
    wild["extensions"] = json!({
        "KHR_materials_transmission": { "transmissionFactor": 9 },
        "KHR_materials_ior": { "ior": 0 },
        "KHR_materials_volume": { "attenuationDistance": 0, "attenuationColor": [2, 0, 0] },
        "KHR_materials_emissive_strength": { "emissiveStrength": 1e30 },
    });
    let mut file = cube();
    file["materials"] = json!([wild]);
    with_file(&file, |import| check(&import.scene).unwrap());
}

/// Red and green above, blue and white below; the white pixel is half transparent.
const PIXELS: [u8; 16] = [255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 128];

fn picture() -> Vec<u8> {
    to_png((2, 2), 4, &PIXELS).unwrap()
}

/// A JPEG file of 8×8 pixels, all of which are (200, 200, 200), in base64.
const GRAY_JPEG: &str = "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAYEBQYFBAYGBQYHBwYIChAKCgkJChQODwwQFxQYGBcUFhYaHSUfGhsj\
    HBYWICwgIyYnKSopGR8tMC0oMCUoKSj/2wBDAQcHBwoIChMKChMoGhYaKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgoKCgo\
    KCgoKCgoKCgoKCgoKCj/wAARCAAIAAgDASIAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAAAAf/xAAUEAEAAAAAAAAAAAAAAAAAAAAA\
    /8QAFAEBAAAAAAAAAAAAAAAAAAAAAP/EABQRAQAAAAAAAAAAAAAAAAAAAAD/2gAMAwEAAhEDEQA/ALAAD//Z";

/// A triangle with texture coordinates in sets 0 and 1, and an image on it.
fn textured() -> Value {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let lists = Lists::default().floats(&triangle).floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).floats(&[
        [0.5, 0.5],
        [1.0, 0.0],
        [0.0, 1.0],
    ]);
    let attributes = json!({ "POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2 });
    let mut file = lists.file(json!({ "attributes": attributes, "material": 0 }));
    file["materials"] =
        json!([{ "pbrMetallicRoughness": { "metallicFactor": 0, "baseColorTexture": { "index": 0 } } }]);
    file["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    file["images"] = json!([{ "uri": uri(&picture()) }]);
    file["samplers"] = json!([{ "wrapS": 33071, "wrapT": 33648 }]);
    file
}

fn image<'a>(texture: Texture<'a>) -> Image<'a> {
    let Texture::Placed(Placed { figure: Figure::Image(image), .. }) = texture else {
        unreachable!("{texture:?}")
    };
    *image
}

#[test]
fn pictures_lie_on_surfaces() {
    let mut file = textured();
    with_file(&file, |import| {
        let material = import.scene.materials[0];
        let expected = Image {
            width: 2,
            height: 2,
            pixels: Pixels::Rgb888(&[255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255]),
            encoding: Encoding::Srgb,
            filter: Filter::Bilinear,
            ends: Ends::ExtendMirror,
        };
        assert_eq!((image(material.color), material.maps), (expected, &[][..]));
        assert_eq!(mesh(&import, 0).uvs.unwrap()[0], [0.0, 1.0]);
        check(&import.scene).unwrap();
    });
    assert_eq!(notes(&file), [""; 0]);
    // Half of the light is code 188. A metal mirrors in the color of its picture.
    let pbr = &mut file["materials"][0]["pbrMetallicRoughness"];
    pbr["baseColorFactor"] = json!([0.5, 1, 1, 1]);
    pbr["metallicFactor"] = json!(1);
    pbr["roughnessFactor"] = json!(0);
    file["samplers"] = json!([{ "magFilter": 9728, "wrapS": 33648, "wrapT": 33648 }]);
    with_file(&file, |import| {
        let material = import.scene.materials[0];
        let image = image(material.color);
        assert_eq!((image.filter, image.ends), (Filter::Nearest, Ends::Mirror));
        assert_eq!(image.pixels, Pixels::Rgb888(&[188, 0, 0, 0, 255, 0, 0, 0, 255, 188, 255, 255]));
        assert_eq!(material.optics.unwrap().reflection_color, LinearRgb::WHITE);
        assert_eq!(material.maps, &[Map { onto: Onto::ReflectionColor, texture: material.color }]);
    });
}

#[test]
fn textures_choose_and_move_their_coordinates() {
    let first = |info: Value| {
        let mut file = textured();
        file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = info;
        with_file(&file, |import| mesh(&import, 0).uvs.unwrap()[1])
    };
    assert_eq!(first(json!({ "index": 0, "texCoord": 0 })), [1.0, 1.0]);
    let moved = |transform: Value| {
        first(json!({ "index": 0, "texCoord": 1, "extensions": { "KHR_texture_transform": transform } }))
    };
    assert_eq!(moved(json!({})), [1.0, 1.0]);
    assert_eq!(moved(json!({ "offset": [0.25, 0.5], "scale": [3, 2] })), [3.25, 0.5]);
    // Counterclockwise, with v growing downward: from the right upward.
    let [u, v] = moved(json!({ "rotation": core::f32::consts::FRAC_PI_2 }));
    assert!(u.abs() < 1e-6 && (v - 2.0).abs() < 1e-6, "{u}, {v}");
}

#[test]
fn alpha_of_pictures_is_seen_through() {
    let mut file = textured();
    file["materials"][0]["alphaMode"] = json!("BLEND");
    let palettes = |file: &Value| {
        with_file(file, |import| {
            let material = import.scene.materials[0];
            check(&import.scene).unwrap();
            assert_eq!((material.diffuse, material.transmittance, material.ior), (1.0, 1.0, 1.0));
            let map = |onto| image(material.maps.iter().find(|map| map.onto == onto).unwrap().texture);
            [Onto::Diffuse, Onto::Transmittance].map(|onto| {
                let Pixels::Palette8 { indices, palette } = map(onto).pixels else { unreachable!() };
                [0, 3].map(|pixel: usize| palette[usize::from(indices[pixel])])
            })
        })
    };
    assert_eq!(palettes(&file), [[[255; 3], [128; 3]], [[0; 3], [127; 3]]]);
    file["materials"][0]["alphaMode"] = json!("MASK");
    file["materials"][0]["alphaCutoff"] = json!(0.6);
    assert_eq!(palettes(&file), [[[255; 3], [0; 3]], [[0; 3], [255; 3]]]);
    // Holes have sharp edges.
    with_file(&file, |import| {
        for map in import.scene.materials[0].maps {
            assert_eq!(image(map.texture).filter, Filter::Nearest);
        }
        assert_eq!(image(import.scene.materials[0].color).filter, Filter::Bilinear);
    });
    // All pixels pass the cutoff, so the surface is opaque.
    file["materials"][0]["alphaCutoff"] = json!(0.5);
    with_file(&file, |import| assert_eq!(import.scene.materials[0].maps, &[]));
}

/// The gray level of a map of a material, of two pixels.
fn levels(material: &Material<'_>, onto: Onto) -> Vec<u8> {
    let map = material.maps.iter().find(|map| map.onto == onto).unwrap();
    let image = image(map.texture);
    let gray = |line: u16| (image.light(0, line).g * 255.0).round() as u8;
    vec![gray(0), gray(image.height - 1)]
}

#[test]
fn metals_and_roughness_differ_by_texel() {
    let mut file = textured();
    // Above rough and no metal, below smooth metal.
    file["images"][0]["uri"] = json!(uri(&to_png((1, 2), 3, &[9, 255, 0, 9, 0, 255]).unwrap()));
    file["materials"] = json!([{ "pbrMetallicRoughness": {
        "baseColorFactor": [0.25, 0.5, 1, 1], "metallicRoughnessTexture": { "index": 0 },
    } }]);
    with_file(&file, |import| {
        let material = import.scene.materials[0];
        check(&import.scene).unwrap();
        assert_eq!((material.reflectance, material.diffuse, material.ambient), (1.0, 1.0, 0.1));
        assert_eq!(levels(&material, Onto::Diffuse), [255, 0]);
        assert_eq!(levels(&material, Onto::Ambient), [255, 0]);
        assert_eq!(levels(&material, Onto::Reflectance), [0, 255]);
        assert_eq!(levels(&material, Onto::Specular), [0, 255]);
        let optics = material.optics.unwrap();
        assert_eq!(optics.reflection_color, LinearRgb::new(0.25, 0.5, 1.0));
        assert_eq!(optics.fresnel, Fresnel::Constant);
    });
    assert_eq!(notes(&file), [""; 0]);
    // Factors: 0.8 of a metal, of roughness 0, beside plastic of roughness 1/4, which mirrors 4 %.
    file["images"][0]["uri"] = json!(uri(&to_png((1, 2), 3, &[9, 255, 0, 9, 0, 255]).unwrap()));
    let pbr = &mut file["materials"][0]["pbrMetallicRoughness"];
    (pbr["metallicFactor"], pbr["roughnessFactor"]) = (json!(0.8), json!(0.25));
    with_file(&file, |import| {
        let material = import.scene.materials[0];
        assert!((material.reflectance - 0.808).abs() < 1e-6, "{}", material.reflectance);
        assert_eq!(levels(&material, Onto::Diffuse), [255, 51]);
        assert_eq!(levels(&material, Onto::Reflectance), [6, 255]);
    });
    // Plastic alone has Fresnel's coat of the texel's sharpness.
    file["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = json!(0);
    with_file(&file, |import| {
        let material = import.scene.materials[0];
        assert_eq!((material.reflectance, material.optics.unwrap().fresnel), (1.0, Fresnel::Exact));
        assert_eq!(levels(&material, Onto::Reflectance), [128, 255]);
        assert!(!material.maps.iter().any(|map| map.onto == Onto::Diffuse));
    });
    // Texels that hardly differ need no maps: the mean is used. So it is, with a note, on other coordinates.
    file["images"][0]["uri"] = json!(uri(&to_png((1, 2), 3, &[9, 100, 255, 9, 102, 255]).unwrap()));
    with_file(&file, |import| assert_eq!(import.scene.materials[0].maps, &[]));
    assert_eq!(notes(&file), [""; 0]);
    file["images"][0]["uri"] = json!(uri(&to_png((1, 2), 3, &[9, 255, 0, 9, 0, 255]).unwrap()));
    let pbr = &mut file["materials"][0]["pbrMetallicRoughness"];
    pbr["baseColorTexture"] = json!({ "index": 0, "texCoord": 1 });
    with_file(&file, |import| assert_eq!(import.scene.materials[0].maps, &[]));
    assert_eq!(notes(&file), ["model.gltf: material 0: the mean of the metallic-roughness texture is used"]);
}

#[test]
fn emissive_and_normal_textures_are_maps() {
    let mut file = textured();
    file["materials"] = json!([{
        "emissiveTexture": { "index": 0, "texCoord": 1 },
        "emissiveFactor": [1, 0.5, 0.25],
        "normalTexture": { "index": 0, "texCoord": 1, "scale": 0.75 },
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 2 } },
        "pbrMetallicRoughness": { "baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0 },
    }]);
    with_file(&file, |import| {
        let material = import.scene.materials[0];
        check(&import.scene).unwrap();
        assert_eq!(mesh(&import, 0).uvs.unwrap()[0], [0.5, 0.5]);
        assert_eq!(material.optics.unwrap().emission, LinearRgb::new(2.0, 1.0, 0.5));
        let map = |onto| image(material.maps.iter().find(|map| map.onto == onto).unwrap().texture);
        assert_eq!(map(Onto::Emission).light(0, 0), LinearRgb::new(1.0, 0.0, 0.0));
        let normals = map(Onto::Normal { strength: 0.75 });
        assert_eq!((normals.encoding, normals.light(1, 0).g), (Encoding::Linear, 1.0));
        assert_eq!(material.maps.len(), 2);
    });
    assert_eq!(notes(&file), [""; 0]);
    // A base color on other coordinates: the mean shines.
    file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
    with_file(&file, |import| {
        let material = import.scene.materials[0];
        assert_eq!(material.optics.unwrap().emission, LinearRgb::new(1.0, 0.5, 0.25));
        assert_eq!(material.maps, &[]);
    });
    let said = ["the normal texture is left out", "the mean of the emissive texture is used"];
    assert_eq!(notes(&file), said.map(|note| format!("model.gltf: material 0: {note}")));
    // A picture that cannot be read does not shine.
    file["images"][0]["uri"] = json!("none.png");
    with_file(&file, |import| {
        let optics = *import.scene.materials[0].optics.unwrap();
        assert_eq!(optics, Optics { sides: Sides::Front, ..Optics::PLAIN });
    });
    // Both sides of an open mesh are seen if the file says so.
    file["materials"][0]["doubleSided"] = json!(true);
    with_file(&file, |import| assert_eq!(import.scene.materials[0].optics, None));
}

#[test]
fn pictures_that_materials_share_are_held_once() {
    let mut file = textured();
    // More than 256 colors.
    let pixels: Vec<u8> = (0..900u32).flat_map(|i| [(i % 30) as u8, (i / 30) as u8, 7]).collect();
    file["images"][0]["uri"] = json!(uri(&to_png((30, 30), 3, &pixels).unwrap()));
    let material = file["materials"][0].clone();
    file["materials"] = json!(vec![material; 17]);
    let primitive = file["meshes"][0]["primitives"][0].clone();
    let primitives = (0..17).map(|index| {
        let mut primitive = primitive.clone();
        primitive["material"] = json!(index);
        primitive
    });
    file["meshes"][0]["primitives"] = json!(primitives.collect::<Vec<_>>());
    with_file(&file, |import| {
        let Texture::Placed(first) = import.scene.materials[0].color else { unreachable!() };
        assert_eq!(import.scene.materials.len(), 17);
        for material in import.scene.materials {
            assert!(matches!(material.color, Texture::Placed(placed) if core::ptr::eq(placed, first)));
        }
    });
    // A picture of one color is one pixel, and one of few colors shares its numbers between factors.
    file["images"][0]["uri"] = json!(uri(&to_png((30, 30), 3, &[[200u8, 100, 50]; 900].concat()).unwrap()));
    with_file(&file, |import| {
        let image = image(import.scene.materials[3].color);
        assert_eq!((image.width, image.height, image.light(0, 0).r > 0.5), (1, 1, true));
    });
    let pixels: Vec<u8> = (0..900u32).flat_map(|i| [(i % 3 * 100) as u8, 0, 0]).collect();
    file["images"][0]["uri"] = json!(uri(&to_png((30, 30), 3, &pixels).unwrap()));
    file["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"] = json!([0.5, 1, 1, 1]);
    with_file(&file, |import| {
        let [(first, whole), (second, half)] = [0, 1].map(|index: usize| {
            let Pixels::Palette8 { indices, palette } = image(import.scene.materials[index].color).pixels
            else {
                unreachable!()
            };
            (indices, palette)
        });
        assert!(core::ptr::eq(first, second));
        assert_eq!(
            (whole, half),
            (&[[0; 3], [100, 0, 0], [200, 0, 0]][..], &[[0; 3], [71, 0, 0], [146, 0, 0]][..])
        );
    });
}

#[test]
fn textures_repeat_at_any_coordinates() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let of = |uvs: [[f32; 2]; 3], wrap: u32| {
        let lists = Lists::default().floats(&triangle).floats(&uvs);
        let mut file = textured();
        let of_lists = lists.file(json!({ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 }));
        for part in ["buffers", "bufferViews", "accessors", "meshes"] {
            file[part] = of_lists[part].clone();
        }
        file["samplers"] = json!([{ "wrapS": wrap, "wrapT": wrap }]);
        file
    };
    let read = |file: &Value| {
        with_file(file, |import| {
            check(&import.scene).unwrap();
            let mut memory =
                vec![core::mem::MaybeUninit::uninit(); import.scene.bytes::<rayline::math::Fixed>()];
            rayline::PreparedScene::<rayline::math::Fixed, _>::new(&import.scene, &mut memory).unwrap();
            let Texture::Placed(placed) = import.scene.materials[0].color else { unreachable!() };
            (mesh(&import, 0).uvs.unwrap().to_vec(), placed.placement.size.x)
        })
    };
    let (repeat, mirror, clamp) = (10497, 33648, 33071);
    // Coordinates are moved by whole periods into ±59: one of a repeated texture, two of a mirrored one.
    let far = [[1000.25, 0.0], [1001.25, -700.0], [1000.25, 1.0 - 700.0]];
    assert_eq!(
        read(&of(far, repeat)),
        (
            [[-0.75, -350.0], [0.25, 350.0], [-0.75, 349.0]]
                .iter()
                .map(|[u, v]: &[f32; 2]| [u / 8.0, v / 8.0])
                .collect::<Vec<_>>(),
            0.125
        )
    );
    let near = [[100.0, 0.0], [100.0, 100.0], [0.0, 100.0]];
    assert_eq!(read(&of(near, repeat)), (vec![[50.0, 50.0], [50.0, -50.0], [-50.0, -50.0]], 1.0));
    let odd = [[101.0, 0.0], [102.0, 0.0], [101.0, 1.0]];
    assert_eq!(read(&of(odd, mirror)).0, [[-1.0, 1.0], [0.0, 1.0], [-1.0, 0.0]]);
    // A clamped texture has no period: the coordinates are halved, and the texture is half as large.
    assert_eq!(read(&of(near, clamp)), (vec![[50.0, 0.5], [50.0, -49.5], [0.0, -49.5]], 0.5));
    assert_eq!(notes(&of(near, clamp)), [""; 0]);
    // In range, nothing is moved.
    let usual = [[40.0, 0.0], [41.0, 0.0], [40.0, 1.0]];
    assert_eq!(read(&of(usual, repeat)).0, [[40.0, 1.0], [41.0, 1.0], [40.0, 0.0]]);
    let note = "model.gltf: mesh 0 `Cube`, primitive 0: texture coordinates are left out: some are beyond \
                ±30,000,000";
    assert_eq!(notes(&of([[0.0, 0.0], [1e9, 0.0], [0.0, 1.0]], repeat))[0], note);
}

#[test]
fn specular_and_glossiness_become_coats_and_metals() {
    let of = |gloss: Value| json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": gloss } });
    let red = json!([0.75, 0.25, 0, 1]);
    // A coat that mirrors 4 %, of roughness 1/4.
    let plastic =
        json!({ "diffuseFactor": red, "specularFactor": [0.04, 0.04, 0.04], "glossinessFactor": 0.75 });
    with_material(of(plastic), |material| {
        assert_eq!((material.color, material.diffuse), (Texture::Solid(RED), 1.0));
        assert!((material.ior - 1.5).abs() < 1e-5 && material.reflectance == 0.5, "{material:?}");
        assert_eq!((material.optics.unwrap().fresnel, material.shininess), (Fresnel::Exact, 510.0));
    });
    // A metal: it mirrors in the specular color, and 1 - 0.8 of the diffuse color is left.
    let gold = json!({ "diffuseFactor": red, "specularFactor": [0.8, 0.5, 0.2] });
    with_material(of(gold), |material| {
        assert_eq!((material.reflectance, material.diffuse), (1.0, 1.0));
        let Texture::Solid(color) = material.color else { unreachable!() };
        assert!(
            (color.r - 0.15).abs() < 1e-6 && (color.g - 0.05).abs() < 1e-6 && color.b == 0.0,
            "{color:?}"
        );
        assert_eq!(material.optics.unwrap().reflection_color, LinearRgb::new(0.8, 0.5, 0.2));
    });
    // Rough: matte, in both colors together.
    let rough = json!({ "diffuseFactor": red, "specularFactor": [0.5, 0, 0], "glossinessFactor": 0 });
    with_material(of(rough), |material| {
        assert_eq!(material, Material { color: LinearRgb::new(0.875, 0.125, 0.0).into(), ..MATTE_RED });
    });
    // A diffuse color alone is that of plastic.
    with_material(of(json!({ "diffuseFactor": red })), |material| {
        assert_eq!((material.color, material.reflectance), (Texture::Solid(RED), 1.0));
    });
    let mut file = textured();
    file["materials"] = json!([of(json!({ "diffuseTexture": { "index": 0, "texCoord": 1 } }))]);
    with_file(&file, |import| {
        assert_eq!(image(import.scene.materials[0].color).width, 2);
        assert_eq!(mesh(&import, 0).uvs.unwrap()[0], [0.5, 0.5]);
    });
}

#[test]
fn clear_coats_and_specular_factors_change_reflections() {
    let with = |mut base: Value, name: &str, extension: Value| {
        base["extensions"] = json!({ name: extension });
        base
    };
    // Half of a clear coat of roughness 0 over a rough red surface, and over a rough metal.
    let coat = json!({ "clearcoatFactor": 0.5 });
    for metallic in [0.0, 1.0] {
        let painted = pbr([0.75, 0.25, 0.0, 1.0], metallic, 1.0);
        with_material(with(painted, "KHR_materials_clearcoat", coat.clone()), |material| {
            assert_eq!((material.color, material.diffuse), (Texture::Solid(RED), 1.0));
            assert_eq!((material.reflectance, material.ior, material.specular), (0.5, 1.5, 0.5));
            let optics = material.optics.unwrap();
            assert_eq!((optics.fresnel, optics.reflection_color), (Fresnel::Exact, LinearRgb::WHITE));
        });
    }
    let specular = json!({ "specularFactor": 0.5, "specularColorFactor": [1, 0.5, 0.25] });
    let smooth = pbr([1.0; 4], 0.0, 0.25);
    with_material(with(smooth.clone(), "KHR_materials_specular", specular), |material| {
        assert_eq!((material.reflectance, material.specular), (0.25, 0.375));
        assert_eq!(material.optics.unwrap().reflection_color, LinearRgb::new(1.0, 0.5, 0.25));
    });
    let none = json!({ "specularFactor": 0 });
    with_material(with(smooth, "KHR_materials_specular", none), |material| {
        assert_eq!((material.reflectance, material.optics), (0.0, None));
    });
}

#[test]
fn pictures_come_from_files_and_buffers_in_png_and_jpeg() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("my pictures")).unwrap();
    let jpeg = BASE64_STANDARD.decode(GRAY_JPEG).unwrap();
    fs::write(folder.path().join("my pictures/gray.jpg"), jpeg).unwrap();
    let mut file = textured();
    let path = folder.path().join("model.gltf");
    for uri in ["my%20pictures/./gray.jpg", "my pictures\\gray.jpg"] {
        file["images"][0]["uri"] = json!(uri);
        fs::write(&path, file.to_string()).unwrap();
        let arena = Bump::new();
        let import = read(&arena, &path, &OpenOptions::default()).unwrap();
        let image = image(import.scene.materials[0].color);
        let light = image.light(0, 0);
        assert!((light.g - 0.578).abs() < 0.01, "{light:?}");
    }

    let bytes = picture();
    file["images"][0] = json!({ "bufferView": 3, "mimeType": "image/png" });
    file["buffers"].as_array_mut().unwrap().push(json!({ "uri": uri(&bytes), "byteLength": bytes.len() }));
    let view = json!({ "buffer": 1, "byteLength": bytes.len() });
    file["bufferViews"].as_array_mut().unwrap().push(view);
    with_file(&file, |import| assert_eq!(image(import.scene.materials[0].color).width, 2));
}

#[test]
fn notes_list_what_is_left_out_of_materials() {
    let mut file = textured();
    file["samplers"] = json!([{}]);
    file["materials"][0]["normalTexture"] = json!({ "index": 0, "texCoord": 1 });
    file["materials"][0]["occlusionTexture"] = json!({ "index": 0 });
    let transmission = json!({ "transmissionFactor": 1, "transmissionTexture": { "index": 0 } });
    file["materials"][0]["extensions"] = json!({ "KHR_materials_transmission": transmission });
    let expected = [
        "the occlusion texture is left out",
        "the transmission texture is left out",
        "the normal texture is left out",
    ];
    assert_eq!(notes(&file), expected.map(|note| format!("model.gltf: material 0: {note}")));

    // One material on two meshes becomes two materials, if only one mesh has texture coordinates.
    let mut file = textured();
    file["samplers"] = json!([{}]);
    let bare = json!({ "attributes": { "POSITION": 0 }, "material": 0 });
    file["meshes"][0]["primitives"].as_array_mut().unwrap().push(bare);
    let note = "model.gltf: material 0: the texture is left out on meshes without texture coordinates";
    assert_eq!(notes(&file), [note]);
    with_file(&file, |import| {
        assert_eq!(import.scene.materials.len(), 2);
        assert_eq!(import.scene.materials[1].color, Texture::Solid(LinearRgb::WHITE));
    });

    // If an image cannot be read, the rest of the file is shown.
    file["images"][0]["uri"] = json!("none.png");
    assert!(
        notes(&file)[0].starts_with("model.gltf: image 0: left out: cannot read none.png: "),
        "{:?}",
        notes(&file)
    );
    file["images"][0]["uri"] = json!(uri(b"no picture"));
    assert!(notes(&file)[0].starts_with("model.gltf: image 0: left out: "), "{:?}", notes(&file));
    file["textures"] = json!([{ "extensions": { "EXT_texture_webp": { "source": 0 } } }]);
    assert_eq!(notes(&file)[0], "model.gltf: texture 0: left out: its format is not PNG or JPEG");
}
