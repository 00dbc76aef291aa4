//! flipdot-graphics. The sign that answers is flipdot's own.

use std::cell::RefCell;
use std::error::Error;
use std::rc::Rc;

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_hal::spi::SpiDevice;
use flipdot::core::{Frame, Message};
use flipdot::{Address, PageFlipStyle, SignBus, SignType};
use flipdot_graphics::FlipdotDisplay;
use flipdot_testing::{VirtualSign, VirtualSignBus};

use crate::bus::Bus;
use crate::decode::sign;
use crate::entry::Entry;
use crate::trial::{Draw, Fault, Trial};

const ADDRESS: Address = Address(3);

/// The line to a sign.
struct Line {
    bus: Bus,
    sign: VirtualSignBus<'static>,
}

impl SignBus for Line {
    fn process_message<'a>(
        &mut self,
        message: Message<'_>,
    ) -> Result<Option<Message<'a>>, Box<dyn Error + Send + Sync>> {
        let bytes = Frame::from(message.clone()).to_bytes();
        SpiDevice::write(&mut self.bus, &bytes).map_err(|_| "unplugged")?;
        self.sign.process_message(message)
    }
}

pub(super) fn entry() -> Entry {
    Entry {
        name: "flipdot-graphics",
        glue: 2,
        note: "",
        trials: vec![
            trial(SignType::Max3000Side90x7, Size::new(90, 7)),
            trial(SignType::Max3000Front98x16, Size::new(98, 16)),
        ],
    }
}

fn trial(sign_type: SignType, size: Size) -> Trial {
    let connect = move |bus: &Bus| -> Draw {
        let sign = VirtualSignBus::new([VirtualSign::new(ADDRESS, PageFlipStyle::Manual)]);
        let line = Rc::new(RefCell::new(Line { bus: bus.clone(), sign }));
        let mut display = FlipdotDisplay::new_with_bus(line, ADDRESS, sign_type);
        Box::new(move |picture, lines| {
            picture.draw(&mut display, lines)?;
            display.flush().map_err(|_| Fault::Flush)
        })
    };
    let panel = format!("Max3000 {}x{}", size.width, size.height);
    Trial::new(panel, size, connect, move |sent| sign::decode(size, sent), super::raw::<BinaryColor>)
}
