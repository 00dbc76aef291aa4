//! ssd1306, over I2C.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::BinaryColor;
use ssd1306::mode::DisplayConfig;
use ssd1306::prelude::{DisplayRotation, DisplaySize72x40, DisplaySize128x32, DisplaySize128x64};
use ssd1306::size::DisplaySize;
use ssd1306::{I2CDisplayInterface, Ssd1306};

use crate::bus::Bus;
use crate::decode::pages::Pages;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Fault, Trial};

pub(super) fn entry() -> Entry {
    let mut trials = turned(DisplaySize128x64);
    trials.extend(turned(DisplaySize128x32));
    trials.extend(turned(DisplaySize72x40));
    Entry {
        name: "ssd1306",
        glue: 2,
        note: "after a `flush` that failed, draw again: the driver has forgotten what it did not send",
        trials,
    }
}

/// A panel in all orientations.
fn turned<S: DisplaySize + Copy + 'static>(size: S) -> Vec<Trial> {
    let turns = [
        (DisplayRotation::Rotate0, 0),
        (DisplayRotation::Rotate90, 1),
        (DisplayRotation::Rotate180, 2),
        (DisplayRotation::Rotate270, 3),
    ];
    turns.into_iter().map(|(rotation, quarters)| trial(size, rotation, Turn::by(quarters))).collect()
}

fn trial<S: DisplaySize + Copy + 'static>(size: S, rotation: DisplayRotation, turn: Turn) -> Trial {
    let glass = Size::new(S::WIDTH.into(), S::HEIGHT.into());
    let connect = move |bus: &Bus| -> Draw {
        let interface = I2CDisplayInterface::new(bus.clone());
        let mut display = Ssd1306::new(interface, size, rotation).into_buffered_graphics_mode();
        display.init().expect("the bus does not fail yet");
        Box::new(move |picture, lines| {
            picture.draw(&mut display, lines)?;
            display.flush().map_err(|_| Fault::Redraw)
        })
    };
    let pages = Pages { columns: 128, first_column: S::OFFSETX.into(), glass, goes_on: true };
    let panel = format!("SSD1306 {}x{}", S::WIDTH, S::HEIGHT);
    Trial::new(panel, glass, connect, move |sent| pages.decode(sent), super::raw::<BinaryColor>).turned(turn)
}
