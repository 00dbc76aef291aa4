//! embedded-graphics-framebuf, before a panel with mipidsi.

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, Size};
use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
use embedded_graphics_framebuf::FrameBuf;
use mipidsi::Builder;
use mipidsi::interface::SpiInterface;
use mipidsi::models::ILI9341Rgb565;

use crate::bus::{Bus, Delay, Pin};
use crate::decode::windows::Windows;
use crate::entry::Entry;
use crate::trial::{Draw, Fault, Trial};

pub(super) fn entry() -> Entry {
    let connect = |bus: &Bus| -> Draw {
        let interface = SpiInterface::new(bus.clone(), bus.data_pin(), vec![0; 512].leak());
        let mut display = Builder::new(ILI9341Rgb565, interface)
            .reset_pin(Pin)
            .init(&mut Delay)
            .expect("the bus does not fail yet");
        let memory: &mut [Rgb565; 240 * 320] =
            vec![Rgb565::BLACK; 240 * 320].leak().try_into().expect("as long");
        let mut buffer = FrameBuf::new(memory, 240, 320);
        Box::new(move |picture, lines| {
            picture.draw(&mut buffer, lines)?;
            let area = buffer.bounding_box();
            display.fill_contiguous(&area, buffer.data.iter().copied()).map_err(|_| Fault::Flush)
        })
    };
    let glass = Size::new(240, 320);
    let decode = |sent: &[_]| Windows::mipi(240, 320).decode(sent);
    Entry {
        name: "embedded-graphics-framebuf",
        glue: 3,
        note: "",
        trials: vec![Trial::new("ILI9341 240x320", glass, connect, decode, super::raw::<Rgb565>)],
    }
}
