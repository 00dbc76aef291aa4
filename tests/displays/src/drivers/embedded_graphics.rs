//! embedded-graphics: its frame buffer, whose bytes a program sends.

use embedded_graphics::framebuffer::{Framebuffer, buffer_size};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::raw::BigEndian;
use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Rgb565};
use embedded_hal::spi::SpiDevice;

use crate::bus::Bus;
use crate::decode::memory::Memory;
use crate::entry::Entry;
use crate::trial::{Draw, Fault, Trial};

/// No multiple of a byte.
const WIDTH: usize = 99;
const HEIGHT: usize = 61;

/// A trial with a frame buffer of this color.
macro_rules! trial {
    ($Color:ty, $bits:literal) => {{
        let connect = |bus: &Bus| -> Draw {
            const BYTES: usize = buffer_size::<$Color>(WIDTH, HEIGHT);
            let mut buffer = Framebuffer::<$Color, _, BigEndian, WIDTH, HEIGHT, BYTES>::new();
            let mut spi = bus.clone();
            Box::new(move |picture, lines| {
                picture.draw(&mut buffer, lines)?;
                spi.write(buffer.data()).map_err(|_| Fault::Flush)
            })
        };
        let size = Size::new(WIDTH as u32, HEIGHT as u32);
        let memory = Memory { size, bits: $bits };
        let panel = concat!("`Framebuffer<", stringify!($Color), ", …>` 99x61");
        Trial::new(panel, size, connect, move |sent| memory.decode(sent), super::raw::<$Color>)
    }};
}

pub(super) fn entry() -> Entry {
    Entry {
        name: "embedded-graphics",
        glue: 2,
        note: "",
        trials: vec![trial!(Rgb565, 16), trial!(Gray4, 4), trial!(BinaryColor, 1)],
    }
}
