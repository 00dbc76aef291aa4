//! The emulator's control socket (QEMU, "QEMU Machine Protocol Specification").

use std::io::{BufRead, BufReader, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result, bail};
use serde_json::{Value, json};

/// A connection to an emulator.
#[derive(Debug)]
pub(crate) struct Qmp {
    stream: BufReader<UnixStream>,
}

impl Qmp {
    /// Connects, and completes the negotiation of capabilities, which enables all other commands.
    pub(crate) fn connect(socket: &Path, timeout: Duration) -> Result<Self> {
        let stream = UnixStream::connect(socket).context("the emulator's control socket")?;
        stream.set_read_timeout(Some(timeout.max(Duration::from_secs(1))))?;
        let mut qmp = Self { stream: BufReader::new(stream) };
        qmp.execute("qmp_capabilities", json!({}))?;
        Ok(qmp)
    }

    /// Writes the display's pixels to a PPM file.
    pub(crate) fn screendump(&mut self, file: &Path) -> Result<()> {
        self.execute("screendump", json!({ "filename": file }))
    }

    fn execute(&mut self, command: &str, arguments: Value) -> Result<()> {
        let request = json!({ "execute": command, "arguments": arguments });
        writeln!(self.stream.get_mut(), "{request}")?;
        loop {
            let mut line = String::new();
            let length = self
                .stream
                .read_line(&mut line)
                .context("the emulator's control socket does not answer, use a longer --timeout")?;
            if length == 0 {
                bail!("the emulator closed its control socket: run the board again");
            }
            let answer: Value = serde_json::from_str(&line)?;
            if let Some(error) = answer.get("error") {
                bail!("{command}: {error}");
            }
            if answer.get("return").is_some() {
                return Ok(());
            }
            // Skip the greeting and events.
        }
    }
}
