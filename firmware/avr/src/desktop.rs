//! The program of this computer, which runs the board in QEMU.

use std::env;
use std::error::Error;
use std::io::{self, Read};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use crate::picture;

/// The time within which the board must have sent its picture.
const TIMEOUT: Duration = Duration::from_secs(60);

/// Runs the board's program, whose file the command line names, and compares the picture with this
/// computer's.
pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let program = env::args().nth(1).ok_or("name the file of the board's program")?;
    let mut expected = vec![];
    picture::draw(|byte| expected.push(byte)).ok_or("the scene or the settings are refused")?;

    let begin = Instant::now();
    let mut board = Command::new("qemu-system-avr")
        .args(["-M", "mega2560", "-display", "none", "-monitor", "none", "-serial", "stdio"])
        .args(["-bios", &program])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|error| format!("qemu-system-avr: {error}; install qemu-system-misc"))?;
    let sent = receive(&mut board, expected.len() + size_of::<u16>());
    board.kill()?;
    board.wait()?;
    let sent = sent?;

    let stack = check(&sent, &expected)?;
    let (bytes, seconds) = (expected.len(), begin.elapsed().as_secs_f32());
    println!("mega2560: {bytes} bytes as on this computer, {stack} B of stack, {seconds:.1} s in QEMU");
    Ok(())
}

/// Compares what the board sent with this computer's picture, and returns the board's use of stack in bytes.
fn check(sent: &[u8], expected: &[u8]) -> Result<u16, String> {
    let Some((picture, stack)) = sent.split_last_chunk().filter(|sent| sent.0.len() == expected.len()) else {
        return Err(format!("the board sent {} bytes", sent.len()));
    };
    let wrong = picture.iter().zip(expected).filter(|(sent, expected)| sent != expected).count();
    if wrong > 0 {
        return Err(format!("{wrong} of {} bytes differ from this computer's", expected.len()));
    }
    match u16::from_le_bytes(*stack) {
        0 => Err("the stack has filled its room".into()),
        stack => Ok(stack),
    }
}

/// The first bytes that the board sends.
fn receive(board: &mut Child, count: usize) -> Result<Vec<u8>, Box<dyn Error>> {
    let output = board.stdout.take().ok_or("QEMU has no output")?;
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || sender.send(read(output, count)));
    let sent = receiver.recv_timeout(TIMEOUT).map_err(|_| format!("no picture within {TIMEOUT:?}"))?;
    sent.map_err(|error| format!("QEMU has ended before the picture was sent: {error}").into())
}

fn read(mut output: ChildStdout, count: usize) -> io::Result<Vec<u8>> {
    let mut sent = vec![0; count];
    output.read_exact(&mut sent)?;
    Ok(sent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_byte_a_short_picture_and_a_full_stack_are_found() {
        assert_eq!(check(&[7, 8, 9, 0x34, 0x12], &[7, 8, 9]), Ok(0x1234));
        assert_eq!(
            check(&[7, 0, 9, 0x34, 0x12], &[7, 8, 9]),
            Err("1 of 3 bytes differ from this computer's".into())
        );
        assert_eq!(check(&[7, 8, 0x34, 0x12], &[7, 8, 9]), Err("the board sent 4 bytes".into()));
        assert_eq!(check(&[7, 8, 9, 0, 0], &[7, 8, 9]), Err("the stack has filled its room".into()));
    }
}
