//! The core's modules use only what stands before them in the order that the crate page lists.

use std::path::{Path, PathBuf};

/// The modules, in the order of the crate page.
fn order() -> Vec<String> {
    let page = std::fs::read_to_string(core().join("lib.rs")).expect("the crate page");
    let start = page.find("Modules use only what stands before them:").expect("the order");
    let list: String = page[start..].lines().take_while(|line| line.trim() != "//!").collect();
    list.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn core() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../core/src")
}

/// All Rust files below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    let below = folders.iter().flat_map(|folder| self::files(folder));
    files.into_iter().filter(|path| path.extension().is_some_and(|e| e == "rs")).chain(below).collect()
}

/// The module of the core that a file belongs to.
fn module(file: &Path) -> String {
    let inside = file.strip_prefix(core()).expect("a file of the core");
    inside.iter().next().expect("a name").to_str().expect("UTF-8").trim_end_matches(".rs").to_owned()
}

#[test]
fn the_crate_page_lists_every_module() {
    let mut listed = order();
    let mut present: Vec<_> = files(&core()).iter().map(|file| module(file)).filter(|m| m != "lib").collect();
    listed.sort();
    present.sort();
    present.dedup();
    assert_eq!(listed, present);
}

#[test]
fn modules_use_only_what_stands_before_them() {
    let order = order();
    let place = |module: &str| order.iter().position(|listed| listed == module);
    let mut uses = 0;
    for file in files(&core()) {
        let module = module(&file);
        let Some(own) = place(&module) else { continue };
        let text = std::fs::read_to_string(&file).expect("a file");
        let shipped = text.split("#[cfg(test)]").next().expect("the file's beginning");
        let lines = shipped.lines().filter(|line| !line.trim_start().starts_with("//"));
        for used in lines.flat_map(|line| line.split("crate::").skip(1)) {
            let used = used.split(|c: char| !c.is_alphanumeric() && c != '_').next().expect("a name");
            let Some(other) = place(used) else { continue };
            assert!(other <= own, "{} uses `{used}`, which stands below `{module}`", file.display());
            uses += 1;
        }
    }
    assert!(uses > 50, "only {uses} uses were found: has the layout changed?");
}

#[test]
fn one_door_for_each_external_crate() {
    for (external, doors) in [
        ("libm", vec!["math"]),
        ("micromath", vec!["math"]),
        ("heapless", vec!["hierarchy", "integrator", "scene"]),
        ("postcard", vec!["read", "scene"]),
        ("embedded_graphics", vec!["render"]),
    ] {
        for file in files(&core()) {
            let text = std::fs::read_to_string(&file).expect("a file");
            let used = text
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"))
                .any(|line| line.contains(&format!("{external}::")));
            let module = module(&file);
            assert!(!used || doors.contains(&&*module), "{external} is used in {}", file.display());
        }
    }
}
