//! Black and white e-paper, in bands of 16 lines: the panel takes a bit for each pixel, and 1 is black.
//!
//! Firmware takes `Ink` and `draw`: they need a line of colors and a band of 400 bytes, and no frame buffer.
//! There, `send` writes the band to the controller's memory.

use std::convert::Infallible;
use std::error::Error;

use embedded_graphics::framebuffer::{Framebuffer, buffer_size};
use embedded_graphics::image::{Image, ImageRaw};
use embedded_graphics::pixelcolor::raw::{BigEndian, RawU1};
use embedded_graphics::pixelcolor::{BinaryColor, PixelColor};
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::{BinaryColorTheme, OutputSettingsBuilder, SimulatorDisplay};
use rayline::builtin::CLASSIC;
use rayline::{Background, Camera, DisplayColor, Dither, Light16, PreparedScene, Quantizer, Renderer};
use rayline::{Scene, Settings, Transfer, Vec3, Workspace};

const WIDTH: usize = 200;
const HEIGHT: usize = 200;
/// The lines of a band; the last band has fewer.
const LINES: usize = 16;

/// Whether a pixel is black. A `BinaryColor` would be on where there is light: a negative.
#[derive(Clone, Copy, PartialEq)]
struct Ink(bool);

impl PixelColor for Ink {
    type Raw = RawU1;
}

impl From<Ink> for RawU1 {
    fn from(Ink(is_black): Ink) -> Self {
        Self::new(u8::from(is_black))
    }
}

impl DisplayColor for Ink {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        Self(quantizer.level(light.luminance(), 1) == 0)
    }
}

fn draw(panel: &mut Panel) -> Result<(), Box<dyn Error>> {
    let size = Settings::new(WIDTH as u32, HEIGHT as u32);
    let settings = Settings { dither: Dither::Ordered, transfer: Transfer::Linear, ..size };
    let camera = Camera { target: Vec3::new(0.0, -0.05, -1.0), vertical_fov: 0.7, ..CLASSIC.camera };
    let scene = Scene { camera, background: Background::gray(1.0), ..CLASSIC };
    let mut memory = Workspace::<{ CLASSIC.bytes::<f32>() }>::new();
    let scene = PreparedScene::<f32, _>::new(&scene, memory.lend())?;
    let renderer = Renderer::new(&scene, settings)?;
    let mut line = [Ink(false); WIDTH];
    let mut band =
        Framebuffer::<Ink, _, BigEndian, WIDTH, LINES, { buffer_size::<Ink>(WIDTH, LINES) }>::new();
    for top in (0..HEIGHT).step_by(LINES) {
        let lines = top as u32..HEIGHT.min(top + LINES) as u32;
        // Line `top` of the picture is line 0 of the band.
        let mut place = band.translated(Point::new(0, -(top as i32)));
        renderer.frame(lines, &mut line)?.draw(&mut place)?;
        send(panel, top, band.data())?;
    }
    Ok(())
}

type Panel = SimulatorDisplay<BinaryColor>;

/// Stands for the bus: shows a band. What is beyond the panel's last line is not shown.
fn send(panel: &mut Panel, top: usize, band: &[u8]) -> Result<(), Infallible> {
    let band = ImageRaw::<BinaryColor>::new(band, WIDTH as u32);
    Image::new(&band, Point::new(0, top as i32)).draw(panel)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut panel = Panel::new(Size::new(WIDTH as u32, HEIGHT as u32));
    draw(&mut panel)?;
    let output = OutputSettingsBuilder::new().theme(BinaryColorTheme::LcdWhite).scale(3).pixel_spacing(0);
    rayline_examples::save(&panel, &output.build(), "epaper.png")
}
