//! oled_async.

use display_interface_spi::SPIInterface;
use embassy_futures::block_on;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::BinaryColor;
use oled_async::Builder;
use oled_async::display::DisplayVariant;
use oled_async::displayrotation::DisplayRotation;
use oled_async::displays::sh1106::Sh1106_128_64;
use oled_async::displays::sh1107::Sh1107_64_128;
use oled_async::mode::GraphicsMode;

use crate::bus::{Bus, DataPin};
use crate::decode::pages::Pages;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Fault, Trial};

pub(super) fn entry() -> Entry {
    let mut trials = turned(|| Sh1106_128_64 {}, "SH1106", 132);
    trials.extend(turned(|| Sh1107_64_128 {}, "SH1107", 128));
    Entry { name: "oled_async", glue: 2, note: "", trials }
}

/// A panel in all orientations.
fn turned<V: DisplayVariant + 'static>(variant: fn() -> V, name: &str, columns: u32) -> Vec<Trial> {
    let turns = [
        (DisplayRotation::Rotate0, 0),
        (DisplayRotation::Rotate90, 1),
        (DisplayRotation::Rotate180, 2),
        (DisplayRotation::Rotate270, 3),
    ];
    let trial = |(rotation, quarters)| trial(variant, name, columns, rotation).turned(Turn::by(quarters));
    turns.into_iter().map(trial).collect()
}

fn trial<V: DisplayVariant + 'static>(
    variant: fn() -> V,
    name: &str,
    columns: u32,
    rotation: DisplayRotation,
) -> Trial {
    let glass = Size::new(V::WIDTH.into(), V::HEIGHT.into());
    let connect = move |bus: &Bus| -> Draw {
        let interface = SPIInterface::new(bus.clone(), bus.data_pin());
        let mut display: GraphicsMode<V, SPIInterface<Bus, DataPin>> =
            Builder::new(variant()).with_rotation(rotation).connect(interface).into();
        block_on(display.init()).expect("the bus does not fail yet");
        Box::new(move |picture, lines| {
            picture.draw(&mut display, lines)?;
            block_on(display.flush()).map_err(|_| Fault::Flush)
        })
    };
    let pages = Pages { columns, first_column: V::COLUMN_OFFSET.into(), glass, goes_on: false };
    let panel = format!("{name} {}x{}", V::WIDTH, V::HEIGHT);
    Trial::new(panel, glass, connect, move |sent| pages.decode(sent), super::raw::<BinaryColor>)
}
