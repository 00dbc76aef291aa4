//! The program that draws many scenes, with all shapes, each from its bytes.
//!
//! The host has them in one file, `scenes`: how many bytes a scene has, in four bytes of which the lowest is the first, then these,
//! then the next scene. So one program draws any number of scenes, and needs RAM for one of them; what would lie in flash is
//! read into RAM. Rejected: scenes within the program, which would be built anew for each change of them, and
//! would need more flash than most boards have.
//!
//! Before the first scene it tells the digest of many numbers, so that arithmetic is checked where no picture asks for it; then
//! how much memory each scene takes, and its digest if there is so much.

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

/// Draws all scenes of the file `scenes`.
pub fn main() -> ! {
    // SAFETY: this function does not return, so it is called once; and what the stack took is looked at after each scene.
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
    report::number(b"digest ", rayline_numbers::digest::<Number>())?;
    report::say(b"done\n")?;
    let file = File::open(c"scenes").map_err(|_| Fault::Input)?;
    // Borrowed once: borrowing asserts that the file is open, and here the compiler sees that it is.
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
        report::say(b"done\n")?;
    }
    Ok(())
}

/// What became of a scene.
#[derive(Debug)]
struct Drawn {
    /// What it takes; if it was not drawn, that much at least.
    memory_bytes: usize,
    /// Of its picture, if there is memory for it.
    digest: Option<u64>,
}

/// Draws the next scene, which has so many bytes.
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

/// How many bytes the next scene has, or `None` after the last.
fn next_length(file: BorrowedFd<'_>) -> Result<Option<usize>, Fault> {
    let mut length = [0; 4];
    match sys::read(file, &mut length) {
        Ok(0) => Ok(None),
        Ok(4) => Ok(Some(u32::from_le_bytes(length) as usize)),
        _ => Err(Fault::Input),
    }
}

/// Passes over so many bytes.
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

/// How much memory the lists of a scene take: as much as each try says that the next list needs. If it is more than there is, the
/// scene may need still more.
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

/// A display of which no more is kept than the digest.
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
