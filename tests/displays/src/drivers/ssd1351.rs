//! ssd1351.

use display_interface_spi::SPIInterface;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb565;
use ssd1351::builder::Builder;
use ssd1351::mode::GraphicsMode;
use ssd1351::properties::{DisplayRotation, DisplaySize};

use crate::bus::{Bus, DataPin};
use crate::decode::windows::Windows;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Trial};

pub(super) fn entry() -> Entry {
    let turns = [
        (DisplayRotation::Rotate0, 0),
        (DisplayRotation::Rotate90, 1),
        (DisplayRotation::Rotate180, 2),
        (DisplayRotation::Rotate270, 3),
    ];
    let square = turns
        .into_iter()
        .map(|(rotation, quarters)| trial(DisplaySize::Display128x128, rotation, Turn::by(quarters)));
    let low = trial(DisplaySize::Display128x96, DisplayRotation::Rotate0, Turn::NONE);
    Entry {
        name: "ssd1351",
        glue: 1,
        note: "it panics when the bus fails; 128x96 turned by 90° has the box of the unturned panel",
        trials: square.chain([low]).collect(),
    }
}

fn trial(size: DisplaySize, rotation: DisplayRotation, turn: Turn) -> Trial {
    let (width, height) = size.dimensions();
    let (width, height) = (u32::from(width), u32::from(height));
    let connect = move |bus: &Bus| -> Draw {
        let interface = SPIInterface::new(bus.clone(), bus.data_pin());
        let mut display: GraphicsMode<SPIInterface<Bus, DataPin>> =
            Builder::new().with_size(size).with_rotation(rotation).connect_interface(interface).into();
        display.init().expect("the bus does not fail yet");
        Box::new(move |picture, lines| Ok(picture.draw(&mut display, lines)?))
    };
    let decode = move |sent: &[_]| Windows::ssd1351(height).decode(sent);
    let panel = format!("SSD1351 {width}x{height}");
    Trial::new(panel, Size::new(width, height), connect, decode, super::raw::<Rgb565>)
        .turned(turn)
        .panics_on_fault()
}
