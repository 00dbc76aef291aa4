//! Black and white for an OLED with an SSD1306 controller, which takes pages: a byte is a column of eight
//! pixels, the upper one in the lowest bit.
//!
//! Firmware takes `draw`: it needs eight lines of colors and 128 bytes, and no frame buffer. There, `send`
//! writes the address of the page and the page to the bus. The driver of the crate `ssd1306` does without
//! this: it is a `DrawTarget`, with a frame buffer of 1 KB.

use std::convert::Infallible;
use std::error::Error;

use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::{BinaryColorTheme, OutputSettingsBuilder, SimulatorDisplay};
use rayline::builtin::CLASSIC;
use rayline::{
    Background, Camera, Dither, PreparedScene, Renderer, Scene, Settings, Transfer, Vec3, Workspace,
};

const WIDTH: usize = 128;
const HEIGHT: usize = 64;
/// The lines of a page.
const LINES: usize = 8;

/// Dithering turns on a share of the pixels. The light of an area is proportional to this share, so the curve
/// of a screen is left out.
const SETTINGS: Settings = Settings {
    dither: Dither::Ordered,
    transfer: Transfer::Linear,
    ..Settings::new(WIDTH as u32, HEIGHT as u32)
};

fn draw(panel: &mut Panel) -> Result<(), Box<dyn Error>> {
    // On a black sky, and from nearer: a small picture shows large things.
    let camera = Camera { target: Vec3::new(0.0, -0.07, -1.0), vertical_fov: 0.55, ..CLASSIC.camera };
    let scene = Scene { camera, background: Background::BLACK, ..CLASSIC };
    let mut memory = Workspace::<{ CLASSIC.bytes::<f32>() }>::new();
    let scene = PreparedScene::<f32, _>::new(&scene, memory.lend())?;
    let renderer = Renderer::new(&scene, SETTINGS)?;
    let mut lines = [BinaryColor::Off; WIDTH * LINES];
    for top in (0..HEIGHT).step_by(LINES) {
        renderer.lines(top as u32, &mut lines, &mut ())?;
        let mut page = [0; WIDTH];
        for (bit, line) in lines.chunks_exact(WIDTH).enumerate() {
            for (byte, pixel) in page.iter_mut().zip(line) {
                *byte |= u8::from(pixel.is_on()) << bit;
            }
        }
        send(panel, top / LINES, &page)?;
    }
    Ok(())
}

type Panel = SimulatorDisplay<BinaryColor>;

/// Stands for the bus: shows a page.
fn send(panel: &mut Panel, number: usize, page: &[u8; WIDTH]) -> Result<(), Infallible> {
    let pixels = page.iter().enumerate().flat_map(|(x, byte)| {
        (0..LINES).map(move |bit| {
            let place = Point::new(x as i32, (number * LINES + bit) as i32);
            Pixel(place, BinaryColor::from(byte >> bit & 1 == 1))
        })
    });
    panel.draw_iter(pixels)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut panel = Panel::new(Size::new(WIDTH as u32, HEIGHT as u32));
    draw(&mut panel)?;
    let output = OutputSettingsBuilder::new().theme(BinaryColorTheme::OledBlue).scale(4).build();
    rayline_examples::save(&panel, &output, "mono.png")
}
