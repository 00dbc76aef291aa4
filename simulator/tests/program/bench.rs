//! Runs the program in a temporary directory.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rayline_simulator::raster::Raster;

/// The time after which a test takes the program for one that hangs: machines may be busy.
const DEADLINE: Duration = Duration::from_secs(60);

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
        self.command(arguments).output().unwrap()
    }

    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rayline"));
        command.args(arguments).current_dir(self.directory.path());
        command
    }

    /// Runs the program with this standard input, and fails if it takes longer than a [`DEADLINE`].
    pub(crate) fn run_in_time(&self, arguments: &[&str], input: impl Into<Stdio>) -> Output {
        let mut command = self.command(arguments);
        let mut child = command.stdin(input).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // The pipes are emptied meanwhile: the program would wait for that.
        fn reader(mut pipe: impl Read + Send + 'static) -> JoinHandle<Vec<u8>> {
            std::thread::spawn(move || {
                let mut bytes = Vec::new();
                pipe.read_to_end(&mut bytes).unwrap();
                bytes
            })
        }
        let (stdout, stderr) = (reader(child.stdout.take().unwrap()), reader(child.stderr.take().unwrap()));
        let start = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break status;
            }
            if start.elapsed() > DEADLINE {
                child.kill().unwrap();
                panic!("{arguments:?} takes more than {DEADLINE:?}");
            }
            std::thread::sleep(Duration::from_millis(10));
        };
        Output { status, stdout: stdout.join().unwrap(), stderr: stderr.join().unwrap() }
    }

    /// A file as standard input.
    pub(crate) fn open(&self, name: &str) -> File {
        File::open(self.path(name)).unwrap()
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
