//! A Raspberry Pi Pico (RP2040) with a panel of 320x240 pixels: a camera goes around a ray-traced scene,
//! frame after frame. Both cores trace bands of lines, while DMA sends finished bands to the panel.
//!
//! # Wiring
//!
//! A panel with an ST7789 controller. The Pimoroni Pico Display Pack 2.0 has this wiring:
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
//! The program turns on the Pico's own light when it stops because of a fault.
//!
//! # Running
//!
//! `cargo boards pico` runs this program in an emulator. For a Pico with a debug probe, run in this folder:
//!
//! ```sh
//! RAYLINE_MODE=realtime cargo build --release --target thumbv6m-none-eabi --features second-core
//! probe-rs run --chip RP2040 ../target/thumbv6m-none-eabi/release/pico
//! ```
//!
//! Without a probe, run `elf2uf2-rs ../target/thumbv6m-none-eabi/release/pico pico.uf2`, hold the button
//! BOOTSEL while you plug the Pico in, and copy the file to the drive that appears.
//!
//! # Panics
//!
//! The HAL holds panics; tracing holds none. `cargo boards pico` follows every call from `tracer::step` to
//! check that, and `cargo boards --prove-no-panic pico` shows that the check can fail.

#![no_std]
#![no_main]

mod band;
mod fault;
mod job;
mod panel;
mod panel_color;
mod panic;
// The build script writes public constants, for programs that are libraries too, or draw previews.
#[allow(dead_code, unreachable_pub)]
mod picture;
mod quality;
#[cfg(feature = "second-core")]
mod second_core;
mod tracer;

use core::convert::Infallible;

use cortex_m::asm;
use cortex_m_rt::entry;
use embassy_futures::block_on;
use embassy_futures::select::{Either, select};
use embassy_rp::clocks::ClockConfig;
use embassy_rp::gpio::{Level, Output};
use embassy_rp::spi::Spi;
use embassy_rp::{bind_interrupts, dma, peripherals};
use rayline::PreparedScene;

use band::Band;
use fault::Fault;
use job::{BANDS, Schedule, TO_TRACE};
use panel::{Panel, Pins};
use picture::{SCENE, Workspace};
use quality::Memory;
use tracer::Tracer;

/// The fastest clock that the chip's maker supports (Raspberry Pi Pico SDK 2.1.1, "RP2040 is now certified to
/// run at 200 MHz", option `PICO_USE_FASTEST_SUPPORTED_CLOCK`). The HAL sets the voltage of 1.15 V that it
/// needs.
const CLOCK_HZ: u32 = 200_000_000;

bind_interrupts!(struct Interrupts {
    DMA_IRQ_0 => dma::InterruptHandler<peripherals::DMA_CH0>;
});

#[entry]
fn main() -> ! {
    static mut WORKSPACE: Workspace = Workspace::new();
    static mut MEMORY: Memory = Memory::new();
    static mut BANDS_OF_LINES: [Band; BANDS] = [Band::BLACK; BANDS];
    let clocks = ClockConfig::system_freq(CLOCK_HZ).unwrap_or_else(|_| ClockConfig::crystal(12_000_000));
    let p = embassy_rp::init(embassy_rp::config::Config::new(clocks));
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
        || {
            let scene = PreparedScene::new(&SCENE, WORKSPACE.lend())?;
            #[cfg(feature = "second-core")]
            second_core::start(p.CORE1, scene)?;
            Ok(Tracer::new(scene, MEMORY))
        },
        BANDS_OF_LINES,
    );
    light.set_high();
    loop {
        asm::wfi();
    }
}

/// Shows frame after frame, and returns only on a fault.
fn run(
    bus: panel::Bus,
    pins: Pins,
    tracer: impl FnOnce() -> Result<Tracer, Fault>,
    bands: &'static mut [Band; BANDS],
) -> Result<Infallible, Fault> {
    let mut schedule = Schedule::new();
    for (number, band) in bands.iter_mut().enumerate() {
        TO_TRACE.try_send(schedule.next(number, band)).map_err(|_| Fault::Line)?;
    }
    // The panel takes a second to start. The second core traces the first picture meanwhile.
    let tracer = tracer()?;
    let panel = Panel::new(bus, pins)?;
    // The panel sends one band while this core traces another.
    match block_on(select(panel.show(schedule), tracer.trace())) {
        Either::First(ended) | Either::Second(ended) => ended,
    }
}
