//! Buffers: the bytes that a file has or refers to.

use std::borrow::Cow;
use std::path::PathBuf;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use super::error::{At, GltfFault, Wrong, find, name};
use super::json::Root;
use crate::files::{Files, MAX_SCENE_BYTES};

/// The most bytes of all buffers together.
const MOST: usize = MAX_SCENE_BYTES as usize;

/// All buffers of a file.
#[derive(Debug)]
pub(super) struct Buffers<'f> {
    root: &'f Root,
    files: &'f Files,
    bytes: Vec<Cow<'f, [u8]>>,
}

impl<'f> Buffers<'f> {
    /// Reads all buffers; `binary` is the first buffer of a binary file.
    pub(super) fn read(root: &'f Root, files: &'f Files, binary: Option<&'f [u8]>) -> Result<Self, Wrong> {
        let mut all = Self { root, files, bytes: Vec::new() };
        let mut sum = 0usize;
        for (index, buffer) in root.buffers.iter().enumerate() {
            let bytes = match (&buffer.uri, binary) {
                (Some(uri), _) => all.resource(uri),
                (None, Some(binary)) if index == 0 => Ok(Cow::Borrowed(binary)),
                _ => Err(GltfFault::NoBytes),
            };
            let cut = bytes.and_then(|bytes| {
                let (needed, given) = (buffer.byte_length, bytes.len());
                sum = sum.saturating_add(given);
                if sum > MOST {
                    return Err(GltfFault::TooMany { what: "bytes of buffers", most: MOST });
                }
                if needed > given as u64 {
                    return Err(GltfFault::Short { needed, given: given as u64 });
                }
                Ok(bytes)
            });
            all.bytes.push(cut.at(|| name("buffer", index, buffer.name.as_ref()))?);
        }
        Ok(all)
    }

    /// The bytes of a view, and its stride if it has one.
    pub(super) fn view(&self, index: usize) -> Result<(&[u8], Option<usize>), Wrong> {
        let view = find(&self.root.buffer_views, "buffer view", index)?;
        let of_view = || {
            let bytes = find(&self.bytes, "buffer", view.buffer)?;
            let (start, length) = (view.byte_offset, view.byte_length);
            let end = start.saturating_add(length);
            let place = usize::try_from(start).ok().zip(usize::try_from(end).ok());
            let part = place.and_then(|(start, end)| bytes.get(start..end));
            part.ok_or(GltfFault::Short { needed: end, given: bytes.len() as u64 })
        };
        let bytes = of_view().at(|| name("buffer view", index, view.name.as_ref()))?;
        Ok((bytes, view.byte_stride))
    }

    /// The bytes of a URI: those in a `data:` URI, or those of a file in the folder or below, or with
    /// `--allow-paths` of any file.
    pub(super) fn resource(&self, uri: &str) -> Result<Cow<'f, [u8]>, GltfFault> {
        if let Some(data) = strip_scheme(uri, "data:") {
            let (_, text) = data
                .split_once(";base64,")
                .ok_or_else(|| GltfFault::NotBase64("`;base64,` is missing".to_owned()))?;
            let bytes = BASE64_STANDARD.decode(text.trim_ascii());
            return Ok(Cow::Owned(bytes.map_err(|error| GltfFault::NotBase64(error.to_string()))?));
        }
        let outside = || GltfFault::Outside(uri.to_owned());
        let name = name_in(uri).ok_or_else(outside)?;
        let path = self.files.reference(self.files.folder(), name).map_err(|_| outside())?;
        match self.files.read(&path) {
            Ok(bytes) => Ok(Cow::Owned(bytes)),
            Err(error) => Err(GltfFault::Unreadable(format!("cannot read {}: {error}", path.display()))),
        }
    }
}

fn strip_scheme<'u>(uri: &'u str, scheme: &str) -> Option<&'u str> {
    let (start, rest) = uri.split_at_checked(scheme.len())?;
    start.eq_ignore_ascii_case(scheme).then_some(rest)
}

/// The path in a URI.
fn name_in(uri: &str) -> Option<PathBuf> {
    // Some programs write the separator of their system.
    let path = unescaped(uri)?.replace('\\', "/");
    // A colon may belong to a scheme or a drive.
    if path.is_empty() || path.contains([':', '\0']) {
        return None;
    }
    Some(PathBuf::from(path))
}

/// The text of a URI in which some characters are written as `%` and two hexadecimal digits.
fn unescaped(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [byte, behind @ ..] = rest {
        rest = behind;
        if *byte != b'%' {
            bytes.push(*byte);
            continue;
        }
        let (digits, behind) = rest.split_at_checked(2)?;
        bytes.push(u8::from_str_radix(core::str::from_utf8(digits).ok()?, 16).ok()?);
        rest = behind;
    }
    String::from_utf8(bytes).ok()
}
