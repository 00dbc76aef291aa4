//! Runs the program in a temporary directory.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use rayline_simulator::raster::Raster;

/// A temporary directory in which `rayline` runs.
pub(crate) struct Bench {
    directory: tempfile::TempDir,
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self { directory: tempfile::tempdir().unwrap() }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), content).unwrap();
    }

    /// The names of all files, sorted.
    pub(crate) fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.directory.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    pub(crate) fn run(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_rayline"))
            .args(arguments)
            .current_dir(self.directory.path())
            .output()
            .unwrap()
    }

    /// The standard output of a run that must succeed without standard error.
    pub(crate) fn output(&self, arguments: &[&str]) -> String {
        let Output { status, stdout, stderr } = self.run(arguments);
        let stderr = String::from_utf8(stderr).unwrap();
        assert!(status.success(), "{arguments:?}: {stderr}");
        assert_eq!(stderr, "", "{arguments:?}");
        String::from_utf8(stdout).unwrap()
    }

    /// The message of a run that must fail with status 1 and one line, without the name of the program.
    pub(crate) fn error(&self, arguments: &[&str]) -> String {
        let Output { status, stdout, stderr } = self.run(arguments);
        let stderr = String::from_utf8(stderr).unwrap();
        assert_eq!(status.code(), Some(1), "{arguments:?}: {stderr}");
        assert_eq!(stdout, b"", "{arguments:?}");
        let line = stderr.strip_prefix("rayline: ").and_then(|rest| rest.strip_suffix('\n'));
        let line = line.unwrap_or_else(|| panic!("{arguments:?}: {stderr:?}"));
        assert!(!line.contains('\n'), "{arguments:?}: {stderr}");
        line.to_owned()
    }

    /// The width, height and bytes of the picture that `render` writes with these arguments.
    pub(crate) fn picture(&self, arguments: &[&str]) -> (u32, u32, Vec<u8>) {
        let name = "picture-of-a-test.png";
        self.output(&[&["render", "-o", name, "--quiet"], arguments].concat());
        let picture = pixels(&self.path(name));
        std::fs::remove_file(self.path(name)).unwrap();
        picture
    }
}

pub(crate) fn pixels(path: &Path) -> (u32, u32, Vec<u8>) {
    let image = Raster::decode(&std::fs::read(path).unwrap()).unwrap();
    (image.width, image.height, image.rgb())
}

/// A model of a red square, which fills the middle of the picture.
pub(crate) const SQUARE: &str = "mtllib square.mtl
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
usemtl red
f 1 2 3 4
";

/// A red ball under a light, 40 by 30 pixels.
pub(crate) const BALL: &str = "v from 0 0 5 at 0 0 0 up 0 1 0 angle 40 hither 1 resolution 40 30
b .1 .2 .3
l 5 5 5
f 1 0 0 .8 .2 20 0 0
s 0 0 0 1
";
