//! A scene that moves, in realtime quality: two balls bounce on a floor.
//!
//! Firmware takes everything but the GIF: the memory can be `static`, and the loop has no end. If the frames
//! must come faster than a chip traces them, set `Realtime::budget_rays`.

use std::error::Error;
use std::fs::File;

use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};
use rayline::shape::{Plane, Sphere};
use rayline::{
    Background, Camera, Light, LinearRgb, Material, Object, PreparedScene, Realtime, Renderer, Sample,
    SceneBuf, Settings, Texture, Vec3, Workspace, prepared_bytes,
};

const WIDTH: u16 = 160;
const HEIGHT: u16 = 120;
const FRAMES: u16 = 24;
const QUALITY: Realtime = Realtime::fine();

const CAMERA: Camera = Camera {
    eye: Vec3::new(0.0, 1.8, 7.0),
    target: Vec3::new(0.0, 1.2, 0.0),
    up: Vec3::new(0.0, 1.0, 0.0),
    vertical_fov: 40f32.to_radians(),
    lens: None,
};

rayline::shape_set! {
    /// The shapes of the scene: the program links no other.
    enum Toy;
    enum PreparedToy {
        Ball(Sphere),
        Floor(Plane),
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut scene = SceneBuf::<Toy, 3, 3, 1>::new(CAMERA, Background::Solid(LinearRgb::new(0.1, 0.2, 0.4)));
    let tiles = Texture::checker_xz(LinearRgb::gray(0.7), LinearRgb::gray(0.3), 1.0);
    let floor = scene.add_material(Material { color: tiles, ..Material::matte(LinearRgb::WHITE) })?;
    let red = scene.add_material(Material::matte(LinearRgb::new(0.8, 0.1, 0.05)))?;
    let mirror = scene
        .add_material(Material { reflectance: 0.7, ..Material::matte(LinearRgb::new(0.2, 0.2, 0.25)) })?;
    scene.add_object(Toy::Floor(Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0))), floor)?;
    scene.add_object(Toy::Ball(Sphere::new(Vec3::new(-1.0, 0.0, 0.0), 0.7)), red)?;
    scene.add_object(Toy::Ball(Sphere::new(Vec3::new(1.0, 0.0, -0.5), 0.7)), mirror)?;
    scene.add_light(Light::Point { position: Vec3::new(-3.0, 6.0, 4.0), color: LinearRgb::WHITE })?;

    let mut memory = Workspace::<{ prepared_bytes::<f32, Toy>(3, 3, 1, 0) }>::new();
    let mut colors = [Rgb565::BLACK; QUALITY.colors(WIDTH)];
    let mut samples = [Sample::BLANK; QUALITY.samples(WIDTH)];
    let mut display = SimulatorDisplay::new(Size::new(WIDTH.into(), HEIGHT.into()));
    let path = rayline_examples::file("animate.gif")?;
    let mut film = gif::Encoder::new(File::create(&path)?, WIDTH, HEIGHT, &[])?;
    film.set_repeat(gif::Repeat::Infinite)?;
    for frame in 0..FRAMES {
        let moment = f32::from(frame) / f32::from(FRAMES);
        for (object, ahead) in scene.objects_mut().iter_mut().zip([0.0, 0.0, 0.5]) {
            if let Object { shape: Toy::Ball(ball), .. } = object {
                let time = (moment + ahead).fract();
                ball.center.y = ball.radius + 6.0 * time * (1.0 - time);
            }
        }
        let prepared = PreparedScene::<f32, _>::new(&scene.as_scene(), memory.lend())?;
        let renderer = Renderer::new(&prepared, Settings::new(WIDTH.into(), HEIGHT.into()))?;
        renderer.draw(&mut display, QUALITY.lend(&mut colors, &mut samples))?;

        let picture = display.to_rgb_output_image(&OutputSettings::default());
        let mut still = gif::Frame::from_rgb(WIDTH, HEIGHT, picture.as_image_buffer().as_raw());
        still.delay = 4; // hundredths of a second
        film.write_frame(&still)?;
    }
    println!("{}: {FRAMES} pictures of {WIDTH}x{HEIGHT} pixels", path.display());
    Ok(())
}
