//! How QEMU is started.

use std::path::Path;
use std::process::Command;

/// Runs a program on a machine, with its report on the standard output and a control socket `qmp`.
pub(crate) fn command(emulator: &str, machine: &[&str], program: &Path) -> Command {
    let mut command = Command::new(emulator);
    command
        .args(machine)
        // One instruction is a nanosecond of the emulator's time.
        .args(["-icount", "shift=0"])
        .args(["-display", "none", "-serial", "null", "-monitor", "none"])
        .args(["-chardev", "stdio,id=report"])
        .args(["-semihosting-config", "enable=on,target=native,chardev=report"])
        .args(["-qmp", "unix:qmp,server=on,wait=off"])
        .arg("-kernel")
        .arg(program);
    command
}
