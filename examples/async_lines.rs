//! Two lines: one is sent by DMA while the processor traces the other, in a task of embassy's executor.
//!
//! Firmware takes `draw`. There, `send` is the `write` of an asynchronous SPI, into a window that was opened
//! before. The panel takes the upper byte of a color first: `firmware/pico` has a color with that order of
//! bytes, so that a line is sent as it is.

use core::convert::Infallible;
use core::mem::swap;
use std::error::Error;

use embassy_executor::Spawner;
use embassy_futures::join::join;
use embassy_futures::yield_now;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};
use rayline::builtin::CLASSIC;
use rayline::{PreparedScene, Renderer, Settings, Workspace};

const WIDTH: usize = 160;
const HEIGHT: u32 = 120;

async fn draw(panel: &mut Panel) -> Result<(), Box<dyn Error>> {
    let mut memory = Workspace::<{ CLASSIC.bytes::<f32>() }>::new();
    let scene = PreparedScene::<f32, _>::new(&CLASSIC, memory.lend())?;
    let renderer = Renderer::new(&scene, Settings::new(WIDTH as u32, HEIGHT))?;
    let (mut sent, mut traced) = (&mut [Rgb565::BLACK; WIDTH], &mut [Rgb565::BLACK; WIDTH]);
    renderer.line(0, sent)?;
    for y in 1..HEIGHT {
        // `join` polls in this order: the transfer starts, and goes on while the line is traced.
        let (sending, tracing) = join(send(panel, y - 1, sent), async { renderer.line(y, traced) }).await;
        sending?;
        tracing?;
        swap(&mut sent, &mut traced);
    }
    send(panel, HEIGHT - 1, sent).await?;
    Ok(())
}

type Panel = SimulatorDisplay<Rgb565>;

/// Stands for the bus: shows a line.
async fn send(panel: &mut Panel, y: u32, line: &[Rgb565]) -> Result<(), Infallible> {
    // Here, DMA is busy, and other futures run.
    yield_now().await;
    let area = Rectangle::new(Point::new(0, y as i32), Size::new(line.len() as u32, 1));
    panel.fill_contiguous(&area, line.iter().copied())
}

async fn run() -> Result<(), Box<dyn Error>> {
    let mut panel = Panel::new(Size::new(WIDTH as u32, HEIGHT));
    draw(&mut panel).await?;
    rayline_examples::save(&panel, &OutputSettings::default(), "async_lines.png")
}

/// On a board, an executor never ends. So this one does not either, and the program ends itself.
#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let ended = run().await;
    if let Err(error) = &ended {
        eprintln!("{error}");
    }
    std::process::exit(i32::from(ended.is_err()));
}
