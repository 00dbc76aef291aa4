//! sh1106.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::BinaryColor;
use sh1106::Builder;
use sh1106::interface::DisplayInterface;
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
    let builder = |rotation| Builder::new().with_rotation(rotation);
    let mut trials = vec![];
    for (rotation, quarters) in turns {
        let connect =
            move |bus: &Bus| draw(builder(rotation).connect_spi(bus.clone(), bus.data_pin(), Pin).into());
        trials.push(trial("SH1106 128x64, SPI", connect).turned(Turn::by(quarters)));
    }
    for (rotation, quarters) in turns {
        let connect = move |bus: &Bus| draw(builder(rotation).connect_i2c(bus.clone()).into());
        trials.push(trial("SH1106 128x64, I2C", connect).turned(Turn::by(quarters)));
    }
    Entry { name: "sh1106", glue: 2, note: "", trials }
}

fn trial(panel: &str, connect: impl Fn(&Bus) -> Draw + 'static) -> Trial {
    let glass = Size::new(128, 64);
    let pages = Pages { columns: 132, first_column: 2, glass, goes_on: false };
    Trial::new(panel, glass, connect, move |sent| pages.decode(sent), super::raw::<BinaryColor>)
}

fn draw<I: DisplayInterface + 'static>(mut display: GraphicsMode<I>) -> Draw {
    assert!(display.init().is_ok(), "the bus does not fail yet");
    Box::new(move |picture, lines| {
        picture.draw(&mut display, lines)?;
        display.flush().map_err(|_| Fault::Flush)
    })
}
