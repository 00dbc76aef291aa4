//! smart-leds-matrix, before a strip of WS2812.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_hal::spi::SpiDevice;
use smart_leds_matrix::SmartLedMatrix;
use smart_leds_matrix::layout::{Layout, Rectangular};
use smart_leds_trait::{RGB8, SmartLedsWrite};

use crate::bus::{Bus, Unplugged};
use crate::decode::memory::Memory;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Fault, Trial};

const WIDTH: u32 = 30;
const HEIGHT: u32 = 14;

/// A strip that takes green, red and blue of one LED after the other.
struct Strip(Bus);

impl SmartLedsWrite for Strip {
    type Error = Unplugged;
    type Color = RGB8;

    fn write<T, I>(&mut self, colors: T) -> Result<(), Unplugged>
    where
        T: IntoIterator<Item = I>,
        I: Into<RGB8>,
    {
        let bytes: Vec<u8> = colors
            .into_iter()
            .flat_map(|color| {
                let RGB8 { r, g, b } = color.into();
                [g, r, b]
            })
            .collect();
        SpiDevice::write(&mut self.0, &bytes)
    }
}

pub(super) fn entry() -> Entry {
    let turn = |quarters, is_mirrored| Turn { quarters, is_mirrored };
    Entry {
        name: "smart-leds-matrix",
        glue: 2,
        note: "`Transfer::Linear`, as above",
        trials: vec![
            trial(|| Rectangular::new(WIDTH, HEIGHT), turn(0, false)),
            trial(|| Rectangular::new_invert_x(WIDTH, HEIGHT), turn(0, true)),
            trial(|| Rectangular::new_invert_y(WIDTH, HEIGHT), turn(2, true)),
            trial(|| Rectangular::new_invert_xy(WIDTH, HEIGHT), turn(2, false)),
        ],
    }
}

fn trial<L: Layout + 'static>(layout: fn() -> L, turn: Turn) -> Trial {
    let connect = move |bus: &Bus| -> Draw {
        let mut display =
            SmartLedMatrix::<_, _, { (WIDTH * HEIGHT) as usize }>::new(Strip(bus.clone()), layout());
        Box::new(move |picture, lines| {
            picture.draw(&mut display, lines)?;
            display.flush().map_err(|_| Fault::Flush)
        })
    };
    let size = Size::new(WIDTH, HEIGHT);
    let decode = move |sent: &[_]| Memory { size, bits: 24 }.decode(sent);
    let code = |color: Rgb888| u32::from_be_bytes([0, color.g(), color.r(), color.b()]);
    Trial::new("WS2812 30x14", size, connect, decode, code).turned(turn)
}
