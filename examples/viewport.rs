//! A picture in a part of a larger screen, with a frame around it and text over it.
//!
//! Firmware takes everything but `SimulatorDisplay` and `save`.

use std::error::Error;

use embedded_graphics::geometry::AnchorPoint;
use embedded_graphics::mono_font::{MonoTextStyle, ascii};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{PrimitiveStyle, Rectangle};
use embedded_graphics::text::{Alignment, Text};
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};
use rayline::builtin::CLASSIC;
use rayline::{PreparedScene, Renderer, Settings, Workspace};

const SCREEN: Size = Size::new(320, 240);
const PICTURE: Rectangle = Rectangle::new(Point::new(80, 40), Size::new(160, 120));

fn draw<D: DrawTarget<Color = Rgb565>>(display: &mut D) -> Result<(), Box<dyn Error>>
where
    D::Error: core::fmt::Debug + 'static,
{
    let failed = |error: D::Error| format!("the display: {error:?}");
    display.clear(Rgb565::CSS_DARK_SLATE_GRAY).map_err(failed)?;
    let edge = PrimitiveStyle::with_stroke(Rgb565::CSS_ORANGE, 3);
    PICTURE.offset(2).into_styled(edge).draw(display).map_err(failed)?;

    let mut memory = Workspace::<{ CLASSIC.bytes::<f32>() }>::new();
    let scene = PreparedScene::<f32, _>::new(&CLASSIC, memory.lend())?;
    let renderer = Renderer::new(&scene, Settings::new(PICTURE.size.width, PICTURE.size.height))?;
    // In this part of the screen, (0, 0) is the picture's corner, and nothing is drawn outside.
    let mut place = display.cropped(&PICTURE);
    renderer.draw(&mut place, &mut [Rgb565::BLACK; PICTURE.size.width as usize])?;

    // Text over the picture is drawn after it.
    let white = MonoTextStyle::new(&ascii::FONT_6X10, Rgb565::WHITE);
    Text::new("classic", Point::new(4, 10), white).draw(&mut place).map_err(failed)?;

    // Below the picture: the same screen, with (0, 0) in another place.
    let middle = PICTURE.anchor_point(AnchorPoint::BottomCenter);
    let mut below = display.translated(middle + Point::new(0, 24));
    let large = MonoTextStyle::new(&ascii::FONT_10X20, Rgb565::CSS_ORANGE);
    Text::with_alignment("160x120 of 320x240", Point::zero(), large, Alignment::Center)
        .draw(&mut below)
        .map_err(failed)?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut display = SimulatorDisplay::new(SCREEN);
    draw(&mut display)?;
    rayline_examples::save(&display, &OutputSettings::default(), "viewport.png")
}
