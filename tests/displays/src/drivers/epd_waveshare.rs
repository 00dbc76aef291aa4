//! epd-waveshare.

use embedded_graphics::draw_target::DrawTargetExt;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::BinaryColor;
use epd_waveshare::color::Color;
use epd_waveshare::graphics::{Display, DisplayRotation};
use epd_waveshare::prelude::WaveshareDisplay;
use epd_waveshare::{epd2in9_v2, epd2in13_v2, epd4in2};

use crate::bus::{Bus, DataPin, Delay, Idle, Pin};
use crate::decode::planes::{Family, Planes};
use crate::entry::Entry;
use crate::ink::Ink;
use crate::panel::Turn;
use crate::trial::{Draw, Fault, Trial};

pub(super) fn entry() -> Entry {
    type Epd2in9 = epd2in9_v2::Epd2in9<Bus, Idle, DataPin, Pin, Delay>;
    type Epd2in13 = epd2in13_v2::Epd2in13<Bus, Idle, DataPin, Pin, Delay>;
    type Epd4in2 = epd4in2::Epd4in2<Bus, Idle, DataPin, Pin, Delay>;
    let (low, high) = (Idle { is_high: false }, Idle { is_high: true });
    let mut trials = turned(|rotation| {
        trial::<Epd2in9, 128, 296, { 16 * 296 }>("SSD1680", Family::Ssd16xx, low, rotation)
    });
    trials.extend(turned(|rotation| {
        trial::<Epd2in13, 122, 250, { 16 * 250 }>("SSD1675", Family::Ssd16xx, low, rotation)
    }));
    trials.extend(turned(|rotation| {
        trial::<Epd4in2, 400, 300, { 50 * 300 }>("UC8176", Family::Uc81xx, high, rotation)
    }));
    Entry {
        name: "epd-waveshare",
        glue: 3 + lines_of_code(include_str!("../ink.rs")),
        note: "`BinaryColor::On` is black: draw on `color_converted::<Ink>()`, as above; after an update \
               that failed, call `wake_up` before the next one, which may else begin anywhere",
        trials,
    }
}

/// A panel in all orientations.
fn turned(trial: impl Fn(DisplayRotation) -> Trial) -> Vec<Trial> {
    let turns = [
        (DisplayRotation::Rotate0, 0),
        (DisplayRotation::Rotate90, 1),
        (DisplayRotation::Rotate180, 2),
        (DisplayRotation::Rotate270, 3),
    ];
    turns.into_iter().map(|(rotation, quarters)| trial(rotation).turned(Turn::by(quarters))).collect()
}

/// A panel whose controller is of this family.
fn trial<E, const WIDTH: u32, const HEIGHT: u32, const BYTES: usize>(
    controller: &str,
    family: Family,
    busy: Idle,
    rotation: DisplayRotation,
) -> Trial
where
    E: WaveshareDisplay<Bus, Idle, DataPin, Pin, Delay> + 'static,
{
    let connect = move |bus: &Bus| -> Draw {
        let mut spi = bus.clone();
        let mut epd =
            E::new(&mut spi, busy, bus.data_pin(), Pin, &mut Delay, None).expect("the bus does not fail yet");
        let mut display = Box::new(Display::<WIDTH, HEIGHT, false, BYTES, Color>::default());
        display.set_rotation(rotation);
        Box::new(move |picture, lines| {
            picture.draw(&mut display.color_converted::<Ink>(), lines)?;
            epd.update_and_display_frame(&mut spi, display.buffer(), &mut Delay).map_err(|_| {
                epd.wake_up(&mut spi, &mut Delay).expect("the bus has failed once");
                Fault::Flush
            })
        })
    };
    let glass = Size::new(WIDTH, HEIGHT);
    let planes = Planes { family, columns: WIDTH.next_multiple_of(8), glass, is_transposed: false };
    let panel = format!("{controller} {WIDTH}x{HEIGHT}");
    Trial::new(panel, glass, connect, move |sent| planes.decode(sent), super::raw::<BinaryColor>)
}

/// The lines of a file that are neither blank nor a comment nor name other items.
fn lines_of_code(text: &str) -> usize {
    let is_code = |line: &&str| !line.is_empty() && !line.starts_with("//") && !line.starts_with("use ");
    text.lines().filter(is_code).count()
}
