//! A Raspberry Pi Pico (RP2040) with a panel of 320x240 pixels: a camera goes around a ray-traced scene, frame after
//! frame. DMA sends one band of lines to the panel while the next is traced.
//!
//! # Wiring
//!
//! A panel with an ST7789 controller, as the Pimoroni Pico Display Pack 2.0 has it, which plugs right in:
//!
//! | Pico | panel |
//! |---|---|
//! | GP16 | D/C |
//! | GP17 | chip select |
//! | GP18 | clock (SCK, SCL) |
//! | GP19 | data (MOSI, SDA) |
//! | GP20 | backlight |
//! | 3V3, GND | supply; also reset, if there is one: to 3V3 |
//!
//! The Pico's own light means that the program cannot go on.
//!
//! # Running
//!
//! `cargo boards pico` runs this very program in an emulator. For a Pico with a debug probe, from this folder:
//!
//! ```sh
//! cargo build --release --target thumbv6m-none-eabi --features second-core
//! probe-rs run --chip RP2040 ../target/thumbv6m-none-eabi/release/pico
//! ```
//!
//! Without a probe: `elf2uf2-rs ../target/thumbv6m-none-eabi/release/pico pico.uf2`, and copy that file to the drive
//! that appears while the button BOOTSEL is held.
//!
//! # Panics
//!
//! The HAL has panics. Tracing has none: `cargo boards --prove-no-panic pico` follows every call from `line::trace`.

#![no_std]
#![no_main]

mod fault;
mod frames;
mod line;
mod panel;
mod panel_color;
mod panic;
// The build script writes its constants for any program, so they are more public than here is use for.
#[allow(unreachable_pub)]
mod picture;
#[cfg_attr(not(feature = "second-core"), path = "no_second_core.rs")]
mod second_core;
mod tracer;

use core::convert::Infallible;

use cortex_m::asm;
use cortex_m_rt::entry;
use embassy_futures::block_on;
use embassy_futures::select::{Either, select};
use embassy_rp::gpio::{Level, Output};
use embassy_rp::spi::Spi;
use embassy_rp::{bind_interrupts, dma, peripherals};
use embassy_sync::blocking_mutex::raw::NoopRawMutex;
use embassy_sync::zerocopy_channel::Channel;
use rayline::PreparedScene;

use fault::Fault;
use panel::{Panel, Pins};
use picture::{Band, Memory, SCENE};
use tracer::Tracer;

bind_interrupts!(struct Interrupts {
    DMA_IRQ_0 => dma::InterruptHandler<peripherals::DMA_CH0>;
});

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory::new();
    static mut BANDS: [Band; 2] = [picture::BLACK; 2];
    let p = embassy_rp::init(Default::default());
    let mut light = Output::new(p.PIN_25, Level::Low);
    let bus = Spi::new_txonly(p.SPI0, p.PIN_18, p.PIN_19, p.DMA_CH0, Interrupts, panel::bus());
    let pins = Pins {
        data: Output::new(p.PIN_16, Level::High),
        select: Output::new(p.PIN_17, Level::High),
        backlight: Output::new(p.PIN_20, Level::Low),
    };
    let Err(_) = run(
        bus,
        pins,
        move || {
            let scene = PreparedScene::new(SCENE, MEMORY.lend())?;
            Ok(Tracer::new(scene, second_core::start(p.CORE1, scene)?))
        },
        BANDS,
    );
    light.set_high();
    loop {
        asm::wfi();
    }
}

/// Shows frame after frame: there is no end but a fault.
fn run(
    bus: panel::Bus,
    pins: Pins,
    tracer: impl FnOnce() -> Result<Tracer, Fault>,
    bands: &mut [Band; 2],
) -> Result<Infallible, Fault> {
    let panel = Panel::new(bus, pins)?;
    let tracer = tracer()?;
    // One band is sent while the next is traced.
    let mut bands = Channel::<NoopRawMutex, Band>::new(bands);
    let (mut traced, mut to_send) = bands.split();
    match block_on(select(panel.show(&mut to_send), tracer.trace(&mut traced))) {
        Either::First(ended) | Either::Second(ended) => ended,
    }
}
