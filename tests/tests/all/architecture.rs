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
    files_of_kind(folder, "rs")
}

/// All files below a folder whose names end so, but those that a build made and those of hidden folders.
fn files_of_kind(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let is_ours = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).expect("UTF-8");
        !(name.starts_with('.') || ["target", "node_modules"].contains(&name))
    };
    let (folders, files): (Vec<_>, Vec<_>) = entries.filter(is_ours).partition(|path| path.is_dir());
    let below = folders.iter().flat_map(|folder| files_of_kind(folder, ending));
    files.into_iter().filter(|path| path.extension().is_some_and(|e| e == ending)).chain(below).collect()
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
        ("heapless", vec!["hierarchy", "integrator", "render", "scene", "shape"]),
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

/// The names of types that have more generic parameters than five, lifetimes included.
fn crowded_types(text: &str) -> Vec<String> {
    let mut crowded = Vec::new();
    for line in text.lines().map(|line| line.trim_start().trim_start_matches("pub ")) {
        let line = line.strip_prefix("pub(").and_then(|rest| rest.split_once(") ")).map_or(line, |(_, l)| l);
        let is_type = ["struct ", "enum ", "trait ", "type "].iter().any(|word| line.starts_with(word));
        let Some((name, rest)) = line.split_once('<').filter(|_| is_type) else { continue };
        let (mut depth, mut parameters) = (1, 1);
        for letter in rest.chars() {
            match letter {
                '>' if depth == 1 => break,
                '<' => depth += 1,
                '>' => depth -= 1,
                ',' if depth == 1 => parameters += 1,
                _ => {}
            }
        }
        if parameters > 5 {
            crowded.push(name.to_owned());
        }
    }
    crowded
}

#[test]
fn no_type_has_more_than_five_generic_parameters() {
    for file in files(&core()) {
        let text = std::fs::read_to_string(&file).expect("a file");
        assert_eq!(crowded_types(&text), <[String; 0]>::default(), "{}", file.display());
    }
    // The search itself finds such types.
    let twin =
        "pub(super) struct Many<'a, 'b, R: Real<A, B>, S, C, P> {\nstruct Five<'a, 'b, R, S: T<U, V>, C> {";
    assert_eq!(crowded_types(twin), ["struct Many"]);
}

/// The functions of the core whose inlining is forced: the number may fall.
const MOST_FORCED: usize = 120;

/// The compiler decides about inlining, but for a few functions that a measurement names.
#[test]
fn inlining_is_seldom_forced() {
    let lines = files(&core()).into_iter().map(|file| std::fs::read_to_string(file).expect("a file"));
    let forced = |line: &&str| line.contains("inline(always)") || line.contains("inline(never)");
    let forced: usize = lines.map(|text| text.lines().filter(forced).count()).sum();
    assert!((1..=MOST_FORCED).contains(&forced), "{forced} functions");
}

/// The numbers of the lines that are longer than 110 columns: comments of Rust, and Markdown but its tables.
/// The formatter breaks other lines of Rust.
fn long_lines(text: &str, is_rust: bool) -> Vec<usize> {
    let is_meant =
        |line: &str| if is_rust { line.trim_start().starts_with("//") } else { !line.starts_with('|') };
    let is_long = |line: &str| is_meant(line) && line.chars().count() > 110;
    (1..).zip(text.lines()).filter(|(_, line)| is_long(line)).map(|(number, _)| number).collect()
}

#[test]
fn lines_end_at_110_columns() {
    let root = core().join("../..");
    for ending in ["rs", "md"] {
        let files = files_of_kind(&root, ending);
        assert!(files.len() > 8, "{} files: has the layout changed?", files.len());
        for file in files {
            let text = std::fs::read_to_string(&file).expect("a file");
            assert_eq!(long_lines(&text, ending == "rs"), <[usize; 0]>::default(), "{}", file.display());
        }
    }
    // The search itself finds such lines.
    let long = "x".repeat(111);
    assert_eq!(long_lines(&format!("// {}\n    // {long}\n{long}", &long[4..]), true), [2]);
    assert_eq!(long_lines(&format!("| {long} |\n{long}"), false), [2]);
}
