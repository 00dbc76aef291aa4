//! The compiler for a board: rustup's if the board's target is installed, else Debian's, which builds the
//! core library from its source.

use std::env;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use rayline::FASTER;
use serde_json::Value;

use crate::board::Board;
use crate::picture::{Mode, Picture};

/// The workspace of the firmware.
const WORKSPACE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml");

/// The manifest of the workspace of programs for this computer.
pub(crate) const MAIN_WORKSPACE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../Cargo.toml");

/// A compiler that can build for a board.
#[derive(Debug)]
pub(crate) enum Toolchain {
    /// The compiler in use, which has the target's core library.
    Installed,
    /// Debian's compiler, which has the source of the core library.
    Debian { rustc: PathBuf, cargo: PathBuf },
}

/// The outcome of a build.
#[derive(Debug)]
pub(crate) enum Built {
    /// The file that the program was linked to.
    Linked(PathBuf),
    /// The compiler's messages about a program that was not built.
    Refused(String),
}

impl Built {
    /// The file of the program.
    ///
    /// # Errors
    /// The reason why the program was not built.
    fn linked(self) -> Result<PathBuf> {
        match self {
            Built::Linked(file) => Ok(file),
            Built::Refused(reason) if reason.contains(PANIC) => {
                bail!(
                    "a panic can be reached, so the linker misses `{PANIC}`: remove the code that can panic"
                )
            }
            Built::Refused(reason) => bail!("the program was not built:\n{}", reason.trim_end()),
        }
    }
}

/// The levels of optimization that programs are built at.
pub(crate) const LEVELS: [&str; 3] = ["3", "s", "z"];

/// How a program is compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Compilation {
    /// The level of optimization.
    pub(crate) level: &'static str,
    /// Whether the core library, where it is built from source, is at level 3, as rustup's is in programs of
    /// any level.
    pub(crate) has_fast_core: bool,
    /// Features of the program that its scene does not need.
    pub(crate) features: &'static [&'static str],
}

impl Compilation {
    /// For speed, with no more features than the scene needs.
    pub(crate) const FAST: Self = Self { level: "3", has_fast_core: true, features: &[] };
}

impl Toolchain {
    /// Finds a compiler for a target.
    ///
    /// # Errors
    /// A line that says what to install.
    pub(crate) fn find(target: &str) -> Result<Self, String> {
        if has_target(target) {
            return Ok(Self::Installed);
        }
        let rustc = debian_file("rustc-web", "bin/rustc");
        let cargo = debian_file("cargo-web", "bin/cargo");
        let source = debian_file("rust-web-src", "lib/rustlib/src");
        let missing: Vec<&str> = [
            (rustc.is_none(), "rustc-web"),
            (cargo.is_none(), "cargo-web"),
            (source.is_none(), "rust-web-src"),
            (!is_on_path("ld.lld"), "lld"),
        ]
        .into_iter()
        .filter_map(|(is_missing, package)| is_missing.then_some(package))
        .collect();
        match (rustc, cargo) {
            (Some(rustc), Some(cargo)) if missing.is_empty() => Ok(Self::Debian { rustc, cargo }),
            _ => Err(format!(
                "no compiler for {target}: run `rustup target add {target}`, or on Debian `apt install {}`",
                missing.join(" ")
            )),
        }
    }

    /// The compiler's name and version, and the origin of its core library: programs depend on both.
    pub(crate) fn name(&self) -> Result<String> {
        let (rustc, core) = match self {
            Self::Installed => (installed_rustc(), ""),
            Self::Debian { rustc, .. } => (rustc.into(), ", core library from source"),
        };
        let output = Command::new(rustc).arg("--version").output()?;
        Ok(format!("{}{core}", String::from_utf8(output.stdout)?.trim()))
    }

    /// Builds the program of a board.
    pub(crate) fn build(&self, board: &Board, picture: &Picture, how: Compilation) -> Result<Built> {
        self.build_by(self.cargo(board.target), board, picture, how)
    }

    fn build_by(
        &self,
        mut command: Command,
        board: &Board,
        picture: &Picture,
        how: Compilation,
    ) -> Result<Built> {
        command
            .args(["build", "--release", "--package", board.program.package, "--bin", board.program.binary])
            .args(["--target", board.target, "--manifest-path", WORKSPACE])
            .args(["--message-format", "json-render-diagnostics"])
            .env("RAYLINE_SCENE", picture.scene.source)
            .env("RAYLINE_SIZE", picture.size.to_string())
            .env("RAYLINE_BOUNCES", picture.bounces.to_string())
            .env("RAYLINE_AREA_LIGHTS", if picture.closed_form { "closed-form" } else { "sampled" })
            .env("RAYLINE_NUMBER", picture.number.name())
            .env("RAYLINE_MODE", picture.mode.name())
            .env("RAYLINE_BOARD", board.program.layout)
            .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", how.level)
            // The flags in use are meant for this computer.
            .env_remove("RUSTFLAGS")
            .env_remove("CARGO_ENCODED_RUSTFLAGS");
        if let Self::Debian { .. } = self {
            command.arg("-Zbuild-std=core");
            // Level 3 needs no setting: with one, programs of other commands would not share their libraries.
            if how.has_fast_core && how.level != "3" {
                for library in ["core", "compiler_builtins"] {
                    command.args(["--config", &format!("profile.release.package.{library}.opt-level=3")]);
                }
            }
        }
        let mut features = [board.program.features, how.features].concat();
        for feature in picture.scene.scene.features() {
            if !(picture.small && FASTER.contains(&feature)) {
                features.push(feature);
            }
        }
        if picture.mode == Mode::Smooth {
            features.push("distributed");
        }
        if !features.is_empty() {
            command.args(["--features", &features.join(",")]);
        }
        let output = command.output().with_context(|| format!("{command:?}"))?;
        if !output.status.success() {
            return Ok(Built::Refused(String::from_utf8_lossy(&output.stderr).into_owned()));
        }
        Ok(Built::Linked(executable(&String::from_utf8(output.stdout)?)?))
    }

    /// Builds the program of a board.
    ///
    /// # Errors
    /// The reason why the program was not built.
    pub(crate) fn program(&self, board: &Board, picture: &Picture, how: Compilation) -> Result<PathBuf> {
        self.build(board, picture, how)?.linked()
    }

    /// Builds the program of a board with [`Compilation::FAST`], with tables of the line that each
    /// instruction comes from.
    pub(crate) fn program_with_lines(&self, board: &Board, picture: &Picture) -> Result<PathBuf> {
        let mut command = self.cargo(board.target);
        command.env("CARGO_PROFILE_RELEASE_DEBUG", "line-tables-only");
        self.build_by(command, board, picture, Compilation::FAST)?.linked()
    }

    /// The toolchain's cargo. Instructions and flash depend on the profile, so the workspace's own is used:
    /// no variable of the environment changes it.
    fn cargo(&self, target: &str) -> Command {
        let mut command = match self {
            Self::Installed => Command::new(installed_cargo()),
            Self::Debian { rustc, cargo } => {
                let mut command = Command::new(cargo);
                let variable = target.to_uppercase().replace(['-', '.'], "_");
                command
                    .env("RUSTC", rustc)
                    .env(format!("CARGO_TARGET_{variable}_LINKER"), "ld.lld")
                    // Building the core library is not stable.
                    .env("RUSTC_BOOTSTRAP", "1");
                command
            }
        };
        for (name, _) in env::vars_os() {
            if name == "CARGO_INCREMENTAL" || name.to_string_lossy().starts_with("CARGO_PROFILE_") {
                command.env_remove(name);
            }
        }
        command
    }
}

/// Builds a program of the main workspace for this computer, as `cargo run --release` does.
pub(crate) fn build_here(binary: &str) -> Result<PathBuf> {
    let arguments = ["build", "--release", "--bin", binary, "--manifest-path", MAIN_WORKSPACE];
    let format = ["--message-format", "json-render-diagnostics"];
    executable(&output_of(&installed_cargo(), &[&arguments[..], &format].concat())?)
}

/// Runs a program of this computer, which must succeed, and returns its standard output.
pub(crate) fn output_of(program: &OsStr, arguments: &[impl AsRef<OsStr>]) -> Result<String> {
    let mut command = Command::new(program);
    command.args(arguments);
    let output = command.output().with_context(|| format!("{command:?}"))?;
    let errors = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{command:?} failed:\n{}", errors.trim_end());
    Ok(String::from_utf8(output.stdout)?)
}

/// The cargo that runs this program.
pub(crate) fn installed_cargo() -> OsString {
    env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// The program that cargo has built, from cargo's messages in JSON.
fn executable(messages: &str) -> Result<PathBuf> {
    let executable = messages
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .find_map(|message| Some(PathBuf::from(message.get("executable")?.as_str()?)));
    executable.context("cargo named no program in its messages: update cargo")
}

/// The function that the panic handler calls, and that no program defines.
pub(crate) const PANIC: &str = "rayline_panic_is_reachable";

/// Whether a command can be run.
pub(crate) fn is_on_path(command: &str) -> bool {
    env::var_os("PATH")
        .is_some_and(|path| env::split_paths(&path).any(|folder| folder.join(command).is_file()))
}

/// The compiler in use.
fn installed_rustc() -> OsString {
    env::var_os("RUSTC").unwrap_or_else(|| "rustc".into())
}

/// Whether the compiler in use has the target's core library.
fn has_target(target: &str) -> bool {
    let libraries = || -> Result<String> {
        let output = Command::new(installed_rustc())
            .args(["--print", "target-libdir", "--target", target])
            .output()?;
        ensure!(output.status.success());
        Ok(String::from_utf8(output.stdout)?)
    };
    libraries().is_ok_and(|folder| Path::new(folder.trim_end()).is_dir())
}

/// The first file or folder of an installed package of Debian whose path ends in `end`.
fn debian_file(package: &str, end: &str) -> Option<PathBuf> {
    let output =
        Command::new("dpkg").args(["-L", package]).output().ok().filter(|output| output.status.success())?;
    let list = String::from_utf8(output.stdout).ok()?;
    list.lines().map(PathBuf::from).find(|path| path.ends_with(end))
}
