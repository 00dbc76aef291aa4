//! Running a program in a board's emulator.

use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};
use tempfile::TempDir;

use crate::board::{self, Board, Output};
use crate::picture::Size;
use crate::qmp::Qmp;
use crate::screen::Screen;
use crate::timing::Timing;
use crate::{qemu, rp2040js};

/// The report of a program.
#[derive(Debug, Default)]
pub(crate) struct Report {
    /// The digest of the picture, if the program computes it.
    pub(crate) digest: Option<u64>,
    /// Instructions of one picture.
    pub(crate) instructions: u64,
    pub(crate) stack_bytes: u64,
    /// Memory that the scene needs, if the program reads the scene. Without a digest, the board has less.
    pub(crate) memory_bytes: u64,
    /// Cycles and clocks, if the emulator counts cycles.
    pub(crate) timing: Option<Timing>,
}

/// A running emulator, which is ended when this value is dropped.
#[derive(Debug)]
pub(crate) struct Emulator {
    process: Child,
    /// The lines of the program's report.
    lines: Receiver<String>,
    /// The emulator's files: the program's picture, the control socket, the emulator's messages.
    folder: TempDir,
    deadline: Instant,
    timeout: Duration,
}

/// Runs a program, and returns its report and the bytes of its picture.
pub(crate) fn run(board: &Board, program: &Path, size: Size, timeout: Duration) -> Result<(Report, Vec<u8>)> {
    let mut emulator = Emulator::start(board, program, &[], timeout)?;
    let report = emulator.report()?;
    let picture = match board.output {
        Output::File | Output::Frames(_) => emulator.file()?,
        Output::Panel(panel) => emulator.screen(panel)?.part(size)?,
    };
    Ok((report, picture))
}

/// Runs a program in rp2040js, and returns the counts that rp2040js wrote: for each address, executions and
/// cycles.
pub(crate) fn profile(board: &Board, program: &Path, timeout: Duration) -> Result<String> {
    let mut emulator = Emulator::start(board, program, &[], timeout)?;
    emulator.report()?;
    emulator.finish()?;
    fs::read_to_string(emulator.folder.path().join("profile")).context("the program's profile")
}

impl Emulator {
    /// Starts a program in a folder with these files.
    pub(crate) fn start(
        board: &Board,
        program: &Path,
        files: &[(&str, &[u8])],
        timeout: Duration,
    ) -> Result<Self> {
        let folder = tempfile::tempdir()?;
        for (name, bytes) in files {
            fs::write(folder.path().join(name), bytes)?;
        }
        let mut process = match board.emulator {
            board::EmulatorKind::Qemu { command, machine, .. } => qemu::command(command, machine, program),
            board::EmulatorKind::Rp2040js { frames } => rp2040js::command(program, frames),
        }
        .current_dir(&folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(File::create(folder.path().join("messages"))?)
        .spawn()
        .context("the emulator")?;
        let output = process.stdout.take();
        let (sender, lines) = mpsc::channel();
        // From here on, every error drops this value, which ends the process.
        let emulator = Self { process, lines, folder, deadline: Instant::now() + timeout, timeout };
        let output = BufReader::new(output.context("the emulator has no output")?);
        thread::spawn(move || {
            for line in output.lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        Ok(emulator)
    }

    /// Waits for the report of the next picture; the time limit starts again.
    pub(crate) fn next_report(&mut self) -> Result<Report> {
        self.deadline = Instant::now() + self.timeout;
        self.report()
    }

    /// Waits for the end of a report.
    fn report(&mut self) -> Result<Report> {
        let mut report = Report::default();
        loop {
            let line = match self.lines.recv_timeout(self.time_left()) {
                Ok(line) => line,
                Err(RecvTimeoutError::Timeout) => bail!("{}", self.too_slow()),
                Err(RecvTimeoutError::Disconnected) => {
                    let status = self.process.wait()?;
                    bail!("the emulator ended early ({status}){}", self.messages());
                }
            };
            let number = |digits| u64::from_str_radix(digits, 16).with_context(|| format!("{line:?}"));
            match line.split_once(' ') {
                Some(("digest", digits)) => report.digest = Some(number(digits)?),
                Some(("instructions", digits)) => report.instructions = number(digits)?,
                Some(("stack_bytes", digits)) => report.stack_bytes = number(digits)?,
                Some(("memory_bytes", digits)) => report.memory_bytes = number(digits)?,
                Some(("fault", fault)) => bail!("the program stopped: {fault}"),
                Some((name, digits)) if Timing::has(name) => {
                    report.timing.get_or_insert_default().set(name, number(digits)?);
                }
                None if line == "done" => return Ok(report),
                _ => bail!("the report has an unknown line {line:?}: build the program again"),
            }
        }
    }

    /// Waits for the end of a program, and returns the picture that it wrote.
    fn file(&mut self) -> Result<Vec<u8>> {
        self.finish()?;
        fs::read(self.folder.path().join("picture")).context("the program's picture")
    }

    /// Waits for the end of a program.
    ///
    /// # Errors
    /// The program ended with an error, or has taken too long.
    pub(crate) fn finish(&mut self) -> Result<()> {
        let status = loop {
            match self.process.try_wait()? {
                Some(status) => break status,
                None if self.time_left().is_zero() => bail!("{}", self.too_slow()),
                None => thread::sleep(Duration::from_millis(5)),
            }
        };
        ensure!(status.success(), "the emulator failed ({status}){}", self.messages());
        Ok(())
    }

    /// Reads the panel's pixels.
    fn screen(&mut self, panel: Size) -> Result<Screen> {
        let mut control = Qmp::connect(&self.folder.path().join("qmp"), self.time_left())?;
        let dump = self.folder.path().join("screen.ppm");
        control.screendump(&dump)?;
        Screen::parse(&fs::read(dump)?, panel)
    }

    fn time_left(&self) -> Duration {
        self.deadline.saturating_duration_since(Instant::now())
    }

    fn too_slow(&self) -> String {
        format!(
            "the emulator was stopped after {} s: use a longer --timeout or a smaller --size{}",
            self.timeout.as_secs(),
            self.messages()
        )
    }

    /// The emulator's own messages, after a colon; empty if it has none.
    fn messages(&self) -> String {
        let messages = fs::read_to_string(self.folder.path().join("messages")).unwrap_or_default();
        if messages.trim().is_empty() { String::new() } else { format!(": {}", messages.trim()) }
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        // Errors do not matter: the process may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
