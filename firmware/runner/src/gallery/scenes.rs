//! The scenes of a folder, as the boards' program reads them.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};

use crate::convert;
use crate::picture::SceneSource;
use crate::request::Request;

/// All scenes of a folder.
#[derive(Debug)]
pub(super) struct Scenes {
    pub(super) sources: Vec<SceneSource>,
    /// The file that the program reads: for each scene the number of its bytes, then the bytes.
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
        ensure!(!texts.is_empty(), "{shown}: there is no .ron file in it, name another folder");
        texts.sort();
        eprintln!("reading {} scenes (the first time takes a few minutes)", texts.len());
        let (mut sources, mut file) = (Vec::new(), Vec::new());
        let converted = tempfile::tempdir()?;
        for bytes in convert::to_bytes(&texts, converted.path())? {
            sources.push(Request::new(bytes.to_str().context("a path that is not UTF-8")?)?.scene);
            append(&mut file, &fs::read(bytes)?)?;
        }
        Ok(Self { sources, file })
    }
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
        assert!(error.ends_with("there is no .ron file in it, name another folder"), "{error}");
    }
}
