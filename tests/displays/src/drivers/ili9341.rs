//! ili9341.

use display_interface_spi::SPIInterface;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb565;
use ili9341::{DisplaySize240x320, Ili9341, Orientation};

use crate::bus::{Bus, Delay, Pin};
use crate::decode::windows::Windows;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Trial};

pub(super) fn entry() -> Entry {
    // The glass shows the memory from right to left: the driver's portrait sets the bit that turns it back.
    let turns: [(fn() -> Orientation, u8); 4] = [
        (|| Orientation::Portrait, 0),
        (|| Orientation::Landscape, 1),
        (|| Orientation::PortraitFlipped, 2),
        (|| Orientation::LandscapeFlipped, 3),
    ];
    Entry {
        name: "ili9341",
        glue: 1,
        note: "",
        trials: turns
            .into_iter()
            .map(|(orientation, quarters)| trial(orientation, Turn::by(quarters)))
            .collect(),
    }
}

fn trial(orientation: fn() -> Orientation, turn: Turn) -> Trial {
    let connect = move |bus: &Bus| -> Draw {
        let interface = SPIInterface::new(bus.clone(), bus.data_pin());
        let mut display = Ili9341::new(interface, Pin, &mut Delay, orientation(), DisplaySize240x320)
            .expect("the bus does not fail yet");
        Box::new(move |picture, lines| Ok(picture.draw(&mut display, lines)?))
    };
    let decode = |sent: &[_]| Windows::mipi(240, 320).mirrored().bgr().decode(sent);
    Trial::new("ILI9341 240x320", Size::new(240, 320), connect, decode, super::raw::<Rgb565>).turned(turn)
}
