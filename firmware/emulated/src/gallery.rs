//! The program that draws many scenes, with all shapes, each from its bytes.
//!
//! The host writes the scenes into one file, `scenes`: the number of bytes of a scene, as four bytes with the
//! lowest first, then those bytes, then the next scene. So one program draws any number of scenes with the
//! RAM for one scene at a time. Here the data of a scene lie in RAM; a program for one scene alone would have
//! these data in flash. Scenes within the program were rejected: the program would be built again for each
//! change of a scene, and would need more flash than most boards have.
//!
//! The report begins with the digest of arithmetic on many numbers, which covers cases that no picture
//! reaches. For each scene it has the memory that the scene needs, and, if the board has that much, the
//! digest of the picture.

use core::mem::MaybeUninit;

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Size};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::prelude::RgbColor;
use rayline::shape::Shape;
use rayline::{BytesError, Digest, PreparedScene, Renderer, Scene};
use semihosting::fd::{AsFd, BorrowedFd};
use semihosting::fs::File;
use semihosting::{process, sys};

use crate::picture::{Buffer, HEIGHT, Number, SETTINGS, WIDTH};
use crate::stack::{self, PaintedStack};
use crate::{Fault, fpu, program, report};

/// Draws all scenes of the file `scenes`, and reports the figures of each.
pub fn main() -> ! {
    // SAFETY: this function is called once, because it does not return; and after each scene it checks the
    // stack's size.
    #[allow(unsafe_code)]
    let memory = unsafe { stack::memory_below() };
    match draw_all(memory) {
        Ok(()) => process::exit(0),
        Err(fault) => report::fail(fault),
    }
}

fn draw_all(memory: &mut [MaybeUninit<u8>]) -> Result<(), Fault> {
    if fpu::flushes_to_zero() {
        return Err(Fault::FlushToZero);
    }
    report::number(b"digest ", rayline_arithmetic_digest::digest::<Number>())?;
    report::text(b"done\n")?;
    let file = File::open(c"scenes").map_err(|_| Fault::Input)?;
    // Borrow the file once: borrowing asserts that it is open, and here the compiler can prove that.
    let file = file.as_fd();
    let mut buffer = Buffer::new(Rgb888::BLACK);
    while let Some(length) = next_length(file)? {
        let stack = PaintedStack::paint_above(memory.as_mut_ptr_range().end.cast());
        let drawn = draw(file, length, memory, &mut buffer)?;
        report::number(b"memory_bytes ", drawn.memory_bytes as u64)?;
        if let Some(digest) = drawn.digest {
            report::number(b"digest ", digest)?;
        }
        report::number(b"stack_bytes ", stack.used().ok_or(Fault::Stack)?.into())?;
        report::text(b"done\n")?;
    }
    Ok(())
}

/// The result of one scene.
#[derive(Debug)]
struct Drawn {
    /// Memory that the scene needs; a lower bound if it was not drawn.
    memory_bytes: usize,
    /// Digest of the picture, or `None` if the board has too little memory for the scene.
    digest: Option<u64>,
}

/// Draws the next scene of the file, which has `length` bytes.
#[inline(never)]
fn draw(
    file: BorrowedFd<'_>,
    length: usize,
    memory: &mut [MaybeUninit<u8>],
    buffer: &mut Buffer<Rgb888>,
) -> Result<Drawn, Fault> {
    let too_large = |memory_bytes| Ok(Drawn { memory_bytes, digest: None });
    let Some((bytes, free)) = memory.split_at_mut_checked(length) else {
        skip(file, length)?;
        return too_large(length);
    };
    let Ok((bytes, [])) = sys::read_uninit(file, bytes) else { return Err(Fault::Input) };
    let list_bytes = list_bytes(bytes, free)?;
    let Some((lists, free)) = free.split_at_mut_checked(list_bytes) else {
        return too_large(length + list_bytes);
    };
    let scene = Scene::<Shape>::from_bytes(bytes, lists).map_err(|_| Fault::Scene)?;
    let prepared_bytes = scene.bytes::<Number>();
    let memory_bytes = length + list_bytes + prepared_bytes;
    if free.len() < prepared_bytes {
        return too_large(memory_bytes);
    }
    let scene = PreparedScene::<Number, _>::new(&scene, free).map_err(|_| Fault::Scene)?;
    let renderer = Renderer::new(&scene, SETTINGS).map_err(|_| Fault::Settings)?;
    let mut picture = Digested(Digest::new());
    program::draw(&renderer, &mut picture, buffer)?;
    Ok(Drawn { memory_bytes, digest: Some(picture.0.value()) })
}

/// The number of bytes of the next scene, or `None` after the last one.
fn next_length(file: BorrowedFd<'_>) -> Result<Option<usize>, Fault> {
    let mut length = [0; 4];
    match sys::read(file, &mut length) {
        Ok(0) => Ok(None),
        Ok(4) => Ok(Some(u32::from_le_bytes(length) as usize)),
        _ => Err(Fault::Input),
    }
}

/// Reads `length` bytes and drops them.
fn skip(file: BorrowedFd<'_>, mut length: usize) -> Result<(), Fault> {
    let mut piece = [0; 64];
    while length > 0 {
        let (piece, _) = piece.split_at_mut_checked(length.min(64)).ok_or(Fault::Input)?;
        match sys::read(file, piece) {
            Ok(read) if read == piece.len() => length -= read,
            _ => return Err(Fault::Input),
        }
    }
    Ok(())
}

/// Bytes of memory for the lists of a scene. Each try fails with the size that the next list needs, until all
/// lists fit. A result above `memory.len()` is a lower bound.
fn list_bytes(bytes: &[u8], memory: &mut [MaybeUninit<u8>]) -> Result<usize, Fault> {
    let mut enough = 0;
    while let Some(lists) = memory.get_mut(..enough) {
        match Scene::<Shape>::from_bytes(bytes, lists) {
            Ok(_) => break,
            Err(BytesError::Memory { needed, .. }) if needed > enough => enough = needed,
            Err(_) => return Err(Fault::Scene),
        }
    }
    Ok(enough)
}

/// A display that keeps only the digest of its pixels.
#[derive(Debug)]
struct Digested(Digest);

impl OriginDimensions for Digested {
    fn size(&self) -> Size {
        Size::new(WIDTH as u32, HEIGHT as u32)
    }
}

impl DrawTarget for Digested {
    type Color = Rgb888;
    type Error = Fault;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Fault>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        pixels.into_iter().for_each(|Pixel(_, color)| self.0.update(&color.to_le_bytes()));
        Ok(())
    }
}
