//! The program of the board. Its first serial port sends the picture, and then the bytes of stack that were
//! in use, or 0 if the stack has filled its room.

use core::panic::PanicInfo;
use core::ptr;

use crate::picture;

/// Registers of the first serial port.
const UCSR0A: *mut u8 = 0xC0 as *mut u8;
const UCSR0B: *mut u8 = 0xC1 as *mut u8;
const UBRR0L: *mut u8 = 0xC4 as *mut u8;
const UDR0: *mut u8 = 0xC6 as *mut u8;

/// In [`UCSR0A`]: the port takes the next byte.
const DATA_REGISTER_EMPTY: u8 = 1 << 5;
/// In [`UCSR0B`]: the port sends.
const TRANSMITTER_ENABLED: u8 = 1 << 3;
/// In [`UBRR0L`]: 38,400 bits a second with a clock of 16 MHz.
const DIVISOR: u8 = 25;

/// The end of the stack's room.
const RAM_END: usize = 0x2200;
/// The byte that free memory is painted with.
const PAINT: u8 = 0xA5;
/// Bytes below the caller's frame that are not painted, because the painter uses them.
const MARGIN: usize = 64;

#[allow(unsafe_code)]
unsafe extern "C" {
    /// The end of the statics: a symbol that the linker defines.
    static __bss_end: u8;
}

#[unsafe(no_mangle)]
#[allow(unsafe_code)]
extern "C" fn main() -> ! {
    // SAFETY: these are registers of the chip.
    unsafe {
        UBRR0L.write_volatile(DIVISOR);
        UCSR0B.write_volatile(TRANSMITTER_ENABLED);
    }
    paint_stack();
    if picture::draw(send).is_some() {
        used_stack().to_le_bytes().into_iter().for_each(send);
    }
    loop {}
}

/// Sends a byte.
#[allow(unsafe_code)]
fn send(byte: u8) {
    // SAFETY: these are registers of the chip.
    unsafe {
        while UCSR0A.read_volatile() & DATA_REGISTER_EMPTY == 0 {}
        UDR0.write_volatile(byte);
    }
}

/// The lowest byte of the stack's room.
fn lowest() -> *mut u8 {
    ptr::addr_of!(__bss_end).cast_mut()
}

/// Paints the free memory above the statics.
// Not inlined, so that its frame lies below that of the caller.
#[inline(never)]
#[allow(unsafe_code)]
fn paint_stack() {
    let here = 0u8;
    let free = (ptr::addr_of!(here) as usize).saturating_sub(MARGIN).saturating_sub(lowest() as usize);
    for byte in 0..free {
        // SAFETY: the byte lies between the statics and the frame of this function, where nothing lives.
        unsafe { lowest().add(byte).write_volatile(PAINT) };
    }
}

/// The largest number of bytes of stack that were in use, or 0 if the stack has filled its room.
#[allow(unsafe_code)]
fn used_stack() -> u16 {
    let room = RAM_END.saturating_sub(lowest() as usize);
    // SAFETY: these bytes are RAM, and reading them has no effect.
    let is_free = |byte: &usize| unsafe { lowest().add(*byte).read_volatile() } == PAINT;
    match (0..room).take_while(is_free).count() {
        0 => 0,
        free => (room - free) as u16,
    }
}

/// The proof that no panic can be reached: a program that calls this function does not link.
#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    #[allow(unsafe_code)]
    unsafe extern "C" {
        safe fn rayline_panic_is_reachable() -> !;
    }
    rayline_panic_is_reachable()
}
