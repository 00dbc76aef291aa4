//! A panel with an ST7789 controller, by the driver crate `mipidsi`, at the end of a mock bus.
//!
//! Firmware takes `main` without its last line. There, the device is an `ExclusiveDevice` of the crate
//! `embedded-hal-bus` around the HAL's SPI, the pin an output of the HAL, and the delay its timer. Other
//! controllers have other models: `ILI9341Rgb565`, `ST7735s`, `GC9A01`.

use std::error::Error;

use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use embedded_graphics_simulator::OutputSettings;
use mipidsi::options::ColorInversion;
use mipidsi::{Builder, interface::SpiInterface, models::ST7789};
use rayline::builtin::CLASSIC;
use rayline::{PreparedScene, Renderer, Settings, Workspace};
use rayline_examples::{MockBus, MockDelay, MockPanel, MockPin};

const WIDTH: u16 = 240;
const HEIGHT: u16 = 240;

fn main() -> Result<(), Box<dyn Error>> {
    let panel = MockPanel::new(Size::new(WIDTH.into(), HEIGHT.into()));
    let (device, data_pin, mut delay) = (MockBus(&panel), MockPin(&panel), MockDelay);

    // The driver gathers bytes in it before it sends them.
    let mut buffer = [0; 512];
    let mut display = Builder::new(ST7789, SpiInterface::new(device, data_pin, &mut buffer))
        .display_size(WIDTH, HEIGHT)
        // Most panels with this controller show inverted colors unless inversion is on.
        .invert_colors(ColorInversion::Inverted)
        .init(&mut delay)
        .map_err(|error| format!("the panel: {error:?}"))?;

    let mut memory = Workspace::<{ CLASSIC.bytes::<f32>() }>::new();
    let scene = PreparedScene::<f32, _>::new(&CLASSIC, memory.lend())?;
    // The size that the display has after it is turned.
    let Size { width, height } = display.bounding_box().size;
    let renderer = Renderer::new(&scene, Settings::new(width, height))?;
    // Each line goes to the panel in one window.
    renderer.draw(&mut display, &mut [Rgb565::BLACK; WIDTH as usize])?;

    rayline_examples::save(&panel.screen(), &OutputSettings::default(), "mipidsi.png")
}
