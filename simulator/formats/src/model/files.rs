//! Files that a model names.

use std::fs;
use std::path::{Path, PathBuf};

use crate::files::Files;

/// A file that a model names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Beside {
    /// The file is in the folder of the model or below.
    Found(PathBuf),
    /// The model names a file elsewhere; one of the same name beside the model is used.
    Instead(PathBuf),
    /// There is no such file in the folder or below.
    Missing,
    /// The model names a file elsewhere, which is not read, and there is none of the same name beside it.
    Outside,
}

/// Finds the file that a model in this folder names. It is never sought elsewhere than in the folder of the
/// scene or below, unless all paths are allowed. A backslash separates folders, as on Windows, and letters
/// may have another case.
pub(crate) fn beside(folder: &Path, name: &str, files: &Files) -> Beside {
    let parts: Vec<&str> =
        name.split(['/', '\\']).map(str::trim).filter(|part| !matches!(*part, "" | ".")).collect();
    let has_scheme = name.contains("://") || parts.iter().any(|part| part.ends_with(':'));
    let named = name.replace('\\', "/");
    if let Ok(path) = files.reference(folder, &named)
        && !has_scheme
    {
        let found = if path.is_file() || named.starts_with('/') { Some(path) } else { find(folder, &parts) };
        return found.filter(|path| path.is_file()).map_or(Beside::Missing, Beside::Found);
    }
    let last = parts.last().filter(|part| **part != ".." && !part.contains(':'));
    match last.and_then(|part| find(folder, &[part])) {
        Some(path) => Beside::Instead(path),
        None => Beside::Outside,
    }
}

/// The regular file of this path below a folder.
fn find(folder: &Path, parts: &[&str]) -> Option<PathBuf> {
    let mut path = folder.to_owned();
    for part in parts {
        let exact = path.join(part);
        path = if exact.exists() { exact } else { of_any_case(&path, part)? };
    }
    (!parts.is_empty() && path.is_file()).then_some(path)
}

/// The first entry of a folder, by the order of names, that has this name in upper or lower case.
fn of_any_case(folder: &Path, name: &str) -> Option<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let is_meant =
        |entry: &fs::DirEntry| entry.file_name().to_string_lossy().to_lowercase() == name.to_lowercase();
    let entries = fs::read_dir(folder).ok()?.filter_map(Result::ok).filter(is_meant);
    entries.map(|entry| entry.path()).min()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_beside_a_model_only() {
        let folder = tempfile::tempdir().unwrap();
        let (inside, model) = (folder.path().join("model/maps"), folder.path().join("model"));
        fs::create_dir_all(&inside).unwrap();
        for path in [inside.join("Wood.PNG"), model.join("a b.png"), folder.path().join("secret.png")] {
            fs::write(path, "").unwrap();
        }
        let files = Files::new(&model.join("model.obj"), false);
        let beside = |name: &str| beside(&model, name, &files);
        let wood = Beside::Found(inside.join("Wood.PNG"));
        for name in ["maps/Wood.PNG", "maps\\wood.png", ".\\MAPS\\Wood.png", "./maps//Wood.PNG"] {
            assert_eq!(beside(name), wood, "{name}");
        }
        assert_eq!(beside("A B.png"), Beside::Found(model.join("a b.png")));
        assert_eq!(beside("maps"), Beside::Missing);
        assert_eq!(beside(""), Beside::Missing);
        for name in ["../secret.png", "/etc/passwd", "C:\\x\\..\\secret.png", "http://x.org/y.png", ".."] {
            assert_eq!(beside(name), Beside::Outside, "{name}");
        }
        for name in ["C:\\art\\a b.png", "/art/a b.png", "../a b.png"] {
            assert_eq!(beside(name), Beside::Instead(model.join("a b.png")), "{name}");
        }
        let files = Files::new(&model.join("model.obj"), true);
        assert_eq!(
            super::beside(&model, "../secret.png", &files),
            Beside::Found(model.join("../secret.png"))
        );
    }
}
