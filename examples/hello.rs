//! The README's first program: a lit sphere on a display.
//!
//! Firmware takes `SCENE` and `draw`. The display of a board is its driver, such as that of the crate
//! `mipidsi`, and errors are an enum instead of `Box`.

use embedded_graphics::{draw_target::DrawTarget, pixelcolor::Rgb565, prelude::*};
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};
use rayline::shape::Sphere;
use rayline::{
    Background, Camera, Light, LinearRgb, Material, Object, PreparedScene, Renderer, Scene, Settings,
};
use rayline::{Vec3, Workspace, prepared_bytes};

static SCENE: Scene<Sphere> = Scene {
    camera: Camera {
        eye: Vec3::new(0.0, 0.0, 4.0),
        target: Vec3::new(0.0, 0.0, 0.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 40f32.to_radians(),
        lens: None,
    },
    background: Background::Solid(LinearRgb::new(0.0, 0.02, 0.05)),
    objects: &[Object::new(Sphere::new(Vec3::new(0.0, 0.0, 0.0), 1.0), 0)],
    materials: &[Material {
        specular: 0.4,
        shininess: 30.0,
        ..Material::matte(LinearRgb::new(0.8, 0.2, 0.1))
    }],
    lights: &[Light::Point { position: Vec3::new(-3.0, 4.0, 5.0), color: LinearRgb::WHITE }],
    motions: &[],
};

fn draw<D: DrawTarget<Color = Rgb565>>(display: &mut D) -> Result<(), Box<dyn core::error::Error>>
where
    D::Error: core::fmt::Debug + 'static,
{
    let mut memory = Workspace::<{ prepared_bytes!(f32, SCENE) }>::new();
    let scene = PreparedScene::<f32, _>::new(&SCENE, memory.lend())?; // only this step can refuse a scene
    let renderer = Renderer::new(&scene, Settings::new(160, 128))?;
    renderer.draw(display, &mut [Rgb565::BLACK; 160])?; // one line at a time
    Ok(())
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let mut display = SimulatorDisplay::new(Size::new(160, 128));
    draw(&mut display)?;
    rayline_examples::save(&display, &OutputSettings::default(), "hello.png")
}
