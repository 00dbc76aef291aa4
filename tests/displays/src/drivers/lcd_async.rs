//! lcd-async, with its frame buffer.

use embassy_futures::block_on;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::primitives::Rectangle;
use lcd_async::Builder;
use lcd_async::interface::SpiInterface;
use lcd_async::models::ST7789;
use lcd_async::options::{Orientation, Rotation};
use lcd_async::raw_framebuf::RawFrameBuf;

use crate::bus::{Bus, Delay, Pin};
use crate::decode::windows::Windows;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Fault, Trial};

pub(super) fn entry() -> Entry {
    Entry { name: "lcd-async", glue: 2, note: "", trials: Turn::all().map(trial).collect() }
}

fn trial(turn: Turn) -> Trial {
    let glass = Size::new(135, 240);
    let Size { width, height } = turn.size(glass);
    let connect = move |bus: &Bus| -> Draw {
        let rotation = Rotation::try_from_degree(i32::from(turn.quarters) * 90).expect("a quarter");
        let builder = Builder::new(ST7789, SpiInterface::new(bus.clone(), bus.data_pin()))
            .reset_pin(Pin)
            .display_size(135, 240)
            .display_offset(52, 40)
            .orientation(Orientation { rotation, mirrored: turn.is_mirrored });
        let mut display = block_on(builder.init(&mut Delay)).expect("the bus does not fail yet");
        let memory = vec![0; 135 * 240 * 2].leak();
        let mut buffer = RawFrameBuf::<Rgb565, _>::new(memory, width as usize, height as usize);
        Box::new(move |picture, lines| {
            picture.draw(&mut buffer, lines)?;
            block_on(display.show_raw_data(0, 0, width as u16, height as u16, buffer.as_bytes()))
                .map_err(|_| Fault::Flush)
        })
    };
    let controller = Windows::mipi(240, 320).behind(Rectangle::new(Point::new(52, 40), glass));
    let decode = move |sent: &[_]| controller.decode(sent);
    Trial::new("ST7789 135x240 at (52, 40)", glass, connect, decode, super::raw::<Rgb565>).turned(turn)
}
