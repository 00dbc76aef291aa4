//! st7735-lcd.

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::primitives::Rectangle;
use st7735_lcd::{Orientation, ST7735};

use crate::bus::{Bus, Delay, Pin};
use crate::decode::windows::Windows;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Trial};

pub(super) fn entry() -> Entry {
    // Panels of 80x160 lie at (26, 1) in the memory of 132x162, seen in the orientation of the driver.
    let turns = [
        (Orientation::Portrait, Turn::by(0), (26, 1)),
        (Orientation::Landscape, Turn::by(1), (1, 26)),
        (Orientation::PortraitSwapped, Turn::by(2), (26, 1)),
        (Orientation::LandscapeSwapped, Turn::by(3), (1, 26)),
    ];
    Entry {
        name: "st7735-lcd",
        glue: 1,
        note: "`new` takes width and height *after* the turn; `set_offset`, too, is for the turned panel",
        trials: turns
            .into_iter()
            .map(|(orientation, turn, offset)| trial(orientation, turn, offset))
            .collect(),
    }
}

fn trial(orientation: Orientation, turn: Turn, (dx, dy): (u16, u16)) -> Trial {
    let glass = Size::new(80, 160);
    let Size { width, height } = turn.size(glass);
    let controller = Windows::mipi(132, 162).behind(Rectangle::new(Point::new(26, 1), glass));
    let connect = move |bus: &Bus| -> Draw {
        let mut display = ST7735::new(bus.clone(), bus.data_pin(), Pin, true, false, width, height);
        display.init(&mut Delay).expect("the bus does not fail yet");
        display.set_orientation(&orientation).expect("the bus does not fail yet");
        display.set_offset(dx, dy);
        Box::new(move |picture, lines| Ok(picture.draw(&mut display, lines)?))
    };
    let decode = move |sent: &[_]| controller.decode(sent);
    Trial::new("ST7735S 80x160 at (26, 1)", glass, connect, decode, super::raw::<Rgb565>).turned(turn)
}
