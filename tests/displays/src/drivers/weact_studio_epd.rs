//! weact-studio-epd.

use display_interface_spi::SPIInterface;
use embedded_graphics::draw_target::DrawTargetExt;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::BinaryColor;
use weact_studio_epd::graphics::{Display213BlackWhite, Display290BlackWhite, DisplayRotation};
use weact_studio_epd::{WeActStudio213BlackWhiteDriver, WeActStudio290BlackWhiteDriver};

use crate::bus::{Bus, Delay, Idle, Pin};
use crate::decode::planes::{Family, Planes};
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
    let mut trials: Vec<_> =
        turns.into_iter().map(|(rotation, quarters)| large(rotation).turned(Turn::by(quarters))).collect();
    trials.push(small());
    Entry {
        name: "weact-studio-epd",
        glue: 2,
        note: "draw on `color_converted::<BinaryColor>()`; the box of 2.13\" has 128 columns, and 122 can be \
               seen: turned by 90° or 180°, they begin at 6",
        trials,
    }
}

/// 2.9 inches.
fn large(rotation: DisplayRotation) -> Trial {
    let connect = move |bus: &Bus| -> Draw {
        let interface = SPIInterface::new(bus.clone(), bus.data_pin());
        let mut driver = WeActStudio290BlackWhiteDriver::new(interface, Idle { is_high: false }, Pin, Delay);
        driver.init().expect("the bus does not fail yet");
        let mut display = Display290BlackWhite::new();
        display.set_rotation(rotation);
        Box::new(move |picture, lines| {
            picture.draw(&mut display.color_converted::<BinaryColor>(), lines)?;
            driver.full_update(&display).map_err(|_| Fault::Flush)
        })
    };
    let glass = Size::new(128, 296);
    Trial::new("SSD1680 128x296", glass, connect, decode(glass), super::raw::<BinaryColor>)
}

/// 2.13 inches, with columns beside the glass.
fn small() -> Trial {
    let connect = |bus: &Bus| -> Draw {
        let interface = SPIInterface::new(bus.clone(), bus.data_pin());
        let mut driver = WeActStudio213BlackWhiteDriver::new(interface, Idle { is_high: false }, Pin, Delay);
        driver.init().expect("the bus does not fail yet");
        let mut display = Display213BlackWhite::new();
        Box::new(move |picture, lines| {
            picture.draw(&mut display.color_converted::<BinaryColor>(), lines)?;
            driver.full_update(&display).map_err(|_| Fault::Flush)
        })
    };
    let glass = Size::new(122, 250);
    Trial::new("SSD1680 122x250", glass, connect, decode(glass), super::raw::<BinaryColor>)
}

fn decode(glass: Size) -> impl Fn(&[crate::bus::Transfer]) -> crate::panel::Panel {
    let planes = Planes { family: Family::Ssd16xx, columns: 128, glass, is_transposed: false };
    move |sent| planes.decode(sent)
}
