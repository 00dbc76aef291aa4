//! The command that starts QEMU.

use std::path::Path;
use std::process::Command;

/// The command that runs a program on a machine. The report goes to the standard output; the control socket
/// is `qmp`.
pub(crate) fn command(emulator: &str, machine: &[&str], program: &Path) -> Command {
    let mut command = Command::new(emulator);
    command
        .args(machine)
        // An instruction takes one nanosecond of the emulator's time.
        .args(["-icount", "shift=0"])
        .args(["-display", "none", "-serial", "null", "-monitor", "none"])
        .args(["-chardev", "stdio,id=report"])
        .args(["-semihosting-config", "enable=on,target=native,chardev=report"])
        .args(["-qmp", "unix:qmp,server=on,wait=off"])
        .arg("-kernel")
        .arg(program);
    command
}
