//! The rows of the tables, and the comparison with what became of a file.

use bumpalo::Bump;
use rayline::shape::{Mesh, Shape};
use rayline::{Material, PreparedScene};
use rayline_formats::raster::to_png;
use rayline_scenes::LoadedScene;

/// A row: the feature, its outcome, and the rest. What stands in quotes there is in the note or the error.
struct Row<'d> {
    feature: &'d str,
    outcome: &'d str,
    words: Vec<&'d str>,
}

/// The notes about a file, and whether its scene holds what the row says; or the error.
pub(crate) type Seen = Result<(Vec<String>, bool), String>;

/// The rows of the table below a heading.
fn rows<'d>(document: &'d str, heading: &str) -> Vec<Row<'d>> {
    let (_, section) = document.split_once(&format!("\n## {heading}\n")).unwrap();
    let section = section.split("\n## ").next().unwrap();
    let lines = section.lines().filter(|line| line.starts_with("| ")).skip(1);
    let row = |line: &'d str| {
        let cells: Vec<_> = line.trim_matches('|').split(" | ").map(str::trim).collect();
        let [feature, outcome, how] = *cells else { panic!("{line}") };
        Row { feature, outcome, words: how.split('"').skip(1).step_by(2).collect() }
    };
    lines.map(row).collect()
}

/// Compares the table below a heading with what became of files, which come in the order of the rows.
pub(crate) fn compare(heading: &str, least: usize, seen: Vec<(&str, Seen)>) {
    let document = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/formats.md"));
    let document = document.unwrap();
    let rows = rows(&document, heading);
    let features: Vec<_> = rows.iter().map(|row| row.feature).collect();
    assert_eq!(features, seen.iter().map(|(feature, _)| *feature).collect::<Vec<_>>());
    assert!(rows.len() >= least);
    for (Row { feature, outcome, words }, (_, seen)) in rows.iter().zip(seen) {
        match (*outcome, &seen) {
            ("drawn" | "written" | "approximated" | "left out", Ok((notes, holds))) => {
                assert!(*holds, "{feature}: the scene does not hold what the table says; {notes:?}");
                let is_said = |words: &&str| notes.iter().any(|note| note.contains(words));
                assert!(words.iter().all(is_said), "{feature}: {words:?} is not in {notes:?}");
                assert!(*outcome != "left out" || !words.is_empty(), "{feature}: which note?");
                // Without words in the row, there is no note but those about camera and light.
                assert!(!words.is_empty() || notes.iter().all(|note| is_usual(note)), "{feature}: {notes:?}");
            }
            ("refused", Err(error)) => {
                assert!(!words.is_empty(), "{feature}: which message?");
                assert!(
                    words.iter().all(|words| error.contains(words)),
                    "{feature}: {words:?} is not in {error}"
                );
            }
            (outcome, seen) => panic!("{feature} is not {outcome}: {seen:?}"),
        }
    }
}

/// Whether a note is about the default camera or light.
fn is_usual(note: &str) -> bool {
    ["OBJ files have no camera", ": no camera: ", ": no light: "].iter().any(|usual| note.contains(usual))
}

/// Opens the first of some files, beside `wood.png`.
pub(crate) fn open(files: &[(&str, &[u8])], holds: impl FnOnce(&LoadedScene<'_>) -> bool) -> Seen {
    let folder = tempfile::tempdir().unwrap();
    let pixels = [[200, 90, 30], [30, 90, 200], [90, 200, 30], [10, 20, 30]];
    std::fs::write(folder.path().join("wood.png"), to_png((2, 2), 3, pixels.as_flattened()).unwrap())
        .unwrap();
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    let arena = Bump::new();
    let scene =
        LoadedScene::open(&folder.path().join(files[0].0), &arena).map_err(|error| error.to_string())?;
    let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.scene.bytes::<f32>()];
    PreparedScene::<f32, _>::new(&scene.scene, &mut memory).map_err(|error| scene.explain(&error))?;
    Ok((scene.notes.clone(), holds(&scene)))
}

/// The mesh of an object.
pub(crate) fn mesh<'a>(scene: &LoadedScene<'a>, index: usize) -> Mesh<'a> {
    let Shape::Mesh(mesh) = scene.scene.objects[index].shape else { panic!("no mesh") };
    mesh
}

/// The material of the first object.
pub(crate) fn material<'a>(scene: &LoadedScene<'a>) -> Material<'a> {
    scene.scene.materials[usize::from(scene.scene.objects[0].material.0)]
}

pub(crate) fn near(a: f32, b: f32) -> bool {
    (a - b).abs() < 1e-4
}
