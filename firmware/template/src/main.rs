//! A ray-traced ball on a Raspberry Pi Pico with an ST7789 panel of 320x240 pixels.

#![no_std]
#![no_main]

use cortex_m::delay::Delay;
use defmt::{Debug2Format, Display2Format, error, info};
use defmt_rtt as _;
use embassy_rp::clocks::clk_sys_freq;
use embassy_rp::gpio::{Level, Output};
use embassy_rp::spi::{Config, Spi};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use embedded_hal_bus::spi::ExclusiveDevice;
use mipidsi::options::{ColorInversion, Orientation, Rotation};
use mipidsi::{Builder, interface::SpiInterface, models::ST7789};
use panic_probe as _;
use rayline::{Background, Camera, Light, LinearRgb, Material, Object, PreparedScene, Renderer, Scene};
use rayline::{Settings, Vec3, Workspace, math::Fixed, prepared_bytes, shape::Sphere};

static SCENE: Scene<Sphere> = Scene {
    camera: Camera {
        eye: Vec3::new(0.0, 0.0, 4.0),
        target: Vec3::ZERO,
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 40f32.to_radians(),
        lens: None,
    },
    background: Background::Solid(LinearRgb::new(0.0, 0.02, 0.05)),
    objects: &[Object::new(Sphere::new(Vec3::ZERO, 1.0), 0)],
    materials: &[Material {
        specular: 0.4,
        shininess: 30.0,
        ..Material::matte(LinearRgb::new(0.8, 0.2, 0.1))
    }],
    lights: &[Light::Point { position: Vec3::new(-3.0, 4.0, 5.0), color: LinearRgb::WHITE }],
    motions: &[],
};

#[cortex_m_rt::entry]
fn main() -> ! {
    let _ = run(); // what fails is logged
    loop {
        cortex_m::asm::wfi();
    }
}

fn run() -> Result<(), ()> {
    let p = embassy_rp::init(embassy_rp::config::Config::default());
    let mut delay = Delay::new(cortex_m::Peripherals::take().ok_or(())?.SYST, clk_sys_freq());
    let mut fast = Config::default();
    fast.frequency = 62_500_000; // the controller's fastest clock
    let bus = Spi::new_blocking_txonly(p.SPI0, p.PIN_18, p.PIN_19, fast);
    let (data, select) = (Output::new(p.PIN_16, Level::High), Output::new(p.PIN_17, Level::High));
    let mut backlight = Output::new(p.PIN_20, Level::Low);

    let mut buffer = [0; 512];
    let Ok(device) = ExclusiveDevice::new_no_delay(bus, select);
    let mut display = Builder::new(ST7789, SpiInterface::new(device, data, &mut buffer))
        .orientation(Orientation::new().rotate(Rotation::Deg90))
        .invert_colors(ColorInversion::Inverted)
        .init(&mut delay)
        .map_err(|failure| error!("the panel: {}", Debug2Format(&failure)))?;

    let mut memory = Workspace::<{ prepared_bytes!(Fixed, SCENE) }>::new();
    let scene = PreparedScene::<Fixed, _>::new(&SCENE, memory.lend()).map_err(log)?;
    let renderer = Renderer::new(&scene, Settings::new(320, 240)).map_err(log)?;
    renderer.draw(&mut display, &mut [Rgb565::BLACK; 320]).map_err(log)?;
    backlight.set_high();
    info!("the picture is drawn");
    Ok(())
}

fn log(failure: impl core::fmt::Display) {
    error!("{}", Display2Format(&failure));
}
