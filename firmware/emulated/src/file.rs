//! The program for boards without a display: it draws one picture into a file of the host, as RGB565.

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Size};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::prelude::RgbColor;
use semihosting::fd::{AsFd, BorrowedFd};
use semihosting::fs::File;
use semihosting::{process, sys};

use crate::picture::{Buffer, HEIGHT, Memory, WIDTH};
use crate::{Counter, Fault, program, report};

/// Draws the picture into the file `picture`, and reports the figures.
pub fn main() -> ! {
    static mut MEMORY: Memory = Memory::new();
    static mut BUFFER: Buffer<Rgb565> = Buffer::new(Rgb565::BLACK);
    let (memory, buffer) = (&raw mut MEMORY, &raw mut BUFFER);
    // SAFETY: both statics are local to this function, which is called once because it does not return, and
    // never by an interrupt.
    #[allow(unsafe_code)]
    let (memory, buffer) = unsafe { (&mut *memory, &mut *buffer) };
    match render(memory, buffer) {
        Ok(()) => process::exit(0),
        Err(fault) => report::fail(fault),
    }
}

/// Opens the file, draws into it, and reports the figures.
fn render(memory: &mut Memory, buffer: &mut Buffer<Rgb565>) -> Result<(), Fault> {
    let file = File::create(c"picture").map_err(|_| Fault::Output)?;
    // Borrow the file once: borrowing asserts that it is open, and here the compiler can prove that.
    let mut picture = PictureFile { file: file.as_fd() };
    program::run(memory, buffer, Counter::start(), &mut picture)?.report()
}

/// A file as a display: pixels are drawn once, from left to right and from top to bottom.
#[derive(Debug)]
struct PictureFile<'f> {
    file: BorrowedFd<'f>,
}

impl OriginDimensions for PictureFile<'_> {
    fn size(&self) -> Size {
        Size::new(WIDTH as u32, HEIGHT as u32)
    }
}

impl DrawTarget for PictureFile<'_> {
    type Color = Rgb565;
    type Error = Fault;

    /// Writes the colors in their order, in pieces of 64 bytes, which fit the stack.
    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Fault>
    where
        I: IntoIterator<Item = Pixel<Rgb565>>,
    {
        let mut pixels = pixels.into_iter();
        loop {
            let mut bytes = [0; 64];
            let mut filled = 0;
            for pair in bytes.as_chunks_mut::<2>().0 {
                let Some(Pixel(_, color)) = pixels.next() else { break };
                *pair = color.to_le_bytes();
                filled += 2;
            }
            if filled == 0 {
                return Ok(());
            }
            let (bytes, _) = bytes.split_at_checked(filled).ok_or(Fault::Output)?;
            match sys::write(self.file, bytes) {
                Ok(written) if written == bytes.len() => {}
                _ => return Err(Fault::Output),
            }
        }
    }
}
