//! max7219, which takes rows of bits: those of a frame buffer of embedded-graphics.

use embedded_graphics::framebuffer::Framebuffer;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::pixelcolor::raw::{BigEndian, RawU1};
use max7219::MAX7219;

use crate::bus::Bus;
use crate::decode::chain;
use crate::entry::Entry;
use crate::trial::{Draw, Fault, Trial};

/// Matrices of 8x8 in the chain.
const MATRICES: usize = 4;

pub(super) fn entry() -> Entry {
    let connect = |bus: &Bus| -> Draw {
        let mut display = MAX7219::from_spi(MATRICES, bus.clone()).expect("the bus does not fail yet");
        display.power_on().expect("the bus does not fail yet");
        let mut buffer =
            Framebuffer::<BinaryColor, RawU1, BigEndian, { MATRICES * 8 }, 8, { MATRICES * 8 }>::new();
        Box::new(move |picture, lines| {
            picture.draw(&mut buffer, lines)?;
            for matrix in 0..MATRICES {
                let rows = core::array::from_fn(|row| buffer.data()[row * MATRICES + matrix]);
                display.write_raw(matrix, &rows).map_err(|_| Fault::Flush)?;
            }
            Ok(())
        })
    };
    let decode = |sent: &[_]| chain::decode(MATRICES as u32, sent);
    let size = Size::new(MATRICES as u32 * 8, 8);
    Entry {
        name: "max7219",
        glue: 5,
        note: "no `DrawTarget`: draw in a `Framebuffer` of embedded-graphics, and write its rows",
        trials: vec![Trial::new("4 matrices of 8x8", size, connect, decode, super::raw::<BinaryColor>)],
    }
}
