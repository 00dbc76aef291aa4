//! The licenses and the origins of all dependencies of all workspaces, by the rules in `deny.toml`.
//!
//! `cargo deny check` checks them as well, and more; this test needs nothing but cargo.

// This is test code, which may panic.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)]

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the repository")
}

/// The licenses that `deny.toml` allows.
fn allowed_licenses() -> Vec<String> {
    let text = std::fs::read_to_string(repository().join("deny.toml")).expect("deny.toml");
    let (_, section) = text.split_once("\n[licenses]\n").expect("the section");
    let (_, list) = section.split_once("\nallow = [").expect("the key");
    let (list, _) = list.split_once(']').expect("the end of the list");
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The folders of all workspaces: those with a lock file.
fn workspaces(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let folders = entries.filter(|entry| entry.file_type().expect("a type").is_dir());
    let folders = folders.map(|entry| entry.path()).filter(|path| {
        let name = path.file_name().expect("a name").to_string_lossy();
        name != "target" && !name.starts_with('.')
    });
    let below = folders.flat_map(|folder| workspaces(&folder));
    let own = folder.join("Cargo.lock").is_file().then(|| folder.to_owned());
    own.into_iter().chain(below).collect()
}

/// All packages that a workspace uses, on all systems and with all features.
fn packages(workspace: &Path) -> Vec<Value> {
    let output = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["metadata", "--format-version", "1", "--locked", "--all-features"])
        .current_dir(workspace)
        .output()
        .expect("cargo");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    metadata["packages"].as_array().expect("packages").clone()
}

/// Whether a user may choose to have only allowed licenses. In SPDX, `AND` binds more tightly than `OR`;
/// older manifests write a slash for `OR`.
fn permits(expression: &str, allowed: &[String]) -> bool {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let mut words = spaced.split_whitespace().peekable();
    let result = either(&mut words, allowed);
    assert_eq!(words.next(), None, "the license expression `{expression}` has an end that is not understood");
    result
}

type Words<'w> = std::iter::Peekable<std::str::SplitWhitespace<'w>>;

fn either(words: &mut Words<'_>, allowed: &[String]) -> bool {
    let mut result = both(words, allowed);
    while words.next_if_eq(&"OR").is_some() {
        result |= both(words, allowed);
    }
    result
}

fn both(words: &mut Words<'_>, allowed: &[String]) -> bool {
    let mut result = one(words, allowed);
    while words.next_if_eq(&"AND").is_some() {
        result &= one(words, allowed);
    }
    result
}

fn one(words: &mut Words<'_>, allowed: &[String]) -> bool {
    if words.next_if_eq(&"(").is_some() {
        let result = either(words, allowed);
        assert_eq!(words.next(), Some(")"), "a bracket is open");
        return result;
    }
    let mut license = words.next().expect("a license").to_owned();
    if words.next_if_eq(&"WITH").is_some() {
        license = format!("{license} WITH {}", words.next().expect("an exception"));
    }
    allowed.contains(&license)
}

/// The reason why a package may not be used.
fn fault(package: &Value, licenses: &[String]) -> Option<String> {
    let repository = repository();
    let origin = package["source"].as_str();
    let is_known = match origin {
        None => Path::new(package["manifest_path"].as_str()?).starts_with(&repository),
        Some(origin) => origin.starts_with("registry+"),
    };
    if !is_known {
        return Some(format!("it comes from {}", origin.unwrap_or("outside of the repository")));
    }
    let is_private = origin.is_none() && package["publish"].as_array().is_some_and(Vec::is_empty);
    match package["license"].as_str() {
        Some(license) if permits(license, licenses) => None,
        Some(license) => Some(format!("its license is {license}")),
        None if is_private => None,
        None => Some("it names no license".to_owned()),
    }
}

#[test]
fn every_dependency_has_a_license_and_an_origin_of_deny_toml() {
    let licenses = allowed_licenses();
    assert!(licenses.len() > 1, "{licenses:?}");
    let workspaces = workspaces(&repository());
    assert!(workspaces.len() >= 4, "{workspaces:?}");
    let mut faults = Vec::new();
    for workspace in workspaces {
        for package in packages(&workspace) {
            if let Some(fault) = fault(&package, &licenses) {
                let name = package["name"].as_str().expect("a name");
                faults.push(format!("{}: `{name}`: {fault}", workspace.display()));
            }
        }
    }
    assert!(faults.is_empty(), "choose other crates, or change deny.toml:\n{}", faults.join("\n"));
}

#[test]
fn packages_that_break_a_rule_are_found() {
    let licenses = allowed_licenses();
    let package = |license: &str, source: &str| {
        let (license, source) = (Value::from(license), Value::from(source));
        fault(&serde_json::json!({ "license": license, "source": source }), &licenses)
    };
    let registry = "registry+https://example.org/index";
    for license in ["MIT", "GPL-3.0-only OR MIT", "Unlicense/MIT", "(MIT OR Apache-2.0) AND Unicode-3.0"] {
        assert_eq!(package(license, registry), None);
    }
    for license in ["GPL-3.0-only", "MIT AND GPL-3.0-only", "Apache-2.0 WITH LLVM-exception", "MIT-0"] {
        assert_eq!(package(license, registry), Some(format!("its license is {license}")));
    }
    let git = "git+https://example.org/crate#1";
    assert_eq!(package("MIT", git), Some(format!("it comes from {git}")));
    let here = repository().join("core/Cargo.toml");
    for (path, private, reason) in [
        (here.as_path(), true, None),
        (&here, false, Some("it names no license")),
        (Path::new("/elsewhere/Cargo.toml"), true, Some("it comes from outside of the repository")),
    ] {
        let publish = if private { serde_json::json!([]) } else { Value::Null };
        let package = serde_json::json!({ "manifest_path": path, "publish": publish });
        assert_eq!(fault(&package, &licenses).as_deref(), reason);
    }
}
