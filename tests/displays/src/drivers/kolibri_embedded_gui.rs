//! kolibri-embedded-gui: the frame buffer of a widget, whose box begins where the widget is on the display.

use embedded_graphics::Drawable;
use embedded_graphics::draw_target::DrawTargetExt;
use embedded_graphics::geometry::{Dimensions, Point, Size};
use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
use embedded_graphics::primitives::Rectangle;
use kolibri_embedded_gui::framebuf::WidgetFramebuf;
use mipidsi::Builder;
use mipidsi::interface::SpiInterface;
use mipidsi::models::ILI9341Rgb565;

use crate::bus::{Bus, Delay, Pin};
use crate::decode::windows::Windows;
use crate::entry::Entry;
use crate::trial::{Draw, Fault, Trial};

pub(super) fn entry() -> Entry {
    let widget = Rectangle::new(Point::new(100, 50), Size::new(83, 61));
    let connect = move |bus: &Bus| -> Draw {
        let interface = SpiInterface::new(bus.clone(), bus.data_pin(), vec![0; 512].leak());
        let mut display = Builder::new(ILI9341Rgb565, interface)
            .reset_pin(Pin)
            .init(&mut Delay)
            .expect("the bus does not fail yet");
        let memory = vec![Rgb565::BLACK; 83 * 61].leak();
        let mut buffer = WidgetFramebuf::new(memory, widget.size, widget.top_left);
        Box::new(move |picture, lines| {
            let corner = buffer.bounding_box().top_left;
            picture.draw(&mut buffer.translated(corner), lines)?;
            buffer.draw(&mut display).map_err(|_| Fault::Flush)
        })
    };
    let controller = Windows::mipi(240, 320).behind(widget);
    let decode = move |sent: &[_]| controller.decode(sent);
    let panel = "widget of 83x61 on an ILI9341";
    Entry {
        name: "kolibri-embedded-gui",
        glue: 3,
        note: "the box of a `WidgetFramebuf` begins at the widget: draw on `translated(corner)`, as above",
        trials: vec![Trial::new(panel, widget.size, connect, decode, super::raw::<Rgb565>)],
    }
}
