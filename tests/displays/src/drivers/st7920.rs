//! st7920.

use embedded_graphics::pixelcolor::BinaryColor;
use st7920::ST7920;

use crate::bus::{Bus, Delay, Pin};
use crate::decode::serial_lcd;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Fault, Trial};

pub(super) fn entry() -> Entry {
    Entry {
        name: "st7920",
        glue: 2,
        note: "`BinaryColor::On` is dark where the background is light: draw there with a color of your own",
        trials: vec![trial(false, Turn::NONE), trial(true, Turn::by(2))],
    }
}

fn trial(is_flipped: bool, turn: Turn) -> Trial {
    let connect = move |bus: &Bus| -> Draw {
        let mut display = ST7920::new(bus.clone(), Pin, Some(Pin), is_flipped);
        display.init(&mut Delay).expect("the bus does not fail yet");
        Box::new(move |picture, lines| {
            picture.draw(&mut display, lines)?;
            display.flush(&mut Delay).map_err(|_| Fault::Flush)
        })
    };
    Trial::new("ST7920 128x64", serial_lcd::GLASS, connect, serial_lcd::decode, super::raw::<BinaryColor>)
        .turned(turn)
}
