//! The panel: its driver initializes it, then DMA sends bands to it.

use core::convert::Infallible;

use embassy_rp::clocks::clk_sys_freq;
use embassy_rp::gpio::Output;
use embassy_rp::peripherals::SPI0;
use embassy_rp::spi::{Async, Config, Spi};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::RgbColor;
use embedded_hal::delay::DelayNs;
use embedded_hal::spi::SpiBus;
use embedded_hal_bus::spi::ExclusiveDevice;
use mipidsi::Builder;
use mipidsi::dcs::{DcsCommand, InterfaceExt, SetColumnAddress, SetPageAddress, WriteMemoryStart};
use mipidsi::interface::SpiInterface;
use mipidsi::models::ST7789;
use mipidsi::options::{ColorInversion, Orientation, Rotation};
use zerocopy::IntoBytes;

use crate::fault::Fault;
use crate::job::{BANDS, Job, Schedule, TO_TRACE, TRACED};
use crate::picture::{HEIGHT, WIDTH};

const PANEL_WIDTH: usize = 320;
const PANEL_HEIGHT: usize = 240;
const _: () = assert!(WIDTH <= PANEL_WIDTH && HEIGHT <= PANEL_HEIGHT, "the panel has 320x240 pixels");
const _: () = assert!(WIDTH > 0 && HEIGHT > 0, "the picture has at least one pixel");

/// The panel's bus, which has no other device.
pub(crate) type Bus = Spi<'static, SPI0, Async>;

/// The settings of the bus.
pub(crate) fn bus() -> Config {
    let mut config = Config::default();
    // The controller's fastest clock: 16 ns a bit (Sitronix, "ST7789V"). The bus divides the chip's clock by
    // an even number, so 200 MHz give 50 MHz.
    config.frequency = 62_500_000;
    config
}

/// The panel's pins that are not the bus's.
pub(crate) struct Pins {
    /// High for data, low for commands.
    pub(crate) data: Output<'static>,
    /// Low while the panel is selected.
    pub(crate) select: Output<'static>,
    pub(crate) backlight: Output<'static>,
}

/// An initialized panel.
pub(crate) struct Panel {
    bus: Bus,
    pins: Pins,
}

impl Panel {
    /// Initializes the panel, makes it black, and opens the window of all frames, in the middle.
    pub(crate) fn new(mut bus: Bus, mut pins: Pins) -> Result<Self, Fault> {
        let mut buffer = [0; 512];
        let device = ExclusiveDevice::new_no_delay(&mut bus, &mut pins.select).map_err(|_| Fault::Panel)?;
        let interface = SpiInterface::new(device, &mut pins.data, &mut buffer);
        let mut display = Builder::new(ST7789, interface)
            .orientation(Orientation::new().rotate(Rotation::Deg90))
            // These panels show inverted colors unless inversion is on.
            .invert_colors(ColorInversion::Inverted)
            .init(&mut Delay)
            .map_err(|_| Fault::Panel)?;
        display.clear(Rgb565::BLACK).map_err(|_| Fault::Panel)?;
        let (mut interface, _, _) = display.release();
        let (left, right) = window(PANEL_WIDTH, WIDTH);
        let (top, bottom) = window(PANEL_HEIGHT, HEIGHT);
        interface.write_command(SetColumnAddress::new(left, right)).map_err(|_| Fault::Panel)?;
        interface.write_command(SetPageAddress::new(top, bottom)).map_err(|_| Fault::Panel)?;

        // The panel stays selected from here on.
        pins.select.set_low();
        pins.backlight.set_high();
        Ok(Self { bus, pins })
    }

    /// Sends bands, frame after frame, and returns each band to the cores with the lines of the next job. It
    /// returns only on a fault.
    pub(crate) async fn show(mut self, mut schedule: Schedule) -> Result<Infallible, Fault> {
        // Jobs that were traced before their turn.
        let mut early: [Option<Job>; BANDS] = [const { None }; BANDS];
        loop {
            for turn in 0..BANDS {
                let Job { band, lines, number, .. } = in_turn(turn, &mut early).await;
                if lines.start == 0 {
                    self.begin()?;
                }
                self.bus.write(band.drawn().as_bytes()).await.map_err(|_| Fault::Panel)?;
                TO_TRACE.send(schedule.next(number, band)).await;
            }
        }
    }

    /// Returns to the upper left corner of the window.
    fn begin(&mut self) -> Result<(), Fault> {
        self.pins.data.set_low();
        self.bus.blocking_write(&[WriteMemoryStart.instruction()]).map_err(|_| Fault::Panel)?;
        SpiBus::flush(&mut self.bus).map_err(|_| Fault::Panel)?;
        self.pins.data.set_high();
        Ok(())
    }
}

/// Waits until the job of this turn is traced.
async fn in_turn(turn: usize, early: &mut [Option<Job>; BANDS]) -> Job {
    loop {
        if let Some(job) = early.get_mut(turn).and_then(Option::take) {
            return job;
        }
        let job = TRACED.receive().await;
        if let Some(place) = early.get_mut(job.number) {
            *place = Some(job);
        }
    }
}

/// The first and the last column or row of a window of `inner` in the middle of a panel of `outer`.
const fn window(outer: usize, inner: usize) -> (u16, u16) {
    let first = (outer - inner) / 2;
    (first as u16, (first + inner - 1) as u16)
}

/// A delay that counts cycles of the chip's clock.
struct Delay;

impl DelayNs for Delay {
    fn delay_ns(&mut self, nanoseconds: u32) {
        let cycles_per_microsecond = clk_sys_freq() / 1_000_000;
        cortex_m::asm::delay(nanoseconds.div_ceil(1000) * cycles_per_microsecond);
    }
}
