//! The JSON of a file, and the binary chunk of a `.glb` file (glTF 2.0 Specification, section 4.4).

use serde::Deserialize;

use super::error::{At, GltfFault, Wrong};
use super::json::Root;
use crate::text::without_mark;

/// The extensions that are read.
const EXTENSIONS: [&str; 8] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
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
    let root: Root = serde_json::from_slice(json).map_err(broken)?;
    if let Some(name) = unknown_extensions(&root.extensions_required).next() {
        return Err(GltfFault::Extension(name.clone()).into());
    }
    Ok(root)
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
