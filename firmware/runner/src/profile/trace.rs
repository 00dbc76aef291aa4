//! The number of executions of each instruction.

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

/// The addresses of the functions that start and stop counting. Their own instructions are not counted.
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
            let symbol = symbol
                .with_context(|| format!("the program has no function Meter{end}: do not inline it"))?;
            // The lowest bit of the address marks Thumb code.
            let start = symbol.address() & !1;
            Ok(start..start + symbol.size())
        };
        Ok(Self { resume: find("::resume")?, pause: find("::pause")? })
    }
}

/// Executions of an instruction, and their cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Executed {
    pub(super) times: u64,
    /// 0 if the emulator counts no cycles.
    pub(super) cycles: u64,
}

/// Executions of each instruction while the program counted, by address.
#[derive(Debug)]
pub(super) struct Trace {
    counts: HashMap<u64, Executed>,
}

impl Trace {
    /// The mean of a frame, from the counts of rp2040js for `frames` frames.
    pub(super) fn of_frames(counts: &str, frames: u32) -> Result<Self> {
        let each = |line: &str| -> Option<(u64, Executed)> {
            let mut numbers = line.split(' ').map(|digits| u64::from_str_radix(digits, 16).ok());
            let mut next = || numbers.next().flatten();
            let (address, times, cycles) = (next()?, next()?, next()?);
            let each = |count: u64| count / u64::from(frames);
            Some((address, Executed { times: each(times), cycles: each(cycles) }))
        };
        let counts = counts.lines().map(|line| {
            each(line).with_context(|| {
                format!("{line:?} is not address, executions and cycles: run the board again")
            })
        });
        Ok(Self { counts: counts.collect::<Result<_>>()? })
    }

    /// Runs QEMU until the program ends its report, and reads the log.
    pub(super) fn of_qemu(mut emulator: Command, marks: &Marks, timeout: Duration) -> Result<Self> {
        let folder = tempfile::tempdir()?;
        let mut process = emulator
            // Log blocks of code, each of one instruction.
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
            // After a timeout there is no receiver.
            let _ = sender.send(lines.into_iter().find(|line| line == "done" || line.starts_with("fault")));
        });
        let marks = marks.clone();
        let reader = thread::spawn(move || read(log, &marks));
        let last_line = last_line.recv_timeout(timeout);
        // Some programs do not end by themselves.
        process.kill()?;
        process.wait()?;
        let (counts, messages) =
            reader.join().map_err(|_| anyhow!("the emulator's log cannot be read"))??;
        match last_line {
            Ok(Some(line)) if line == "done" => {}
            Ok(Some(line)) => bail!("the program stopped: {line}"),
            Ok(None) => bail!("the emulator ended early: {}", messages.trim()),
            Err(_) => bail!(
                "the emulator was stopped after {} s: use a longer --timeout or a smaller --size",
                timeout.as_secs()
            ),
        }
        ensure!(!counts.is_empty(), "the emulator logged no instructions: {}", messages.trim());
        Ok(Self { counts })
    }

    /// Addresses with their executions.
    pub(super) fn counts(&self) -> impl Iterator<Item = (u64, Executed)> {
        self.counts.iter().map(|(address, count)| (*address, *count))
    }
}

/// Counts the instructions of a log; also returns the log's other messages.
fn read(log: ChildStderr, marks: &Marks) -> Result<(HashMap<u64, Executed>, String)> {
    let mut log = BufReader::with_capacity(1 << 20, log);
    let mut counts = HashMap::<u64, Executed>::new();
    let (mut messages, mut line) = (Vec::new(), Vec::new());
    let mut counts_now = false;
    // The limit protects against a line without an end.
    while log.by_ref().take(1 << 16).read_until(b'\n', &mut line)? > 0 {
        match executed(&line) {
            Some(address) if marks.resume.contains(&address) => counts_now = true,
            Some(address) if marks.pause.contains(&address) => counts_now = false,
            Some(address) if counts_now => counts.entry(address).or_default().times += 1,
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
    fn counts_of_frames_are_for_one() {
        let trace = Trace::of_frames("20000100 a 14\n10000200 4 6\n", 2).unwrap();
        let mut counts: Vec<_> = trace.counts().collect();
        counts.sort_by_key(|(address, _)| *address);
        let executed = |times, cycles| Executed { times, cycles };
        assert_eq!(counts, [(0x1000_0200, executed(2, 3)), (0x2000_0100, executed(5, 10))]);
        for broken in ["20000100 a", "x 1 1", "1  1"] {
            assert!(Trace::of_frames(broken, 1).is_err(), "{broken}");
        }
    }

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
