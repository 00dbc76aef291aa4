//! No two files, and no two folders, of a program use each other.
//!
//! In each folder the files and folders beside each other are compared. The folder's own `mod.rs` is left
//! out: it declares what the folder shares, and uses the files below it. A name that `mod.rs` has from one of
//! them counts as a use of the file that defines it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The text of each file, by its path of modules: `["render", "frame"]`; for `mod.rs`, that of the folder.
type Sources = BTreeMap<Vec<String>, String>;

/// The files of a program. Tests and comments are left out.
fn sources(root: &Path) -> Sources {
    fn add(folder: &Path, modules: &[String], sources: &mut Sources) {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let stem = path.file_stem().and_then(|stem| stem.to_str()).expect("UTF-8").to_owned();
            if matches!(&*stem, "tests" | "testing") {
                continue;
            }
            let mut inner = modules.to_vec();
            if path.is_dir() {
                inner.push(stem);
                add(&path, &inner, sources);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                if !matches!(&*stem, "mod" | "lib" | "main") {
                    inner.push(stem);
                }
                let text = std::fs::read_to_string(&path).expect("a file");
                sources.entry(inner).or_default().push_str(&shipped(&text));
            }
        }
    }
    let mut sources = Sources::new();
    add(root, &[], &mut sources);
    sources
}

/// A file without its tests and comments.
fn shipped(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).flat_map(|line| [line, "\n"]).collect()
}

/// All paths that begin with a word, such as `crate`: `crate::a::{b, c::D}` is `a::b` and `a::c::D`.
fn paths(text: &str, first: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for (start, _) in text.match_indices(&format!("{first}::")) {
        let before = text[..start].chars().next_back();
        if !before.is_some_and(|before| before.is_alphanumeric() || before == '_' || before == ':') {
            expand(&text[start + first.len() + 2..], &[], &mut found);
        }
    }
    found
}

/// Adds the paths that a text begins with, after a prefix; returns how many bytes they are.
fn expand(text: &str, prefix: &[String], found: &mut Vec<Vec<String>>) -> usize {
    if text.starts_with('{') {
        let mut at = 1;
        while at < text.len() && !text[at..].starts_with('}') {
            let skip = text[at..].find(|c: char| !c.is_whitespace() && c != ',').unwrap_or(text.len() - at);
            at += skip;
            let length = expand(&text[at..], prefix, found);
            at += length.max(usize::from(!text[at..].starts_with('}')));
        }
        return at + 1;
    }
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    let mut path = prefix.to_vec();
    path.push(text[..end].to_owned());
    if text[end..].starts_with("::") && !text[end + 2..].starts_with('<') {
        return end + 2 + expand(&text[end + 2..], &path, found);
    }
    found.push(path);
    end
}

/// The file that a path of modules and a name leads to.
fn file(sources: &Sources, path: &[String]) -> Option<Vec<String>> {
    let depth = (0..=path.len()).rev().find(|depth| sources.contains_key(&path[..*depth]))?;
    let (module, rest) = path.split_at(depth);
    let Some(name) = rest.first() else { return Some(module.to_vec()) };
    // A name that the folder has from one of its files leads to that file.
    for line in sources[module].split(';').filter_map(|line| line.trim().split_once("use ")) {
        let mut passed = Vec::new();
        expand(line.1.trim(), &[], &mut passed);
        for inner in passed.iter().filter(|inner| inner.last() == Some(name) && inner.len() > 1) {
            let below = [module, inner].concat();
            if sources.contains_key(&below[..=module.len()]) {
                return file(sources, &below);
            }
        }
    }
    Some(module.to_vec())
}

/// The files that a file uses.
fn uses(sources: &Sources, module: &[String], text: &str) -> BTreeSet<Vec<String>> {
    let mut used = BTreeSet::new();
    for path in paths(text, "crate") {
        used.extend(file(sources, &path));
    }
    for path in paths(text, "super") {
        let mut above = module.to_vec();
        above.pop();
        let mut rest = &path[..];
        while let [first, others @ ..] = rest
            && first == "super"
        {
            above.pop();
            rest = others;
        }
        used.extend(file(sources, &[&above, rest].concat()));
    }
    used
}

/// The circles of a program, each with its files.
fn circles(sources: &Sources) -> Vec<String> {
    // For each folder, which of its files and folders uses which.
    let mut folders: BTreeMap<Vec<String>, BTreeMap<String, BTreeSet<String>>> = BTreeMap::new();
    for (module, text) in sources {
        for used in uses(sources, module, text) {
            let common = module.iter().zip(&used).take_while(|(a, b)| a == b).count();
            if let (Some(from), Some(to)) = (module.get(common), used.get(common)) {
                let folder = folders.entry(module[..common].to_vec()).or_default();
                folder.entry(from.clone()).or_default().insert(to.clone());
            }
        }
    }
    let mut found = Vec::new();
    for (folder, uses) in &folders {
        for start in uses.keys() {
            // All that the file uses, directly or through others.
            let (mut reached, mut open) = (BTreeSet::new(), vec![start]);
            while let Some(next) = open.pop() {
                open.extend(uses.get(next).into_iter().flatten().filter(|to| reached.insert((*to).clone())));
            }
            if reached.contains(start) {
                found.push(format!("{}::{start}", folder.join("::")));
            }
        }
    }
    found
}

/// A number system and its vectors are one concept in several files: each is defined by means of the others.
const NUMBERS_AND_VECTORS: [&str; 5] =
    ["math::lattice", "math::ray", "math::real", "math::rotation", "math::vec3"];

#[test]
fn no_file_is_part_of_a_circle() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut programs = vec!["core/src".into(), "simulator/src".into()];
    for entry in std::fs::read_dir(root.join("firmware")).expect("the firmware") {
        let folder = entry.expect("an entry").path().join("src");
        if folder.is_dir() {
            programs.push(folder);
        }
    }
    for program in programs {
        let sources = sources(&root.join(&program));
        let files: usize = sources.iter().map(|(module, text)| uses(&sources, module, text).len()).sum();
        assert!(files > 0 || sources.len() < 4, "no use was found in {}", program.display());
        let mut circles = circles(&sources);
        circles.retain(|file| !NUMBERS_AND_VECTORS.contains(&&**file));
        assert_eq!(circles, [""; 0], "circles in {}", program.display());
    }
}

/// The twin: circles of each kind are found.
#[test]
fn circles_are_found() {
    let program = |files: &[(&str, &str)]| -> Vec<String> {
        let path = |name: &str| name.split('/').filter(|part| *part != "mod").map(str::to_owned).collect();
        circles(&files.iter().map(|(name, text)| (path(name), shipped(text))).collect())
    };
    assert_eq!(program(&[("a", "use super::b::B;"), ("b", "pub struct B;")]), [""; 0]);
    assert_eq!(program(&[("a", "use super::b::B;"), ("b", "use crate::{c, a::A};")]), ["::a", "::b"]);
    // Through a third file; inside a folder; by a name that the folder passes on; by a path in the code.
    let three = [("a", "use crate::b::B;"), ("b", "use crate::c::C;"), ("c", "use crate::a::A;")];
    assert_eq!(program(&three), ["::a", "::b", "::c"]);
    let inside = [("f/mod", "mod a;\nmod b;"), ("f/a", "use super::b::{B};"), ("f/b", "use super::a::A;")];
    assert_eq!(program(&inside), ["f::a", "f::b"]);
    let passed_on =
        [("f/mod", "pub(super) use a::{A, x};"), ("f/a", "use super::b;"), ("f/b", "use crate::f::A;")];
    assert_eq!(program(&passed_on), ["f::a", "f::b"]);
    let inherited = [("f/mod", "use b::B;"), ("f/a", "use super::B;"), ("f/b", "use super::a::A;")];
    assert_eq!(program(&inherited), ["f::a", "f::b"]);
    assert_eq!(
        program(&[("a", "fn f() { super::b::g() }"), ("b", "fn g() { crate::a::f() }")]),
        ["::a", "::b"]
    );
    // Folders count as one.
    let folders =
        [("f/mod", ""), ("f/a", "use crate::g::B;"), ("g/mod", ""), ("g/b", "use super::super::f::a::A;")];
    assert_eq!(program(&folders), ["::f", "::g"]);
    // Comments and tests do not count.
    assert_eq!(
        program(&[
            ("a", "use super::b::B;"),
            ("b", "// crate::a\n#[cfg(test)]\nmod tests { use crate::a; }")
        ]),
        [""; 0]
    );
}
