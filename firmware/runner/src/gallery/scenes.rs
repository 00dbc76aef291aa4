//! The scenes of a folder, as the boards' program reads them.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::picture::SceneSource;
use crate::request::Request;
use crate::toolchain;

/// All scenes of a folder.
#[derive(Debug)]
pub(super) struct Scenes {
    pub(super) sources: Vec<SceneSource>,
    /// What the program reads: how many bytes a scene has, these, and so on.
    pub(super) file: Vec<u8>,
}

impl Scenes {
    /// Reads all `.ron` files of a folder, in the order of their names.
    pub(super) fn read(folder: &Path) -> Result<Self> {
        let shown = folder.display();
        let mut texts = Vec::new();
        for entry in fs::read_dir(folder).with_context(|| shown.to_string())? {
            let path = entry?.path();
            if path.extension().is_some_and(|extension| extension == "ron") {
                texts.push(path);
            }
        }
        ensure!(!texts.is_empty(), "{shown}: there is no .ron file in it");
        texts.sort();
        eprintln!("reading {} scenes (the first time takes a few minutes)", texts.len());
        let (mut sources, mut file) = (Vec::new(), Vec::new());
        let converted = tempfile::tempdir()?;
        for bytes in convert(&texts, converted.path())? {
            sources.push(Request::new(bytes.to_str().context("a path that is not UTF-8")?)?.scene);
            append(&mut file, &fs::read(bytes)?)?;
        }
        Ok(Self { sources, file })
    }
}

/// Has `rayline` write the bytes of each scene into a folder.
fn convert(texts: &[PathBuf], folder: &Path) -> Result<Vec<PathBuf>> {
    // Started as a program: linked into this one, its readers of files would take longer to build than all
    // the rest.
    let rayline = toolchain::build_here("rayline")?;
    let convert = |text: &PathBuf| {
        let bytes = folder.join(text.file_stem().unwrap_or_default()).with_extension("rayline");
        let output = Command::new(&rayline).args(["convert", "--quiet"]).args([text, &bytes]).output()?;
        ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr).trim_end());
        Ok(bytes)
    };
    texts.iter().map(convert).collect()
}

/// Adds a scene to the file that the program reads.
fn append(file: &mut Vec<u8>, scene: &[u8]) -> Result<()> {
    file.extend(u32::try_from(scene.len())?.to_le_bytes());
    file.extend(scene);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_scene_comes_after_its_length() {
        let mut file = Vec::new();
        append(&mut file, &[7; 258]).unwrap();
        append(&mut file, &[8]).unwrap();
        assert_eq!(file[..6], [2, 1, 0, 0, 7, 7]);
        assert_eq!(file[262..], [1, 0, 0, 0, 8]);
    }

    #[test]
    fn a_folder_without_scenes_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let error = Scenes::read(folder.path()).unwrap_err().to_string();
        assert!(error.ends_with("there is no .ron file in it"), "{error}");
    }
}
