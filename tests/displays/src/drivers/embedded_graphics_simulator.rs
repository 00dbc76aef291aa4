//! embedded-graphics-simulator: its display, without a window.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Gray8, Rgb888};
use embedded_graphics_simulator::SimulatorDisplay;
use embedded_hal::spi::SpiDevice;

use crate::bus::Bus;
use crate::decode::memory::Memory;
use crate::entry::Entry;
use crate::trial::{Draw, Fault, Trial};

const SIZE: Size = Size::new(99, 61);

/// A trial with a display of this color.
macro_rules! trial {
    ($Color:ty, $bits:literal) => {{
        let connect = |bus: &Bus| -> Draw {
            let mut display = SimulatorDisplay::<$Color>::new(SIZE);
            let mut spi = bus.clone();
            Box::new(move |picture, lines| {
                picture.draw(&mut display, lines)?;
                spi.write(&display.to_be_bytes()).map_err(|_| Fault::Flush)
            })
        };
        let memory = Memory { size: SIZE, bits: $bits };
        let panel = concat!("`SimulatorDisplay<", stringify!($Color), ">` 99x61");
        Trial::new(panel, SIZE, connect, move |sent| memory.decode(sent), super::raw::<$Color>)
    }};
}

pub(super) fn entry() -> Entry {
    Entry {
        name: "embedded-graphics-simulator",
        glue: 1,
        note: "",
        trials: vec![trial!(Rgb888, 24), trial!(Gray8, 8)],
    }
}
