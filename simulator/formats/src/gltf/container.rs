//! The JSON of a file, and the binary chunk of a `.glb` file (glTF 2.0 Specification, section 4.4).

use serde::Deserialize;
use serde_json::Value;

use super::error::{At, GltfFault, Wrong};
use super::json::Root;
use crate::text::without_mark;

/// The extensions that are read.
const EXTENSIONS: [&str; 12] = [
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
];

/// Extensions that a file may require although they are left out. The scene at rest looks the same without
/// them, or only the finish of a surface or a picture on it is another one.
const WITHOUT_HARM: [&str; 33] = [
    // Choices, movements and descriptions.
    "AGI_articulations",
    "AGI_stk_metadata",
    "CESIUM_primitive_outline",
    "EXT_feature_metadata",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "KHR_animation2",
    "KHR_animation_pointer",
    "KHR_audio",
    "KHR_audio_emitter",
    "KHR_implicit_shapes",
    "KHR_interactivity",
    "KHR_materials_variants",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_physics_rigid_bodies",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MSFT_lod",
    "MSFT_packing_normalRoughnessMetallic",
    "MSFT_packing_occlusionRoughnessMetallic",
    // The finish of surfaces.
    "KHR_materials_anisotropy",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    // Formats of pictures.
    "EXT_texture_avif",
    "EXT_texture_webp",
    "GOOGLE_texture_basis",
    "KHR_texture_basisu",
    "MSFT_texture_dds",
    "MSFT_texture_ktx",
];

/// Reads the JSON, and returns the bytes of the first buffer if they are in the file.
pub(super) fn open(bytes: &[u8]) -> Result<(Root, Option<&[u8]>), Wrong> {
    let (json, buffer) = if bytes.starts_with(b"glTF") { split(bytes)? } else { (without_mark(bytes), None) };
    Ok((parse(json)?, buffer))
}

/// The unsupported extensions in a list.
pub(super) fn unknown_extensions(used: &[String]) -> impl Iterator<Item = &String> {
    used.iter().filter(|name| !EXTENSIONS.contains(&name.as_str()))
}

fn parse(json: &[u8]) -> Result<Root, Wrong> {
    /// Only the version: in other versions all other fields may differ.
    #[derive(Deserialize)]
    struct Versioned {
        asset: Asset,
    }
    #[derive(Deserialize)]
    struct Asset {
        version: String,
    }
    let broken = |error: serde_json::Error| GltfFault::Json(error.to_string());
    let Versioned { asset: Asset { version } } = serde_json::from_slice(json).map_err(broken)?;
    if version != "2" && !version.starts_with("2.") {
        return Err(GltfFault::Version(version).into());
    }
    let root: Root = match serde_json::from_slice(json) {
        Ok(root) => root,
        // If both ways of reading fail, report the error of the first: it has a position.
        Err(error) => parse_loosely(json).ok_or_else(|| broken(error))?,
    };
    let required = || unknown_extensions(&root.extensions_required);
    if let Some(name) = required().find(|name| !WITHOUT_HARM.contains(&name.as_str())) {
        return Err(GltfFault::Extension(name.clone()).into());
    }
    Ok(root)
}

/// Reads JSON in which whole numbers are written as `5126.0`, or parts that are not there as `null`; `None`
/// if it is wrong in another way.
fn parse_loosely(json: &[u8]) -> Option<Root> {
    let mut all: Value = serde_json::from_slice(json).ok()?;
    // The text has a limit to its nesting, so the list stays short.
    let mut open = vec![&mut all];
    while let Some(value) = open.pop() {
        match value {
            Value::Array(list) => open.extend(list),
            Value::Object(fields) => {
                fields.retain(|name, value| !value.is_null() && name != "extras");
                open.extend(fields.values_mut());
            }
            Value::Number(number) => {
                if let Some(whole) = number.as_f64().and_then(whole) {
                    *value = whole.into();
                }
            }
            _ => {}
        }
    }
    // As text again, so that there is one reader of all parts.
    serde_json::from_slice(&serde_json::to_vec(&all).ok()?).ok()
}

/// The whole number that a floating-point number is; `None` if it has a fraction, or is too large or
/// negative.
fn whole(number: f64) -> Option<u64> {
    // All whole numbers up to 2⁵³ have a floating-point number of their own.
    let is_whole = (0.0..=9_007_199_254_740_992.0).contains(&number) && number.fract() == 0.0;
    is_whole.then_some(number as u64)
}

/// The chunks of a binary file: the JSON, and the bytes if there are any.
fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Wrong> {
    let (header, _) = words::<3>(bytes)?;
    let [_, version, length] = header;
    if version != 2 {
        return Err(GltfFault::Version(version.to_string()).into());
    }
    let truncated = || GltfFault::Truncated { needed: length.into(), given: bytes.len() as u64 };
    let all = usize::try_from(length).ok().and_then(|length| bytes.get(..length)).ok_or_else(truncated)?;
    let rest = all.get(12..).ok_or_else(truncated)?;
    let (kind, json, rest) = chunk(rest).at(|| "first chunk".to_owned())?;
    if kind != u32::from_le_bytes(*b"JSON") {
        return Err(GltfFault::NoJson.into());
    }
    // A file without a second chunk has all of its bytes in other files.
    if rest.is_empty() {
        return Ok((json, None));
    }
    let (kind, bytes, _) = chunk(rest).at(|| "second chunk".to_owned())?;
    Ok((json, (kind == u32::from_le_bytes(*b"BIN\0")).then_some(bytes)))
}

/// The kind of the first chunk, its contents, and the bytes after it.
fn chunk(bytes: &[u8]) -> Result<(u32, &[u8], &[u8]), GltfFault> {
    let ([length, kind], rest) = words::<2>(bytes)?;
    let truncated = || GltfFault::Truncated { needed: length.into(), given: rest.len() as u64 };
    let split = usize::try_from(length).ok().and_then(|length| rest.split_at_checked(length));
    let (content, rest) = split.ok_or_else(truncated)?;
    Ok((kind, content, rest))
}

/// The first `N` numbers of 32 bits, and the bytes after them.
fn words<const N: usize>(bytes: &[u8]) -> Result<([u32; N], &[u8]), GltfFault> {
    let truncated = || GltfFault::Truncated { needed: 4 * N as u64, given: bytes.len() as u64 };
    let (head, rest) = bytes.split_at_checked(4 * N).ok_or_else(truncated)?;
    let mut words = [0; N];
    for (word, bytes) in words.iter_mut().zip(head.as_chunks::<4>().0) {
        *word = u32::from_le_bytes(*bytes);
    }
    Ok((words, rest))
}
