//! How rp2040js is installed and started.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::toolchain::is_on_path;

/// Where the script is that runs it, and the package that names its version.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../pico/emulator");

/// Makes sure that it is there, or tells in one line what to install. npm fetches it at the first use.
pub(crate) fn install() -> Result<(), String> {
    if !is_on_path("node") {
        return Err("no node: install Node.js, 18 or later".into());
    }
    if Path::new(FOLDER).join("node_modules").join("rp2040js").is_dir() {
        return Ok(());
    }
    if !is_on_path("npm") {
        return Err("no npm, which fetches rp2040js: install it".into());
    }
    let installed =
        Command::new("npm").args(["ci", "--silent"]).current_dir(FOLDER).stdout(Stdio::null()).status();
    match installed {
        Ok(status) if status.success() => Ok(()),
        _ => Err("no rp2040js: run `npm ci` in firmware/pico/emulator".into()),
    }
}

/// Runs a program until it has shown so many frames.
pub(crate) fn command(program: &Path, frames: u32) -> Command {
    let mut command = Command::new("node");
    command.arg(Path::new(FOLDER).join("main.mjs")).arg(program).arg(frames.to_string());
    command
}
