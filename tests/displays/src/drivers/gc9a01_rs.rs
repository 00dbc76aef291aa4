//! gc9a01-rs, with its frame buffer.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb565;
use gc9a01::mode::DisplayConfiguration;
use gc9a01::prelude::{DisplayResolution240x240, DisplayRotation};
use gc9a01::{Gc9a01, SPIDisplayInterface};

use crate::bus::{Bus, Delay};
use crate::decode::windows::Windows;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Fault, Trial};

pub(super) fn entry() -> Entry {
    let turns = [
        (DisplayRotation::Rotate0, 0),
        (DisplayRotation::Rotate90, 3),
        (DisplayRotation::Rotate180, 2),
        (DisplayRotation::Rotate270, 1),
    ];
    Entry {
        name: "gc9a01-rs",
        glue: 2,
        note: "after a `flush` that failed, draw again: the driver has forgotten what it did not send",
        trials: turns.into_iter().map(|(rotation, quarters)| trial(rotation, Turn::by(quarters))).collect(),
    }
}

fn trial(rotation: DisplayRotation, turn: Turn) -> Trial {
    let connect = move |bus: &Bus| -> Draw {
        let interface = SPIDisplayInterface::new(bus.clone(), bus.data_pin());
        let mut display =
            Box::new(Gc9a01::new(interface, DisplayResolution240x240, rotation).into_buffered_graphics());
        display.init(&mut Delay).expect("the bus does not fail yet");
        Box::new(move |picture, lines| {
            picture.draw(&mut *display, lines)?;
            display.flush().map_err(|_| Fault::Redraw)
        })
    };
    let decode = |sent: &[_]| Windows::mipi(240, 240).bgr().negative().decode(sent);
    Trial::new("GC9A01 240x240", Size::new(240, 240), connect, decode, super::raw::<Rgb565>).turned(turn)
}
