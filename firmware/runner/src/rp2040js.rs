//! The commands that install and start rp2040js.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::toolchain::is_on_path;

/// The folder of the script that runs rp2040js, and of the package that names its version.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../pico/emulator");

/// Installs rp2040js with npm if it is not there.
///
/// # Errors
/// A line that says what to install.
pub(crate) fn install() -> Result<(), String> {
    if !is_on_path("node") {
        return Err("no node: install Node.js, 18 or later".into());
    }
    if Path::new(FOLDER).join("node_modules").join("rp2040js").is_dir() {
        return Ok(());
    }
    if !is_on_path("npm") {
        return Err("no npm, which installs rp2040js: install npm".into());
    }
    let installed =
        Command::new("npm").args(["ci", "--silent"]).current_dir(FOLDER).stdout(Stdio::null()).status();
    match installed {
        Ok(status) if status.success() => Ok(()),
        _ => Err("no rp2040js: run `npm ci` in firmware/pico/emulator".into()),
    }
}

/// The command that runs a program until the panel has shown `frames` frames.
pub(crate) fn command(program: &Path, frames: u32) -> Command {
    let mut command = Command::new("node");
    command.arg(Path::new(FOLDER).join("main.mjs")).arg(program).arg(frames.to_string());
    command
}
