//! uc8151.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::BinaryColor;
use uc8151::{HEIGHT, LUT, Uc8151, WIDTH};

use crate::bus::{Bus, Delay, Idle, Pin};
use crate::decode::planes::{Family, Planes};
use crate::entry::Entry;
use crate::trial::{Draw, Fault, Trial};

pub(super) fn entry() -> Entry {
    let glass = Size::new(WIDTH, HEIGHT);
    let planes = Planes { family: Family::Uc81xx, columns: HEIGHT, glass, is_transposed: true };
    let connect = |bus: &Bus| -> Draw {
        let mut display = Uc8151::new(bus.clone(), Pin, bus.data_pin(), Idle { is_high: true }, Pin);
        display.setup(&mut Delay, LUT::Internal).expect("the bus does not fail yet");
        Box::new(move |picture, lines| {
            picture.draw(&mut display, lines)?;
            display.update().map_err(|_| Fault::Flush)
        })
    };
    let decode = move |sent: &[_]| planes.decode(sent);
    Entry {
        name: "uc8151",
        glue: 2,
        note: "",
        trials: vec![Trial::new("UC8151 296x128", glass, connect, decode, super::raw::<BinaryColor>)],
    }
}
