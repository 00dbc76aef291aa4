//! A display color of your own: e-paper with black, white and red.
//!
//! Firmware takes `Paper` and `draw`. The conversion into `Rgb888` is for the simulator only; a driver's own
//! color is made in the same way, and `display.color_converted::<Paper>()` makes the driver take `Paper`.

use std::error::Error;

use embedded_graphics::pixelcolor::raw::RawU2;
use embedded_graphics::pixelcolor::{PixelColor, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::{OutputSettingsBuilder, SimulatorDisplay};
use rayline::builtin::CLASSIC;
use rayline::{Background, Camera, DisplayColor, Dither, Light16, PreparedScene, Quantizer, Renderer};
use rayline::{Scene, Settings, Transfer, Vec3, Workspace};

#[derive(Clone, Copy, PartialEq)]
enum Paper {
    White,
    Black,
    Red,
}

impl PixelColor for Paper {
    type Raw = RawU2;
}

impl DisplayColor for Paper {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        // One level for red, and one for what red ink swallows: green and blue.
        let others = (light.g + light.b) / 2;
        match (quantizer.level(light.r, 1), quantizer.level(others, 1)) {
            (_, 1) => Self::White,
            (1, _) => Self::Red,
            _ => Self::Black,
        }
    }
}

impl From<Paper> for Rgb888 {
    fn from(color: Paper) -> Self {
        match color {
            Paper::White => Rgb888::new(240, 238, 230),
            Paper::Black => Rgb888::new(30, 30, 35),
            Paper::Red => Rgb888::new(190, 30, 30),
        }
    }
}

fn draw<D: DrawTarget<Color = Paper>>(display: &mut D) -> Result<(), Box<dyn Error>>
where
    D::Error: core::fmt::Debug + 'static,
{
    // Three colors are few, so areas are dithered; their light is proportional to the pixels of a color.
    let settings =
        Settings { dither: Dither::Ordered, transfer: Transfer::Linear, ..Settings::new(212, 104) };
    let camera = Camera { target: Vec3::new(0.05, -0.05, -1.0), vertical_fov: 0.6, ..CLASSIC.camera };
    let scene = Scene { camera, background: Background::gray(1.0), ..CLASSIC };
    let mut memory = Workspace::<{ CLASSIC.bytes::<f32>() }>::new();
    let scene = PreparedScene::<f32, _>::new(&scene, memory.lend())?;
    Renderer::new(&scene, settings)?.draw(display, &mut [Paper::White; 212])?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut display = SimulatorDisplay::with_default_color(Size::new(212, 104), Paper::White);
    draw(&mut display)?;
    rayline_examples::save(&display, &OutputSettingsBuilder::new().scale(3).build(), "own_color.png")
}
