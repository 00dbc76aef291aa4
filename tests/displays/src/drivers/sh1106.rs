//! sh1106.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::BinaryColor;
use sh1106::Builder;
use sh1106::mode::GraphicsMode;
use sh1106::prelude::DisplayRotation;

use crate::bus::{Bus, Pin};
use crate::decode::pages::Pages;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Fault, Trial};

pub(super) fn entry() -> Entry {
    let turns = [
        (DisplayRotation::Rotate0, 0),
        (DisplayRotation::Rotate90, 1),
        (DisplayRotation::Rotate180, 2),
        (DisplayRotation::Rotate270, 3),
    ];
    Entry {
        name: "sh1106",
        glue: 2,
        note: "",
        trials: turns.into_iter().map(|(rotation, quarters)| trial(rotation, Turn::by(quarters))).collect(),
    }
}

fn trial(rotation: DisplayRotation, turn: Turn) -> Trial {
    let connect = move |bus: &Bus| -> Draw {
        let mut display: GraphicsMode<_> =
            Builder::new().with_rotation(rotation).connect_spi(bus.clone(), bus.data_pin(), Pin).into();
        display.init().expect("the bus does not fail yet");
        Box::new(move |picture, lines| {
            picture.draw(&mut display, lines)?;
            display.flush().map_err(|_| Fault::Flush)
        })
    };
    let glass = Size::new(128, 64);
    let pages = Pages { columns: 132, first_column: 2, glass, goes_on: false };
    let decode = move |sent: &[_]| pages.decode(sent);
    Trial::new("SH1106 128x64", glass, connect, decode, super::raw::<BinaryColor>).turned(turn)
}
