//! A preview by scan conversion, which a slow chip shows while things move. Where the camera rests, the same
//! renderer traces the picture.
//!
//! Firmware takes everything but the GIF: the memory can be `static`, and the camera follows a knob or an
//! accelerometer.

use std::error::Error;
use std::fs::File;

use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};
use rayline::builtin::PRISM;
use rayline::{Camera, PreparedScene, Preview, PreviewFacet, PreviewPixel, Renderer, Settings, Vec3};

const WIDTH: u16 = 160;
const HEIGHT: u16 = 120;
const FRAMES: u16 = 24;
/// Of polygons that take the place of circles. More look rounder, and take more facets.
const SEGMENTS: u16 = 12;
/// As many as the scene has from all sides; `Preview::new` tells if they are too few.
const FACETS: usize = 1200;

fn main() -> Result<(), Box<dyn Error>> {
    let mut memory = vec![core::mem::MaybeUninit::uninit(); PRISM.bytes::<f32>()];
    let mut scene = PreparedScene::<f32, _>::new(&PRISM, &mut memory)?;
    let mut facets = vec![PreviewFacet::BLANK; FACETS];
    let mut pixels = [PreviewPixel::BLANK; WIDTH as usize];
    let mut line = [Rgb565::BLACK; WIDTH as usize];
    let mut display = SimulatorDisplay::new(Size::new(WIDTH.into(), HEIGHT.into()));
    let path = rayline_examples::file("preview.gif")?;
    let mut film = gif::Encoder::new(File::create(&path)?, WIDTH, HEIGHT, &[])?;
    film.set_repeat(gif::Repeat::Infinite)?;
    for frame in 0..=FRAMES {
        let angle = 0.6 * (f32::from(frame) / f32::from(FRAMES) - 1.0);
        scene.set_camera(&turned(&PRISM.camera, angle))?;
        let renderer = Renderer::new(&scene, Settings::new(WIDTH.into(), HEIGHT.into()))?;
        let is_moving = frame < FRAMES;
        if is_moving {
            let mut preview = Preview::new(&renderer, SEGMENTS, &mut facets)?;
            renderer.draw(&mut display, preview.lend(&mut line, &mut pixels))?;
        } else {
            renderer.draw(&mut display, &mut line)?;
        }

        let picture = display.to_rgb_output_image(&OutputSettings::default());
        let mut still = gif::Frame::from_rgb(WIDTH, HEIGHT, picture.as_image_buffer().as_raw());
        still.delay = if is_moving { 4 } else { 200 }; // hundredths of a second
        film.write_frame(&still)?;
    }
    println!("{}: {FRAMES} previews, and a traced picture", path.display());
    Ok(())
}

/// The camera, turned about the vertical axis through its target.
fn turned(camera: &Camera, angle: f32) -> Camera {
    let (sine, cosine) = angle.sin_cos();
    let Vec3 { x, y, z } = camera.eye - camera.target;
    let eye = camera.target + Vec3::new(x * cosine + z * sine, y, z * cosine - x * sine);
    Camera { eye, ..*camera }
}
