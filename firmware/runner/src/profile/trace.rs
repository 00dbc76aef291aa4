//! The instructions that an emulated processor executes.

use std::collections::HashMap;
use std::io::{BufRead, BufReader, Read};
use std::ops::Range;
use std::process::{ChildStderr, Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result, anyhow, bail, ensure};
use object::{Object, ObjectSymbol};
use rustc_demangle::demangle;

/// The functions of the program that start and stop counting. They do not count themselves.
#[derive(Clone, Debug)]
pub(super) struct Marks {
    resume: Range<u64>,
    pause: Range<u64>,
}

impl Marks {
    pub(super) fn find(elf: &object::File<'_>) -> Result<Self> {
        let find = |end: &str| -> Result<Range<u64>> {
            let symbol = elf.symbols().find(|symbol| {
                let name = symbol.name().map(|name| format!("{:#}", demangle(name))).unwrap_or_default();
                name.contains("rayline_emulated::meter::") && name.ends_with(end)
            });
            let symbol = symbol.with_context(|| format!("the program has no function Meter{end}"))?;
            // The lowest bit tells that it is Thumb code.
            let start = symbol.address() & !1;
            Ok(start..start + symbol.size())
        };
        Ok(Self { resume: find("::resume")?, pause: find("::pause")? })
    }
}

/// How often each instruction was executed while the program counted.
#[derive(Debug)]
pub(super) struct Trace {
    counts: HashMap<u64, u64>,
}

impl Trace {
    /// Runs the emulator until the program has told everything.
    pub(super) fn record(mut emulator: Command, marks: &Marks, timeout: Duration) -> Result<Self> {
        let folder = tempfile::tempdir()?;
        let mut process = emulator
            // Blocks of one instruction, each of which is written down.
            .args(["-singlestep", "-d", "exec,nochain"])
            .current_dir(&folder)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .context("the emulator")?;
        let output = process.stdout.take().context("the emulator has no output")?;
        let log = process.stderr.take().context("the emulator has no log")?;
        let (sender, last_line) = mpsc::channel();
        thread::spawn(move || {
            let lines = BufReader::new(output).lines().map_while(Result::ok);
            // Nobody waits any more if that was too late.
            let _ = sender.send(lines.into_iter().find(|line| line == "done" || line.starts_with("fault")));
        });
        let marks = marks.clone();
        let reader = thread::spawn(move || read(log, &marks));
        let last_line = last_line.recv_timeout(timeout);
        // Some programs never end by themselves.
        process.kill()?;
        process.wait()?;
        let (counts, messages) =
            reader.join().map_err(|_| anyhow!("the emulator's log cannot be read"))??;
        match last_line {
            Ok(Some(line)) if line == "done" => {}
            Ok(Some(line)) => bail!("the program stopped: {line}"),
            Ok(None) => bail!("the emulator ended early: {}", messages.trim()),
            Err(_) => bail!(
                "the emulator was stopped after {} s: this needs a longer --timeout or a smaller --size",
                timeout.as_secs()
            ),
        }
        ensure!(!counts.is_empty(), "the emulator wrote no instructions down: {}", messages.trim());
        Ok(Self { counts })
    }

    /// Addresses, and how often they were executed.
    pub(super) fn counts(&self) -> impl Iterator<Item = (u64, u64)> {
        self.counts.iter().map(|(address, count)| (*address, *count))
    }
}

/// Counts the instructions of a log, and gives what else it says.
fn read(log: ChildStderr, marks: &Marks) -> Result<(HashMap<u64, u64>, String)> {
    let mut log = BufReader::with_capacity(1 << 20, log);
    let (mut counts, mut messages, mut line) = (HashMap::new(), Vec::new(), Vec::new());
    let mut counts_now = false;
    // A line that never ends would be no log.
    while log.by_ref().take(1 << 16).read_until(b'\n', &mut line)? > 0 {
        match executed(&line) {
            Some(address) if marks.resume.contains(&address) => counts_now = true,
            Some(address) if marks.pause.contains(&address) => counts_now = false,
            Some(address) if counts_now => *counts.entry(address).or_default() += 1,
            Some(_) => {}
            None if messages.len() < 1 << 12 => messages.extend_from_slice(&line),
            None => {}
        }
        line.clear();
    }
    Ok((counts, String::from_utf8_lossy(&messages).into_owned()))
}

/// The address in a line such as `Trace 0: 0x7f12 [00000000/0000abcd/00000110/ff000201] name`.
fn executed(line: &[u8]) -> Option<u64> {
    let fields = line.strip_prefix(b"Trace ")?.split(|byte| *byte == b'[').nth(1)?;
    let address = fields.split(|byte| *byte == b'/').nth(1)?;
    u64::from_str_radix(std::str::from_utf8(address).ok()?, 16).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_names_an_address() {
        let line = b"Trace 0: 0x7f1234 [00000000/0000abcd/00000110/ff000201] some_name\n";
        assert_eq!(executed(line), Some(0xABCD));
        for other in [&b"Stopped execution of TB chain before 0x7f [0000abcd] name\n"[..], b"Trace 0:\n", b""]
        {
            assert_eq!(executed(other), None);
        }
    }
}
