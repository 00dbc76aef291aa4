//! Tests of meshes in one plane, in files.

use bumpalo::Bump;
use rayline_scenes::LoadedScene;

/// Files of all formats that have meshes; the second mesh moves, and a note names it.
#[test]
fn scenes_from_files_are_parted() {
    let folder = tempfile::tempdir().unwrap();
    let square = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 2 -1 0\nv 2 2 0\n";
    std::fs::write(folder.path().join("two.obj"), format!("{square}o one\nf 1 2 3 4\no two\nf 1 5 6\n"))
        .unwrap();
    std::fs::write(folder.path().join("one.obj"), format!("{square}f 1 2 3 4\n")).unwrap();
    let ron = "(camera: (eye: (0, 0, 9), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 0.7),
        materials: [(color: Solid(1, 0, 0))],
        objects: [(shape: Mesh(\"one.obj\"), material: 0),
            (shape: Mesh(\"one.obj\"), material: 0)])";
    std::fs::write(folder.path().join("two.ron"), ron).unwrap();
    for (name, place) in [("two.obj", " `two`"), ("two.ron", "4:13")] {
        let arena = Bump::new();
        let scene = LoadedScene::open(&folder.path().join(name), &arena).unwrap();
        let note = "moved slightly behind an earlier mesh in the same plane, which is the one seen";
        let note = format!("{}/{name}:{place}: {note}", folder.path().display());
        assert!(scene.notes.contains(&note), "{:?} has no {note}", scene.notes);
    }
}
