//! Draws a finding's file again.

use std::path::Path;

use crate::case::Case;
use crate::check::{Bench, Finding, Held};
use crate::scene_bytes::read;
use crate::search::contents;

/// Checks the scene in a file, drawn as the file's name says; tells the kinds of its shapes and lights too.
///
/// # Errors
/// The file is not there or no scene, or its name says not how it is drawn. The finding is the value, not
/// an error.
pub fn replay(path: &Path) -> Result<(Case, String, Result<Held, Finding>), String> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let case: Case = name.parse()?;
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut bench = Bench::default();
    #[cfg(feature = "importers")]
    if path.extension().is_none_or(|extension| extension != "rayline") {
        let arena = bumpalo::Bump::new();
        let loaded = rayline_simulator::LoadedScene::open(path, &arena).map_err(|error| error.to_string())?;
        return Ok((case, contents(&loaded.scene), bench.check_caught(&loaded.scene, &case)));
    }
    let mut lists = Vec::new();
    let scene = read(&bytes, &mut lists).ok_or_else(|| format!("{} holds no scene", path.display()))?;
    Ok((case, contents(&scene), bench.check_caught(&scene, &case)))
}
