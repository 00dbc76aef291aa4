//! Scenes as the bytes that programs read.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use rayline::Scene;

use crate::toolchain;

/// Writes the bytes of each scene into a folder, with the program `rayline`; returns the files.
pub(crate) fn to_bytes(scenes: &[PathBuf], folder: &Path) -> Result<Vec<PathBuf>> {
    // A program of its own: its readers of scene files would take longer to build into this one than all the
    // rest.
    let rayline = toolchain::build_here("rayline")?;
    let convert = |scene: &PathBuf| {
        let bytes = folder.join(scene.file_stem().unwrap_or_default()).with_extension("rayline");
        let arguments = [scene.as_os_str(), bytes.as_os_str()];
        let flags = ["convert", "--quiet"].map(AsRef::as_ref);
        toolchain::output_of(rayline.as_os_str(), &[flags, arguments].concat())?;
        Ok(bytes)
    };
    scenes.iter().map(convert).collect()
}

/// Writes a scene of this program into a file.
pub(crate) fn write(scene: &Scene<'_>, file: &Path) -> Result<()> {
    let mut room = vec![0; 1 << 20];
    fs::write(file, scene.to_bytes(&mut room)?).with_context(|| file.display().to_string())
}
