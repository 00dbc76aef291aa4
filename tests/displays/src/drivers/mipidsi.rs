//! mipidsi: many controllers, in eight orientations.

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;
use mipidsi::Builder;
use mipidsi::interface::{InterfacePixelFormat, SpiInterface};
use mipidsi::models::{GC9A01, ILI9341Rgb565, ILI9341Rgb666, ILI9486Rgb666, Model, ST7735s, ST7789};
use mipidsi::options::{ColorInversion, ColorOrder, Orientation, Rotation};
use rayline::DisplayColor;

use crate::bus::{Bus, Delay, Pin};
use crate::decode::windows::Windows;
use crate::entry::Entry;
use crate::panel::Turn;
use crate::trial::{Draw, Trial};

pub(super) fn entry() -> Entry {
    let mut trials = vec![];
    for turn in Turn::all() {
        trials.push(trial(|| ST7789, "ST7789", (135, 240), (52, 40), turn, super::raw));
    }
    for turn in Turn::all() {
        trials.push(trial(|| ST7735s, "ST7735S", (80, 160), (26, 1), turn, super::raw));
    }
    for turn in Turn::all() {
        trials.push(trial(|| GC9A01, "GC9A01", (240, 240), (0, 0), turn, super::raw));
    }
    for turn in Turn::all() {
        trials.push(trial(|| ILI9341Rgb565, "ILI9341", (240, 320), (0, 0), turn, super::raw));
    }
    for turn in Turn::all() {
        trials.push(trial(|| ILI9341Rgb666, "ILI9341 in 18 bits", (240, 320), (0, 0), turn, super::raw));
    }
    for turn in Turn::all() {
        trials.push(trial(|| ILI9486Rgb666, "ILI9486 in 18 bits", (320, 480), (0, 0), turn, super::raw));
    }
    Entry {
        name: "mipidsi",
        glue: 1,
        note: "if red and blue are swapped, `ColorOrder::Bgr`; if the picture is a negative, \
               `ColorInversion::Inverted`",
        trials,
    }
}

/// A model with glass of this size at this place of its memory.
fn trial<M>(
    model: fn() -> M,
    name: &str,
    size: (u16, u16),
    offset: (u16, u16),
    turn: Turn,
    code: fn(M::ColorFormat) -> u32,
) -> Trial
where
    M: Model<ColorFormat: InterfacePixelFormat<u8> + DisplayColor> + 'static,
{
    let (width, height) = size;
    let place = if offset == (0, 0) { String::new() } else { format!(" at {offset:?}") };
    let glass = Size::new(width.into(), height.into());
    let corner = Point::new(offset.0.into(), offset.1.into());
    let memory = M::FRAMEBUFFER_SIZE;
    let controller = Windows::mipi(memory.0.into(), memory.1.into())
        .bgr()
        .negative()
        .behind(Rectangle::new(corner, glass));
    let connect = move |bus: &Bus| -> Draw {
        let interface = SpiInterface::new(bus.clone(), bus.data_pin(), vec![0; 512].leak());
        let rotation = Rotation::try_from_degree(i32::from(turn.quarters) * 90).expect("a quarter");
        let mut display = Builder::new(model(), interface)
            .reset_pin(Pin)
            .display_size(size.0, size.1)
            .display_offset(offset.0, offset.1)
            .orientation(Orientation { rotation, mirrored: turn.is_mirrored })
            .color_order(ColorOrder::Bgr)
            .invert_colors(ColorInversion::Inverted)
            .init(&mut Delay)
            .expect("the bus does not fail yet");
        Box::new(move |picture, lines| Ok(picture.draw(&mut display, lines)?))
    };
    Trial::new(
        format!("{name} {width}x{height}{place}"),
        glass,
        connect,
        move |sent| controller.decode(sent),
        code,
    )
    .turned(turn)
}
